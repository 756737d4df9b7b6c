"""What is clear beside and above a flight, and on a landing less walls and railings."""

import math
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.flight import LOWEST_CEILING
from kaidan.readers.solids.ground import APART
from kaidan.readers.solids.path import Path
from kaidan.readers.solids.rays import Triangles

Array = NDArray[np.float64]

HEIGHTS = (0.15, 0.5)
"""Heights above a nosing, or a landing, at which it must be clear: of tracks and of a body [m]."""
FARTHEST = 4.0
"""Distance up to which a floor is looked at around a flight [m]."""
GRAZED = 0.02
"""Height up to which a track passes over what stands on a nosing [m]."""
BEYOND = 0.7
"""Length of the floors at both ends that belongs to the way up a flight [m]: the shortest robot of
the catalogue (Absolem, 0.68 m) covers so much of them as it sets out and as it arrives."""
CELL = 0.02
"""Width of the strips in which a face that slopes across is looked at [m]."""
HIGHEST = 6.0
"""Height above the nosings up to which it is looked [m]."""
DIFFERS = 0.01
"""Difference up to which two clear widths are one [m]."""
NARROWEST = 0.3
"""Width from which a strip is a way [m]."""
_THIN = 0.002
_ROUND = 1e-6


class Strip(NamedTuple):
    """Widest strip along a flight that is free up to a height above the line of its nosings."""

    height: float
    """[m]; infinite: nothing hangs over it."""
    low: float
    """Right side, t [m]."""
    high: float
    """Left side, t [m]."""

    @property
    def width(self) -> float:
        """Clear width [m]."""
        return self.high - self.low


def free_strips(
    path: Path, around: Triangles, ends: tuple[float, float], finishes: frozenset[int]
) -> list[Strip]:
    """What is free across a flight and above its nosings, heights ascending, widths descending.

    All that stands or hangs along it is seen in one picture, along the line of the nosings: a robot
    that goes straight passes where a strip that is free up to its height holds its width.

    around: solids that may stand in the way, those of the flight among them.
    ends: lengths of the floors before the first and behind the last nosing as lines found them,
        side by side: between two of them other steps may begin sooner [m].

    One at least; of width 0 where there is nothing free.
    """
    before, behind = (min(max(each - APART, 0.0), BEYOND) for each in ends)
    line = path.line(before, behind)
    low, high = path.lane
    corners = [path.frame.back(s, t) for s in (line[0, 0], line[-1, 0]) for t in path.lane]
    bottom, top = float(line[:, 1].min()), float(line[:, 1].max()) + HIGHEST
    near = around.within(
        np.array([*np.min(corners, axis=0), bottom]), np.array([*np.max(corners, axis=0), top])
    )
    faces = path.square(near.corners.reshape(-1, 3)).reshape(-1, 3, 3)
    lies = np.isin(near.owner, list(finishes))
    posts = [
        _seen(faces[lies == of], line, (low, high), over)
        for of, over in ((False, GRAZED), (True, HEIGHTS[0]))
    ]
    return _strips(np.concatenate(posts), low, high)


def usual(strips: Sequence[Strip]) -> Strip:
    """Strip of which people speak as the clear width; the headroom is that over it.

    It is free up to where ceilings begin and rails end; under a lower one, up to that.
    """
    wide = [each for each in strips if each.width >= NARROWEST] or [strips[0]]
    return next((each for each in wide if each.height >= LOWEST_CEILING), wide[-1])


def _seen(faces: Array, line: Array, lane: tuple[float, float], grazed: float) -> Array:
    """Faces as they are seen along the line: right and left side, least height, shape (n, 3)."""
    s, t = faces[:, :, 0], faces[:, :, 1]
    keep = (s.max(axis=1) > line[0, 0]) & (s.min(axis=1) < line[-1, 0])
    keep &= (t.max(axis=1) > lane[0]) & (t.min(axis=1) < lane[1])
    faces = faces[keep]
    for each in line[:, 0]:
        faces = _split(faces, 0, float(each))
    middle = faces[:, :, 0].mean(axis=1)
    faces = faces[(middle > line[0, 0]) & (middle < line[-1, 0])]
    heights = _heights(faces, line)
    faces = faces[(heights.max(axis=1) > grazed) & (heights.min(axis=1) < HIGHEST)]
    slopes = _slopes_across(faces)
    parts = faces[slopes]
    for each in np.arange(lane[0] + CELL, lane[1], CELL):
        parts = _split(parts, 1, float(each))
    faces = np.concatenate([faces[~slopes], parts])
    heights = _heights(faces, line)
    over = np.where(faces[:, :, 0].mean(axis=1) < line[1, 0], HEIGHTS[0], grazed)
    over[faces[:, :, 0].mean(axis=1) > line[-2, 0]] = HEIGHTS[0]
    seen = (heights.max(axis=1) > over) & (heights.min(axis=1) < HIGHEST)
    t = faces[seen][:, :, 1]
    return np.column_stack([t.min(axis=1), t.max(axis=1), heights[seen].min(axis=1)])


