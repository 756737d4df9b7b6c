"""LAS and LAZ by laspy: streamed, and thinned to a raster where they are large."""

import struct

import numpy as np

from kaidan.readers.formats.columns import points_of_columns
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Array, Known, Points
from kaidan.readers.opening import Source

CHUNK = 1_000_000
"""Points that are in memory at a time."""
WHOLE = 4_000_000
"""Points up to which all are kept."""
RASTER = 0.01
"""Side of the cubes of which one point is kept otherwise, in the file's unit."""
LASZIP, VARIABLE, MOST_IN_CHUNK = 22204, 0xFFFFFFFF, 5_000_000
"""Number of the record that describes the compression, chunk size that says that it varies, and
largest one that is believed."""
MOST_KEPT = 20_000_000
"""Points left after thinning, from which the file must be cropped."""


def read(source: Source, hints: Hints) -> Points:
    """Points of a LAS or LAZ file.

    Raises
    ------
    InputError
        A damaged file, or too many points after thinning.
    """
    import laspy

    total = _checked(source)
    kept: list[Array] = []
    seen = np.zeros(0, dtype=np.int64)
    with source.foreign(), laspy.open(source.path) as file:
        low = np.array(file.header.mins)
        for piece in file.chunk_iterator(CHUNK):
            xyz = np.column_stack([piece.x, piece.y, piece.z]).astype(np.float64)
            if hints.crop is not None:
                inside = (xyz >= hints.crop[:3]) & (xyz <= hints.crop[3:])
                xyz = xyz[inside.all(axis=1)]
            if total > WHOLE:
                xyz, seen = _thinned(xyz, low, seen)
            kept.append(xyz)
            if sum(map(len, kept)) > MOST_KEPT:
                raise source.refuse(
                    f"more than {MOST_KEPT} points are left after thinning to "
                    f"{RASTER * 1e3:.0f} mm: crop it"
                )
    xyz = np.vstack(kept) if kept else np.zeros((0, 3))
    if not len(xyz):
        raise source.refuse("it holds no points")
    return points_of_columns(
        source, "las", xyz.T, hints, total=total,
        unit=Known("m", "assumed"), up=Known("+z", "format"),
    )  # fmt: skip


def _checked(source: Source) -> int:
    """Number of points, after the numbers in the header were held against the size of the file."""
    head = source.head
    if len(head) < 227:
        raise source.refuse("its header is cut off", f"byte {len(head)}")
    major, minor = head[24], head[25]
    begin, records, form, length = struct.unpack_from("<IIBH", head, 96)
    (points,) = struct.unpack_from("<I", head, 107)
    if major != 1 or minor > 4:
        raise source.refuse(f"version {major}.{minor} is not known")
    extended = 0
    if minor == 4:
        if len(head) < 375:
            raise source.refuse("its header is cut off", f"byte {len(head)}")
        (extended,) = struct.unpack_from("<I", head, 243)
        points = max(points, struct.unpack_from("<Q", head, 247)[0])
    source.refuse_missing(records, 54, 227)
    source.refuse_missing(extended, 60, 0)
    source.refuse_missing(1, 1, begin)
    compressed = form & 0x80
    source.refuse_missing(points, 0 if compressed else length, begin)
    if compressed and points > 4000 * max(source.size - begin, 1):
        raise source.refuse(f"the header states {points} points in {source.size} bytes")
    if compressed:
        _check_chunks(source, begin, records, length, int(struct.unpack_from("<H", head, 94)[0]))
    return int(points)


def _check_chunks(source: Source, begin: int, records: int, length: int, at: int) -> None:
    """Refuse sizes for which the decompressor would take memory that no file of this size needs.

    It ends the process when there is none left.
    """
    with source.opened() as file:
        for _ in range(records):
            file.seek(at)
            head = file.read(54)
            if len(head) < 54:
                raise source.refuse("a record of the header is cut off", f"byte {at}")
            number, size = struct.unpack_from("<HH", head, 18)
            if number == LASZIP:
                _check_record(source, file.read(size), length)
            at += 54 + size
        file.seek(begin)
        (table,) = struct.unpack("<q", file.read(8).ljust(8, b"\0"))
        table = table if table > 0 else source.size - 8
        file.seek(min(table, source.size))
        _, chunks = struct.unpack("<II", file.read(8).ljust(8, b"\0"))
    if chunks > source.size or table > source.size:
        raise source.refuse(f"the table states {chunks} chunks in {source.size} bytes")


def _check_record(source: Source, record: bytes, length: int) -> None:
    if len(record) < 34:
        raise source.refuse("the record of the compression is cut off")
    (chunk,) = struct.unpack_from("<I", record, 12)
    (items,) = struct.unpack_from("<H", record, 32)
    sizes = [struct.unpack_from("<H", record, 36 + 6 * k)[0] for k in range(items)
             if 40 + 6 * k <= len(record)]  # fmt: skip
    if len(sizes) != items or sum(sizes) != length:
        raise source.refuse(f"the compression states points of {sum(sizes)} bytes, not {length}")
    if chunk > MOST_IN_CHUNK and chunk != VARIABLE:
        raise source.refuse(f"the compression states chunks of {chunk} points")


def _thinned(
    xyz: Array, low: Array, seen: "np.ndarray[tuple[int], np.dtype[np.int64]]"
) -> tuple[Array, "np.ndarray[tuple[int], np.dtype[np.int64]]"]:
    """First point of each cube that holds none yet, and the sorted cubes that hold one."""
    cells = np.floor((xyz - low) / RASTER).astype(np.int64) & 0x1FFFFF
    keys = (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]
    unique, first = np.unique(keys, return_index=True)
    if len(seen):
        at = np.minimum(np.searchsorted(seen, unique), len(seen) - 1)
        new = seen[at] != unique
        unique, first = unique[new], first[new]
    return xyz[first], np.union1d(seen, unique)
