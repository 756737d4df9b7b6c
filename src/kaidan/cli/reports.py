"""``kaidan margin|plane|compare|reproduce``: curves, planes, matrices, and the paper again."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from kaidan.cli import options
from kaidan.cli.question import question
from kaidan.cli.tables import echo, echo_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from kaidan.assessment.case import Case
    from kaidan.report.d_a_plane import Plane
    from kaidan.report.margin_curve import MarginCurve, Mark
    from kaidan.report.matrix import Matrix

FigureFile = Annotated[
    Path | None,
    typer.Option("--figure", metavar="FILE", help="Write a picture: .png, .svg or .pdf."),
]
CsvFile = Annotated[
    Path | None, typer.Option("--csv", metavar="FILE", help="Write a table of figures.")
]
From = Annotated[str | None, typer.Option("--from", help="Smallest nosing spacing, e.g. 100mm.")]
To = Annotated[str | None, typer.Option("--to", help="Largest nosing spacing, e.g. 350mm.")]
Points = Annotated[
    int | None, typer.Option(min=2, max=100_000, help="Number of spacings [every 5 mm].")
]
Codes = Annotated[
    bool, typer.Option("--codes", help="Show the stairs of the catalogue, each at its steepest.")
]
Accelerate = Annotated[
    bool,
    typer.Option(
        "--accelerate",
        help="Plan an acceleration over the position through area E, within the drive's limits; "
        "exit code 1 if one is needed and there is none.",
    ),
]
RobotNames = Annotated[
    list[str] | None,
    typer.Argument(metavar="ROBOT", help="Catalogue names or TOML files [all robots]."),
]
StairsNames = Annotated[
    list[str] | None,
    typer.Option("--stairs", metavar="NAME", help="May be given again [all stairs]."),
]
FlippersWhere = Annotated[
    str,
    typer.Option(help="As in assess; flat lays them in line with the track where there are some."),
]
Folder = Annotated[
    Path | None,
    typer.Option("--out", metavar="FOLDER", help="Write figures, captions and tables into it."),
]
Formats = Annotated[
    list[str] | None,
    typer.Option("--format", help="png, svg or pdf for --out; may be given again [png]."),
]

_STEP = 0.005
"""Between the spacings of a table, where the user states no number of them [m]."""
_ROWS = 16
"""Most lines of a table on the terminal."""


def register(app: typer.Typer) -> None:
    """Add the commands of this module to the command line."""
    app.command("margin")(margin)
    app.command("plane")(plane)
    app.command("compare")(compare)
    app.command("reproduce")(reproduce)


def margin(
    robot: options.RobotName,
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    acceleration: options.Acceleration = "0m/s2",
    direction: options.Direction = None,
    facing: options.Facing = "nose-first",
    start: From = None,
    to: To = None,
    points: Points = None,
    theta_d: options.ThetaD = None,
    theta_m: options.ThetaM = None,
    override: options.Override = None,
    codes: Codes = False,
    figure: FigureFile = None,
    csv: CsvFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Show how steep stairs may be, and how gentle, for every nosing spacing.

    Exit code: 0, 2 bad input, 3 outside the model whatever the spacing.
    """
    import numpy as np

    from kaidan.report import files
    from kaidan.report.margin_curve import margin_curve
    from kaidan.stairs import Stairs

    form = _form(figure, csv)
    case = options.case_from(
        robot,
        Stairs.inclined(angle=0.5, nosing_spacing=0.15),  # plays no part
        flippers=flippers,
        payload=payload,
        acceleration=acceleration,
        direction=direction,
        facing=facing,
        theta_d=theta_d,
        theta_m=theta_m,
        override=override,
    )
    marks = _marks() if codes else ()
    half = case.stance.flat_length / 2
    p = _spacings(half, start, to, points, marks)
    curve = margin_curve(case, p, marks)
    contents: dict[Path, bytes | str] = {}
    if csv is not None:
        contents[csv] = files.csv_text(curve.columns())
    if figure is not None and not curve.outside:
        from kaidan.report.margin_figure import margin_figure

        inside = [half] if p[0] <= half <= p[-1] else []
        dense = np.union1d(np.linspace(p[0], p[-1], 600), inside)
        contents[figure] = files.figure_bytes(margin_figure(margin_curve(case, dense, marks)), form)
    _put_out(contents, curve.as_dict() if as_json else None, lambda: _show_margin(curve))
    if curve.outside:
        raise typer.Exit(3)


