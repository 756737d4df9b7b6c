"""The nearest of all features at a pose: what would be hit first."""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    AXIS,
    CONVEX,
    COSINE,
    DISC_1,
    DISC_2,
    E_X,
    E_Z,
    FLAT,
    LENGTH,
    NO_FEATURE,
    PART,
    POINT,
    R1,
    R2,
    SIDE,
    SINE,
    U_X,
    U_Z,
    X1,
    X2,
    Z1,
    Z2,
    X,
    Z,
)
from kaidan.contact.kernel.gaps import FAR, INSIDE
from kaidan.contact.tables import BodyTable, GroundTable

#: Depth up to which a feature is taken for penetrated and not for "the far side of a fin" [m].
DEEPEST = 0.02


def height_of_ground(ground: GroundTable, x: float) -> float:
    """Height of the terrain at x [m]; at a riser the upper end."""
    lo = 0
    hi = ground.shape[0] - 2
    while lo < hi:
        mid = (lo + hi + 1) // 2
        if ground[mid, X] <= x:
            lo = mid
        else:
            hi = mid - 1
    if ground[lo, U_X] <= 0.0:
        return float(ground[lo + 1, Z])
    return float(ground[lo, Z] + (x - ground[lo, X]) * ground[lo, U_Z] / ground[lo, U_X])


def first_index(ground: GroundTable, x: float, hint: int) -> int:
    """Index of the last point left of x, looked for from a hint: ever farther, then halving."""
    n = ground.shape[0]
    k = int(min(max(hint, 0), n - 2))
    reach = 1
    if ground[k, X] < x:
        beyond = k + 1
        while beyond < n - 1 and ground[beyond, X] < x:
            k = beyond
            beyond = min(beyond + reach, n - 1)
            reach *= 2
    else:
        beyond = k
        k = max(k - 1, 0)
        while k > 0 and ground[k, X] >= x:
            beyond = k
            k = max(k - reach, 0)
            reach *= 2
    while beyond - k > 1:
        middle = (k + beyond) // 2
        if ground[middle, X] < x:
            k = middle
        else:
            beyond = middle
    return k


def disc_gap(
    ground: GroundTable, k: int, to_x: float, to_z: float, radius: float, best: float
) -> float:
    """Gap between a disc and a segment if it is less than ``best``, else ``best`` [m].

    Parameters
    ----------
    to_x, to_z
        From point k to the disc's centre [m].
    """
    u_x = ground[k, U_X]
    u_z = ground[k, U_Z]
    distance = u_x * to_z - u_z * to_x
    if distance - radius >= best or distance <= -DEEPEST:
        return best
    foot = to_x * u_x + to_z * u_z
    if foot < 0.0 or foot > ground[k, LENGTH]:
        return best
    if distance <= 0.0 and to_z + ground[k, Z] >= height_of_ground(ground, to_x + ground[k, X]):
        return best
    return float(distance - radius)


def nearest(
    ground: GroundTable,
    body: BodyTable,
    x: float,
    z: float,
    c: float,
    s: float,
    skip_1: int,
    skip_2: int,
    reach: float,
    hint: int,
) -> tuple[int, float, int]:
    """Feature with the smallest gap, two left out.

    Parameters
    ----------
    ground, body, x, z, c, s
        Tables and pose.
    skip_1, skip_2
        Features left out (the contacts that carry the robot), -1 for none.
    reach
        Gaps above this [m] need not be found.
    hint
        A point of the terrain near the rear of the robot, from the call before.

    Returns
    -------
    feature (-1: nothing within reach), gap [m], hint for the next call
    """
    n = ground.shape[0]
    best = reach
    which = NO_FEATURE
    new_hint = n
    for part in range(body.shape[0]):
        x1 = x + (c * body[part, X1] - s * body[part, Z1])
        z1 = z + (s * body[part, X1] + c * body[part, Z1])
        x2 = x + c * body[part, X2] - s * body[part, Z2]
        z2 = z + s * body[part, X2] + c * body[part, Z2]
        r1 = body[part, R1]
        r2 = body[part, R2]
        from_x = min(x1 - r1, x2 - r2)
        to_far = max(x1 + r1, x2 + r2)
        # a small disc may have stepped past a face altogether
        wide1 = max(best, DEEPEST - r1)
        wide2 = max(best, DEEPEST - r2)
        left = from_x - max(wide1, wide2)
        right = to_far + max(wide1, wide2)
        # axis of the part in the world
        e_x = c * body[part, E_X] - s * body[part, E_Z]
        e_z = s * body[part, E_X] + c * body[part, E_Z]
        side = body[part, SIDE]
        sine = body[part, SINE]
        cosine = body[part, COSINE]
        flat = body[part, FLAT]
        thin = INSIDE - min(r1, r2)
        left1 = x1 - r1 - wide1
        right1 = x1 + r1 + wide1
        left2 = x2 - r2 - wide2
        right2 = x2 + r2 + wide2
        k = first_index(ground, left, hint)
        hint = k
        if k < new_hint:
            new_hint = k
        while k < n - 1 and ground[k, X] <= right:
            g_x = ground[k, X]
            g_z = ground[k, Z]
            a_x = g_x - x1
            a_z = g_z - z1
            along = a_x * e_x + a_z * e_z
            below = side * (a_x * e_z - a_z * e_x)
            if below < 0.0 and (below < -thin or g_x <= from_x or g_x >= to_far):
                below = -below
            distance = along * sine + below * cosine - r1  # to the line of the flat: no more
            if distance < best and ground[k, CONVEX] == 1.0 and g_x >= left:
                w = along * cosine - below * sine
                if w < 0.0:
                    distance = math.sqrt(along * along + below * below) - r1
                elif w > flat:
                    along -= body[part, AXIS]
                    distance = math.sqrt(along * along + below * below) - r2
                if distance < best:
                    feature = POINT * k + PART * part
                    if feature != skip_1 and feature != skip_2:
                        best = distance
                        which = feature
            next_x = ground[k + 1, X]
            for disc in range(DISC_1, DISC_2 + 1):
                if disc == DISC_1:
                    if next_x < left1 or g_x > right1:
                        continue
                    to_x = x1 - g_x
                    to_z = z1 - g_z
                    radius = r1
                else:
                    if next_x < left2 or g_x > right2:
                        continue
                    to_x = x2 - g_x
                    to_z = z2 - g_z
                    radius = r2
                distance = disc_gap(ground, k, to_x, to_z, radius, best)
                if distance < best:
                    feature = POINT * k + PART * part + disc
                    if feature != skip_1 and feature != skip_2:
                        best = distance
                        which = feature
            k += 1
    if which < 0:
        best = FAR
    return which, best, new_hint
