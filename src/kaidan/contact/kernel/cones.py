r"""Two contacts with a friction cone each: how much narrower the cones may be.

`kaidan.mechanics.cones.cone_margin`, pose by pose::

    edge of a cone narrower by e:  a - b tan(e) + (c - d tan(e)) l >= 0,    l = inner force

The four edges leave an interval of l, or none. Cones that shrink hold ever less. So where a lower
and an upper bound leave none, the next angle to look at is the largest at which the two meet, or at
which one of them turns round; at most each two meet twice.
"""

from __future__ import annotations

import math

from kaidan.contact.kernel.trigonometry import atan2, cosine_sine, tan
from kaidan.contact.layout import Bound, Cone

#: Angle below a place where two bounds meet at which none of them is lost to rounding [rad].
BELOW = 1e-8
#: Half-angle of the narrowest cone, and of one in which no force that counts as none pulls [rad]:
#: a ray would hold what pulls as well as what pushes.
NARROWEST = 1e-5
NARROW = 1e-2
#: Share of the force that counts as none [1].
NO_FORCE = 1e-7
#: Slope of a bound that is level.
LEVEL = 1e-12


def edge(
    f_x: float, f_z: float, g_x: float, g_z: float, angle: float, side: float, size: float
) -> Bound:
    """Edge of a cone as a bound on the inner force: a, b, c, d."""
    u_z, u_x = cosine_sine(angle)
    return Bound(
        side * (u_x * f_z - u_z * f_x) + size,
        u_z * f_z + u_x * f_x,
        side * (u_x * g_z - u_z * g_x),
        u_z * g_z + u_x * g_x,
    )


def narrowed(bound: Bound, t: float, least: float, most: float) -> tuple[float, float]:
    """Interval of the inner force that an edge leaves of another; an empty one has no end."""
    constant = bound.a - bound.b * t
    slope = bound.c - bound.d * t
    if abs(slope) < LEVEL:
        if constant >= 0.0:
            return least, most
        return math.inf, -math.inf
    if slope > 0.0:
        return max(least, -constant / slope), most
    return least, min(most, -constant / slope)


def root_below(a: float, b: float, c: float, t: float) -> float:
    """Largest root of a x^2 + b x + c below t; minus infinity: there is none."""
    square = b * b - 4.0 * a * c
    root = -math.inf
    if square < 0.0:
        return root
    half = -0.5 * (b + math.copysign(math.sqrt(square), b))
    if a != 0.0 and half / a < t:
        root = half / a
    if half != 0.0 and root < c / half and c / half < t:
        root = c / half
    return root


def level_below(bound: Bound, t: float) -> float:
    """Where an edge is level, if that is below t; minus infinity: it is not."""
    if bound.d != 0.0 and bound.c / bound.d < t:
        return bound.c / bound.d
    return -math.inf


def meet_below(low: Bound, high: Bound, t: float) -> float:
    """Largest number below t at which a lower and an upper bound meet, or one turns round."""
    meet = root_below(
        high.b * low.d - low.b * high.d,
        low.a * high.d + low.b * high.c - high.a * low.d - high.b * low.c,
        high.a * low.c - low.a * high.c,
        t,
    )
    return max(meet, level_below(low, t), level_below(high, t))


def held_below(one: Bound, two: Bound, three: Bound, four: Bound, t: float) -> float:
    """t, if some inner force keeps both forces within cones narrower by arctan(t).

    Else a smaller number, above which none does; minus infinity: none does at all.
    """
    low = one
    high = one
    least, most = narrowed(one, t, -math.inf, math.inf)
    more, less = narrowed(two, t, least, most)
    if more > least:
        low = two
    if less < most:
        high = two
    least, most = narrowed(three, t, more, less)
    if least > more:
        low = three
    if most < less:
        high = three
    more, less = narrowed(four, t, least, most)
    if more > least:
        low = four
    if less < most:
        high = four
    if more <= less:
        return t
    # a bound that is level and fails does so there alone
    meet = t if more == math.inf else meet_below(low, high, t)
    return meet - BELOW * (1.0 + meet * meet)


def cone_margin(one: Cone, two: Cone, w_x: float, w_z: float) -> float:
    """Angle by which the cones of two contacts may shrink while they hold the robot [rad].

    w_x, w_z: sum of their forces [N/kg].

    Minus infinity where no friction is enough, NaN for contacts at one place.
    """
    d_x = two.x - one.x
    d_z = two.z - one.z
    d = math.sqrt(d_x * d_x + d_z * d_z)
    if d == 0.0:
        return math.nan
    e_x = d_x / d
    e_z = d_z / d
    across_2 = -(one.x * w_z - one.z * w_x) / d
    across_1 = -w_x * e_z + w_z * e_x - across_2
    along = w_x * e_x + w_z * e_z
    size = NO_FORCE * math.sqrt(w_x * w_x + w_z * w_z)
    f_x = -across_1 * e_z
    f_z = across_1 * e_x
    h_x = along * e_x - across_2 * e_z
    h_z = along * e_z + across_2 * e_x
    first = edge(f_x, f_z, e_x, e_z, one.alpha + one.phi, 1.0, size)
    second = edge(f_x, f_z, e_x, e_z, one.alpha - one.phi, -1.0, size)
    third = edge(h_x, h_z, -e_x, -e_z, two.alpha + two.phi, 1.0, size)
    fourth = edge(h_x, h_z, -e_x, -e_z, two.alpha - two.phi, -1.0, size)
    t = tan(min(one.phi, two.phi) - NARROW)
    if held_below(first, second, third, fourth, t) == t:
        t = tan(min(one.phi, two.phi) - NARROWEST)
    bottom = tan(max(one.phi, two.phi) - 0.5 * math.pi + 1e-3)
    while t >= bottom:
        below = held_below(first, second, third, fourth, t)
        if below == t:
            return atan2(t, 1.0)
        t = below
    return -math.inf
