"""What carries along a flight and behind its ends, as it is drawn: gaps, and floors beyond them.

::

        |  tread  |   gap   |  floor          Looked at along lines side by side in the lane, nearer
     ---'---------'         '----------       to each other than a track is wide: the highest
                  :         :                 surface that is no more than a riser above the level.
                  near     far
"""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.solids.levels import JOINT
from kaidan.readers.solids.path import Path
from kaidan.readers.solids.rays import Triangles
from kaidan.readers.solids.runs import NARROWEST, RISES
from kaidan.readers.solids.section import INSET, cut
from kaidan.terrain.gap import DEEPEST_TREAD, Gap

Array = NDArray[np.float64]

APART = 0.08
"""Distance of the lines that are looked along [m]: less than tracks are wide (Absolem's, 97 mm)."""
LOOKED = 2.0
"""Distance up to which it is looked what carries behind the ends of a flight [m]."""
PIECE = 0.1
"""Length of the pieces in which a sloping surface is followed [m]."""
FLUSH = 0.04
"""Difference up to which surfaces lie on one level [m]: floor finishes."""
WALL = 0.5
"""Height above a level from which something is a wall at which it ends [m]: more than a riser."""
BOTTOMLESS = 4.0
"""Depth of a gap below which nothing is drawn [m]."""

_BESIDE = 1e-4
"""Distance from a nosing at which it is looked what lies behind it [m]."""
_MIRROR = np.array([-1.0, 1.0, -1.0, 1.0])
"""What turns a section round."""


class Hole(NamedTuple):
    """A gap along one line."""

    near: float
    """Distance from where the level begins [m]."""
    far: float
    """The same of the far edge; infinite: nothing carries as far as it is looked [m]."""
    depth: float
    """Below the level [m]."""


class Followed(NamedTuple):
    """A level as far as it is drawn along one line."""

    holes: tuple[Hole, ...]
    rise: float
    """Level of a surface that a riser leads up to at its end [m]; NaN: there is none."""
    end: float
    """Distance to its end [m]."""


def followed(segments: Array, start: float, level: float) -> Followed:
    """Level that begins at a place of a section, towards larger s.

    segments, shape (n, 4): s, z of one end and of the other [m].
    start: place where it begins, s [m].
    level: height there [m].
    """
    end = min(start + LOOKED, _wall(segments, start, level + WALL))
    places = _places(segments, start + _BESIDE, end, np.arange(start, end, PIECE))
    left, right = _ground(segments, places, np.full(len(places) - 1, level + RISES[1]))
    holes: list[Hole] = []
    near, depth, first = math.nan, 0.0, level
    for k in range(len(places) - 1):
        at, up = float(places[k]) if k else start, float(left[k]) - level
        if up > FLUSH and (math.isnan(near) or _carries(places, left, k)):
            holes += [] if math.isnan(near) else _hole(near - start, at - start, depth)
            return Followed(tuple(holes), float(left[k]), at - start)
        if abs(up) <= FLUSH:
            holes += [] if math.isnan(near) else _hole(near - start, at - start, depth)
            near, depth, level = math.nan, 0.0, float(right[k])
        elif up < 0.0:
            near = at if math.isnan(near) else near
            depth = max(depth, min(first - min(float(left[k]), float(right[k])), BOTTOMLESS))
    if not math.isnan(near):
        holes.append(Hole(near - start, math.inf, depth))
    return Followed(tuple(holes), math.nan, end - start)


def _hole(near: float, far: float, depth: float) -> Iterable[Hole]:
    """Gap that is wider than a joint."""
    return [Hole(near, far, depth)] if far - near > 2 * JOINT else []


def _carries(places: Array, left: Array, k: int) -> bool:
    """Whether the surface above the level that begins there is one to stand on."""
    same = np.abs(left[k:] - left[k]) <= FLUSH
    end = k + (len(same) if same.all() else int(np.argmin(same)))
    return bool(places[end] - places[k] > NARROWEST)


def _wall(segments: Array, start: float, height: float) -> float:
    """Where something stands in the way at a height, s [m]; infinite: nothing does."""
    s0, z0, s1, z1 = segments.T
    crosses = (z0 - height) * (z1 - height) < 0
    share = (height - z0[crosses]) / (z1 - z0)[crosses]
    s = s0[crosses] + share * (s1 - s0)[crosses]
    return float(s[s > start + 1e-3].min(initial=math.inf))


def _places(segments: Array, low: float, high: float, more: Array) -> Array:
    """Where a section may change between two places, those and some more among them, s [m]."""
    ends = np.concatenate([segments[:, 0], segments[:, 2], more])
    inside = ends[(ends > low) & (ends < high)]
    return np.unique(np.concatenate([inside, [low, high]]).round(7))


