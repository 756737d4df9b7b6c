"""Small flat pieces of a cloud: one for each cube of a raster, with a normal.

Sums over the points of a cube give its covariance; the direction of least spread is the normal.
No search for points nearby is needed, so it costs a sort and a few passes over the points. The
sums of a cube of twice the side are those of the eight in it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.quantiles import quantile

SMALL = 0.05
"""Side of a cube in which the scatter is measured [m]. Patches are made in cubes of twice the side,
which is less than a tread or a riser."""
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


@dataclass(frozen=True, eq=False)
class Raster:
    """Cubes of a raster that hold points, with the sums over those of each."""

    side: float
    """Of a cube [m]."""
    place: Indices
    """Number of each cube along x, y and z, shape (3, m)."""
    count: Array
    """Points of each, shape (m,)."""
    first: Array
    """Sums of their coordinates from the low corner of the cube, shape (3, m) [m]."""
    second: Array
    """Sums of the products xx, xy, xz, yy, yz, zz of them, shape (6, m) [m^2]."""
    of_point: Indices
    """Cube of each point, shape (n,)."""


def rastered(xyz: Array, side: float) -> Raster:
    """Raster of points, shape (n, 3) [m]."""
    place = np.floor(xyz.T * (1.0 / side))
    order, begins, counts = in_cubes(place)
    of_point = np.empty(len(xyz), dtype=np.int64)
    of_point[order] = np.repeat(np.arange(len(counts)), counts)
    away = xyz.T - place * side
    sums = [np.bincount(of_point, weights=each) for each in (*away, *_products(away))]
    return Raster(
        side=side,
        place=place[:, order[begins]].astype(np.int64),
        count=counts.astype(np.float64),
        first=np.array(sums[:3]),
        second=np.array(sums[3:]),
        of_point=of_point,
    )


def joined(fine: Raster) -> Raster:
    """Raster of cubes of twice the side, from the sums of those that they consist of."""
    place, odd = fine.place >> 1, (fine.place & 1).astype(np.float64)
    order, begins, counts = in_cubes(place.astype(np.float64))
    of_cube = np.empty(fine.place.shape[1], dtype=np.int64)
    of_cube[order] = np.repeat(np.arange(len(counts)), counts)
    shift = odd * fine.side
    first = fine.first + shift * fine.count
    # sums of (u + a)(v + b) over the points, from those of uv, u and v
    crossed = [shift[i] * fine.first[j] + fine.first[i] * shift[j] for i, j in _PAIRS]
    second = fine.second + crossed + _products(shift) * fine.count
    sums = [np.bincount(of_cube, weights=each) for each in (fine.count, *first, *second)]
    return Raster(
        side=2 * fine.side,
        place=place[:, order[begins]],
        count=sums[0].astype(np.float64),
        first=np.array(sums[1:4]),
        second=np.array(sums[4:]),
        of_point=of_cube[fine.of_point],
    )


_PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


def _products(each: Array) -> Array:
    return np.array([each[i] * each[j] for i, j in _PAIRS])


def in_cubes(place: Array) -> tuple[Indices, Indices, Indices]:
    """Order of the points by their cubes, where each cube begins in it, and how many it holds."""
    low, high = place.min(axis=1), place.max(axis=1)
    wide = (high - low + 1).astype(np.int64)
    x, y, z = (place - low[:, None]).astype(np.int64)
    keys, count = (x * wide[1] + y) * wide[2] + z, place.shape[1]
    bits = count.bit_length()
    if int(keys.max()).bit_length() + bits < 63:  # key and row in one number sort much faster
        both = np.sort((keys << bits) | np.arange(count))
        keys, order = both >> bits, both & ((1 << bits) - 1)
    else:
        order = np.argsort(keys, kind="stable")
        keys = keys[order]
    begins = np.flatnonzero(np.r_[True, keys[1:] != keys[:-1]])
    return order, begins, np.diff(np.r_[begins, count])


def thinned(xyz: Array, side: float) -> Indices:
    """Rows of one point of each cube."""
    order, begins, counts = in_cubes(np.floor(xyz.T * (1.0 / side)))
    return np.asarray(order[begins + counts // 2])


def scatter(raster: Raster) -> float:
    """Scatter of the points across small pieces of surface [m], from a raster of small cubes.

    Of pieces that are seen face on: along the ray it is larger than across a floor seen from the
    side. Small ones, because larger ones bend over the edges of steps; where few hold points
    enough, those of twice the side.
    """
    each = raster
    cube, _, covariance = _spread(each, 8)
    if len(cube) < 40:
        each = joined(raster)
        cube, _, covariance = _spread(each, 8)
    if len(cube) < 40:
        return 0.0
    thin, middling, _ = principal(covariance)
    thick = np.maximum(thin, 0.0) * each.count[cube] / (each.count[cube] - 3.0)
    flat = middling > (0.15 * each.side) ** 2  # a line of points has no thickness
    return float(np.sqrt(quantile(thick[flat], 0.7))) if flat.any() else 0.0


def _spread(raster: Raster, fewest: int) -> tuple[Indices, Array, Array]:
    """Cubes that hold points enough, shape (p,), and mean and covariance of the points of each.

    The mean from the low corner of the cube, shape (3, p) [m]; xx, xy, xz, yy, yz, zz, shape
    (6, p) [m^2].
    """
    cube = np.flatnonzero(raster.count >= fewest)
    n = raster.count[cube]
    mean = raster.first.take(cube, axis=1) / n
    return cube, mean, raster.second.take(cube, axis=1) / n - _products(mean)


def principal(covariance: Array) -> Array:
    """Principal variances of many covariances, shape (3, m), the least first.

    The roots of the characteristic cubic by its angle (Smith 1961, doi:10.1145/355578.366316).

    covariance, shape (6, m): xx, xy, xz, yy, yz, zz of each.

    Examples
    --------
    >>> principal(np.array([[4.0], [0.0], [0.0], [1.0], [0.0], [9.0]]))[:, 0].round(9).tolist()
    [1.0, 4.0, 9.0]
    """
    xx, xy, xz, yy, yz, zz = covariance
    mean = (xx + yy + zz) / 3
    a, b, c = xx - mean, yy - mean, zz - mean
    size = np.sqrt((a * a + b * b + c * c + 2 * (xy * xy + xz * xz + yz * yz)) / 6)
    product = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)
    angle = np.arccos(np.clip(product / np.maximum(2 * size**3, 1e-300), -1.0, 1.0)) / 3
    most = mean + 2 * size * np.cos(angle)
    least = mean + 2 * size * np.cos(angle + 2 * np.pi / 3)
    return np.array([least, 3 * mean - most - least, most])


def thinnest(covariance: Array, least: Array) -> Array:
    """Directions of the least variances, unit vectors of either sign, shape (m, 3).

    The longest product of two rows of the covariance less its least root.

    Examples
    --------
    >>> thinnest(np.array([[4.0], [0.0], [0.0], [1.0], [0.0], [9.0]]), np.array([1.0]))
    array([[0., 1., 0.]])
    """
    xx, xy, xz, yy, yz, zz = covariance
    a, b, c = xx - least, yy - least, zz - least
    products = np.array([
        [xy * yz - xz * b, xz * xy - a * yz, a * b - xy * xy],
        [xz * yz - xy * c, a * c - xz * xz, xy * xz - a * yz],
        [b * c - yz * yz, yz * xz - xy * c, xy * yz - b * xz],
    ])  # fmt: skip
    length = (products**2).sum(axis=1)
    best, every = length.argmax(axis=0), np.arange(len(least))
    found = products[best, :, every] / np.sqrt(np.maximum(length[best, every], 1e-300))[:, None]
    return np.asarray(found)


def patches_of(raster: Raster, viewpoint: Array | None) -> Patches:
    """Flat pieces of a cloud, one for each cube of a raster of it that holds points enough."""
    cube, mean, covariance = _spread(raster, FEWEST)
    values = principal(covariance)
    flat = np.flatnonzero(values[0] < FLAT**2 * values[1])
    number = np.full(len(raster.count), -1)
    number[cube[flat]] = np.arange(len(flat))
    cube, least, count = cube[flat], values[0, flat], raster.count[cube[flat]]
    middle = (raster.place.take(cube, axis=1) * raster.side + mean.take(flat, axis=1)).T
    normal = thinnest(covariance.take(flat, axis=1), least)
    if viewpoint is not None:
        towards = np.einsum("ij,ij->i", normal, viewpoint - middle)
        normal = np.where(towards[:, None] < 0, -normal, normal)
    # three parameters of the plane are fitted to the points of a patch
    thickness = np.sqrt(np.maximum(least, 0.0) * count / np.maximum(count - 3.0, 1.0))
    return Patches(middle, normal, np.minimum(count, 30.0), thickness, number[raster.of_point])


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
