"""Grousers that the kernel judges one by one, as formulas (docs/theory/grousers.md)."""

import numpy as np

from kaidan.mechanics import Number


def tip_tilt(*, theta: Number, h: Number, r: Number, curvature: Number = 0.0) -> Number:
    """Tilt of the normal where the tip of a grouser stands deepest behind a nosing.

    ``beta = max(0, theta - 2 arctan(sqrt(a) / sqrt(2 b - a)))``,
    a = h (1 + h k / 2), b = r (1 + r k), k the curvature of the belt.

    The round of the nosing, where its normal is tilted by beta, lies ``b (1 - cos(theta - beta))``
    below the belt, in the measure in which the tip stands ``a`` out of it. From zero on, the tip
    stands on the tread.

    Assumptions: rigid grouser, sharp at its tip; nosing round with radius r, tread level.

    Parameters
    ----------
    theta : float or array
        Tilt of the belt's normal where it touches the nosing, from the tread's [rad], 0 to pi/2.
    h : float or array
        Height of the grouser above the belt, under load [m]; zero is a smooth belt.
    r : float or array
        Radius of the nosing [m].
    curvature : float or array
        Of the belt there [1/m]: zero on the flat, one over the radius on a round end.

    Returns
    -------
    float or array
        beta [rad], 0 to theta.

    Examples
    --------
    A tip of half the radius of the nosing reaches 60 degrees farther up the round.

    >>> print(round(np.degrees(tip_tilt(theta=np.radians(80), h=0.005, r=0.010)), 9))
    20.0
    >>> print(round(np.degrees(tip_tilt(theta=np.radians(80), h=0.0, r=0.010)), 9))
    80.0

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    a = h * (1.0 + 0.5 * h * curvature)
    b = r * (1.0 + r * curvature)
    reach = 2.0 * np.arctan2(np.sqrt(a), np.sqrt(np.maximum(2.0 * b - a, 0.0)))
    return np.maximum(theta - reach, 0.0)


def roll_off_length(*, theta: Number, h: Number, r: Number) -> Number:
    """Length along the belt over which a grouser that has passed a nosing rolls off it.

    ``l_off = sqrt(h (2 r - h))``, or ``r cos(theta)`` where h > r (1 - sin(theta)) and the edge of
    the tip comes as far down as the riser's face.

    Its uphill edge then rests on normals tilted by more than theta, and pushes the robot down.

    Assumptions: rigid grouser with a sharp edge; straight belt.

    Parameters
    ----------
    theta : float or array
        Tilt of the belt's normal from the tread's [rad], 0 to pi/2.
    h : float or array
        Height of the grousers under load [m].
    r : float or array
        Radius of the nosings [m].

    Returns
    -------
    float or array
        l_off [m].

    Examples
    --------
    >>> print(round(float(roll_off_length(theta=np.radians(30), h=0.002, r=0.010)), 9))
    0.006
    >>> print(round(float(roll_off_length(theta=np.radians(60), h=0.012, r=0.010)), 9))
    0.005

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    round_ = np.sqrt(np.maximum(h * (2.0 * r - h), 0.0))
    return np.where(h > r * (1.0 - np.sin(theta)), r * np.cos(theta), round_)


def roll_off_sine(*, run: Number, off: Number, r: Number) -> Number:
    """Sine of the tilt that a grouser loses while another one rolls off its nosing.

    ``gamma = max(0, l_off - l) / (2 r)``

    While one tip rolls off its nosing over l_off, a tip that stands at another has l on the tread
    and then climbs the round, where the sine of theta - beta falls by 1 / r a metre. Whenever the
    one begins to roll, the other holds at one of two times: as it comes to stand, while the first
    has rolled off by gamma at most; or when the first has rolled off, and its own sine is less by
    gamma at most.

    Assumptions: those of `standing_run`; the worst phase of the two nosings.

    Parameters
    ----------
    run, off : float or array
        l of the one and l_off of the other, see `standing_run` and `roll_off_length` [m].
    r : float or array
        Radius of the nosings [m], more than zero.

    Returns
    -------
    float or array
        gamma [1]; zero where a tip stands on the tread for longer than another rolls off.

    Examples
    --------
    >>> print(round(roll_off_sine(run=0.002, off=0.006, r=0.010), 9))
    0.2

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    return np.maximum(off - run, 0.0) / (2.0 * r)


def standing_friction(*, theta: Number, beta: Number, share: Number) -> Number:
    """Least friction with which a robot holds, a grouser under a share of its load.

    ``share tan(theta - beta + phi) + (1 - share) tan(phi) = tan(theta)`` for mu = tan(phi):
    with A = tan(theta - beta), T = tan(theta), q = 1 + T A
    ``mu = 2 (T - share A) / (q + sqrt(q^2 - 4 (1 - share) A (T - share A)))``

    Assumptions: a straight belt on the nosings, so that tractive forces have no moment; Coulomb
    friction, one coefficient; one grouser stands.

    Parameters
    ----------
    theta : float or array
        Slope of the belt [rad], 0 to pi/2.
    beta : float or array
        Tilt of the normal under the tip [rad], see `tip_tilt`; theta is a smooth belt.
    share : float or array
        Share of the load on that contact [1], 0 to 1.

    Returns
    -------
    float or array
        Friction [1]: tan(theta) without a share, zero where all of it stands on the tread.

    Examples
    --------
    >>> print(round(standing_friction(theta=np.radians(37.8), beta=0.0, share=0.29), 2))
    0.4
    >>> print(round(standing_friction(theta=np.pi / 4, beta=0.0, share=0.0), 9))
    1.0

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    A = np.tan(theta - beta)
    T = np.tan(theta)
    q = 1.0 + T * A
    missing = T - share * A
    root = np.sqrt(np.maximum(q * q - 4.0 * (1.0 - share) * A * missing, 0.0))
    return np.maximum(2.0 * missing / (q + root), 0.0)


