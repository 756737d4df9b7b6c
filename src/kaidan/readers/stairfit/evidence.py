"""What says that the points along a line are stairs, and no ramp and no heap."""

import math

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.staircase_line import (
    INNER_RISER,
    INNER_TREAD,
    Assigned,
    StairLine,
    grouped,
)

OUT_OF_LEVEL = math.tan(math.radians(3.0))
"""Slope across at which a tread is none; along it, where edges blur it, twice that."""
FEWEST_SLANTED = 30
"""Points of treads, or of risers, from which their slope is taken."""
CORNER, FEW = 0.35, 5
"""Part of a tread or a riser that is near its end [1], and points that say nothing of it."""
SCARCE_RISERS = 0.05
"""Points of risers over those of treads from which risers are seen [1]; from above they are not."""


def by_step(line: StairLine, step: Indices, on: NDArray[np.bool_]) -> list[Indices]:
    """Rows of the points of each step of a line, sorted once."""
    rows = np.flatnonzero(on & (step >= line.first) & (step <= line.last))
    return grouped(rows, step[rows] - line.first, line.last - line.first + 1)


def depth(line: StairLine, s: Array, t: Array, z: Array) -> float:
    """Scatter of the points about the line through mid-steps, over that of where steps have them.

    A point is taken to lie on the nearest tread or riser, so that it does not matter which part of
    them is seen: 1 for stairs, near 0 for a ramp.
    """
    k, u, v = line.local(s, t, z)
    over = v - line.rise * (u / line.going - 0.5)
    near = (np.abs(over) < 0.8 * line.rise) & (k >= line.first) & (k < line.last)
    if near.sum() < 20:
        return 0.0
    over, u, v = over[near], u[near], v[near]
    face = np.where(v > 0, u - line.going, u)  # behind the riser ahead, or its own
    riser = np.abs(face) < np.abs(v)
    on = np.where(riser, over + line.rise * face / line.going, over - v)
    return float(np.sqrt(np.mean(over**2) / np.mean(on**2)))


def level_share(line: StairLine, at: Assigned, s: Array, t: Array, z: Array) -> float:
    """Points on treads whose plane is level, as a share of those on treads that have one."""
    good = total = 0
    for rows in by_step(line, at.step, at.tread):
        x, y, height = s[rows], t[rows], z[rows]
        if len(x) < 40 or np.std(y) < 0.08:
            continue
        columns = np.column_stack([np.ones(len(x)), x - x.mean(), y - y.mean()])
        _, along, across = np.linalg.lstsq(columns, height, rcond=None)[0].tolist()
        seen_along = np.std(x) > 0.03
        total += len(x)
        level = abs(across) < OUT_OF_LEVEL and (not seen_along or abs(along) < 2 * OUT_OF_LEVEL)
        good += len(x) if level else 0
    return good / total if total else math.nan


def slant(line: StairLine, s: Array, t: Array, z: Array) -> float:
    """Slope of treads, or lean of risers, over that of the line of the nosings.

    Of all points half a step about an element, away from its edges, and so of what lies between two
    battens: its slope, each step about its own mean. Treads or risers, of which more is seen: 0
    for stairs, 1 for a ramp; NaN: too little of both.
    """
    g, r = line.going, line.rise
    ahead, above = s - line.skew * t - line.s0, z - line.z0
    k = np.floor(ahead / g).astype(np.int64)
    u, v = ahead - k * g, above - k * r
    inner = (u > INNER_TREAD[0] * g) & (u < INNER_TREAD[1] * g) & (np.abs(v) < 0.5 * r)
    tread = inner & (k >= line.first) & (k <= line.last)
    j = np.round(ahead / g).astype(np.int64)
    x, y = ahead - j * g, above - (j - 1) * r
    inner = (y > INNER_RISER[0] * r) & (y < INNER_RISER[1] * r) & (np.abs(x) < 0.5 * g)
    riser = inner & (j >= line.first) & (j <= line.last)
    if max(tread.sum(), riser.sum()) < FEWEST_SLANTED:
        return math.nan
    if tread.sum() >= riser.sum():
        return _slope(k[tread], u[tread], v[tread]) * g / r
    return _slope(j[riser], y[riser], x[riser]) * r / g


def _slope(step: Indices, x: Array, y: Array) -> float:
    """Slope of y over x by least squares, each step about its own mean."""
    step = step - step.min()
    count = np.maximum(np.bincount(step), 1)
    x, y = (each - (np.bincount(step, each) / count)[step] for each in (x, y))
    return float(x @ y / max(float(x @ x), 1e-12))


def evenness(line: StairLine, at: Assigned) -> float:
    """Points of every second step as a share of those of the steps beside them.

    Near 0 where the steps are twice as long and as high as the line has them. Each is held against
    the geometric mean of those before and behind it: it does not matter how far away they are. Of
    three steps one at an end may be seen in part: that between them is held against the nearer.
    """
    on = (at.tread | at.riser) & (at.step >= line.first) & (at.step <= line.last)
    count = np.bincount(at.step[on] - line.first, minlength=line.last - line.first + 1)
    size = np.log(1.0 + count)
    before, own, behind = size[:-2], size[1:-1], size[2:]
    usual = (before + behind) / 2
    if len(own) == 1:
        usual = np.clip(own, np.minimum(before, behind), np.maximum(before, behind))
    other = (own - usual) * np.where(np.arange(len(own)) % 2, 1.0, -1.0)
    return math.exp(-abs(float(other.mean()))) if len(other) else 1.0


def upright(line: StairLine, at: Assigned) -> float:
    """Whether steps are seen as those that stand are: positive; negative: upside down.

    Steps hide the backs of treads and the feet of risers, never their nosings: the logarithm of the
    points near the nosings over those near the inner corners. And the higher a tread lies the less
    of it is seen from before the stairs, where risers are seen: how many steps the mean point of a
    riser lies above that of a tread. Upside down both have the other sign.
    """
    count = line.last - line.first
    above, along = at.over / line.rise, at.ahead / line.going
    above = np.where(above < 0.0, above + 1.0, above)
    tread = at.tread & (at.step >= line.first) & (at.step < line.last)
    tread &= (along > INNER_TREAD[0]) & (along < INNER_TREAD[1])
    riser = at.riser & (at.step > line.first) & (at.step <= line.last)
    riser &= (above > INNER_RISER[0]) & (above < INNER_RISER[1])
    near = (tread & (along < CORNER)).sum() + (riser & (above > 1.0 - CORNER)).sum()
    inner = (tread & (along > 1.0 - CORNER)).sum() + (riser & (above < CORNER)).sum()
    found = math.log((near + FEW) / (inner + FEW))
    treads, risers = at.step[tread], at.step[riser] - 1
    if count and len(treads) >= FEWEST_SLANTED and len(risers) > SCARCE_RISERS * len(treads):
        found += float(risers.mean() - treads.mean())
    return found
