r"""Grousers and the phase at which nosings meet them: theta_d, theta_M and the margin by geometry.

::

                         . '  flat, leaning by m more than the stairs
                    . '
               . '|  c: the nosing that stays stands under a tip
          . '_ w  *
       . '
     *  the nosing that is lost lies between two tips, or e beyond the end of the flat

A nosing keeps its place on the belt for its whole passage. Whether it stands under a tip or between
two is its phase, and that of the next nosing differs by the nosing spacing.
"""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number

_ROUNDS = 60
_PLACES, _WEIGHTS = np.polynomial.laguerre.laggauss(24)


def limit_at_loss(
    *,
    L: Number,
    p: Number,
    C_L: Number,
    C_N: Number,
    c: Number = 0.0,
    w: Number = 0.0,
    e: Number = 0.0,
) -> Number:
    """Slope at which the centroid is plumb above the nosing that stays, as the lowest one is lost.

    ``atan2(L - p cos(m) - C_L + e, C_N + c) - m``, ``m = arcsin((c + w) / p)``

    Assumptions: rigid belt and nosings; at rest; two nosings carry until one is lost.

    Parameters
    ----------
    L, p, C_L, C_N : float or array
        Flat length, nosing spacing, centroid behind the front tip and above the underside [m].
    c : float or array
        Height of the flat above the nosing that stays [m].
    w : float or array
        How far the nosing that is lost stands above the flat, prolonged, when it is lost [m].
    e : float or array
        How far beyond the end of the flat it is lost [m].

    Returns
    -------
    float or array
        Slope [rad]; NaN where c + w exceeds p.

    Examples
    --------
    >>> kenaf = {"L": 0.470, "p": 0.150, "C_L": 0.196, "C_N": 0.071}
    >>> print(round(limit_at_loss(**kenaf) * 180 / np.pi, 3))
    60.205

    References
    ----------
    Derived: docs/theory/grouser_phase.md.
    """
    m = np.arcsin((c + w) / p)
    return np.arctan2(L - p * np.cos(m) - C_L + e, C_N + c) - m


def limit_up(*, L: Number, p: Number, C_L: Number, C_N: Number, h: Number) -> Number:
    """Steepest slope up at the worst phase of grousers: both losses at once.

    ``limit_at_loss(c=h, w=0)``: the nosing that stays is under a tip, the lost one between two.

    Parameters
    ----------
    h : float or array
        Height of the grousers [m].

    Returns
    -------
    float or array
        Slope [rad]. First order: theta_s_sup - h (1 / p + sin cos(theta_s_sup) / C_N).

    Examples
    --------
    >>> kenaf = {"L": 0.470, "p": 0.150, "C_L": 0.196, "C_N": 0.071}
    >>> print(round(limit_up(h=0.0068, **kenaf) * 180 / np.pi, 1))
    55.3

    References
    ----------
    Derived: docs/theory/grouser_phase.md.
    """
    return limit_at_loss(L=L, p=p, C_L=C_L, C_N=C_N, c=h)


def limit_down(*, L: Number, p: Number, C_L: Number, C_N: Number, h: Number) -> Number:
    """Steepest slope down, tail first, at the worst phase of grousers: one loss or the other.

    ``min(limit_at_loss(c=h, w=-h), limit_at_loss(c=0, w=h))``

    Parameters
    ----------
    h : float or array
        Height of the grousers [m].

    Returns
    -------
    float or array
        Slope [rad]. First order: theta_s_sup - max(h / p, h sin cos(theta_s_sup) / C_N).

    Examples
    --------
    >>> kenaf = {"L": 0.470, "p": 0.150, "C_L": 0.196, "C_N": 0.071}
    >>> print(round(limit_down(h=0.0068, **kenaf) * 180 / np.pi, 1))
    57.6

    References
    ----------
    Derived: docs/theory/grouser_phase.md.
    """
    place = {"L": L, "p": p, "C_L": C_L, "C_N": C_N}
    return np.minimum(limit_at_loss(c=h, w=-h, **place), limit_at_loss(w=h, **place))


