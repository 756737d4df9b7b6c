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

from kaidan.contact.kernel.closing import TO_FLAT, crossing_angle, flat_normal
from kaidan.contact.kernel.event_location import PENETRATED
from kaidan.contact.kernel.first_closing import first_closing
from kaidan.contact.kernel.gaps import centre_of, contact_point, on_flat
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.rotation import (
    angle_until_over,
    carried,
    foot_limit,
    next_pivot,
    turned,
    turned_on,
)
from kaidan.contact.kernel.settling import lever
from kaidan.contact.kernel.trigonometry import atan2, cosine_sine, placed
from kaidan.contact.layout import (
    KIND_MASK,
    NO_FEATURE,
    PART,
    POINT,
    POINT_BITS,
    VERTEX,
    At,
    First,
    Release,
    Scene,
)

#: A contact that closes as the centroid comes over the pivot, or this much beyond [rad], closes
#: first: a robot that rotates back to where its rotation began stands there on what carried it.
AS_IT_COMES_OVER = 1e-6


def barrier(
    scene: Scene, pivot: int, release: Release, tolerance: float
) -> tuple[bool, float, float]:
    """Rise of the centroid along the flow before it turns by more than rocking: the energy margin.

    It turns about ``pivot`` against gravity; where another gap closes farther out the turn goes on
    about that contact, until the centroid stands over the pivot. If it then comes to rest within
    ``tolerance`` [rad] of the pose, the turn goes on from there.

    bounded: False if no such pose lies within 90 degrees (then the rise is a lower bound).
    Along effective gravity.
    How far the centroid has moved across it there, along x.
    """
    x, z, phi, sense, kappa = release
    down = math.sqrt(1.0 + kappa * kappa)
    height = (z + kappa * x) / down
    begin = (x - kappa * z) / down
    total = 0.0
    best = 0.0
    across = 0.0
    for _ in range(60 + 2 * len(scene.ground)):  # an end rolls over each point by two names
        at = placed(x, z, phi)
        over = 0.0
        if lever(scene, pivot, at, kappa) * sense < 0.0:
            over = max(angle_until_over(scene, pivot, at, sense, kappa, False), 0.0)
        elif total >= tolerance:
            return True, best, across
        most = 0.5 * math.pi - total
        if most <= 0.0:
            return False, best, across
        limit = foot_limit(scene, pivot, at, sense)
        end = min(limit, most)
        if over <= end:  # past the pivot only as far as rocking is tolerated
            end = min(max(over + AS_IT_COMES_OVER, tolerance - total), end)
        angle, closed = first_closing(scene, pivot, at, sense, end)
        if over < angle:
            c, s = cosine_sine(over)
            top_x, top_z = carried(scene, pivot, at, sense * over, c, sense * s)
            rise = (top_z + kappa * top_x) / down - height
            if rise > best:
                best = rise
                across = (top_x - kappa * top_z) / down - begin
            if closed < 0 and angle < limit and pivot & KIND_MASK == VERTEX:
                return True, best, across  # past the highest point of a circle
        c, s = cosine_sine(angle)
        x, z = carried(scene, pivot, at, sense * angle, c, sense * s)
        phi += sense * angle
        total += angle
        rise = (z + kappa * x) / down - height
        if rise > best:
            best = rise
            across = (x - kappa * z) / down - begin
        if closed >= 0:
            pivot = closed
        elif over <= angle and angle < limit:
            return True, best, across
        elif limit <= angle:
            pivot = next_pivot(scene, pivot, sense)
        else:
            return False, best, across
    return False, best, across


def lean(scene: Scene, pivot: int, at: At, sense: float, kappa: float) -> float:
    """Tilt of gravity at which its line through the centroid passes a contact [rad]."""
    p_x, p_z = contact_point(scene, pivot, at)
    return atan2(sense * (at.x - p_x - kappa * (at.z - p_z)), at.z - p_z + kappa * (at.x - p_x))


def next_under_flat(
    scene: Scene, pivot: int, at: At, sense: float, end: float, without: int
) -> First:
    """First vertex that comes under a flat within a rotation of ``end`` about a vertex.

    Ends of the parts are passed over: they may touch before, or never. So is the point ``without``.
    """
    ground = scene.ground
    at_k = pivot >> POINT_BITS
    o_x = ground[at_k].x
    o_z = ground[at_k].z
    cosine, sine = cosine_sine(end)
    first = First(end, NO_FEATURE)
    for number in range(len(scene.body)):
        part = scene.body[number]
        a_x, a_z = centre_of(part.one, at)
        b_x, _ = centre_of(part.two, at)
        n_x, n_z = flat_normal(part, TO_FLAT, at)
        level = (o_x - a_x) * n_x + (o_z - a_z) * n_z - part.one.r
        thick = max(part.one.r, part.two.r)
        swept = thick + end * (abs(a_x - o_x) + abs(b_x - o_x) + abs(a_z - o_z) + thick)
        right = max(a_x, b_x) + swept
        k = first_index(scene, min(a_x, b_x) - swept)
        while k < len(ground) - 1 and ground[k].x <= right:
            if ground[k].convex and k != at_k and k != without:
                v_x = ground[k].x - o_x
                v_z = ground[k].z - o_z
                angle = crossing_angle(
                    level, v_x * n_x + v_z * n_z, sense * (v_z * n_x - v_x * n_z), cosine, sine,
                    PENETRATED,
                )  # fmt: skip
                if angle < first.angle:
                    feature = POINT * k + PART * number
                    if on_flat(scene, feature, turned_on(scene, pivot, at, sense, angle)):
                        first = First(angle, feature)
            k += 1
    return first


def carrying_tilt(
    scene: Scene, pivot: int, release: Release, tolerance: float, without: int
) -> tuple[float, float]:
    """Tilt of gravity beyond which a pose rotates by more than rocking.

    Of the nosings under the flats all within ``tolerance`` carry, those that the robot has to rock
    onto too; an end that only comes to touch in rotating does not, and hides none of them.

    tolerance: rotation that is rocking [rad].
    without: point of the ground that does not count, or -1: the flat is about to reach it, or has
        left it.

    Largest lean about a pivot that takes over within the tolerance.
    Rotation after which that pivot takes over.
    """
    x, z, phi, sense, kappa = release
    at = placed(x, z, phi)
    most = lean(scene, pivot, at, sense, kappa)
    if tolerance <= 0.0 and pivot & KIND_MASK == VERTEX:  # the robot rocks onto nothing
        return most, 0.0
    rocking = 0.0
    total = 0.0
    for _ in range(20):
        limit = math.inf
        if pivot & KIND_MASK == VERTEX:
            first = next_under_flat(scene, pivot, at, sense, tolerance - total, without)
        else:
            limit = foot_limit(scene, pivot, at, sense)
            first = first_closing(scene, pivot, at, sense, min(tolerance - total, limit))
        x, z = turned(scene, pivot, x, z, phi, sense * first.angle)
        phi += sense * first.angle
        total += first.angle
        at = placed(x, z, phi)
        if first.feature >= 0:
            pivot = first.feature
            held = lean(scene, pivot, at, sense, kappa)
            if held > most and on_flat(scene, pivot, at):
                most = held
                rocking = total
        elif limit <= first.angle:
            pivot = next_pivot(scene, pivot, sense)
        if total >= tolerance:
            break
    return most, rocking
