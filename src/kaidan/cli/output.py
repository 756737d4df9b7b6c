"""What commands put out: pictures and tables as files, then the answer as text or JSON."""

import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli.tables import echo
from kaidan.modes import Verdict

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Figure

    from kaidan.answer import Answer

Contents = dict[Path, bytes | str]
"""What each file shall hold."""
FigureFiles = Annotated[
    list[Path] | None,
    typer.Option(
        "--figure",
        metavar="FILE",
        help="Write a picture: .png, .svg or .pdf. May be given again.",
    ),
]
CsvFile = Annotated[
    Path | None, typer.Option("--csv", metavar="FILE", help="Write the numbers as a table.")
]


def checked(figures: Sequence[Path] | None, *others: Path | None) -> tuple[Path, ...]:
    """Files of a picture, refused before anything is computed if one cannot be."""
    from kaidan.errors import InputError

    files = tuple(dict.fromkeys(figures or ()))
    if files:
        from kaidan.figures.saving import figure_format

        for path in files:
            figure_format(path)
    every = [*files, *(path for path in others if path is not None)]
    for path in every:
        if every.count(path) > 1:
            raise InputError(f"{path} is to be written twice, with different contents")
    return files


def drawn(files: Sequence[Path], draw: "Callable[[], Figure]") -> Contents:
    """Contents of the files of a picture; it is drawn once, and not at all without files."""
    if not files:
        return {}
    from kaidan.figures.saving import figure_bytes, figure_format
    from kaidan.progress import working

    with working("drawing"):
        figure = draw()
        return {path: figure_bytes(figure, figure_format(path)) for path in files}


def put_out(answer: "Answer", contents: Contents, *, as_json: bool) -> None:
    """Write the files, print the answer, and say which files there are."""
    put_text(answer.to_json() if as_json else str(answer), contents, aside=as_json)


def put_text(text: str, contents: Contents, *, verdict: str = "", aside: bool = False) -> None:
    """Write the files, print a text, and say which files there are.

    text: what to print; begins with the label of the verdict, if one is given.
    """
    from kaidan.files import write_all

    write_all(contents)
    label = Verdict(verdict).label if verdict else ""
    if label and text.startswith(label) and sys.stdout.isatty() and not os.environ.get("NO_COLOR"):
        text = typer.style(label, fg=_COLOURS[verdict], bold=True) + text[len(label) :]
        typer.echo(text)
    else:
        echo(text)
    _say(contents, aside)


def write(contents: Contents, *, aside: bool = False) -> None:
    """Write the files, and say which there are."""
    from kaidan.files import write_all

    write_all(contents)
    _say(contents, aside)


def _say(contents: Contents, aside: bool) -> None:
    """Which files there are, and how large the pictures and films among them."""
    from kaidan.files import size_of

    for path, content in contents.items():
        size = f" ({size_of(content)})" if isinstance(content, bytes) else ""
        typer.echo(f"wrote {path}{size}", err=aside)


_COLOURS = {
    "go": "green",
    "rough": "yellow",
    "unsure": "cyan",
    "no-go": "red",
    "outside-model": "magenta",
}
