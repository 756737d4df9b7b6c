"""The commands of the laboratory, below ``kaidan lab``."""

from importlib import import_module

import typer

_COMMANDS = (
    "agree", "bench", "calibrate", "campaign", "experiment", "outcomes", "physics", "reproduce",
    "rerun", "schema",
)  # fmt: skip


def register(app: typer.Typer) -> None:
    """Add ``lab`` and its commands to the command line."""
    group = typer.Typer(
        name="lab",
        help="The laboratory: the paper again, trials in physics, models compared and calibrated.",
        no_args_is_help=True,
    )
    for name in _COMMANDS:
        import_module(f"kaidan.lab.cli.{name}").register(group)
    app.add_typer(group)
