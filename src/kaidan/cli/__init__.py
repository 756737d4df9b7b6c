"""The command line: degrees and millimetres in, verdicts and pictures out.

Exit codes: 0 go or caution, 1 no-go, 2 bad input, 3 outside the model.
"""

import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from typing import Annotated, Any, NoReturn

import typer

_COMMANDS = {
    "agree": ("agree",),
    "assess": ("assess",),
    "calibrate": ("calibrate",),
    "campaign": ("campaign",),
    "catalogs": ("robots", "stairs", "surfaces", "new", "schema"),
    "experiment": ("experiment",),
    "monitor": ("monitor",),
    "physics": ("physics",),
    "posture": ("posture",),
    "reports": ("margin", "plane", "compare", "reproduce"),
    "traverse": ("traverse",),
}
"""Commands by the module that registers them: one that is asked for is loaded alone."""

_START_LIGHTLY = {
    "OPENBLAS_NUM_THREADS": "1",  # no matrix here is worth the threads numpy would start
    "PYDANTIC_DISABLE_PLUGINS": "__all__",  # kaidan uses none, and looking for some takes time
}


def _print_version(wanted: bool) -> None:
    if wanted:
        from kaidan import __version__

        typer.echo(__version__)
        raise typer.Exit


def kaidan(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, help="Show the version and exit.")
    ] = False,
) -> None:
    """Can this tracked robot take these stairs?"""


def app_for(words: Sequence[str]) -> typer.Typer:
    """Command line with the command that comes first, or with all if that is none of them."""
    app = typer.Typer(
        name="kaidan",
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(kaidan)
    asked = words[0] if words else ""
    modules = [name for name, commands in _COMMANDS.items() if asked in commands] or _COMMANDS
    for name in modules:
        import_module(f"kaidan.cli.{name}").register(app)
    return app


def __getattr__(name: str) -> Any:
    """All commands as `app`, for those who run it in their own process."""
    if name == "app":
        return app_for(())
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def main() -> None:
    """Run the command line; what kaidan refuses ends with exit code 2 and one line."""
    for name, value in _START_LIGHTLY.items():
        os.environ.setdefault(name, value)
    from kaidan.errors import KaidanError

    try:
        app_for(sys.argv[1:])()
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
