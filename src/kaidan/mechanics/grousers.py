r"""Tracks with grousers on stairs: a tip that stands on a tread holds with little friction.

::

            belt, inclined by theta ->   . '
                                   . '  |/
                     grouser   . '|  \  |     tip of height h: stands on the tread,
                           . ' \  |   \ v       normal tilted by beta = 0
                   . '          \_|____________
               . '   nosing, r  (    tread
           . '                  |
                                | riser: a face that nothing can stand on

Closed risers offer treads, whose normal is vertical, and faces, whose normal points downhill.
Nothing faces uphill, so a grouser cannot hook behind a nosing. But its tip stands on the tread just
above the edge, where the normal is tilted by beta and not by theta as under the belt.
"""

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


def standing_run(*, theta: Number, h: Number, r: Number) -> Number:
    """Length along the belt over which a grouser stands on the tread behind a nosing.

    ``l = [h - r (1 - cos(theta))]+ / tan(theta)``

    A tip comes to the tread, and then climbs the round. Of rigid grousers so close that the one
    before is not yet clear, h is `height_behind`.

    Assumptions: rigid grousers with sharp edges; straight belt.

    Parameters
    ----------
    theta : float or array
        Slope of the belt above the tread [rad].
    h : float or array
        Height of the grousers under load [m].
    r : float or array
        Radius of the nosing [m].

    Returns
    -------
    float or array
        l [m].

    Examples
    --------
    >>> print(round(standing_run(theta=np.pi / 4, h=0.012, r=0.0), 9))
    0.012

    References
    ----------
    Derived: docs/theory/grousers.md.
    """
    return np.maximum(h - r * (1.0 - np.cos(theta)), 0.0) / np.tan(theta)


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


def slip_height(*, psi: Number, s: Number, mu_k: Number, mu_required: Number) -> Number:
    """Kinetic-energy height of a robot that has slipped back by a spacing of its grousers.

    ``v^2 / 2g = s sin(psi) (1 - mu_k / mu_required)``

    Weight does the work ``s sin(psi)``. All contacts slide, and with the friction required they
    would do as much; sliding friction does its share of that. On a flight psi = theta and
    mu_required = tan(theta): ``s (sin(theta) - mu_k cos(theta))``.

    Assumptions: it starts at rest, the belt stands still, and no grouser brakes it before.

    Parameters
    ----------
    psi : float or array
        Direction of the centroid's path above the horizontal [rad].
    s : float or array
        How far it slips [m].
    mu_k : float or array
        Sliding friction [1].
    mu_required : float or array
        Static friction with which nothing would slip [1].

    Returns
    -------
    float or array
        Height [m]; zero where friction holds.

    Examples
    --------
    >>> theta = np.radians(37.8)
    >>> height = slip_height(psi=theta, s=0.020, mu_k=0.3, mu_required=np.tan(theta))
    >>> print(round(1e3 * height, 1))
    7.5

    References
    ----------
    Derived: the work of weight and friction over the slip.
    """
    return np.maximum(s * np.sin(psi) * (1.0 - mu_k / mu_required), 0.0)
