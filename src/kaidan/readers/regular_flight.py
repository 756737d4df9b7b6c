"""The uniform flight through nosings that were found, and whether steps are alike."""

import math
from dataclasses import dataclass

import numpy as np

from kaidan.readers.kinds import Array

ALIKE = 0.01
"""Probability of a chi squared as large as this one, from which steps count as all alike [1]."""


@dataclass(frozen=True)
class RegularFlight:
    """The uniform flight that fits the nosings best."""

    rise: float
    """[m]"""
    going: float
    """[m]"""
    rise_sigma: float
    """Standard uncertainty from the nosings alone [m]."""
    going_sigma: float
    """The same of the going [m]."""
    correlation: float
    """Of both [1]."""
    chi2: float
    """Sum of squared residuals over their variances."""
    freedom: int
    """Degrees of freedom."""

    @property
    def alike(self) -> float:
        """Probability of so large a chi squared, were all steps alike [1]; NaN: too few steps."""
        return chi2_tail(self.chi2, self.freedom)

    @property
    def spacing(self) -> float:
        """Nosing spacing [m]."""
        return math.hypot(self.rise, self.going)

    @property
    def angle(self) -> float:
        """Slope of the line through the nosings [rad]."""
        return math.atan2(self.rise, self.going)

    def sigmas(self) -> tuple[float, float]:
        """Standard uncertainty of angle [rad] and spacing [m] from the nosings alone."""
        p, r, g = self.spacing, self.rise, self.going
        both = self.correlation * self.rise_sigma * self.going_sigma
        var_r, var_g = self.rise_sigma**2, self.going_sigma**2
        angle = (g * g * var_r + r * r * var_g - 2 * r * g * both) / p**4
        spacing = (r * r * var_r + g * g * var_g + 2 * r * g * both) / p**2
        return math.sqrt(max(angle, 0.0)), math.sqrt(max(spacing, 0.0))


def uniform_columns(count: int) -> Array:
    """Columns of s0, z0, going and rise in s and z of all nosings, shape (2 count, 4)."""
    number = np.arange(count, dtype=np.float64)
    return np.asarray(np.kron(np.column_stack([np.ones(count), number]), np.eye(2)))


def uniform_flight(line: Array, weights: Array, measured: Array) -> RegularFlight:
    """Uniform flight through nosings (generalised least squares).

    Where chi squared says that steps are not alike, each nosing has the variance of those about it
    too: weights of what was measured to a tenth of a millimetre would make one odd riser turn the
    line.

    line, shape (m, 2): (s, z) of two nosings or more [m].
    weights, shape (2m, 2m): inverse of their covariance about a uniform flight [m^-2].
    measured, shape (2m, 2m): covariance of what was measured of them [m^2].
    """
    design, values, freedom = uniform_columns(len(line)), line.ravel(), line.size - 4

    def fitted(weights: Array) -> tuple[Array, Array, Array]:
        found = np.asarray(np.linalg.inv(design.T @ weights @ design))
        fit = found @ design.T @ weights @ values
        return found, fit, values - design @ fit

    found, fit, off = fitted(weights)
    chi2 = float(off @ weights @ off)
    if chi2_tail(chi2, freedom) < ALIKE:
        plain = fitted(np.eye(line.size))[2]
        odd = float(plain @ plain) / freedom * np.eye(line.size)
        found, fit, _ = fitted(np.asarray(np.linalg.inv(measured + odd)))
    going, rise = float(fit[2]), float(fit[3])
    s_going, s_rise = float(np.sqrt(found[2, 2])), float(np.sqrt(found[3, 3]))
    corr = float(found[2, 3]) / (s_going * s_rise)
    return RegularFlight(rise, going, s_rise, s_going, corr, chi2, freedom)


def chi2_tail(chi2: float, freedom: int) -> float:
    """Probability that a chi squared of an even number of degrees of freedom is larger.

    exp(-x/2) times the sum of (x/2)^j / j! for j < freedom / 2 (Abramowitz & Stegun 26.4.21).

    Examples
    --------
    >>> round(chi2_tail(5.991, 2), 4), round(chi2_tail(9.488, 4), 4)
    (0.05, 0.05)
    """
    if freedom < 2:
        return math.nan
    half, term, total = chi2 / 2, 1.0, 0.0
    for j in range(freedom // 2):
        total += term
        term *= half / (j + 1)
    return math.exp(-half) * total if half < 700 else 0.0
