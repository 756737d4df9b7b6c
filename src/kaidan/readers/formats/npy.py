"""Arrays of numpy, NPY and NPZ, without pickle: points, organised points, or heights."""

import io
import math
from typing import Any

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from kaidan.errors import listed
from kaidan.readers.formats.columns import points_of_columns, provenance_of
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Heights, Known, Points
from kaidan.readers.opening import LARGEST, Source

MOST_COLUMNS = 8
"""Columns up to which a table is one of points: x, y, z, colours, a normal."""
_KEYS = ("points", "xyz", "pts", "cloud", "heights", "elevation", "z", "arr_0")


def read(source: Source, hints: Hints) -> Points | Heights:
    """Points or heights of an array.

    Raises
    ------
    InputError
        No array of numbers, objects that only pickle could read, or a shape that is neither.
    """
    if source.head.startswith(b"PK"):
        return _kind_of(source, "npz", *_member(source, hints), hints)
    with source.opened() as file:
        array = _array(source, file, source.size, "")
    return _kind_of(source, "npy", array, "", hints)


def _member(source: Source, hints: Hints) -> tuple[NDArray[Any], str]:
    members = {each.filename.removesuffix(".npy"): each for each in source.members}
    wanted = [hints.element] if hints.element else [key for key in _KEYS if key in members]
    if not hints.element and len(members) == 1:
        wanted = list(members)
    if not wanted or wanted[0] not in members:
        known = listed(sorted(members))
        raise source.refuse(f"which array is meant? name one as its element: {known}")
    content = source.member(members[wanted[0]], LARGEST)
    return _array(source, io.BytesIO(content), len(content), wanted[0]), wanted[0]


def _array(source: Source, file: Any, size: int, where: str) -> NDArray[Any]:
    with source.foreign(where):
        version = npy.read_magic(file)
        head = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
        shape, _, kind = head(file)
        if kind.hasobject:
            raise source.refuse("it holds Python objects, which only pickle reads: not read", where)
        if math.prod(shape) * kind.itemsize > size - file.tell():
            raise source.refuse(f"the header states shape {shape}, for which bytes are missing")
        file.seek(0)
        return np.asarray(npy.read_array(file, allow_pickle=False))


def _kind_of(
    source: Source, form: str, array: NDArray[Any], element: str, hints: Hints
) -> Points | Heights:
    if array.dtype.names and {"x", "y", "z"} <= set(array.dtype.names):
        grid = array.shape if array.ndim == 2 else None
        columns = [array[axis].ravel() for axis in "xyz"]
        return points_of_columns(source, form, columns, hints, grid=grid, element=element)
    if array.dtype.kind not in "fiu":
        raise source.refuse(f"an array of {array.dtype} holds no lengths")
    if array.ndim == 3 and 3 <= array.shape[2] <= MOST_COLUMNS:
        rows = array.reshape(-1, array.shape[2])
        grid = (array.shape[0], array.shape[1])
        return points_of_columns(source, form, rows.T[:3], hints, grid=grid, element=element)
    if array.ndim != 2 or array.shape[1] < 3:
        raise source.refuse(f"shape {array.shape} is neither (n, 3) points nor rows of heights")
    if array.shape[1] <= MOST_COLUMNS and hints.resolution is None:
        return points_of_columns(source, form, array.T[:3], hints, element=element)
    if hints.resolution is None:
        raise source.refuse("heights need the side of their cells: state the resolution")
    provenance = provenance_of(
        source, form, hints, unit=Known("m", "assumed"), up=Known("+z", "format"), element=element
    )
    return Heights(array.astype(np.float64), (hints.resolution,) * 2, provenance)
