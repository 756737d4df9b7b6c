"""Small flat pieces of a cloud: one for each cube of a raster, with a normal.

Sums over the points of a cube give its covariance; the direction of least spread is the normal.
No search for points nearby is needed, so it costs a sort and a few passes over the points.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices

SIDE = 0.10
"""Side of a cube [m]: less than a tread or a riser."""
SMALL = 0.05
"""Side of a cube in which the scatter is measured [m]."""
FEWEST = 6
"""Points that make a patch."""
FLAT = 0.35
"""Largest spread across a patch as a share of its second spread."""


@dataclass(frozen=True, eq=False)
class Patches:
    """Flat pieces of a cloud."""

    middle: Array
    """Shape (p, 3) [m]."""
    normal: Array
    """Unit vectors towards the sensor where it is known, shape (p, 3)."""
    weight: Array
    """Points of each, at most 30, shape (p,)."""
    thickness: Array
    """Root mean square distance of the points from the patch, shape (p,) [m]."""
    of_point: Indices
    """Patch of each point, shape (n,); -1: none."""


def scatter(xyz: Array) -> float:
    """Scatter of the points across small pieces of surface [m].

    Of pieces that are seen face on: along the ray it is larger than across a floor seen from the
    side. Small ones, because larger ones bend over the edges of steps.
    """
    for side in (SMALL, SIDE):
        _, counts, values, _, _ = _spreads(xyz, side, 8)
        if len(counts) >= 40:
            break
    else:
        return 0.0
    thick = np.maximum(values[:, 0], 0.0) * counts / (counts - 3.0)
    thin = values[:, 1] > (0.15 * side) ** 2  # a line of points has no thickness
    return float(np.sqrt(np.percentile(thick[thin], 70))) if thin.any() else 0.0


def cubes(xyz: Array, side: float) -> tuple[Indices, Indices, Indices]:
    """Order of the points by their cubes, where each cube begins in it, and how many it holds."""
    x, y, z = (np.floor(each * (1.0 / side)).astype(np.int64) for each in xyz.T)
    keys, count = x - x.min(), len(xyz)
    for each in (y, z):  # column by column: least and greatest of short rows take ten times as long
        low = each.min()
        keys = keys * (each.max() - low + 1) + (each - low)
    if int(keys.max()) < (2**63 - count) // count:  # key and row in one number sort much faster
        keys, order = np.divmod(np.sort(keys * count + np.arange(count)), count)
    else:
        order = np.argsort(keys, kind="stable")
        keys = keys[order]
    begins = np.flatnonzero(np.r_[True, keys[1:] != keys[:-1]])
    return order, begins, np.diff(np.r_[begins, len(keys)])


def thinned(xyz: Array, side: float) -> Indices:
    """Rows of one point of each cube."""
    order, begins, counts = cubes(xyz, side)
    return np.asarray(order[begins + counts // 2])


def _spreads(xyz: Array, side: float, fewest: int) -> tuple[Array, Array, Array, Array, Indices]:
    """Middles, counts, principal variances and axes of the cubes, and the cube of each point."""
    order, begins, counts = cubes(xyz, side)
    n = counts[:, None].astype(np.float64)
    ordered = [each[order] for each in xyz.T]
    middle = np.column_stack([np.add.reduceat(each, begins) for each in ordered]) / n
    of_cube = np.repeat(np.arange(len(counts)), counts)
    off = [each - mean[of_cube] for each, mean in zip(ordered, middle.T, strict=True)]
    rows, columns = np.triu_indices(3)
    pairs = zip(rows, columns, strict=True)
    second = np.column_stack([np.add.reduceat(off[i] * off[j], begins) for i, j in pairs]) / n
    many = np.flatnonzero(counts >= fewest)
    spread = np.empty((len(many), 3, 3))
    spread[:, rows, columns] = spread[:, columns, rows] = second[many]
    values, vectors = np.linalg.eigh(spread)
    number = np.full(len(counts), -1)
    number[many] = np.arange(len(many))
    of_point = np.empty(len(xyz), dtype=np.int64)
    of_point[order] = number[of_cube]
    return middle[many], counts[many].astype(np.float64), values, vectors[:, :, 0], of_point


def patches_of(xyz: Array, viewpoint: Array | None, side: float = SIDE) -> Patches:
    """Flat pieces of a cloud, shape (n, 3) [m]."""
    middle, counts, values, normal, of_point = _spreads(xyz, side, FEWEST)
    flat = values[:, 0] < FLAT**2 * values[:, 1]
    number = np.full(len(flat) + 1, -1)
    number[:-1][flat] = np.arange(int(flat.sum()))
    middle, counts, values, normal = middle[flat], counts[flat], values[flat], normal[flat]
    if viewpoint is not None:
        towards = np.einsum("ij,ij->i", normal, viewpoint - middle)
        normal = np.where(towards[:, None] < 0, -normal, normal)
    # three parameters of the plane are fitted to the points of a patch
    thickness = np.sqrt(np.maximum(values[:, 0], 0.0) * counts / np.maximum(counts - 3.0, 1.0))
    return Patches(middle, normal, np.minimum(counts, 30.0), thickness, number[of_point])


def directions(patches: Patches, most: int = 4) -> list[Array]:
    """Directions in which most patches look, both ends of an axis being one, most first."""
    normals, weights = patches.normal, patches.weight.copy()
    found: list[Array] = []
    for _ in range(most):
        if weights.sum() < 0.03 * patches.weight.sum() or not len(normals):
            break
        step = max(1, len(normals) // 150)
        seeds = normals[::step]
        near: NDArray[np.bool_] = np.abs(seeds @ normals.T) > np.cos(np.radians(8.0))
        best = seeds[int(np.argmax(near @ weights))]
        for _ in range(3):
            along = normals @ best
            close = np.abs(along) > np.cos(np.radians(8.0))
            pull = (np.sign(along) * weights * close) @ normals
            best = pull / max(float(np.linalg.norm(pull)), 1e-12)
        weights = np.where(np.abs(normals @ best) > np.cos(np.radians(12.0)), 0.0, weights)
        found.append(best)
    return found
