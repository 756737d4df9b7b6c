"""``kaidan compare``: many robots against many stairs."""

from typing import Annotated

import typer

from kaidan.cli import options, output

RobotNames = Annotated[
    list[str] | None,
    typer.Argument(metavar="ROBOT", help="Catalogue names or TOML files [all robots]."),
]
StairsNames = Annotated[
    list[str] | None,
    typer.Option(
        "--stairs", metavar="NAME", help="Stairs to compare; may be given again [all stairs]."
    ),
]
FlippersWhere = Annotated[
    str | None,
    typer.Option(help="As in assess; robots without flippers pass over it [best, for each pair]."),
]
Workers = Annotated[
    int | None,
    typer.Option(min=1, max=1024, help="Processes of the contact model [one a processor]."),
]


def register(app: typer.Typer) -> None:
    """Add ``compare`` to the command line."""
    app.command("compare")(compare)


def compare(
    robots: RobotNames = None,
    stairs: StairsNames = None,
    surface: options.SurfaceName = None,
    friction: options.Friction = None,
    acceleration: options.Acceleration = "0m/s2",
    direction: options.Direction = None,
    facing: options.Facing = None,
    flippers: FlippersWhere = None,
    theta_d: options.ThetaD = None,
    theta_m: options.ThetaM = None,
    override: options.Override = None,
    risk: options.Risk = 0.01,
    model: options.Model = "contact",
    workers: Workers = None,
    figure: output.FigureFiles = None,
    csv: output.CsvFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Compare many robots on many stairs: a verdict and a margin for each pair."""
    from kaidan import files
    from kaidan.verbs.comparison import compare as find

    pictures = output.checked(figure, csv)

    found = find(
        robots or None,
        stairs or None,
        surface=surface,
        friction=friction,
        acceleration=acceleration,
        direction=direction,
        facing=facing,
        flippers=flippers,
        workers=workers,
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
        from kaidan.figures.comparison_figure import comparison_figure

        return comparison_figure(found)

    contents |= output.drawn(pictures, draw)
    output.put_out(found, contents, as_json=as_json)
