"""Whether a cloud was seen from a place: which side of its surfaces is free, and so what is up.

Stairs turned upside down are stairs: only the side from which they were seen tells. A cloud of one
scan has its sensor at the origin, where from each direction one surface is seen.
"""

import numpy as np

from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.patches import in_cubes

NEAREST, FARTHEST = 0.3, 20.0
"""Distances between which the nearest points of a scan and the middle of them lie [m]."""
CELL = 0.02
"""Side of the pieces of the unit sphere in which distances are compared [rad]."""
FEWEST_POINTS, FEWEST_CELLS = 4, 200
"""Points of such a piece, and pieces that have them."""
ALIKE = 0.15
"""Largest difference of the distances in one piece, as a share of them [1]."""
ONE_SURFACE = 0.85
"""Least share of the pieces in which one surface is seen [1]: 24 clouds of one scan or of five
nearby had 0.88 and more; surfaces end in the others."""


def seen_from_origin(xyz: Array) -> bool:
    """Whether the points of a cloud, shape (n, 3) [m], may all be seen from its origin."""
    away = np.sqrt((xyz**2).sum(axis=1))
    if len(xyz) < FEWEST_CELLS * FEWEST_POINTS or float(np.median(away)) > FARTHEST:
        return False
    if float(np.percentile(away, 1)) < NEAREST:
        return False
    order, begins, count = in_cubes(np.floor(xyz.T / np.maximum(away, 1e-9) / CELL))
    ordered, many = away[order], count >= FEWEST_POINTS
    near, far = (each.reduceat(ordered, begins)[many] for each in (np.minimum, np.maximum))
    alike = far - near < ALIKE * far
    return len(alike) >= FEWEST_CELLS and float(alike.mean()) > ONE_SURFACE
