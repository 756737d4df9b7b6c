"""Level surfaces that can be stood on: treads, landings, floors.

Level faces with nothing of their own solid above them are gathered by height and joined where they
meet; one with something a hand's breadth above it, such as the concrete below a tread, is none.
Which way a face looks in the file says nothing: programs turn some, and leave out others.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.solids.rays import Triangles, hits, inside

Array = NDArray[np.float64]

STEEPEST_TREAD = math.radians(4.0)
"""Slope up to which a face counts as level [rad]: treads fall a little, so that water runs off."""
SAME_LEVEL = 0.003
"""Heights closer together than that are one level [m]: less than any riser."""
JOINT = 0.015
"""Half the width of the joints between boards that are closed over [m]."""
LEAST_AREA = 0.02
"""Least area of a tread [m^2]."""
LEAST_SPACE = 0.25
"""Space above a face that it takes to set a foot on it [m]."""
THICKEST = 0.6
"""Space below a surface of its own solid in which a face is its underside [m], where no sides are
drawn that would close it: slabs are thinner, and people do not walk where it is lower."""
INWARD = 0.7
"""Where it is looked whether a face is covered: between its middle and its corners [1]."""
WITHIN = np.array([0.47, 0.31, 0.22])
"""Place in a face from which it is looked up: off its middle, where edges of others may lie [1]."""
OFF = 1e-4
"""Height above a face from which it is looked up [m]: less than the thickness of any sheet."""
LEVELED = 1e-6
"""Grid on which outlines meet [m]."""


@dataclass(frozen=True, eq=False)
class Plate:
    """A level surface, seen from above."""

    level: float
    """Height [m]."""
    shape: Any
    """Plan outline, a shapely polygon [m]."""
    owners: tuple[int, ...]
    """Numbers of the solids that it belongs to, the one with most of it first."""

    @cached_property
    def corners(self) -> Array:
        """Corners of the outline, shape (n, 2), counter-clockwise [m]."""
        import shapely

        ring = shapely.get_exterior_ring(self.shape)
        found = np.asarray(shapely.get_coordinates(ring)[:-1], dtype=np.float64)
        return found if shapely.is_ccw(ring) else found[::-1]

    @cached_property
    def sides(self) -> Array:
        """Sides of the outline and of its holes, x, y of both ends, shape (n, 4) [m]."""
        import shapely

        points, ring = shapely.get_coordinates(shapely.get_rings(self.shape), return_index=True)
        found = np.hstack([points[:-1], points[1:]])
        return np.asarray(found[ring[:-1] == ring[1:]])

    @cached_property
    def box(self) -> tuple[float, float]:
        """Long and short side of the smallest rectangle about it [m]."""
        import shapely

        corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(self.shape))
        if len(corners) < 4:
            return 0.0, 0.0
        one, two = (float(np.hypot(*(corners[k + 1] - corners[k]))) for k in (0, 1))
        return max(one, two), min(one, two)

    @property
    def depth(self) -> float:
        """Mean depth: area over the long side [m]."""
        import shapely

        long = self.box[0]
        return float(shapely.area(self.shape)) / long if long > 0 else 0.0

    @property
    def middle(self) -> Array:
        """Centroid in the plan, shape (2,) [m]."""
        import shapely

        return np.asarray(shapely.get_coordinates(shapely.centroid(self.shape))[0])


def plates_of(solids: Triangles) -> list[Plate]:
    """Level surfaces that can be stood on, from the lowest up."""
    normals = solids.normals
    length = np.linalg.norm(normals, axis=1)
    level = np.abs(normals[:, 2]) > math.cos(STEEPEST_TREAD) * np.maximum(length, 1e-12)
    up = np.flatnonzero(level & (length > 1e-8))
    above = np.einsum("k,nkj->nj", WITHIN, solids.corners[up]) + np.array([0.0, 0.0, OFF])
    up = up[~inside(above, solids.shells[up], solids)]
    if len(up) == 0:
        return []
    heights = solids.corners[up, :, 2].mean(axis=1)
    order = np.argsort(heights, kind="stable")
    up, heights = up[order], heights[order]
    groups = np.split(up, np.flatnonzero(np.diff(heights) > SAME_LEVEL) + 1)
    found = [plate for group in groups for plate in _joined(solids, group)]
    return [plate for plate, free in zip(found, _uncovered(found, solids), strict=True) if free]


def _joined(solids: Triangles, group: NDArray[np.int64]) -> Iterator[Plate]:
    """Plates that faces of one level make up."""
    import shapely

    flat = solids.corners[group][:, :, :2]
    faces = shapely.polygons(flat)
    joined = shapely.union_all(faces)
    square = {"join_style": "mitre", "mitre_limit": 2.0}
    if shapely.get_num_geometries(joined) > 1:
        joined = shapely.buffer(shapely.buffer(joined, JOINT, **square), -JOINT, **square)
    parts = [
        each
        for each in shapely.get_parts(joined)
        if shapely.get_type_id(each) == 3 and shapely.area(each) > LEAST_AREA
    ]
    if not parts:
        return
    near, which = shapely.STRtree(parts).query_nearest(shapely.points(flat.mean(axis=1)))
    of_part = np.full(len(flat), -1)
    of_part[near] = which
    areas = np.abs(solids.normals[group, 2]) / 2
    heights = solids.corners[group, :, 2].mean(axis=1)
    parts = list(shapely.simplify(parts, LEVELED))
    for k, part in enumerate(parts):
        within = of_part == k
        if not within.any():
            continue
        weights = np.bincount(solids.owner[group][within], weights=areas[within])
        owners = [int(k) for k in np.argsort(-weights) if weights[k] > 0]
        size = np.maximum(areas[within], 1e-9)
        height = float(heights[within] @ size / size.sum())
        yield Plate(height, part, tuple(owners))


def _uncovered(plates: list[Plate], solids: Triangles) -> NDArray[np.bool_]:
    """Whether there is space to stand on most of each plate."""
    import shapely

    points: list[Array] = []
    of: list[int] = []
    for number, plate in enumerate(plates):
        inside = shapely.get_coordinates(shapely.point_on_surface(plate.shape))
        ring = plate.corners[:: max(1, len(plate.corners) // 6)]
        some = np.vstack([inside, inside + INWARD * (ring - inside)])
        points.append(np.column_stack([some, np.full(len(some), plate.level + SAME_LEVEL + 1e-3)]))
        of += [number] * len(some)
    if not points:
        return np.zeros(0, dtype=bool)
    owner = np.array([each.owners[0] for each in plates])[of]
    ray, face, above = hits(np.vstack(points), np.array([0.0, 0.0, 1.0]), solids)
    own = solids.owner[face] == owner[ray]
    over = np.bincount(ray[above < np.where(own, THICKEST, LEAST_SPACE)], minlength=len(of)) > 0
    count = np.bincount(of, minlength=len(plates))
    covered = np.bincount(of, weights=over, minlength=len(plates))
    return np.asarray(covered < 0.5 * count)
