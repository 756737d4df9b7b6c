"""Stable band of acceleration: Eqs. (17), (18) of Endo & Nagatani 2016, and with slip down."""

import numpy as np

from kaidan.mechanics import Number


def a_max(*, a_S: Number, min_a_r0: Number) -> Number:
    """Upper end of the paper's stable band of acceleration.

    ``a_max = min(a_S, min(a_r0))``

    Parameters
    ----------
    a_S, min_a_r0 : float or array
        Slip limit and smallest downhill tip limit [m/s^2].

    Returns
    -------
    float or array
        a_max [m/s^2]; the stable band lies strictly below. An unknown (NaN) a_S is left out.

    Examples
    --------
    >>> print(a_max(a_S=2.0, min_a_r0=3.0))
    2.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (17).
    """
    return np.fmin(a_S, min_a_r0)


def a_min(*, max_a_rn: Number) -> Number:
    """Lower end of the paper's stable band of acceleration.

    ``a_min = max(a_rn)``

    Parameters
    ----------
    max_a_rn : float or array
        Largest uphill tip limit [m/s^2].

    Returns
    -------
    float or array
        a_min [m/s^2]; the stable band lies strictly above.

    Examples
    --------
    >>> print(a_min(max_a_rn=-3.0))
    -3.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eq. (18).

    Errata: the band forgets that the tracks can also slip down; `a_min_with_slip` does not.
    """
    return max_a_rn


def a_min_with_slip(*, a_slides_up: Number, max_a_rn: Number) -> Number:
    """Lower end of the stable band of acceleration with downhill slip in it.

    ``max(max(a_rn), a_slides_up)``

    Parameters
    ----------
    a_slides_up, max_a_rn : float or array
        Downhill slip limit and largest uphill tip limit [m/s^2].

    Returns
    -------
    float or array
        Lower end [m/s^2]. An unknown (NaN) a_slides_up is left out.

    Examples
    --------
    >>> print(a_min_with_slip(a_slides_up=-8.0, max_a_rn=-9.0))
    -8.0

    References
    ----------
    Derived: Eq. (18) of Endo & Nagatani 2016 (doi:10.1186/s40648-016-0058-y) with the slip bound
    it lacks.
    """
    return np.fmax(a_slides_up, max_a_rn)
