"""What the drive must give: traction, torque, power, and the limits that follow from them.

Losses always work against the motion. Driving, they add to what the motor must give; braking,
they take part of the work off it: the efficiency changes from a divisor to a factor.
"""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.slipping import normal_sum, traction_sum
from kaidan.mechanics.validity import validity


def drive_force(
    *, M: Number, a: Number, theta_s: Number, c_rr: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Force along the stairs that the drive must bring to the tracks.

    ``F = M (g sin(theta_s) + a) + c_rr M g cos(theta_s)``

    Assumptions: rolling resistance (the track that bends, its rollers) in proportion to the
    normal load.

    Parameters
    ----------
    c_rr : float or array
        Coefficient of rolling resistance [1]: positive moving up, negative moving down.

    Returns
    -------
    float or array
        Force [N], up the stairs positive; negative where it must push down the stairs.

    Examples
    --------
    sin = 0.6, cos = 0.8: 60 N of slope, 10 N of acceleration, 8 N of rolling.

    >>> print(round(drive_force(M=10.0, a=1.0, theta_s=np.arctan(0.75), c_rr=0.1, g=10.0), 12))
    78.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (2) and (3); rolling resistance
    added.
    """
    traction = traction_sum(M=M, a=a, theta_s=theta_s, g=g)
    return traction + c_rr * normal_sum(M=M, theta_s=theta_s, g=g)


def drive_power(*, F: Number, v: Number, eta: Number) -> Number:
    """Power of both drives together, counted before the losses.

    ``P = F v / eta`` driving (F v > 0), ``P = F v eta`` braking (F v < 0)

    Parameters
    ----------
    F : float or array
        Drive force [N], up the stairs positive, see `drive_force`.
    v : float or array
        Speed [m/s], up the stairs positive.
    eta : float or array
        Efficiency from where the power is counted to the ground, in (0, 1] [1].

    Returns
    -------
    float or array
        Power [W]; negative where the drive brakes and must take it up.

    Examples
    --------
    >>> print(drive_power(F=100.0, v=0.2, eta=0.5), drive_power(F=100.0, v=-0.2, eta=0.5))
    40.0 -10.0

    References
    ----------
    Derived, see `sprocket_torque`.
    """
    P = F * v
    return np.maximum(P, 0.0) / eta + np.minimum(P, 0.0) * eta


def drive_acceleration(
    *, F: Number, M: Number, theta_s: Number, c_rr: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Largest acceleration up the stairs that a drive force allows.

    ``a = F / M - g (sin(theta_s) + c_rr cos(theta_s))``

    Parameters
    ----------
    F : float or array
        Largest drive force up the stairs [N].
    c_rr : float or array
        Coefficient of rolling resistance [1]: positive moving up, negative moving down.

    Returns
    -------
    float or array
        Acceleration [m/s^2], up the stairs positive; negative where the drive cannot hold its
        speed.

    Examples
    --------
    >>> slope = np.arctan(0.75)
    >>> print(round(drive_acceleration(F=78.0, M=10.0, theta_s=slope, c_rr=0.1, g=10.0), 12))
    1.0

    References
    ----------
    Derived: inverse of `drive_force`.
    """
    return F / M - g * (np.sin(theta_s) + c_rr * np.cos(theta_s))


def drive_slope(
    *, F: Number, M: Number, a: Number, c_rr: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Steepest slope that a drive force can climb.

    ``theta = arcsin((F / (M g) - a / g) / sqrt(1 + c_rr^2)) - arctan(c_rr)``

    Parameters
    ----------
    F : float or array
        Largest drive force up the stairs [N].
    c_rr : float or array
        Coefficient of rolling resistance [1]: positive moving up, negative moving down.

    Returns
    -------
    float or array
        Slope [rad]; NaN where no slope uses the force up exactly: it is enough for any slope, or
        for none (`drive_acceleration` tells which).

    Examples
    --------
    >>> print(round(drive_slope(F=50.0, M=10.0, a=0.0, c_rr=0.0, g=10.0) * 180 / np.pi, 9))
    30.0

    References
    ----------
    Derived: `drive_force` solved for theta_s; sin + c_rr cos is a sine of amplitude
    sqrt(1 + c_rr^2), shifted by arctan(c_rr).
    """
    s = (F / M - a) / (g * np.hypot(1.0, c_rr))
    branch = np.arcsin(np.maximum(np.minimum(s, 1.0), -1.0))
    return validity(holds=np.abs(s) <= 1.0) * branch - np.arctan(c_rr)
