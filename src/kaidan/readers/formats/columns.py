"""Columns of a file as a point cloud: invalid points become NaN, hints come before the file."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Array, Known, Points, Provenance
from kaidan.readers.opening import Source

FARTHEST = 1e4
"""Distance of a sensor from a cloud that is believed, in sizes of the cloud [1]."""
MOST_POINTS = 60_000_000
"""Most points that are kept in memory."""


def provenance_of(
    source: Source,
    form: str,
    hints: Hints,
    *,
    unit: Known | None = None,
    up: Known | None = None,
    notes: tuple[str, ...] = (),
    element: str = "",
) -> Provenance:
    """Where it was read; what the person states comes before what the file states."""
    return Provenance(
        path=str(source.path),
        digest=source.digest,
        form=form,
        element=element or hints.element,
        unit=unit if hints.unit is None else Known(hints.unit, "person"),
        up=up if hints.up is None else Known(hints.up, "person"),
        notes=notes,
    )


def points_of_columns(
    source: Source,
    form: str,
    columns: Sequence[NDArray[Any]] | NDArray[Any],
    hints: Hints,
    *,
    grid: tuple[int, int] | None = None,
    viewpoint: Array | None = None,
    total: int = 0,
    **known: Any,
) -> Points:
    """Point cloud of the columns x, y and z of a file.

    Points at exactly (0, 0, 0), where sensors put what they did not see, and points that are not
    finite become NaN in an organised cloud and are left out of another one.
    """
    count = len(columns[0])
    if count > MOST_POINTS:
        raise source.refuse(f"{count} points are more than {MOST_POINTS}: thin or crop it")
    xyz = np.empty((count, 3))
    with np.errstate(all="ignore"):  # what is no number is left out below
        for axis, column in enumerate(columns):
            xyz[:, axis] = column
    invalid = ~np.isfinite(xyz).all(axis=1) | ~xyz.any(axis=1) | (np.abs(xyz) > 1e9).any(axis=1)
    if hints.crop is not None:
        low, high = np.array(hints.crop[:3]), np.array(hints.crop[3:])
        invalid |= ((xyz < low) | (xyz > high)).any(axis=1)
    if invalid.all():
        raise source.refuse(f"none of {count} points is valid")
    if grid is not None and grid[0] * grid[1] == count:
        xyz[invalid] = np.nan
    else:
        grid, xyz = None, xyz[~invalid]
    if hints.viewpoint is not None:
        viewpoint = np.array(hints.viewpoint)
    if viewpoint is not None:
        low, high = np.nanmin(xyz, axis=0), np.nanmax(xyz, axis=0)
        beyond = np.maximum(low - viewpoint, viewpoint - high).max()
        if not beyond <= FARTHEST * max(float((high - low).max()), 1e-6):
            if viewpoint.any():
                raise source.refuse(f"the sensor stands {beyond:.3g} away from all of its points")
            viewpoint = None  # zeros that say nothing, of a cloud in coordinates of a country
    provenance = provenance_of(source, form, hints, **known)
    return Points(xyz, provenance, grid=grid, viewpoint=viewpoint, total=total)
