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
    LENGTH,
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
    crossing_angle,
    flat_normal,
    on_piece,
    separation,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.gaps import gap
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.rotation import carried
from kaidan.contact.tables import BodyTable, Four, GroundTable, Pose

#: A pivot this close to an end disc [m] lies on it: five times the gap at which a rotation ends.
#: One that lies farther off closes with the segment sqrt(2 off / R) later, at a gap of zero.
SAME_ARC = 1e-11
#: Points that the flat meets within this angle of one another [rad] lie in line.
IN_LINE = 1e-10


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


def flat_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, piece: int, pivot: int,
    x: float, z: float, c0: float, s0: float, o_x: float, o_z: float, sense: float,
    ce: float, se: float, n_x: float, n_z: float, level: float, best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """Point k meets a flat of a part that turns about (o_x, o_z).

    Returns
    -------
    angle [rad], feature: those given unless it closes before.
    """
    v_x = ground[k, X] - o_x
    v_z = ground[k, Z] - o_z
    even = v_x * n_x + v_z * n_z
    at = crossing_angle(level, even, sense * (v_z * n_x - v_x * n_z), ce, se, PENETRATED)
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
        at = crossing_angle(level, even, rate, ce, se, PENETRATED)
        if at < best:
            # along the segment: the centre, turned
            foot = (
                math.cos(at) * (r_x * u_x + r_z * u_z)
                - sense * math.sin(at) * even
                - v_x * u_x
                - v_z * u_z
            )
            if foot >= 0.0 and foot <= ground[k, LENGTH]:
                best = at
                which = POINT * k + PART * part + DISC_1 + disc
    return best, which


def rolling_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, pivot: int, free: bool,
    down: bool, top: bool, start: Pose, finish: Pose, sense: float, end: float,
    moved: Four, levers: Four, turned_to: Four, ranges: Four, best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """Point k or segment k meets a part that rolls: no sinusoid.

    Parameters
    ----------
    free, down, top
        Whether the part never meets point k; whether its flat and its other side can.
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
            if free or (piece == TO_FLAT and not down) or (piece == TO_TOP and not top):
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
        a_x = x + c0 * body[part, X1] - s0 * body[part, Z1]
        a_z = z + s0 * body[part, X1] + c0 * body[part, Z1]
        b_x = x + c0 * body[part, X2] - s0 * body[part, Z2]
        b_z = z + s0 * body[part, X2] + c0 * body[part, Z2]
        centres = (a_x, a_z, b_x, b_z)
        # a side that faces up from end to end meets nothing: the ground reaches down
        n_x, n_z = flat_normal(body, part, TO_FLAT, c0, s0)
        t_x, t_z = flat_normal(body, part, TO_TOP, c0, s0)
        down = n_z < 0.0 or n_z * ce + n_x * sense * se < 0.0
        top = t_z < 0.0 or t_z * ce + t_x * sense * se < 0.0
        flat_level = (o_x - a_x) * n_x + (o_z - a_z) * n_z - body[part, R1]
        top_level = (o_x - a_x) * t_x + (o_z - a_z) * t_z - body[part, R1]
        # x range swept: chord of each disc's centre, plus the sagitta of its arc
        e_x = x1 + c1 * body[part, X1] - s1 * body[part, Z1]
        sag = bend * (abs(a_x - h_x) + abs(a_z - h_z)) + body[part, R1]
        left1 = min(a_x, e_x) - sag
        right1 = max(a_x, e_x) + sag
        e_x = x1 + c1 * body[part, X2] - s1 * body[part, Z2]
        sag = bend * (abs(b_x - h_x) + abs(b_z - h_z)) + body[part, R2]
        left2 = min(b_x, e_x) - sag
        right2 = max(b_x, e_x) + sag
        ranges = (left1, right1, left2, right2)
        levers = (a_x - h_x, a_z - h_z, b_x - h_x, b_z - h_z)
        turned_to = (
            ce * levers[0] - sense * se * levers[1], ce * levers[1] + sense * se * levers[0],
            ce * levers[2] - sense * se * levers[3], ce * levers[3] + sense * se * levers[2],
        )  # fmt: skip
        right = max(right1, right2)
        k = first_index(ground, min(left1, left2), hint)
        hint = k
        if k < new_hint:
            new_hint = k
        while k < n - 1 and ground[k, X] <= right:
            free = part == own and out_of_reach(ground, k, o_x, o_z, q_x, q_z, sense, lifts)
            if free and out_of_reach(ground, k + 1, o_x, o_z, q_x, q_z, sense, lifts):
                k += 1
                continue
            if rolls:
                best, which = rolling_closing(
                    ground, body, k, part, pivot, free, down, top, start, finish, sense, end,
                    moved, levers, turned_to, ranges, best, which,
                )  # fmt: skip
            else:
                if not free and ground[k, CONVEX] == 1.0 and not (k == at_k and part == own):
                    if down:
                        best, which = flat_closing(
                            ground, body, k, part, TO_FLAT, pivot, x, z, c0, s0, o_x, o_z, sense,
                            ce, se, n_x, n_z, flat_level, best, which,
                        )  # fmt: skip
                    if top:
                        best, which = flat_closing(
                            ground, body, k, part, TO_TOP, pivot, x, z, c0, s0, o_x, o_z, sense,
                            ce, se, t_x, t_z, top_level, best, which,
                        )  # fmt: skip
                    best, which = arcs_closing(
                        ground, body, k, part, o_x, o_z, sense, ce, se, centres, best, which
                    )
                best, which = segment_closing(
                    ground, body, k, part, pivot, o_x, o_z, sense, ce, se,
                    centres, ranges, best, which,
                )  # fmt: skip
            k += 1
    return which, best, new_hint
