"""Turning about one contact: where the centroid goes, and what closes first, in closed form.

::

        C
       /|        vertex: the body turns rigidly about the vertex
      / |        disc on a segment: it rolls, the centre moves by -r dphi along the segment
     o--+-->     Delta < 0: nose down; Delta > 0: nose up

Within one turn every gap is a sinusoid of the angle (plus a linear term if the pivot rolls), piece
by piece: vertex to flat, vertex to end disc, end disc to segment. A piece can close within a turn
of ``end`` only if it is negative there, or if it falls at the start and grows at the end; all
others are passed over after one look at both ends.
"""

from __future__ import annotations

import math

from kaidan.contact.branch import PENETRATED
from kaidan.contact.compiling import kernel
from kaidan.contact.gaps import gap, on_flat
from kaidan.contact.scan import first_index
from kaidan.contact.tables import FloatArray

NEVER = 1e9
#: A gap that falls by less than this per radian [m] is one contact under two names, at rest.
RESTING = 1e-9
#: A vertex beyond the line of a flat, or a disc below the line of a segment, by more than this [m]
#: at the start is not on its way to meet it: it has passed beside it.
BESIDE = 0.01
#: A pivot this close to an end disc [m] lies on it: five times the gap at which a turn ends. One
#: that lies farther off closes with the segment sqrt(2 off / R) later, at a gap of zero.
SAME_ARC = 1e-11
#: A piece of a gap that falls at one end of a turn this small and grows at the other is convex in
#: between [rad]: its curvature changes sign a right angle away from a minimum if nothing rolls.
CONVEX = 0.4


@kernel
def turned(
    ground: FloatArray, body: FloatArray, pivot: int, x: float, z: float, phi: float, angle: float
) -> tuple[float, float]:
    """Centroid after turning by ``angle`` about a contact: closed form, rolling included."""
    c = math.cos(angle)
    s = math.sin(angle)
    kind = pivot & 3
    k = pivot >> 6
    if kind == 0:
        d_x = x - ground[k, 0]
        d_z = z - ground[k, 1]
        return ground[k, 0] + c * d_x - s * d_z, ground[k, 1] + s * d_x + c * d_z
    part = (pivot >> 2) & 15
    j = 3 * (kind - 1)
    o_x = math.cos(phi) * body[part, j] - math.sin(phi) * body[part, j + 1]
    o_z = math.sin(phi) * body[part, j] + math.cos(phi) * body[part, j + 1]
    roll = -body[part, j + 2] * angle
    return (
        x + o_x + roll * ground[k, 2] - c * o_x + s * o_z,
        z + o_z + roll * ground[k, 3] - s * o_x - c * o_z,
    )


@kernel
def foot_limit(
    ground: FloatArray, body: FloatArray, pivot: int, x: float, z: float, phi: float, sense: float
) -> float:
    """Turn after which a rolling disc's foot reaches the end of its segment [rad] (inf: vertex)."""
    kind = pivot & 3
    if kind == 0:
        return 1e9
    k = pivot >> 6
    part = (pivot >> 2) & 15
    j = 3 * (kind - 1)
    c_x = x + math.cos(phi) * body[part, j] - math.sin(phi) * body[part, j + 1]
    c_z = z + math.sin(phi) * body[part, j] + math.cos(phi) * body[part, j + 1]
    foot = (c_x - ground[k, 0]) * ground[k, 2] + (c_z - ground[k, 1]) * ground[k, 3]
    if sense > 0.0:
        return float(max(foot, 0.0) / body[part, j + 2])
    return float(max(ground[k, 4] - foot, 0.0) / body[part, j + 2])


@kernel
def next_pivot(
    ground: FloatArray, body: FloatArray, pivot: int, x: float, z: float, phi: float, sense: float
) -> int:
    """Name of the pivot after its disc has run to the end of its segment.

    Over the end of the terrain itself it turns about that end.
    """
    k = pivot >> 6
    part = (pivot >> 2) & 15
    if sense > 0.0:
        if ground[k, 5] == 1.0 or k == 0:
            return 64 * k + 4 * part
        return 64 * (k - 1) + (pivot & 63)
    if ground[k + 1, 5] == 1.0 or k + 2 == ground.shape[0]:
        return 64 * (k + 1) + 4 * part
    return 64 * (k + 1) + (pivot & 63)