def _heights(faces: Array, line: Array) -> Array:
    """Heights of corners above the line, shape (n, 3) [m]."""
    return np.asarray(faces[:, :, 2] - np.interp(faces[:, :, 0], line[:, 0], line[:, 1]))


def _slopes_across(faces: Array) -> NDArray[np.bool_]:
    """Which faces are neither square to the way across nor alike all along it."""
    a, b, c = (faces[:, k] for k in range(3))
    normal = np.abs(np.cross(b - a, c - a))
    normal /= np.maximum(normal.max(axis=1, initial=0.0), 1e-12)[:, None]
    across, other = normal[:, 1], np.maximum(normal[:, 0], normal[:, 2])
    return np.asarray((across > 1e-3) & (other > 1e-3))


def _split(faces: Array, axis: int, at: float) -> Array:
    """Faces cut by a plane across an axis, shape (m, 3, 3)."""
    off = faces[:, :, axis] - at
    cut = (off.min(axis=1) < -_ROUND) & (off.max(axis=1) > _ROUND)
    if not cut.any():
        return faces
    some, off = faces[cut], off[cut]
    side = off > 0
    alone = np.where(side.sum(axis=1) == 1, side.argmax(axis=1), (~side).argmax(axis=1))
    order = (alone[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(some, order[:, :, None], axis=1).swapaxes(0, 1)
    d_a, d_b, d_c = np.take_along_axis(off, order, axis=1).T
    ab = a + (d_a / (d_a - d_b))[:, None] * (b - a)
    ac = a + (d_a / (d_a - d_c))[:, None] * (c - a)
    parts = [np.stack(each, axis=1) for each in ((a, ab, ac), (ab, b, c), (ab, c, ac))]
    return np.concatenate([faces[~cut], *parts])


def _strips(posts: Array, low: float, high: float) -> list[Strip]:
    """Widest strips of what posts leave free: right and left side, foot, shape (n, 3)."""
    posts = np.maximum(posts, [-np.inf, -np.inf, 0.0]).round(6)
    posts = posts[np.argsort(posts[:, 2], kind="stable")]
    _, lowest = np.unique(posts[:, :2], axis=0, return_index=True)
    free = [(low, high)]
    found: list[Strip] = []
    for right, left, height in posts[np.sort(lowest)].tolist():
        widest = max(free, key=_width, default=(low, low))
        _take(free, right, left)
        if max(map(_width, free), default=0.0) < _width(widest):
            found.append(Strip(height, *widest))
    if free:
        found.append(Strip(math.inf, *max(free, key=_width)))
    return _thinned(found)


def _thinned(strips: Iterable[Strip]) -> list[Strip]:
    """The narrowest and highest of strips that are alike."""
    found: list[Strip] = []
    alike = math.inf
    for each in strips:
        if found and each.height == found[-1].height:
            continue
        if found and alike - each.width < DIFFERS:
            found[-1] = each
        else:
            found.append(each)
            alike = each.width
    return found


def _width(strip: tuple[float, float]) -> float:
    return strip[1] - strip[0]


def _take(free: list[tuple[float, float]], right: float, left: float) -> None:
    """Take what lies between two places from the strips that are free, in order."""
    first = bisect_right(free, (right, -math.inf))
    first -= first > 0 and free[first - 1][1] > right
    last = first
    rest: list[tuple[float, float]] = []
    while last < len(free) and free[last][0] < left:
        a, b = free[last]
        rest += [each for each in ((a, min(b, right)), (max(a, left), b)) if _width(each) > _ROUND]
        last += 1
    free[first:last] = rest


def walls_around(around: Triangles, level: float, low: Array, high: Array) -> Array:
    """What stands on a floor, as segments in the plan, shape (n, 4) [m].

    level: of the floor [m].
    low, high, shape (2,): corners of the part of the plan that is looked at [m].
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

    shape: of the floor.
    walls, shape (n, 4): segments [m].
    points, shape (m, 2): ends of flights on it [m].

    shapely polygon.
    """
    import shapely

    low, high = points.min(axis=0) - FARTHEST, points.max(axis=0) + FARTHEST
    near = shapely.intersection(shape, shapely.box(*low, *high))
    if len(walls):
        lines = shapely.linestrings(walls.reshape(-1, 2, 2))
        near = shapely.difference(
            near, shapely.union_all(shapely.buffer(lines, _THIN, quad_segs=1))
        )
    parts = [each for each in shapely.get_parts(near) if shapely.get_type_id(each) == 3]
    if not parts:
        return shape
    ends = shapely.multipoints(points)
    at = [float(shapely.distance(each, ends)) - 1e-3 * shapely.area(each) for each in parts]
    return shapely.simplify(parts[int(np.argmin(at))], 1e-3)
