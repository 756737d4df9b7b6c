"""Staircases in an elevation map: its cells are points, seen from above."""

from dataclasses import replace

import numpy as np

from kaidan.readers.estimate import Found, Refusal
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points
from kaidan.readers.kinds import METRES, Heights, Known, Points

COARSEST = 0.05
"""Side of cells that blur the steps [m]."""


def found(heights: Heights, hints: Hints) -> Found:
    """Staircases that an elevation map holds, or why it holds none.

    An edge is known to a third of a cell.
    """
    provenance = heights.provenance
    unit = provenance.unit or Known("m", "assumed")
    cell = max(heights.cell) * METRES[unit.value]
    if cell > COARSEST:
        refusal = Refusal("coarse", {"cell_mm": 1e3 * cell}, provenance)
        return Found(provenance, refusals=(refusal,), contents=heights)
    rows, columns = np.nonzero(np.isfinite(heights.z))
    xyz = np.column_stack(
        [columns * heights.cell[1], rows * heights.cell[0], heights.z[rows, columns]]
    )
    if hints.crop is not None:
        low, high = np.array(hints.crop[:3]), np.array(hints.crop[3:])
        xyz = xyz[np.all((xyz >= low) & (xyz <= high), axis=1)]
    if len(xyz) < 50:
        return Found(provenance, refusals=(Refusal("none", {}, provenance),), contents=heights)
    cloud = Points(xyz, replace(provenance, unit=unit, up=provenance.up or Known("+z", "assumed")))
    return replace(points.found(cloud, hints), contents=heights)
