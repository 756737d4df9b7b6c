"""The stability measures that others use, in the plane of the stairs.

::

                    C            theta_alpha at t_0, theta_beta at t_n, both against the track
                  . | .
         alpha  .   |   .  beta  positions x behind the uphill tip of the flat, downhill positive:
              .     |     .      t_n at x_n, t_0 at x_0, the centroid over C_L
      t_0 ---o------+------o--- t_n
             x_0   C_L     x_n

All are positive when safe. They keep their published names and definitions, so they do not agree
with each other except on the sign. The texts of Hirose, Tsukagoshi & Yoneda and of Papadopoulos &
Rey were not at hand: their measures are written from their definitions, without equation numbers.
"""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number


def static_margin_downhill(*, x_0: Number, C_L: Number, C_N: Number, theta_s: Number) -> Number:
    """Static stability margin on the downhill side.

    ``(x_0 - C_L) cos(theta_s) - C_N sin(theta_s)``

    The horizontal distance from the lowest contact to the plumb line of the centroid.

    Assumptions: at rest or at constant speed.

    Parameters
    ----------
    x_0 : float or array
        Lowest contact behind the uphill tip [m].

    Returns
    -------
    float or array
        Margin [m], horizontal, positive when safe.

    Examples
    --------
    >>> margin = static_margin_downhill(x_0=0.5, C_L=0.2, C_N=0.1, theta_s=np.arctan(0.75))
    >>> print(round(margin, 12))
    0.18

    References
    ----------
    McGhee & Frank 1968, doi:10.1016/0025-5564(68)90090-4, define the static stability margin;
    written out for the plane of the stairs.
    """
    return (x_0 - C_L) * np.cos(theta_s) - C_N * np.sin(theta_s)


def static_margin_uphill(*, x_n: Number, C_L: Number, C_N: Number, theta_s: Number) -> Number:
    """Static stability margin on the uphill side.

    ``(C_L - x_n) cos(theta_s) + C_N sin(theta_s)``

    Parameters
    ----------
    x_n : float or array
        Highest contact behind the uphill tip [m].

    Returns
    -------
    float or array
        Margin [m], horizontal, positive when safe.

    Examples
    --------
    >>> margin = static_margin_uphill(x_n=0.1, C_L=0.2, C_N=0.1, theta_s=np.arctan(0.75))
    >>> print(round(margin, 12))
    0.14

    References
    ----------
    McGhee & Frank 1968, doi:10.1016/0025-5564(68)90090-4, see `static_margin_downhill`.
    """
    return (C_L - x_n) * np.cos(theta_s) + C_N * np.sin(theta_s)


def zero_moment_margin(*, x_z: Number, x_0: Number, x_n: Number) -> Number:
    """Distance of the zero moment point to the nearer end of the support.

    ``min(x_0 - x_z, x_z - x_n)``

    Parameters
    ----------
    x_z : float or array
        Zero moment point behind the uphill tip [m], see
        `kaidan.mechanics.loads.zero_moment_point`.
    x_0, x_n : float or array
        Lowest and highest contact behind the uphill tip [m].

    Returns
    -------
    float or array
        Margin [m], along the track, positive when safe.

    Examples
    --------
    >>> print(round(zero_moment_margin(x_z=0.3, x_0=0.4, x_n=0.1), 12))
    0.1

    References
    ----------
    Vukobratovic & Borovac 2004, doi:10.1142/S0219843604000083, for the zero moment point and
    the support it must stay in.
    """
    return np.minimum(x_0 - x_z, x_z - x_n)


def energy_margin_backward(*, alpha: Number, theta_alpha: Number, theta_s: Number) -> Number:
    """Normalised energy stability margin about the lowest contact.

    ``S_back = alpha [1 - sin(theta_s + theta_alpha)]``, negative beyond the upright

    How far the centroid must rise before the robot goes over its downhill end; once it is past
    the highest point, minus how far it has come down again. Written as
    ``2 alpha sin(w) |sin(w)|`` with ``w = pi/4 - (theta_s + theta_alpha)/2``, which is the same
    and keeps its digits where the margin is small.

    Assumptions: at rest or at constant speed; the robot turns without slipping.

    Parameters
    ----------
    alpha : float or array
        Distance t_0 to centroid [m], see `kaidan.mechanics.triangle.alpha`.
    theta_alpha : float or array
        Angle t_n t_0 C [rad], see `kaidan.mechanics.triangle.theta_alpha`.

    Returns
    -------
    float or array
        Margin [m], a height: energy over weight.

    Examples
    --------
    >>> print(round(energy_margin_backward(alpha=2.0, theta_alpha=np.pi / 6, theta_s=0.0), 12))
    1.0

    References
    ----------
    Hirose, Tsukagoshi & Yoneda 1998, "Normalized energy stability margin", CLAWAR, pp. 71-76 (no
    DOI); cited as [14] by Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y. The sign beyond
    the upright is ours; the published margin is not defined there.
    """
    w = np.pi / 4.0 - (theta_s + theta_alpha) / 2.0
    return 2.0 * alpha * np.sin(w) * np.abs(np.sin(w))


