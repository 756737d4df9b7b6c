"""PCD, the format of the Point Cloud Library: ascii, binary and binary_compressed (0.7)."""

import io
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.formats.columns import points_of_columns
from kaidan.readers.formats.lzf import unpacked
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Points
from kaidan.readers.opening import LARGEST, Source

_WORDS = {"VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS"}
_TYPES = {"F": "f", "I": "i", "U": "u"}
_LARGEST_COUNT = 10_000


def read(source: Source, hints: Hints) -> Points:
    """Points of a PCD file.

    Raises
    ------
    InputError
        A header that contradicts itself or the size of the file.
    """
    header, encoding, at = _header(source)
    kind = _dtype(source, header)
    width, height = (_whole(source, header, word) for word in ("WIDTH", "HEIGHT"))
    count = width * height
    if "POINTS" in header and _whole(source, header, "POINTS") != count:
        raise source.refuse(f"WIDTH {width} times HEIGHT {height} is not POINTS")
    if encoding == "ascii":
        table: Any = _ascii(source, kind, count, at)
    elif encoding == "binary":
        table = source.array(kind, count, at)
    else:
        table = _compressed(source, kind, count, at)
    view = header.get("VIEWPOINT", [])
    try:
        viewpoint = np.array([float(each) for each in view[:3]]) if len(view) == 7 else None
    except ValueError:
        raise source.refuse("the header's VIEWPOINT is not seven numbers") from None
    if viewpoint is not None and not np.isfinite(viewpoint).all():
        viewpoint = None
    grid = (height, width) if height > 1 else None
    columns = [table[axis] for axis in "xyz"]
    return points_of_columns(source, "pcd", columns, hints, grid=grid, viewpoint=viewpoint)


def _header(source: Source) -> tuple[dict[str, list[str]], str, int]:
    header: dict[str, list[str]] = {}
    at = 0
    while True:
        end = source.head.find(b"\n", at)
        if end < 0:
            raise source.refuse("the header has no DATA line", f"byte {at}")
        words = source.head[at:end].decode("ascii", "replace").split()
        at = end + 1
        if not words or words[0].startswith("#"):
            continue
        if words[0] == "DATA":
            known = ("ascii", "binary", "binary_compressed")
            if len(words) != 2 or words[1] not in known:
                raise source.refuse(f"DATA is none of {', '.join(known)}")
            return header, words[1], at
        if words[0] not in _WORDS:
            raise source.refuse(f"{words[0][:20]!r} is no line of a header")
        header[words[0]] = words[1:]


def _whole(source: Source, header: dict[str, list[str]], word: str) -> int:
    text = header.get(word, [""])[:1] or [""]
    if not text[0].isascii() or not text[0].isdigit() or len(text[0]) > 12:
        raise source.refuse(f"the header's {word} is not a whole number")
    return int(text[0])


def _dtype(source: Source, header: dict[str, list[str]]) -> np.dtype[Any]:
    names = header.get("FIELDS", [])
    counts = header.get("COUNT", ["1"] * len(names))
    lines = [header.get("SIZE", []), header.get("TYPE", []), counts]
    if not names or any(len(line) != len(names) for line in lines):
        raise source.refuse("FIELDS, SIZE, TYPE and COUNT have different lengths")
    parts = []
    for number, (name, size, kind, many) in enumerate(zip(names, *lines, strict=True)):
        if kind not in _TYPES or size not in ("1", "2", "4", "8") or (kind, size) == ("F", "1"):
            raise source.refuse(f"field {name[:20]!r}: no type {kind[:5]}{size[:5]} is known")
        if not many.isdigit() or not 1 <= int(many) <= _LARGEST_COUNT:
            raise source.refuse(f"field {name[:20]!r}: COUNT {many[:20]} is not 1 to 10000")
        unique = name if name in ("x", "y", "z") and name not in names[:number] else f"_{number}"
        parts.append((unique, f"<{_TYPES[kind]}{size}", (int(many),) if int(many) > 1 else ()))
    kind_of = np.dtype([(name, each, shape) for name, each, shape in parts])
    for axis in "xyz":
        if axis not in (kind_of.names or ()) or kind_of[axis].shape:
            raise source.refuse(f"no field {axis}")
    return kind_of


def _ascii(source: Source, kind: np.dtype[Any], count: int, at: int) -> dict[str, NDArray[Any]]:
    source.refuse_larger(LARGEST)
    source.refuse_missing(count, 2 * len(kind.names or ()) - 1, at)
    starts, column = {}, 0
    for name in kind.names or ():
        starts[name] = column
        column += int(np.prod(kind[name].shape, initial=1))
    with source.opened() as file:
        file.seek(at)
        text = io.TextIOWrapper(file, encoding="ascii", errors="replace")
        rows = (line for line in text if line.partition("#")[0].strip())
        try:
            found = np.loadtxt(
                rows, usecols=[starts[axis] for axis in "xyz"], ndmin=2, max_rows=count or 1
            )
        except ValueError as error:
            raise source.refuse(f"points: {str(error).splitlines()[0]}") from None
        finally:
            text.detach()
    if len(found) != count:
        raise source.refuse(f"{len(found)} points, not the {count} that the header states")
    return {axis: found[:, number] for number, axis in enumerate("xyz")}


def _compressed(
    source: Source, kind: np.dtype[Any], count: int, at: int
) -> dict[str, NDArray[Any]]:
    packed, size = (int(each) for each in source.array("<u4", 2, at))
    if size != count * kind.itemsize:
        raise source.refuse(
            f"{size} bytes unpacked are not the {count} points of {kind.itemsize} bytes that the "
            "header states"
        )
    if size > 140 * max(packed, 1):  # 264 bytes for 3 is the most that LZF can do
        raise source.refuse("its compression is no honest one")
    content = unpacked(source.array("u1", packed, at + 8).tobytes(), size, source)
    table, start = {}, 0
    for name in kind.names or ():  # one field of all points after the other
        if name in ("x", "y", "z"):
            table[name] = np.frombuffer(content, kind[name], count, start)
        start += count * kind[name].itemsize
    return table
