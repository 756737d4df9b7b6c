"""PLY with points alone: ascii, binary little and big endian. With faces it is a mesh."""

import io
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.formats.columns import points_of_columns
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Points
from kaidan.readers.opening import LARGEST, Source

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2",
    "ushort": "u2", "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
_ENCODINGS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}

Elements = dict[str, tuple[int, list[list[str]]]]


def header_of(source: Source) -> tuple[Elements, str, int]:
    """Elements of a PLY file with their properties, the byte order, and where the data begins."""
    elements: Elements = {}
    order, name, at = None, "", 0
    while True:
        end = source.head.find(b"\n", at)
        if end < 0:
            raise source.refuse("the header has no end_header line", f"byte {at}")
        words = source.head[at:end].decode("ascii", "replace").split()
        line, at = " ".join(words)[:40], end + 1
        match words:
            case ["end_header"] if order is not None:
                return elements, order, at
            case ["format", word, _] if word in _ENCODINGS:
                order = _ENCODINGS[word]
            case ["element", name, count] if count.isdigit() and len(count) < 13:
                elements[name] = (int(count), [])
            case ["property", *rest] if name in elements and rest:
                elements[name][1].append(rest)
            case ["ply"] | ["comment", *_] | ["obj_info", *_] | []:
                pass
            case _:
                raise source.refuse(f"{line!r} is no line of a header")


def has_faces(source: Source) -> bool:
    """Whether it is a PLY file with faces."""
    if not source.head.startswith(b"ply"):
        return False
    words = source.head[: source.head.find(b"end_header")].split()
    pairs = zip(words, words[1:], words[2:], strict=False)
    return any(a == b"element" and b in (b"face", b"tristrips") and c != b"0" for a, b, c in pairs)


def read(source: Source, hints: Hints) -> Points:
    """Points of a PLY file.

    Raises
    ------
    InputError
        A header that contradicts itself or the size of the file.
    """
    elements, order, at = header_of(source)
    if "vertex" not in elements:
        raise source.refuse("no element vertex")
    for name, (count, properties) in elements.items():
        kind = _dtype(source, name, properties, order or "<")
        if name == "vertex":
            break
        if not order:
            raise source.refuse(f"element {name[:20]!r} stands before the vertices")
        source.refuse_missing(count, kind.itemsize, at)
        at += count * kind.itemsize
    count = elements["vertex"][0]
    for axis in "xyz":
        if axis not in (kind.names or ()):
            raise source.refuse(f"the vertices have no property {axis}")
    if order:
        table: Any = source.array(kind, count, at)
    else:
        table = _ascii(source, kind, count, at)
    return points_of_columns(source, "ply", [table[axis] for axis in "xyz"], hints)


def _dtype(source: Source, element: str, properties: list[list[str]], order: str) -> np.dtype[Any]:
    parts: list[tuple[str, str]] = []
    for number, words in enumerate(properties):
        if len(words) != 2 or words[0] not in _TYPES:
            raise source.refuse(
                f"property {' '.join(words)[:40]!r} of {element[:20]!r} is no number"
            )
        name = words[1] if words[1] not in dict(parts) else f"_{number}"
        parts.append((name, order + _TYPES[words[0]]))
    if not parts:
        raise source.refuse(f"element {element[:20]!r} has no properties")
    return np.dtype(parts)


def _ascii(source: Source, kind: np.dtype[Any], count: int, at: int) -> dict[str, NDArray[Any]]:
    names = list(kind.names or ())
    source.refuse_larger(LARGEST)
    source.refuse_missing(count, 2 * len(names) - 1, at)
    with source.opened() as file:
        file.seek(at)
        text = io.TextIOWrapper(file, encoding="ascii", errors="replace")
        rows = (line for line in text if line.partition("#")[0].strip())
        try:
            columns = [names.index(axis) for axis in "xyz"]
            found = np.loadtxt(rows, usecols=columns, ndmin=2, max_rows=count or 1)
        except ValueError as error:
            raise source.refuse(f"vertices: {str(error).splitlines()[0]}") from None
        finally:
            text.detach()
    if len(found) != count:
        raise source.refuse(f"{len(found)} vertices, not the {count} that the header states")
    return {axis: found[:, number] for number, axis in enumerate("xyz")}
