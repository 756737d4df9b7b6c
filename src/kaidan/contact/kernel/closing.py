"""At which angle of a rotation one smooth piece of a gap closes.

Within one rotation every gap is smooth in the angle piece by piece: vertex to flat, vertex to end
disc, end disc to segment. About a vertex each piece is a sinusoid, solved in closed form. About a
disc that rolls it has linear terms besides, and may fall, grow and fall again; there a bound on its
curvature says how far the robot may turn before the piece can close.
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    COSINE,
    DISC,
    DISC_R,
    DISC_X,
    DISC_Z,
    E_X,
    E_Z,
    LENGTH,
    PART,
    POINT,
    R1,
    SIDE,
    SINE,
    U_X,
    U_Z,
    X1,
    Z1,
    X,
    Z,
)
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.gaps import is_above, on_flat
from kaidan.contact.kernel.rotation import NEVER, carried
from kaidan.contact.tables import BodyTable, GroundTable, Pose

#: A gap that falls by less than this per radian [m] is one contact under two names, at rest.
RESTING = 1e-9
#: A vertex beyond the line of a flat, or a disc below the line of a segment, by more than this [m]
#: at the start is not on its way to meet it: it has passed beside it.
BESIDE = 0.01
#: Step in which a piece that touches, or all but touches, is followed [rad]: with levers of some
#: metres it sinks by less than `PENETRATED` between two of them.
FINEST = 1e-6
#: Smooth pieces of a gap: a vertex to the flat, to its mirror image on the part's other side, to
#: the end discs' arcs; end discs to a segment.
TO_FLAT, TO_TOP, TO_ARC_1, TO_ARC_2, FROM_DISC_1, FROM_DISC_2 = range(6)


def turning_side(body: BodyTable, part: int, piece: int) -> float:
    """+1 if a flat's normal, turned nose up, leads along it from its first end; -1: to it."""
    return float(-body[part, SIDE] if piece == TO_TOP else body[part, SIDE])


def flat_normal(body: BodyTable, part: int, piece: int, c: float, s: float) -> tuple[float, float]:
    """Outward normal of a part's flat, or of its mirror image (`TO_TOP`)."""
    side = turning_side(body, part, piece)
    e_x = body[part, E_X]
    e_z = body[part, E_Z] * side
    b_x = body[part, SINE] * e_x + body[part, COSINE] * e_z
    b_z = body[part, SINE] * body[part, E_Z] - body[part, COSINE] * e_x * side
    return c * b_x - s * b_z, s * b_x + c * b_z


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
    if piece <= TO_TOP:
        n_x, n_z = flat_normal(body, part, piece, c, s)
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
    if start <= 0.0 and rate < -RESTING:
        return 0.0 if start > -deep * (BESIDE / PENETRATED) else NEVER
    rho = math.sqrt(even * even + rate * rate)
    if level <= -rho:  # never positive; a feature through the pivot itself is one of these
        return NEVER
    angle = math.atan2(-rate, -even) - math.acos(max(-1.0, min(1.0, level / rho)))
    if angle < -1e-6:
        angle += 2.0 * math.pi
    return max(angle, 0.0)


def crossing_angle_on(
    level: float, even: float, rate: float, cosine: float, sine: float,
    length: float, offset: float, ahead: float,
) -> float:  # fmt: skip
    """:func:`crossing_angle` to a flat or a segment; 1e9 too if the foot stays beside it.

    Parameters
    ----------
    level, even, rate, cosine, sine
        See :func:`crossing_angle`.
    length
        Of the flat or the segment [m].
    offset, ahead
        The foot runs along an arc: offset + ahead (rate cos - even sin), ``ahead`` 1 or -1.

    Notes
    -----
    Sagitta of an arc by the angle a, of radius r = hypot(even, rate), seen from any side::

        r (1 - cos(a/2)) = r (1 - cos a) / (2 + 2 cos(a/2)) <= (|even| + |rate|) (1 - cos a) / 2
    """
    sagitta = 0.5 * (1.0 - cosine) * (abs(even) + abs(rate))
    later = offset + ahead * (rate * cosine - even * sine)
    if stays_beside(offset + ahead * rate, later, sagitta, length):
        return NEVER
    return crossing_angle(level, even, rate, cosine, sine, PENETRATED)


