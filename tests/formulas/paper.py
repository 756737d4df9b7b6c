"""Equations of Endo & Nagatani 2016 (doi:10.1186/s40648-016-0058-y) that others follow from."""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY


def friction_reserve(*, traction, normal, mu_s):
    """Eq. (1): what friction carries beyond the traction [N]."""
    return mu_s * normal - traction


def moment_about_lowest(*, M, a, alpha, theta_alpha, theta_s, g=STANDARD_GRAVITY):
    """Eq. (5): moment of weight and inertia about t_0 that turns the nose up [N m]."""
    return M * a * alpha * np.sin(theta_alpha) - M * g * alpha * np.cos(theta_s + theta_alpha)


def tip_acceleration_downhill(*, theta_alpha, theta_s, g=STANDARD_GRAVITY):
    """Eqs. (6) and (7): acceleration at which that moment vanishes [m/s^2]."""
    return (np.cos(theta_s) / np.tan(theta_alpha) - np.sin(theta_s)) * g


def moment_about_highest(*, M, a, beta, theta_beta, theta_s, g=STANDARD_GRAVITY):
    """Eq. (11): moment of weight and inertia about t_n that turns the nose down [N m]."""
    return -M * a * beta * np.sin(theta_beta) - M * g * beta * np.cos(theta_beta - theta_s)


def tip_acceleration_uphill(*, theta_beta, theta_s, g=STANDARD_GRAVITY):
    """Eq. (12): acceleration at which that moment vanishes [m/s^2]."""
    return -(np.cos(theta_s) / np.tan(theta_beta) + np.sin(theta_s)) * g


def theta_beta_arccos(*, alpha, beta, k, p):
    """Eq. (13), by the law of cosines [rad]."""
    return np.arccos((beta**2 + k**2 * p**2 - alpha**2) / (2 * k * beta * p))
