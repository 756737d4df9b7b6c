"""Where a flight lies in a cloud: its heading, its steps, and how wide it is."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.echo import echoes
from kaidan.readers.stairfit.patches import Patches, directions
from kaidan.readers.stairfit.staircase_line import (
    StairLine,
    assigned,
    explained_share,
    fitted,
    phase,
)

LANE = 0.1
"""Width of a lane along the heading [m]."""
PLAN, STOREY, TALL = 0.07, 0.12, 5
"""Side of a square of the plan, height of a level in it [m], and levels that no riser fills."""
FLOOR = 0.03
"""Thickness of the levels in which floors are looked for [m]."""
NARROWEST = 0.3
"""Width that a flight has at least [m]."""
FEWEST = 3
"""Nosings that a flight has at least."""
TRIED = 5
"""Repetitions of the side view that are tried with a fit."""
ABOUT = 3.0
"""Height over or under a line up to which a point may be one of its steps, in rises [1]."""
ASKEW = math.radians(1.0)
"""Angle by which nosings lie off a heading that is then sought again [rad]."""
SWEEP = 10
"""Angle between headings where no plumb patch says which to try [deg]."""


@dataclass(frozen=True, eq=False)
class Lane:
    """A flight roughly: its line, and where it lies."""

    heading: float
    """[rad]"""
    line: StairLine
    low: float
    """Least t, to the left of the heading [m]."""
    high: float
    score: float
    explained: float
    """Share of the points about the line that lie on it, chance subtracted [1]."""


def rotated(xyz: Array, heading: float) -> tuple[Array, Array, Array]:
    """Coordinates along a heading, to the left of it, and up [m]."""
    c, s = math.cos(heading), math.sin(heading)
    return xyz[:, 0] * c + xyz[:, 1] * s, xyz[:, 1] * c - xyz[:, 0] * s, xyz[:, 2]


def headings(patches: Patches) -> list[float]:
    """Axes along which stairs may climb, each within half a circle [rad]."""
    plumb = np.abs(patches.normal[:, 2]) < 0.17
    if plumb.sum() < 8:
        return [math.radians(each) for each in range(0, 180, SWEEP)]
    flat = replace(
        patches,
        normal=_levelled(patches.normal[plumb]),
        weight=patches.weight[plumb],
        middle=patches.middle[plumb],
    )
    axes: list[float] = []
    for each in directions(flat):
        here = math.atan2(each[1], each[0])
        for angle in (here, here + math.pi / 2):
            if all(abs(math.sin(angle - other)) > math.sin(math.radians(6)) for other in axes):
                axes.append(angle)
    return axes[:6]


def _levelled(normals: Array) -> Array:
    flat = normals * np.array([1.0, 1.0, 0.0])
    return np.asarray(flat / np.maximum(np.linalg.norm(flat, axis=1), 1e-12)[:, None])


def lanes(xyz: Array, patches: Patches, of_point: Indices, tolerance: float) -> list[Lane]:
    """Flights that the cloud may hold, the best first.

    Parameters
    ----------
    xyz : array, shape (n, 3)
        Thinned cloud, z up [m].
    patches : Patches
        Of the cloud, z up.
    of_point : array, shape (n,)
        Patch of each point, -1 without one.
    tolerance : float
        Distance within which a point lies on a step [m].
    """
    tried: list[tuple[float, float, StairLine, NDArray[np.bool_]]] = []
    normal = np.vstack([patches.normal, np.zeros(3)])[of_point]
    high = tall(xyz)
    for axis in headings(patches):
        s, _, z = rotated(xyz, axis)
        across = np.abs(normal[:, 1] * math.cos(axis) - normal[:, 0] * math.sin(axis))
        # side walls say nothing and cover everything
        free = (across < 0.85) & ~high
        s, z = s[free], z[free]
        steps = ~floors(s, z) if len(s) else free[:0]
        if steps.sum() < 50:
            continue
        s, z = s[steps], z[steps]
        for echo in echoes(s, z):
            back = echo.going < 0
            line, support = phase(-s if back else s, z, abs(echo.going), echo.rise)
            tried.append((support, axis + math.pi * back, line, free))
    tried.sort(key=lambda each: -each[0])
    found = []
    for _, heading, line, free in tried[:TRIED]:
        lane = lane_of(*rotated(xyz[free], heading), heading, line, tolerance)
        if lane is not None and abs(lane.line.skew) > ASKEW:
            heading -= math.atan(lane.line.skew)
            s, t, z = rotated(xyz[free], heading)
            going = lane.line.going * math.cos(math.atan(lane.line.skew))
            steps = ~floors(s, z)
            line, _ = phase(s[steps], z[steps], going, lane.line.rise)
            lane = lane_of(s, t, z, heading, line, tolerance)
        if lane is not None:
            found.append(lane)
    return sorted(found, key=lambda lane: -lane.score)


def tall(xyz: Array) -> NDArray[np.bool_]:
    """Points of what stands up farther than a riser: walls, people, posts.

    Seen in the plan they are in a small square that holds points in many levels. A handrail above
    a tread, or a ceiling, fills few of them.
    """
    cells = np.floor(xyz * np.array([1 / PLAN, 1 / PLAN, 1 / STOREY])).astype(np.int64)
    cells -= cells.min(axis=0)
    wide = cells.max(axis=0) + 1
    square = cells[:, 0] * wide[1] + cells[:, 1]
    filled = np.unique(square * wide[2] + cells[:, 2]) // wide[2]
    places, levels = np.unique(filled, return_counts=True)
    return np.asarray(levels[np.searchsorted(places, square)] >= TALL)


def floors(s: Array, z: Array) -> NDArray[np.bool_]:
    """Points in thin levels that hold many more than those about them, and are long."""
    level = ((z - z.min()) / FLOOR).astype(np.int64)
    count = np.bincount(level).astype(np.float64)
    padded = np.pad(count, 8)
    usual = np.median(np.lib.stride_tricks.sliding_window_view(padded, 17), axis=1)
    floor = np.zeros(len(count), dtype=bool)
    for each in np.flatnonzero(count > 2.0 * usual + 10):
        along = np.bincount(((s[level == each] - s.min()) / LANE).astype(np.int64))
        floor[each] = (along > 0.3 * np.percentile(along[along > 0], 90)).sum() * LANE > 1.0
    floor |= np.r_[floor[1:], False] | np.r_[False, floor[:-1]]
    return np.asarray(floor[level])


def lane_of(
    s: Array, t: Array, z: Array, heading: float, line: StairLine, tolerance: float
) -> Lane | None:
    """Flight about a line, or None where too few steps lie side by side."""
    low, high, score = float(t.min()), float(t.max()), 0.0
    slope = line.rise / line.going
    about = np.flatnonzero(np.abs(z - line.z0 - slope * (s - line.s0)) < ABOUT * line.rise)
    s, t, z = s[about], t[about], z[about]
    for wide in (max(2.0 * tolerance, 0.04), max(1.5 * tolerance, 0.025), tolerance):
        inside = np.flatnonzero((t >= low) & (t <= high))
        at = assigned(line, s[inside], t[inside], z[inside], min(wide, line.rise * 0.35))
        on = np.flatnonzero(at.tread | at.riser)
        if len(on) < 30:
            return None
        k, lane = at.step[on], ((t[inside[on]] - low) / LANE).astype(np.int64)
        k0 = int(k.min())
        size = (int(k.max()) - k0 + 1, int(lane.max()) + 1)
        seen = np.bincount((k - k0) * size[1] + lane, minlength=size[0] * size[1])
        there = seen.reshape(size) >= 2
        counts = there.sum(axis=0)
        best = int(np.argmax(np.convolve(counts, np.ones(3), mode="same")))
        first, last = _run(
            counts >= max(2.0, 0.5 * counts[max(0, best - 1) : best + 2].max()), best
        )
        low, high = low + first * LANE, low + (last + 1) * LANE
        if high - low < NARROWEST:
            return None
        share = there[:, first : last + 1].mean(axis=1)
        begin, end = _run(share >= 0.3, int(np.argmax(np.convolve(share, np.ones(3), "same"))))
        if end - begin + 1 < FEWEST:
            return None
        line = replace(line, first=begin + k0, last=end + k0)
        inside = np.flatnonzero((t >= low) & (t <= high))
        line = fitted(line, s[inside], t[inside], z[inside], tolerances=(wide, wide, tolerance))
        score = float(share[begin : end + 1].sum() * min(high - low, 1.5))
    inside = np.flatnonzero((t >= low) & (t <= high))
    explained = explained_share(line, s[inside], t[inside], z[inside], tolerance)
    return Lane(heading, line, low, high, score * max(explained, 0.0), explained)


def _run(good: NDArray[np.bool_], at: int) -> tuple[int, int]:
    """First and last of the run about a place, single gaps passed over."""
    first = last = at
    while first > 0 and (good[first - 1] or (first > 1 and good[first - 2])):
        first -= 1
    while last < len(good) - 1 and (good[last + 1] or (last + 2 < len(good) and good[last + 2])):
        last += 1
    while first < at and not good[first]:
        first += 1
    while last > at and not good[last]:
        last -= 1
    return first, last
