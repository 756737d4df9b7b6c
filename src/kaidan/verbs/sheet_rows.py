"""Figures of a sheet as rows: name, symbol, value, source and doubt."""

from collections.abc import Iterator
from typing import NamedTuple

from kaidan.sheet import Sheet
from kaidan.tables import human

_SAID_ELSEWHERE = ("name", "title", "notes", "sources")
_DOUBTED = {"track.flat_length": "flat_length"}
"""Fields whose standard uncertainty has another name."""


class FieldRow(NamedTuple):
    """A figure of a sheet."""

    field: str
    """Name, with those of the tables that it is in."""
    symbol: str
    """Of the paper; empty without one."""
    value: str
    """With its unit, as people write it."""
    source: str
    """Where it comes from; "default" where it is that of the sheet; empty: not said."""
    doubt: str
    """Standard uncertainty; empty where none is stated."""


def field_rows(sheet: Sheet) -> Iterator[FieldRow]:
    """Rows of all figures of a sheet that it has, those of its tables behind their names.

    Examples
    --------
    >>> from kaidan import Stairs
    >>> [row.value for row in field_rows(Stairs(rise=0.178, going=0.279, steps=4))][:3]
    ['178 mm', '279 mm', '4']
    """
    yield from _rows(sheet, getattr(sheet, "sources", {}), getattr(sheet, "uncertainty", None), "")


def _rows(
    sheet: Sheet, sources: dict[str, str], doubts: Sheet | None, path: str
) -> Iterator[FieldRow]:
    for name, field in type(sheet).model_fields.items():
        value = getattr(sheet, name)
        if isinstance(value, Sheet):
            yield from _rows(value, sources, doubts, f"{path}{name}.")
        elif value is not None and name not in _SAID_ELSEWHERE:
            extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
            unit = str(extra.get("unit", ""))
            doubt = getattr(doubts, _DOUBTED.get(path + name, path + name), 0.0)
            yield FieldRow(
                field=path + name,
                symbol=str(extra.get("symbol", "")),
                value=human(value, unit=unit),
                source=sources.get(path + name, "default" if value == field.default else ""),
                doubt=human(doubt, unit=unit) if doubt else "",
            )
