"""Every failure mode at once: the margins and the bounds of acceleration.

One pass over numbers or arrays; `kaidan.assess` and `kaidan.sweep` both stand on it, so that one
robot and ten million get the same answer.
"""

from typing import NamedTuple

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, Number
from kaidan.mechanics.band import a_max, a_min_with_slip
from kaidan.mechanics.margin import slope_limit, theta_s_inf, theta_s_sup
from kaidan.mechanics.plane import two_contacts_remain
from kaidan.mechanics.slipping import slip_acceleration_down, slip_acceleration_up
from kaidan.mechanics.tipping import max_a_rn, min_a_r0
from kaidan.mechanics.validity import validity


class Margins(NamedTuple):
    """Margins of slope of every failure mode [rad], positive when safe."""

    theta_s_sup: Number
    """Steepest slope for this acceleration, without allowances."""
    tip_downhill: Number
    """theta_s_sup - theta_d - theta_M - theta_s."""
    tip_uphill: Number
    """theta_s - theta_s_inf - theta_d."""
    slides_down: Number
    """Slope at which friction is used up, minus theta_s; NaN where friction is unknown."""
    slides_up: Number
    """theta_s minus the slope below which braking slips; NaN where friction is unknown."""
    worst: Number
    """The smallest of the four, leaving out what is unknown."""
    inside: Number
    """1 where the model holds, NaN where p > L / 2."""


class AccelerationBounds(NamedTuple):
    """Bounds of the acceleration up the stairs [m/s^2], without allowances."""

    slides_down: Number
    slides_up: Number
    tip_downhill: Number
    tip_uphill: Number
    a_max: Number
    """The smaller upper bound (Eq. 17)."""
    a_min: Number
    """The larger lower bound (Eq. 18 with downhill slip)."""


def margins(
    *,
    L: Number,
    C_L: Number,
    C_N: Number,
    theta_s: Number,
    p: Number,
    mu_s: Number,
    a: Number = 0.0,
    theta_d: Number = 0.0,
    theta_M: Number = 0.0,
    g: Number = STANDARD_GRAVITY,
) -> Margins:
    """Margins of slope of every failure mode and the smallest of them.

    Assumptions: regular nosings, p <= L / 2, constant acceleration. theta_d lowers both
    tip limits, because the contact that carries most yields at either end; theta_M only off the
    downhill one, where the grousers of the lowest contact act.

    Parameters
    ----------
    theta_d, theta_M : float or array
        Allowances of Eq. (24) [rad].

    Returns
    -------
    Margins
        NaN throughout where p > L / 2, where the model says nothing.

    Examples
    --------
    >>> m = margins(L=0.470, C_L=0.196, C_N=0.071, theta_s=np.radians(50.0), p=0.150, mu_s=2.0)
    >>> print(np.degrees([m.tip_downhill, m.tip_uphill, m.slides_down, m.worst]).round(3))
    [10.205 82.939 13.435 10.205]

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (4), (7), (12), (24); the uphill
    limit, downhill slip and theta_d at the uphill end derived.
    """
    inside = validity(holds=two_contacts_remain(L=L, p=p))
    sup = inside * theta_s_sup(L=L, p=p, C_L=C_L, C_N=C_N, a=a, g=g)
    inf = inside * theta_s_inf(p=p, C_L=C_L, C_N=C_N, a=a, g=g)
    tip_downhill = sup - theta_d - theta_M - theta_s
    tip_uphill = theta_s - inf - theta_d
    slides_down = inside * (slope_limit(grip=mu_s, a=a, g=g) - theta_s)
    slides_up = inside * (theta_s - slope_limit(grip=-mu_s, a=a, g=g))
    tip = np.minimum(tip_downhill, tip_uphill)
    slip = np.minimum(slides_down, slides_up)
    worst = np.fmin(tip, slip) + 0.0 * tip  # an unknown slip is left out, an unknown tip is not
    return Margins(sup, tip_downhill, tip_uphill, slides_down, slides_up, worst, inside)


def acceleration_bounds(
    *,
    L: Number,
    C_L: Number,
    C_N: Number,
    theta_s: Number,
    p: Number,
    mu_s: Number,
    g: Number = STANDARD_GRAVITY,
) -> AccelerationBounds:
    """Bounds of the acceleration by every failure mode, over a whole regular flight.

    Returns
    -------
    AccelerationBounds
        NaN throughout where p > L / 2; slip bounds NaN, and left out of a_max and a_min, where
        friction is unknown. The band is empty where a_min >= a_max.

    Examples
    --------
    >>> b = acceleration_bounds(L=0.5, C_L=0.2, C_N=0.1, theta_s=0.0, p=0.1, mu_s=0.5, g=10.0)
    >>> print(round(b.a_max, 9), round(b.a_min, 9), round(b.tip_downhill, 9))
    5.0 -5.0 20.0

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (14)-(18); downhill slip derived.
    """
    inside = validity(holds=two_contacts_remain(L=L, p=p))
    slides_down = inside * slip_acceleration_up(mu_s=mu_s, theta_s=theta_s, g=g)
    slides_up = inside * slip_acceleration_down(mu_s=mu_s, theta_s=theta_s, g=g)
    tip_downhill = inside * min_a_r0(L=L, p=p, theta_s=theta_s, C_L=C_L, C_N=C_N, g=g)
    tip_uphill = inside * max_a_rn(p=p, theta_s=theta_s, C_L=C_L, C_N=C_N, g=g)
    return AccelerationBounds(
        slides_down,
        slides_up,
        tip_downhill,
        tip_uphill,
        a_max(a_S=slides_down, min_a_r0=tip_downhill),
        a_min_with_slip(a_slides_up=slides_up, max_a_rn=tip_uphill),
    )
