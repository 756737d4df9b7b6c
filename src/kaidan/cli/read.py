"""``kaidan read``: what a file is, what was found in it, and sheets of it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, output

if TYPE_CHECKING:
    from kaidan.verbs.read import FileAnswer

File = Annotated[
    str,
    typer.Argument(
        metavar="FILE[#PART]",
        help="Robot description, building model, mesh, point cloud or elevation map; its content "
        "says which. PART is a GlobalId, a topic, a model in it.",
    ),
]
SheetFile = Annotated[
    Path | None,
    typer.Option("--output", "-o", metavar="FILE.toml", help="Write the sheet: robot or stairs."),
]
Force = Annotated[bool, typer.Option("--force", help="Replace a sheet that is there.")]
Unit = Annotated[str | None, typer.Option(help="Unit of its lengths: m, cm, mm, in, ft.")]
Up = Annotated[str | None, typer.Option(help="Axis that points up: +z, -y, ...")]
Forward = Annotated[str | None, typer.Option(help="Axis that points to a robot's front [+x].")]
Crop = Annotated[
    str | None,
    typer.Option(help="Box to read: smallest x,y,z, then largest: 0,-1,0,3,1,2."),
]
RangeError = Annotated[
    str | None, typer.Option(help="Standard error of distances, as a share: 0.005.")
]
Gravity = Annotated[
    str | None, typer.Option(help="Standard error of its up axis against gravity, e.g. 1deg.")
]
Viewpoint = Annotated[str | None, typer.Option(help="Where the sensor stood: x,y,z in the file.")]
Resolution = Annotated[
    str | None, typer.Option(help="Cell of an elevation map that does not say it, e.g. 20mm.")
]
Joint = Annotated[
    list[str] | None,
    typer.Option("--joint", help="Joint of a robot, NAME=30deg or NAME=200mm; may be repeated."),
]
Own = Annotated[
    list[str] | None,
    typer.Option("--override", help="Own figure of a robot: com_height=200mm, track.width=80mm."),
]


def register(app: typer.Typer) -> None:
    """Add ``read`` to the command line."""
    app.command("read")(read)


def read(
    file: File,
    out: SheetFile = None,
    force: Force = False,
    unit: Unit = None,
    up: Up = None,
    forward: Forward = None,
    crop: Crop = None,
    range_error: RangeError = None,
    gravity: Gravity = None,
    viewpoint: Viewpoint = None,
    resolution: Resolution = None,
    joint: Joint = None,
    override: Own = None,
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Say what FILE is, what was found in it and with what doubt, and write a sheet of it.

    Robots: URDF, SDF, MJCF. A staircase of several flights becomes several sheets, numbered from
    bottom to top. Exit code: 0 something was found, 2 it cannot be read, 3 it holds nothing to
    judge.
    """
    from kaidan.verbs.read import read as read_file

    pictures = output.checked(figure, out)
    if out is not None:
        from kaidan.cli.new import checked_sheet_file

        checked_sheet_file(out, force=force)
    found = read_file(
        file, unit=unit, up=up, forward=forward, crop=crop, range_error=range_error,
        gravity=gravity, viewpoint=viewpoint, resolution=resolution, joints=joint or (),
        override=override or (),
    )  # fmt: skip
    files = _drawn(found, pictures)
    if out is not None and found.exit_code == 0:
        files |= _sheets(found, out, force=force)
    output.put_out(found, files, as_json=as_json)
    raise typer.Exit(found.exit_code)


def _drawn(found: "FileAnswer", pictures: tuple[Path, ...]) -> output.Contents:
    if not pictures:
        return {}
    from kaidan.figures.read_figure import drawable, read_figure

    return output.drawn(pictures, lambda: read_figure(found)) if drawable(found) else {}


def _sheets(found: "FileAnswer", out: Path, *, force: bool) -> output.Contents:
    """Sheets as files; those of several flights are numbered."""
    from kaidan.cli.new import checked_sheet_file

    sheets = list(found.sheets().values())
    paths = [out]
    if len(sheets) > 1:
        paths = [
            out.with_name(f"{out.stem}-{number}{out.suffix}")
            for number in range(1, len(sheets) + 1)
        ]
        for path in paths:
            checked_sheet_file(path, force=force)
    return {path: sheet.to_toml() for path, sheet in zip(paths, sheets, strict=True)}