def winding_angle(*, R: Number, delta: Number) -> Number:
    """Angle of a round end at which a bar without a tread is met by the next grouser.

    ``R (phi - sin(phi)) = delta``: the belt winds over the bar by that much more than the robot
    goes on.

    Parameters
    ----------
    R : float or array
        Radius of the end [m].
    delta : float or array
        Free belt between the bar and the grouser that comes, as the bar leaves the flat [m].

    Returns
    -------
    float or array
        phi [rad], at most pi / 2, where the end has left the bar anyway.

    Examples
    --------
    >>> print(round(winding_angle(R=2.0, delta=2.0 * (1.0 - np.sin(1.0))), 12))
    1.0

    References
    ----------
    Derived: docs/theory/grouser_phase.md.
    """
    low = 0.0 * (R + delta)
    high = low + np.pi / 2
    for _ in range(_ROUNDS):
        phi = 0.5 * (low + high)
        late = R * (phi - np.sin(phi)) > delta
        low, high = np.where(late, low, phi), np.where(late, phi, high)
    return 0.5 * (low + high)


def limit_of_round_end(
    *,
    L: Number,
    p: Number,
    C_L: Number,
    C_N: Number,
    R: Number,
    c: Number = 0.0,
    phi: Number = np.pi / 2,
) -> Number:
    """Steepest slope that holds at rest where a round end carries the robot down from its nosing.

    ``max of limit_at_loss(w=R (1 - cos), e=R sin)`` over angles up to phi.

    Assumptions: nosings alone (no tread arrests the tail); smooth but for c.

    Parameters
    ----------
    R : float or array
        Radius of the end [m].
    c : float or array
        Height of the flat above the nosing that stays [m].
    phi : float or array
        Angle of the end at which it is detached at the latest [rad], as `winding_angle` has it.

    Returns
    -------
    float or array
        Slope [rad].

    Examples
    --------
    >>> kenaf = {"L": 0.470, "p": 0.150, "C_L": 0.196, "C_N": 0.071}
    >>> print(round(limit_of_round_end(R=0.060, **kenaf) * 180 / np.pi, 1))
    62.5

    References
    ----------
    Derived: docs/theory/grouser_phase.md.
    """
    t = 0.0 * (L + p + C_L + C_N + R + c)
    for _ in range(_ROUNDS):
        m = np.arcsin((c + R * (1.0 - np.cos(t))) / p)
        x, z = L - p * np.cos(m) - C_L + R * np.sin(t), C_N + c
        t = np.arctan2(z * p * np.cos(m), x * x + z * z - z * p * np.sin(m))
    t = np.minimum(t, phi)
    return limit_at_loss(L=L, p=p, C_L=C_L, C_N=C_N, c=c, w=R * (1.0 - np.cos(t)), e=R * np.sin(t))


def lead_of_driving(
    *, x: Number, C_N: Number, v: Number, rho: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """What driving on while it topples adds to the limit: the belt carries the centroid uphill.

    ``mean of atan2(x + v t, C_N), weighted by lambda exp(-lambda t), - atan2(x, C_N)``,
    ``lambda = sqrt(b^2 + g H / (rho^2 + H^2)) - b``, ``b = x v / (rho^2 + H^2)``, H^2 = x^2 + C_N^2

    Assumptions: up, at rest until the loss; a sharp end, which arrests nothing; first order in the
    angle beyond the limit.

    Parameters
    ----------
    x : float or array
        Centroid ahead of the nosing that stays [m].
    C_N : float or array
        Centroid above it [m].
    v : float or array
        Speed [m/s].
    rho : float or array
        Radius of gyration about the centroid [m].

    Returns
    -------
    float or array
        Angle [rad].

    Examples
    --------
    >>> print(round(lead_of_driving(x=0.124, C_N=0.071, v=0.1, rho=0.150) * 180 / np.pi, 1))
    3.0

    References
    ----------
    Derived: docs/theory/grouser_phase.md.
    """
    squared = x * x + C_N * C_N
    inertia = rho * rho + squared
    b = x * v / inertia
    rate = np.sqrt(b * b + g * np.sqrt(squared) / inertia) - b
    mean = sum(
        weight * np.arctan2(x + v * place / rate, C_N)
        for place, weight in zip(_PLACES, _WEIGHTS, strict=True)
    )
    return mean - np.arctan2(x, C_N)
