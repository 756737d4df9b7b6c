"""The d-a plane: states A-D (Fig. 3) and the five areas (Fig. 7) of Endo & Nagatani 2016."""

from enum import IntEnum

import numpy as np

from kaidan.mechanics import Number

_ROUNDING = 1.0 + 4.0 * 2.0**-52
"""Four units of rounding: a quotient of lengths so little below a whole number is that number."""


class Area(IntEnum):
    """Areas of the d-a plane, in the order in which they are assigned."""

    A = 0
    """Slipping: a does not satisfy Eq. (4)."""
    B = 1
    """Falling backward: a satisfies Eq. (4) but not Eq. (7)."""
    C = 2
    """Falling forward: a does not satisfy Eq. (12)."""
    DOWNHILL_SLIP = 3
    """Slipping down under braking or downhill acceleration: ours, not the paper's."""
    D = 4
    """Stable: a_min < a < a_max."""
    E = 5
    """Semi-unstable: none of the above; the acceleration must follow the position."""


def contact_count(*, L: Number, p: Number) -> Number:
    """Count n of nosings that carry the robot after a detachment.

    ``n = floor(L / p)``

    n + 1 nosings touch for 0 <= d < L - n p, and n from there on. A quotient within four units
    of rounding below a whole number counts as that number, so that 0.3 / 0.1 gives 3.

    Returns
    -------
    float or array
        n [1]; the model holds for n >= 2.

    Examples
    --------
    >>> print(contact_count(L=0.47, p=0.2))
    2.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, text to Figs. 2 and 3.

    Errata: "n is an integer greater than 2" contradicts the paper's own tests at 180-220 mm,
    where n = 2; the equations need n >= 2.
    """
    return np.floor(L / p * _ROUNDING)


def two_contacts_remain(*, L: Number, p: Number) -> Number:
    """Whether two nosings carry the robot after one has left, so that the model holds.

    ``p <= L / 2``, that is n >= 2, with the rounding of `contact_count`.

    Returns
    -------
    bool or array of bool

    Examples
    --------
    >>> print(two_contacts_remain(L=0.470, p=0.235), two_contacts_remain(L=0.470, p=0.236))
    True False

    References
    ----------
    Derived from Fig. 3 of Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return 2.0 * p <= L * _ROUNDING


def lowest_contact(*, d: Number, L: Number, p: Number) -> Number:
    """Distance of the lowest contact behind the uphill tip.

    ``s = d + k p`` with k = n for d < L - n p, k = n - 1 from there on.

    Parameters
    ----------
    d : float or array
        Progress [m], 0 <= d < p.

    Returns
    -------
    float or array
        Distance [m], in [L - p, L).

    Examples
    --------
    >>> print(round(lowest_contact(d=0.01, L=0.47, p=0.15), 12))
    0.46
    >>> print(round(lowest_contact(d=0.03, L=0.47, p=0.15), 12))
    0.33

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Fig. 3 and its text.
    """
    n = contact_count(L=L, p=p)
    return d + (n - (d >= L - n * p)) * p


def area(
    *,
    a: Number,
    a_S: Number,
    a_r0: Number,
    a_rn: Number,
    a_slides_up: Number,
    min_a_r0: Number,
    max_a_rn: Number,
) -> Number:
    """Area of the d-a plane in which an acceleration lies.

    Assigned in the order A, B, C, downhill slip, D, E; equality with a limit is never D.

    Parameters
    ----------
    a_S, a_slides_up : float or array
        Slip limits [m/s^2].
    a_r0, a_rn : float or array
        Tip limits at this progress [m/s^2].
    min_a_r0, max_a_rn : float or array
        Tip limits over all progress [m/s^2].

    Returns
    -------
    int or array of int
        `Area`.

    Examples
    --------
    >>> limits = dict(a_S=5.0, a_r0=4.0, a_rn=-4.0, a_slides_up=-9.0, min_a_r0=1.0, max_a_rn=-2.0)
    >>> [Area(int(area(a=a, **limits))).name for a in (6.0, 4.5, -5.0, -10.0, 0.0, 2.0, 1.0)]
    ['A', 'B', 'C', 'C', 'D', 'E', 'E']

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Fig. 7 and the list of areas.

    Errata: areas A and C can overlap and equality is in none of the paper's areas; the downhill
    slip area does not exist there.
    """
    slips, falls_back, falls_forward = a >= a_S, a > a_r0, a < a_rn
    slips_down = a <= a_slides_up
    stable = (a < np.minimum(a_S, min_a_r0)) & (a > np.maximum(a_slides_up, max_a_rn))
    # one step further for every area that it is not in: the first that holds is the answer
    return (1 - slips) * (
        1 + (1 - falls_back) * (1 + (1 - falls_forward) * (1 + (1 - slips_down) * (2 - stable)))
    )
