"""Triangles of solids, and rays against them."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FEW_PAIRS = 20_000
"""Pairs of a ray and a triangle up to which all are worked out, without an index."""


@dataclass(frozen=True, eq=False)
class Triangles:
    """Faces of solids that look outward, counter-clockwise."""

    corners: Array
    """Shape (n, 3, 3) [m]."""
    owner: NDArray[np.int64]
    """Number of the solid of each."""

    @classmethod
    def of(cls, solids: "list[tuple[Array, NDArray[np.int64]]]") -> Self:
        """Triangles of solids given as vertices and faces.

        A closed solid of negative volume is inside out, as mirrored ones are, and is turned.
        """
        corners, owner = [np.zeros((0, 3, 3))], [np.zeros(0, dtype=np.int64)]
        for number, (vertices, faces) in enumerate(solids):
            each = vertices[faces]
            if len(each) and _volume(each) < 0:
                each = each[:, ::-1]
            corners.append(each)
            owner.append(np.full(len(each), number))
        return cls(np.concatenate(corners), np.concatenate(owner))

    @cached_property
    def normals(self) -> Array:
        """Normals, as long as twice the area, shape (n, 3) [m^2]."""
        a, b, c = (self.corners[:, k] for k in range(3))
        return np.asarray(np.cross(b - a, c - a))

    @cached_property
    def low(self) -> Array:
        """Least coordinates of each, shape (n, 3) [m]."""
        return np.asarray(self.corners.min(axis=1))

    @cached_property
    def high(self) -> Array:
        """Largest coordinates of each, shape (n, 3) [m]."""
        return np.asarray(self.corners.max(axis=1))

    def of_owners(self, owners: "set[int]") -> "Triangles":
        """Those of some solids."""
        keep = np.isin(self.owner, list(owners))
        return Triangles(self.corners[keep], self.owner[keep])

    def within(self, low: Array, high: Array) -> "Triangles":
        """Those that reach into a box."""
        keep = np.arange(len(self.corners))
        for axis in range(3):
            reaches = self.high[keep, axis] >= low[axis]
            keep = keep[reaches & (self.low[keep, axis] <= high[axis])]
        return Triangles(self.corners[keep], self.owner[keep])


def _volume(corners: Array) -> float:
    """Volume inside faces that look outward [m^3]; 0 within rounding for an open surface."""
    from_middle = corners - corners.reshape(-1, 3).mean(axis=0)
    a, b, c = (from_middle[:, k] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def first_hits(starts: Array, direction: Array, solids: Triangles) -> Array:
    """Distance from each start to the first face in a direction [m]; infinite: none.

    Parameters
    ----------
    starts : array, shape (n, 3)
        Where the rays begin [m].
    direction : array, shape (3,)
        Of all rays, of length 1.
    solids : Triangles

    Returns
    -------
    array, shape (n,)

    Seen along the direction each face is a triangle in a plane: a ray hits it where the barycentric
    coordinates of its point are none of them negative.
    """
    found = np.full(len(starts), np.inf)
    if len(solids.corners) == 0 or len(starts) == 0:
        return found
    frame = _frame(*direction.tolist())
    corners, points = solids.corners @ frame.T, starts @ frame.T
    low, high = points.min(axis=0), points.max(axis=0)
    near = (corners[:, :, :2].max(axis=1) >= low[:2] - 1e-9).all(axis=1)
    near &= (corners[:, :, :2].min(axis=1) <= high[:2] + 1e-9).all(axis=1)
    a = corners[near, 0]
    one, two = corners[near, 1] - a, corners[near, 2] - a
    determinant = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    meets = np.abs(determinant) > 1e-12
    a, one, two, determinant = a[meets], one[meets], two[meets], determinant[meets]
    if len(a) == 0:
        return found
    of_u = np.stack([two[:, 1], -two[:, 0]]) / determinant
    of_v = np.stack([-one[:, 1], one[:, 0]]) / determinant
    u_0, v_0 = ((each.T * a[:, :2]).sum(axis=1) for each in (of_u, of_v))
    of_t = of_u * one[:, 2] + of_v * two[:, 2]
    t_0 = a[:, 2] - u_0 * one[:, 2] - v_0 * two[:, 2]
    if len(a) * len(points) <= FEW_PAIRS:
        ray, face = (each.ravel() for each in np.indices((len(points), len(a))))
    else:
        ray, face = _near_in_plane(points, corners[near][meets])
    x, y, z = points[ray].T
    u, v = x * of_u[0, face] + y * of_u[1, face], x * of_v[0, face] + y * of_v[1, face]
    u, v = u - u_0[face], v - v_0[face]
    t = x * of_t[0, face] + y * of_t[1, face] + t_0[face] - z
    edge = 1e-9
    hit = (u >= -edge) & (v >= -edge) & (u + v <= 1 + edge) & (t > edge)
    np.minimum.at(found, ray[hit], t[hit])
    return found


def _frame(x: float, y: float, z: float) -> Array:
    """Two directions across a third one, and that one, as rows of a rotation."""
    if abs(z) > 0.9:
        length = math.hypot(z, x)
        a = (z / length, 0.0, -x / length)
    else:
        length = math.hypot(x, y)
        a = (-y / length, x / length, 0.0)
    b = (y * a[2] - z * a[1], z * a[0] - x * a[2], x * a[1] - y * a[0])
    return np.array([a, b, (x, y, z)])


def _near_in_plane(points: Array, corners: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Pairs of a point and a triangle whose box in the plane it lies in."""
    import shapely

    low, high = corners[:, :, :2].min(axis=1) - 1e-9, corners[:, :, :2].max(axis=1) + 1e-9
    tree = shapely.STRtree(shapely.box(*low.T, *high.T))
    ray, face = tree.query(shapely.points(points[:, :2]))
    return ray, face