def _ground(segments: Array, places: Array, limit: Array) -> tuple[Array, Array]:
    """Highest surface of each piece up to a height: its heights at both ends [m].

    Infinitely low where there is none.
    """
    low, high = places[0], places[-1]
    s0, z0, s1, z1 = segments.T
    first, last = np.minimum(s0, s1), np.maximum(s0, s1)
    lies = (last - first > 1e-7) & (last > low) & (first < high)
    s0, z0, s1, z1, first, last = (each[lies] for each in (s0, z0, s1, z1, first, last))
    middle = (places[:-1] + places[1:]) / 2
    if len(s0) == 0:
        nothing = np.full(len(middle), -np.inf)
        return nothing, nothing
    slope = (z1 - z0) / (s1 - s0)
    height = (z0 - slope * s0)[:, None] + slope[:, None] * middle
    height[(first[:, None] > middle) | (last[:, None] < middle) | (height > limit)] = -np.inf
    best = height.argmax(axis=0)
    top = height[best, np.arange(len(middle))]
    half = slope[best] * (places[1:] - places[:-1]) / 2
    return top - half, top + half


class Ends(NamedTuple):
    """What is drawn of a flight's gaps and of the floors at its ends."""

    gaps: tuple[Gap, ...]
    level: tuple[float, float]
    """Lengths up to which any line finds them level, and none finds other steps on them [m]."""


def ends_of(path: Path, solids: Triangles) -> Ends:
    """Gaps of a flight and of the floors at its ends."""
    lines = _lines(path, solids)
    places, first = path.nosings, float(path.nosings[0])
    found: list[Gap] = []
    treads = [_steps(path, t, segments) for t, segments in lines]
    for k, of_tread in enumerate(zip(*treads, strict=True)):
        found += _gaps(of_tread, float(places[k]) - first, lines)
    level = []
    for head in (False, True):
        along = [_floor(path, t, segments, head=head) for t, segments in lines]
        # a floor as deep as a landing that ends is one: its outline says how deep
        holes = [
            [one for one in each.holes if one.near < DEEPEST_TREAD or math.isfinite(one.far)]
            for each in along
        ]
        gaps = _gaps(holes, 0.0, lines)
        found += [_placed(each, float(places[-1]) - first, head=head) for each in gaps]
        level.append(_level(along))
    return Ends(tuple(sorted(found, key=_start)), (level[0], level[1]))


def _level(along: Iterable[Followed]) -> float:
    """Length up to which any line finds a floor level, and none finds other steps on it [m]."""
    ends = [(one.holes[0].near if one.holes else one.end, one.rise) for one in along]
    steps = min((end for end, rise in ends if math.isfinite(rise)), default=math.inf)
    return min(steps, max(end for end, _ in ends))


def _start(gap: Gap) -> float:
    return -math.inf if gap.start is None else gap.start


def floor_before(path: Path, solids: Triangles) -> float:
    """Level of the floor that is drawn before the first nosing, over a gap too; NaN: none is."""
    found = []
    top = float(path.levels[0])
    for t, segments in _lines(path.over(top - RISES[1]), solids):
        mirrored, start = segments * _MIRROR, -float(path.at(t)[0])
        places = _places(mirrored, start, start + LOOKED, np.zeros(0))
        left, _ = _ground(mirrored, places, np.full(len(places) - 1, top - RISES[0]))
        near = np.flatnonzero(left >= top - RISES[1])
        found.append(float(left[near[0]]) if len(near) else math.nan)
    return _agreed(found)


def floor_behind(path: Path, solids: Triangles) -> tuple[float, Array] | None:
    """Floor that is drawn behind the last nosing, level with it or a riser higher; None: none is.

    Its height [m], and s of its edge near the left and the right side of the lane, shape (2,); of a
    level one that of the last nosing [m].
    """
    lines, z = _lines(path, solids), float(path.levels[-1])
    found = [_floor(path, t, segments, head=True) for t, segments in lines]
    level = _agreed([_led_to(each, z) for each in found])
    if math.isnan(level):
        return None
    if abs(level - z) <= FLUSH:
        return z, np.array([path.left[-1], path.right[-1]])
    here = [k for k, each in enumerate(found) if abs(each.rise - level) <= FLUSH]
    t = np.array([lines[k][0] for k in here]) - path.middle
    s = np.array([path.at(lines[k][0])[-1] + found[k].end for k in here])
    slope, middle = np.polyfit(t, s, 1) if len(here) > 1 else (0.0, s[0])
    half = (path.lane[1] - path.lane[0]) / 2 - INSET
    return level, middle + slope * np.array([half, -half])


