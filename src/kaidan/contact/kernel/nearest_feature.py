"""The nearest of all features at a pose: what would be hit first."""

from __future__ import annotations

import math

from kaidan.contact.kernel.gaps import FAR, INSIDE
from kaidan.contact.layout import (
    DISC_1,
    DISC_2,
    NO_FEATURE,
    PART,
    POINT,
    At,
    Point,
    Scene,
)
from kaidan.contact.memory import Table

#: Depth up to which a feature is taken for penetrated and not for "the far side of a fin" [m].
DEEPEST = 0.02


def height_of_ground(ground: Table[Point], x: float) -> float:
    """Height of the terrain at x [m]; at a riser the upper end."""
    lo = 0
    hi = len(ground) - 2
    while lo < hi:
        mid = (lo + hi + 1) // 2
        if ground[mid].x <= x:
            lo = mid
        else:
            hi = mid - 1
    point = ground[lo]
    if point.u_x <= 0.0:
        return ground[lo + 1].z
    return point.z + (x - point.x) * point.u_z / point.u_x


def first_index(scene: Scene, x: float) -> int:
    """Index of the last point left of x, looked for from the hint: ever farther, then halving.

    The next look is expected to be near it.
    """
    ground = scene.ground
    n = len(ground)
    k = min(max(scene.hint, 0), n - 2)
    reach = 1
    if ground[k].x < x:
        beyond = k + 1
        while beyond < n - 1 and ground[beyond].x < x:
            k = beyond
            beyond = min(beyond + reach, n - 1)
            reach *= 2
    else:
        beyond = k
        k = max(k - 1, 0)
        while k > 0 and ground[k].x >= x:
            beyond = k
            k = max(k - reach, 0)
            reach *= 2
    while beyond - k > 1:
        middle = (k + beyond) // 2
        if ground[middle].x < x:
            k = middle
        else:
            beyond = middle
    scene.hint = k
    return k


def disc_gap(
    ground: Table[Point], point: Point, to_x: float, to_z: float, radius: float, best: float
) -> float:
    """Gap between a disc and a segment if it is less than ``best``, else ``best`` [m].

    to_x, to_z: from the point where the segment begins to the disc's centre [m].
    """
    distance = point.u_x * to_z - point.u_z * to_x
    if distance - radius >= best or distance <= -DEEPEST:
        return best
    foot = to_x * point.u_x + to_z * point.u_z
    if foot < 0.0 or foot > point.length:
        return best
    if distance <= 0.0 and to_z + point.z >= height_of_ground(ground, to_x + point.x):
        return best
    return distance - radius


def nearest(scene: Scene, at: At, skip_1: int, skip_2: int, reach: float) -> tuple[int, float]:
    """Feature with the smallest gap, two left out.

    skip_1, skip_2: features left out (the contacts that carry the robot), -1 for none.
    reach: gaps above this [m] need not be found.

    feature (-1: nothing within reach), gap [m].
    """
    x, z, c, s = at
    ground = scene.ground
    n = len(ground)
    best = reach
    which = NO_FEATURE
    for number in range(len(scene.body)):
        part = scene.body[number]
        x1 = x + (c * part.one.x - s * part.one.z)
        z1 = z + (s * part.one.x + c * part.one.z)
        x2 = x + c * part.two.x - s * part.two.z
        z2 = z + s * part.two.x + c * part.two.z
        r1 = part.one.r
        r2 = part.two.r
        from_x = min(x1 - r1, x2 - r2)
        to_far = max(x1 + r1, x2 + r2)
        # a small disc may have stepped past a face altogether
        wide1 = max(best, DEEPEST - r1)
        wide2 = max(best, DEEPEST - r2)
        left = from_x - max(wide1, wide2)
        right = to_far + max(wide1, wide2)
        # axis of the part in the world
        e_x = c * part.e_x - s * part.e_z
        e_z = s * part.e_x + c * part.e_z
        thin = INSIDE - min(r1, r2)
        left1 = x1 - r1 - wide1
        right1 = x1 + r1 + wide1
        left2 = x2 - r2 - wide2
        right2 = x2 + r2 + wide2
        k = first_index(scene, left)
        while k < n - 1 and ground[k].x <= right:
            point = ground[k]
            a_x = point.x - x1
            a_z = point.z - z1
            along = a_x * e_x + a_z * e_z
            below = part.side * (a_x * e_z - a_z * e_x)
            if below < 0.0 and (below < -thin or point.x <= from_x or point.x >= to_far):
                below = -below
            # to the line of the flat: no more
            distance = along * part.sine + below * part.cosine - r1
            if distance < best and point.convex and point.x >= left:
                w = along * part.cosine - below * part.sine
                if w < 0.0:
                    distance = math.sqrt(along * along + below * below) - r1
                elif w > part.flat:
                    along -= part.axis
                    distance = math.sqrt(along * along + below * below) - r2
                if distance < best:
                    feature = POINT * k + PART * number
                    if feature != skip_1 and feature != skip_2:
                        best = distance
                        which = feature
            next_x = ground[k + 1].x
            for disc in range(DISC_1, DISC_2 + 1):
                if disc == DISC_1:
                    if next_x < left1 or point.x > right1:
                        continue
                    to_x = x1 - point.x
                    to_z = z1 - point.z
                    radius = r1
                else:
                    if next_x < left2 or point.x > right2:
                        continue
                    to_x = x2 - point.x
                    to_z = z2 - point.z
                    radius = r2
                distance = disc_gap(ground, point, to_x, to_z, radius, best)
                if distance < best:
                    feature = POINT * k + PART * number + disc
                    if feature != skip_1 and feature != skip_2:
                        best = distance
                        which = feature
            k += 1
    return which, best if which >= 0 else FAR