def _spacings(
    half: float,
    start: str | None,
    to: str | None,
    points: int | None,
    marks: "tuple[Mark, ...]",
) -> "NDArray[Any]":
    """Nosing spacings asked for; by default from small ones to past half the flat length."""
    import numpy as np

    from kaidan.errors import InputError

    farthest = max([1.1 * half, *(1.05 * mark.p for mark in marks)])
    low = min(0.05, half / 2) if start is None else _spacing(start, "--from")
    high = math.ceil(farthest / 0.01) * 0.01 if to is None else _spacing(to, "--to")
    if not low < high:
        raise InputError(f"--from {1e3 * low:g} mm is not less than --to {1e3 * high:g} mm")
    count = points if points is not None else max(2, math.floor((high - low) / _STEP + 1e-6) + 1)
    if points is None and start is None and to is None:
        return np.round(low + _STEP * np.arange(count), 6)
    return np.linspace(low, high, count)


def _spacing(text: str, option: str) -> float:
    from kaidan.errors import InputError
    from kaidan.units import parse

    value = parse(text, "length", option=option)
    if not 0.01 <= value <= 5.0:
        raise InputError(f"{option} {text!r} is not within 10mm to 5m")
    return value


def _marks() -> "tuple[Mark, ...]":
    from kaidan import catalog
    from kaidan.report.margin_curve import mark
    from kaidan.stairs import Stairs

    return tuple(mark(Stairs.named(name)) for name in catalog.names("stairs"))


def _show_margin(curve: "MarginCurve") -> None:
    from kaidan.mechanics.plane import two_contacts_remain

    lead = f"{curve.direction} {curve.facing.replace('-', ' ')}, a = {curve.acceleration:g} m/s2"
    echo(
        f"{curve.robot}, {lead}: L {1e3 * curve.L:.0f} mm, centroid {1e3 * curve.C_L:.0f} mm "
        f"behind the uphill end and {1e3 * curve.C_N:.0f} mm high"
    )
    if curve.outside:
        echo(f"OUTSIDE THE MODEL: {curve.outside}")
        return
    columns = {name: _list(values) for name, values in curve.columns().items()}
    rows = [
        {name: values[index] for name, values in columns.items()}
        for index in _told(curve.p.tolist())
    ]
    echo_table(
        rows,
        {
            "nosing_spacing_m": "p [mm]",
            "contacts_n": "n",
            "margin_angle_deg": "tips downhill beyond [deg]",
            "margin_angle_corrected_low_deg": "allowances off [deg]",
            "lower_angle_deg": "tips uphill below [deg]",
            "lower_angle_corrected_high_deg": "allowances off [deg]",
        },
    )
    shown = ", ".join(
        f"{name} {math.degrees(value.low):.1f} to {math.degrees(value.high):.1f} deg "
        f"({value.source})"
        for name, value in (("theta_d", curve.theta_d), ("theta_M", curve.theta_M))
    )
    echo(f"Allowances, worst reading off: {shown}.")
    echo(f"Beyond p = L/2 = {1e3 * curve.L / 2:.0f} mm the model says nothing.")
    if curve.marks:
        echo("")
        echo_table(
            [
                {
                    "name": mark.name,
                    "angle_deg": math.degrees(mark.theta_s),
                    "nosing_spacing_m": mark.p,
                    "inside": bool(two_contacts_remain(L=curve.L, p=mark.p)),
                }
                for mark in sorted(curve.marks, key=lambda mark: mark.theta_s)
            ],
            {
                "name": "stairs",
                "angle_deg": "angle [deg]",
                "nosing_spacing_m": "p [mm]",
                "inside": "inside the model",
            },
        )


