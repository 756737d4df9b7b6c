"""Falling backward and forward: Eqs. (5)-(7), (11), (12), (15), (16) of Endo & Nagatani 2016.

The paper's robot looks up the stairs, so that it falls backward over its tail and forward over
its nose. The functions are named by what the limit does, tipping over the downhill or the uphill
end, and hold for a robot that looks down the stairs with ``L - C_L`` written for ``C_L``.
"""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number


def a_r0(
    *, s: Number, theta_s: Number, C_L: Number, C_N: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Acceleration a_r0 with the lowest contact ``s`` behind the uphill tip.

    ``a_r0 = g [((s - C_L) / C_N) cos(theta_s) - sin(theta_s)]``, s = d + k p.

    Parameters
    ----------
    s : float or array
        Lowest contact behind the uphill tip of the flat [m], see
        `kaidan.mechanics.plane.lowest_contact`.

    Returns
    -------
    float or array
        a_r0 [m/s^2], up the stairs positive.

    Examples
    --------
    >>> print(round(a_r0(s=0.4, theta_s=0.0, C_L=0.2, C_N=0.1, g=10.0), 9))
    20.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (15) with Eq. (8) in closed form.
    """
    return g * ((s - C_L) / C_N * np.cos(theta_s) - np.sin(theta_s))


def a_rn(
    *, d: Number, theta_s: Number, C_L: Number, C_N: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Acceleration a_rn with the highest contact ``d`` behind the uphill tip.

    ``a_rn = -g [((C_L - d) / C_N) cos(theta_s) + sin(theta_s)]``

    Parameters
    ----------
    d : float or array
        Progress: highest contact behind the uphill tip of the flat [m].

    Returns
    -------
    float or array
        a_rn [m/s^2], up the stairs positive.

    Examples
    --------
    >>> print(round(a_rn(d=0.1, theta_s=0.0, C_L=0.2, C_N=0.1, g=10.0), 9))
    -10.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (16) with Eq. (13) in closed form.
    """
    return -g * ((C_L - d) / C_N * np.cos(theta_s) + np.sin(theta_s))


def min_a_r0(
    *,
    L: Number,
    p: Number,
    theta_s: Number,
    C_L: Number,
    C_N: Number,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Minimum of a_r0 over the progress, reached just after the lowest contact has left.

    ``min a_r0 = g [((L - p - C_L) / C_N) cos(theta_s) - sin(theta_s)]``

    The new lowest contact then lies L - p behind the uphill tip, whatever n is.

    Assumptions: regular nosings, p <= L / 2 (two contacts remain).

    Returns
    -------
    float or array
        Minimum [m/s^2], attained.

    Examples
    --------
    >>> print(round(min_a_r0(L=0.5, p=0.1, theta_s=0.0, C_L=0.2, C_N=0.1, g=10.0), 9))
    20.0

    References
    ----------
    Derived from Eqs. (8)-(10), (15) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return a_r0(s=L - p, theta_s=theta_s, C_L=C_L, C_N=C_N, g=g)


def max_a_rn(
    *, p: Number, theta_s: Number, C_L: Number, C_N: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Supremum of a_rn over the progress, approached just before the next nosing is met.

    ``max a_rn = -g [((C_L - p) / C_N) cos(theta_s) + sin(theta_s)]``

    Assumptions: regular nosings, p <= L / 2.

    Returns
    -------
    float or array
        Supremum [m/s^2], approached as d -> p but not attained.

    Examples
    --------
    >>> print(round(max_a_rn(p=0.1, theta_s=0.0, C_L=0.2, C_N=0.1, g=10.0), 9))
    -10.0

    References
    ----------
    Derived from Eqs. (13), (16) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return a_rn(d=p, theta_s=theta_s, C_L=C_L, C_N=C_N, g=g)
