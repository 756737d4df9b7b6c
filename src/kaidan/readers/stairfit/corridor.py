"""Where a flight lies in a cloud: its heading, its steps, and how wide it is."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.echo import DIM, Echo, echoes
from kaidan.readers.stairfit.staircase_line import (
    StairLine,
    assigned,
    explained_share,
    fitted,
    phase,
)
from kaidan.readers.stairfit.views import View, Views

LANE = 0.1
"""Width of a lane along the heading [m]."""
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


def lanes(
    seen: Views, left: NDArray[np.bool_], tolerance: float, *, another: bool
) -> Iterator[Lane]:
    """Flights that a cloud may hold: a sure one as soon as it is met, then the best.

    Most stairs climb along the first axis that plumb patches look along, or across it: the other
    headings are looked at where the clearest line of these two is no sure flight.

    left, shape (n,): which of its points belong to no flight yet.
    tolerance: distance within which a point lies on a step [m].
    another: whether one was found already, so that faint lines are not worth a fit.
    """
    if another and seen.steps(left) < FEWEST_MORE:
        return
    count = len(seen.headings)
    tried: list[_Tried] = []
    yielded: Lane | None = None
    for some in (range(min(2, count)), range(2, count)):
        tried += _lines([seen.along(k).of(left) for k in some], another=another)
        tried.sort(key=lambda each: -each.support)
        if tried and _is_sure(tried[0].fit(tolerance)) and yielded is None:
            yielded = tried[0].lane
            assert yielded is not None
            yield yielded
    found: list[Lane] = []
    fits: list[Lane] = []
    for each in tried[:TRIED]:
        known = any(_same(lane, each.view.heading, each.line) for lane in fits)
        if each.support < RIVAL * tried[0].support or (known and not each.done):
            continue
        lane = each.fit(tolerance)
        fits += [each.first] if each.first is not None else []
        if lane is None or lane is yielded:
            continue
        if yielded is None and _is_sure(lane):
            yielded = lane
            yield lane
        else:
            found.append(lane)
    yield from sorted(found, key=lambda lane: -lane.score)


@dataclass(eq=False)
class _Tried:
    """A repetition with the line that most points lie on, and what a fit makes of it."""

    support: float
    """Points of the line above those of its average shift."""
    view: View
    line: StairLine
    first: Lane | None = None
    """Lane that was fitted along the heading of the view."""
    lane: Lane | None = None
    """The same along the heading of its nosings."""
    done: bool = False

    def fit(self, tolerance: float) -> Lane | None:
        """Lane about the line, fitted once; None: there is none."""
        if not self.done:
            self.done = True
            self.first = self.lane = lane_of(self.view, self.line, tolerance)
            if self.first is not None and abs(self.first.line.skew) > ASKEW:
                askew, line = math.atan(self.first.line.skew), self.first.line
                square = self.view.turned(-askew)
                line, _ = phase(*square.steps(), line.going * math.cos(askew), line.rise)
                self.lane = lane_of(square, line, tolerance)
        return self.lane


def _lines(some: list[View], *, another: bool) -> list[_Tried]:
    """Lines of the repetitions of some views, but for those that are dim beside the clearest."""
    repeated: list[tuple[Echo, View, Array, Array]] = []
    for view in some:
        s, z = view.steps()
        if len(s) >= (FEWEST_MORE if another else FEWEST_VIEWED):
            repeated += [(echo, view, s, z) for echo in echoes(s, z)]
    clearest = max((echo.contrast for echo, *_ in repeated), default=0.0)
    found: list[_Tried] = []
    for echo, view, s, z in repeated:
        if echo.contrast < DIM * clearest:
            continue
        back = echo.going < 0
        line, support = phase(-s if back else s, z, abs(echo.going), echo.rise)
        if support > FAINT or not another:
            found.append(_Tried(support, view.turned(math.pi) if back else view, line))
    return found


def _is_sure(lane: Lane | None) -> bool:
    if lane is None:
        return False
    return lane.explained > SURE and lane.line.last - lane.line.first + 1 >= LONG


def _same(lane: Lane, heading: float, line: StairLine) -> bool:
    """Whether a line along a heading has the nosings of a lane, so that a fit leads there again."""
    if heading != lane.heading:
        return False
    at = lane.line.at(np.arange(lane.line.first, lane.line.last + 1))
    steps = (at - [line.s0, line.z0]) / [line.going, line.rise]
    return bool((np.abs(steps - np.round(steps[:, :1])) < SAME).all())


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
