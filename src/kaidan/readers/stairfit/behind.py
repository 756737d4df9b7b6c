"""Whether a floor was seen right behind the last nosing of a flight in a cloud, or that it ends.

From below nobody sees a landing, so points that are missing there say nothing. They do where the
level of the last nosing itself was seen: who sees that from above sees what follows it, be it the
face of another riser or more of the level.
"""

import math

import numpy as np

from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.flight_ends import FLOOR_SEEN
from kaidan.terrain.gap import DEEPEST_TREAD

STRIP = 0.05
"""Depth of the strips across the way in which points are counted [m]."""
HOLE = 0.15
"""Length without points from which there is a gap [m]: edges and coarse cells lack fewer."""
BEYOND = 0.3
"""Length of the level behind a gap that says that it is one [m]: more than stray points make."""
FARTHEST = 1.5
"""Distance behind the nosing up to which a level is looked at [m]: longer than most robots."""
FEW = 0.1
"""Share of the points of a usual strip up to which one counts as empty [1]."""
BODY = 0.5
"""Height over the level up to which something stands on it [m]."""


def gap_behind(ahead: Array, over: Array, *, going: float, tight: float) -> float:
    """Where the level behind the last nosing ends though it was seen [m]; NaN: it goes on.

    ahead, over, shape (n,): points between the sides of the flight: distance behind its last
        nosing, height over its level [m].
    going: of the flight [m].
    tight: distance within which a point lies on the level [m].

    NaN too where the level was not seen, something stands or steps up where it ends, or so much of
    it was seen as a landing is deep and nothing farther.
    """
    near = (ahead > 0.0) & (ahead < FARTHEST) & (over < BODY)
    ahead, over = ahead[near], over[near]
    on = np.abs(over) < tight
    if on.sum() < FLOOR_SEEN:
        return math.nan
    count = round(FARTHEST / STRIP)
    strip = np.minimum((ahead / STRIP).astype(np.int64), count - 1)
    level = np.bincount(strip[on], minlength=count)
    least = max(2.0, FEW * float(np.median(level[level > 0])))
    seen = level >= least
    stands = np.bincount(strip[over > tight], minlength=count) >= least
    for k in range(count - round(HOLE / STRIP)):
        end = k + round(HOLE / STRIP)
        if seen[k:end].any() or stands[max(k - 1, 0) : end].any():
            continue
        goes_on = seen[end:].sum() * STRIP >= BEYOND
        ends = going / 2 <= seen[:k].sum() * STRIP and k * STRIP < DEEPEST_TREAD
        return k * STRIP if goes_on or ends else math.nan
    return math.nan
