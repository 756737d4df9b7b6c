"""E57 by pye57: one scan, or all of them in the frame of the file."""

import struct

import numpy as np

from kaidan.readers.formats.columns import MOST_POINTS, points_of_columns
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Known, Points
from kaidan.readers.opening import LARGEST, Source


def read(source: Source, hints: Hints) -> Points:
    """Points of an E57 file; `hints.element` is the number of a scan, counted from 0.

    Raises
    ------
    InputError
        A damaged file, one without points, or a scan that it does not have.
    """
    import pye57

    source.refuse_larger(LARGEST)
    if len(source.head) < 48:
        raise source.refuse("its header is cut off", f"byte {len(source.head)}")
    stated, begin, length = struct.unpack_from("<QQQ", source.head, 16)
    if stated != source.size or begin + length > source.size:
        raise source.refuse(f"the header states {stated} bytes, the file has {source.size}")
    with source.foreign():
        file = pye57.E57(str(source.path))
        try:
            count = file.scan_count
            numbers = list(range(count)) if not hints.element else [_scan(source, hints, count)]
            heads = [file.get_header(number) for number in numbers]
            total = sum(head.point_count for head in heads)
            if total > MOST_POINTS:
                raise source.refuse(f"{total} points are more than {MOST_POINTS}: name one scan")
            scans = [file.read_scan(number, ignore_missing_fields=True) for number in numbers]
            viewpoint = np.array(heads[0].translation) if len(numbers) == 1 else None
        finally:
            file.close()
        columns = [
            np.concatenate([scan[f"cartesian{axis}"] for scan in scans]) if scans else np.zeros(0)
            for axis in "XYZ"
        ]
    if not len(columns[0]):
        raise source.refuse("it holds no points")
    return points_of_columns(
        source, "e57", columns, hints, viewpoint=viewpoint,
        unit=Known("m", "format"), up=Known("+z", "format"),
    )  # fmt: skip


def _scan(source: Source, hints: Hints, count: int) -> int:
    if not hints.element.isdigit() or int(hints.element) >= count:
        raise source.refuse(f"no scan {hints.element[:20]!r}; it has {count}, counted from 0")
    return int(hints.element)
