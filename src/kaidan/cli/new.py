"""``kaidan new``: a sheet to fill in by hand, or by questions."""

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli.tables import echo
from kaidan.tables import printable

if TYPE_CHECKING:
    from kaidan.sheet import Sheet


class What(StrEnum):
    """Kinds of sheets."""

    ROBOT = "robot"
    STAIRS = "stairs"
    SURFACE = "surface"


def register(app: typer.Typer) -> None:
    """Add the command of this module to the command line."""
    app.command("new")(new)


def new(
    what: Annotated[What, typer.Argument(help="Kind of sheet.")],
    file: Annotated[Path, typer.Argument(help="TOML file to write.")],
    asked: Annotated[
        bool,
        typer.Option("--ask", help="Ask for each figure; answers may be piped in, one a line."),
    ] = False,
    force: Annotated[bool, typer.Option("--force", help="Replace a file that is there.")] = False,
) -> None:
    """Write a commented sheet, to fill in by hand or by questions (--ask).

    Filled in, the file works wherever a name of the catalogue does. Scales, a tape and a level
    give the figures: kaidan measure robot --help, with a drawing of L, C_L, C_N and R.
    """
    from kaidan.catalog.completing import completed
    from kaidan.catalog.template import blank_toml
    from kaidan.files import write_all

    shown = checked_sheet_file(file, force=force)
    name = file.stem.encode(errors="replace").decode()
    text = blank_toml(_model(what), name=name, title=title_of(what, file.name))
    listing, _ = _COMMANDS[what]
    if asked:
        from kaidan.cli.asking import ask

        write_all({file: completed(text, ask(_model(what)), origin=shown)})
        echo(f"wrote {shown}; look at it: kaidan {listing} {shown}")
        say_next(file, _model(what))
        return
    write_all({file: text})
    echo(f"wrote {shown}: fill it in, then look at it: kaidan {listing} {shown}")


def say_next(file: Path, kind: "type[Sheet]", *, aside: bool = False) -> None:
    """Say what a sheet still asks for, or how to use it."""
    from kaidan.catalog import text_of
    from kaidan.errors import InputError

    shown = printable(str(file))
    try:
        kind.from_text(text_of(file), origin=shown)
    except InputError as error:
        typer.echo(f"to do: {error}", err=aside)
        return
    uses = {
        "robot": f"{shown} STAIRS",
        "stairs": f"ROBOT {shown}",
        "surface": f"ROBOT STAIRS --surface {shown}",
    }
    typer.echo(f"next: kaidan assess {uses[kind.label]}", err=aside)


def checked_sheet_file(file: Path, *, force: bool) -> str:
    """Name of a sheet's file as it is shown, once it is sure that it may be written."""
    import os

    from kaidan.errors import InputError

    shown = printable(str(file))
    if file.suffix.lower() != ".toml":
        raise InputError(f"{shown}: a sheet is a TOML file; write {printable(file.stem)}.toml")
    if os.path.lexists(file) and not force:
        raise InputError(f"{shown} is there already; --force replaces it")
    return shown


def title_of(what: str, file: str) -> str:
    """First lines of a sheet: what it is, and how it is used."""
    listing, use = _COMMANDS[What(what)]
    return f"{use}\nSee what kaidan makes of it: kaidan {listing} {printable(file)}"


_COMMANDS = {
    What.ROBOT: ("robots", "A tracked robot. Used by: kaidan assess THIS.toml STAIRS"),
    What.STAIRS: ("stairs", "A straight flight of stairs. Used by: kaidan assess ROBOT THIS.toml"),
    What.SURFACE: ("surfaces", "A surface. Used by: kaidan assess ... --surface THIS.toml"),
}


def _model(what: What) -> "type[Sheet]":
    from kaidan.robot import Robot
    from kaidan.surface import Surface
    from kaidan.terrain.stairs import Stairs

    models: dict[What, type[Sheet]] = {
        What.ROBOT: Robot,
        What.STAIRS: Stairs,
        What.SURFACE: Surface,
    }
    return models[what]
