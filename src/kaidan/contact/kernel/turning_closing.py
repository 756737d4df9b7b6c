"""Which feature of one part closes first as it turns about a point of the ground."""

from __future__ import annotations

import math

from kaidan.contact.kernel.closing import (
    crossing_angle,
    crossing_angle_on,
    on_piece,
    turning_side,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.rotation import turned_on
from kaidan.contact.kernel.trigonometry import atan2, cosine_sine
from kaidan.contact.layout import (
    DISC_1,
    KIND_MASK,
    NO_FEATURE,
    PART,
    POINT,
    POINT_BITS,
    VERTEX,
    First,
    Scene,
    Side,
    Swept,
    Turn,
)

#: A pivot this close to an end disc [m] lies on it: five times the gap at which a rotation ends.
#: One that lies farther off closes with the segment sqrt(2 off / R) later, at a gap of zero.
SAME_ARC = 1e-11
#: Points that the flat meets within this angle of one another [rad] lie in line.
IN_LINE = 1e-10


def flat_closing(
    scene: Scene, k: int, number: int, piece: int, turn: Turn, side: Side, first: First
) -> First:
    """Point k meets a flat of a part that turns about the point of the pivot.

    ``side``: see :func:`kaidan.contact.kernel.first_closing.side_of`; ``number``: of the part.
    """
    point = scene.ground[k]
    part = scene.body[number]
    v_x = point.x - turn.o_x
    v_z = point.z - turn.o_z
    even = v_x * side.n_x + v_z * side.n_z
    rate = turn.sense * (v_z * side.n_x - v_x * side.n_z)
    ahead = turn.sense * turning_side(part, piece)
    at = crossing_angle_on(side.level, even, rate, turn.c, turn.s, part.flat, side.foot, ahead)
    tie = 0.0
    if first.feature != NO_FEATURE and first.feature & KIND_MASK == VERTEX:
        # of points in line the outermost: they come in the order of x
        tie = -turn.sense * IN_LINE
    if at < first.angle + tie:
        there = turned_on(scene, turn.pivot, turn.start, turn.sense, at)
        if on_piece(scene, k, number, piece, there):
            return First(at, POINT * k + PART * number)
    return first


def arcs_closing(
    scene: Scene, k: int, number: int, turn: Turn, swept: Swept, first: First
) -> First:
    """Point k meets the end discs of a part that turns about the point of the pivot."""
    best = first
    point = scene.ground[k]
    part = scene.body[number]
    v_x = point.x - turn.o_x
    v_z = point.z - turn.o_z
    square = v_x * v_x + v_z * v_z
    for disc in range(2):
        r_x = (swept.a_x if disc == 0 else swept.b_x) - turn.o_x
        r_z = (swept.a_z if disc == 0 else swept.b_z) - turn.o_z
        radius = part.one.r if disc == 0 else part.two.r
        away = r_x * r_x + r_z * r_z
        level = square + away - radius * radius
        if level > 0.0 and level * level >= 4.0 * square * away:
            continue
        # law of cosines: |V - C|^2 - r^2
        at = crossing_angle(
            level, -2.0 * (r_x * v_x + r_z * v_z), -2.0 * turn.sense * (r_x * v_z - r_z * v_x),
            turn.c, turn.s, 2.0 * radius * PENETRATED,
        )  # fmt: skip
        if at < best.angle:
            best = First(at, POINT * k + PART * number)
    return best


def segment_closing(
    scene: Scene, k: int, number: int, turn: Turn, swept: Swept, first: First
) -> First:
    """End discs of a part that turns about the point of the pivot meet segment k."""
    best = first
    point = scene.ground[k]
    part = scene.body[number]
    at_k = turn.pivot >> POINT_BITS
    ahead = scene.ground[k + 1].x
    v_x = point.x - turn.o_x
    v_z = point.z - turn.o_z
    for disc in range(2):
        left = swept.left1 if disc == 0 else swept.left2
        right = swept.right1 if disc == 0 else swept.right2
        if ahead < left or point.x > right:
            continue
        r_x = (swept.a_x if disc == 0 else swept.b_x) - turn.o_x
        r_z = (swept.a_z if disc == 0 else swept.b_z) - turn.o_z
        radius = part.one.r if disc == 0 else part.two.r
        feature = POINT * k + PART * number + DISC_1 + disc
        if (k == at_k or k == at_k - 1) and abs(
            math.sqrt(r_x * r_x + r_z * r_z) - radius
        ) < SAME_ARC:
            # the pivot is this segment's end and lies under the disc: it rolls on along the
            # segment ahead as soon as its centre stands over the end
            if (k == at_k) == (turn.sense > 0.0):
                continue
            at = turn.sense * (atan2(point.u_x, -point.u_z) - atan2(r_z, r_x))
            if at < -1e-9:
                at += 2.0 * math.pi
            if at < best.angle:
                best = First(max(at, 0.0), feature)
            continue
        even = point.u_x * r_z - point.u_z * r_x
        level = point.u_z * v_x - point.u_x * v_z - radius
        rate = turn.sense * (r_x * point.u_x + r_z * point.u_z)
        beyond = v_x * point.u_x + v_z * point.u_z
        at = crossing_angle_on(level, even, rate, turn.c, turn.s, point.length, -beyond, turn.sense)
        if at < best.angle:
            # along the segment: the centre, turned
            c, s = cosine_sine(at)
            foot = turn.sense * (c * rate - s * even) - beyond
            if foot >= 0.0 and foot <= point.length:
                best = First(at, feature)
    return best
