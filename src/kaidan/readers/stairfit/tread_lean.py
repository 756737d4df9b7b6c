"""How far the treads themselves say that up leans along a flight.

Patches over edges lean, and a floor may fall. What lies between the edges of a tread is level; its
slope by least squares is that by which up is off. Noise moves a point along its ray, and so its
place along the tread and its height together. Where the tread goes on at both sides as many points
come as go, and the slope stays; where it ends, or is hidden, it does not: points near there are
left out.
"""

import math

import numpy as np

from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.doubts import ALIKE_WITHIN, LOCAL
from kaidan.readers.stairfit.quantiles import quantile
from kaidan.readers.stairfit.staircase_line import StairLine

FEWEST_POINTS, FEWEST_TREADS = 60, 2
"""Points of a tread whose slope counts, and such treads."""
MARGIN, SHORTEST = 0.03, 0.05
"""Distance from the ends of what is seen of a tread within which points are left out, three times
the noise of a good sensor, and the least length that is left [m]."""


def tread_lean(
    line: StairLine, levels: Array, s: Array, t: Array, z: Array, *,
    eye: Array, width: float, range_error: float, out_of_true: float,
) -> tuple[float, float]:  # fmt: skip
    """Angle by which up leans ahead as the treads have it, and its doubt [rad]; NaN: too few.

    levels, shape (m,): heights of its nosings [m]; the last one is not a tread.
    s, t, z, shape (n,): points in the frame of the heading [m].
    eye, shape (3,): (s, t, z) of the sensor [m].
    width: distance from the level up to which a point lies on the tread [m].
    range_error: doubt of measured distances as a share of them [1].
    out_of_true: standard deviation of the slope of a tread as it was built [rad].
    """
    k, u, _ = line.local(s, t, z)
    k = k - line.first
    inner = (k >= 0) & (k < len(levels) - 1)
    over = z - levels[np.clip(k, 0, len(levels) - 1)]
    rows = np.flatnonzero(inner & (np.abs(over) < width))
    square = product = flat = 0.0
    bends: list[float] = []
    for number in range(len(levels) - 1):
        here = rows[k[rows] == number]
        if len(here) < FEWEST_POINTS:
            continue
        low, high = quantile(u[here], 0.02) + MARGIN, quantile(u[here], 0.98) - MARGIN
        here = here[(u[here] > low) & (u[here] < high)]
        if len(here) < FEWEST_POINTS or high - low < SHORTEST:
            continue
        ray = np.array([s[here].mean(), t[here].mean(), z[here].mean()]) - eye
        sine = abs(float(ray[2])) / float(np.linalg.norm(ray))
        x, y = u[here] - u[here].mean(), over[here] - over[here].mean()
        square += float(x @ x)
        product += float(x @ y)
        flat += float(x @ x) * float(np.mean(y**2))
        bends.append(math.sqrt(2) * LOCAL * range_error * sine**2 / ALIKE_WITHIN)
    if len(bends) < FEWEST_TREADS:
        return math.nan, math.nan
    scatter = math.sqrt(flat) / square
    built = out_of_true / math.sqrt(len(bends))
    return -math.atan(product / square), math.hypot(scatter, built, float(np.mean(bends)))
