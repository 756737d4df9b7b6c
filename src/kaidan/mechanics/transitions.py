"""Onto the stairs and off them: single step, riser start, top edge, entry from above.

::

                        ___ C
                    ___/   /           theta   inclination, the tail disc (radius R) on the floor
              _____/______/_           l_c     L - C_L, rear tip of the flat to the centroid
         ____/       s  |              s       rear tip of the flat to the edge, along the flat
        (_)_____________| h

Quasi-static throughout: the robot moves slowly and turns without slipping.
"""

import numpy as np

from kaidan.mechanics import Number
from kaidan.mechanics.validity import validity


def step_height(*, theta: Number, l_c: Number, C_N: Number, R: Number) -> Number:
    """Height of the edge over which the robot balances at an inclination, its tail on the floor.

    ``H(theta) = R (1 - cos(theta)) + l_c sin(theta) - C_N sin(theta) tan(theta)``

    The rear tip of the flat stands R (1 - cos) above the floor, and the plumb line of the
    centroid meets the flat l_c - C_N tan(theta) further on.

    Assumptions: the edge bears on the flat, C_N tan(theta) <= l_c.

    Parameters
    ----------
    theta : float or array
        Inclination of the body [rad], nose up positive.
    l_c : float or array
        Rear tip of the flat to the centroid, along the track [m]: L - C_L.
    C_N : float or array
        Centroid above the underside [m].
    R : float or array
        Radius of the track's rear end [m].

    Returns
    -------
    float or array
        Height [m]; NaN where the plumb line misses the flat, C_N tan(theta) > l_c.

    Examples
    --------
    sin = 0.6, cos = 0.8: 0.02 + 0.24 - 0.045.

    >>> print(round(step_height(theta=np.arctan(0.75), l_c=0.4, C_N=0.1, R=0.1), 12))
    0.215

    References
    ----------
    Derived, after Guo, Song, Bao, Zhang & Tang 2010, doi:10.5772/10493, who set the same
    question; their text was not at hand, so no equation is quoted.
    """
    tangent = np.tan(theta)
    height = R * (1.0 - np.cos(theta)) + (l_c - C_N * tangent) * np.sin(theta)
    return validity(holds=C_N * tangent <= l_c) * height


def best_inclination(*, l_c: Number, C_N: Number, R: Number) -> Number:
    """Inclination at which the robot balances over the highest edge.

    ``t^3 + (2 - R/C_N) t - l_c/C_N = 0``, t = tan(theta): with P = 2 - R/C_N, Q = l_c/C_N
    ``t = 2 sqrt(P/3) sinh(arsinh((3 Q / (2 P)) sqrt(3/P)) / 3)``

    ``dH/dtheta = 0`` divided by cos(theta). For P > 0 the left side grows with t: one root.

    Assumptions: those of `step_height`; enough friction.

    Parameters
    ----------
    l_c : float or array
        Rear tip of the flat to the centroid, along the track [m]: L - C_L.
    C_N : float or array
        Centroid above the underside [m].
    R : float or array
        Radius of the track's rear end [m].

    Returns
    -------
    float or array
        Inclination [rad]; NaN where R >= 2 C_N (another form of the root), or where the edge
        would bear on the rear end instead of the flat, which R <= C_N rules out.

    Examples
    --------
    t = 1 solves t^3 + t - 2 = 0: C_N = R, l_c = 2 R.

    >>> print(round(best_inclination(l_c=0.2, C_N=0.1, R=0.1) * 180 / np.pi, 9))
    45.0

    References
    ----------
    Derived from `step_height`; Cardano's formula in its hyperbolic form.
    """
    P = 2.0 - R / C_N
    Q = l_c / C_N
    q = np.maximum(P, 1e-100)  # keeps the powers of P finite where there is no answer
    t = 2.0 * np.sqrt(q / 3.0) * np.sinh(np.arcsinh(1.5 * Q / q * np.sqrt(3.0 / q)) / 3.0)
    return validity(holds=(P > 0.0) & (t <= Q)) * np.arctan(t)


def largest_step_height(*, l_c: Number, C_N: Number, R: Number) -> Number:
    """Highest single step over which the robot can pivot.

    ``max over theta of H(theta)``

    Assumptions: those of `step_height`; friction enough to start up the riser
    (`riser_start_friction`) and to keep the tail pushing; no flippers.

    Parameters
    ----------
    l_c : float or array
        Rear tip of the flat to the centroid, along the track [m]: L - C_L.
    C_N : float or array
        Centroid above the underside [m].
    R : float or array
        Radius of the track's rear end [m].

    Returns
    -------
    float or array
        Height [m]; NaN where `best_inclination` is.

    Examples
    --------
    At 45 degrees, see `best_inclination`: 0.1 (1 - cos) + 0.2 sin - 0.1 sin = 0.1.

    >>> print(round(largest_step_height(l_c=0.2, C_N=0.1, R=0.1), 12))
    0.1

    References
    ----------
    Derived, after Guo et al. 2010, doi:10.5772/10493, see `step_height`.
    """
    theta = best_inclination(l_c=l_c, C_N=C_N, R=R)
    return step_height(theta=theta, l_c=l_c, C_N=C_N, R=R)
