"""The inner loop of a yielding track: one rigid body on rubber at each contact, in the plane.

::

             n (into the robot)     a contact is a nosing under the outline, or an end on a tread
        robot ^                     or riser. Depth d below the undeformed outline:
       _______|____ outline           N = k d + c d'                    never pulls
          d |/                        T = kt s + ct s',  |T| <= mu N    s: shear since it was met
       -----*----> t (forward)      the force acts at the nosing, which stands still

Half-round grousers, if any, are discs on the outline that the belt carries round; each of the two
belts has half of the rubber under them. Explicit in the forces, implicit in the places (symplectic
Euler). Ordinary Python of floats and arrays: `kaidan.physics.planar` hands it to numba.
"""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

THINNEST = 0.03
"""Depth up to which thinner parts than this count as pressed in, and not passed through [m]."""


def depth_below(part: Array, x: float, z: float, thickest: float) -> tuple[float, float, float]:
    """Depth of a point inside a part's outline from below [m], and the outward normal there.

    part, shape (12,): discs x, z, r, x, z, r [m]; start x, z, unit vector and length of the lower
        tangent, its outward normal's x (z follows from the unit vector).
    x, z: point in the body's frame [m].
    thickest: depth from which the point is taken to lie above the part [m].
    """
    e_x, e_z = part[8], part[9]
    away_x, away_z = x - part[6], z - part[7]
    s = away_x * e_x + away_z * e_z
    if 0.0 <= s <= part[10]:
        depth = -(away_x * e_z - away_z * e_x)  # the normal is (e_z, -e_x)
        return (depth if depth < thickest else 0.0), e_z, -e_x
    at = 0 if s < 0.0 else 3
    d_x, d_z = x - part[at], z - part[at + 1]
    apart = math.sqrt(d_x * d_x + d_z * d_z)
    if apart >= part[at + 2] or apart < 1e-9:
        return 0.0, 0.0, -1.0
    return part[at + 2] - apart, d_x / apart, d_z / apart


def corner_met(
    points: Array, i: int, kind: float, parts: Array, x: float, z: float, cos: float, sin: float
) -> tuple[float, float, float, float]:
    """Depth of a corner inside the robot [m], the normal there into it, and 1 of a belt that runs.

    points, i, shape (n, 2): terrain, and which of its points.
    kind: see `corners` of `advance`.
    parts, shape (m, 12): see `depth_below`.
    x, z, cos, sin: centroid [m], cosine and sine of the inclination.
    """
    depth, n_x, n_z, runs = 0.0, 0.0, 0.0, 0.0
    r_x, r_z = points[i, 0] - x, points[i, 1] - z
    own_x, own_z = cos * r_x + sin * r_z, cos * r_z - sin * r_x
    for m in range(len(parts)):
        thickest = max(parts[m, 2] + parts[m, 5], THINNEST)
        deep, out_x, out_z = depth_below(parts[m], own_x, own_z, thickest)
        if deep > depth:
            depth, runs = deep, parts[m, 11]
            n_x, n_z = sin * out_z - cos * out_x, -sin * out_x - cos * out_z
    if depth > 0.0 and kind == 1.0:
        before_x = points[i, 0] - points[i - 1, 0]
        before_z = points[i, 1] - points[i - 1, 1]
        after_x = points[i + 1, 0] - points[i, 0]
        after_z = points[i + 1, 1] - points[i, 1]
        if n_x * before_x + n_z * before_z < -1e-12 or n_x * after_x + n_z * after_z > 1e-12:
            depth = 0.0  # the tread or the riser is met, not the corner
    return depth, n_x, n_z, runs


def end_met(
    points: Array, i: int, discs: Array, e: int, x: float, z: float, cos: float, sin: float
) -> tuple[float, float, float, float]:
    """Depth of an end below the piece after a point, its foot on that piece [m], and its direction.

    points, i, shape (n, 2): terrain, and where the piece begins.
    discs, e, shape (e, 4): ends, see `advance`, and which of them.
    x, z, cos, sin: see `corner_met`.
    """
    along_x = points[i + 1, 0] - points[i, 0]
    along_z = points[i + 1, 1] - points[i, 1]
    length = math.sqrt(along_x * along_x + along_z * along_z)
    along_x, along_z = along_x / length, along_z / length
    c_x = x + cos * discs[e, 0] - sin * discs[e, 1]
    c_z = z + sin * discs[e, 0] + cos * discs[e, 1]
    a_x, a_z = c_x - points[i, 0], c_z - points[i, 1]
    s = a_x * along_x + a_z * along_z
    high = a_z * along_x - a_x * along_z
    radius = discs[e, 2]
    if 0.0 <= s <= length and -max(radius, THINNEST) < high < radius:
        return radius - high, s, along_x, along_z
    return 0.0, s, along_x, along_z


