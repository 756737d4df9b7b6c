"""Which feature closes first within a rotation about one contact."""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    CONVEX,
    DISC,
    DISC_1,
    DISC_R,
    FLAT,
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
from kaidan.contact.kernel.gaps import contact_point, gap
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.rotation import carried
from kaidan.contact.kernel.turning_closing import arcs_closing, flat_closing, segment_closing
from kaidan.contact.tables import BodyTable, Four, GroundTable, Line, Pose, Side


def turning_about(
    ground: GroundTable, body: BodyTable, pivot: int, o_x: float, o_z: float, end: float
) -> Four:
    """What a robot turns about: centre of the end that rolls, its radius, the way that it rolls.

    A vertex has no radius.  ``o``: the point of the pivot.
    """
    kind = pivot & KIND_MASK
    if kind == VERTEX:
        return o_x, o_z, 0.0, 0.0
    radius = body[(pivot >> PART_BITS) & PART_MASK, DISC * (kind - DISC_1) + DISC_R]
    k = pivot >> POINT_BITS
    return o_x - radius * ground[k, U_Z], o_z + radius * ground[k, U_X], radius, radius * end


def swept(
    body: BodyTable, part: int, start: Pose, finish: Pose, h_x: float, h_z: float, end: float
) -> tuple[Four, Four]:
    """Centres of a part's discs at the start of a rotation, and the ranges of x that they sweep.

    ``h``: what it turns about.
    """
    x, z, c0, s0, _, _ = start
    x1, _, c1, s1, _, _ = finish
    a_x = x + c0 * body[part, X1] - s0 * body[part, Z1]
    a_z = z + s0 * body[part, X1] + c0 * body[part, Z1]
    b_x = x + c0 * body[part, X2] - s0 * body[part, Z2]
    b_z = z + s0 * body[part, X2] + c0 * body[part, Z2]
    # chord of each disc's centre, plus the sagitta of its arc, over the radius of the arc
    bend = 0.125 * end * end
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
    foot
        Where along it the pivot lies, from its first end [m].
    """
    _, _, c0, s0, o_x, o_z = start
    n_x, n_z = flat_normal(body, part, piece, c0, s0)
    level = (o_x - a_x) * n_x + (o_z - a_z) * n_z - body[part, R1]
    foot = turning_side(body, part, piece) * ((o_z - a_z) * n_x - (o_x - a_x) * n_z)
    return n_z < 0.0 or n_z * ce + n_x * se < 0.0, n_x, n_z, level, foot


def curvature(piece: int, g_x: float, g_z: float, levers: Four, about: Four) -> float:
    """Bound on the curvature of one smooth piece of a gap, for a pivot that rolls [m/rad^2].

    Of a disc's distance the lever of its centre; of a flat's that of the vertex, ``g``, besides
    twice the rate at which the disc that rolls moves on.
    """
    if piece <= TO_TOP:
        h_x, h_z, radius, rolled = about
        v_x = g_x - h_x
        v_z = g_z - h_z
        return 2.0 * radius + rolled + math.sqrt(v_x * v_x + v_z * v_z)
    a_x, a_z, b_x, b_z = levers
    if piece == TO_ARC_1 or piece == FROM_DISC_1:  # noqa: SIM109
        return math.sqrt(a_x * a_x + a_z * a_z)
    return math.sqrt(b_x * b_x + b_z * b_z)


def rolling_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, pivot: int,
    down: bool, falls: bool, start: Pose, finish: Pose, sense: float, end: float,
    about: Four, levers: Four, ranges: Four, best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """Point k or segment k meets a part that rolls: no sinusoid.

    Parameters
    ----------
    down, falls
        Whether its lower and its upper side can meet a point.
    start, finish
        x, z, cosine and sine of the inclination, and the point of the pivot, at both ends of the
        rotation by ``end``.
    about
        See :func:`turning_about`.
    levers
        From there to the centres of the part's discs.

    Returns
    -------
    angle [rad], feature: those given unless one of these closes before.
    """
    x, z, c0, s0, o_x, o_z = start
    x1, z1, c1, s1, f_x, f_z = finish
    left1, right1, left2, right2 = ranges
    here = ground[k, X]
    ahead = ground[k + 1, X]
    hollow = ground[k, CONVEX] == 0.0
    for piece in range(FROM_DISC_2 + 1):
        feature = POINT * k + PART * part
        if piece < FROM_DISC_1:
            if hollow or (piece == TO_FLAT and not down) or (piece == TO_TOP and not falls):
                continue
        else:
            feature += DISC_1 + piece - FROM_DISC_1
            if feature == pivot:
                continue
        if piece == TO_ARC_1 or piece == FROM_DISC_1:  # noqa: SIM109
            if here > right1 or (here if piece == TO_ARC_1 else ahead) < left1:
                continue
        elif piece > TO_TOP and (here > right2 or (here if piece == TO_ARC_2 else ahead) < left2):
            continue
        bend = curvature(piece, here, ground[k, Z], levers, about)
        value, rate = separation(ground, body, k, part, piece, x, z, c0, s0, o_x, o_z, sense)
        if value > 0.0 and value + best * (rate - 0.5 * bend * best) > 0.0:
            continue
        if piece <= TO_TOP or piece >= FROM_DISC_1:
            length = body[part, FLAT] if piece <= TO_TOP else ground[k, LENGTH]
            foot = foot_on(ground, body, k, part, piece, x, z, c0, s0)
            later = foot_on(ground, body, k, part, piece, x1, z1, c1, s1)
            if stays_beside(foot, later, 0.125 * bend * end * end, length):
                continue
        far, far_rate = separation(ground, body, k, part, piece, x1, z1, c1, s1, f_x, f_z, sense)
        at = closing_angle(
            ground, body, k, part, piece, pivot, start, finish, sense, end, best,
            value, rate, far, far_rate, bend,
        )  # fmt: skip
        if at < best:
            best = at
            which = feature
    return best, which


def stays_under(
    ground: GroundTable, k: int, o_x: float, o_z: float, ce: float, se: float, line: Line
) -> bool:
    """Whether point k stays under a line through (o_x, o_z) as long as that turns about there.

    The part of the pivot lies over its supporting line there, so that it meets nothing that stays
    under it. What is over it by PENETRATED / 2 at most before and after a turn by 120 deg or less
    is so by PENETRATED at most on the way: its height is a sinusoid, and half of the greatest one
    is reached 60 deg before and after.
    """
    n_x, n_z, height = line
    v_x = ground[k, X] - o_x
    v_z = ground[k, Z] - o_z
    up = v_x * n_x + v_z * n_z
    most = min(height, 0.0) + 0.5 * PENETRATED
    return bool(up <= most and up * ce + (v_z * n_x - v_x * n_z) * se <= most)


def part_closing(
    ground: GroundTable, body: BodyTable, k: int, part: int, pivot: int,
    flat: Side, top: Side, start: Pose, finish: Pose, sense: float, end: float,
    ce: float, se: float, line: Line, about: Four, centres: Four, levers: Four, ranges: Four,
    best: float, which: int,
) -> tuple[float, int]:  # fmt: skip
    """Points and segments from k on meet one part.

    Parameters
    ----------
    flat, top
        Its lower and its upper side, see :func:`side_of`.
    start, finish, about, levers
        See :func:`rolling_closing`.
    ce, se
        Cosine and sine of ``end``.
    line
        Supporting line of the pivot's part: its normal, and its height over the pivot.
    centres, ranges
        See :func:`swept`.

    Returns
    -------
    angle [rad], feature: those given unless one of these closes before.
    """
    _, _, _, _, o_x, o_z = start
    right = max(ranges[1], ranges[3])
    down, _, _, _, _ = flat
    falls, _, _, _, _ = top
    rolls = pivot & KIND_MASK != VERTEX
    passes = not rolls and part == (pivot >> PART_BITS) & PART_MASK
    under = passes and stays_under(ground, k, o_x, o_z, ce, sense * se, line)
    while k < ground.shape[0] - 1 and ground[k, X] <= right:
        before = under
        under = passes and stays_under(ground, k + 1, o_x, o_z, ce, sense * se, line)
        if before and under:
            k += 1
            continue
        if rolls:
            best, which = rolling_closing(
                ground, body, k, part, pivot, down, falls, start, finish, sense, end, about,
                levers, ranges, best, which,
            )  # fmt: skip
        else:
            if ground[k, CONVEX] == 1.0:
                if down:
                    best, which = flat_closing(
                        ground, body, k, part, TO_FLAT, pivot, start, sense, ce, se, flat,
                        best, which,
                    )  # fmt: skip
                if falls:
                    best, which = flat_closing(
                        ground, body, k, part, TO_TOP, pivot, start, sense, ce, se, top,
                        best, which,
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
    c0: float,
    s0: float,
    sense: float,
    end: float,
    hint: int,
) -> tuple[int, float, int]:
    """First feature that closes within a rotation of ``end`` about a pivot.

    Returns
    -------
    feature (-1: none), angle [rad], hint for the next call
    """
    ce = math.cos(end)
    se = math.sin(end)
    x1, z1 = carried(ground, body, pivot, x, z, c0, s0, sense * end, ce, sense * se)
    c1 = c0 * ce - s0 * sense * se
    s1 = s0 * ce + c0 * sense * se
    height, q_x, q_z, o_x, o_z = gap(ground, body, pivot, x, z, c0, s0)
    f_x, f_z = contact_point(ground, body, pivot, x1, z1, c1, s1)
    about = turning_about(ground, body, pivot, o_x, o_z, end)
    h_x, h_z, _, _ = about
    start = (x, z, c0, s0, o_x, o_z)
    finish = (x1, z1, c1, s1, f_x, f_z)
    n = ground.shape[0]
    which = NO_FEATURE
    best = end
    new_hint = n
    for part in range(body.shape[0]):
        centres, ranges = swept(body, part, start, finish, h_x, h_z, end)
        a_x, a_z, b_x, b_z = centres
        flat = side_of(body, part, TO_FLAT, start, a_x, a_z, ce, sense * se)
        top = side_of(body, part, TO_TOP, start, a_x, a_z, ce, sense * se)
        levers = (a_x - h_x, a_z - h_z, b_x - h_x, b_z - h_z)
        k = first_index(ground, min(ranges[0], ranges[2]), hint)
        hint = k
        new_hint = min(new_hint, k)
        best, which = part_closing(
            ground, body, k, part, pivot, flat, top, start, finish, sense, end, ce, se,
            (q_x, q_z, height), about, centres, levers, ranges, best, which,
        )  # fmt: skip
    return which, best, new_hint
