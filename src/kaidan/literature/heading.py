r"""Heading on stairs from the accelerometer, and a law that keeps it, after Martens & Newman 1994.

::

      uphill              psi   heading off the line of steepest ascent, to the left positive
    x   ^                 f_x   specific force along the track, ahead positive
     \  |                 f_y   to the left; f_z normal to the tracks: at rest they show what is up
      \ o                 theta_s   slope of the line through the nosings

On level ground gravity says nothing of the heading; on stairs its part within the plane of the
nosings points up them. `kaidan.literature.heading_loop` closes the loop.
"""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.oblique import body_inclination, roll
from kaidan.mechanics.validity import validity


def specific_force(
    *, theta_s: Number, psi: Number, a: Number = 0.0, g: Number = STANDARD_GRAVITY
) -> tuple[Number, Number, Number]:
    """Components that an accelerometer on the robot shows.

    ``f_x = g sin(theta_s) cos(psi) + a``, ``f_y = -g sin(theta_s) sin(psi)``,
    ``f_z = g cos(theta_s)``

    With the body's inclination phi and roll: f_x = g sin(phi) + a, f_y = g cos(phi) sin(roll),
    f_z = g cos(phi) cos(roll).

    Assumptions: the underside lies on the plane through the nosings; the acceleration is along the
    track.

    Parameters
    ----------
    theta_s : float or array
        Slope of the line through the nosings [rad].
    psi : float or array
        Yaw off the line of steepest ascent, to the left positive [rad].
    a : float or array
        Acceleration along the track, ahead positive [m/s^2].
    g : float
        Gravity [m/s^2].

    Returns
    -------
    tuple of float or array
        f_x, f_y, f_z [m/s^2]: ahead, to the left, normal to the tracks.

    Examples
    --------
    >>> f = specific_force(theta_s=np.pi / 6, psi=np.pi / 2, g=10.0)
    >>> print([round(float(part), 6) + 0.0 for part in f])
    [0.0, -5.0, 8.660254]

    References
    ----------
    After Martens & Newman 1994, IEEE ICRA, pp. 2501-2507, derived anew from
    `kaidan.mechanics.oblique.body_inclination` and `kaidan.mechanics.oblique.roll`.
    """
    phi, lean = body_inclination(theta_s=theta_s, psi=psi), roll(theta_s=theta_s, psi=psi)
    return (
        g * np.sin(phi) + a,
        g * np.cos(phi) * np.sin(lean),
        g * np.cos(phi) * np.cos(lean),
    )


def heading_error(*, f_x: Number, f_y: Number, a: Number = 0.0) -> Number:
    """Yaw off the line of steepest ascent, from the accelerometer.

    ``psi = atan2(-f_y, f_x - a)``

    Neither the slope nor gravity has to be known. Facing down the stairs, at psi near pi, give
    -f_x, -f_y and -a: the yaw off the line of steepest descent.

    Assumptions: those of `specific_force`. A body that is inclined by delta more than the plane of
    the nosings (between them, or by the track's give) shows tan(psi) / (cos(delta) +
    sin(delta) / (tan(theta_s) cos(psi))): as long as that is positive, the sign is right.

    Parameters
    ----------
    f_x, f_y : float or array
        Specific force ahead and to the left [m/s^2].
    a : float or array
        Acceleration along the track, as far as it is known, ahead positive [m/s^2].

    Returns
    -------
    float or array
        psi [rad], to the left positive; NaN where both components are 0, on level ground.

    Examples
    --------
    >>> print(round(heading_error(f_x=4.0, f_y=-4.0) * 180 / np.pi, 9))
    45.0

    References
    ----------
    After Martens & Newman 1994, IEEE ICRA, pp. 2501-2507, derived anew.
    """
    ahead = f_x - a
    return validity(holds=(ahead != 0.0) | (f_y != 0.0)) * np.arctan2(-f_y, ahead)


def slope_felt(*, f_x: Number, f_y: Number, f_z: Number, a: Number = 0.0) -> Number:
    """Slope of the line through the nosings, from the accelerometer.

    ``theta_s = atan2(hypot(f_x - a, f_y), f_z)``

    Parameters
    ----------
    f_x, f_y, f_z : float or array
        Specific force ahead, to the left and normal to the tracks [m/s^2].
    a : float or array
        Acceleration along the track, as far as it is known [m/s^2].

    Returns
    -------
    float or array
        theta_s [rad], whatever the heading.

    Examples
    --------
    >>> print(round(slope_felt(f_x=3.0, f_y=-4.0, f_z=5.0) * 180 / np.pi, 9))
    45.0

    References
    ----------
    Derived, see `specific_force`.
    """
    return np.arctan2(np.hypot(f_x - a, f_y), f_z)