def shear_when_met(
    shear: Array,
    touched: Array,
    before: float,
    row: int,
    i: int,
    corner: int,
    first: int,
    last: int,
) -> float:
    """Shear with which a contact begins [m].

    Driven from a corner onto the piece behind it, or from a piece onto its corner, a contact
    changes its name and keeps its shear.

    touched, before: see `advance`, and the step before.
    corner, first, last: rows of the same rubber at corners, and on pieces, the last one excluded.
    """
    if row != corner:
        return shear[corner, i] if touched[corner, i] == before else 0.0
    kept = 0.0
    if i > 0:
        for other in range(first, last):
            if touched[other, i - 1] == before:
                kept = shear[other, i - 1]
    return kept


def carry_round(
    bars: Array,
    part: Array,
    run: float,
    belt: float,
    window: float,
    x: float,
    cos: float,
    sin: float,
) -> None:
    """Put grousers where a belt has them: `bars` but its columns 0 and 3 (see `advance`).

    part, shape (12,): the belt's, see `depth_below`.
    run, belt: how far it has run [m], and its speed [m/s].
    window: length along the belt over which grousers come round [m], a whole number of spacings.
    x, cos, sin: centroid [m], cosine and sine of the inclination.
    """
    length, down, behind = part[10], math.atan2(-part[8], part[9]), math.pi * part[2]
    run = run % window
    for j in range(len(bars)):
        along = bars[j, 0] - run - behind
        if along < -behind:
            along += window
        angle, turning = down, 0.0
        own_x, own_z = part[6] + along * part[8], part[7] + along * part[9]
        if along < 0.0:
            angle, turning = down + along / part[2], -belt / part[2]
            own_x = part[0] + part[2] * math.cos(angle)
            own_z = part[1] + part[2] * math.sin(angle)
        elif along > length:
            angle, turning = down + (along - length) / part[5], -belt / part[5]
            own_x = part[3] + part[5] * math.cos(angle)
            own_z = part[4] + part[5] * math.sin(angle)
        bars[j, 1], bars[j, 2], bars[j, 6] = own_x, own_z, turning
        bars[j, 4], bars[j, 5] = belt * math.sin(angle), -belt * math.cos(angle)
        bars[j, 7] = x + cos * own_x - sin * own_z


def tip_met(
    points: Array,
    i: int,
    kind: float,
    bars: Array,
    j: int,
    x: float,
    z: float,
    cos: float,
    sin: float,
) -> tuple[float, float, float]:
    """Depth of a corner inside a grouser [m], and the normal there into the robot.

    bars, j, shape (b, 8): see `advance`, and which of them.
    points, i, kind, x, z, cos, sin: see `corner_met`.
    """
    d_x = points[i, 0] - x - cos * bars[j, 1] + sin * bars[j, 2]
    d_z = points[i, 1] - z - sin * bars[j, 1] - cos * bars[j, 2]
    apart = math.sqrt(d_x * d_x + d_z * d_z)
    if apart >= bars[j, 3] or apart < 1e-9:
        return 0.0, 0.0, 1.0
    n_x, n_z = -d_x / apart, -d_z / apart
    if kind == 1.0:
        before_x = points[i, 0] - points[i - 1, 0]
        before_z = points[i, 1] - points[i - 1, 1]
        after_x = points[i + 1, 0] - points[i, 0]
        after_z = points[i + 1, 1] - points[i, 1]
        if n_x * before_x + n_z * before_z < -1e-12 or n_x * after_x + n_z * after_z > 1e-12:
            return 0.0, 0.0, 1.0  # the tread or the riser is met, not the corner
    return bars[j, 3] - apart, n_x, n_z


def rubber_force(
    depth: float, closing: float, shear: float, sliding: float, dt: float, constants: Array
) -> tuple[float, float, float]:
    """Normal force, force along the belt [N], and the shear that is left [m].

    depth, closing: of the contact [m], and its rate [m/s].
    shear, sliding: before the step [m], and its rate [m/s].
    dt: step [s].
    constants, shape (9,): see `advance`.
    """
    k, kt, c, ct, mu = constants[2], constants[3], constants[4], constants[5], constants[6]
    normal = k * depth + c * closing
    if normal <= 0.0:
        normal = 0.0
    moved = shear + sliding * dt
    holding = kt * moved + ct * sliding
    if holding > mu * normal:
        holding = mu * normal
        moved = min(moved, holding / kt)
    elif holding < -mu * normal:
        holding = -mu * normal
        moved = max(moved, holding / kt)
    return normal, holding, moved


