"""``kaidan experiment``: the paper's verification test in MuJoCo, for any robot and spacings."""

import math
import tempfile
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from kaidan.cli import options, physics
from kaidan.cli.tables import echo, echo_table

if TYPE_CHECKING:
    from kaidan.campaign import Condition, Tally, VerificationTest
    from kaidan.physics import TrackModel
    from kaidan.report.verification import Range, Verification

Spacings = Annotated[
    str, typer.Option(help="Nosing spacings, for example 150mm,180mm [those of the paper].")
]
Angles = Annotated[
    str | None,
    typer.Option(
        help="Slopes: 50deg,52deg, or LOW..HIGH/COUNT, for example 44deg..66deg/12; 12 around the "
        "margin of each spacing without."
    ),
]
Trials = Annotated[int, typer.Option(min=1, max=1_000_000, help="A condition.")]
Descent = Annotated[
    bool, typer.Option("--descent", help="Come down too, tail first: theta_M and Eq. (24).")
]
Seed = Annotated[int, typer.Option(min=0, help="Of all start offsets and grousers' phases.")]
StoreFolder = Annotated[
    Path | None,
    typer.Option(
        "--store", metavar="DIR", help="Keep the trials here; what it has is not done again."
    ),
]
Workers = Annotated[
    int | None, typer.Option(min=1, max=1024, help="Processes on this machine [one a processor].")
]
Scheduler = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Dask scheduler whose workers do it: tcp://HOST:8786."),
]
FigureFile = Annotated[
    Path | None,
    typer.Option("--figure", metavar="FILE", help="In the form of Fig. 13: .png, .svg or .pdf."),
]
CsvFile = Annotated[
    Path | None, typer.Option("--csv", metavar="FILE", help="Write a row a condition.")
]


def register(app: typer.Typer) -> None:
    """Add ``experiment`` to the command line."""
    app.command("experiment")(experiment)


