"""Elevation maps as GeoTIFF, by tifffile."""

import numpy as np

from kaidan.readers.formats.columns import provenance_of
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Heights, Known
from kaidan.readers.opening import Source

MOST_CELLS = 50_000_000
"""Most cells that are unpacked."""
_SCALE, _KEYS, _NO_DATA = 33550, 34735, 42113
_MODEL_TYPE, _GEOGRAPHIC = 1024, 2


def read(source: Source, hints: Hints) -> Heights:
    """Heights of the first band.

    Raises
    ------
    InputError
        A damaged file, an image in colours, cells in degrees, or no size of a cell.
    """
    import tifffile

    with source.foreign(), tifffile.TiffFile(source.path) as file:
        page = file.pages[0]
        assert isinstance(page, tifffile.TiffPage)
        shape = page.shape
        if len(shape) != 2 or page.dtype is None or page.dtype.kind not in "fiu":
            raise source.refuse(f"an image of shape {shape} is no elevation map")
        if shape[0] * shape[1] > MOST_CELLS:
            raise source.refuse(f"{shape[0]} x {shape[1]} cells are more than {MOST_CELLS}")
        tags = {code: page.tags[code].value for code in (_SCALE, _KEYS, _NO_DATA)
                if code in page.tags}  # fmt: skip
        heights = page.asarray().astype(np.float64)
        if heights.shape != shape or not heights.size:
            raise source.refuse(f"its {heights.size} cells are not the {shape} that it states")
    cell = _cell(source, tags, hints)
    try:
        heights[heights == float(str(tags.get(_NO_DATA, "nan")).strip("\0 "))] = np.nan
    except ValueError:
        raise source.refuse("its mark for missing heights is no number", "GDAL_NODATA") from None
    heights[np.abs(heights) > 1e6] = np.nan
    provenance = provenance_of(
        source, "geotiff", hints, unit=Known("m", "assumed"), up=Known("+z", "format")
    )
    return Heights(heights[::-1], cell, provenance)


def _cell(source: Source, tags: dict[int, object], hints: Hints) -> tuple[float, float]:
    keys = tags.get(_KEYS, ())
    assert isinstance(keys, tuple)
    values = dict(zip(keys[4::4], keys[7::4], strict=False))
    if hints.resolution is not None:
        return hints.resolution, hints.resolution
    if values.get(_MODEL_TYPE) == _GEOGRAPHIC:
        raise source.refuse("its cells are degrees, not metres: project it first")
    scale = tags.get(_SCALE)
    if not isinstance(scale, tuple) or len(scale) < 2 or not (scale[0] > 0 and scale[1] > 0):
        raise source.refuse("it does not state the side of its cells: state the resolution")
    return float(scale[1]), float(scale[0])
