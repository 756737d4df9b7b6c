"""The margin theta_s_sup(p) and its corrections: Eqs. (19)-(24) of Endo & Nagatani 2016."""

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.triangle import alpha, beta, d_C, theta_alpha_arccos


def theta_s_sup_arccos(*, L: Number, p: Number, n: Number, C_L: Number, C_N: Number) -> Number:
    """Steepest slope at constant speed, written as the paper does.

    ``theta_s_sup = pi/2 - theta_alpha_C``, theta_alpha_C from Eqs. (20)-(23).

    Parameters
    ----------
    n : int or array
        floor(L / p) [1], at least 2.
    C_L, C_N : float or array
        Centroid behind the front tip and above the underside [m].

    Returns
    -------
    float or array
        Slope [rad]; NaN or infinite for n < 2.

    Examples
    --------
    >>> sup = theta_s_sup_arccos(L=0.470, p=0.150, n=3, C_L=0.196, C_N=0.071)
    >>> print(round(sup * 180 / np.pi, 3))
    60.205

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (19)-(23).
    """
    d = d_C(L=L, n=n, p=p)
    alpha_C = alpha(d=d, k=n - 1, p=p, C_L=C_L, C_N=C_N)
    beta_C = beta(d=d, C_L=C_L, C_N=C_N)
    return np.pi / 2 - theta_alpha_arccos(alpha=alpha_C, beta=beta_C, k=n - 1, p=p)


def slope_limit(*, grip: Number, a: Number, g: Number = STANDARD_GRAVITY) -> Number:
    """Slope at which the equivalent slope reaches a given tangent.

    ``tan(theta) + a / (g cos(theta)) = grip`` solved for theta:
    ``theta = atan2(grip q - A, q + grip A)``, ``A = a / g``, ``q = sqrt(1 + grip^2 - A^2)``

    One formula for all four limits: grip is (L - p - C_L)/C_N for tipping downhill,
    (p - C_L)/C_N for tipping uphill, +mu_s and -mu_s for slipping.

    Parameters
    ----------
    grip : float or array
        Tangent of the equivalent slope at the limit [1].

    Returns
    -------
    float or array
        Slope [rad]; NaN where no slope satisfies the equation, |a| > g sqrt(1 + grip^2).

    Examples
    --------
    >>> print(round(slope_limit(grip=1.0, a=0.0) * 180 / np.pi, 9))
    45.0
    >>> print(round(slope_limit(grip=1.0, a=10.0, g=10.0) * 180 / np.pi, 9))
    0.0

    References
    ----------
    Derived from Eq. (7) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y. The same root as
    arccos(A / sqrt(1 + grip^2)) - atan2(1, grip), without the digits arccos loses.
    """
    A = a / g
    q = np.sqrt(1.0 + grip * grip - A * A)
    return np.arctan2(grip * q - A, q + grip * A)