def closing_angle(
    ground: GroundTable, body: BodyTable, k: int, part: int, piece: int, pivot: int,
    start: Pose, finish: Pose, sense: float, end: float, before: float,
    value: float, rate: float, far: float, far_rate: float, bend: float,
) -> float:  # fmt: skip
    """First angle before another at which a piece of a gap closes, 1e9 if it does not.

    For a pivot that rolls. From a look at the gap g and its rate g' it stays above the parabola
    g + g' t - K t^2 / 2, K bounding its curvature: nothing closes before the parabola does, and
    there the next look is taken, Newton's method from the safe side. If the parabola from the end
    meets it above zero, nothing closes. A vertex beyond the line of a flat, or a disc below the
    line of a segment, is followed in the same way until it is back: it has passed beside.

    Parameters
    ----------
    start, finish
        x, z, cosine and sine of the inclination, and the point of the pivot, at both ends of the
        rotation by ``end``.
    before
        Angle at which something else closes [rad].
    value, rate, far, far_rate
        Gap [m] and its change [m/rad] at both ends.
    bend
        K [m/rad^2]; for an arc, from below only.
    """
    x, z, c0, s0, o_x, o_z = start
    _, _, _, _, f_x, f_z = finish
    outside = value > -BESIDE
    y_x, y_z, c, s = x, z, c0, s0
    at = 0.0
    while True:
        if value > -0.5 * PENETRATED:
            outside = True
        elif outside and rate < -RESTING:
            if on_piece(ground, body, k, part, piece, y_x, y_z, c, s):
                return at
            outside = False
        room = max(value + 0.75 * PENETRATED if outside else -value, 0.25 * PENETRATED)
        slope = rate if outside else -rate
        left = before - at
        if room + left * (slope - 0.5 * bend * left) > 0.0:
            return NEVER
        if outside and far >= -PENETRATED:
            left = end - at
            meet = far - value - left * (far_rate + 0.5 * bend * left)
            apart = rate - far_rate - bend * left
            if meet <= left * apart or meet >= 0.0:
                return NEVER
            meet /= apart
            if value + meet * (rate - 0.5 * bend * meet) > -PENETRATED:
                return NEVER
        root = math.sqrt(slope * slope + 2.0 * bend * room)
        step = 2.0 * room / (root - slope) if slope < 0.0 else (slope + root) / bend
        if slope * FINEST > -0.25 * PENETRATED:
            step = max(step, FINEST)
        at += step
        if at >= before:
            return NEVER
        c = math.cos(at)
        s = sense * math.sin(at)
        y_x, y_z = carried(ground, body, pivot, x, z, c0, s0, sense * at, c, s)
        left = at / end
        c, s = c0 * c - s0 * s, s0 * c + c0 * s
        value, rate = separation(
            ground, body, k, part, piece, y_x, y_z, c, s,
            o_x + left * (f_x - o_x), o_z + left * (f_z - o_z), sense,
        )  # fmt: skip


def foot_on(
    ground: GroundTable, body: BodyTable, k: int, part: int, piece: int,
    x: float, z: float, c: float, s: float,
) -> float:  # fmt: skip
    """Where along a flat from its first end, or along segment k, a piece of a gap has its foot [m].

    Of a flat that of vertex k, of a segment that of the centre of an end disc.
    """
    if piece <= TO_TOP:
        n_x, n_z = flat_normal(body, part, piece, c, s)
        v_x = ground[k, X] - x - c * body[part, X1] + s * body[part, Z1]
        v_z = ground[k, Z] - z - s * body[part, X1] - c * body[part, Z1]
        return float(turning_side(body, part, piece) * (v_z * n_x - v_x * n_z))
    j = DISC * (piece - FROM_DISC_1)
    r_x = x + c * body[part, j + DISC_X] - s * body[part, j + DISC_Z] - ground[k, X]
    r_z = z + s * body[part, j + DISC_X] + c * body[part, j + DISC_Z] - ground[k, Z]
    return float(r_x * ground[k, U_X] + r_z * ground[k, U_Z])


def stays_beside(foot: float, later: float, sagitta: float, length: float) -> bool:
    """Whether a foot that runs along an arc stays beyond an end of what it would stand on.

    It is never farther off the chord of its arc, from ``foot`` to ``later``, than the sagitta.
    """
    return min(foot, later) - sagitta > length or max(foot, later) + sagitta < 0.0


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
    if piece <= TO_TOP:
        if piece == TO_TOP and not is_above(ground, body, part, k, x, c, s, -body[part, R1]):
            return False
        return on_flat(ground, body, POINT * k + PART * part, x, z, c, s)
    if piece < FROM_DISC_1:
        return True
    return bool(0.0 <= foot_on(ground, body, k, part, piece, x, z, c, s) <= ground[k, LENGTH])
