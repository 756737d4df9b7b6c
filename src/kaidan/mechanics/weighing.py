"""Where the centroid is: two scales, level and on a slope, or the inclination at which it tips.

::

                      ___ C                 phi   inclination of the flat, nose up
                  ___/ | /                  x_f, x_r   supports behind the front tip of the flat
            _____/_____|/_                  m_f, m_r   what the scales under them show
       ____/______/    |
      (_)_/  x_r  |    | x_f                plumb line: x of the flat is C_L + C_N tan(phi)
       m_r             m_f

And the angle and spacing of stairs from their totals. Every formula is that of a rigid body at
rest, and of vertical forces: one support must be free to roll.
"""

import math
from collections.abc import Callable, Mapping

import numpy as np

from kaidan.mechanics import Number


def plumb_position(*, m_f: Number, m_r: Number, x_f: Number, x_r: Number) -> Number:
    """Place on the flat through which the plumb line of the centroid passes.

    ``x = (m_f x_f + m_r x_r) / (m_f + m_r)``

    Moments about the front tip: each support carries vertically, so the cosine of the inclination
    cancels.

    Assumptions: at rest; supports on the flat, free of horizontal forces (one of them rolls).

    Parameters
    ----------
    m_f, m_r : float or array
        What the scales under the front and the rear support show [kg].
    x_f, x_r : float or array
        Supports behind the front tip of the flat, along the flat [m].

    Returns
    -------
    float or array
        Behind the front tip, along the flat [m]: C_L where the robot stands level.

    Examples
    --------
    >>> print(plumb_position(m_f=12.0, m_r=8.0, x_f=0.0, x_r=0.5))
    0.2

    References
    ----------
    Derived.
    """
    return (m_f * x_f + m_r * x_r) / (m_f + m_r)


def com_height_by_slope(*, x_level: Number, x_slope: Number, phi: Number) -> Number:
    """Height of the centroid above the underside from plumb positions, level and on a slope.

    ``C_N = (x_slope - x_level) / tan(phi)``

    Nose up by phi, the plumb line of the centroid meets the flat C_N tan(phi) further back.

    Assumptions: those of `plumb_position`, both times.

    Parameters
    ----------
    x_level, x_slope : float or array
        Plumb position with the flat level, and with the nose up by phi [m].
    phi : float or array
        Inclination of the flat, nose up positive [rad].

    Returns
    -------
    float or array
        Height [m]; negative where the values contradict each other.

    Examples
    --------
    >>> print(round(com_height_by_slope(x_level=0.2, x_slope=0.25, phi=math.atan(0.5)), 12))
    0.1

    References
    ----------
    Derived.
    """
    return (x_slope - x_level) / np.tan(phi)


def com_height_by_tipping(*, l_c: Number, phi: Number, R: Number) -> Number:
    """Height of the centroid from the inclination at which the robot balances on one end.

    ``C_N = R + l_c / tan(phi)``

    Balanced, the centroid stands plumb above the contact. On its round end that is the point
    below the centre of the end's disc, which lies R above the tip of the flat. On a ramp whose
    slope grows until the robot tips, the tip of the flat itself is the pivot: R = 0.

    Assumptions: the end of the flat is the pivot; the robot moves slowly and does not slip.

    Parameters
    ----------
    l_c : float or array
        That tip of the flat to the centroid, along the track [m]: L - C_L at the rear, C_L in
        front.
    phi : float or array
        Inclination of the flat [rad], away from level.
    R : float or array
        Radius of that end, or 0 on a ramp [m].

    Returns
    -------
    float or array
        Height [m].

    Examples
    --------
    >>> print(round(com_height_by_tipping(l_c=0.3, phi=math.atan(2.0), R=0.05), 12))
    0.2

    References
    ----------
    Derived.
    """
    return R + l_c / np.tan(phi)


