"""Approach with a yaw: the robot heads off the line of steepest ascent by an angle psi.

The underside lies on the plane through the nosings, so the slope keeps its angle theta_s; what
changes is how the weight splits within that plane. The two tracks meet a nosing one after the
other, and between these two moments the robot stands on a support that is not a rectangle: the
planar limits of the other modules, used with the spacing and the slope given here, are those of
one track alone. They say nothing about tipping over a diagonal.
"""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.validity import validity


def oblique_spacing(*, p: Number, psi: Number) -> Number:
    """Nosing spacing along the track.

    ``p / cos(psi)``

    Returns
    -------
    float or array
        Spacing [m]; NaN for |psi| >= pi/2, where the track meets no next nosing.

    Examples
    --------
    >>> print(round(oblique_spacing(p=0.1, psi=np.pi / 3), 12))
    0.2

    References
    ----------
    Derived: distance of two parallel lines along a line that crosses them.
    """
    return validity(holds=np.abs(psi) < np.pi / 2.0) * p / np.cos(psi)


def equivalent_slope_along(
    *, theta_s: Number, psi: Number, a: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Tangent of the slope that tips the robot alike over its ends when it heads straight up.

    ``tan(theta_eff) = tan(theta_s) cos(psi) + a / (g cos(theta_s))``

    The load along the track over the load normal to it. Not the inclination of the body, whose
    sine is sin(theta_s) cos(psi).

    Parameters
    ----------
    theta_s : float or array
        Slope of the line through the nosings [rad], within (-pi/2, pi/2).
    a : float or array
        Acceleration along the heading [m/s^2].

    Returns
    -------
    float or array
        Tangent of the equivalent slope [1].

    Examples
    --------
    >>> print(round(equivalent_slope_along(theta_s=np.pi / 4, psi=np.pi / 3, a=0.0), 12))
    0.5

    References
    ----------
    Derived; for psi = 0 `kaidan.mechanics.slipping.equivalent_slope`.
    """
    return np.tan(theta_s) * np.cos(psi) + a / (g * np.cos(theta_s))


def equivalent_slope_across(*, theta_s: Number, psi: Number) -> Number:
    """Tangent of the slope that tips the robot alike over its side.

    ``tan(theta_s) sin(psi)``

    The load across the robot over the load normal to the underside; also the tangent of the
    body's roll, see `roll`.

    Parameters
    ----------
    theta_s : float or array
        Slope of the line through the nosings [rad], within (-pi/2, pi/2).

    Returns
    -------
    float or array
        Tangent of the equivalent slope across [1], positive when the load leans to the left.

    Examples
    --------
    >>> print(round(equivalent_slope_across(theta_s=np.pi / 4, psi=np.pi / 6), 12))
    0.5

    References
    ----------
    Derived.
    """
    return np.tan(theta_s) * np.sin(psi)


def oblique_friction(
    *, theta_s: Number, psi: Number, a: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Static friction below which the robot slips in any direction.

    ``sqrt(tan(theta_eff)^2 + (tan(theta_s) sin(psi))^2)``, at a = 0 just ``|tan(theta_s)|``

    A yaw takes load off the direction of the track and puts it across: at constant speed the
    friction required stays the same.

    Assumptions: the same Coulomb friction along and across the track.

    Parameters
    ----------
    theta_s : float or array
        Slope of the line through the nosings [rad], within (-pi/2, pi/2).
    a : float or array
        Acceleration along the heading [m/s^2].

    Returns
    -------
    float or array
        Required friction [1].

    Examples
    --------
    >>> print(round(oblique_friction(theta_s=np.pi / 4, psi=1.0, a=0.0), 12))
    1.0

    References
    ----------
    Derived; for psi = 0 `kaidan.mechanics.slipping.required_friction`.
    """
    along = equivalent_slope_along(theta_s=theta_s, psi=psi, a=a, g=g)
    return np.hypot(along, equivalent_slope_across(theta_s=theta_s, psi=psi))


def track_lag(*, gauge: Number, psi: Number) -> Number:
    """Distance by which one track meets a nosing after the other.

    ``gauge tan(psi)``

    Parameters
    ----------
    gauge : float or array
        Distance between the middles of the two tracks [m].

    Returns
    -------
    float or array
        Lag of the left track behind the right [m], along the track; NaN for |psi| >= pi/2.

    Examples
    --------
    >>> print(round(track_lag(gauge=0.3, psi=np.pi / 4), 12))
    0.3

    References
    ----------
    Derived: heading to the left, the right track is nearer to the next nosing.
    """
    return validity(holds=np.abs(psi) < np.pi / 2.0) * gauge * np.tan(psi)


def body_inclination(*, theta_s: Number, psi: Number) -> Number:
    """Inclination of the body, its heading over the horizontal.

    ``sin(phi) = sin(theta_s) cos(psi)``

    Returns
    -------
    float or array
        phi [rad], nose up positive.

    Examples
    --------
    >>> print(round(body_inclination(theta_s=np.pi / 2, psi=np.pi / 3) * 180 / np.pi, 9))
    30.0

    References
    ----------
    Derived: height gained per length driven.
    """
    return np.arcsin(np.sin(theta_s) * np.cos(psi))
