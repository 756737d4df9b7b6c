"""Where a flight lies in a cloud: its heading, its steps, and how wide it is."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.echo import echoes
from kaidan.readers.stairfit.patches import Patches, directions, in_cubes
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
FEWEST_VIEWED, FEWEST_MORE = 50, 300
"""Points of a view on no floor in which steps are looked for, and of one in which another flight
is: three steps of 0.3 m have so many where most of them is seen."""
FAINT = 100.0
"""Points by which the line of another flight must stand out of its average shift: three steps 0.3 m
wide have 250 where all of them is seen."""
RIVAL = 0.3
"""Least share of the most points by which a line stands out, from which it is tried with a fit
[1]."""
SURE, LONG = 0.7, 8
"""Share of the points about a line that lie on it, chance subtracted [1], and nosings, from which
it is the flight before others are tried: in a short one an odd riser may pull the line."""
SAME = 0.2
"""Distance of nosings up to which two lines are one, in steps [1]."""
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


@dataclass(frozen=True, eq=False)
class View:
    """A thinned cloud along one heading, without what stands up: side walls, people, posts."""

    heading: float
    """[rad]"""
    rows: Indices
    """Of the cloud, shape (m,)."""
    s: Array
    t: Array
    z: Array
    """Of them, shape (m,) [m]."""

    def of(self, which: NDArray[np.bool_]) -> "View":
        """The same of some rows of the cloud."""
        kept = np.flatnonzero(which[self.rows])
        s, t, z = (each[kept] for each in (self.s, self.t, self.z))
        return View(self.heading, self.rows[kept], s, t, z)

    def turned(self, by: float) -> "View":
        """The same along another heading."""
        c, sine = math.cos(by), math.sin(by)
        s, t = self.s * c + self.t * sine, self.t * c - self.s * sine
        return View(self.heading + by, self.rows, s, t, self.z)

    def steps(self) -> tuple[Array, Array]:
        """(s, z) of what lies on no floor."""
        if not len(self.s):
            return self.s, self.z
        kept = np.flatnonzero(~floors(self.s, self.z))
        return self.s[kept], self.z[kept]


def views(xyz: Array, patches: Patches, of_point: Indices) -> list[View]:
    """Views of a cloud along all headings that stairs may have.

    Parameters
    ----------
    xyz : array, shape (n, 3)
        Thinned cloud, z up [m].
    patches : Patches
        Of the cloud, z up.
    of_point : array, shape (n,)
        Patch of each point, -1 without one.
    """
    normal = np.vstack([patches.normal, np.zeros(3)])[of_point]
    low = ~tall(xyz)
    found = []
    for axis in headings(patches):
        across = np.abs(normal[:, 1] * math.cos(axis) - normal[:, 0] * math.sin(axis))
        # side walls say nothing and cover everything
        rows = np.flatnonzero((across < 0.85) & low)
        found.append(View(axis, rows, *rotated(xyz[rows], axis)))
    return found


def lanes(seen: list[View], tolerance: float, *, another: bool) -> Iterator[Lane]:
    """Flights that the views of a cloud may hold: a sure one as soon as it is met, then the best.

    Parameters
    ----------
    seen : list of View
    tolerance : float
        Distance within which a point lies on a step [m].
    another : bool
        Whether one was found already, so that faint lines are not worth a fit.
    """
    tried: list[tuple[float, View, StairLine]] = []
    for view in seen:
        s, z = view.steps()
        if len(s) < (FEWEST_MORE if another else FEWEST_VIEWED):
            continue
        for echo in echoes(s, z):
            back = echo.going < 0
            line, support = phase(-s if back else s, z, abs(echo.going), echo.rise)
            if support > FAINT or not another:
                tried.append((support, view.turned(math.pi) if back else view, line))
    tried.sort(key=lambda each: -each[0])
    found, none_yet = [], True
    fits: list[Lane] = []
    for support, view, line in tried[:TRIED]:
        if support < RIVAL * tried[0][0] or any(_same(lane, view.heading, line) for lane in fits):
            continue
        lane = lane_of(view, line, tolerance)
        fits += [lane] if lane is not None else []
        if lane is not None and abs(lane.line.skew) > ASKEW:
            askew = math.atan(lane.line.skew)
            square = view.turned(-askew)
            line, _ = phase(*square.steps(), lane.line.going * math.cos(askew), lane.line.rise)
            lane = lane_of(square, line, tolerance)
        if lane is None:
            continue
        if none_yet and lane.explained > SURE and lane.line.last - lane.line.first + 1 >= LONG:
            none_yet = False
            yield lane
        else:
            found.append(lane)
    yield from sorted(found, key=lambda lane: -lane.score)


def _same(lane: Lane, heading: float, line: StairLine) -> bool:
    """Whether a line along a heading has the nosings of a lane, so that a fit leads there again."""
    if heading != lane.heading:
        return False
    at = lane.line.at(np.arange(lane.line.first, lane.line.last + 1))
    steps = (at - [line.s0, line.z0]) / [line.going, line.rise]
    return bool((np.abs(steps - np.round(steps[:, :1])) < SAME).all())


def tall(xyz: Array) -> NDArray[np.bool_]:
    """Points of what stands up farther than a riser: walls, people, posts.

    Seen in the plan they are in a small square that holds points in many levels. A handrail above
    a tread, or a ceiling, fills few of them.
    """
    place = np.floor(xyz.T * np.array([[1 / PLAN], [1 / PLAN], [1 / STOREY]]))
    order, begins, counts = in_cubes(place)
    squares = place[:2, order[begins]]
    each = np.flatnonzero(np.r_[True, (squares[:, 1:] != squares[:, :-1]).any(axis=0)])
    levels = np.diff(np.r_[each, len(begins)])
    found = np.empty(len(xyz), dtype=np.bool_)
    found[order] = np.repeat(np.repeat(levels >= TALL, levels), counts)
    return found


def floors(s: Array, z: Array) -> NDArray[np.bool_]:
    """Points in thin levels that hold many more than those about them, and are long."""
    level = ((z - z.min()) / FLOOR).astype(np.int64)
    column = ((s - s.min()) / LANE).astype(np.int64)
    wide = int(column.max()) + 1
    view = np.bincount(level * wide + column, minlength=(int(level.max()) + 1) * wide)
    view = view.reshape(-1, wide)
    count = view.sum(axis=1)
    usual = np.median(np.lib.stride_tricks.sliding_window_view(np.pad(count, 8), 17), axis=1)
    floor = np.zeros(len(count), dtype=bool)
    for each in np.flatnonzero(count > 2.0 * usual + 10):
        along = view[each]
        floor[each] = (along > 0.3 * np.percentile(along[along > 0], 90)).sum() * LANE > 1.0
    floor |= np.r_[floor[1:], False] | np.r_[False, floor[:-1]]
    return np.asarray(floor[level])


def lane_of(view: View, line: StairLine, tolerance: float) -> Lane | None:
    """Flight about a line, or None where too few steps lie side by side."""
    s, t, z = view.s, view.t, view.z
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
    return Lane(view.heading, line, low, high, score * max(explained, 0.0), explained)


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
