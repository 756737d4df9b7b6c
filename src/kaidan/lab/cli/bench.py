"""``kaidan lab bench``: tools that judge stairs, on frozen cases with known outcomes."""

from pathlib import Path
from typing import Annotated

import typer

from kaidan.cli import options, output


def register(app: typer.Typer) -> None:
    """Add ``bench`` to the command line."""
    app.command("bench")(bench)


def bench(
    adapter: Annotated[
        Path | None,
        typer.Option(
            "--adapter", metavar="FILE.py", help='Own tool: answer(case) returns "GO" or "NO-GO".'
        ),
    ] = None,
    as_json: options.AsJson = False,
) -> None:
    """Count wrong GO, wrong NO-GO and undecided of kaidan, simple rules and a tool of your own."""
    from kaidan.lab.outcomes.bench import bench as run

    output.put_out(run(adapter), {}, as_json=as_json)
