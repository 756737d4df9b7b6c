r"""Two contacts with a friction cone each: how much narrower the cones may be.

`kaidan.mechanics.cones.cone_margin`, pose by pose::

    edge of a cone narrower by e:  a - b tan(e) + (c - d tan(e)) l >= 0,    l = inner force

The four edges leave an interval of l, or none.
"""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.tables import Four

#: Halvings: of less than half a turn down to 1e-5 rad.
HALVINGS = 18
#: Share of the force that counts as none [1].
NO_FORCE = 1e-7
#: Slope of a bound that is level.
LEVEL = 1e-12


def edge(
    f_x: float, f_z: float, g_x: float, g_z: float, angle: float, side: float, size: float
) -> Four:
    """Edge of a cone as a bound on the inner force: a, b, c, d."""
    u_x = math.sin(angle)
    u_z = math.cos(angle)
    return (
        side * (u_x * f_z - u_z * f_x) + size,
        u_z * f_z + u_x * f_x,
        side * (u_x * g_z - u_z * g_x),
        u_z * g_z + u_x * g_x,
    )


def narrowed(bound: Four, t: float, least: float, most: float) -> tuple[float, float]:
    """Interval of the inner force that an edge leaves of another; an empty one has no end."""
    constant = bound[0] - bound[1] * t
    slope = bound[2] - bound[3] * t
    if abs(slope) < LEVEL:
        if constant >= 0.0:
            return least, most
        return math.inf, -math.inf
    if slope > 0.0:
        return max(least, -constant / slope), most
    return least, min(most, -constant / slope)


def cones_hold(one: Four, two: Four, three: Four, four: Four, t: float) -> bool:
    """Whether some inner force keeps both forces within cones narrower by arctan(t)."""
    least, most = narrowed(one, t, -math.inf, math.inf)
    least, most = narrowed(two, t, least, most)
    if least > most:
        return False
    least, most = narrowed(three, t, least, most)
    if least > most:
        return False
    least, most = narrowed(four, t, least, most)
    return least <= most


@entry
def cone_margin(
    x_1: float, z_1: float, alpha_1: float, phi_1: float,
    x_2: float, z_2: float, alpha_2: float, phi_2: float, w_x: float, w_z: float,
) -> float:  # fmt: skip
    """Angle by which the cones of two contacts may shrink while they hold the robot [rad].

    Parameters
    ----------
    x_1, z_1, x_2, z_2
        Places of the contacts from the centroid [m].
    alpha_1, phi_1, alpha_2, phi_2
        Tilt of the normal and angle of friction of each [rad].
    w_x, w_z
        Sum of their forces [N/kg].

    Returns
    -------
    float
        Minus infinity where no friction is enough, NaN for contacts at one place.
    """
    d_x = x_2 - x_1
    d_z = z_2 - z_1
    d = math.sqrt(d_x * d_x + d_z * d_z)
    if d == 0.0:
        return math.nan
    e_x = d_x / d
    e_z = d_z / d
    across_2 = -(x_1 * w_z - z_1 * w_x) / d
    across_1 = -w_x * e_z + w_z * e_x - across_2
    along = w_x * e_x + w_z * e_z
    size = NO_FORCE * math.sqrt(w_x * w_x + w_z * w_z)
    f_x = -across_1 * e_z
    f_z = across_1 * e_x
    h_x = along * e_x - across_2 * e_z
    h_z = along * e_z + across_2 * e_x
    one = edge(f_x, f_z, e_x, e_z, alpha_1 + phi_1, 1.0, size)
    two = edge(f_x, f_z, e_x, e_z, alpha_1 - phi_1, -1.0, size)
    three = edge(h_x, h_z, -e_x, -e_z, alpha_2 + phi_2, 1.0, size)
    four = edge(h_x, h_z, -e_x, -e_z, alpha_2 - phi_2, -1.0, size)
    high = min(phi_1, phi_2)
    low = max(phi_1, phi_2) - 0.5 * math.pi + 1e-3
    if not cones_hold(one, two, three, four, math.tan(low)):
        return -math.inf
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if cones_hold(one, two, three, four, math.tan(middle)):
            low = middle
        else:
            high = middle
    return low