def first_near(points: Array, first: int, last: int, x: float) -> int:
    """First point from whose piece on something at x [m] may be met: the last before it.

    points, first, last: see `advance`.
    """
    low, high = first, last
    while low < high:
        middle = (low + high) // 2
        if points[middle, 0] < x:
            low = middle + 1
        else:
            high = middle
    return max(first, low - 1)


def add_contact(
    total: Array,
    impulses: Array,
    owner: int,
    state: Array,
    shear: Array,
    row: int,
    i: int,
    at_x: float,
    at_z: float,
    n_x: float,
    n_z: float,
    depth: float,
    carried_x: float,
    carried_z: float,
    share: float,
    dt: float,
    constants: Array,
) -> None:
    """Add what a contact does to the robot, and keep its shear.

    total, shape (4,): force x, z [N], moment [N m] and number of contacts; changed in place.
    impulses, owner, state, shear, row, i, dt, constants: see `advance`.
    at_x, at_z, n_x, n_z: where it is [m], and its normal into the robot.
    depth: [m]
    carried_x, carried_z: velocity of the rubber in the robot [m/s].
    share: of the stiffnesses of both belts.
    """
    t_x, t_z = n_z, -n_x
    r_x, r_z = at_x - state[0], at_z - state[1]
    p_x = state[3] - state[5] * r_z + carried_x
    p_z = state[4] + state[5] * r_x + carried_z
    closing = -(p_x * n_x + p_z * n_z)
    sliding = p_x * t_x + p_z * t_z
    normal, holding, shear[row, i] = rubber_force(
        depth, closing, shear[row, i], sliding, dt, constants
    )
    g_x, g_z = share * (normal * n_x - holding * t_x), share * (normal * n_z - holding * t_z)
    total[0] += g_x
    total[1] += g_z
    total[2] += r_x * g_z - r_z * g_x
    total[3] += 1.0
    impulses[owner, 0] += g_x * dt
    impulses[owner, 1] += g_z * dt


def meet_grousers(
    total: Array,
    impulses: Array,
    owners: Array,
    state: Array,
    points: Array,
    corners: Array,
    bars: Array,
    shear: Array,
    touched: Array,
    now: float,
    first: int,
    last: int,
    dt: float,
    constants: Array,
) -> None:
    """Add the contacts of grousers with corners and pieces; each belt has half of the rubber.

    total: see `add_contact`; now: number of the step; all else: see `advance`.
    """
    x, z, cos, sin = state[0], state[1], math.cos(state[2]), math.sin(state[2])
    n, count = len(points), len(bars)
    ends = len(shear) - 1 - 2 * count
    for j in range(count):
        i = first_near(points, first, last, bars[j, 7] - bars[j, 3]) - 1
        corner = 1 + ends + j
        while i + 1 < last and points[i + 1, 0] < bars[j, 7] + bars[j, 3]:
            i += 1
            if i < first:
                continue
            for row in (corner, corner + count):
                if row == corner:
                    if corners[i] == 0.0:
                        continue
                    depth, n_x, n_z = tip_met(points, i, corners[i], bars, j, x, z, cos, sin)
                    at_x, at_z = points[i, 0], points[i, 1]
                elif i + 1 < n and corners[i] != 2.0:
                    depth, s, t_x, t_z = end_met(points, i, bars[:, 1:], j, x, z, cos, sin)
                    n_x, n_z = -t_z, t_x
                    at_x, at_z = points[i, 0] + s * t_x, points[i, 1] + s * t_z
                else:
                    continue
                if depth <= 0.0:
                    continue
                if touched[row, i] < now - 1.0:
                    shear[row, i] = shear_when_met(
                        shear,
                        touched,
                        now - 1.0,
                        row,
                        i,
                        corner,
                        corner + count,
                        corner + count + 1,
                    )
                touched[row, i] = now
                off_x = at_x - x - cos * bars[j, 1] + sin * bars[j, 2]
                off_z = at_z - z - sin * bars[j, 1] - cos * bars[j, 2]
                add_contact(
                    total,
                    impulses,
                    int(owners[i, 0 if row == corner else 1]),
                    state,
                    shear,
                    row,
                    i,
                    at_x,
                    at_z,
                    n_x,
                    n_z,
                    depth,
                    cos * bars[j, 4] - sin * bars[j, 5] - bars[j, 6] * off_z,
                    sin * bars[j, 4] + cos * bars[j, 5] + bars[j, 6] * off_x,
                    0.5,
                    dt,
                    constants,
                )