def theta_s_sup(
    *,
    L: Number,
    p: Number,
    C_L: Number,
    C_N: Number,
    a: Number = 0.0,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Steepest slope on which the robot does not tip over its downhill end.

    ``theta_s_sup = atan((L - p - C_L) / C_N)`` at a = 0, independent of n;
    ``arccos(C_N a / (g hypot(x, C_N))) - atan2(C_N, x)``, x = L - p - C_L, with acceleration.

    Assumptions: regular nosings, p <= L / 2, rigid smooth track.

    Returns
    -------
    float or array
        Slope [rad]; negative when even level nosings do not hold it; NaN where no slope does,
        C_N |a| > g hypot(x, C_N). Not checked for p <= L / 2.

    Examples
    --------
    >>> print(round(theta_s_sup(L=0.470, p=0.150, C_L=0.196, C_N=0.071) * 180 / np.pi, 3))
    60.205

    References
    ----------
    Derived from Eqs. (7)-(10), (19)-(23) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return slope_limit(grip=(L - p - C_L) / C_N, a=a, g=g)


def theta_s_inf(
    *, p: Number, C_L: Number, C_N: Number, a: Number = 0.0, g: Number = STANDARD_GRAVITY
) -> Number:
    """Gentlest slope on which the robot does not tip over its uphill end between two nosings.

    ``theta_s_inf = atan((p - C_L) / C_N)`` at a = 0; of interest where positive (p > C_L).

    Assumptions: regular nosings, p <= L / 2.

    Returns
    -------
    float or array
        Slope [rad]; negative where no real stair is too gentle; NaN where no slope is a limit.

    Examples
    --------
    >>> print(round(theta_s_inf(p=0.220, C_L=0.196, C_N=0.071) * 180 / np.pi, 1))
    18.7

    References
    ----------
    Derived from Eqs. (12), (13) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return slope_limit(grip=(p - C_L) / C_N, a=a, g=g)


def theta_s_sup_corrected(*, theta_s_sup: Number, theta_d: Number, theta_M: Number) -> Number:
    """Margin less the deformation of the track and the moment of the grousers.

    ``theta_s_sup - theta_d - theta_M``

    Parameters
    ----------
    theta_s_sup : float or array
        Margin of the rigid smooth track [rad].
    theta_d : float or array
        Extra inclination from the deformation of the track [rad].
    theta_M : float or array
        Loss from the moment of the grousers at the lowest contact [rad]; 0 when descending.

    Returns
    -------
    float or array
        Corrected margin [rad].

    Examples
    --------
    >>> print(round(theta_s_sup_corrected(theta_s_sup=60.2, theta_d=2.6, theta_M=1.2), 9))
    56.4

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (24).

    Errata: Eq. (24) writes theta_x_alpha for theta_alpha_C; the section on deformation first
    calls the growth of inclination theta_M, then theta_d.
    """
    return theta_s_sup - theta_d - theta_M


def semi_stable_limit(*, L: Number, p: Number, C_L: Number, C_N: Number) -> Number:
    """Steepest slope on which an acceleration that follows the position can hold the robot.

    ``atan((L - p/2 - C_L) / C_N)``

    Over one nosing spacing the lowest contact moves evenly from L - p to L behind the uphill
    tip, so the mean of a_r0 is its value at L - p/2; a speed that repeats from nosing to nosing
    needs a mean acceleration of zero. Unlimited friction and drive: a bound, not a promise.

    Returns
    -------
    float or array
        Slope [rad] above which area E (semi-unstable) cannot be used for a whole flight.

    Examples
    --------
    >>> print(round(semi_stable_limit(L=0.5, p=0.2, C_L=0.3, C_N=0.1) * 180 / np.pi, 9))
    45.0

    References
    ----------
    Derived from the description of area E in Endo & Nagatani 2016,
    doi:10.1186/s40648-016-0058-y.
    """
    return np.arctan2(L - p / 2 - C_L, C_N)


def centroid_margin_downhill(
    *,
    L: Number,
    p: Number,
    C_L: Number,
    C_N: Number,
    theta_s: Number,
    a: Number = 0.0,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Distance by which the centroid may move downhill before the robot can tip.

    ``L - p - C_L - C_N (tan(theta_s) + a / (g cos(theta_s)))``

    Returns
    -------
    float or array
        Margin along the track [m], positive when safe.

    Examples
    --------
    >>> theta = np.pi / 4
    >>> print(round(centroid_margin_downhill(L=0.5, p=0.1, C_L=0.2, C_N=0.1, theta_s=theta), 12))
    0.1

    References
    ----------
    Derived from Eq. (7) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return L - p - C_L - C_N * (np.tan(theta_s) + a / (g * np.cos(theta_s)))


def centroid_margin_uphill(
    *,
    p: Number,
    C_L: Number,
    C_N: Number,
    theta_s: Number,
    a: Number = 0.0,
    g: Number = STANDARD_GRAVITY,
) -> Number:
    """Distance by which the centroid may move uphill before the robot can tip.

    ``C_L - p + C_N (tan(theta_s) + a / (g cos(theta_s)))``

    Returns
    -------
    float or array
        Margin along the track [m], positive when safe.

    Examples
    --------
    >>> print(round(centroid_margin_uphill(p=0.1, C_L=0.2, C_N=0.1, theta_s=0.0), 12))
    0.1

    References
    ----------
    Derived from Eq. (12) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return C_L - p + C_N * (np.tan(theta_s) + a / (g * np.cos(theta_s)))


def margin_per_centroid_length(*, L: Number, p: Number, C_L: Number, C_N: Number) -> Number:
    """Change of theta_s_sup per metre of centroid along the track, or of nosing spacing.

    ``d theta_s_sup / d C_L = d theta_s_sup / d p = -C_N / (x^2 + C_N^2)``, x = L - p - C_L

    Returns
    -------
    float or array
        Sensitivity at a = 0 [rad/m].

    Examples
    --------
    >>> print(round(margin_per_centroid_length(L=0.5, p=0.1, C_L=0.4, C_N=0.1), 9))
    -10.0

    References
    ----------
    Derived from Eqs. (19)-(23) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    x = L - p - C_L
    return -C_N / (x * x + C_N * C_N)
