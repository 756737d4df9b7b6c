"""The command line: degrees and millimetres in, verdicts and pictures out.

Exit codes: 0 go or caution, 1 no-go, 2 bad input, 3 outside the model.
"""

import sys

import typer

from kaidan.cli import catalogs

app = typer.Typer(
    name="kaidan",
    help="Can this tracked robot take these stairs?",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
catalogs.register(app)


def main() -> None:
    """Run the command line; what kaidan refuses ends with exit code 2 and one line."""
    from kaidan.errors import KaidanError

    try:
        app()
    except KaidanError as error:
        print(f"kaidan: {error}", file=sys.stderr)  # noqa: T201
        sys.exit(2)
    except BrokenPipeError:
        sys.stderr.close()
        sys.exit(0)
