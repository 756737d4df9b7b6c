"""``kaidan measure``: a robot's centroid and the steps of stairs, from scales, tape and level."""

from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from kaidan.cli import options, output
from kaidan.cli.new import say_next
from kaidan.text import guide

if TYPE_CHECKING:
    from kaidan.sheet import Sheet

group = typer.Typer(
    name="measure",
    help="Measure a robot or stairs with scales, tape and level.",
    no_args_is_help=True,
)  # fmt: skip


class End(StrEnum):
    """End of the robot."""

    REAR = "rear"
    FRONT = "front"


class Way(StrEnum):
    """How it tips."""

    END = "end"
    RAMP = "ramp"


SheetFile = Annotated[
    Path | None,
    typer.Argument(
        metavar="FILE.toml", help="Sheet to write, or to complete if it is there.",
        show_default=False,
    ),
]  # fmt: skip
Length = Annotated[str | None, typer.Option("--length", help="L, flat underside, e.g. 620mm.")]
FrontScale = Annotated[str | None, typer.Option(help="Front scale, level, for example 14.2kg.")]
RearScale = Annotated[str | None, typer.Option(help="Rear scale, level.")]
Balance = Annotated[
    str | None, typer.Option(help="Instead: C_L, balance point behind the front tip of the flat.")
]
Mass = Annotated[str | None, typer.Option(help="Mass, where one scale weighed all of it.")]
Slope = Annotated[
    str | None, typer.Option(help="Inclination at the second weighing, nose up, e.g. 20deg.")
]
FrontOnSlope = Annotated[str | None, typer.Option(help="Front scale on the slope.")]
RearOnSlope = Annotated[str | None, typer.Option(help="Rear scale on the slope.")]
TipsAt = Annotated[
    str | None, typer.Option(help="Instead: inclination at which it balances or tips, e.g. 65deg.")
]
Over = Annotated[End, typer.Option(help="End on which it balances or over which it tips.")]
On = Annotated[
    Way, typer.Option(help="Balanced by hand on its round end, or tipped on a growing ramp.")
]
FrontRadius = Annotated[
    str | None, typer.Option(help="R, radius of the front end, belt included, e.g. 90mm.")
]
RearRadius = Annotated[str | None, typer.Option(help="R of the rear end.")]
FrontInset = Annotated[str, typer.Option(help="Front support inward of the tip of the flat.")]
RearInset = Annotated[str, typer.Option(help="Rear support inward of the tip of the flat.")]
ScaleDoubt = Annotated[str, typer.Option("--u-scale", help="Standard uncertainty of a scale.")]
TapeDoubt = Annotated[str, typer.Option("--u-tape", help="Standard uncertainty of the tape.")]
AngleDoubt = Annotated[str, typer.Option("--u-angle", help="Standard uncertainty of the level.")]
TotalRise = Annotated[str, typer.Option(help="Lower to upper floor, for example 2.72m.")]
TotalGoing = Annotated[
    str, typer.Option(help="First to last nosing, measured level, for example 4.20m.")
]
Risers = Annotated[
    int, typer.Option(help="Number of risers, the one up to the upper floor included.")
]
FirstRise = Annotated[str | None, typer.Option(help="First riser, where it differs.")]
LastRise = Annotated[str | None, typer.Option(help="Last riser, where it differs.")]
RiseChecks = Annotated[
    list[str] | None, typer.Option("--rise", help="Rise of a single step; give three or more.")
]
GoingChecks = Annotated[
    list[str] | None, typer.Option("--going", help="Going of a single step; give three or more.")
]
Clear = Annotated[str | None, typer.Option("--width", help="Clear width of the flight.")]
LowerTurn = Annotated[
    str | None, typer.Option("--lower-turn", help="Turn on the lower landing: quarter or half.")
]
LowerLanding = Annotated[
    str | None, typer.Option("--lower-landing", help="Its clear length, along the flight.")
]
LowerAcross = Annotated[
    str | None, typer.Option("--lower-landing-width", help="Its clear width, across the flight.")
]
LowerPassage = Annotated[
    str | None,
    typer.Option(
        "--lower-passage", help="Where a level passage lies beyond the turn: its clear width."
    ),
]
LowerLeaf = Annotated[
    str | None, typer.Option("--lower-leaf", help="Leaf of a door opposite that opens onto it.")
]
UpperTurn = Annotated[
    str | None, typer.Option("--upper-turn", help="Turn on the upper landing: quarter or half.")
]
UpperLanding = Annotated[
    str | None, typer.Option("--upper-landing", help="Its clear length, along the flight.")
]
UpperAcross = Annotated[
    str | None, typer.Option("--upper-landing-width", help="Its clear width, across the flight.")
]
UpperPassage = Annotated[
    str | None,
    typer.Option(
        "--upper-passage", help="Where a level passage lies beyond the turn: its clear width."
    ),
]
UpperLeaf = Annotated[
    str | None, typer.Option("--upper-leaf", help="Leaf of a door opposite that opens onto it.")
]


