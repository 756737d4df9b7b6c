"""What is clear beside and above a flight, and on a landing less walls and railings."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.solids.rays import Triangles, first_hits
from kaidan.readers.solids.section import Section

Array = NDArray[np.float64]

HEIGHTS = (0.15, 0.5)
"""Heights above a nosing, or a landing, at which it must be clear: of tracks and of a body [m]."""
ACROSS = 5
"""Places across a lane at which the headroom is looked at."""
FARTHEST = 4.0
"""Distance up to which a floor is looked at around a flight [m]."""
_HIGHEST = 6.0
_THIN = 0.002


def clear_lane(section: Section, around: Triangles) -> tuple[float, float]:
    """Right and left side of the lane that treads, walls and railings leave clear, t [m].

    Parameters
    ----------
    section : Section
    around : Triangles
        Solids that may stand in the way, those of the flight among them.
    """
    starts, left = _along(section)
    low, high = section.lane
    middle = (low + high) / 2
    rays = np.concatenate([starts + np.array([0.0, 0.0, each]) for each in HEIGHTS])
    near = around.within(rays.min(axis=0) - 3.0, rays.max(axis=0) + 3.0)
    to_left = float(first_hits(rays, left, near).min(initial=np.inf))
    to_right = float(first_hits(rays, -left, near).min(initial=np.inf))
    return max(low, middle - to_right), min(high, middle + to_left)


def headroom_of(section: Section, around: Triangles) -> float:
    """Least height above the nosings [m]; NaN: there is nothing above them."""
    low, high = section.lane
    across = (np.linspace(0.05, 0.95, ACROSS) - 0.5) * (high - low)
    starts, left = _along(section)
    rays = np.concatenate([starts + each * left for each in across])
    rays[:, 2] += 0.02
    top = rays.max(axis=0) + np.array([0.1, 0.1, _HIGHEST])
    hits = first_hits(rays, np.array([0.0, 0.0, 1.0]), around.within(rays.min(axis=0) - 0.1, top))
    least = float(hits.min(initial=np.inf)) + 0.02
    return least if least < _HIGHEST else np.nan


def _along(section: Section) -> tuple[Array, Array]:
    """Middles of the nosings, shape (m, 3), and the direction to the left, shape (3,)."""
    middle = sum(section.lane) / 2
    s = (section.left + section.right) / 2
    plan = np.array([section.frame.back(float(each), middle) for each in s])
    heading = section.frame.heading
    left = np.array([-np.sin(heading), np.cos(heading), 0.0])
    return np.column_stack([plan, section.levels]), left


def walls_around(around: Triangles, level: float, low: Array, high: Array) -> Array:
    """What stands on a floor, as segments in the plan, shape (n, 4) [m].

    Parameters
    ----------
    around : Triangles
        Solids.
    level : float
        Of the floor [m].
    low, high : array, shape (2,)
        Corners of the part of the plan that is looked at [m].
    """
    found = [np.zeros((0, 4))]
    for height in HEIGHTS:
        z = level + height + 1e-7
        near = around.within(np.array([*low, z]), np.array([*high, z]))
        off = near.corners[:, :, 2] - z
        ends = []
        for k in range(3):
            j = (k + 1) % 3
            crosses = off[:, k] * off[:, j] < 0
            share = off[:, k] / np.where(crosses, off[:, k] - off[:, j], 1.0)
            one, two = near.corners[:, k, :2], near.corners[:, j, :2]
            point = one + share[:, None] * (two - one)
            ends.append(np.where(crosses[:, None], point, np.nan))
        stacked = np.stack(ends, axis=1)
        order = np.argsort(np.isnan(stacked[:, :, 0]), axis=1, kind="stable")
        pairs = np.take_along_axis(stacked, order[:, :2, None], axis=1).reshape(-1, 4)
        found.append(pairs[~np.isnan(pairs).any(axis=1)])
    return np.concatenate(found)


def free_outline(shape: Any, walls: Array, points: Array) -> Any:
    """Part of a floor from which some points can be reached, less what stands on it.

    Parameters
    ----------
    shape : shapely polygon
        Of the floor.
    walls : array, shape (n, 4)
        Segments [m].
    points : array, shape (m, 2)
        Ends of flights on it [m].

    Returns
    -------
    shapely polygon
    """
    import shapely

    low, high = points.min(axis=0) - FARTHEST, points.max(axis=0) + FARTHEST
    near = shapely.intersection(shape, shapely.box(*low, *high))
    if len(walls):
        lines = shapely.linestrings(walls.reshape(-1, 2, 2))
        near = shapely.difference(
            near, shapely.buffer(shapely.union_all(lines), _THIN, quad_segs=1)
        )
    parts = [each for each in shapely.get_parts(near) if shapely.get_type_id(each) == 3]
    if not parts:
        return shape
    ends = shapely.multipoints(points)
    at = [float(shapely.distance(each, ends)) - 1e-3 * shapely.area(each) for each in parts]
    return shapely.simplify(parts[int(np.argmin(at))], 1e-3)
