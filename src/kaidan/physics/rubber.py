"""The inner loop of a yielding track: one rigid body on rubber at each contact, in the plane.

::

             n (into the robot)     a contact is a nosing under the outline, or an end on a tread
        robot ^                     or riser. Depth d below the undeformed outline:
       _______|____ outline           N = k d + c d'                    never pulls
          d |/                        T = kt s + ct s',  |T| <= mu N    s: shear since it was met
       -----*----> t (forward)      the force acts at the nosing, which stands still

Explicit in the forces, implicit in the places (symplectic Euler). Ordinary Python of floats and
arrays: `kaidan.physics.planar` hands it to numba.
"""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.float64]

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


def shear_when_met(shear: Array, touching: Flags, row: int, i: int) -> float:
    """Shear with which a contact begins [m].

    Driven from a corner onto the piece behind it, or from a piece onto its corner, a contact
    changes its name and keeps its shear.
    """
    if row > 0:
        return shear[0, i] if touching[0, i] == 1.0 else 0.0
    kept = 0.0
    if i > 0:
        for other in range(1, len(touching)):
            if touching[other, i - 1] == 1.0:
                kept = shear[other, i - 1]
    return kept


def rubber_force(
    depth: float, closing: float, shear: float, sliding: float, dt: float, constants: Array
) -> tuple[float, float, float]:
    """Normal force, force along the belt [N], and the shear that is left [m].

    depth, closing: of the contact [m], and its rate [m/s].
    shear, sliding: before the step [m], and its rate [m/s].
    dt: step [s].
    constants, shape (8,): see `advance`.
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


def advance(
    state: Array,
    points: Array,
    owners: Array,
    corners: Array,
    parts: Array,
    discs: Array,
    shear: Array,
    touching: Flags,
    constants: Array,
    first: int,
    last: int,
    steps: int,
    dt: float,
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
    shear, shape (1 + e, n): shear of each contact, of corners and of each end on each piece [m];
        changed in place.
    touching, shape (1 + e, n): 1 where there is one; changed in place.
    constants, shape (8,): mass [kg], inertia [kg m^2], k, kt [N/m], c, ct [N s/m], mu, gravity
        [m/s^2].
    first, last: points of the terrain that can be reached, the last one excluded.
    steps, dt: number and length [s].
    speed, change: of the belt at the start [m/s] and its rate [m/s^2].
    push, shape (2,): force at the centroid besides gravity [N].
    impulses, shape (r, 2): what the ground gave the robot by rows of `owners` [N s]; added to.
    """
    mass, inertia, gravity = constants[0], constants[1], constants[7]
    n, ends, contacts = len(points), len(discs), 0
    for step in range(steps):
        x, z, phi = state[0], state[1], state[2]
        v_x, v_z, w = state[3], state[4], state[5]
        cos, sin = math.cos(phi), math.sin(phi)
        belt = speed + change * step * dt
        f_x, f_z, moment, contacts = push[0], push[1] - mass * gravity, 0.0, 0
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
                contacts += 1
                if touching[row, i] == 0.0:
                    shear[row, i] = shear_when_met(shear, touching, row, i)
                touching[row, i] = 2.0
                t_x, t_z = n_z, -n_x
                r_x, r_z = at_x - x, at_z - z
                p_x, p_z = v_x - w * r_z, v_z + w * r_x
                closing = -(p_x * n_x + p_z * n_z)
                sliding = p_x * t_x + p_z * t_z - belt * runs
                normal, holding, shear[row, i] = rubber_force(
                    depth, closing, shear[row, i], sliding, dt, constants
                )
                g_x, g_z = normal * n_x - holding * t_x, normal * n_z - holding * t_z
                f_x += g_x
                f_z += g_z
                moment += r_x * g_z - r_z * g_x
                owner = int(owners[i, min(row, 1)])
                impulses[owner, 0] += g_x * dt
                impulses[owner, 1] += g_z * dt
        for i in range(first, last):
            for row in range(1 + ends):
                touching[row, i] = 1.0 if touching[row, i] == 2.0 else 0.0
        state[3] = v_x + f_x / mass * dt
        state[4] = v_z + f_z / mass * dt
        state[5] = w + moment / inertia * dt
        state[0] = x + state[3] * dt
        state[1] = z + state[4] * dt
        state[2] = phi + state[5] * dt
    return contacts