def heading_noise(*, sigma: Number, theta_s: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """Standard deviation of the heading that noise of the accelerometer leaves.

    ``sigma_psi = sigma / (g sin(theta_s))``

    Assumptions: independent noise, alike on both axes, small against g sin(theta_s).

    Parameters
    ----------
    sigma : float or array
        Standard deviation of each component [m/s^2].
    theta_s : float or array
        Slope of the line through the nosings [rad].
    g : float
        Gravity [m/s^2].

    Returns
    -------
    float or array
        sigma_psi [rad], the same at every heading; infinite on level ground.

    Examples
    --------
    >>> print(round(heading_noise(sigma=0.1, theta_s=np.pi / 6, g=10.0), 12))
    0.02

    References
    ----------
    Derived: only the component across the heading turns the angle.
    """
    return sigma / (g * np.sin(theta_s))


def speed_difference(*, psi: Number, k: Number, gauge: Number, limit: Number) -> Number:
    """Speed by which the right track shall run ahead of the left one.

    ``v_R - v_L = -k gauge psi``, not beyond +- limit

    A robot that turns as its tracks say then obeys d psi / dt = -k psi: the error dies away with
    the time constant 1 / k, whatever the speed.

    Parameters
    ----------
    psi : float or array
        Heading error, to the left positive [rad].
    k : float or array
        Gain [1/s].
    gauge : float or array
        Distance between the middles of the tracks [m].
    limit : float or array
        Largest difference that the drive gives at its speed [m/s], see `difference_limit`.

    Returns
    -------
    float or array
        v_R - v_L [m/s].

    Examples
    --------
    >>> print(speed_difference(psi=0.1, k=2.0, gauge=0.5, limit=1.0))
    -0.1
    >>> print(speed_difference(psi=-1.0, k=2.0, gauge=0.5, limit=0.3))
    0.3

    References
    ----------
    After Martens & Newman 1994, IEEE ICRA, pp. 2501-2507; the law is ours.
    """
    return np.maximum(np.minimum(-k * gauge * psi, limit), -limit)


def difference_limit(*, v: Number, v_max: Number) -> Number:
    """Largest difference of the tracks' speeds that leaves their mean as it is.

    ``2 (v_max - |v|)``

    Parameters
    ----------
    v : float or array
        Mean speed of the tracks [m/s].
    v_max : float or array
        Largest speed of a track [m/s].

    Returns
    -------
    float or array
        Difference [m/s]; NaN where |v| > v_max.

    Examples
    --------
    >>> print(round(difference_limit(v=0.3, v_max=0.4), 12))
    0.2

    References
    ----------
    Derived: the faster track runs at |v| plus half the difference.
    """
    return validity(holds=np.abs(v) <= v_max) * 2.0 * (v_max - np.abs(v))


def losing_yaw(*, grip: Number, limit: Number, gauge: Number, divergence: Number) -> Number:
    """Heading error from which the saturated drive loses.

    ``sin(psi) = grip limit / (gauge divergence)``

    The stairs turn the robot away at divergence sin(psi), the drive back at most at
    grip limit / gauge.

    Why they turn it away: across the robot its weight pulls at the centroid, M g sin(theta_s)
    sin(psi) towards the lower side, and what friction answers in proportion to the loads has its
    resultant at the zero moment point, C_N tan(theta_eff) further back. The couple turns the nose
    further off. How fast depends on the creep of the tracks, which statics does not give: the
    divergence must be measured.

    Parameters
    ----------
    grip : float or array
        Share of the turning rate (v_R - v_L) / gauge that the robot really turns, in (0, 1] [1].
    limit : float or array
        Largest difference of the tracks' speeds [m/s].
    gauge : float or array
        Distance between the middles of the tracks [m].
    divergence : float or array
        Rate at which the stairs turn a robot away, over sin(psi) [1/s].

    Returns
    -------
    float or array
        psi [rad], to either side; NaN where the drive is the stronger at every heading.

    Examples
    --------
    >>> psi = losing_yaw(grip=0.5, limit=0.2, gauge=0.4, divergence=0.5)
    >>> print(round(psi * 180 / np.pi, 9))
    30.0

    References
    ----------
    Derived.
    """
    ratio = grip * limit / (gauge * np.maximum(divergence, 1e-100))
    return validity(holds=ratio <= 1.0) * np.arcsin(np.minimum(ratio, 1.0))