@kernel
def angle_until_over(
    ground: FloatArray,
    body: FloatArray,
    pivot: int,
    x: float,
    z: float,
    phi: float,
    sense: float,
    kappa: float,
    below: bool,
) -> float:
    """Turn after which the centroid stands over the pivot, or hangs below it [rad]; 1e9: never.

    With d the centroid from the vertex (or from the centre of the rolling disc), t the angle of
    effective gravity: |d| sin(t - angle of d) = q, q = 0 for a vertex, and for a disc its contact's
    offset from the gravity line through its centre; the second root of the sine is the stable one,
    on which a disc comes to rest rocking. A vertex is never hung from within 90 degrees.
    """
    k = pivot >> 6
    up = math.atan2(1.0, kappa)
    if pivot & 3 == 0:
        angle = sense * (up - math.atan2(z - ground[k, 1], x - ground[k, 0]))
        if below:
            return NEVER
        return angle + 2.0 * math.pi if angle < -1e-9 else angle
    part = (pivot >> 2) & 15
    j = 3 * ((pivot & 3) - 1)
    c = math.cos(phi)
    s = math.sin(phi)
    d_x = s * body[part, j + 1] - c * body[part, j]
    d_z = -s * body[part, j] - c * body[part, j + 1]
    ratio = body[part, j + 2] * (ground[k, 3] + kappa * ground[k, 2])
    size = math.hypot(d_x, d_z) * math.sqrt(1.0 + kappa * kappa)
    if abs(ratio) >= size:
        return NEVER
    lean = math.asin(ratio / size)
    if below:
        lean = math.pi - lean
    angle = sense * (up - lean - math.atan2(d_z, d_x))
    return angle + 2.0 * math.pi if angle < -1e-9 else angle


