"""``kaidan lab experiment``: the paper's verification test in MuJoCo, for any robot."""

from pathlib import Path
from typing import Annotated

import typer

from kaidan.cli import options, output
from kaidan.lab.cli import physics

Spacings = Annotated[
    str | None,
    typer.Option(
        help="Nosing spacings, for example 150mm,180mm [those of the paper; of a protocol, the "
        "same shares of the robot's L]."
    ),
]
Angles = Annotated[
    str | None,
    typer.Option(
        help="Slopes: 50deg,52deg, or LOW..HIGH/COUNT, for example 44deg..66deg/12; 12 around the "
        "margin of each spacing without."
    ),
]
Trials = Annotated[int, typer.Option(min=1, max=1_000_000, help="Trials for each condition.")]
ProtocolFile = Annotated[
    Path | None,
    typer.Option(
        "--protocol",
        metavar="FILE",
        help="Try nothing: write how to do it on a real robot, with the trials that tell most, and "
        "beside it the sheet to fill in, FILE.toml.",
    ),
]
Descent = Annotated[
    bool, typer.Option("--descent", help="Come down too, tail first: theta_M and Eq. (24).")
]
Seed = Annotated[
    int, typer.Option(min=0, help="Seed of the start offsets and the grousers' phases.")
]
Nosings = Annotated[
    int, typer.Option(min=1, max=1000, help="Nosings to be passed in a trial, each at its phase.")
]
StoreFolder = Annotated[
    Path | None,
    typer.Option(
        "--store",
        metavar="DIR",
        help="Folder that keeps the trials; those it has are not repeated.",
    ),
]
Workers = Annotated[
    int | None, typer.Option(min=1, max=1024, help="Processes on this machine [one a processor].")
]
Track = Annotated[
    str | None,
    typer.Option(
        help="Model: smooth-belt, yielding-belt, sprung-noses (stairs that yield), driven-grousers "
        "or shoe-chain [yielding-belt, as the sheet says or as fitted to the paper's text]."
    ),
]
Friction = Annotated[
    str | None,
    typer.Option(
        help="Friction of the track on the nosings [3, which isolates tipping; grousers 0.8]."
    ),
]
Scheduler = Annotated[
    str | None,
    typer.Option(
        metavar="ADDRESS",
        help="Dask scheduler whose workers do it: tcp://HOST:8786. Only one you trust: Dask sends "
        "pickles, which run code.",
    ),
]


def register(app: typer.Typer) -> None:
    """Add ``experiment`` to the command line."""
    app.command("experiment")(experiment)


def experiment(
    robot: options.RobotName,
    spacings: Spacings = None,
    angles: Angles = None,
    trials: Trials = 5,
    descent: Descent = False,
    track: Track = None,
    stiffness: physics.Stiffness = None,
    shear_ratio: physics.ShearRatio = None,
    grouser_height: physics.GrouserHeight = None,
    grouser_spacing: physics.GrouserSpacing = None,
    shoes: physics.Shoes = None,
    speed: physics.Speed = "0.1m/s",
    friction: Friction = None,
    ground: physics.Ground = "steps",
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    override: options.Override = None,
    seed: Seed = 0,
    nosings: Nosings = 10,
    protocol: ProtocolFile = None,
    store: StoreFolder = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    figure: output.FigureFiles = None,
    csv: output.CsvFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Test in MuJoCo at which slopes ROBOT falls: the paper's verification test.

    Exit code: 0 done, 2 bad input, 3 no trial says anything about the robot.
    """
    from kaidan import files
    from kaidan.errors import InputError
    from kaidan.lab.verification.experiment import PAPER, carried_out, plan_of

    pictures = output.checked(figure, csv)
    if protocol is not None:
        write_protocol(robot, protocol, spacings, trials, override)
        return
    if workers is not None and scheduler is not None:
        raise InputError("give either --workers or --scheduler, not both")
    given = (stiffness, shear_ratio, grouser_height, grouser_spacing, shoes)
    plan = plan_of(
        robot,
        spacings=PAPER if spacings is None else spacings,
        angles=angles,
        trials=trials,
        descent=descent,
        seed=seed,
        nosings=nosings,
        track=None
        if track is None and not any(given)
        else physics.track_model(track or "yielding-belt", *given),
        speed=speed,
        friction=friction,
        ground=ground,
        flippers=flippers,
        payload=payload,
        override=override,
    )
    try:
        done = carried_out(plan, store, workers=workers, scheduler=scheduler, progress=True)
    except KeyboardInterrupt:
        kept = "" if store is None else f"; the same command goes on with {store}"
        typer.echo(f"kaidan: broken off{kept}", err=True)
        raise typer.Exit(130) from None
    found = done.verification
    contents: output.Contents = {}
    if csv is not None:
        contents[csv] = files.csv_text(found.columns())

    def draw() -> "output.Figure":
        from kaidan.lab.verification.figure import verification_figure

        return verification_figure(found)

    contents |= output.drawn(pictures, draw)
    if done.found and not as_json:
        typer.echo(f"{done.found} of {len(plan)} trials were in the store already.")
    output.put_out(found, contents, as_json=as_json)
    raise typer.Exit(found.exit_code)


def write_protocol(
    robot: str, file: Path, spacings: str | None, trials: int, override: list[str] | None
) -> None:
    """Write the protocol and the sheet beside it."""
    from kaidan.cli.new import checked_sheet_file
    from kaidan.errors import InputError
    from kaidan.files import write_all
    from kaidan.lab.rig.protocol import protocol_of
    from kaidan.spelling import robot_of
    from kaidan.units import value_of

    if file.suffix.lower() != ".md":
        raise InputError(f"{file}: a protocol is Markdown; write {file.stem}.md")
    sheet = file.with_suffix(".toml")
    checked_sheet_file(sheet, force=False)
    given = None
    if spacings is not None:
        given = [value_of(each, "length", option="--spacings") for each in spacings.split(",")]
    made = protocol_of(robot, robot_of(robot, override), spacings=given, trials=trials)
    write_all({file: made.page, sheet: made.sheet})
    typer.echo(f"wrote {file} and {sheet}: fill it in, then kaidan lab calibrate {sheet}")
