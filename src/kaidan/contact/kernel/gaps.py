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

A feature is one integer, see :mod:`kaidan.contact.layout`: the vertex or the start of the segment,
the part, and VERTEX (vertex on part), DISC_1 or DISC_2 (end disc on segment).
"""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.kernel.trigonometry import atan2, cosine_sine
from kaidan.contact.layout import (
    DISC_1,
    DISC_2,
    KIND_MASK,
    PART,
    PART_BITS,
    PART_MASK,
    POINT,
    POINT_BITS,
    VERTEX,
    At,
    Disc,
    Part,
    Point,
    Scene,
)
from kaidan.contact.memory import Table

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


def part_of(scene: Scene, feature: int) -> Part:
    """Part of the robot that a feature is of."""
    return scene.body[(feature >> PART_BITS) & PART_MASK]


def disc_of(scene: Scene, feature: int) -> Disc:
    """End disc that a feature is of; of a vertex the second one."""
    part = part_of(scene, feature)
    return part.one if feature & KIND_MASK == DISC_1 else part.two


def centre_of(disc: Disc, at: At) -> tuple[float, float]:
    """Centre of an end disc in the world [m]."""
    return at.x + at.c * disc.x - at.s * disc.z, at.z + at.s * disc.x + at.c * disc.z


def is_above(part: Part, v: float, at: At, below: float) -> bool:
    """Whether a vertex beyond the axis of a part is outside it, above, and not deep inside.

    The ground reaches down from every vertex, so a vertex just above a thin part has gone through
    it if the part lies under it; a vertex ahead of a lowered nose, or behind a lowered tail, is
    simply above. ``v`` is its place along [m].
    """
    if below < min(part.one.r, part.two.r) - INSIDE:
        return True
    x1, _ = centre_of(part.one, at)
    x2, _ = centre_of(part.two, at)
    left = min(x1 - part.one.r, x2 - part.two.r)
    right = max(x1 + part.one.r, x2 + part.two.r)
    return v <= left or v >= right


def beside_axis(part: Part, point: Point, at: At) -> tuple[float, float, float]:
    """Where a point of the ground lies along the axis of a part and below it [m], on which side.

    Above the part the point is measured to its upper side: the side is turned then.
    """
    d_x = point.x - at.x
    d_z = point.z - at.z
    a_x = at.c * d_x + at.s * d_z - part.one.x
    a_z = at.c * d_z - at.s * d_x - part.one.z
    along = a_x * part.e_x + a_z * part.e_z
    below = part.side * (a_x * part.e_z - a_z * part.e_x)
    if below < 0.0 and is_above(part, point.x, at, below):
        return along, -below, -part.side
    return along, below, part.side


@entry
def gap(scene: Scene, feature: int, at: At) -> tuple[float, float, float, float, float]:
    """Signed gap of one feature, its normal and its contact point.

    The gradient of the gap to (x, z, phi) is ``(n_x, n_z, (p_x - x) n_z - (p_z - z) n_x)``.

    gap [m], n_x, n_z (unit, from the ground into the robot), p_x, p_z [m].
    """
    kind = feature & KIND_MASK
    part = part_of(scene, feature)
    point = scene.ground[feature >> POINT_BITS]
    if kind == VERTEX:
        along, below, side = beside_axis(part, point, at)
        w = along * part.cosine - below * part.sine
        if w > 0.0 and w < part.flat:
            distance = along * part.sine + below * part.cosine - part.one.r
            nu = part.sine
            nv = part.cosine
        else:
            radius = part.one.r
            if w > 0.0:
                along -= part.axis
                radius = part.two.r
            rho = math.sqrt(along * along + below * below)
            distance = rho - radius
            if rho > 1e-15:
                nu = along / rho
                nv = below / rho
            else:
                nu = part.sine
                nv = part.cosine
        b_x = nu * part.e_x + nv * side * part.e_z
        b_z = nu * part.e_z - nv * side * part.e_x
        return distance, at.s * b_z - at.c * b_x, -at.s * b_x - at.c * b_z, point.x, point.z
    disc = disc_of(scene, feature)
    c_x, c_z = centre_of(disc, at)
    n_x = -point.u_z
    n_z = point.u_x
    distance = n_x * (c_x - point.x) + n_z * (c_z - point.z) - disc.r
    reach = disc.r + distance
    return distance, n_x, n_z, c_x - reach * n_x, c_z - reach * n_z


def gap_anywhere(scene: Scene, feature: int, at: At) -> float:
    """Gap of a feature wherever the robot is [m].

    As :func:`gap`, but a disc whose foot lies beyond an end of its segment is measured to that end:
    the line of a segment means nothing there.
    """
    distance, _, _, p_x, p_z = gap(scene, feature, at)
    if feature & KIND_MASK == VERTEX:
        return distance
    beyond = beyond_segment(scene.ground, feature >> POINT_BITS, p_x, p_z)
    if beyond <= 0.0:
        return distance
    radius = disc_of(scene, feature).r
    return math.sqrt(beyond * beyond + (distance + radius) * (distance + radius)) - radius


def beyond_segment(ground: Table[Point], k: int, p_x: float, p_z: float) -> float:
    """How far a foot on a segment's line lies beyond its nearer end [m]; negative: within."""
    point = ground[k]
    foot = (p_x - point.x) * point.u_x + (p_z - point.z) * point.u_z
    return max(-foot, foot - point.length)


