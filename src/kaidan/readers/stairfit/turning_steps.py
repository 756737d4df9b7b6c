"""By what angle each nosing lies across the heading: curved flights and winders show themselves.

Between two levels nothing but the face of a riser stands. Strip by strip across the flight the
median of its points says where it is; the median of the slopes between strips says how it lies
(Theil 1950, Sen 1968), whatever stands about.
"""

import math
from functools import lru_cache

import numpy as np

from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.quantiles import median
from kaidan.readers.stairfit.staircase_line import StairLine, grouped

STRIP = 0.08
"""Width of a strip [m]."""
FEWEST_STRIPS, FEWEST_POINTS = 4, 3
"""Strips that a face needs, and points that a strip needs."""
BAND = (0.2, 0.8)
"""Part of the rise below a nosing in which its face is looked for [1]: treads are outside it."""
REACH = 1.5
"""Distance from the regular face up to which one is looked for, in goings [1]."""
STRAIGHT = 0.025
"""Median distance of the strips from a straight line from which they are no nosing [m]: things that
stand before it."""
CURVED, WINDING = np.radians(6.0), np.radians(15.0)
"""Turn of a flight from its first to its last nosing from which it is curved, and angle of single
nosings off the others from which they are winders [rad]."""
FEWEST_SURE, EVENLY = 5, np.radians(3.0)
"""Faces of which one may be hidden without turning the median of the slopes between them: four of
ten pairs have it. Fewer show a curve only where all lie this close to one line [rad]."""


def nosing_angles(
    line: StairLine,
    s: Array,
    t: Array,
    z: Array,
    sides: tuple[float, float],
    floor: float = math.nan,
) -> Array:
    """Angle of each nosing off square to the heading, shape (m,) [rad]; NaN: too little was seen.

    s, t, z, shape (n,): points in the frame of its heading [m].
    sides: least and greatest t of the flight [m].
    floor: its level [m], which below an odd first riser lies where a face is looked for; NaN: not
        seen.
    """
    low, high = sides[0] + 0.05, sides[1] - 0.05
    above = (z - line.z0) / line.rise
    number = np.ceil(above)
    below, ahead = number - above, s - line.skew * t - line.s0 - number * line.going
    face = (below > BAND[0]) & (below < BAND[1]) & (np.abs(ahead) < REACH * line.going)
    face &= (number >= line.first) & (number <= line.last)
    rows = np.flatnonzero(face & (t > low) & (t < high) & ~(z < floor + BAND[0] * line.rise))
    found = np.full(line.last - line.first + 1, np.nan)
    for row, here in enumerate(grouped(rows, number[rows] - line.first, len(found))):
        if len(here) < FEWEST_STRIPS * FEWEST_POINTS:
            continue
        strip = ((t[here] - low) / STRIP).astype(np.int64)
        x, y = (_medians(strip, each[here]) for each in (t, s))
        if len(x) < FEWEST_STRIPS:
            continue
        i, j = _pairs(len(x), 2)  # neighbours say little
        slope = median((y[j] - y[i]) / (x[j] - x[i]))
        off = y - slope * x
        if median(np.abs(off - median(off))) < STRAIGHT:
            found[row] = np.arctan(slope)
    return found


@lru_cache(maxsize=256)
def _pairs(count: int, apart: int) -> tuple[Indices, Indices]:
    """Pairs of so many numbers that lie so far apart or farther."""
    return np.triu_indices(count, apart)


def _medians(strip: Indices, value: Array) -> Array:
    """Median in each strip that holds points enough."""
    order = np.lexsort((value, strip))
    count = np.bincount(strip)
    begins = np.cumsum(count) - count
    begins, count = begins[count >= FEWEST_POINTS], count[count >= FEWEST_POINTS]
    ordered = value[order]
    return np.asarray((ordered[begins + (count - 1) // 2] + ordered[begins + count // 2]) / 2)


def turn_of(angles: Array) -> tuple[str, float]:
    """Word of the refusal for nosings that turn, empty for a straight flight, and the turn [rad].

    A single face that points elsewhere is a step that something stands before, not a flight that
    turns: where both would look alike the word is "unclear", with the angle between the faces.

    Examples
    --------
    >>> turn_of(np.radians([-6.0, -3.0, 0.0, 3.0, 6.0]))[0]
    'curved'
    >>> turn_of(np.radians([0.0, 1.0, -1.0, 0.0, 30.0]))[0]
    'winders'
    >>> turn_of(np.radians([0.0, 1.0, -1.0, 0.0, 1.0]))[0]
    ''
    >>> turn_of(np.radians([0.0, 1.0, 20.0]))[0], turn_of(np.radians([0.0, 10.0, 20.0]))[0]
    ('unclear', 'curved')
    """
    number = np.flatnonzero(np.isfinite(angles))
    if len(number) < 3:
        return "", 0.0
    seen = angles[number]
    i, j = _pairs(len(number), 1)
    slope = median((seen[j] - seen[i]) / (number[j] - number[i]))
    turn = slope * (len(angles) - 1)
    off = np.abs(seen - median(seen))
    if abs(turn) <= CURVED and off.max() <= WINDING:
        return "", 0.0
    apart = seen - slope * number
    few = len(number) < FEWEST_SURE and float(np.abs(apart - median(apart)).max()) > EVENLY
    if few or (abs(turn) <= CURVED and _straight_at_both_ends(off)):
        return "unclear", float(np.ptp(seen))
    return ("curved", abs(turn)) if abs(turn) > CURVED else ("winders", float(off.max()))


def _straight_at_both_ends(off: Array) -> bool:
    """Whether nosings before and behind those that are off lie alike: the way does not turn."""
    return bool(max(off[0], off[-1]) <= WINDING)
