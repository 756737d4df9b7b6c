"""``kaidan margin``: how steep stairs may be, and how gentle, for every nosing spacing."""

from typing import Annotated

import typer

from kaidan.cli import options, output

From = Annotated[str | None, typer.Option("--from", help="Smallest nosing spacing, e.g. 100mm.")]
To = Annotated[str | None, typer.Option("--to", help="Largest nosing spacing, e.g. 350mm.")]
Points = Annotated[
    int | None, typer.Option(min=2, max=100_000, help="Number of spacings [every 5 mm].")
]
Codes = Annotated[
    bool, typer.Option("--codes", help="Show the stairs of the catalogue, each at its steepest.")
]


def register(app: typer.Typer) -> None:
    """Add ``margin`` to the command line."""
    app.command("margin")(margin)


def margin(
    robot: options.RobotName,
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    acceleration: options.Acceleration = "0m/s2",
    direction: options.Direction = None,
    facing: options.Facing = None,
    start: From = None,
    to: To = None,
    points: Points = None,
    theta_d: options.ThetaD = None,
    theta_m: options.ThetaM = None,
    override: options.Override = None,
    codes: Codes = False,
    figure: output.FigureFiles = None,
    csv: output.CsvFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Show how steep stairs may be, and how gentle, for every nosing spacing.

    Exit code: 0, 2 bad input, 3 outside the model whatever the spacing.
    """
    from kaidan import files
    from kaidan.verbs import margin_curve

    pictures = output.checked(figure, csv)
    requested = margin_curve.question_of(
        robot,
        flippers=flippers,
        payload=payload,
        acceleration=acceleration,
        direction=direction,
        facing=facing,
        theta_d=theta_d,
        theta_M=theta_m,
        override=override,
    )
    stairs = margin_curve.catalogue_stairs() if codes else []
    p = margin_curve.spacings(requested, start, to, points, stairs, ends=("--from", "--to"))
    curve = margin_curve.margin_curve(requested, p, stairs)
    contents: output.Contents = {}
    if csv is not None:
        contents[csv] = files.csv_text(curve.columns())
    if not curve.outside:

        def draw() -> "output.Figure":
            from kaidan.figures.margin_figure import margin_figure

            return margin_figure(margin_curve.fine_curve(requested, curve, stairs))

        contents |= output.drawn(pictures, draw)
    output.put_out(curve, contents, as_json=as_json)
    if curve.outside:
        raise typer.Exit(3)
