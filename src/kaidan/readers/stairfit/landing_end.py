"""Where the level before or behind a flight ends: at what stands across the way.

How far a floor was seen says little: a camera at the foot of the stairs sees the half metre before
the first riser, and stands on the rest. So a landing of a cloud is as deep as its wall is far, and
not stated where no wall was seen.
"""

import math

import numpy as np

from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.quantiles import quantile

NEAREST, FARTHEST = 0.25, 4.0
"""Distances from the nosing between which something across the way is sought [m]."""
HEIGHTS = (0.25, 1.6)
"""Heights above the level between which a robot meets it [m]."""
SLICE, STRIP = 0.1, 0.1
"""Depth and width of the cells in which points are counted [m]."""
ACROSS = 0.7
"""Least share of the strips in which a wall is seen [1]: a person or a post covers fewer."""
TALL = 0.4
"""Least height of a wall [m]: more than a riser."""


def landing_end(ahead: Array, t: Array, over: Array, *, width: tuple[float, float]) -> float:
    """Distance from a nosing to the wall across the way [m]; NaN: none was seen.

    ahead, t, over, shape (n,): points: distance from the nosing, away from the flight; place
        across; height over the level [m].
    width: least and greatest t of the flight [m].
    """
    low, high = width
    near = (ahead > NEAREST) & (ahead < FARTHEST) & (t > low) & (t < high)
    near &= (over > HEIGHTS[0]) & (over < HEIGHTS[1])
    if near.sum() < 20:
        return math.nan
    x, y, z = ahead[near], t[near], over[near]
    slices = (x / SLICE).astype(np.int64)
    strips = ((y - low) / STRIP).astype(np.int64)
    wide = max(1, round((high - low) / STRIP))
    # a wall may lie on the border of two slices
    count = int(slices.max()) + 2, int(strips.max()) + 1
    seen = np.bincount(slices * count[1] + strips, minlength=count[0] * count[1]) > 0
    seen = seen.reshape(count)
    across = (seen[:-1] | seen[1:]).sum(axis=1) * seen[:-1].any(axis=1)
    for each in np.flatnonzero(across >= ACROSS * wide).tolist():
        here = (slices == each) | (slices == each + 1)
        if np.ptp(z[here]) >= TALL:
            return quantile(x[here], 0.1)
    return math.nan