def advance(
    state: Array,
    points: Array,
    owners: Array,
    corners: Array,
    parts: Array,
    discs: Array,
    bars: Array,
    shear: Array,
    touched: Array,
    constants: Array,
    first: int,
    last: int,
    done: int,
    steps: int,
    dt: float,
    run: float,
    speed: float,
    change: float,
    push: Array,
    impulses: Array,
) -> int:
    """Advance the body by some steps; the number of contacts at the end.

    state, shape (6,): centroid x, z [m], inclination [rad] and their rates; changed in place.
    points, shape (n, 2): terrain from left to right [m].
    owners, shape (n, 2): row of `impulses` that a corner and the piece that follows it belong to.
    corners, shape (n,): 1 for a corner that stands out (a nosing), 0 for any other; 2: a nosing
        alone, which may be touched from any side and has no tread.
    parts, shape (m, 12): see `depth_below`; the twelfth is 1 for a belt that runs.
    discs, shape (e, 4): ends: x, z, radius [m], 1 for a belt that runs.
    bars, shape (b, 8): grousers of the first part: place along the belt before it has run, x, z,
        radius [m], velocity in x and z [m/s] and turning [rad/s] in the robot, x in space [m];
        changed in place.
    shear, shape (1 + e + 2 b, n): shear of each contact, of corners, of each end on each piece, of
        each grouser at each corner and on each piece [m]; changed in place.
    touched, the same shape: number of the step in which there was one last; changed in place.
    constants, shape (9,): mass [kg], inertia [kg m^2], k, kt [N/m], c, ct [N s/m], mu, gravity
        [m/s^2], window of `carry_round` [m].
    first, last: points of the terrain that can be reached, the last one excluded.
    done, steps, dt: steps before, number of steps, and their length [s].
    run: how far the belt has run [m].
    speed, change: of the belt at the start [m/s] and its rate [m/s^2].
    push, shape (3,): force at the centroid besides gravity [N], and moment about it [N m].
    impulses, shape (r, 2): what the ground gave the robot by rows of `owners` [N s]; added to.
    """
    mass, inertia, gravity = constants[0], constants[1], constants[7]
    n, ends, total = len(points), len(discs), np.zeros(4)
    for step in range(steps):
        x, z, phi = state[0], state[1], state[2]
        cos, sin = math.cos(phi), math.sin(phi)
        belt, now = speed + change * step * dt, float(done + step + 1)
        carry_round(bars, parts[0], run, belt, constants[8], x, cos, sin)
        run += belt * dt
        total[0], total[1], total[2], total[3] = push[0], push[1] - mass * gravity, push[2], 0.0
        for i in range(first, last):
            for row in range(1 + ends):
                if row == 0:
                    if corners[i] == 0.0:
                        continue
                    depth, n_x, n_z, runs = corner_met(points, i, corners[i], parts, x, z, cos, sin)
                    at_x, at_z = points[i, 0], points[i, 1]
                elif i + 1 < n and corners[i] != 2.0:
                    depth, s, t_x, t_z = end_met(points, i, discs, row - 1, x, z, cos, sin)
                    n_x, n_z, runs = -t_z, t_x, discs[row - 1, 3]
                    at_x, at_z = points[i, 0] + s * t_x, points[i, 1] + s * t_z
                else:
                    continue
                if depth <= 0.0:
                    continue
                if touched[row, i] < now - 1.0:
                    shear[row, i] = shear_when_met(
                        shear, touched, now - 1.0, row, i, 0, 1, 1 + ends
                    )
                touched[row, i] = now
                add_contact(
                    total,
                    impulses,
                    int(owners[i, min(row, 1)]),
                    state,
                    shear,
                    row,
                    i,
                    at_x,
                    at_z,
                    n_x,
                    n_z,
                    depth,
                    -belt * runs * n_z,
                    belt * runs * n_x,
                    1.0,
                    dt,
                    constants,
                )
        meet_grousers(
            total,
            impulses,
            owners,
            state,
            points,
            corners,
            bars,
            shear,
            touched,
            now,
            first,
            last,
            dt,
            constants,
        )
        state[3] += total[0] / mass * dt
        state[4] += total[1] / mass * dt
        state[5] += total[2] / inertia * dt
        state[0] = x + state[3] * dt
        state[1] = z + state[4] * dt
        state[2] = phi + state[5] * dt
    return int(total[3])
