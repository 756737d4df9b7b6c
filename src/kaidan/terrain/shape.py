"""What a profile is along the path: level, a ramp, a step, a flight, a threshold, or irregular.

::

      ramp        step          flight           threshold        irregular
         ____      _____           __|            ______          _   _
      _/        __|            __|          _____|      |___    _| |_| |__|-
"""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from kaidan.terrain.polyline import ROUGHNESS

Array = NDArray[np.float64]
Shape = Literal["level", "ramp", "step", "flight", "threshold", "irregular"]

UNEVEN = 2 * ROUGHNESS
"""Height by which a scan may fall on its way up [m]: highest above lowest point of a level landing,
with 3 mm of noise 19 mm, and a tread that wears or slopes to its nosing."""
LEVEL_SLOPE = 0.05
"""Slope up to which a floor counts as level [1]: ADA 403.3 calls 1:20 and less no ramp."""
ALIKE = 2.0
"""Ratio of a riser to the median of its flight within which it is one of them [1]: entrance steps
of 100 mm below a flight of 190 mm are, blocks of any height are not."""


def shape_of(points: Array, nosings: Array, edges: Array) -> Shape:
    """Shape of a profile from its lower to its upper end.

    A flight of steps, several with landings between them, a step and a ramp lead up throughout;
    a threshold leads up and down again by a face or a slope each, stairs over a bridge by flights.
    What is built so is built right across the path; of anything else one track may meet more than
    the other.

    points, shape (n, 2): x ahead and z up [m].
    nosings, edges, shape (m, 2): upper ends of steep parts that rise, and of all steep parts [m].

    Examples
    --------
    >>> corners = np.array([(0.0, 0.15), (0.4, 0.15)])  # a block on a floor
    >>> line = np.array([(-2.0, 0.0), (0.0, 0.0), *corners, (0.4, 0.0), (2.0, 0.0)])
    >>> shape_of(line, corners[:1], corners)
    'threshold'
    """
    if is_level(points, edges):
        return "level"
    falling = edges[~np.isin(edges @ (1.0, 1.0j), nosings @ (1.0, 1.0j))]
    if len(falling) == 0 and _leads_up(points):
        if len(nosings) > 1:
            return "flight" if _alike(np.diff(nosings[:, 1])[:-1]) else "irregular"
        return "step" if len(nosings) else "ramp"
    top = int(np.argmax(points[:, 1]))
    up, down = points[: top + 1], points[top:][::-1] * (-1.0, 1.0)
    apart = (nosings[:, 0] <= points[top, 0]).all() and (falling[:, 0] >= points[top, 0]).all()
    if not (apart and _leads_up(up) and _leads_up(down)):
        return "irregular"
    if max(len(nosings), len(falling)) <= 1:
        return "threshold"
    legs = (nosings, up), (falling[::-1], down)
    risers = [np.diff(each[:, 1], prepend=leg[0, 1]) for each, leg in legs]
    return "flight" if all(len(each) > 2 and _alike(each) for each in risers) else "irregular"


def is_level(points: Array, edges: Array) -> bool:
    """Whether a profile is a floor: it has no steep part, and is as even as a scan shows it."""
    return len(edges) == 0 and bool(np.ptp(points[:, 1]) <= UNEVEN)


def _leads_up(points: Array) -> bool:
    """Whether a line falls nowhere by more than a floor may."""
    u = points[:, 1] + LEVEL_SLOPE * points[:, 0]
    return bool((np.maximum.accumulate(u) - u).max() <= UNEVEN)


def _alike(risers: Array) -> bool:
    """Whether some risers are those of flights."""
    middle = np.median(risers) if len(risers) else 0.0
    return bool(((risers >= middle / ALIKE) & (risers <= middle * ALIKE)).all())
