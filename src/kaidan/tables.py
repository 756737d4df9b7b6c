"""Tables and values as text: millimetres and degrees, as wide as the screen is."""

import math
import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

_UNITS = {"m": ("mm", 1e3), "rad": ("deg", 180 / math.pi), "rad/s": ("deg/s", 180 / math.pi)}
_WIDE = 400
"""Width of a table that nobody looks at on a screen."""


def unit_of(key: str) -> str:
    """Unit at the end of a JSON key."""
    suffix = key.rpartition("_")[2]
    return suffix if suffix in ("m", "deg", "kg") else ""


def human(value: Any, key: str = "", unit: str = "") -> str:
    """Value with its unit as people write it: millimetres and degrees."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list | tuple):
        return ", ".join(human(item, key, unit) for item in value)
    if not isinstance(value, int | float):
        return str(value)
    unit = unit or unit_of(key)
    shown, factor = _UNITS.get(unit, ("" if unit in ("1", "risers") else unit, 1.0))
    return f"{_number(value * factor)} {shown}".strip()


def fixed(value: float | None, digits: int = 1, sign: str = "") -> str:
    """Number with fixed decimals, never -0; a dash for none.

    Examples
    --------
    >>> fixed(-0.04), fixed(2.25, 1, "+"), fixed(None)
    ('0.0', '+2.2', '-')
    """
    return "-" if value is None else f"{round(value, digits) + 0.0:{sign}.{digits}f}"


def decimals(value: float, digits: int) -> int:
    """So many decimals that a number other than 0 does not look like it; 4 at most.

    Examples
    --------
    >>> decimals(-0.02, 1), decimals(2.25, 1), decimals(0.0, 1)
    (2, 1, 1)
    """
    while digits < 4 and 0 < abs(value) < 0.5 * 10**-digits:
        digits += 1
    return digits


def _number(value: float) -> str:
    return f"{value:.5g}" if abs(value) < 1e5 else f"{value:.0f}"


def _cell(value: Any, key: str) -> str:
    """Value in a column whose head names the unit."""
    if value is None:
        return "-"
    if isinstance(value, list):
        return "/".join(dict.fromkeys(_cell(item, key) for item in value))
    if isinstance(value, bool) or not isinstance(value, int | float):
        return human(value)
    if unit_of(key) == "deg":
        return f"{value:.1f}"
    return f"{value * 1e3:.1f}".removesuffix(".0") if unit_of(key) == "m" else _number(value)


def table(
    rows: Sequence[dict[str, Any]], columns: dict[str, str], *, below: str | None = None
) -> str:
    """Table as text.

    Parameters
    ----------
    rows : sequence of dict
        Values by key.
    columns : dict
        Head of each column by its key, in their order.
    below : str, optional
        Key of the text that goes on a line of its own below its row where the screen is too
        narrow for the whole table.
    """
    from rich.console import Console

    whole = _made(rows, columns)
    console = Console(width=_WIDE, color_system=None)
    width = screen_width()
    if below is None or console.measure(whole).maximum <= width:
        return "\n".join(_lines(console, whole, width))
    heads = {key: head.replace(" [", "\n[") for key, head in columns.items() if key != below}
    narrow = _made(rows, heads)
    lines = _lines(console, narrow, max(width, console.measure(narrow).maximum))
    first = len(lines) - len(rows)
    texts = [f"    {printable(_cell(row[below], below))}" for row in rows]
    both = [line for pair in zip(lines[first:], texts, strict=True) for line in pair]
    return "\n".join([*lines[:first], *both])


def _made(rows: Sequence[dict[str, Any]], columns: dict[str, str]) -> "Table":
    from rich import box
    from rich.table import Table
    from rich.text import Text

    made = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False, header_style="")
    for key, head in columns.items():
        numeric = any(isinstance(row[key], int | float | list) for row in rows)
        made.add_column(Text(head), justify="right" if numeric else "left", overflow="fold")
    for row in rows:
        made.add_row(*(Text(printable(_cell(row[key], key))) for key in columns))
    return made


def _lines(console: "Console", made: "Table", width: int) -> list[str]:
    with console.capture() as capture:
        console.print(made, width=width)
    return [line.rstrip() for line in capture.get().splitlines()]


def screen_width() -> int:
    """Columns of the screen that standard output is, or that COLUMNS states; else very many."""
    import shutil

    seen = sys.stdout.isatty() or "COLUMNS" in os.environ
    return shutil.get_terminal_size().columns if seen else _WIDE


def printable(text: str) -> str:
    """Text without the control characters that a user's file may hold."""
    return "".join(c if c.isprintable() or c == "\n" else "�" for c in text)
