"""At which angle of a rotation one smooth piece of a gap closes.

Within one rotation every gap is a sinusoid of the angle (plus a linear term if the pivot rolls),
piece by piece: vertex to flat, vertex to end disc, end disc to segment. A piece can close within a
rotation of ``end`` only if it is negative there, or if it falls at the start and grows at the end;
all others are passed over after one look at both ends.
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    COSINE,
    DISC,
    DISC_1,
    DISC_R,
    DISC_X,
    DISC_Z,
    E_X,
    E_Z,
    KIND_MASK,
    LENGTH,
    PART,
    PART_BITS,
    PART_MASK,
    POINT,
    POINT_BITS,
    R1,
    SIDE,
    SINE,
    U_X,
    U_Z,
    VERTEX,
    X1,
    Z1,
    X,
    Z,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.gaps import on_flat
from kaidan.contact.kernel.rotation import NEVER, carried
from kaidan.contact.tables import BodyTable, GroundTable

#: A gap that falls by less than this per radian [m] is one contact under two names, at rest.
RESTING = 1e-9
#: A vertex beyond the line of a flat, or a disc below the line of a segment, by more than this [m]
#: at the start is not on its way to meet it: it has passed beside it.
BESIDE = 0.01
#: A piece of a gap that falls at one end of a turn this small and grows at the other is convex in
#: between [rad]: its curvature changes sign a right angle away from a minimum if nothing rolls.
CONVEX_WITHIN = 0.4
#: Smooth pieces of a gap: a vertex to the flat, to the end discs' arcs; end discs to a segment.
TO_FLAT, TO_ARC_1, TO_ARC_2, FROM_DISC_1, FROM_DISC_2 = range(5)


def separation(
    ground: GroundTable,
    body: BodyTable,
    k: int,
    part: int,
    piece: int,
    x: float,
    z: float,
    c: float,
    s: float,
    o_x: float,
    o_z: float,
    sense: float,
) -> tuple[float, float]:
    """One smooth piece of a gap, and its change with the angle turned about (o_x, o_z).

    ``piece``: vertex k to the line of the flat or to an end disc, end disc to the line of segment
    k. Positive outside; 1 rad in the given sense.
    """
    g_x = ground[k, X]
    g_z = ground[k, Z]
    if piece == TO_FLAT:
        e_x = body[part, E_X]
        e_z = body[part, E_Z]
        side = body[part, SIDE]
        sine = body[part, SINE]
        cosine = body[part, COSINE]
        b_x = sine * e_x + cosine * (e_z * side)
        b_z = sine * e_z - cosine * e_x * side
        n_x = c * b_x - s * b_z
        n_z = s * b_x + c * b_z
        d_x = body[part, X1]
        d_z = body[part, Z1]
        v_x = g_x - x - c * d_x + s * d_z
        v_z = g_z - z - s * d_x - c * d_z
        return (
            v_x * n_x + v_z * n_z - body[part, R1],
            sense * ((g_z - o_z) * n_x - (g_x - o_x) * n_z),
        )
    j = DISC
    if piece == TO_ARC_1 or piece == FROM_DISC_1:  # noqa: SIM109
        j = 0
    d_x = body[part, j + DISC_X]
    d_z = body[part, j + DISC_Z]
    r_x = x + c * d_x - s * d_z
    r_z = z + s * d_x + c * d_z
    if piece >= FROM_DISC_1:
        u_x = ground[k, U_X]
        u_z = ground[k, U_Z]
        return (
            u_x * (r_z - g_z) - u_z * (r_x - g_x) - body[part, j + DISC_R],
            sense * ((r_x - o_x) * u_x + (r_z - o_z) * u_z),
        )
    r_x -= g_x
    r_z -= g_z
    rho = math.sqrt(r_x * r_x + r_z * r_z)
    return (
        rho - body[part, j + DISC_R],
        sense * ((g_x - o_x) * r_z - (g_z - o_z) * r_x) / max(rho, 1e-15),
    )


def crossing_angle(
    level: float, even: float, rate: float, cosine: float, sine: float, deep: float
) -> float:
    """Angle at which level + even cos + rate sin goes down through zero, 1e9 if not soon.

    ``cosine`` and ``sine`` of the turn looked at: it crosses within it if it is negative at the
    end, or falls at the start, grows at the end and its least value, level - hypot(even, rate), is
    negative. Values above ``-deep`` are not.
    """
    if level + even * cosine + rate * sine >= -deep and (
        rate >= -RESTING
        or rate * cosine - even * sine <= 0.0
        or (level + deep >= 0.0 and (level + deep) * (level + deep) >= even * even + rate * rate)
    ):
        return NEVER
    start = level + even
    if start <= -0.5 * deep and rate < -RESTING:
        return 0.0 if start > -deep * (BESIDE / PENETRATED) else NEVER
    rho = math.sqrt(even * even + rate * rate)
    if level <= -rho:  # never positive; a feature through the pivot itself is one of these
        return NEVER
    angle = math.atan2(-rate, -even) - math.acos(max(-1.0, min(1.0, level / rho)))
    if angle < -1e-6:
        angle += 2.0 * math.pi
    return max(angle, 0.0)


def closing_angle(
    ground: GroundTable,
    body: BodyTable,
    k: int,
    part: int,
    piece: int,
    pivot: int,
    x: float,
    z: float,
    c0: float,
    s0: float,
    o_x: float,
    o_z: float,
    sense: float,
    end: float,
    g0: float,
    rate0: float,
    g1: float,
    rate1: float,
    steepest: float,
) -> float:
    """First angle within ``end`` at which a piece of a gap closes, 1e9 if it does not.

    For a pivot that rolls. Values and rates at both ends are given, and a bound on the
    rate. A minimum inside is looked for until it is negative or the bound rules that out; then
    Newton within the bracket.
    """
    floor = -0.5 * PENETRATED
    roll = 0.0
    if pivot & KIND_MASK != VERTEX:
        roll = (
            -sense
            * body[(pivot >> PART_BITS) & PART_MASK, DISC * ((pivot & KIND_MASK) - DISC_1) + DISC_R]
        )
    u_x = ground[pivot >> POINT_BITS, U_X] * roll
    u_z = ground[pivot >> POINT_BITS, U_Z] * roll
    lo = 0.0
    hi = end
    if g1 >= -PENETRATED:
        if rate0 >= -RESTING or rate1 <= 0.0:
            return NEVER
        if g0 <= floor:
            return 0.0
        low = g0
        high = g1
        for turn in range(60):
            if 0.5 * (low + high - steepest * (hi - lo)) > 0.0 or hi - lo < 1e-9:
                return NEVER
            # near a minimum it is convex: the tangents at both ends meet below it
            meet = (high - low - rate1 * (hi - lo)) / (rate0 - rate1)
            if hi - lo < CONVEX_WITHIN and low + rate0 * meet > 0.0:
                return NEVER
            meet = (lo * rate1 - hi * rate0) / (rate1 - rate0)
            if turn % 3 == 2 or not (lo < meet < hi):
                meet = 0.5 * (lo + hi)
            c = math.cos(meet)
            s = sense * math.sin(meet)
            x1, z1 = carried(ground, body, pivot, x, z, c0, s0, sense * meet, c, s)
            value, rate = separation(
                ground, body, k, part, piece, x1, z1, c0 * c - s0 * s, s0 * c + c0 * s,
                o_x + meet * u_x, o_z + meet * u_z, sense,
            )  # fmt: skip
            if value < -PENETRATED:
                hi = meet
                lo = 0.0
                g1 = value
                break
            if rate < 0.0:
                lo = meet
                rate0 = rate
                low = value
            else:
                hi = meet
                rate1 = rate
                high = value
        if g1 >= -PENETRATED:
            return NEVER
    # secant to begin with, then Newton from the newest point
    at = hi * (g0 - floor) / (g0 - g1) if g0 > floor else 0.5 * hi
    for _ in range(60):
        c = math.cos(at)
        s = sense * math.sin(at)
        x1, z1 = carried(ground, body, pivot, x, z, c0, s0, sense * at, c, s)
        value, rate = separation(
            ground, body, k, part, piece, x1, z1, c0 * c - s0 * s, s0 * c + c0 * s,
            o_x + at * u_x, o_z + at * u_z, sense,
        )  # fmt: skip
        value -= floor
        if value > 0.0:
            lo = at
        else:
            hi = at
            if value > floor:
                break
        if hi - lo < 1e-13:
            break
        # aim a hair beyond, so that the bracket closes from the far side
        at = at - (value - 0.5 * floor) / rate if rate < 0.0 else 0.5 * (lo + hi)
        if not (lo < at < hi):
            at = 0.5 * (lo + hi)
    return hi


def on_piece(
    ground: GroundTable,
    body: BodyTable,
    k: int,
    part: int,
    piece: int,
    x: float,
    z: float,
    c: float,
    s: float,
) -> bool:
    """Whether the foot lies on the flat or the segment, not beyond."""
    if piece == TO_FLAT:
        return on_flat(ground, body, POINT * k + PART * part, x, z, c, s)
    if piece < FROM_DISC_1:
        return True
    j = DISC * (piece - FROM_DISC_1)
    r_x = x + c * body[part, j + DISC_X] - s * body[part, j + DISC_Z] - ground[k, X]
    r_z = z + s * body[part, j + DISC_X] + c * body[part, j + DISC_Z] - ground[k, Z]
    foot = r_x * ground[k, U_X] + r_z * ground[k, U_Z]
    return bool(0.0 <= foot <= ground[k, LENGTH])
