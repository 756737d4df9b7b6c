"""Features and their signed gaps: what can touch what, and how far it is from touching.

::

    feature (vertex, part)            feature (end disc, segment)

      .---------------------.             ,---.
     (   flat    | n         )           (  c  )
      '----------+----------'             `-+-'   gap = m.(c - P) - r,
                 | gap                 m ^  | gap  while the foot of c lies in the segment
                 o vertex               P o-+--------o

A vertex is measured to the whole outline of a part (arc, flat, arc): the gap is C1 from flat to
arc.  From vertex to segment it is C1 as well, so a contact may be relabelled without a jump.

A feature is one integer, see :mod:`kaidan.contact.columns`: the vertex or the start of the segment,
the part, and VERTEX (vertex on part), DISC_1 or DISC_2 (end disc on segment).
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    AXIS,
    CONVEX,
    COSINE,
    DISC,
    DISC_1,
    DISC_2,
    DISC_R,
    DISC_X,
    DISC_Z,
    E_X,
    E_Z,
    FLAT,
    KIND_MASK,
    LENGTH,
    PART,
    PART_BITS,
    PART_MASK,
    POINT,
    POINT_BITS,
    R1,
    R2,
    SIDE,
    SINE,
    U_X,
    U_Z,
    VERTEX,
    X1,
    X2,
    Z1,
    Z2,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.tables import BodyTable, GroundTable

#: Parts thinner than this are given that much inside below their axis [m], so that a step of some
#: millimetres into a thin part is still seen as "too deep" and not as "through".
INSIDE = 0.01
FAR = 1e9
#: Rubber gives way by this share of the flat's length [1]: 1 mm of half a metre, a seventh of what
#: the paper's rig did.
YIELD = 2e-3
#: Arc over which it may carry as the flat does, at most [rad]: ends far smaller than that yield are
#: edges.
ARC = 0.25
#: Discs of two parts this near to each other [m] are one.
ONE_DISC = 1e-9


def is_above(
    ground: GroundTable,
    body: BodyTable,
    part: int,
    k: int,
    x: float,
    c: float,
    s: float,
    below: float,
) -> bool:
    """Whether a vertex beyond the axis of a part is outside it, above, and not deep inside.

    The ground reaches down from every vertex, so a vertex just above a thin part has gone through
    it if the part lies under it; a vertex ahead of a lowered nose, or behind a lowered tail, is
    simply above.
    """
    if below < min(body[part, R1], body[part, R2]) - INSIDE:
        return True
    x1 = x + c * body[part, X1] - s * body[part, Z1]
    x2 = x + c * body[part, X2] - s * body[part, Z2]
    v = ground[k, X]
    left = min(x1 - body[part, R1], x2 - body[part, R2])
    right = max(x1 + body[part, R1], x2 + body[part, R2])
    return bool(v <= left or v >= right)


@entry
def gap(
    ground: GroundTable,
    body: BodyTable,
    feature: int,
    x: float,
    z: float,
    c: float,
    s: float,
) -> tuple[float, float, float, float, float]:
    """Signed gap of one feature, its normal and its contact point.

    The gradient of the gap to (x, z, phi) is ``(n_x, n_z, (p_x - x) n_z - (p_z - z) n_x)``.

    Parameters
    ----------
    ground, body
        Tables of :mod:`kaidan.contact.tables`.
    feature
        Code of the feature.
    x, z
        Centroid [m].
    c, s
        Cosine and sine of the inclination.

    Returns
    -------
    gap [m], n_x, n_z (unit, from the ground into the robot), p_x, p_z [m]
    """
    kind = feature & KIND_MASK
    part = (feature >> PART_BITS) & PART_MASK
    k = feature >> POINT_BITS
    if kind == VERTEX:
        g_x = ground[k, X]
        g_z = ground[k, Z]
        d_x = g_x - x
        d_z = g_z - z
        a_x = c * d_x + s * d_z - body[part, X1]
        a_z = c * d_z - s * d_x - body[part, Z1]
        e_x = body[part, E_X]
        e_z = body[part, E_Z]
        sine = body[part, SINE]
        cosine = body[part, COSINE]
        side = body[part, SIDE]
        along = a_x * e_x + a_z * e_z
        below = side * (a_x * e_z - a_z * e_x)
        if below < 0.0 and is_above(ground, body, part, k, x, c, s, below):
            below = -below
            side = -side
        w = along * cosine - below * sine
        if w > 0.0 and w < body[part, FLAT]:
            distance = along * sine + below * cosine - body[part, R1]
            nu = sine
            nv = cosine
        else:
            radius = body[part, R1]
            if w > 0.0:
                along -= body[part, AXIS]
                radius = body[part, R2]
            rho = math.sqrt(along * along + below * below)
            distance = rho - radius
            if rho > 1e-15:
                nu = along / rho
                nv = below / rho
            else:
                nu = sine
                nv = cosine
        b_x = nu * e_x + nv * side * e_z
        b_z = nu * e_z - nv * side * e_x
        return distance, s * b_z - c * b_x, -s * b_x - c * b_z, g_x, g_z
    j = DISC * (kind - DISC_1)
    b_x = body[part, j + DISC_X]
    b_z = body[part, j + DISC_Z]
    c_x = x + c * b_x - s * b_z
    c_z = z + s * b_x + c * b_z
    radius = body[part, j + DISC_R]
    n_x = -ground[k, U_Z]
    n_z = ground[k, U_X]
    distance = n_x * (c_x - ground[k, X]) + n_z * (c_z - ground[k, Z]) - radius
    reach = radius + distance
    return distance, n_x, n_z, c_x - reach * n_x, c_z - reach * n_z


def gap_anywhere(
    ground: GroundTable, body: BodyTable, feature: int, x: float, z: float, c: float, s: float
) -> float:
    """Gap of a feature wherever the robot is [m].

    As :func:`gap`, but a disc whose foot lies beyond an end of its segment is measured to that end:
    the line of a segment means nothing there.
    """
    kind = feature & KIND_MASK
    distance, _, _, p_x, p_z = gap(ground, body, feature, x, z, c, s)
    if kind == VERTEX:
        return distance
    beyond = beyond_segment(ground, feature >> POINT_BITS, p_x, p_z)
    if beyond <= 0.0:
        return distance
    radius: float = body[(feature >> PART_BITS) & PART_MASK, DISC * (kind - DISC_1) + DISC_R]
    return math.sqrt(beyond * beyond + (distance + radius) * (distance + radius)) - radius


def beyond_segment(ground: GroundTable, k: int, p_x: float, p_z: float) -> float:
    """How far a foot on a segment's line lies beyond its nearer end [m]; negative: within."""
    foot = (p_x - ground[k, X]) * ground[k, U_X] + (p_z - ground[k, Z]) * ground[k, U_Z]
    return float(max(-foot, foot - ground[k, LENGTH]))


