"""``kaidan report``: a document on missions, for the field and for who signs."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question_of, question_options, shared
from kaidan.modes import EXIT_CODES

if TYPE_CHECKING:
    from kaidan.question import Question

Ask = Callable[[str, str | None], "Question"]
Names = Annotated[
    list[str] | None,
    typer.Argument(
        metavar="[ROBOT] [STAIRS]...",
        help="Robot, then stairs, as in assess; each of several stairs is a mission of its own.",
    ),
]
MoreRobots = Annotated[
    list[str] | None,
    typer.Option("--robot", metavar="ROBOT", help="Another robot; may be given again."),
]
OutFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--out", "-o", metavar="FILE", help="Document: .pdf or .html. May be given again."
    ),
]
Codes = Annotated[
    list[str] | None,
    typer.Option(
        "--again",
        metavar="CODE",
        help="Code of an earlier report, which is answered again; may be given again.",
    ),
]
Language = Annotated[Literal["en", "ja"], typer.Option(help="Language of the text.")]


def register(app: typer.Typer) -> None:
    """Add ``report`` to the command line."""
    app.command("report", epilog=f"Exit code, by the worst verdict: {EXIT_CODES}.")(report)


def _asking(**values: Any) -> Ask:
    return lambda robot, stairs: question_of(robot, stairs, **values)


@shared((question_options,), _asking, without=("robot", "stairs"))
def report(
    ask: Ask,
    names: Names = None,
    robot: MoreRobots = None,
    again: Codes = None,
    out: OutFiles = None,
    language: Language = "en",
    as_json: options.AsJson = False,
) -> None:
    """Write a document: a page for the field, then inputs, margins, figures and limits."""
    from kaidan.documents import document_format, report_bytes
    from kaidan.errors import InputError
    from kaidan.verbs.report import report as find
    from kaidan.verbs.report.code import question_of as coded

    formats = {path: document_format(path) for path in out or ()}
    first, *stairs = names or [""]
    robots = [*([first] if first else []), *(robot or [])]
    if not robots and not again:
        raise InputError("report: no robot; write kaidan report ROBOT STAIRS -o FILE")
    terrains: list[str | None] = [*stairs] or [None]
    questions = [ask(each, on) for each in robots for on in terrains]
    found = find([*map(coded, again or ()), *questions])
    contents: output.Contents = {
        path: report_bytes(found, form, language) for path, form in formats.items()
    }
    output.put_out(found, contents, as_json=as_json)
    raise typer.Exit(found.exit_code)
