"""The command line: degrees and millimetres in, verdicts and pictures out.

Exit codes: 0 go or caution, 1 no-go, 2 bad input, 3 outside the model.
"""

import os
import sys
from contextlib import suppress
from typing import Annotated, NoReturn

import typer

from kaidan.cli import (
    agree,
    assess,
    calibrate,
    campaign,
    catalogs,
    experiment,
    monitor,
    physics,
    posture,
    reports,
    traverse,
)

_START_LIGHTLY = {
    "OPENBLAS_NUM_THREADS": "1",  # no matrix here is worth the threads numpy would start
    "PYDANTIC_DISABLE_PLUGINS": "__all__",  # kaidan uses none, and looking for some takes time
}

app = typer.Typer(
    name="kaidan",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)


def _print_version(wanted: bool) -> None:
    if wanted:
        from kaidan import __version__

        typer.echo(__version__)
        raise typer.Exit


@app.callback()
def kaidan(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, help="Show the version and exit.")
    ] = False,
) -> None:
    """Can this tracked robot take these stairs?"""


agree.register(app)
assess.register(app)
calibrate.register(app)
campaign.register(app)
catalogs.register(app)
experiment.register(app)
monitor.register(app)
physics.register(app)
posture.register(app)
reports.register(app)
traverse.register(app)


def main() -> None:
    """Run the command line; what kaidan refuses ends with exit code 2 and one line."""
    for name, value in _START_LIGHTLY.items():
        os.environ.setdefault(name, value)
    from kaidan.errors import KaidanError

    try:
        app()
    except KaidanError as error:
        _complain(str(error))
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(0)
    except OSError as error:  # a full disk behind standard output, for example
        _complain(f"the answer cannot be written: {error.strerror or error}")


def _complain(text: str) -> NoReturn:
    """Say in one line what is wrong, if anybody listens, and end with exit code 2."""
    with suppress(OSError):
        print(f"kaidan: {text}", file=sys.stderr, flush=True)  # noqa: T201
    sys.exit(2)