def contact_point(
    ground: GroundTable, body: BodyTable, feature: int, x: float, z: float, c: float, s: float
) -> tuple[float, float]:
    """Contact point of one feature [m], without its gap: a vertex is its own."""
    kind = feature & KIND_MASK
    k = feature >> POINT_BITS
    if kind == VERTEX:
        return ground[k, X], ground[k, Z]
    part = (feature >> PART_BITS) & PART_MASK
    j = DISC * (kind - DISC_1)
    c_x = x + c * body[part, j + DISC_X] - s * body[part, j + DISC_Z]
    c_z = z + s * body[part, j + DISC_X] + c * body[part, j + DISC_Z]
    u_x = ground[k, U_X]
    u_z = ground[k, U_Z]
    off = u_x * (c_z - ground[k, Z]) - u_z * (c_x - ground[k, X])
    return c_x + off * u_z, c_z - off * u_x


def pressed_normal(
    ground: GroundTable,
    body: BodyTable,
    feature: int,
    x: float,
    z: float,
    c: float,
    s: float,
    n_x: float,
    n_z: float,
) -> tuple[float, float]:
    """Normal of a contact as the belt gives way under it: forces follow it, poses do not.

    A vertex under an end's arc the arclength u beyond the flat lies u^2 / 2R above the flat's line.
    Up to the height that rubber yields by, that is to ``a = sqrt(2 R YIELD L)``, the belt carries
    as the flat does, over a quarter of a radian at most, and from 3 a on as the arc does; between,
    the normal turns by 3 (u - a) / 2R. A normal more upright than the flat's stays.

    Parameters
    ----------
    n_x, n_z
        Normal of the rigid outline, from :func:`gap`.
    """
    if feature & KIND_MASK != VERTEX:
        return n_x, n_z
    part = (feature >> PART_BITS) & PART_MASK
    k = feature >> POINT_BITS
    if on_flat(ground, body, feature, x, z, c, s):
        return n_x, n_z
    d_x = x + c * body[part, X1] - s * body[part, Z1] - ground[k, X]
    d_z = z + s * body[part, X1] + c * body[part, Z1] - ground[k, Z]
    to_1 = math.sqrt(d_x * d_x + d_z * d_z)
    d_x = x + c * body[part, X2] - s * body[part, Z2] - ground[k, X]
    d_z = z + s * body[part, X2] + c * body[part, Z2] - ground[k, Z]
    to_2 = math.sqrt(d_x * d_x + d_z * d_z)
    j = 0 if to_1 - body[part, R1] <= to_2 - body[part, R2] else DISC
    radius = body[part, j + DISC_R]
    # of all flats that end on this disc the nearest, and how far the normal has turned from it
    turned = math.pi
    length = 0.0
    upright = 1.0
    for other in range(body.shape[0]):
        for end in range(2):
            i = DISC * end
            if (
                abs(body[other, i + DISC_X] - body[part, j + DISC_X]) > ONE_DISC
                or abs(body[other, i + DISC_Z] - body[part, j + DISC_Z]) > ONE_DISC
                or abs(body[other, i + DISC_R] - radius) > ONE_DISC
            ):
                continue
            b_x = body[other, SINE] * body[other, E_X]
            b_x += body[other, COSINE] * body[other, SIDE] * body[other, E_Z]
            b_z = body[other, SINE] * body[other, E_Z]
            b_z -= body[other, COSINE] * body[other, SIDE] * body[other, E_X]
            f_x = s * b_z - c * b_x
            f_z = -s * b_x - c * b_z
            angle = math.atan2(n_x * f_z - n_z * f_x, n_x * f_x + n_z * f_z)
            if abs(angle) < abs(turned):
                turned = angle
                length = body[other, FLAT]
                upright = f_z
    a = min(math.sqrt(2.0 * radius * YIELD * length), ARC * radius)
    u = radius * abs(turned)
    if u >= 3.0 * a or n_z >= upright:
        return n_x, n_z
    back = turned - math.copysign(1.5 * max(u - a, 0.0) / radius, turned)
    return n_x * math.cos(back) - n_z * math.sin(back), n_z * math.cos(back) + n_x * math.sin(back)


