"""Which feature closes first within a rotation about one contact."""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    CONVEX,
    DISC,
    DISC_1,
    DISC_R,
    E_X,
    E_Z,
    KIND_MASK,
    NO_FEATURE,
    PART,
    PART_BITS,
    PART_MASK,
    POINT,
    POINT_BITS,
    R1,
    R2,
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
from kaidan.contact.kernel.closing import (
    BESIDE,
    FROM_DISC_1,
    FROM_DISC_2,
    TO_ARC_1,
    TO_ARC_2,
    TO_FLAT,
    TO_TOP,
    closing_angle,
    flat_normal,
    separation,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.gaps import gap
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.rotation import carried
from kaidan.contact.kernel.turning_closing import arcs_closing, flat_closing, segment_closing
from kaidan.contact.tables import BodyTable, Four, GroundTable, Pose, Side


def out_of_reach(
    ground: GroundTable, k: int, o_x: float, o_z: float, q_x: float, q_z: float, sense: float,
    lifts: bool,
) -> bool:  # fmt: skip
    """Whether the pivot's own part never meets point k.

    That part lies above its supporting line: what lies below that line, and on the side that is
    lifted (rolling upward: on either side), is never met.
    """
    v_x = ground[k, X] - o_x
    v_z = ground[k, Z] - o_z
    return v_x * q_x + v_z * q_z <= 1e-12 and (lifts or sense * (v_x * q_z - v_z * q_x) > 0.0)


def swept(
    body: BodyTable, part: int, start: Pose, finish: Pose, h_x: float, h_z: float, bend: float
) -> tuple[Four, Four]:
    """Centres of a part's discs at the start of a rotation, and the ranges of x that they sweep.

    Parameters
    ----------
    h_x, h_z, bend
        What it turns about; sagitta of the arc that a centre runs along, over its radius.
    """
    x, z, c0, s0, _, _ = start
    x1, _, c1, s1, _, _ = finish
    a_x = x + c0 * body[part, X1] - s0 * body[part, Z1]
    a_z = z + s0 * body[part, X1] + c0 * body[part, Z1]
    b_x = x + c0 * body[part, X2] - s0 * body[part, Z2]
    b_z = z + s0 * body[part, X2] + c0 * body[part, Z2]
    # chord of each disc's centre, plus the sagitta of its arc
    e_x = x1 + c1 * body[part, X1] - s1 * body[part, Z1]
    sag = bend * (abs(a_x - h_x) + abs(a_z - h_z)) + body[part, R1]
    left1 = min(a_x, e_x) - sag
    right1 = max(a_x, e_x) + sag
    e_x = x1 + c1 * body[part, X2] - s1 * body[part, Z2]
    sag = bend * (abs(b_x - h_x) + abs(b_z - h_z)) + body[part, R2]
    left2 = min(b_x, e_x) - sag
    right2 = max(b_x, e_x) + sag
    return (a_x, a_z, b_x, b_z), (left1, right1, left2, right2)


def side_of(
    body: BodyTable, part: int, piece: int, start: Pose, a_x: float, a_z: float,
    ce: float, se: float,
) -> Side:  # fmt: skip
    """Side of a part at the start of a rotation whose cosine and signed sine are ``ce``, ``se``.

    Returns
    -------
    faces down
        Whether it does so at one end; else it meets nothing: the ground reaches down.
    n_x, n_z
        Its normal.
    level
        How far the pivot lies beyond its line [m].
    """
    _, _, c0, s0, o_x, o_z = start
    n_x, n_z = flat_normal(body, part, piece, c0, s0)
    level = (o_x - a_x) * n_x + (o_z - a_z) * n_z - body[part, R1]
    return n_z < 0.0 or n_z * ce + n_x * se < 0.0, n_x, n_z, level


def rolling_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, pivot: int, free: bool,
    down: bool, falls: bool, start: Pose, finish: Pose, sense: float, end: float,
    moved: Four, levers: Four, turned_to: Four, ranges: Four, best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """Point k or segment k meets a part that rolls: no sinusoid.

    Parameters
    ----------
    free, down, falls
        Whether the part never meets point k; whether its lower and its upper side can.
    start, finish
        x, z, cosine and sine of the inclination, and the point of the pivot, at both ends of the
        rotation by ``end``.
    moved
        Centre of the disc that rolls, its radius, and the way that it rolls.
    levers, turned_to
        From it to the centres of the part's discs, at both ends.

    Returns
    -------
    angle [rad], feature: those given unless one of these closes before.
    """
    x, z, c0, s0, o_x, o_z = start
    x1, z1, c1, s1, f_x, f_z = finish
    a_x, a_z, b_x, b_z = levers
    a1_x, a1_z, b1_x, b1_z = turned_to
    left1, right1, left2, right2 = ranges
    h_x, h_z, radius, rolled = moved
    u_x = ground[k, U_X]
    u_z = ground[k, U_Z]
    here = ground[k, X]
    ahead = ground[k + 1, X]
    free = free or ground[k, CONVEX] == 0.0
    v_x = here - h_x
    v_z = ground[k, Z] - h_z
    for piece in range(FROM_DISC_2 + 1):
        feature = POINT * k + PART * part
        if piece < FROM_DISC_1:
            if free or (piece == TO_FLAT and not down) or (piece == TO_TOP and not falls):
                continue
        else:
            feature += DISC_1 + piece - FROM_DISC_1
            if feature == pivot:
                continue
        # curvature: of a disc's distance as its lever, of a flat's as the vertex's, besides twice
        # the rate at which the disc that rolls moves on
        bulge = 0.0
        bulge_1 = 0.0
        if piece == TO_ARC_1 or piece == FROM_DISC_1:  # noqa: SIM109
            if here > right1 or (here if piece == TO_ARC_1 else ahead) < left1:
                continue
            bend = math.sqrt(a_x * a_x + a_z * a_z)
            bulge = u_x * a_z - u_z * a_x
            bulge_1 = u_x * a1_z - u_z * a1_x
        elif piece > TO_TOP:
            if here > right2 or (here if piece == TO_ARC_2 else ahead) < left2:
                continue
            bend = math.sqrt(b_x * b_x + b_z * b_z)
            bulge = u_x * b_z - u_z * b_x
            bulge_1 = u_x * b1_z - u_z * b1_x
        else:
            bend = 2.0 * radius + rolled + math.sqrt(v_x * v_x + v_z * v_z)
        value, rate = separation(ground, body, k, part, piece, x, z, c0, s0, o_x, o_z, sense)
        if value > 0.0 and value + best * (rate - 0.5 * bend * best) > 0.0:
            continue
        if value < -BESIDE and TO_TOP < piece < FROM_DISC_1:
            continue
        far, far_rate = separation(ground, body, k, part, piece, x1, z1, c1, s1, f_x, f_z, sense)
        if piece >= FROM_DISC_1:
            if min(bulge, bulge_1) >= 0.0 and far >= -PENETRATED:
                continue  # concave, and open at the end
            if max(bulge, bulge_1) <= 0.0:
                if value <= -BESIDE:
                    continue  # convex, and on the other side at the start
                bend = 0.0
        at = closing_angle(
            ground, body, k, part, piece, pivot, start, finish, sense, end, best,
            value, rate, far, far_rate, bend,
        )  # fmt: skip
        if at < best:
            best = at
            which = feature
    return best, which


def part_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, pivot: int, lifts: bool,
    flat: Side, top: Side, start: Pose, finish: Pose, sense: float, end: float,
    ce: float, se: float, moved: Four, q_x: float, q_z: float, centres: Four, levers: Four,
    turned_to: Four, ranges: Four, best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """Points and segments from k on meet one part.

    Parameters
    ----------
    lifts, q_x, q_z
        See :func:`out_of_reach`.
    flat, top
        Its lower and its upper side, see :func:`side_of`.
    start, finish, moved, levers, turned_to
        See :func:`rolling_closing`.
    ce, se
        Cosine and sine of ``end``.
    centres, ranges
        See :func:`swept`.

    Returns
    -------
    angle [rad], feature: those given unless one of these closes before.
    """
    x, z, c0, s0, o_x, o_z = start
    right = max(ranges[1], ranges[3])
    down, n_x, n_z, flat_level = flat
    falls, t_x, t_z, top_level = top
    rolls = pivot & KIND_MASK != VERTEX
    own = part == (pivot >> PART_BITS) & PART_MASK
    at_k = pivot >> POINT_BITS
    while k < ground.shape[0] - 1 and ground[k, X] <= right:
        free = own and out_of_reach(ground, k, o_x, o_z, q_x, q_z, sense, lifts)
        if free and out_of_reach(ground, k + 1, o_x, o_z, q_x, q_z, sense, lifts):
            k += 1
            continue
        if rolls:
            best, which = rolling_closing(
                ground, body, k, part, pivot, free, down, falls, start, finish, sense, end,
                moved, levers, turned_to, ranges, best, which,
            )  # fmt: skip
        else:
            if not free and ground[k, CONVEX] == 1.0 and not (k == at_k and own):
                if down:
                    best, which = flat_closing(
                        ground, body, k, part, TO_FLAT, pivot, x, z, c0, s0, o_x, o_z, sense,
                        ce, se, n_x, n_z, flat_level, best, which,
                    )  # fmt: skip
                if falls:
                    best, which = flat_closing(
                        ground, body, k, part, TO_TOP, pivot, x, z, c0, s0, o_x, o_z, sense,
                        ce, se, t_x, t_z, top_level, best, which,
                    )  # fmt: skip
                best, which = arcs_closing(
                    ground, body, k, part, o_x, o_z, sense, ce, se, centres, best, which
                )
            best, which = segment_closing(
                ground, body, k, part, pivot, o_x, o_z, sense, ce, se, centres, ranges, best, which
            )
        k += 1
    return best, which


def first_closing(
    ground: GroundTable,
    body: BodyTable,
    pivot: int,
    x: float,
    z: float,
    phi: float,
    sense: float,
    end: float,
    hint: int,
) -> tuple[int, float, int]:
    """First feature that closes within a rotation of ``end`` about a pivot.

    Returns
    -------
    feature (-1: none), angle [rad], hint for the next call
    """
    c0 = math.cos(phi)
    s0 = math.sin(phi)
    ce = math.cos(end)
    se = math.sin(end)
    x1, z1 = carried(ground, body, pivot, x, z, c0, s0, sense * end, ce, sense * se)
    c1 = c0 * ce - s0 * sense * se
    s1 = s0 * ce + c0 * sense * se
    _, q_x, q_z, o_x, o_z = gap(ground, body, pivot, x, z, c0, s0)
    rolls = pivot & KIND_MASK != VERTEX
    own = (pivot >> PART_BITS) & PART_MASK
    at_k = pivot >> POINT_BITS
    f_x = o_x
    f_z = o_z
    radius = 0.0
    lifts = False
    if rolls:
        # the part's other end goes up, away from the segment, all the way
        out = sense * (1.0 if pivot & KIND_MASK == DISC_1 else -1.0)
        along = out * (body[own, E_X] * ground[at_k, U_X] + body[own, E_Z] * ground[at_k, U_Z])
        up = out * (body[own, E_X] * ground[at_k, U_Z] - body[own, E_Z] * ground[at_k, U_X])
        lifts = c0 * along + s0 * up > 0.0 and c1 * along + s1 * up > 0.0
        radius = body[own, DISC * ((pivot & KIND_MASK) - DISC_1) + DISC_R]
        f_x -= sense * radius * end * ground[at_k, U_X]
        f_z -= sense * radius * end * ground[at_k, U_Z]
    h_x = o_x + radius * q_x
    h_z = o_z + radius * q_z
    moved = (h_x, h_z, radius, end * radius)
    start = (x, z, c0, s0, o_x, o_z)
    finish = (x1, z1, c1, s1, f_x, f_z)
    bend = 0.125 * end * end
    n = ground.shape[0]
    which = NO_FEATURE
    best = end
    new_hint = n
    for part in range(body.shape[0]):
        centres, ranges = swept(body, part, start, finish, h_x, h_z, bend)
        a_x, a_z, b_x, b_z = centres
        flat = side_of(body, part, TO_FLAT, start, a_x, a_z, ce, sense * se)
        top = side_of(body, part, TO_TOP, start, a_x, a_z, ce, sense * se)
        levers = (a_x - h_x, a_z - h_z, b_x - h_x, b_z - h_z)
        turned_to = (
            ce * levers[0] - sense * se * levers[1], ce * levers[1] + sense * se * levers[0],
            ce * levers[2] - sense * se * levers[3], ce * levers[3] + sense * se * levers[2],
        )  # fmt: skip
        k = first_index(ground, min(ranges[0], ranges[2]), hint)
        hint = k
        new_hint = min(new_hint, k)
        best, which = part_closing(
            ground, body, k, part, pivot, lifts, flat, top, start, finish, sense, end, ce, se,
            moved, q_x, q_z, centres, levers, turned_to, ranges, best, which,
        )  # fmt: skip
    return which, best, new_hint
