"""The triangle of lowest contact, highest contact and centroid: Eqs. (8)-(10), (13), (20)-(23).

::

                        C  centroid, C_N above the underside
                      . | .
             alpha  .   |   .  beta
                  .     |     .
      t_0 ------o-------+-------o------ t_n --- | front tip
                '-- d + k p - C_L --'-- C_L - d --'-- d --'

``t_n`` lies ``d`` behind the front tip and ``t_0`` lies ``k p`` behind ``t_n``, where ``k`` is n
before the lowest contact leaves and n - 1 after it.
"""

import numpy as np

from kaidan.mechanics import Number


def alpha(*, d: Number, k: Number, p: Number, C_L: Number, C_N: Number) -> Number:
    """Distance from the lowest contact t_0 to the centroid.

    ``alpha = sqrt((d + k p - C_L)^2 + C_N^2)``

    Parameters
    ----------
    d : float or array
        Progress: distance of the highest contact behind the front tip [m].
    k : int or array
        Nosing spacings between the lowest and the highest contact [1]: n before the lowest
        contact leaves, n - 1 after.
    C_L, C_N : float or array
        Centroid behind the front tip and above the underside [m].

    Returns
    -------
    float or array
        Distance [m].

    Examples
    --------
    >>> print(alpha(d=0.1, k=2, p=0.1, C_L=0.0, C_N=0.4))
    0.5

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (9) and, with k = n - 1, (21).
    """
    return np.hypot(d + k * p - C_L, C_N)


def beta(*, d: Number, C_L: Number, C_N: Number) -> Number:
    """Distance from the highest contact t_n to the centroid.

    ``beta = sqrt((C_L - d)^2 + C_N^2)``

    Parameters
    ----------
    d : float or array
        Progress: distance of the highest contact behind the front tip [m].
    C_L, C_N : float or array
        Centroid behind the front tip and above the underside [m].

    Returns
    -------
    float or array
        Distance [m].

    Examples
    --------
    >>> print(beta(d=0.1, C_L=0.4, C_N=0.4))
    0.5

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (10) and (22).
    """
    return np.hypot(C_L - d, C_N)


def theta_alpha_arccos(*, alpha: Number, beta: Number, k: Number, p: Number) -> Number:
    """Angle t_n t_0 C by the law of cosines, as the paper prints it.

    ``theta_alpha = arccos((alpha^2 + k^2 p^2 - beta^2) / (2 k alpha p))``

    Kept to show what the paper says; `theta_alpha` is the same angle without the digits that
    arccos loses when the angle is small.

    Parameters
    ----------
    alpha, beta : float or array
        Distances of the centroid from the lowest and the highest contact [m].
    k : int or array
        Nosing spacings between these two contacts [1].

    Returns
    -------
    float or array
        Angle [rad]; NaN where the three lengths make no triangle.

    Examples
    --------
    >>> print(round(theta_alpha_arccos(alpha=1.0, beta=1.0, k=1, p=1.0) * 180 / np.pi, 9))
    60.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (8) and, with k = n - 1, (20).

    Errata: Eq. (8) names the triangle loosely; it is t_0 t_n C.
    """
    return np.arccos((alpha**2 + k**2 * p**2 - beta**2) / (2 * k * alpha * p))


def theta_alpha(*, d: Number, k: Number, p: Number, C_L: Number, C_N: Number) -> Number:
    """Angle t_n t_0 C in closed form.

    ``theta_alpha = atan2(C_N, d + k p - C_L)``

    Exact where `theta_alpha_arccos` loses digits, and more than pi/2 when the centroid hangs
    behind the lowest contact.

    Parameters
    ----------
    d : float or array
        Progress: distance of the highest contact behind the front tip [m].
    k : int or array
        Nosing spacings between the lowest and the highest contact [1].
    C_L, C_N : float or array
        Centroid behind the front tip and above the underside [m].

    Returns
    -------
    float or array
        Angle [rad], in (0, pi).

    Examples
    --------
    >>> print(round(theta_alpha(d=0.1, k=2, p=0.1, C_L=0.2, C_N=0.1) * 180 / np.pi, 9))
    45.0

    References
    ----------
    Derived from Eqs. (8)-(10) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return np.arctan2(C_N, d + k * p - C_L)


def theta_beta(*, d: Number, C_L: Number, C_N: Number) -> Number:
    """Angle t_0 t_n C in closed form.

    ``theta_beta = atan2(C_N, C_L - d)``

    Parameters
    ----------
    d : float or array
        Progress: distance of the highest contact behind the front tip [m].
    C_L, C_N : float or array
        Centroid behind the front tip and above the underside [m].

    Returns
    -------
    float or array
        Angle [rad], in (0, pi); more than pi/2 once the highest contact is behind the centroid.

    Examples
    --------
    >>> print(round(theta_beta(d=0.1, C_L=0.2, C_N=0.1) * 180 / np.pi, 9))
    45.0

    References
    ----------
    Derived from Eqs. (9), (10), (13) of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return np.arctan2(C_N, C_L - d)


def d_C(*, L: Number, n: Number, p: Number) -> Number:
    """Progress at which the lowest contact reaches the rear tip (state C).

    ``d_C = L - n p``

    Parameters
    ----------
    n : int or array
        floor(L / p) [1].

    Returns
    -------
    float or array
        Progress [m].

    Examples
    --------
    >>> print(round(d_C(L=0.47, n=3, p=0.15), 12))
    0.02

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (23).
    """
    return L - n * p
