"""Where a flight begins and ends: its first nosing, the floor before it, the landing behind it."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.flight import UNCHECKED
from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.doubts import place_of
from kaidan.readers.stairfit.quantiles import median, quantile
from kaidan.readers.stairfit.staircase_line import Edges, StairLine, assigned, fitted, fronts

FEWEST_POINTS = 12
"""Points of a tread or a riser from which its mean is taken."""
FEWEST_LANES = 3
"""Lanes in which an end must be seen."""
STRIP = 0.1
"""Width of the strips across a step in which it must be seen [m]."""
SHORTEST_FLOOR = 0.08
"""Length of the level before the first riser that must be seen [m]."""
EDGE_OFF = 0.03
"""Distance of the end of an element from its regular place up to which it is its end [m]."""
ODD_UNSEEN = 0.25
"""Largest difference of the last riser from the others, as a share of them, where its face was not
seen [1]: what lies higher is something that stands on the landing."""
HIGHEST_LAST = 1.3
"""Highest last riser, over the others [1]: what lies higher stands on the landing."""
LANDING_ACROSS = 0.6
"""Least width of a landing with a riser of its own, over that of the flight [1]: a box on it is
narrower."""
FACE_SEEN = 0.3
"""Height over which the points of the first riser lie, in rises [1]: those of a floor that lies
lower than a regular riser leads up from are of one level."""
ALONE = 0.8
"""Share of the points under a nosing, a going before and behind it, that are its face where little
of that is seen [1]."""
CLOSE = 0.6
"""Distance behind the last nosing up to which a landing says its level where enough of it is seen
[m]: a plane that leans by 2 degrees is 20 mm higher there."""
CENTRED = 6
"""Times that a level is sought about where it was found, at most."""
FLOOR_SEEN = 15
"""Points from which a floor counts as seen."""


def trimmed(line: StairLine, s: Array, t: Array, z: Array, tight: float) -> StairLine:
    """Line without the steps at its ends that few points make, or points that lie anyhow."""
    at = assigned(line, s, t, z, tight)
    on = at.tread | at.riser
    k, u, v = line.local(s, t, z)
    near = np.abs(v - line.rise * (u / line.going - 0.5)) < 0.8 * line.rise
    lane = np.floor(t / STRIP).astype(np.int64)
    lane -= lane.min()
    wide = int(lane.max()) + 1
    steps = np.arange(line.first, line.last + 1)
    count = len(steps)
    rows = np.flatnonzero(on & (at.step >= line.first) & (at.step <= line.last))
    cells = (at.step[rows] - line.first) * wide + lane[rows]
    seen = (np.bincount(cells, minlength=count * wide).reshape(count, wide) > 0).sum(axis=1) / wide
    rows = np.flatnonzero(near & (k >= line.first) & (k <= line.last))
    number = k[rows] - line.first
    about = np.bincount(number, minlength=count)
    share = np.bincount(number, weights=on[rows], minlength=count) / np.maximum(about, 1)
    usual = median(seen)
    good = (seen >= 0.5 * usual) & ((share >= 0.5) | (seen >= 0.9))
    good &= share >= 0.5 * median(share)
    if not good.any():
        return line
    kept = np.flatnonzero(good)
    return replace(line, first=int(steps[kept[0]]), last=int(steps[kept[-1]]))


def from_the_first(line: StairLine, s: Array, t: Array, z: Array, tight: float) -> StairLine:
    """Line that begins at the first nosing.

    A level that goes on below its nosing, or of which neither the riser is seen nor a front end at
    its place with something lower before it, is the floor. The end of a floor that the first step
    hides is no front: before another level is dropped, the line is fitted without it. A level below
    that ends after a going, with something lower before it, is a step.
    """
    g, r = line.going, line.rise
    begun = line
    front: Edges | None = None
    again = False
    while line.last - line.first >= 2:
        s1, z1 = line.at(np.array([line.first]))[0]
        ahead = s - line.skew * t - s1
        level = np.abs(z - z1) < tight
        before = int((level & (ahead > -0.4 * g - 0.15) & (ahead < -0.04)).sum())
        behind = (level & (ahead > 0.04) & (ahead < 0.9 * g)).sum()
        if _is_face(ahead, z - z1, line, tight, before):
            break
        front = fronts(begun, s, t, z, tight) if front is None else front
        ends = (front.at - line.skew * front.t)[front.step == line.first]
        edge = len(ends) >= FEWEST_LANES and abs(median(ends) - s1) < EDGE_OFF
        below = (ahead < -0.03) & (ahead > -2 * g) & (z < z1 - 0.4 * r) & (z > z1 - 2.5 * r)
        if before <= 0.3 * behind + 4 and behind >= 4 and edge and below.sum() >= FLOOR_SEEN:
            break
        if line.first > begun.first and not again:
            again, front = True, None
            begun = line = fitted(line, s, t, z, tolerances=(1.5 * tight, tight))
            continue
        line = replace(line, first=line.first + 1)
    for _ in range(3):
        s1, z1 = line.at(np.array([line.first]))[0]
        ahead = s - line.skew * t - s1
        tread = (np.abs(z - z1 + r) < tight) & (ahead < -0.04)
        ends_there = (tread & (ahead > -g - 0.04)).sum() > 0.95 * tread.sum()
        lower = (z < z1 - 1.5 * r) & (z > z1 - 2.6 * r) & (ahead < -g + 0.04) & (ahead > -2 * g)
        full = (tread & (ahead < -0.6 * g)).sum() >= 4
        if not (ends_there and full and lower.sum() >= FLOOR_SEEN):
            break
        line = replace(line, first=line.first - 1)
    return line


def _is_face(ahead: Array, over: Array, line: StairLine, tight: float, before: int) -> bool:
    """Whether the face of a first riser is seen under its nosing, of which there are these points.

    It is more than the level before the nosing, and stands up; or little of it is seen, as by one
    beam, and nothing else of that height lies about it, as a floor would.
    """
    g, r = line.going, line.rise
    below = (over < -0.15 * r) & (over > -0.85 * r) & (np.abs(ahead) < g)
    face = below & (np.abs(ahead) < tight)
    count = int(face.sum())
    if count < 5 or count <= before:
        return False
    alone = count > ALONE * below.sum()
    return alone or _span(over[face], 0.1) > FACE_SEEN * r


def with_odd_last(line: StairLine, s: Array, t: Array, z: Array, tight: float) -> StairLine:
    """Line with the nosing behind its last one, if the face of its riser is seen and ends there.

    The level of another riser is not that of the line, so that nothing on it counts as a step.
    """
    g, r = line.going, line.rise
    s1, z1 = line.at(np.array([line.last]))[0]
    ahead, over = s - line.skew * t - s1 - g, z - z1
    about = np.abs(ahead) < tight
    face = about & (over > 0.15 * r) & (over < (1.0 - ODD_UNSEEN) * r)
    beyond = about & (over > HIGHEST_LAST * r) & (over < 2.0 * r)
    if face.sum() < FEWEST_POINTS or _narrow(t, face) or beyond.sum() > 0.1 * face.sum():
        return line
    stands = _span(over[face], 0.1) > FACE_SEEN * r
    return replace(line, last=line.last + 1) if stands else line


def floor_before(
    line: StairLine, first: Array, s: Array, t: Array, z: Array, tight: float
) -> tuple[float, float, float, Array]:
    """Level of the floor, its doubt, how far it was seen, and `place_of` it; NaN where it was not.

    Where it was not its place is anywhere.
    """
    nowhere = math.nan, 0.0, math.nan, np.zeros((2, 3))
    ahead = s - line.skew * t - first[0]
    r = line.rise
    before = (ahead < -0.03) & (ahead > -1.5) & (z < first[1] - 0.25 * r) & (z > first[1] - 1.8 * r)
    while True:
        level, sigma, count = _densest(z[before], max(tight, 0.01))
        if count < FLOOR_SEEN:
            return nowhere
        on = before & (np.abs(z - level) < tight)
        if not _narrow(t, on):
            break
        before &= z < level - tight  # what lies on the floor is higher than it
    reach = _reach(-ahead[on])
    if reach < SHORTEST_FLOOR:
        return nowhere
    return level, sigma, reach, place_of(s, t, z, np.flatnonzero(on))


def last_riser(
    found: Array, sigma: Array, measured: NDArray[np.bool_], places: Array, line: StairLine,
    s: Array, t: Array, z: Array, noise: float, tight: float,
) -> tuple[Array, Array, NDArray[np.bool_], Array, float]:  # fmt: skip
    """Nosings with that of the landing, whose riser may be another one, and the landing's length.

    The length is NaN where no landing was seen.
    """
    last, r, g = found[-1], line.rise, line.going
    alone = bool(measured[-1, 1])
    within = tight if alone else max(tight, ODD_UNSEEN * r)
    behind = s > last[0] + 0.03
    close = behind & (s < last[0] + CLOSE)
    known = close if (close & (np.abs(z - last[1]) < within)).sum() >= 2 * FLOOR_SEEN else behind
    height, doubt, count = _centred(z[known], float(last[1]), within, tight)
    on = behind & (np.abs(z - height) < tight)
    if count >= FLOOR_SEEN and _reach(s[on] - last[0]) > g + 0.1 and (alone or not _narrow(t, on)):
        found[-1, 1], sigma[-1, 1], measured[-1, 1] = height, doubt, True
        places[-1, 1] = place_of(s, t, z, np.flatnonzero(on & known))
        return found, sigma, measured, places, _reach(s[on] - last[0])
    above = (s > last[0] + g + 0.03) & (s < last[0] + g + 1.2)
    above &= (z > last[1] + 0.2 * r) & (z < last[1] + 1.7 * r)
    close = above & (s < last[0] + g + CLOSE)
    height, doubt, count = _densest(z[close], max(tight, 0.01))
    if count < FLOOR_SEEN:
        return found, sigma, measured, places, math.nan
    on = above & (np.abs(z - height) < tight)
    reach = _reach(s[on] - last[0] - g)
    narrow = _narrow(t, on)
    high = height > last[1] + HIGHEST_LAST * r
    if reach < 0.1 + 0.5 * g or on.sum() < 0.5 * above.sum() or narrow or high:
        return found, sigma, measured, places, math.nan
    face = (np.abs(s - last[0] - g) < max(2 * tight, 0.04)) & (z > last[1] + 0.1 * r)
    face &= z < height - 0.1 * r
    here = np.full((2, 2, 3), np.nan)
    here[1] = place_of(s, t, z, np.flatnonzero(on & close))
    if face.sum() >= FEWEST_POINTS:
        front, doubt_s = median(s[face]), noise / math.sqrt(face.sum())
        here[0] = place_of(s, t, z, np.flatnonzero(face))
    elif abs(height - last[1] - r) < ODD_UNSEEN * r:
        front, doubt_s = last[0] + g, UNCHECKED
    else:
        return found, sigma, measured, places, math.nan
    return (
        np.vstack([found, [front, height]]),
        np.vstack([sigma, [doubt_s, doubt]]),
        np.vstack([measured, [True, True]]),
        np.concatenate([places, here[None]]),
        reach,
    )


def _centred(values: Array, about: float, within: float, width: float) -> tuple[float, float, int]:
    """`_densest` of the values near one, then of those near that, until it stays where it is.

    Those near a regular level alone would draw that of another riser towards it.
    """
    found = _densest(values[np.abs(values - about) < within], max(width, 0.01))
    for _ in range(CENTRED):
        before = found[0]
        if not math.isfinite(before):
            break
        found = _densest(values[np.abs(values - before) < 2 * width], max(width, 0.01))
        if abs(found[0] - before) < 0.1 * found[1]:
            break
    return found


def _densest(values: Array, width: float) -> tuple[float, float, int]:
    """Mean of the most crowded level, its standard uncertainty, and its points."""
    if not len(values):
        return math.nan, math.nan, 0
    bins = np.floor((values - values.min()) / width).astype(np.int64)
    counts = np.bincount(bins)
    pairs = counts + np.r_[counts[1:], 0]
    low = values.min() + int(np.argmax(pairs)) * width
    core = values[(values >= low) & (values < low + 2 * width)]
    middle = median(core)
    spread = max(1.4826 * median(np.abs(core - middle)), 1e-4)
    core = values[np.abs(values - middle) < 3 * spread]
    return float(core.mean()), spread / math.sqrt(len(core)), len(core)


def _reach(ahead: Array) -> float:
    """How far points lie one behind the other, from an edge on [m]."""
    count = np.bincount(np.maximum(ahead / STRIP, 0.0).astype(np.int64))
    few = np.flatnonzero(count < max(2.0, 0.02 * float(count.max())))
    hidden = few[few > 0]  # what lies right behind the edge may be hidden by it
    end = int(hidden[0]) if len(hidden) else len(count)
    return min(end * STRIP, float(ahead.max()))


def _span(values: Array, share: float) -> float:
    """Length over which values lie, a share of them left out at either end."""
    return quantile(values, 1 - share) - quantile(values, share)


def _narrow(t: Array, on: NDArray[np.bool_]) -> bool:
    """Whether a level is narrower than a landing: a box, walls at both sides, stray points."""
    _, in_strip = np.unique(np.floor(t[on] / STRIP), return_counts=True)
    across = STRIP * int((in_strip >= FEWEST_LANES).sum())
    return across < LANDING_ACROSS * _span(t, 0.02)