@kernel
def separation(
    ground: FloatArray,
    body: FloatArray,
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

    ``piece`` 0: vertex k to the line of the flat; 1, 2: vertex to end disc; 3, 4: end disc 1, 2 to
    the line of segment k. Positive outside; 1 rad in the given sense.
    """
    if piece == 0:
        e_x = body[part, 6]
        e_z = body[part, 7] * body[part, 12]
        b_x = body[part, 9] * e_x + body[part, 10] * e_z
        b_z = body[part, 9] * body[part, 7] - body[part, 10] * e_x * body[part, 12]
        n_x = c * b_x - s * b_z
        n_z = s * b_x + c * b_z
        v_x = ground[k, 0] - x - c * body[part, 0] + s * body[part, 1]
        v_z = ground[k, 1] - z - s * body[part, 0] - c * body[part, 1]
        return (
            v_x * n_x + v_z * n_z - body[part, 2],
            sense * ((ground[k, 1] - o_z) * n_x - (ground[k, 0] - o_x) * n_z),
        )
    j = 3
    if piece == 1 or piece == 3:
        j = 0
    r_x = x + c * body[part, j] - s * body[part, j + 1]
    r_z = z + s * body[part, j] + c * body[part, j + 1]
    if piece >= 3:
        u_x = ground[k, 2]
        u_z = ground[k, 3]
        return (
            u_x * (r_z - ground[k, 1]) - u_z * (r_x - ground[k, 0]) - body[part, j + 2],
            sense * ((r_x - o_x) * u_x + (r_z - o_z) * u_z),
        )
    r_x -= ground[k, 0]
    r_z -= ground[k, 1]
    rho = math.sqrt(r_x * r_x + r_z * r_z)
    return (
        rho - body[part, j + 2],
        sense * ((ground[k, 0] - o_x) * r_z - (ground[k, 1] - o_z) * r_x) / max(rho, 1e-15),
    )


@kernel
def crossing_angle(
    level: float, swing: float, rate: float, cosine: float, sine: float, deep: float
) -> float:
    """Angle at which level + swing cos + rate sin goes down through zero, 1e9 if not soon.

    ``cosine`` and ``sine`` of the turn looked at: it crosses within it if it is negative at the
    end, or falls at the start, grows at the end and its least value, level - hypot(swing, rate), is
    negative. Values above ``-deep`` are not.
    """
    if level + swing * cosine + rate * sine >= -deep and (
        rate >= -RESTING
        or rate * cosine - swing * sine <= 0.0
        or (level + deep >= 0.0 and (level + deep) * (level + deep) >= swing * swing + rate * rate)
    ):
        return NEVER
    start = level + swing
    if start <= -0.5 * deep and rate < -RESTING:
        return 0.0 if start > -deep * (BESIDE / PENETRATED) else NEVER
    rho = math.sqrt(swing * swing + rate * rate)
    if level <= -rho:  # never positive; a feature through the pivot itself is one of these
        return NEVER
    angle = math.atan2(-rate, -swing) - math.acos(max(-1.0, min(1.0, level / rho)))
    if angle < -1e-6:
        angle += 2.0 * math.pi
    return max(angle, 0.0)


@kernel
def closing_angle(
    ground: FloatArray,
    body: FloatArray,
    k: int,
    part: int,
    piece: int,
    pivot: int,
    x: float,
    z: float,
    phi: float,
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
    if pivot & 3 != 0:
        roll = -sense * body[(pivot >> 2) & 15, 3 * ((pivot & 3) - 1) + 2]
    u_x = ground[pivot >> 6, 2] * roll
    u_z = ground[pivot >> 6, 3] * roll
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
            if hi - lo < CONVEX and low + rate0 * meet > 0.0:
                return NEVER
            meet = (lo * rate1 - hi * rate0) / (rate1 - rate0)
            if turn % 3 == 2 or not (lo < meet < hi):
                meet = 0.5 * (lo + hi)
            x1, z1 = turned(ground, body, pivot, x, z, phi, sense * meet)
            angle = phi + sense * meet
            value, rate = separation(
                ground, body, k, part, piece, x1, z1, math.cos(angle), math.sin(angle),
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
        x1, z1 = turned(ground, body, pivot, x, z, phi, sense * at)
        angle = phi + sense * at
        value, rate = separation(
            ground, body, k, part, piece, x1, z1, math.cos(angle), math.sin(angle),
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


@kernel
def on_piece(
    ground: FloatArray,
    body: FloatArray,
    k: int,
    part: int,
    piece: int,
    x: float,
    z: float,
    c: float,
    s: float,
) -> bool:
    """Whether the foot lies on the flat (piece 0) or the segment (pieces 3, 4), not beyond."""
    if piece == 0:
        return on_flat(ground, body, 64 * k + 4 * part, x, z, c, s)
    if piece < 3:
        return True
    j = 3 * (piece - 3)
    r_x = x + c * body[part, j] - s * body[part, j + 1] - ground[k, 0]
    r_z = z + s * body[part, j] + c * body[part, j + 1] - ground[k, 1]
    foot = r_x * ground[k, 2] + r_z * ground[k, 3]
    return bool(0.0 <= foot <= ground[k, 4])


@kernel
def first_closing(
    ground: FloatArray,
    body: FloatArray,
    pivot: int,
    x: float,
    z: float,
    phi: float,
    sense: float,
    end: float,
    hint: int,
) -> tuple[int, float, int]:
    """First feature that closes within a turn of ``end`` about a pivot.

    Returns
    -------
    feature (-1: none), angle [rad], hint for the next call
    """
    c0 = math.cos(phi)
    s0 = math.sin(phi)
    x1, z1 = turned(ground, body, pivot, x, z, phi, sense * end)
    c1 = math.cos(phi + sense * end)
    s1 = math.sin(phi + sense * end)
    _, q_x, q_z, o_x, o_z = gap(ground, body, pivot, x, z, c0, s0)
    rolls = pivot & 3 != 0
    own = (pivot >> 2) & 15
    at_k = pivot >> 6
    f_x = o_x
    f_z = o_z
    rolled = 0.0
    lifts = False
    if rolls:
        # the part's other end goes up, away from the segment
        other = c0 * body[own, 6] - s0 * body[own, 7]
        away = s0 * body[own, 6] + c0 * body[own, 7]
        ahead = other * ground[at_k, 2] + away * ground[at_k, 3]
        lifts = sense * ahead * (1.0 if pivot & 3 == 1 else -1.0) > 0.0
        rolled = end * body[own, 3 * ((pivot & 3) - 1) + 2]
        f_x -= sense * rolled * ground[at_k, 2]
        f_z -= sense * rolled * ground[at_k, 3]
    bend = 0.125 * end * end
    ce = math.cos(end)
    se = math.sin(end)
    n = ground.shape[0]
    which = -1
    best = end
    new_hint = n
    for part in range(body.shape[0]):
        a_x = x + c0 * body[part, 0] - s0 * body[part, 1]
        a_z = z + s0 * body[part, 0] + c0 * body[part, 1]
        b_x = x + c0 * body[part, 3] - s0 * body[part, 4]
        b_z = z + s0 * body[part, 3] + c0 * body[part, 4]
        e_x = body[part, 6]
        e_z = body[part, 7] * body[part, 12]
        n_x = body[part, 9] * e_x + body[part, 10] * e_z
        e_z = body[part, 9] * body[part, 7] - body[part, 10] * e_x * body[part, 12]
        n_z = s0 * n_x + c0 * e_z
        n_x = c0 * n_x - s0 * e_z
        flat_level = (o_x - a_x) * n_x + (o_z - a_z) * n_z - body[part, 2]
        # x range swept: chord of each disc, plus the sagitta of its arc
        e_x = x1 + c1 * body[part, 0] - s1 * body[part, 1]
        sag = bend * (abs(a_x - o_x) + abs(a_z - o_z)) + body[part, 2]
        left1 = min(a_x, e_x) - sag
        right1 = max(a_x, e_x) + sag
        e_x = x1 + c1 * body[part, 3] - s1 * body[part, 4]
        sag = bend * (abs(b_x - o_x) + abs(b_z - o_z)) + body[part, 5]
        left2 = min(b_x, e_x) - sag
        right2 = max(b_x, e_x) + sag
        left = min(left1, left2)
        right = max(right1, right2)
        k = first_index(ground, left, hint)
        hint = k
        if k < new_hint:
            new_hint = k
        while k < n - 1 and ground[k, 0] <= right:
            # the pivot's own part lies above its supporting line: what lies below that line, and
            # on the side that is lifted, is never met (rolling upward: on either side)
            v_x = ground[k, 0] - o_x
            v_z = ground[k, 1] - o_z
            free = (
                part == own
                and v_x * q_x + v_z * q_z <= 1e-12
                and (lifts or sense * (v_x * q_z - v_z * q_x) > 0.0)
            )
            if free:
                v_x = ground[k + 1, 0] - o_x
                v_z = ground[k + 1, 1] - o_z
                if v_x * q_x + v_z * q_z <= 1e-12 and (
                    lifts or sense * (v_x * q_z - v_z * q_x) > 0.0
                ):
                    k += 1
                    continue
            if not rolls:
                v_x = ground[k, 0] - o_x
                v_z = ground[k, 1] - o_z
                if not free and ground[k, 5] == 1.0 and not (k == at_k and part == own):
                    swing = v_x * n_x + v_z * n_z
                    at = crossing_angle(
                        flat_level, swing, sense * (v_z * n_x - v_x * n_z), ce, se, PENETRATED
                    )
                    if at < best:
                        y_x, y_z = turned(ground, body, pivot, x, z, phi, sense * at)
                        angle = phi + sense * at
                        if on_flat(
                            ground, body, 64 * k + 4 * part, y_x, y_z,
                            math.cos(angle), math.sin(angle),
                        ):  # fmt: skip
                            best = at
                            which = 64 * k + 4 * part
                    square = v_x * v_x + v_z * v_z
                    for disc in range(2):
                        r_x = a_x - o_x
                        r_z = a_z - o_z
                        if disc == 1:
                            r_x = b_x - o_x
                            r_z = b_z - o_z
                        radius = body[part, 3 * disc + 2]
                        away = r_x * r_x + r_z * r_z
                        level = square + away - radius * radius
                        if level > 0.0 and level * level >= 4.0 * square * away:
                            continue
                        # law of cosines: |V - C|^2 - r^2
                        at = crossing_angle(
                            level, -2.0 * (r_x * v_x + r_z * v_z),
                            -2.0 * sense * (r_x * v_z - r_z * v_x), ce, se,
                            2.0 * radius * PENETRATED,
                        )  # fmt: skip
                        if at < best:
                            best = at
                            which = 64 * k + 4 * part
                for disc in range(2):
                    r_x = a_x - o_x
                    r_z = a_z - o_z
                    if disc == 0:
                        if ground[k + 1, 0] < left1 or ground[k, 0] > right1:
                            continue
                    else:
                        if ground[k + 1, 0] < left2 or ground[k, 0] > right2:
                            continue
                        r_x = b_x - o_x
                        r_z = b_z - o_z
                    radius = body[part, 3 * disc + 2]
                    if (k == at_k or k == at_k - 1) and abs(
                        math.sqrt(r_x * r_x + r_z * r_z) - radius
                    ) < SAME_ARC:
                        # the pivot is this segment's end and lies under the disc: it rolls on
                        # along the segment ahead as soon as its centre stands over the end
                        if (k == at_k) == (sense > 0.0):
                            continue
                        at = sense * (
                            math.atan2(ground[k, 2], -ground[k, 3]) - math.atan2(r_z, r_x)
                        )
                        if at < -1e-9:
                            at += 2.0 * math.pi
                        if at < best:
                            best = max(at, 0.0)
                            which = 64 * k + 4 * part + disc + 1
                        continue
                    u_x = ground[k, 2]
                    u_z = ground[k, 3]
                    swing = u_x * r_z - u_z * r_x
                    level = u_z * v_x - u_x * v_z - radius
                    rate = sense * (r_x * u_x + r_z * u_z)
                    at = crossing_angle(level, swing, rate, ce, se, PENETRATED)
                    if at < best:
                        # along the segment: the centre, turned
                        foot = (
                            math.cos(at) * (r_x * u_x + r_z * u_z)
                            - sense * math.sin(at) * swing
                            - v_x * u_x
                            - v_z * u_z
                        )
                        if foot >= 0.0 and foot <= ground[k, 4]:
                            best = at
                            which = 64 * k + 4 * part + disc + 1
                k += 1
                continue
            reach = math.sqrt(v_x * v_x + v_z * v_z) + rolled
            for piece in range(5):
                if piece < 3:
                    if free or ground[k, 5] != 1.0:
                        continue
                    if piece == 1 and (ground[k, 0] < left1 or ground[k, 0] > right1):
                        continue
                    if piece == 2 and (ground[k, 0] < left2 or ground[k, 0] > right2):
                        continue
                    feature = 64 * k + 4 * part
                else:
                    feature = 64 * k + 4 * part + piece - 2
                    if feature == pivot:
                        continue
                    r_x = a_x - o_x
                    r_z = a_z - o_z
                    if piece == 3:
                        if ground[k + 1, 0] < left1 or ground[k, 0] > right1:
                            continue
                    else:
                        if ground[k + 1, 0] < left2 or ground[k, 0] > right2:
                            continue
                        r_x = b_x - o_x
                        r_z = b_z - o_z
                    reach = math.sqrt(r_x * r_x + r_z * r_z) + rolled
                g0, rate0 = separation(ground, body, k, part, piece, x, z, c0, s0, o_x, o_z, sense)
                if g0 > reach * best or g0 < -BESIDE:
                    continue
                g1, rate1 = separation(
                    ground, body, k, part, piece, x1, z1, c1, s1, f_x, f_z, sense
                )
                if g1 >= -PENETRATED and rate0 >= -RESTING:
                    continue
                at = closing_angle(
                    ground, body, k, part, piece, pivot, x, z, phi, o_x, o_z, sense, end,
                    g0, rate0, g1, rate1, reach,
                )  # fmt: skip
                if at < best:
                    y_x, y_z = turned(ground, body, pivot, x, z, phi, sense * at)
                    c = math.cos(phi + sense * at)
                    s = math.sin(phi + sense * at)
                    if on_piece(ground, body, k, part, piece, y_x, y_z, c, s):
                        best = at
                        which = feature
            k += 1
    return which, best, new_hint