def _told(p: list[float]) -> list[int]:
    """Lines of a table that are told on the terminal, at round spacings if there are enough."""
    for step in (10, 20, 25, 50, 100):
        round_ones = [
            i for i, x in enumerate(p) if abs(1e3 * x / step - round(1e3 * x / step)) < 1e-6
        ]
        if _ROWS / 4 <= len(round_ones) <= _ROWS:
            return round_ones
    return list(range(0, len(p), math.ceil(len(p) / _ROWS)))


@question(without=("points", "uncertainty", "yaw", "risk"))
def plane(
    case: "Case",
    accelerate: Accelerate = False,
    figure: FigureFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Show the paper's d-a plane, its figure 7: limits of acceleration over the progress.

    Exit code: 0, 1 no plan where one is needed (--accelerate), 2 bad input, 3 outside the model.
    """
    from kaidan.report import files
    from kaidan.report.d_a_plane import d_a_plane

    form = _form(figure)
    found = d_a_plane(case, accelerate=accelerate)
    contents: dict[Path, bytes | str] = {}
    if figure is not None and not found.outside:
        from kaidan.report.d_a_figure import d_a_figure

        contents[figure] = files.figure_bytes(d_a_figure(found), form)
    _put_out(contents, found.as_dict() if as_json else None, lambda: _show_plane(found))
    if found.outside:
        raise typer.Exit(3)
    if found.plan is not None and not (found.plan.found or found.plan.needless):
        raise typer.Exit(1)


def _show_plane(plane: "Plane") -> None:
    pose = plane.pose
    echo(
        f"{plane.robot} on {plane.stairs}, {plane.direction} {plane.facing.replace('-', ' ')}: "
        f"{math.degrees(pose.theta_s):.1f} deg, {1e3 * pose.p:.0f} mm from nosing to nosing"
    )
    if plane.outside:
        echo(f"OUTSIDE THE MODEL: {plane.outside}. There is no plane and no figure.")
        return
    for name, start, end, contacts in plane.states():
        place = f"d = {1e3 * start:.0f} mm" if start == end else f"to {1e3 * end:.0f} mm"
        echo(f"  state {name}: {place}, {contacts} contacts")
    for value, name, meaning in (
        (plane.a_S, "a_S", "above it the tracks slip (A)"),
        (plane.min_a_r0, "min a_r0", "above a_r0(d) it tips downhill (B)"),
        (plane.max_a_rn, "max a_rn", "below a_rn(d) it tips uphill (C)"),
        (plane.a_slip_down, "downhill slip", "below it the tracks slip the other way (ours)"),
    ):
        shown = "friction not stated" if math.isnan(value) else f"{value:+.2f} m/s2"
        echo(f"  {name:<14}{shown:<20}{meaning}")
    if plane.a_min < plane.a_max:
        echo(f"  stable (D): {plane.a_min:+.2f} to {plane.a_max:+.2f} m/s2 throughout")
    else:
        echo("  stable (D): no constant acceleration")
    stays = ", ".join(
        f"{stay.area.name.replace('_', ' ').lower() if len(stay.area.name) > 1 else stay.area.name}"
        f" for d = {1e3 * stay.start:.0f} to {1e3 * stay.end:.0f} mm"
        for stay in plane.stays(plane.acceleration)
    )
    echo(f"  a = {plane.acceleration:g} m/s2 (asked): {stays}")
    if plane.plan is not None:
        echo(f"  {plane.plan.reason}")


def compare(
    robots: RobotNames = None,
    stairs: StairsNames = None,
    surface: options.SurfaceName = None,
    friction: options.Friction = None,
    acceleration: options.Acceleration = "0m/s2",
    direction: options.Direction = None,
    facing: options.Facing = "nose-first",
    flippers: FlippersWhere = "flat",
    theta_d: options.ThetaD = None,
    theta_m: options.ThetaM = None,
    risk: options.Risk = 0.01,
    model: options.Model = "contact",
    figure: FigureFile = None,
    csv: CsvFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Set many robots against many stairs: a verdict and a margin for each pair."""
    from kaidan import catalog
    from kaidan.errors import InputError
    from kaidan.report import files
    from kaidan.report.matrix import matrix
    from kaidan.robot import Robot
    from kaidan.stairs import Stairs

    form = _form(figure, csv)
    gross = catalog.gross_robots()
    asked = robots or [*catalog.names("robots"), *gross]
    apart = [name.strip().lower() for name in asked if name.strip().lower() in gross]
    known = [name for name in asked if name.strip().lower() not in gross]
    if not known:
        raise InputError(f"no centroid is published of {', '.join(apart)}: nothing to compare")
    flights = [Stairs.named(name) for name in stairs or catalog.names("stairs")]

    def case(name: str, flight: Stairs) -> "Case":
        robot = Robot.named(name)
        bare = robot.front_flippers is None and robot.rear_flippers is None
        return options.case_from(
            name,
            flight,
            surface=surface,
            friction=friction,
            acceleration=acceleration,
            direction=direction,
            facing=facing,
            flippers="stowed" if bare and flippers.strip() == "flat" else flippers,
            theta_d=theta_d,
            theta_m=theta_m,
            risk=risk,
        )

    cases = [[case(name, flight) for name in known] for flight in flights]
    found = matrix(cases, model=model, conditions=_conditions(cases, model), without_centroid=apart)
    contents: dict[Path, bytes | str] = {}
    if csv is not None:
        contents[csv] = files.csv_text(found.columns())
    if figure is not None:
        from kaidan.report.matrix_figure import matrix_figure

        contents[figure] = files.figure_bytes(matrix_figure(found), form)
    _put_out(contents, found.as_dict() if as_json else None, lambda: _show_matrix(found))


def _conditions(cases: "list[list[Case]]", model: str) -> str:
    """What holds for all cases, in words."""
    first = cases[0][0]
    directions = {case.direction for row in cases for case in row}
    way = first.direction if len(directions) == 1 else "up or down as the stairs say"
    speed = (
        "constant speed"
        if first.acceleration == 0
        else f"{first.acceleration:g} m/s2 up the stairs"
    )
    ground = "friction not stated" if first.surface is None else first.surface.name
    judged = "whole way" if model == "contact" else "closed form, the regular flight alone"
    return f"{way} {first.facing.replace('-', ' ')}, {speed}, {ground}; {judged}".capitalize()


def _show_matrix(matrix: "Matrix") -> None:
    import shutil
    import sys

    from kaidan.report.matrix import SYMBOLS, WORDS

    echo(matrix.conditions)
    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else 400
    widest = max(map(len, matrix.stairs)) + 24
    at_once = max(1, (width - widest) // 17)
    for first in range(0, len(matrix.robots), at_once):
        shown = range(first, min(first + at_once, len(matrix.robots)))
        rows = []
        for row in matrix.cells:
            line: dict[str, Any] = {
                "stairs": row[0].stairs,
                "angle_deg": row[0].angle_deg,
                "p_m": row[0].nosing_spacing_m,
            }
            for column in shown:
                cell = row[column]
                number = "" if math.isnan(cell.margin_deg) else f" {cell.margin_deg:+.1f}"
                line[str(column)] = f"{SYMBOLS[cell.verdict]} {WORDS[cell.verdict]}{number}"
            rows.append(line)
        echo("")
        heads = {"stairs": "stairs", "angle_deg": "[deg]", "p_m": "p [mm]"}
        for column in shown:
            posture = matrix.cells[0][column].flippers
            heads[str(column)] = matrix.robots[column] + (f" ({posture})" if posture else "")
        echo_table(rows, heads)
    key = ", ".join(f"{SYMBOLS[verdict]} {word}" for verdict, word in WORDS.items())
    echo(f"\n{key} the model. Number: smallest margin [deg] on the worst reading.")
    if matrix.without_centroid:
        echo("No centroid is published, so no margin can be computed:")
    for robot in matrix.without_centroid:
        echo(f"  {robot.name}: {robot.title}, {robot.figures}")


def reproduce(out: Folder = None, formats: Formats = None, as_json: options.AsJson = False) -> None:
    """Reproduce the paper: what its text prints, what kaidan computes, and the difference."""
    from kaidan.errors import InputError
    from kaidan.report import files, reproduction

    contents: dict[Path, bytes | str] = {}
    if formats and out is None:
        raise InputError("--format needs --out FOLDER")
    for form in formats or ():
        if form not in files.FORMATS:
            raise InputError(f"--format {form!r} is not known; known: {', '.join(files.FORMATS)}")
    found = reproduction.as_dict()
    if out is not None:
        for name, picture in _figures().items():
            for form in dict.fromkeys(formats or ("png",)):
                contents[out / f"{name}.{form}"] = files.figure_bytes(picture, form)
        contents[out / "captions.txt"] = "\n\n".join(
            f"{name}: {text}" for name, text in reproduction.captions().items()
        )
        contents[out / "table1.csv"] = files.csv_text(reproduction.columns(reproduction.table_1()))
        contents[out / "printed-computed.csv"] = files.csv_text(
            reproduction.columns(reproduction.comparison())
        )
        contents[out / "reproduction.json"] = files.json_text(found)
        try:
            out.mkdir(parents=True, exist_ok=True)
        except (OSError, ValueError) as error:
            raise InputError(f"{out}: cannot be made: {files.reason(error)}") from None
    _put_out(contents, found if as_json else None, _show_reproduction)
    if out is None and not as_json:
        echo("Figures, captions and tables as files: kaidan reproduce --out FOLDER")


def _figures() -> "dict[str, Figure]":
    """Figures of the paper, by file name."""
    from kaidan.report import reproduction
    from kaidan.report.d_a_figure import d_a_figure
    from kaidan.report.experiment_figure import experiment_figure
    from kaidan.report.margin_figure import margin_figure
    from kaidan.report.triangle_figure import triangle_figure

    curve = reproduction.fig_11()
    return {
        "fig07": d_a_figure(reproduction.fig_7(), reproduction.FIG_7_NOTE),
        "fig10": triangle_figure(reproduction.fig_10()),
        "fig11": margin_figure(curve, reproduction.FIG_11_NOTE),
        "fig13_21": experiment_figure(curve, reproduction.MEASURED, reproduction.corrected()),
    }


def _show_reproduction() -> None:
    from kaidan.report import reproduction

    rows = reproduction.comparison()
    echo(reproduction.PAPER + "\n")

    def number(value: float, unit: str, sign: str = "") -> str:
        digits = 0 if unit == "mm" else 3
        text = "-" if math.isnan(value) else f"{round(value, digits) + 0.0:{sign}.{digits}f}"
        return text.rjust(7)

    echo_table(
        [
            {
                "quantity": row.quantity,
                "unit": row.unit,
                "printed": (row.printed or "-").rjust(7),
                "computed": number(row.computed, row.unit),
                "difference": number(row.difference, row.unit, "+"),
            }
            for row in rows
        ],
        {
            "quantity": "quantity",
            "unit": "unit",
            "printed": "printed",
            "computed": "computed",
            "difference": "difference",
        },
    )
    echo("")
    for row in rows:
        if row.role == "measurement":
            echo(f"{row.quantity}: {row.note}.")
    echo("")
    for text in (*reproduction.statements(), reproduction.NOT_PRINTED):
        echo(text)


def _form(figure: Path | None, csv: Path | None = None) -> str:
    """Format of a figure's file; what cannot be is refused before anything is computed."""
    from kaidan.errors import InputError
    from kaidan.report.files import figure_format

    if figure is not None and figure == csv:
        raise InputError(f"--figure and --csv cannot both be {figure}")
    return "" if figure is None else figure_format(figure)


def _list(values: Any) -> list[Any]:
    """Plain list; None for NaN."""
    return [None if value != value else value for value in values.tolist()]


def _put_out(contents: Mapping[Path, bytes | str], found: Any, show: Any) -> None:
    """Write the files, then print JSON or a page for people, and say which files there are."""
    from kaidan.report.files import json_text, write_all

    write_all(contents)
    if found is not None:
        typer.echo(json_text(found), nl=False)
    else:
        show()
    for path in contents:
        typer.echo(f"wrote {path}", err=found is not None)
