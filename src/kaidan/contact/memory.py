"""Memory of the kernel, as plain Python has it: tables of records and rows of numbers.

``Table[Pose]`` holds places of poses, ``Row[float]`` numbers. A slice shares the memory of the
whole. A row or a slice beyond it is an `IndexError`, before the first row too. The native kernel
has the same as arrays of structs; `kaidan.contact.door` leads from arrays of numpy to either.
"""

from __future__ import annotations

import math
from array import array
from dataclasses import fields
from functools import cache
from typing import Any, Generic, TypeVar, get_type_hints, overload

R = TypeVar("R")
N = TypeVar("N", float, int, bool)

#: What a place holds before anything is written to it, by its type.
BLANK: dict[Any, Any] = {float: math.nan, int: -(2**62), bool: False}
#: Code of a number in a buffer, by its type.
CODES = {float: "d", int: "q", bool: "?"}


class Table(Generic[R]):
    """Places of records, one a row; each is made from the array behind it when it is first read."""

    __slots__ = ("count", "first", "places", "record", "source")

    def __init__(self, record: type[R], source: Any, count: int) -> None:
        self.record, self.source, self.first, self.count = record, source, 0, count
        self.places: list[R | None] = [None] * count

    def __len__(self) -> int:
        return self.count

    @overload
    def __getitem__(self, row: int) -> R: ...
    @overload
    def __getitem__(self, row: slice) -> Table[R]: ...
    def __getitem__(self, row: Any) -> Any:
        if row.__class__ is slice:
            return self._part(*_ends(row, self.count))
        if 0 <= row < self.count:
            return self.places[self.first + row] or self._made(self.first + row)
        raise IndexError(f"row {row} of a table of {self.count}")

    def _made(self, row: int) -> R:
        """Place of a row that is read for the first time."""
        values = None if self.source is None else self.source[row].item()
        made: R = _place(self.record, values)
        self.places[row] = made
        return made

    def _part(self, first: int, last: int) -> Table[R]:
        part = object.__new__(Table)
        part.record, part.source, part.places = self.record, self.source, self.places
        part.first, part.count = self.first + first, last - first
        return part

    def flush(self) -> None:
        """Write what has been read, and maybe changed, to the array behind it."""
        for row, place in enumerate(self.places):
            if place is not None:
                self.source[row] = values_of(place)


class Row(Generic[N]):
    """Numbers, one beside the other."""

    __slots__ = ("view",)

    def __init__(self, view: Any) -> None:
        self.view = view

    def __len__(self) -> int:
        return len(self.view)

    @overload
    def __getitem__(self, k: int) -> N: ...
    @overload
    def __getitem__(self, k: slice) -> Row[N]: ...
    def __getitem__(self, k: Any) -> Any:
        if k.__class__ is slice:
            first, last = _ends(k, len(self.view))
            return Row(self.view[first:last])
        if k >= 0:
            return self.view[k]
        raise IndexError(f"number {k} of a row of {len(self.view)}")

    def __setitem__(self, k: int, value: N) -> None:
        if k < 0:
            raise IndexError(f"number {k} of a row of {len(self.view)}")
        self.view[k] = value


def _ends(part: slice, count: int) -> tuple[int, int]:
    first, last = part.start or 0, count if part.stop is None else part.stop
    if not 0 <= first <= last <= count:
        raise IndexError(f"rows {first} to {last} of a table of {count}")
    return first, last


@overload
def empty(kind: type[N], count: int) -> Row[N]: ...  # type: ignore[overload-overlap]
@overload
def empty(kind: type[R], count: int) -> Table[R]: ...
def empty(kind: Any, count: int) -> Any:
    """Row or table that holds nothing yet; it lasts as long as the function that makes it."""
    if kind not in CODES:
        return Table(kind, None, count)
    places: Any = memoryview(array("d", [math.nan]) * count).cast("B")
    return Row(places.cast(CODES[kind])[:count])


def put(place: R, source: R) -> None:
    """Copy all that one place holds to another."""
    record: Any = type(place)
    for name, part in _parts(record):
        if part is None:
            setattr(place, name, getattr(source, name))
        else:
            put(getattr(place, name), getattr(source, name))


@cache
def _parts(record: Any) -> tuple[tuple[str, Any], ...]:
    """Name of each field, and of one that is a record its type."""
    hints = get_type_hints(record)
    return tuple(
        (each.name, None if hints[each.name] in BLANK else hints[each.name])
        for each in fields(record)
    )


def _place(record: Any, values: Any) -> Any:
    """Place that holds values, nested as its fields are; None: nothing yet."""
    if values is None:
        hints = get_type_hints(record)
        values = [BLANK.get(hints[name]) for name, _ in _parts(record)]
    parts = zip(_parts(record), values, strict=True)
    return record(*(each if part is None else _place(part, each) for (_, part), each in parts))


def values_of(place: Any) -> tuple[Any, ...]:
    """What a place holds, nested."""
    return tuple(
        getattr(place, name) if part is None else values_of(getattr(place, name))
        for name, part in _parts(place.__class__)
    )