def _led_to(found: Followed, z: float) -> float:
    """Level of the floor that a tread leads to over its end or a gap [m]; NaN: there is none."""
    if RISES[0] <= found.rise - z <= RISES[1]:
        return found.rise
    beyond = found.holes and math.isfinite(found.holes[0].far)
    whole = not found.holes and found.end > DEEPEST_TREAD
    return z if beyond or whole else math.nan


def _agreed(levels: Sequence[float]) -> float:
    """Level that more than half of the lines have [m]; NaN: there is none."""
    known = sorted(each for each in levels if math.isfinite(each))
    if 2 * len(known) <= len(levels):
        return math.nan
    return known[len(known) // 2]


def _lines(path: Path, solids: Triangles) -> list[tuple[float, Array]]:
    """Sections of what carries along lines in the lane, each with its t [m]."""
    low, high = path.lane[0] + INSET, path.lane[1] - INSET
    t = np.linspace(low, high, max(2, math.ceil((high - low) / APART) + 1))
    ends = np.vstack([
        path.frame.back(float(s), each)
        for s in (path.nosings[0] - LOOKED, path.nosings[-1] + LOOKED) for each in path.lane
    ])  # fmt: skip
    bottom, top = path.base - BOTTOMLESS, float(path.levels[-1]) + 2 * WALL
    near = solids.within(np.array([*ends.min(axis=0), bottom]), np.array([*ends.max(axis=0), top]))
    return [(float(each), cut(near, path.frame, float(each))) for each in t]


def _steps(path: Path, t: float, segments: Array) -> list[list[Hole]]:
    """Gaps in the tread behind each nosing but the last."""
    starts = path.at(t)
    places = _places(segments, float(starts[0]), float(starts[-1]), starts)
    tread = np.searchsorted(starts, (places[:-1] + places[1:]) / 2) - 1
    level = path.levels[tread]
    left, right = _ground(segments, places, level + RISES[1])
    missing = np.maximum(left, right) < level - FLUSH
    depth = np.minimum(level - np.minimum(left, right), BOTTOMLESS)
    holes: list[list[Hole]] = [[] for _ in starts[:-1]]
    begins = missing & ~(np.r_[False, missing[:-1]] & (np.diff(tread, prepend=-1) == 0))
    for k in np.flatnonzero(begins):
        alike = missing[k:] & (tread[k:] == tread[k])
        end = k + (len(alike) if alike.all() else int(np.argmin(alike)))
        start = starts[tread[k]]
        near, far = float(places[k] - start), float(places[end] - start)
        holes[tread[k]] += _hole(near, far, float(depth[k:end].max()))
    return holes


def _floor(path: Path, t: float, segments: Array, *, head: bool) -> Followed:
    if head:
        return followed(segments, float(path.at(t)[-1]), float(path.levels[-1]))
    return followed(segments * _MIRROR, -float(path.at(t)[0]), path.base)


def _gaps(
    each: Sequence[Sequence[Hole]], start: float, lines: Sequence[tuple[float, Array]]
) -> list[Gap]:
    """Gaps of one level over all lines: what has a far edge, and what has none."""
    beside = _widest((t, not holes) for (t, _), holes in zip(lines, each, strict=True))
    found = []
    for endless in (False, True):
        holes = [hole for one in each for hole in one if math.isinf(hole.far) is endless]
        for some in _overlapping(holes):
            near, far = min(one.near for one in some), max(one.far for one in some)
            found.append(
                Gap(
                    start=round(start + near, 6),
                    end=None if endless else round(start + far, 6),
                    depth=round(max(one.depth for one in some), 6),
                    beside=round(beside, 6),
                )
            )
    return found


def _overlapping(holes: Iterable[Hole]) -> list[list[Hole]]:
    """Holes in groups of those that overlap along the flight."""
    groups: list[list[Hole]] = []
    for each in sorted(holes):
        if groups and each.near <= max(one.far for one in groups[-1]):
            groups[-1].append(each)
        else:
            groups.append([each])
    return groups


def _widest(lines: Iterable[tuple[float, bool]]) -> float:
    """Widest strip of neighbouring lines without a gap [m]."""
    widest, first = 0.0, math.nan
    for t, whole in lines:
        first = (t if math.isnan(first) else first) if whole else math.nan
        widest = max(widest, t - first) if whole else widest
    return widest


def _placed(gap: Gap, last: float, *, head: bool) -> Gap:
    """Gap at an end of the flight, from its first nosing on."""
    start, end = gap.start, gap.end
    assert start is not None
    if head:
        ends = {"start": start + last, "end": None if end is None else end + last}
    else:
        ends = {"start": None if end is None else -end, "end": 0.0 - start}
    return gap.model_copy(update=ends)
