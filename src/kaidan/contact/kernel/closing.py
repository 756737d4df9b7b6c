"""At which angle of a rotation one smooth piece of a gap closes.

Within one rotation every gap is smooth in the angle piece by piece: vertex to flat, vertex to end
disc, end disc to segment. About a vertex each piece is a sinusoid, solved in closed form. About a
disc that rolls it has linear terms besides, and may fall, grow and fall again; there a bound on its
curvature says how far the robot may turn before the piece can close.
"""

from __future__ import annotations

import math

from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.gaps import centre_of, is_above, on_flat
from kaidan.contact.kernel.rotation import NEVER, turned_on
from kaidan.contact.kernel.trigonometry import acos, atan2
from kaidan.contact.layout import PART, POINT, At, Part, Scene, Turn

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


def turning_side(part: Part, piece: int) -> float:
    """+1 if a flat's normal, turned nose up, leads along it from its first end; -1: to it."""
    return -part.side if piece == TO_TOP else part.side


def flat_normal(part: Part, piece: int, at: At) -> tuple[float, float]:
    """Outward normal of a part's flat, or of its mirror image (`TO_TOP`)."""
    side = turning_side(part, piece)
    e_z = part.e_z * side
    b_x = part.sine * part.e_x + part.cosine * e_z
    b_z = part.sine * part.e_z - part.cosine * part.e_x * side
    return at.c * b_x - at.s * b_z, at.s * b_x + at.c * b_z


def separation(
    scene: Scene, k: int, part: Part, piece: int, at: At, o_x: float, o_z: float, sense: float
) -> tuple[float, float]:
    """One smooth piece of a gap, and its change with the angle turned about (o_x, o_z).

    ``piece``: vertex k to the line of the flat or to an end disc, end disc to the line of segment
    k. Positive outside; 1 rad in the given sense.
    """
    point = scene.ground[k]
    if piece <= TO_TOP:
        n_x, n_z = flat_normal(part, piece, at)
        v_x = point.x - at.x - at.c * part.one.x + at.s * part.one.z
        v_z = point.z - at.z - at.s * part.one.x - at.c * part.one.z
        return (
            v_x * n_x + v_z * n_z - part.one.r,
            sense * ((point.z - o_z) * n_x - (point.x - o_x) * n_z),
        )
    disc = part.one if piece == TO_ARC_1 or piece == FROM_DISC_1 else part.two
    r_x, r_z = centre_of(disc, at)
    if piece >= FROM_DISC_1:
        return (
            point.u_x * (r_z - point.z) - point.u_z * (r_x - point.x) - disc.r,
            sense * ((r_x - o_x) * point.u_x + (r_z - o_z) * point.u_z),
        )
    r_x -= point.x
    r_z -= point.z
    rho = math.sqrt(r_x * r_x + r_z * r_z)
    return (
        rho - disc.r,
        sense * ((point.x - o_x) * r_z - (point.z - o_z) * r_x) / max(rho, 1e-15),
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
    angle = atan2(-rate, -even) - acos(max(-1.0, min(1.0, level / rho)))
    if angle < -1e-6:
        angle += 2.0 * math.pi
    return max(angle, 0.0)


def crossing_angle_on(
    level: float, even: float, rate: float, cosine: float, sine: float,
    length: float, offset: float, ahead: float,
) -> float:  # fmt: skip
    """:func:`crossing_angle` to a flat or a segment; 1e9 too if the foot stays beside it.

    level, even, rate, cosine, sine: see :func:`crossing_angle`.
    length: of the flat or the segment [m].
    offset, ahead: the foot runs along an arc: offset + ahead (rate cos - even sin), ``ahead`` 1 or
        -1.

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
    scene: Scene, k: int, number: int, piece: int, turn: Turn, before: float,
    value: float, rate: float, far: float, far_rate: float, bend: float,
) -> float:  # fmt: skip
    """First angle before another at which a piece of a gap closes, 1e9 if it does not.

    For a pivot that rolls. From a look at the gap g and its rate g' it stays above the parabola
    g + g' t - K t^2 / 2, K bounding its curvature: nothing closes before the parabola does, and
    there the next look is taken, Newton's method from the safe side. If the parabola from the end
    meets it above zero, nothing closes. A vertex beyond the line of a flat, or a disc below the
    line of a segment, is followed in the same way until it is back: it has passed beside.

    before: angle at which something else closes [rad].
    value, rate, far, far_rate: gap [m] and its change [m/rad] at both ends of the rotation.
    bend: K [m/rad^2]; for an arc, from below only.
    """
    part = scene.body[number]
    outside = value > -BESIDE
    at = turn.start
    angle = 0.0
    while True:
        if value > -0.5 * PENETRATED:
            outside = True
        elif outside and rate < -RESTING:
            if on_piece(scene, k, number, piece, at):
                return angle
            outside = False
        room = max(value + 0.75 * PENETRATED if outside else -value, 0.25 * PENETRATED)
        slope = rate if outside else -rate
        left = before - angle
        if room + left * (slope - 0.5 * bend * left) > 0.0:
            return NEVER
        if outside and far >= -PENETRATED:
            left = turn.end - angle
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
        angle += step
        if angle >= before:
            return NEVER
        at = turned_on(scene, turn.pivot, turn.start, turn.sense, angle)
        left = angle / turn.end
        o_x = turn.o_x + left * (turn.f_x - turn.o_x)
        o_z = turn.o_z + left * (turn.f_z - turn.o_z)
        value, rate = separation(scene, k, part, piece, at, o_x, o_z, turn.sense)


def foot_on(scene: Scene, k: int, part: Part, piece: int, at: At) -> float:
    """Where along a flat from its first end, or along segment k, a piece of a gap has its foot [m].

    Of a flat that of vertex k, of a segment that of the centre of an end disc.
    """
    point = scene.ground[k]
    if piece <= TO_TOP:
        n_x, n_z = flat_normal(part, piece, at)
        v_x = point.x - at.x - at.c * part.one.x + at.s * part.one.z
        v_z = point.z - at.z - at.s * part.one.x - at.c * part.one.z
        return turning_side(part, piece) * (v_z * n_x - v_x * n_z)
    r_x, r_z = centre_of(part.one if piece == FROM_DISC_1 else part.two, at)
    return (r_x - point.x) * point.u_x + (r_z - point.z) * point.u_z


def stays_beside(foot: float, later: float, sagitta: float, length: float) -> bool:
    """Whether a foot that runs along an arc stays beyond an end of what it would stand on.

    It is never farther off the chord of its arc, from ``foot`` to ``later``, than the sagitta.
    """
    return min(foot, later) - sagitta > length or max(foot, later) + sagitta < 0.0


def on_piece(scene: Scene, k: int, number: int, piece: int, at: At) -> bool:
    """Whether the foot lies on the flat or the segment, not beyond; ``number``: of the part."""
    part = scene.body[number]
    point = scene.ground[k]
    if piece <= TO_TOP:
        if piece == TO_TOP and not is_above(part, point.x, at, -part.one.r):
            return False
        return on_flat(scene, POINT * k + PART * number, at)
    if piece < FROM_DISC_1:
        return True
    foot = foot_on(scene, k, part, piece, at)
    return foot >= 0.0 and foot <= point.length
