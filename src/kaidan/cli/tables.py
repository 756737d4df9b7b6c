"""Tables, values and text on a screen: millimetres and degrees, whatever the screen is."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from rich.console import Console

_UNITS = {"m": ("mm", 1e3), "rad": ("deg", 180 / math.pi), "rad/s": ("deg/s", 180 / math.pi)}


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


def echo_table(rows: Sequence[dict[str, Any]], columns: dict[str, str]) -> None:
    """Print a table: the keys of `columns` choose from the rows, its values are the heads."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, show_edge=False, header_style="")
    for key, head in columns.items():
        numeric = any(isinstance(row[key], int | float | list) for row in rows)
        table.add_column(Text(head), justify="right" if numeric else "left", overflow="fold")
    for row in rows:
        table.add_row(*(Text(plain(_cell(row[key], key))) for key in columns))
    console = _console()
    with console.capture() as capture:
        console.print(table)
    typer.echo("\n".join(line.rstrip() for line in capture.get().splitlines()))


def echo(text: str) -> None:
    """Print a text."""
    _forgive_odd_characters()
    typer.echo(plain(text))


def echo_json(value: Any) -> None:
    """Print one JSON object, in ASCII."""
    import json

    typer.echo(json.dumps(value, indent=2, allow_nan=False))


def plain(text: str) -> str:
    """Text without the control characters that a user's file may hold."""
    return "".join(c if c.isprintable() or c == "\n" else "�" for c in text)


def _console() -> "Console":
    """Console on standard output, in a pipe as wide as the table needs."""
    import os
    import sys

    from rich.console import Console

    _forgive_odd_characters()
    piped = not sys.stdout.isatty() and "COLUMNS" not in os.environ
    return Console(width=400 if piped else None, color_system=None)


def _forgive_odd_characters() -> None:
    """Let standard output show "?" for what its encoding cannot show, instead of failing."""
    import io
    import sys

    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")
