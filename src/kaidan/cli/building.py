"""``kaidan building``: robots in a building model."""

from pathlib import Path
from typing import Annotated

import typer

from kaidan.cli import options, output

ModelFile = Annotated[Path, typer.Argument(metavar="FILE", help="Building model: .ifc or .ifczip.")]
RobotNames = Annotated[
    str, typer.Option("--robots", metavar="NAME,NAME", help="Catalogue names or TOML files.")
]
FlippersThere = Annotated[
    str,
    typer.Option(
        help="Posture on the flights, as in assess; robots without flippers pass over it."
    ),
]
WayDirection = Annotated[
    str, typer.Option("--direction", help="Direction in the table of flights: up or down.")
]
StartStorey = Annotated[
    str | None,
    typer.Option("--from", metavar="STOREY", help="Where the ways begin [nearest to level 0]."),
]
PageFile = Annotated[
    Path | None,
    typer.Option("--html", metavar="FILE", help="Write a page with plans, complete in itself."),
]


def register(app: typer.Typer) -> None:
    """Add ``building`` to the command line."""
    app.command("building")(building)


def building(
    file: ModelFile,
    robots: RobotNames,
    surface: options.SurfaceName = None,
    friction: options.Friction = None,
    flippers: FlippersThere = "best",
    direction: WayDirection = "up",
    start: StartStorey = None,
    speed: options.Speed = None,
    theta_d: options.ThetaD = None,
    theta_m: options.ThetaM = None,
    override: options.Override = None,
    risk: options.Risk = 0.01,
    model: options.Model = "contact",
    figure: output.FigureFiles = None,
    csv: output.CsvFile = None,
    html: PageFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Judge every straight flight of a building model, and the ways to its storeys."""
    from kaidan import files
    from kaidan.verbs.building import building as find

    pictures = output.checked(figure, csv, html)
    found = find(
        file,
        [name.strip() for name in robots.split(",") if name.strip()],
        surface=surface,
        friction=friction,
        flippers=flippers,
        direction=direction,
        start=start,
        speed=speed,
        theta_d=theta_d,
        theta_M=theta_m,
        override=override or (),
        risk=risk,
        model=model,
    )
    contents: output.Contents = {}
    if csv is not None:
        contents[csv] = files.csv_text(found.columns())

    def draw() -> "output.Figure":
        from kaidan.figures.building_figure import building_figure

        return building_figure(found)

    if html is not None:
        from kaidan.figures.saving import figure_bytes
        from kaidan.text.building_page import page

        plan = figure_bytes(draw(), "svg").decode() if found.flights else ""
        contents[html] = page(found, plan)
    contents |= output.drawn(pictures, draw)
    output.put_out(found, contents, as_json=as_json)
    raise typer.Exit(found.exit_code)
