"""``kaidan lab reproduce``: the paper again."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, output

if TYPE_CHECKING:
    from kaidan.lab.reproduction.reproduction import Reproduction

Folder = Annotated[
    Path | None,
    typer.Option("--out", metavar="FOLDER", help="Write figures, captions and tables into it."),
]
Formats = Annotated[
    list[str] | None,
    typer.Option("--format", help="png, svg or pdf for --out; may be given again [png]."),
]


def register(app: typer.Typer) -> None:
    """Add ``reproduce`` to the command line."""
    app.command("reproduce")(reproduce)


def reproduce(out: Folder = None, formats: Formats = None, as_json: options.AsJson = False) -> None:
    """Reproduce the paper: what its text prints, what kaidan computes, and the difference."""
    from kaidan import files
    from kaidan.errors import InputError, shown
    from kaidan.lab.reproduction import reproduction

    if formats and out is None:
        raise InputError("--format needs --out FOLDER")
    if out is not None:
        from kaidan.figures.saving import FORMATS

        for form in formats or ():
            if form not in FORMATS:
                raise InputError(
                    f"--format {shown(form)} is not known; known: {', '.join(FORMATS)}"
                )
    found = reproduction.reproduce()
    contents: output.Contents = {}
    if out is not None:
        contents = _pictures(found, out, tuple(dict.fromkeys(formats or ("png",))))
        contents[out / "captions.txt"] = "\n\n".join(
            f"{name}: {text}" for name, text in found.captions.items()
        )
        for name, rows in (("table1", reproduction.table_1()), ("printed-computed", found.table)):
            contents[out / f"{name}.csv"] = files.csv_text(reproduction.columns(rows))
        contents[out / "reproduction.json"] = found.to_json() + "\n"
        try:
            out.mkdir(parents=True, exist_ok=True)
        except (OSError, ValueError) as error:
            raise InputError(f"{out}: cannot be made: {files.reason(error)}") from None
    output.put_out(found, contents, as_json=as_json)
    if out is None and not as_json:
        typer.echo("Figures, captions and tables as files: kaidan lab reproduce --out FOLDER")


def _pictures(found: "Reproduction", out: Path, formats: tuple[str, ...]) -> output.Contents:
    """Figures of the paper as files."""
    from kaidan.figures.d_a_figure import d_a_figure
    from kaidan.figures.margin_figure import margin_figure
    from kaidan.figures.saving import figure_bytes
    from kaidan.lab.reproduction import reproduction
    from kaidan.lab.reproduction.experiment_figure import experiment_figure
    from kaidan.lab.reproduction.text import FIG_11_NOTE, fig_7_note
    from kaidan.lab.reproduction.triangle_figure import triangle_figure

    curve = reproduction.fig_11()
    figures = {
        "fig07": d_a_figure(reproduction.fig_7(), fig_7_note(reproduction.FRICTION_SHOWN)),
        "fig10": triangle_figure(found.state_c),
        "fig11": margin_figure(curve, FIG_11_NOTE),
        "fig13_21": experiment_figure(found, curve),
    }
    return {
        out / f"{name}.{form}": figure_bytes(figure, form)
        for name, figure in figures.items()
        for form in formats
    }
