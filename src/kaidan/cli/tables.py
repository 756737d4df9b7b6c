"""Text, tables and JSON on standard output, whatever the screen can show."""

import io
import sys
from collections.abc import Sequence
from typing import Any

import typer


def echo(text: str) -> None:
    """Print a text; standard output shows "?" for what its encoding cannot show."""
    from kaidan.tables import printable

    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")
    typer.echo(printable(text))


def echo_table(
    rows: Sequence[dict[str, Any]], columns: dict[str, str], *, below: str | None = None
) -> None:
    """Print a table, see `kaidan.tables.table`."""
    from kaidan.tables import table

    echo(table(rows, columns, below=below))


def echo_json(value: Any) -> None:
    """Print one JSON object, in ASCII."""
    import json

    typer.echo(json.dumps(value, indent=2, allow_nan=False))