def relabelled(
    ground: GroundTable, body: BodyTable, feature: int, x: float, z: float, c: float, s: float
) -> int:
    """Name the same contact as it is called at this pose.

    A disc whose foot has run past the end of its segment stands on the vertex there; a vertex
    under an end disc whose centre has come over one of the vertex's segments is a contact with that
    segment.  Both changes are C1, so they are no events.
    """
    kind = feature & KIND_MASK
    part = (feature >> PART_BITS) & PART_MASK
    k = feature >> POINT_BITS
    if kind == VERTEX:
        g_x = ground[k, X]
        g_z = ground[k, Z]
        d_x = g_x - x
        d_z = g_z - z
        a_x = c * d_x + s * d_z - body[part, X1]
        a_z = c * d_z - s * d_x - body[part, Z1]
        e_x = body[part, E_X]
        e_z = body[part, E_Z]
        along = a_x * e_x + a_z * e_z
        below = body[part, SIDE] * (a_x * e_z - a_z * e_x)
        if below < 0.0 and is_above(ground, body, part, k, x, c, s, below):
            below = -below
        w = along * body[part, COSINE] - below * body[part, SINE]
        if w > 0.0 and w < body[part, FLAT]:
            return feature
        kind = DISC_1
        if w > 0.0:
            kind = DISC_2
        j = DISC * (kind - DISC_1)
        b_x = body[part, j + DISC_X]
        b_z = body[part, j + DISC_Z]
        to_x = x + c * b_x - s * b_z - g_x
        to_z = z + s * b_x + c * b_z - g_z
        if to_x * ground[k, U_X] + to_z * ground[k, U_Z] > 0.0:
            return POINT * k + PART * part + kind
        if to_x * ground[k - 1, U_X] + to_z * ground[k - 1, U_Z] < 0.0:
            return POINT * (k - 1) + PART * part + kind
        return feature
    j = DISC * (kind - DISC_1)
    b_x = body[part, j + DISC_X]
    b_z = body[part, j + DISC_Z]
    to_x = x + c * b_x - s * b_z - ground[k, X]
    to_z = z + s * b_x + c * b_z - ground[k, Z]
    foot = to_x * ground[k, U_X] + to_z * ground[k, U_Z]
    if foot < 0.0 and ground[k, CONVEX] == 1.0:
        return POINT * k + PART * part
    if foot > ground[k, LENGTH] and ground[k + 1, CONVEX] == 1.0:
        return POINT * (k + 1) + PART * part
    return feature


@entry
def on_flat(
    ground: GroundTable, body: BodyTable, feature: int, x: float, z: float, c: float, s: float
) -> bool:
    """Whether a feature is a vertex under the straight underside of its part."""
    return feature & KIND_MASK == VERTEX and flat_room(ground, body, feature, x, z, c, s) >= 0.0


def flat_room(
    ground: GroundTable, body: BodyTable, feature: int, x: float, z: float, c: float, s: float
) -> float:
    """How far a vertex under a part is from the nearer end of its flat [m]; negative: beyond it."""
    part = (feature >> PART_BITS) & PART_MASK
    k = feature >> POINT_BITS
    d_x = ground[k, X] - x
    d_z = ground[k, Z] - z
    a_x = c * d_x + s * d_z - body[part, X1]
    a_z = c * d_z - s * d_x - body[part, Z1]
    along = a_x * body[part, E_X] + a_z * body[part, E_Z]
    below = body[part, SIDE] * (a_x * body[part, E_Z] - a_z * body[part, E_X])
    if below < 0.0 and is_above(ground, body, part, k, x, c, s, below):
        below = -below
    w = along * body[part, COSINE] - below * body[part, SINE]
    return float(min(w, body[part, FLAT] - w))
