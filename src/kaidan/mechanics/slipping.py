"""Slipping along the stairs: Eqs. (1)-(4) and (14) of Endo & Nagatani 2016, and its other side."""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number


def traction_sum(*, M: Number, a: Number, theta_s: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """Sum of the tractive forces along the stairs.

    ``sum f_kL = M a + M g sin(theta_s)``

    Assumptions: rigid robot in translation along the stairs, no rolling resistance.

    Parameters
    ----------
    a : float or array
        Acceleration of the robot up the stairs [m/s^2].

    Returns
    -------
    float or array
        Sum of the tractive forces, up the stairs positive [N]; broadcast shape of the inputs.

    Examples
    --------
    >>> print(round(traction_sum(M=10.0, a=1.0, theta_s=np.pi / 6, g=10.0), 12))
    60.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (2).

    Errata: the paper calls ``a`` the "lateral" acceleration; it is along the stairs.
    """
    return M * a + M * g * np.sin(theta_s)


def normal_sum(*, M: Number, theta_s: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """Sum of the normal forces of all contacts.

    ``sum f_kN = M g cos(theta_s)``

    Returns
    -------
    float or array
        Sum of the normal forces [N].

    Examples
    --------
    >>> print(round(normal_sum(M=10.0, theta_s=np.pi / 3, g=10.0), 12))
    50.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (3).
    """
    return M * g * np.cos(theta_s)


def slip_acceleration_up(*, mu_s: Number, theta_s: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """Acceleration a_S up the stairs at which the tracks begin to slip.

    ``a_S = (mu_s cos(theta_s) - sin(theta_s)) g``; safe below it.

    Returns
    -------
    float or array
        a_S [m/s^2], up the stairs positive; negative when the robot slides down at rest.

    Examples
    --------
    >>> print(round(slip_acceleration_up(mu_s=1.0, theta_s=np.pi / 4, g=10.0), 12))
    0.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (4) and (14).
    """
    return (mu_s * np.cos(theta_s) - np.sin(theta_s)) * g


def slip_acceleration_down(
    *, mu_s: Number, theta_s: Number, g: Number = STANDARD_GRAVITY
) -> Number:
    """Acceleration down the stairs (negative) beyond which the tracks slip the other way.

    ``-(mu_s cos(theta_s) + sin(theta_s)) g``; safe above it. It limits accelerating downhill and
    braking while climbing.

    Returns
    -------
    float or array
        Lower slip bound [m/s^2], up the stairs positive.

    Examples
    --------
    >>> print(round(slip_acceleration_down(mu_s=0.5, theta_s=0.0, g=10.0), 12))
    -5.0

    References
    ----------
    Derived: Eq. (1) of Endo & Nagatani 2016 (doi:10.1186/s40648-016-0058-y) with the sign of the
    traction reversed; the paper has no such bound.
    """
    return -(mu_s * np.cos(theta_s) + np.sin(theta_s)) * g


def equivalent_slope(*, theta_s: Number, a: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """Tangent of the slope that a robot at constant speed would feel the same on.

    ``tan(theta_eff) = tan(theta_s) + a / (g cos(theta_s))``

    Its modulus is also the friction that the pose needs.

    Parameters
    ----------
    theta_s : float or array
        Slope of the line through the nosings [rad], within (-pi/2, pi/2).

    Returns
    -------
    float or array
        Tangent of the equivalent inclination [1].

    Examples
    --------
    >>> print(round(equivalent_slope(theta_s=np.pi / 4, a=0.0), 12))
    1.0

    References
    ----------
    Derived: exact form of the remark in the case study of Endo & Nagatani 2016
    (doi:10.1186/s40648-016-0058-y) that acceleration acts like inclination.
    """
    return np.tan(theta_s) + a / (g * np.cos(theta_s))


def required_friction(*, theta_s: Number, a: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """Static friction below which the robot slips, either way along the stairs.

    ``mu_s > |tan(theta_s) + a / (g cos(theta_s))|``

    Returns
    -------
    float or array
        Required friction [1].

    Examples
    --------
    >>> print(round(required_friction(theta_s=np.pi / 4, a=0.0), 12))
    1.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (4) solved for mu_s; the downhill
    side derived.
    """
    return np.abs(equivalent_slope(theta_s=theta_s, a=a, g=g))