def regular_step(*, total: Number, odd: Number, count: Number) -> Number:
    """Rise of the regular steps of a flight, or their going, from the total.

    ``(total - odd) / count``

    Assumptions: the regular steps are meant to be alike.

    Parameters
    ----------
    total : float or array
        Floor to floor, or first to last nosing [m].
    odd : float or array
        Sum of the first and the last riser where they differ, else 0 [m].
    count : float or array
        Number of regular steps.

    Returns
    -------
    float or array
        Rise or going [m].

    Examples
    --------
    >>> print(round(regular_step(total=2.72, odd=0.15 + 0.17, count=15), 12))
    0.16

    References
    ----------
    Derived.
    """
    return (total - odd) / count


def step_spread(*, differences: Number) -> float:
    """Standard deviation of single steps from some that were checked against the mean.

    ``s sqrt(k / (k - 2))``, s^2 = sum of the squared differences / k

    The mean is known from the totals, so k checks have k degrees of freedom. Of few checks the
    next step follows Student's t about that mean, whose variance is k / (k - 2) times s^2.

    Assumptions: steps scatter normally and independently; the tape's own scatter is left in.

    Parameters
    ----------
    differences : array
        Checked steps less the mean [m]; at least three.

    Returns
    -------
    float
        [m]; NaN for fewer than three, of which no variance follows.

    Examples
    --------
    >>> print(round(step_spread(differences=[0.002, -0.001, 0.001, 0.0]), 9))
    0.001732051

    References
    ----------
    Derived, after JCGM 100:2008 (GUM), G.3, for the t-distribution.
    """
    d = np.asarray(differences, dtype=float)
    k = d.size
    return float(np.sqrt((d @ d) / (k - 2))) if k > 2 else math.nan


def local_angle_deviation(*, theta_s: Number, p: Number, s_r: Number, s_g: Number) -> Number:
    """Standard deviation of the slope from one nosing to the next.

    ``hypot(s_r cos(theta_s), s_g sin(theta_s)) / p``

    The chord of one step turns by the part of a deviation that is square to it, over its length.
    A chord over k steps turns by 1/sqrt(k) of it, so one step is the worst.

    Assumptions: deviations are small against p; rises and goings deviate independently.

    Parameters
    ----------
    s_r, s_g : float or array
        Standard deviation of single rises and goings [m].

    Returns
    -------
    float or array
        [rad]

    Examples
    --------
    >>> print(round(local_angle_deviation(theta_s=0.0, p=0.3, s_r=0.003, s_g=0.1), 12))
    0.01

    References
    ----------
    Derived.
    """
    return np.hypot(s_r * np.cos(theta_s), s_g * np.sin(theta_s)) / p


def combined_uncertainty(
    formula: Callable[..., float], at: Mapping[str, float], u: Mapping[str, float]
) -> float:
    """Standard uncertainty of a result from those of its independent inputs.

    ``u_c^2 = sum_i (df/dx_i u_i)^2``

    Each derivative is the difference over plus and minus half of its own uncertainty, so a step
    is never larger than what it stands for.

    Assumptions: independent inputs; the formula is nearly straight over one uncertainty.

    Parameters
    ----------
    formula : callable
        Result of the inputs by name.
    at : mapping of str to float
        Inputs, in their units.
    u : mapping of str to float
        Standard uncertainty of some of them; the others are exact.

    Returns
    -------
    float
        In the unit of the result.

    Examples
    --------
    >>> print(round(combined_uncertainty(lambda x, y: x + 2 * y, dict(x=1, y=1),
    ...                                  dict(x=3.0, y=2.0)), 9))
    5.0

    References
    ----------
    JCGM 100:2008 (GUM), Eq. (10).
    """
    total = 0.0
    for name, spread in u.items():
        ahead = formula(**{**at, name: at[name] + 0.5 * spread})
        behind = formula(**{**at, name: at[name] - 0.5 * spread})
        total += (ahead - behind) ** 2
    return math.sqrt(total)
