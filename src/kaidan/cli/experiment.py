"""``kaidan experiment``: the paper's verification test in MuJoCo, for any robot and spacings."""

from pathlib import Path
from typing import Annotated

import typer

from kaidan.cli import options, output, physics

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
Friction = Annotated[
    str | None,
    typer.Option(help="Of the track on the nosings [3, which isolates tipping; grousers 0.8]."),
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
    spacings: Spacings = "150mm,180mm,200mm,220mm",
    angles: Angles = None,
    trials: Trials = 5,
    descent: Descent = False,
    track: physics.Track = "smooth-belt",
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
    from kaidan.studies.experiment import carried_out, plan_of

    pictures = output.checked(figure, csv)
    if workers is not None and scheduler is not None:
        raise InputError("give either --workers or --scheduler, not both")
    plan = plan_of(
        robot,
        spacings=spacings,
        angles=angles,
        trials=trials,
        descent=descent,
        seed=seed,
        track=physics.track_model(
            track, stiffness, shear_ratio, grouser_height, grouser_spacing, shoes
        ),
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
        from kaidan.figures.verification_figure import verification_figure

        return verification_figure(found)

    contents |= output.drawn(pictures, draw)
    if done.found and not as_json:
        typer.echo(f"{done.found} of {len(plan)} trials were in the store already.")
    output.put_out(found, contents, as_json=as_json)
    raise typer.Exit(found.exit_code)
