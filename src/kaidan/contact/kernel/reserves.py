r"""How far a pose is from rocking and from a fall: rise of the centroid, and tilt of gravity.

::

    turned on about the outermost contact against gravity,      C  .   over the pivot: the rise is
    and about each that closes farther out on the way         / .      known from one angle, unless
                                                            /.         the tail (or the nose) comes
                                                           o  \        down on the way
                                                       pivot   \ tail
                                                                `.___

Each pivot holds up to the tilt at which the gravity line passes it, the angle between that line and
the line pivot - centroid as the pivot takes over. On its way the robot comes to rest wherever two
contacts straddle the gravity line. A rest within `tolerance` of the pose counts as the same pose:
the robot has rocked.
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    CONVEX,
    COSINE,
    E_X,
    E_Z,
    KIND_MASK,
    NO_FEATURE,
    PART,
    POINT,
    POINT_BITS,
    R1,
    R2,
    SIDE,
    SINE,
    VERTEX,
    X1,
    X2,
    Z1,
    Z2,
    X,
    Z,
)
from kaidan.contact.kernel.closing import crossing_angle
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.first_closing import first_closing
from kaidan.contact.kernel.gaps import contact_point, on_flat
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.rotation import angle_until_over, carried, foot_limit, next_pivot, turned
from kaidan.contact.kernel.settling import lever
from kaidan.contact.tables import BodyTable, GroundTable

#: A contact that closes as the centroid comes over the pivot, or this much beyond [rad], closes
#: first: a robot that rotates back to where its rotation began stands there on what carried it.
AS_IT_COMES_OVER = 1e-6


def barrier(
    ground: GroundTable,
    body: BodyTable,
    pivot: int,
    x: float,
    z: float,
    phi: float,
    sense: float,
    kappa: float,
    tolerance: float,
    hint: int,
) -> tuple[bool, float, float, int]:
    """Rise of the centroid along the flow before it turns by more than rocking: the energy margin.

    It turns about ``pivot`` against gravity; where another gap closes farther out the turn goes on
    about that contact, until the centroid stands over the pivot. If it then comes to rest within
    ``tolerance`` [rad] of the pose, the turn goes on from there.

    Returns
    -------
    bounded
        False if no such pose lies within 90 degrees (then the rise is a lower bound).
    rise [m]
        Along effective gravity.
    across [m]
        How far the centroid has moved across it there, along x.
    hint
    """
    down = math.sqrt(1.0 + kappa * kappa)
    height = (z + kappa * x) / down
    begin = (x - kappa * z) / down
    total = 0.0
    best = 0.0
    across = 0.0
    for _ in range(60 + 2 * ground.shape[0]):  # an end rolls over each point by two names
        c = math.cos(phi)
        s = math.sin(phi)
        delta = lever(ground, body, pivot, x, z, c, s, kappa)
        over = 0.0
        if delta * sense < 0.0:
            over = max(angle_until_over(ground, body, pivot, x, z, c, s, sense, kappa, False), 0.0)
        elif total >= tolerance:
            return True, best, across, hint
        most = 0.5 * math.pi - total
        if most <= 0.0:
            return False, best, across, hint
        limit = foot_limit(ground, body, pivot, x, z, c, s, sense)
        end = min(limit, most)
        if over <= end:  # past the pivot only as far as rocking is tolerated
            end = min(max(over + AS_IT_COMES_OVER, tolerance - total), end)
        closed, angle, hint = first_closing(ground, body, pivot, x, z, c, s, sense, end, hint)
        if over < angle:
            c_over = math.cos(over)
            s_over = sense * math.sin(over)
            top_x, top_z = carried(ground, body, pivot, x, z, c, s, sense * over, c_over, s_over)
            rise = (top_z + kappa * top_x) / down - height
            if rise > best:
                best = rise
                across = (top_x - kappa * top_z) / down - begin
            if closed < 0 and angle < limit and pivot & KIND_MASK == VERTEX:
                return True, best, across, hint  # past the highest point of a circle
        x, z = carried(
            ground, body, pivot, x, z, c, s, sense * angle, math.cos(angle), sense * math.sin(angle)
        )
        phi += sense * angle
        total += angle
        rise = (z + kappa * x) / down - height
        if rise > best:
            best = rise
            across = (x - kappa * z) / down - begin
        if closed >= 0:
            pivot = closed
        elif over <= angle and angle < limit:
            return True, best, across, hint
        elif limit <= angle:
            pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
        else:
            return False, best, across, hint
    return False, best, across, hint


def lean(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, phi: float,
    sense: float, kappa: float,
) -> float:  # fmt: skip
    """Tilt of gravity at which its line through the centroid passes a contact [rad]."""
    p_x, p_z = contact_point(ground, body, pivot, x, z, math.cos(phi), math.sin(phi))
    return math.atan2(sense * (x - p_x - kappa * (z - p_z)), z - p_z + kappa * (x - p_x))


def next_under_flat(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, phi: float,
    sense: float, end: float, without: int, hint: int,
) -> tuple[int, float, int]:  # fmt: skip
    """First vertex that comes under a flat within a rotation of ``end`` about a vertex.

    Ends of the parts are passed over: they may touch before, or never. So is the point ``without``.

    Returns
    -------
    feature (-1: none), angle [rad], hint for the next call
    """
    c = math.cos(phi)
    s = math.sin(phi)
    at_k = pivot >> POINT_BITS
    o_x = ground[at_k, X]
    o_z = ground[at_k, Z]
    cosine = math.cos(end)
    sine = math.sin(end)
    best = end
    which = NO_FEATURE
    new_hint = ground.shape[0]
    for part in range(body.shape[0]):
        a_x = x + c * body[part, X1] - s * body[part, Z1]
        a_z = z + s * body[part, X1] + c * body[part, Z1]
        b_x = x + c * body[part, X2] - s * body[part, Z2]
        e_x = body[part, E_X]
        e_z = body[part, E_Z] * body[part, SIDE]
        along = body[part, SINE] * e_x + body[part, COSINE] * e_z
        up = body[part, SINE] * body[part, E_Z] - body[part, COSINE] * e_x * body[part, SIDE]
        n_x = c * along - s * up
        n_z = s * along + c * up
        level = (o_x - a_x) * n_x + (o_z - a_z) * n_z - body[part, R1]
        thick = max(body[part, R1], body[part, R2])
        swept = thick + end * (abs(a_x - o_x) + abs(b_x - o_x) + abs(a_z - o_z) + thick)
        right = max(a_x, b_x) + swept
        k = first_index(ground, min(a_x, b_x) - swept, hint)
        hint = k
        new_hint = min(new_hint, k)
        while k < ground.shape[0] - 1 and ground[k, X] <= right:
            if ground[k, CONVEX] == 1.0 and k != at_k and k != without:
                v_x = ground[k, X] - o_x
                v_z = ground[k, Z] - o_z
                angle = crossing_angle(
                    level, v_x * n_x + v_z * n_z, sense * (v_z * n_x - v_x * n_z), cosine, sine,
                    PENETRATED,
                )  # fmt: skip
                if angle < best:
                    c1 = math.cos(angle)
                    s1 = sense * math.sin(angle)
                    y_x, y_z = carried(ground, body, pivot, x, z, c, s, sense * angle, c1, s1)
                    feature = POINT * k + PART * part
                    if on_flat(ground, body, feature, y_x, y_z, c * c1 - s * s1, s * c1 + c * s1):
                        best = angle
                        which = feature
            k += 1
    return which, best, new_hint


def carrying_tilt(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, phi: float,
    sense: float, kappa: float, tolerance: float, without: int, hint: int,
) -> tuple[float, float, int]:  # fmt: skip
    """Tilt of gravity beyond which a pose rotates by more than rocking.

    Of the nosings under the flats all within ``tolerance`` carry, those that the robot has to rock
    onto too; an end that only comes to touch in rotating does not, and hides none of them.

    Parameters
    ----------
    pivot
        Outermost contact on the side to which it would turn.
    sense
        +1 nose up, -1 nose down.
    tolerance
        Rotation that is rocking [rad].
    without
        Point of the ground that does not count, or -1: the flat is about to reach it, or has left
        it.

    Returns
    -------
    tilt [rad]
        Largest lean about a pivot that takes over within the tolerance.
    rocking [rad]
        Rotation after which that pivot takes over.
    hint
    """
    most = lean(ground, body, pivot, x, z, phi, sense, kappa)
    if tolerance <= 0.0 and pivot & KIND_MASK == VERTEX:  # the robot rocks onto nothing
        return most, 0.0, hint
    rocking = 0.0
    total = 0.0
    for _ in range(20):
        if pivot & KIND_MASK == VERTEX:
            limit = math.inf
            closed, angle, hint = next_under_flat(
                ground, body, pivot, x, z, phi, sense, tolerance - total, without, hint
            )
        else:
            c = math.cos(phi)
            s = math.sin(phi)
            limit = foot_limit(ground, body, pivot, x, z, c, s, sense)
            closed, angle, hint = first_closing(
                ground, body, pivot, x, z, c, s, sense, min(tolerance - total, limit), hint
            )
        x, z = turned(ground, body, pivot, x, z, phi, sense * angle)
        phi += sense * angle
        total += angle
        if closed >= 0:
            pivot = closed
            held = lean(ground, body, pivot, x, z, phi, sense, kappa)
            if held > most and on_flat(ground, body, pivot, x, z, math.cos(phi), math.sin(phi)):
                most = held
                rocking = total
        elif limit <= angle:
            pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
        if total >= tolerance:
            break
    return most, rocking, hint