def energy_margin_forward(*, beta: Number, theta_beta: Number, theta_s: Number) -> Number:
    """Normalised energy stability margin about the highest contact.

    ``S_fwd = beta [1 - sin(theta_beta - theta_s)]``, negative beyond the upright

    Assumptions: at rest or at constant speed; the robot turns without slipping.

    Parameters
    ----------
    beta : float or array
        Distance t_n to centroid [m], see `kaidan.mechanics.triangle.beta`.
    theta_beta : float or array
        Angle t_0 t_n C [rad], see `kaidan.mechanics.triangle.theta_beta`.

    Returns
    -------
    float or array
        Margin [m], a height: energy over weight.

    Examples
    --------
    >>> print(round(energy_margin_forward(beta=2.0, theta_beta=np.pi / 3, theta_s=np.pi / 6), 12))
    1.0

    References
    ----------
    Hirose, Tsukagoshi & Yoneda 1998, see `energy_margin_backward`.
    """
    w = np.pi / 4.0 - (theta_beta - theta_s) / 2.0
    return 2.0 * beta * np.sin(w) * np.abs(np.sin(w))


def energy_margin(*, backward: Number, forward: Number) -> Number:
    """Normalised energy stability margin: the smaller of the two sides.

    ``S_NE = min(S_back, S_fwd)``

    Parameters
    ----------
    backward, forward : float or array
        Margins about the lowest and about the highest contact [m].

    Returns
    -------
    float or array
        Margin [m], a height: energy over weight.

    Examples
    --------
    >>> print(energy_margin(backward=0.01, forward=0.05))
    0.01

    References
    ----------
    Hirose, Tsukagoshi & Yoneda 1998, see `energy_margin_backward`.
    """
    return np.minimum(backward, forward)


def force_angle_measure(
    *,
    x_0: Number,
    x_n: Number,
    C_L: Number,
    C_N: Number,
    theta_s: Number,
    a: Number,
    M: Number,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Force-angle measure of tip-over stability, in the plane.

    ``min_i theta_i d_i |f|``, i over the lowest and the highest contact

    f is the resultant of weight and inertia at the centroid, theta_i the angle from it to the
    line from the centroid to contact i (negative when f points outside), d_i the distance of
    contact i from the line of f. With phi = atan2(g sin(theta_s) + a, g cos(theta_s)) the angle
    of f downhill of the normal::

        theta_0 = atan2(x_0 - C_L, C_N) - phi      theta_n = atan2(C_L - x_n, C_N) + phi
        d_i = l_i |sin(theta_i)|                   l_i = hypot(x_i - C_L, C_N)

    Assumptions: the robot does not turn, and nothing but the stairs touches it.

    Parameters
    ----------
    x_0, x_n : float or array
        Lowest and highest contact behind the uphill tip [m].

    Returns
    -------
    float or array
        Measure [rad N m], positive when safe.

    Examples
    --------
    Level, both contacts at 45 degrees and 0.1 m beside the plumb line, weight 100 N:

    >>> pose = dict(x_0=0.3, x_n=0.1, C_L=0.2, C_N=0.1, theta_s=0.0, a=0.0)
    >>> print(round(force_angle_measure(**pose, M=10.0, g=10.0) / np.pi, 12))
    2.5

    References
    ----------
    Papadopoulos & Rey 1996, doi:10.1109/ROBOT.1996.509185, and 2000, Vehicle System Dynamics
    33(1), 29-48; in the form with d_i.
    """
    along = g * np.sin(theta_s) + a
    across = g * np.cos(theta_s)
    phi = np.arctan2(along, across)
    theta_0 = np.arctan2(x_0 - C_L, C_N) - phi
    theta_n = np.arctan2(C_L - x_n, C_N) + phi
    d_0 = np.hypot(x_0 - C_L, C_N) * np.abs(np.sin(theta_0))
    d_n = np.hypot(C_L - x_n, C_N) * np.abs(np.sin(theta_n))
    return np.minimum(theta_0 * d_0, theta_n * d_n) * M * np.hypot(along, across)


def kinetic_energy_height(*, v: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """Height to which the energy of the motion could lift the robot.

    ``v^2 / (2 g)``

    All of it can be used up by a sudden stop only if all of it goes into a rotation: see
    `sudden_stop_height`.

    Parameters
    ----------
    v : float or array
        Speed [m/s].

    Returns
    -------
    float or array
        Height [m].

    Examples
    --------
    >>> print(kinetic_energy_height(v=2.0, g=10.0))
    0.2

    References
    ----------
    Hand: M v^2 / 2 = M g h.
    """
    return v**2 / (2.0 * g)


def sudden_stop_height(
    *, v: Number, lever: Number, gyration: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Rise of the centroid that a sudden stop or start of the belts can bring about.

    ``v^2 / (2 g) * lever^2 / (gyration^2 + lever^2)``

    ::

              C  --> v     the belt pulls at the contact, lever below the centroid: what remains
              |            of the motion is a rotation about the contact with the angular momentum
        lever |            M v lever, and a part of the energy is lost as the contact takes it up
        ------o------ belt

    A bound for any history of speeds between rest and v, about either outermost contact, and for a
    rotation that comes back from the other one.

    Assumptions: contacts that close do not bounce, and the speed changes once while the robot
    rotates.

    Parameters
    ----------
    v : float or array
        Speed of the belts [m/s].
    lever : float or array
        Centroid above the line of the belt at the contact [m].
    gyration : float or array
        Radius of gyration about the centroid [m].

    Returns
    -------
    float or array
        Height [m], less than `kinetic_energy_height`.

    Examples
    --------
    >>> print(round(sudden_stop_height(v=2.0, lever=0.1, gyration=0.2, g=10.0), 12))
    0.04

    References
    ----------
    Derived: docs/theory/measures.md.
    """
    return kinetic_energy_height(v=v, g=g) * lever**2 / (gyration**2 + lever**2)
