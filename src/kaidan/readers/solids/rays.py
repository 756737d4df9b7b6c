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
WELDED = 1e-5
"""Distance up to which corners are one, so that their faces are of one surface [m]."""
WAYS = (
    np.array([0.0, 0.0, 1.0]),
    *(
        np.array([math.cos(2.4 * k) * flat, math.sin(2.4 * k) * flat, z])
        for k, z in enumerate(np.linspace(0.83, -0.91, 15).tolist())
        for flat in [math.sqrt(1.0 - z**2)]
    ),
)
"""Directions in which it is looked whether a point lies inside a surface: up, and all round."""
_MIXED = np.array([73_856_093, 19_349_663, 83_492_791], dtype=np.int64)


@dataclass(frozen=True, eq=False)
class Triangles:
    """Faces of solids, whichever way they look."""

    corners: Array
    """Shape (n, 3, 3) [m]."""
    owner: NDArray[np.int64]
    """Number of the solid of each."""

    @classmethod
    def of(cls, solids: "list[tuple[Array, NDArray[np.int64]]]") -> Self:
        """Triangles of solids given as vertices and faces."""
        corners = [np.zeros((0, 3, 3)), *(vertices[faces] for vertices, faces in solids)]
        owner = np.repeat(np.arange(len(solids)), [len(faces) for _, faces in solids])
        return cls(np.concatenate(corners), owner)

    @cached_property
    def normals(self) -> Array:
        """Normals, as long as twice the area, shape (n, 3) [m^2]."""
        a, b, c = (self.corners[:, k] for k in range(3))
        return np.asarray(np.cross(b - a, c - a))

    @cached_property
    def shells(self) -> NDArray[np.int64]:
        """Number of the connected surface that each belongs to, shape (n,)."""
        if len(self.corners) == 0:
            return self.owner
        places = (self.corners.reshape(-1, 3) / WELDED).round().astype(np.int64)
        keys = places @ _MIXED + np.repeat(self.owner, 3) * 0x9E3779B1
        points, of = np.unique(keys, return_inverse=True)
        corner, label = of.reshape(-1, 3), np.arange(len(points))
        while True:  # each corner takes the least label of a face that it is one of
            least = label[corner].min(axis=1)
            after = label.copy()
            np.minimum.at(after, corner.ravel(), np.repeat(least, 3))
            after = after[after]
            if (after == label).all():
                return np.asarray(label[corner[:, 0]])
            label = after

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


def inside(starts: Array, shell: NDArray[np.int64], solids: Triangles) -> NDArray[np.bool_]:
    """Whether points lie inside a closed surface, whichever way its faces look.

    Every ray from within crosses it an odd number of times. From a tread of an open surface some
    rays do too, such as one that meets another flight above, but not all.

    starts, shape (n, 3): points, on no face [m].
    shell, shape (n,): number of that surface for each, of `Triangles.shells`.

    Shape (n,).
    """
    found = np.ones(len(starts), dtype=bool)
    for direction in WAYS:
        left = np.flatnonzero(found)
        ray, face, _ = hits(starts[left], direction, solids)
        own = solids.shells[face] == shell[left][ray]
        found[left] = np.bincount(ray[own], minlength=len(left)) % 2 > 0
    return found


def hits(
    starts: Array, direction: Array, solids: Triangles
) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
    """All faces that rays meet: numbers of ray and face, and the distance [m].

    Seen along the direction each face is a triangle in a plane: a ray hits it where the barycentric
    coordinates of its point are none of them negative.

    starts, shape (n, 3): where the rays begin [m].
    direction, shape (3,): of all rays, of length 1.
    """
    nothing = np.zeros(0, dtype=np.int64)
    if len(solids.corners) == 0 or len(starts) == 0:
        return nothing, nothing, np.zeros(0)
    frame = _frame(*direction.tolist())
    corners, points = solids.corners @ frame.T, starts @ frame.T
    low, high = points.min(axis=0), points.max(axis=0)
    near = (corners[:, :, :2].max(axis=1) >= low[:2] - 1e-9).all(axis=1)
    near &= (corners[:, :, :2].min(axis=1) <= high[:2] + 1e-9).all(axis=1)
    one, two = (corners[:, k] - corners[:, 0] for k in (1, 2))
    determinant = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]
    which = np.flatnonzero(near & (np.abs(determinant) > 1e-12))
    if len(which) == 0:
        return nothing, nothing, np.zeros(0)
    a, one, two, determinant = corners[which, 0], one[which], two[which], determinant[which]
    of_u = np.stack([two[:, 1], -two[:, 0]]) / determinant
    of_v = np.stack([-one[:, 1], one[:, 0]]) / determinant
    u_0, v_0 = ((each.T * a[:, :2]).sum(axis=1) for each in (of_u, of_v))
    of_t = of_u * one[:, 2] + of_v * two[:, 2]
    t_0 = a[:, 2] - u_0 * one[:, 2] - v_0 * two[:, 2]
    if len(a) * len(points) <= FEW_PAIRS:
        ray, face = (each.ravel() for each in np.indices((len(points), len(a))))
    else:
        ray, face = _near_in_plane(points, corners[which])
    x, y, z = points[ray].T
    u, v = x * of_u[0, face] + y * of_u[1, face], x * of_v[0, face] + y * of_v[1, face]
    u, v = u - u_0[face], v - v_0[face]
    t = x * of_t[0, face] + y * of_t[1, face] + t_0[face] - z
    edge = 1e-9
    hit = (u >= -edge) & (v >= -edge) & (u + v <= 1 + edge) & (t > edge)
    return ray[hit], which[face[hit]], t[hit]


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
