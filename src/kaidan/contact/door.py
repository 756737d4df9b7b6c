"""From arrays of numpy to the memory of the kernel: dtypes of its records, and the plain kernel."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import is_dataclass
from functools import cache, wraps
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from kaidan.contact.memory import CODES, Row, Table, values_of

T = TypeVar("T")

#: Rows of one record, its fields by their names.
Records = NDArray[np.void]


@cache
def dtype_of(kind: Any) -> np.dtype[Any]:
    """Layout of a record, or of a number.

    Examples
    --------
    >>> from kaidan.contact.layout import Disc
    >>> dtype_of(Disc).names, dtype_of(Disc).itemsize
    (('x', 'z', 'r'), 24)
    """
    if kind in CODES:
        return np.dtype(CODES[kind])
    parts = [(name, dtype_of(part)) for name, part in get_type_hints(kind).items()]
    return np.dtype(parts, align=True)


def zeros(kind: Any, count: int) -> Records:
    """Table of so many rows, noughts all."""
    return np.zeros(count, dtype=dtype_of(kind))


def unknown(kind: Any, count: int) -> Records:
    """Table of so many rows of which nothing is known yet: NaN for every number that may be."""
    table = zeros(kind, count)
    for name in table.dtype.names or ():
        if table.dtype[name].kind == "f":
            table[name] = np.nan
    return table


def table_of(kind: Any, rows: Iterable[Any]) -> Records:
    """Table of records, or of tuples of their fields."""
    given = [values_of(row) if is_dataclass(row) else tuple(row) for row in rows]
    return np.array(given, dtype=dtype_of(kind))


def picked(table: Records, rows: Any) -> Records:
    """Some rows; each moves whole, as number by number it would take 30 times as long."""
    found: Records = table.view(f"V{table.itemsize}")[rows].view(table.dtype)
    return found


def stacked(tables: Sequence[Records]) -> Records:
    """Copy of some tables, one after the other; each row moves whole."""
    whole = [table.view(f"V{table.itemsize}") for table in tables]
    return np.concatenate(whole).view(tables[0].dtype)


def given(kind: type[T], *fields: Any) -> T:
    """Named tuple as an entry takes it: where it declares a table or a row it holds an array."""
    return kind(*fields)


def plain(function: Callable[..., Any]) -> Callable[..., Any]:
    """Entry of the plain kernel that takes what the native one takes."""
    hints = [hint for name, hint in get_type_hints(function).items() if name != "return"]
    name = function.__name__

    @wraps(function)
    def call(*given: Any) -> Any:
        if len(given) != len(hints):
            raise TypeError(f"{name}: other arguments are expected")
        tables: list[Table[Any]] = []
        held = [opened(name, each, hint, tables) for each, hint in zip(given, hints, strict=True)]
        answer = function(*held)
        for table in tables:
            table.flush()
        return answer

    return call


def opened(name: str, given: Any, kind: Any, tables: list[Table[Any]]) -> Any:
    """What the plain kernel takes for an array, or for a tuple of the fields of a record."""
    if get_origin(kind) in (Table, Row):
        (held,) = get_args(kind)
        flags = getattr(given, "flags", None)
        usable = flags and flags.c_contiguous and flags.writeable
        if not usable or given.dtype != dtype_of(held):
            raise TypeError(f"{name}: a writable contiguous array of {held.__name__} is expected")
        if given.ndim != 1:
            raise TypeError(f"{name}: {held.__name__} in one row are expected")
        if get_origin(kind) is Row:
            return Row(memoryview(given))
        tables.append(Table(held, given, len(given)))
        return tables[-1]
    if kind in CODES:
        return kind(given)
    parts = list(get_type_hints(kind).values())
    if not is_dataclass(kind) and len(given) != len(parts):
        raise TypeError(f"{name}: a tuple of other fields is expected")
    pairs = zip(given, parts, strict=False)
    return kind(*(opened(name, each, part, tables) for each, part in pairs))
