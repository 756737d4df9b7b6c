"""Which feature closes first within a rotation about one contact."""

from __future__ import annotations

import math

from kaidan.contact.kernel.closing import (
    FROM_DISC_1,
    FROM_DISC_2,
    TO_ARC_1,
    TO_ARC_2,
    TO_FLAT,
    TO_TOP,
    closing_angle,
    flat_normal,
    foot_on,
    separation,
    stays_beside,
    turning_side,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.gaps import centre_of, contact_point, disc_of, gap
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.rotation import turned_by
from kaidan.contact.kernel.trigonometry import cosine_sine
from kaidan.contact.kernel.turning_closing import arcs_closing, flat_closing, segment_closing
from kaidan.contact.layout import (
    DISC_1,
    KIND_MASK,
    NO_FEATURE,
    PART,
    PART_BITS,
    PART_MASK,
    POINT,
    POINT_BITS,
    VERTEX,
    At,
    First,
    Part,
    Point,
    Scene,
    Side,
    Swept,
    Turn,
)


def turn_about(scene: Scene, pivot: int, start: At, sense: float, end: float) -> Turn:
    """Rotation by an angle in a sense about a contact, from where the body is."""
    c, s = cosine_sine(end)
    finish = turned_by(scene, pivot, start, sense, end, c, s)
    height, n_x, n_z, o_x, o_z = gap(scene, pivot, start)
    f_x, f_z = contact_point(scene, pivot, finish)
    radius = 0.0
    h_x = o_x
    h_z = o_z
    if pivot & KIND_MASK != VERTEX:
        radius = disc_of(scene, pivot).r
        point = scene.ground[pivot >> POINT_BITS]
        h_x = o_x - radius * point.u_z
        h_z = o_z + radius * point.u_x
    return Turn(
        pivot, start, o_x, o_z, finish, f_x, f_z, sense, end, c, s,
        h_x, h_z, radius, n_x, n_z, height,
    )  # fmt: skip


def swept_by(part: Part, turn: Turn) -> Swept:
    """Centres of a part's discs at the start of a rotation, and the ranges of x that they sweep."""
    a_x, a_z = centre_of(part.one, turn.start)
    b_x, b_z = centre_of(part.two, turn.start)
    # chord of each disc's centre, plus the sagitta of its arc, over the radius of the arc
    bend = 0.125 * turn.end * turn.end
    e_x, _ = centre_of(part.one, turn.finish)
    sag = bend * (abs(a_x - turn.h_x) + abs(a_z - turn.h_z)) + part.one.r
    left1 = min(a_x, e_x) - sag
    right1 = max(a_x, e_x) + sag
    e_x, _ = centre_of(part.two, turn.finish)
    sag = bend * (abs(b_x - turn.h_x) + abs(b_z - turn.h_z)) + part.two.r
    left2 = min(b_x, e_x) - sag
    right2 = max(b_x, e_x) + sag
    return Swept(a_x, a_z, b_x, b_z, left1, right1, left2, right2)


def side_of(part: Part, piece: int, turn: Turn, swept: Swept) -> Side:
    """Side of a part at the start of a rotation."""
    n_x, n_z = flat_normal(part, piece, turn.start)
    o_x = turn.o_x - swept.a_x
    o_z = turn.o_z - swept.a_z
    level = o_x * n_x + o_z * n_z - part.one.r
    foot = turning_side(part, piece) * (o_z * n_x - o_x * n_z)
    faces = n_z < 0.0 or n_z * turn.c + n_x * (turn.sense * turn.s) < 0.0
    return Side(faces, n_x, n_z, level, foot)


def curvature(piece: int, point: Point, turn: Turn, swept: Swept) -> float:
    """Bound on the curvature of one smooth piece of a gap, for a pivot that rolls [m/rad^2].

    Of a disc's distance the lever of its centre; of a flat's that of the vertex besides twice the
    rate at which the disc that rolls moves on.
    """
    if piece <= TO_TOP:
        v_x = point.x - turn.h_x
        v_z = point.z - turn.h_z
        rolled = turn.radius * turn.end
        return 2.0 * turn.radius + rolled + math.sqrt(v_x * v_x + v_z * v_z)
    first = piece == TO_ARC_1 or piece == FROM_DISC_1
    l_x = (swept.a_x if first else swept.b_x) - turn.h_x
    l_z = (swept.a_z if first else swept.b_z) - turn.h_z
    return math.sqrt(l_x * l_x + l_z * l_z)


def rolling_closing(
    scene: Scene, k: int, number: int, down: bool, falls: bool, turn: Turn, swept: Swept,
    first: First,
) -> First:  # fmt: skip
    """Point k or segment k meets a part that rolls: no sinusoid."""
    found = first
    point = scene.ground[k]
    part = scene.body[number]
    here = point.x
    ahead = scene.ground[k + 1].x
    for piece in range(FROM_DISC_2 + 1):
        feature = POINT * k + PART * number
        if piece < FROM_DISC_1:
            if (
                not point.convex
                or (piece == TO_FLAT and not down)
                or (piece == TO_TOP and not falls)
            ):
                continue
        else:
            feature += DISC_1 + piece - FROM_DISC_1
            if feature == turn.pivot:
                continue
        if piece == TO_ARC_1 or piece == FROM_DISC_1:
            if here > swept.right1 or (here if piece == TO_ARC_1 else ahead) < swept.left1:
                continue
        elif piece > TO_TOP and (
            here > swept.right2 or (here if piece == TO_ARC_2 else ahead) < swept.left2
        ):
            continue
        bend = curvature(piece, point, turn, swept)
        value, rate = separation(scene, k, part, piece, turn.start, turn.o_x, turn.o_z, turn.sense)
        best = found.angle
        if value > 0.0 and value + best * (rate - 0.5 * bend * best) > 0.0:
            continue
        if piece <= TO_TOP or piece >= FROM_DISC_1:
            length = part.flat if piece <= TO_TOP else point.length
            foot = foot_on(scene, k, part, piece, turn.start)
            later = foot_on(scene, k, part, piece, turn.finish)
            if stays_beside(foot, later, 0.125 * bend * turn.end * turn.end, length):
                continue
        far, far_rate = separation(
            scene, k, part, piece, turn.finish, turn.f_x, turn.f_z, turn.sense
        )
        at = closing_angle(scene, k, number, piece, turn, best, value, rate, far, far_rate, bend)
        if at < best:
            found = First(at, feature)
    return found


def stays_under(point: Point, turn: Turn) -> bool:
    """Whether a point stays under a line through the pivot as long as that turns about there.

    The part of the pivot lies over its supporting line there, so that it meets nothing that stays
    under it. What is over it by PENETRATED / 2 at most before and after a turn by 120 deg or less
    is so by PENETRATED at most on the way: its height is a sinusoid, and half of the greatest one
    is reached 60 deg before and after.
    """
    v_x = point.x - turn.o_x
    v_z = point.z - turn.o_z
    up = v_x * turn.n_x + v_z * turn.n_z
    most = min(turn.height, 0.0) + 0.5 * PENETRATED
    sine = turn.sense * turn.s
    return up <= most and up * turn.c + (v_z * turn.n_x - v_x * turn.n_z) * sine <= most


def part_closing(scene: Scene, number: int, turn: Turn, first: First) -> First:
    """Points and segments meet one part."""
    best = first
    ground = scene.ground
    part = scene.body[number]
    swept = swept_by(part, turn)
    flat = side_of(part, TO_FLAT, turn, swept)
    top = side_of(part, TO_TOP, turn, swept)
    right = max(swept.right1, swept.right2)
    k = first_index(scene, min(swept.left1, swept.left2))
    rolls = turn.pivot & KIND_MASK != VERTEX
    passes = not rolls and number == (turn.pivot >> PART_BITS) & PART_MASK
    under = passes and stays_under(ground[k], turn)
    while k < len(ground) - 1 and ground[k].x <= right:
        before = under
        under = passes and stays_under(ground[k + 1], turn)
        if before and under:
            k += 1
            continue
        if rolls:
            best = rolling_closing(
                scene, k, number, flat.faces_down, top.faces_down, turn, swept, best
            )
        else:
            if ground[k].convex:
                if flat.faces_down:
                    best = flat_closing(scene, k, number, TO_FLAT, turn, flat, best)
                if top.faces_down:
                    best = flat_closing(scene, k, number, TO_TOP, turn, top, best)
                best = arcs_closing(scene, k, number, turn, swept, best)
            best = segment_closing(scene, k, number, turn, swept, best)
        k += 1
    return best


def first_closing(scene: Scene, pivot: int, at: At, sense: float, end: float) -> First:
    """First feature that closes within a rotation of ``end`` about a pivot.

    Its feature is -1 if there is none.
    """
    turn = turn_about(scene, pivot, at, sense, end)
    first = First(end, NO_FEATURE)
    for number in range(len(scene.body)):
        first = part_closing(scene, number, turn, first)
    return first