def experiment(
    robot: options.RobotName,
    spacings: Spacings = "150mm,180mm,200mm,220mm",
    angles: Angles = None,
    trials: Trials = 5,
    descent: Descent = False,
    track: physics.Track = "smooth-belt",
    stiffness: physics.Stiffness = None,
    grouser_height: physics.GrouserHeight = None,
    grouser_spacing: physics.GrouserSpacing = None,
    shoes: physics.Shoes = None,
    speed: physics.Speed = "0.1m/s",
    friction: Annotated[str, typer.Option(help="Of the track on the nosings.")] = "3",
    ground: physics.Ground = "steps",
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    override: options.Override = None,
    seed: Seed = 0,
    store: StoreFolder = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    figure: FigureFile = None,
    csv: CsvFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Test in MuJoCo at which slopes ROBOT falls: the paper's verification test.

    Exit code: 0 done, 2 bad input, 3 no trial says anything about the robot.
    """
    from kaidan.campaign import carry_out, read_batches
    from kaidan.errors import InputError
    from kaidan.report import files
    from kaidan.report.verification import verification

    form = None if figure is None else files.figure_format(figure)
    if workers is not None and scheduler is not None:
        raise InputError("give either --workers or --scheduler, not both")
    plan = _plan(
        robot, spacings, angles, trials, descent, physics.track_model(
            track, stiffness, grouser_height, grouser_spacing, shoes
        ), speed, friction, ground, flippers, payload, override, seed,
    )  # fmt: skip
    with ExitStack() as stack:
        folder = store or Path(stack.enter_context(tempfile.TemporaryDirectory()))
        try:
            tally = carry_out(plan, folder, workers=workers, scheduler=scheduler, progress=True)
        except KeyboardInterrupt:
            kept = "" if store is None else f"; the same command goes on with {store}"
            typer.echo(f"kaidan: broken off{kept}", err=True)
            raise typer.Exit(130) from None
        columns = ("id", "outcome", "largest_extra_deg")
        batches = read_batches(folder, columns)
        found = verification(plan, (row for batch in batches for row in batch.to_pylist()))
    contents: dict[Path, bytes | str] = {}
    if csv is not None:
        contents[csv] = files.csv_text(found.columns())
    if figure is not None and form is not None:
        from kaidan.report.verification_figure import verification_figure

        contents[figure] = files.figure_bytes(verification_figure(found), form)
    files.write_all(contents)
    if as_json:
        typer.echo(files.json_text(found.as_dict()), nl=False)
    else:
        _show(found, tally)
    for path in contents:
        typer.echo(f"wrote {path}", err=as_json)
    raise typer.Exit(found.exit_code)


def _plan(
    robot: str,
    spacings: str,
    angles: str | None,
    trials: int,
    descent: bool,
    track: "TrackModel",
    speed: str,
    friction: str,
    ground: str,
    flippers: str,
    payload: list[str] | None,
    override: list[str] | None,
    seed: int,
) -> "VerificationTest":
    """Experiment from the texts of the options."""
    from kaidan.campaign import Condition, VerificationTest
    from kaidan.report.verification import usual_conditions
    from kaidan.stairs import Stairs
    from kaidan.units import parse

    distances = list(
        dict.fromkeys(parse(text, "length", option="--spacings") for text in spacings.split(","))
    )
    case = options.case_from(
        robot,
        Stairs.inclined(angle=0.5, nosing_spacing=0.15),  # plays no part
        friction=friction,
        speed=speed,
        flippers=flippers,
        payload=payload,
        override=override,
    )
    assert case.surface is not None
    assert case.speed is not None
    plan = VerificationTest(
        robot=case.robot,
        posture=case.posture,
        payload=case.payload,
        conditions=(Condition(nosing_spacing=distances[0], angle=0.5),),
        trials=trials,
        track=track,
        friction=case.surface.friction_low,
        speed=case.speed,
        ground=ground,
        seed=seed,
    )
    if angles is None:
        conditions = usual_conditions(plan, distances, descent=descent)
    else:
        conditions = tuple(_conditions(distances, _angles(angles), descent))
    whole = plan.model_dump() | {"conditions": [each.model_dump() for each in conditions]}
    plan = VerificationTest.model_validate(whole)
    for condition in plan.conditions:
        plan.spec(condition, 0)  # refuses what cannot be tried before anything is begun
    return plan


def _conditions(distances: list[float], slopes: list[float], descent: bool) -> "list[Condition]":
    from kaidan.campaign import Condition

    directions = ("up", "down") if descent else ("up",)
    return [
        Condition(nosing_spacing=p, angle=angle, direction=direction)
        for p in distances
        for direction in directions
        for angle in slopes
    ]


def _angles(text: str) -> list[float]:
    """Slopes [rad] of a list with ranges, each once, from gentle to steep."""
    from kaidan.errors import InputError
    from kaidan.units import parse

    found: set[float] = set()
    for part in text.split(","):
        low, dots, rest = part.partition("..")
        if not dots:
            found.add(parse(part, "angle", option="--angles"))
            continue
        high, _, count = rest.partition("/")
        if not count.strip().isdecimal() or not 2 <= int(count) <= 1000:
            raise InputError(
                f"--angles {part!r}: write LOW..HIGH/COUNT with a count of 2 to 1000, for example "
                "44deg..66deg/12"
            )
        first, last = (parse(end, "angle", option="--angles") for end in (low, high))
        if not first < last:
            raise InputError(f"--angles {part!r}: LOW is not less than HIGH")
        steps = int(count) - 1
        found |= {round(first + (last - first) * k / steps, 9) for k in range(steps + 1)}
    for angle in found:
        if not 0.01 <= angle <= 1.5533:
            raise InputError(f"--angles: {math.degrees(angle):g} deg is not within 1 to 89 deg")
    return sorted(found)


def _show(found: "Verification", tally: "Tally") -> None:
    plan = found.plan
    echo(
        f"{plan.robot.name}: {len(plan)} trials, {tally.found} of them in the store before; "
        f"{plan.track.kind}, {plan.speed:g} m/s, seed {plan.seed}"
    )
    echo(f"  {found.version}")
    echo("")
    echo_table(
        [
            {
                "p": f"{1e3 * each.nosing_spacing:g}",
                "closed": _number(each.closed_form_deg),
                "contact": _number(each.contact_deg),
                "climbed": _number(each.climbed_up_to_deg),
                "fell": _number(each.fell_from_deg),
                "d": _range(each.theta_d),
                "M": _range(each.theta_M),
                "corrected": _range(each.corrected),
            }
            for each in found.spacings
        ],
        {
            "p": "p [mm]",
            "closed": "closed form [deg]",
            "contact": "contact [deg]",
            "climbed": "all climbed up to",
            "fell": "all fell from",
            "d": "theta_d",
            "M": "theta_M",
            "corrected": "Eq. (24)",
        },
    )
    echo("")
    for each in found.spacings:
        for name, counts in (("up", each.up), ("down", each.down)):
            if counts:
                told = "  ".join(
                    f"{count.angle_deg:g}:{_symbol(count.symbol, count.fell, count.others)}"
                    for count in counts
                )
                echo(f"  {1e3 * each.nosing_spacing:g} mm {name:<5} {told}")
    echo("")
    echo("  o climbed every time, x fell every time, a number: fell so often; ? did neither")
    outside = {outcome for count in found.counts for outcome in count.others}
    if outside:
        echo(f"  ? stands for: {', '.join(sorted(outside))}")


def _symbol(symbol: str, fell: int, others: dict[str, int]) -> str:
    if symbol == "square":
        return f"{sum(others.values())}?"
    return {"circle": "o", "cross": "x"}.get(symbol, str(fell))


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.1f}"


def _range(value: "Range | None") -> str:
    return "-" if value is None else f"{value.mean:.1f} ({value.low:.1f} to {value.high:.1f})"
