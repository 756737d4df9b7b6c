"""Which feature of one part closes first as it turns about a point of the ground."""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    DISC,
    DISC_1,
    DISC_R,
    FLAT,
    KIND_MASK,
    LENGTH,
    NO_FEATURE,
    PART,
    POINT,
    POINT_BITS,
    U_X,
    U_Z,
    VERTEX,
    X,
    Z,
)
from kaidan.contact.kernel.closing import (
    crossing_angle,
    crossing_angle_on,
    on_piece,
    turning_side,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.rotation import carried
from kaidan.contact.tables import BodyTable, Four, GroundTable, Pose, Side

#: A pivot this close to an end disc [m] lies on it: five times the gap at which a rotation ends.
#: One that lies farther off closes with the segment sqrt(2 off / R) later, at a gap of zero.
SAME_ARC = 1e-11
#: Points that the flat meets within this angle of one another [rad] lie in line.
IN_LINE = 1e-10


def flat_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, piece: int, pivot: int,
    start: Pose, sense: float, ce: float, se: float, side: Side, best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """Point k meets a flat of a part that turns about the point of the pivot.

    ``side``: see :func:`kaidan.contact.kernel.first_closing.side_of`.

    Returns
    -------
    angle [rad], feature: those given unless it closes before.
    """
    x, z, c0, s0, o_x, o_z = start
    _, n_x, n_z, level, foot = side
    v_x = ground[k, X] - o_x
    v_z = ground[k, Z] - o_z
    even = v_x * n_x + v_z * n_z
    rate = sense * (v_z * n_x - v_x * n_z)
    ahead = sense * turning_side(body, part, piece)
    at = crossing_angle_on(level, even, rate, ce, se, body[part, FLAT], foot, ahead)
    tie = 0.0
    if which != NO_FEATURE and which & KIND_MASK == VERTEX:
        # of points in line the outermost: they come in the order of x
        tie = -sense * IN_LINE
    if at < best + tie:
        c = math.cos(at)
        s = sense * math.sin(at)
        y_x, y_z = carried(ground, body, pivot, x, z, c0, s0, sense * at, c, s)
        if on_piece(ground, body, k, part, piece, y_x, y_z, c0 * c - s0 * s, s0 * c + c0 * s):
            best = at
            which = POINT * k + PART * part
    return best, which


def arcs_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, o_x: float, o_z: float, sense: float,
    ce: float, se: float, centres: Four, best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """Point k meets the end discs of a part that turns about (o_x, o_z).

    Returns
    -------
    angle [rad], feature: those given unless one of these closes before.
    """
    v_x = ground[k, X] - o_x
    v_z = ground[k, Z] - o_z
    square = v_x * v_x + v_z * v_z
    a_x, a_z, b_x, b_z = centres
    for disc in range(2):
        r_x = a_x - o_x
        r_z = a_z - o_z
        if disc == 1:
            r_x = b_x - o_x
            r_z = b_z - o_z
        radius = body[part, DISC * disc + DISC_R]
        away = r_x * r_x + r_z * r_z
        level = square + away - radius * radius
        if level > 0.0 and level * level >= 4.0 * square * away:
            continue
        # law of cosines: |V - C|^2 - r^2
        at = crossing_angle(
            level, -2.0 * (r_x * v_x + r_z * v_z), -2.0 * sense * (r_x * v_z - r_z * v_x), ce, se,
            2.0 * radius * PENETRATED,
        )  # fmt: skip
        if at < best:
            best = at
            which = POINT * k + PART * part
    return best, which


def segment_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, pivot: int,
    o_x: float, o_z: float, sense: float, ce: float, se: float,
    centres: Four, ranges: Four, best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """End discs of a part that turns about (o_x, o_z) meet segment k.

    Returns
    -------
    angle [rad], feature: those given unless one of these closes before.
    """
    at_k = pivot >> POINT_BITS
    a_x, a_z, b_x, b_z = centres
    left1, right1, left2, right2 = ranges
    u_x = ground[k, U_X]
    u_z = ground[k, U_Z]
    here = ground[k, X]
    ahead = ground[k + 1, X]
    v_x = here - o_x
    v_z = ground[k, Z] - o_z
    for disc in range(2):
        r_x = a_x - o_x
        r_z = a_z - o_z
        if disc == 0:
            if ahead < left1 or here > right1:
                continue
        else:
            if ahead < left2 or here > right2:
                continue
            r_x = b_x - o_x
            r_z = b_z - o_z
        radius = body[part, DISC * disc + DISC_R]
        if (k == at_k or k == at_k - 1) and abs(
            math.sqrt(r_x * r_x + r_z * r_z) - radius
        ) < SAME_ARC:
            # the pivot is this segment's end and lies under the disc: it rolls on along the
            # segment ahead as soon as its centre stands over the end
            if (k == at_k) == (sense > 0.0):
                continue
            at = sense * (math.atan2(u_x, -u_z) - math.atan2(r_z, r_x))
            if at < -1e-9:
                at += 2.0 * math.pi
            if at < best:
                best = max(at, 0.0)
                which = POINT * k + PART * part + DISC_1 + disc
            continue
        even = u_x * r_z - u_z * r_x
        level = u_z * v_x - u_x * v_z - radius
        rate = sense * (r_x * u_x + r_z * u_z)
        beyond = v_x * u_x + v_z * u_z
        at = crossing_angle_on(level, even, rate, ce, se, ground[k, LENGTH], -beyond, sense)
        if at < best:
            # along the segment: the centre, turned
            foot = sense * (math.cos(at) * rate - math.sin(at) * even) - beyond
            if foot >= 0.0 and foot <= ground[k, LENGTH]:
                best = at
                which = POINT * k + PART * part + DISC_1 + disc
    return best, which