def contact_point(scene: Scene, feature: int, at: At) -> tuple[float, float]:
    """Contact point of one feature [m], without its gap: a vertex is its own."""
    point = scene.ground[feature >> POINT_BITS]
    if feature & KIND_MASK == VERTEX:
        return point.x, point.z
    c_x, c_z = centre_of(disc_of(scene, feature), at)
    off = point.u_x * (c_z - point.z) - point.u_z * (c_x - point.x)
    return c_x + off * point.u_z, c_z - off * point.u_x


def pressed_normal(
    scene: Scene, feature: int, at: At, n_x: float, n_z: float
) -> tuple[float, float]:
    """Normal of a contact as the belt gives way under it: forces follow it, poses do not.

    A vertex under an end's arc the arclength u beyond the flat lies u^2 / 2R above the flat's line.
    Up to the height that rubber yields by, that is to ``a = sqrt(2 R YIELD L)``, the belt carries
    as the flat does, over a quarter of a radian at most, and from 3 a on as the arc does; between,
    the normal turns by 3 (u - a) / 2R. A normal more upright than the flat's stays.

    n_x, n_z: normal of the rigid outline, from :func:`gap`.
    """
    if feature & KIND_MASK != VERTEX or on_flat(scene, feature, at):
        return n_x, n_z
    part = part_of(scene, feature)
    point = scene.ground[feature >> POINT_BITS]
    c_x, c_z = centre_of(part.one, at)
    d_x = c_x - point.x
    d_z = c_z - point.z
    to_1 = math.sqrt(d_x * d_x + d_z * d_z)
    c_x, c_z = centre_of(part.two, at)
    d_x = c_x - point.x
    d_z = c_z - point.z
    to_2 = math.sqrt(d_x * d_x + d_z * d_z)
    disc = part.one if to_1 - part.one.r <= to_2 - part.two.r else part.two
    # of all flats that end on this disc the nearest, and how far the normal has turned from it
    turned = math.pi
    length = 0.0
    upright = 1.0
    for k in range(len(scene.body)):
        other = scene.body[k]
        for end in range(2):
            own = other.one if end == 0 else other.two
            if (
                abs(own.x - disc.x) > ONE_DISC
                or abs(own.z - disc.z) > ONE_DISC
                or abs(own.r - disc.r) > ONE_DISC
            ):
                continue
            b_x = other.sine * other.e_x
            b_x += other.cosine * other.side * other.e_z
            b_z = other.sine * other.e_z
            b_z -= other.cosine * other.side * other.e_x
            f_x = at.s * b_z - at.c * b_x
            f_z = -at.s * b_x - at.c * b_z
            angle = atan2(n_x * f_z - n_z * f_x, n_x * f_x + n_z * f_z)
            if abs(angle) < abs(turned):
                turned = angle
                length = other.flat
                upright = f_z
    a = min(math.sqrt(2.0 * disc.r * YIELD * length), ARC * disc.r)
    u = disc.r * abs(turned)
    if u >= 3.0 * a or n_z >= upright:
        return n_x, n_z
    back = turned - math.copysign(1.5 * max(u - a, 0.0) / disc.r, turned)
    c, s = cosine_sine(back)
    return n_x * c - n_z * s, n_z * c + n_x * s


def relabelled(scene: Scene, feature: int, at: At) -> int:
    """Name the same contact as it is called at this pose.

    A disc whose foot has run past the end of its segment stands on the vertex there; a vertex
    under an end disc whose centre has come over one of the vertex's segments is a contact with that
    segment.  Both changes are C1, so they are no events.
    """
    k = feature >> POINT_BITS
    point = scene.ground[k]
    on_part = feature & (PART_MASK * PART)
    if feature & KIND_MASK == VERTEX:
        part = part_of(scene, feature)
        along, below, _ = beside_axis(part, point, at)
        w = along * part.cosine - below * part.sine
        if w > 0.0 and w < part.flat:
            return feature
        kind = DISC_2 if w > 0.0 else DISC_1
        c_x, c_z = centre_of(part.two if w > 0.0 else part.one, at)
        to_x = c_x - point.x
        to_z = c_z - point.z
        if to_x * point.u_x + to_z * point.u_z > 0.0:
            return POINT * k + on_part + kind
        behind = scene.ground[k - 1]
        if to_x * behind.u_x + to_z * behind.u_z < 0.0:
            return POINT * (k - 1) + on_part + kind
        return feature
    c_x, c_z = centre_of(disc_of(scene, feature), at)
    foot = (c_x - point.x) * point.u_x + (c_z - point.z) * point.u_z
    if foot < 0.0 and point.convex:
        return POINT * k + on_part
    if foot > point.length and scene.ground[k + 1].convex:
        return POINT * (k + 1) + on_part
    return feature


@entry
def on_flat(scene: Scene, feature: int, at: At) -> bool:
    """Whether a feature is a vertex under the straight underside of its part."""
    return feature & KIND_MASK == VERTEX and flat_room(scene, feature, at) >= 0.0


def flat_room(scene: Scene, feature: int, at: At) -> float:
    """How far a vertex under a part is from the nearer end of its flat [m]; negative: beyond it."""
    part = part_of(scene, feature)
    along, below, _ = beside_axis(part, scene.ground[feature >> POINT_BITS], at)
    w = along * part.cosine - below * part.sine
    return min(w, part.flat - w)