def register(app: typer.Typer) -> None:
    """Add ``measure`` to the command line."""
    app.add_typer(group)


@group.command("robot", help=guide.ROBOT)
def robot(
    file: SheetFile = None,
    length: Length = None,
    front_scale: FrontScale = None,
    rear_scale: RearScale = None,
    balance: Balance = None,
    mass: Mass = None,
    slope: Slope = None,
    front_on_slope: FrontOnSlope = None,
    rear_on_slope: RearOnSlope = None,
    tips_at: TipsAt = None,
    over: Over = End.REAR,
    on: On = Way.END,
    front_radius: FrontRadius = None,
    rear_radius: RearRadius = None,
    front_inset: FrontInset = "0mm",
    rear_inset: RearInset = "0mm",
    u_scale: ScaleDoubt = "50g",
    u_tape: TapeDoubt = "1mm",
    u_angle: AngleDoubt = "0.2deg",
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Find mass, L, C_L and C_N of a robot; `kaidan.text.guide` has the help."""
    from kaidan.errors import InputError
    from kaidan.verbs.measure_robot import RobotMeasurement, measure_robot

    pictures = output.checked(figure, file)

    def draw(found: "RobotMeasurement | None") -> "output.Figure":
        from kaidan.figures.weighing_figure import weighing_figure

        return weighing_figure(found)

    if length is None:
        if pictures and file is None:
            output.put_text("The procedure:", output.drawn(pictures, lambda: draw(None)))
            return
        raise InputError("--length is missing: the flat underside L, for example 620mm")
    found = measure_robot(
        name="robot" if file is None else file.stem, flat_length=length,
        front_scale=front_scale, rear_scale=rear_scale, balance=balance, mass=mass, slope=slope,
        front_on_slope=front_on_slope, rear_on_slope=rear_on_slope, tips_at=tips_at,
        over=over.value, on=on.value, front_radius=front_radius, rear_radius=rear_radius,
        front_inset=front_inset, rear_inset=rear_inset,
        u_scale=u_scale, u_tape=u_tape, u_angle=u_angle,
    )  # fmt: skip
    files = output.drawn(pictures, lambda: draw(found))
    if file is None:
        output.put_out(found, files, as_json=as_json)
        return
    from kaidan.robot import Robot

    files |= {file: _sheet(file, Robot, found.figures)}
    output.put_out(found, files, as_json=as_json)
    say_next(file, Robot, aside=as_json)


@group.command("stairs", help=guide.STAIRS)
def stairs(
    total_rise: TotalRise,
    total_going: TotalGoing,
    risers: Risers,
    file: SheetFile = None,
    first_rise: FirstRise = None,
    last_rise: LastRise = None,
    rise: RiseChecks = None,
    going: GoingChecks = None,
    width: Clear = None,
    lower_turn: LowerTurn = None,
    lower_landing: LowerLanding = None,
    lower_landing_width: LowerAcross = None,
    lower_passage: LowerPassage = None,
    lower_leaf: LowerLeaf = None,
    upper_turn: UpperTurn = None,
    upper_landing: UpperLanding = None,
    upper_landing_width: UpperAcross = None,
    upper_passage: UpperPassage = None,
    upper_leaf: UpperLeaf = None,
    u_tape: TapeDoubt = "2mm",
    as_json: options.AsJson = False,
) -> None:
    """Find rise, going, slope and spacing of stairs; `kaidan.text.guide` has the help."""
    from kaidan.terrain.stairs import Stairs
    from kaidan.verbs.measure_stairs import measure_stairs

    found = measure_stairs(
        name="stairs" if file is None else file.stem,
        total_rise=total_rise, total_going=total_going, risers=risers,
        first_rise=first_rise, last_rise=last_rise, rises=rise or (), goings=going or (),
        width=width,
        lower_turn=lower_turn, lower_landing=lower_landing, lower_landing_width=lower_landing_width,
        lower_passage=lower_passage, lower_leaf=lower_leaf,
        upper_turn=upper_turn, upper_landing=upper_landing, upper_landing_width=upper_landing_width,
        upper_passage=upper_passage, upper_leaf=upper_leaf,
        u_tape=u_tape,
    )  # fmt: skip
    files: output.Contents = {}
    if file is not None:
        files = {file: _sheet(file, Stairs, found.figures)}
    output.put_out(found, files, as_json=as_json)
    if file is not None:
        say_next(file, Stairs, aside=as_json)


def _sheet(file: Path, kind: "type[Sheet]", figures: Mapping[str, Any]) -> str:
    """Text of a sheet with the figures in it: of the file that is there, or of a blank one."""
    from kaidan.catalog import text_of
    from kaidan.catalog.completing import completed
    from kaidan.catalog.template import blank_toml
    from kaidan.cli.new import checked_sheet_file, title_of
    from kaidan.errors import short

    checked_sheet_file(file, force=True)
    if file.exists():
        text = text_of(file)
    else:
        text = blank_toml(kind, name=file.stem, title=title_of(kind.label, file.name))
    return completed(text, figures, origin=short(file))
