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

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.loads import zero_moment_point
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


def riser_start_friction(*, l_c: Number, C_L: Number, R: Number) -> Number:
    """Static friction needed to lift the nose off the floor against a riser.

    ``mu = [-R + sqrt(R^2 + 4 l_c (C_L + R))] / (2 (C_L + R))``

    At the start all floor load is on the rear tip of the flat, N_r; the floor pushes with
    mu N_r, the riser answers with that on the nose at height R and rubs upward with mu^2 N_r.
    Moments about the rear tip: ``mu^2 (L + R) + mu R = l_c (1 + mu^2)``.

    Assumptions: vertical riser higher than R; no flippers; both contacts slip at once (any other
    split lifts less while mu < 1 + L/R); the robot is still level.

    Parameters
    ----------
    l_c, C_L : float or array
        Centroid from the rear and from the front tip of the flat, along the track [m].
    R : float or array
        Radius of the track's front end [m].

    Returns
    -------
    float or array
        Friction [1], the same at floor and riser.

    Examples
    --------
    l_c = 0.3, C_L = 0.2, R = 0.1: 0.3 mu^2 + 0.1 mu - 0.3 = 0.

    >>> mu = riser_start_friction(l_c=0.3, C_L=0.2, R=0.1)
    >>> print(round(0.3 * mu**2 + 0.1 * mu, 12))
    0.3

    References
    ----------
    Derived.
    """
    reach = C_L + R
    return (np.sqrt(R**2 + 4.0 * l_c * reach) - R) / (2.0 * reach)


def crest_progress(
    *, C_L: Number, C_N: Number, theta_s: Number, a: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """How far the top edge is behind the uphill tip when the robot rotates about it to land.

    ``C_L + C_N (tan(theta_s) + a / (g cos(theta_s)))``

    The zero moment point reaches the last edge: from there on the downhill contacts are free.

    Assumptions: nothing ahead of the top edge holds the nose.

    Parameters
    ----------
    C_L, C_N : float or array
        Centroid behind the uphill tip and above the underside [m].
    theta_s : float or array
        Slope of the line through the nosings [rad].
    a : float or array
        Acceleration up the stairs [m/s^2].
    g : float
        Gravity [m/s^2].

    Returns
    -------
    float or array
        Distance [m]. More than the flat length means that the robot falls back before.

    Examples
    --------
    >>> print(round(crest_progress(C_L=0.2, C_N=0.1, theta_s=np.pi / 4, a=0.0), 12))
    0.3

    References
    ----------
    Derived, see `kaidan.mechanics.loads.zero_moment_point`.
    """
    return zero_moment_point(C_L=C_L, C_N=C_N, theta_s=theta_s, a=a, g=g)


def crest_energy(
    *, M: Number, C_N: Number, theta_s: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Energy that the drop of the nose onto the upper floor releases.

    ``M g C_N (1 / cos(theta_s) - 1)``

    Balanced, the centroid stands C_N / cos(theta_s) above the edge; landed, C_N.

    Assumptions: the robot turns about the edge without slipping and ends level; slow before.

    Parameters
    ----------
    M : float or array
        Mass of the robot [kg].
    C_N : float or array
        Centroid above the underside [m].
    theta_s : float or array
        Slope of the line through the nosings [rad].
    g : float
        Gravity [m/s^2].

    Returns
    -------
    float or array
        Energy [J].

    Examples
    --------
    >>> print(round(crest_energy(M=10.0, C_N=0.1, theta_s=np.pi / 3, g=10.0), 12))
    10.0

    References
    ----------
    Derived.
    """
    return M * g * C_N * (1.0 / np.cos(theta_s) - 1.0)


def entry_progress(*, C_L: Number, C_N: Number, a: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """How far the top edge is behind the leading tip when the robot turns down over it.

    ``C_L - C_N a / g``

    Assumptions: level upper floor.

    Parameters
    ----------
    C_L : float or array
        Centroid behind the tip that leads [m]: write L - C_L when the tail leads.
    C_N : float or array
        Centroid above the underside [m].
    a : float or array
        Acceleration away from the stairs [m/s^2]: braking is positive, as it is on the stairs.
    g : float
        Gravity [m/s^2].

    Returns
    -------
    float or array
        Distance [m].

    Examples
    --------
    >>> print(round(entry_progress(C_L=0.2, C_N=0.1, a=5.0, g=10.0), 12))
    0.15

    References
    ----------
    Derived: zero moment point on the level.
    """
    return C_L - C_N * a / g


def entry_energy(
    *, M: Number, C_N: Number, theta_s: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Energy that the drop of the leading end onto the stairs releases.

    ``M g C_N (1 - cos(theta_s))``

    Balanced over the edge, the centroid stands C_N above it; landed on the nosings,
    C_N cos(theta_s).

    Assumptions: the pivot starts slowly, a = 0; the robot turns about the edge without slipping
    until its underside lies on the line of the nosings.

    Parameters
    ----------
    M : float or array
        Mass of the robot [kg].
    C_N : float or array
        Centroid above the underside [m].
    theta_s : float or array
        Slope of the line through the nosings [rad].
    g : float
        Gravity [m/s^2].

    Returns
    -------
    float or array
        Energy [J].

    Examples
    --------
    >>> print(round(entry_energy(M=10.0, C_N=0.1, theta_s=np.pi / 3, g=10.0), 12))
    5.0

    References
    ----------
    Derived.
    """
    return M * g * C_N * (1.0 - np.cos(theta_s))


def entry_arrest_margin(*, C_L: Number, p: Number) -> Number:
    """Length of flat beyond the next nosing when the robot has come down over the top edge.

    ``C_L - p``

    Assumptions: the pivot starts at a = 0, C_L behind the leading tip; the next nosing lies p
    further down the line.

    Parameters
    ----------
    C_L : float or array
        Centroid behind the tip that leads [m]: write L - C_L when the tail leads.
    p : float or array
        Nosing spacing [m].

    Returns
    -------
    float or array
        Margin [m]; negative when the flat ends short of the next nosing and the leading end
        drops further than the slope.

    Examples
    --------
    >>> print(round(entry_arrest_margin(C_L=0.196, p=0.15), 12))
    0.046

    References
    ----------
    Derived.
    """
    return C_L - p