def phases_friction(*, theta: Number, q: Number) -> Number:
    """Friction with which a robot holds in the mean over the phases of its grousers.

    ``q min(tan(theta + phi), 2 tan(theta)) + (1 - q) tan(phi) = tan(theta)`` for mu = tan(phi)

    With three nosings or more under a rigid belt, which two carry depends on the phases, and a tip
    may stand where no load is. What is certain is the mean: each nosing has a tip on its tread in a
    share q of the phases. What a tip holds beyond twice the slope counts for nothing: rigid teeth
    may give it no more than half of the load. Rigid teeth in 2,700 random cases slid for good in
    none where this friction was exceeded by 0.01 (docs/theory/grousers.md).

    Parameters
    ----------
    theta : float or array
        Slope of the belt [rad], 0 to pi/2.
    q : float or array
        Share of the phases in which a grouser stands on the tread [1]; three quarters of it
        with four nosings or more.

    Returns
    -------
    float or array
        Friction [1].

    Examples
    --------
    >>> print(round(phases_friction(theta=np.pi / 4, q=0.1), 9))  # 0.8 / 0.9
    0.888888889

    References
    ----------
    Derived, the bound of twice the slope and the three quarters fitted: docs/theory/grousers.md.
    """
    bounded = np.tan(theta) * (1.0 - 2.0 * q) / (1.0 - q)
    return np.maximum(standing_friction(theta=theta, beta=0.0, share=q), bounded)


def face_friction(*, mu: Number, h: Number, curvature: Number) -> Number:
    """Friction that grousers on a round end have left at a riser's face.

    ``mu / (1 + h k)^2``: they come round the end apart from one another, push it off the face, and
    their tips run so much faster than the belt. A rule for trials, not derived.

    Assumptions: rigid grousers; fitted with 1 to 10 mm round an end of 29 mm, tried round ends of
    15 to 89 mm at 0.1 m/s.

    Parameters
    ----------
    mu : float or array
        Friction of a smooth belt at the face [1].
    h : float or array
        Height of the grouser above the belt, under load [m]; zero is a smooth belt.
    curvature : float or array
        Of the belt there [1/m]: one over the radius of the end.

    Returns
    -------
    float or array
        [1]

    Examples
    --------
    >>> print(round(face_friction(mu=0.6, h=0.010, curvature=1 / 0.029), 3))
    0.332

    References
    ----------
    Fitted: docs/theory/grousers.md.
    """
    return mu / (1.0 + h * curvature) ** 2


def belt_lag(*, d_x: Number, d_z: Number, own: Number, other: Number) -> Number:
    """Share of its speed by which a belt passes one support more slowly than another.

    ``1 - (d_x cos(other) - d_z sin(other)) / (d_x cos(own) - d_z sin(own))``

    A robot that rests on two supports can only rotate about the point where their normals meet. So
    each passes by in proportion to its distance from there; where the normals are parallel, alike.
    Belts run everywhere at one speed. The one that passes more slowly runs on, and takes its
    grousers back with it: a tip slides back by ``s belt_lag`` while the belt runs on by a spacing.

    Assumptions: rigid; all belts run at one speed; the other support does not slide.

    Parameters
    ----------
    d_x, d_z : float or array
        From the other support to the own one, ahead and up [m].
    own, other : float or array
        Tilt of the normal of each from the vertical, ahead positive [rad].

    Returns
    -------
    float or array
        [1]: negative where the belt passes faster there; more than one where it passes the other
        way.

    Examples
    --------
    The other on a riser's face, its normal level, the own one as far below as behind it, so that
    the distances from where they meet are 1 and sqrt(1/2):

    >>> lag = belt_lag(d_x=-0.3, d_z=-0.3, own=np.radians(-45), other=np.radians(-90))
    >>> print(round(float(1.0 - lag) ** 2, 9))
    0.5

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    far = d_x * np.cos(own) - d_z * np.sin(own)
    near = d_x * np.cos(other) - d_z * np.sin(other)
    return 1.0 - near / far
