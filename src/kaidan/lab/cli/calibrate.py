"""``kaidan lab calibrate``: the physics fitted to the paper's text and judged blind."""

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from kaidan.cli import options, output
from kaidan.lab.cli.experiment import Nosings, Seed, StoreFolder, Workers
from kaidan.lab.cli.rig import FileOrStudy, rig

if TYPE_CHECKING:
    from kaidan.lab.calibration.bench import Bench

group = typer.Typer(
    name="calibrate",
    cls=FileOrStudy,
    help="Fit the physics to the paper's text, judge it blind on the rest, vary the grousers; or "
    "fit a real robot: kaidan lab calibrate RIG.toml.",
    no_args_is_help=True,
)

RobotName = Annotated[
    str,
    typer.Argument(metavar="[ROBOT]", help="The paper's, or own figures for it (TOML file)."),
]
Trials = Annotated[
    int, typer.Option(min=2, max=1000, help="Trials for each condition; the paper made 5.")
]
Judged = Annotated[
    int, typer.Option(min=0, max=50, help="Fits that predict blind, the likeliest first.")
]
Step = Annotated[str, typer.Option(help="Between the slopes at which margins are looked for.")]


def register(app: typer.Typer) -> None:
    """Add ``calibrate`` to the command line."""
    group.command("rig")(rig)
    app.add_typer(group)


@group.command("compliance")
def compliance(
    robot: RobotName = "kenaf",
    stiffness: Annotated[
        str, typer.Option(help="Nosing stiffness values to try, for example 16kN/m,32kN/m.")
    ] = "8,11,16,22,32,45,64,90,128kN/m",
    end_radius: Annotated[
        str,
        typer.Option(help="Radii of the track's ends to try; the best one counts."),
    ] = "5,10,20,30,45,65mm",
    ground: Annotated[
        str,
        typer.Option(
            help="Ground to try: steps with treads, noses (a rig of nosings); the best counts."
        ),
    ] = "steps,noses",
    trials: Trials = 5,
    seed: Seed = 0,
    judged: Judged = 9,
    step: Step = "2deg",
    store: StoreFolder = None,
    workers: Workers = None,
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Fit the stiffness of sprung nosings to theta_d and to the fall zone at 150 mm.

    Exit code: 0 done, whatever is reproduced; 2 bad input.
    """
    from kaidan.errors import InputError, shown
    from kaidan.lab.calibration import fitting

    stiff = _list(stiffness, "stiffness", "--stiffness")
    radii = _list(end_radius, "length", "--end-radius")
    grounds = [text.strip() for text in ground.split(",")]
    for text in grounds:
        if text not in fitting.GROUND:
            raise InputError(f"--ground {shown(text)} is not known; known: steps, noses")
    from kaidan.robot import Robot

    sheet = Robot.named(robot)
    grid = fitting.compliance_grid(sheet, stiff, radii, grounds)
    _calibrate("sprung-noses", sheet.name, grid, trials, seed, judged, step, store, workers,
               figure, as_json)  # fmt: skip


@group.command("yielding")
def yielding(
    robot: RobotName = "kenaf",
    points: Annotated[
        int, typer.Option(min=60, max=100_000, help="Runs of the design, half of them with treads.")
    ] = 256,
    trials: Annotated[int, typer.Option(min=2, max=1000, help="Trials for each condition.")] = 2,
    seed: Seed = 0,
    store: StoreFolder = None,
    workers: Workers = None,
    figure: output.FigureFiles = None,
    as_json: options.AsJson = False,
) -> None:
    """Fit the yielding track to theta_d and the fall zone; predict the rest blind, with intervals.

    About 110 trials a point of 0.03 s each, then some minutes for emulator and sampler.

    Exit code: 0 done, whatever is reproduced; 2 bad input.
    """
    from kaidan.lab.calibration.yielding import calibrate_yielding
    from kaidan.robot import Robot

    pictures = output.checked(figure)
    sheet = Robot.named(robot)
    with _bench(store, workers, seed, trials) as bench:
        found = calibrate_yielding(bench, sheet, points=points)

    def draw() -> "output.Figure":
        from kaidan.lab.calibration.region_figure import region_figure

        return region_figure(found)

    output.put_out(found, output.drawn(pictures, draw), as_json=as_json)


@group.command("grousers")
def grousers(
    robot: RobotName = "kenaf",
    drawn: Annotated[int, typer.Option(min=1, max=1_000_000, help="Tracks drawn.")] = 4096,
    tried: Annotated[
        int, typer.Option(min=1, max=100_000, help="Tracks tried at most, of those left.")
    ] = 256,
    trials: Trials = 2,
    nosings: Nosings = 10,
    seed: Seed = 0,
    store: StoreFolder = None,
    workers: Workers = None,
    as_json: options.AsJson = False,
) -> None:
    """Seek a track with grousers on rubber that meets all that the paper's text says.

    Closed forms leave out what they refute; the rest is tried, some minutes on two quiet cores.

    Exit code: 0 done, whatever is found; 2 bad input.
    """
    from kaidan.lab.calibration.search import search
    from kaidan.robot import Robot

    sheet = Robot.named(robot)
    with _bench(store, workers, seed, trials, nosings) as bench:
        found = search(bench, sheet, count=drawn, tried=tried)
    output.put_out(found, {}, as_json=as_json)


@group.command("effects")
def effects(
    robot: RobotName = "kenaf",
    height: Annotated[str, typer.Option(help="Grouser heights to try.")] = "3,5,7,10mm",
    spacing: Annotated[str, typer.Option(help="Grouser spacings to try.")] = "20,28,33,50mm",
    stiffness: Annotated[
        str, typer.Option(help="Stiffness values of both belts at a contact to try.")
    ] = "20,50,100,400kN/m",
    friction: Annotated[str, typer.Option(help="Frictions to try.")] = "0.8,1.2,2,3",
    about: Annotated[
        str, typer.Option(help="Height, spacing, stiffness and friction while another is varied.")
    ] = "7mm,33mm,100kN/m,2",
    nosing_spacing: Annotated[str, typer.Option(help="Nosing to nosing.")] = "150mm",
    trials: Trials = 3,
    nosings: Nosings = 10,
    seed: Seed = 0,
    step: Step = "2deg",
    store: StoreFolder = None,
    workers: Workers = None,
    figure: output.FigureFiles = None,
    csv: output.CsvFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Vary grousers on rubber and their friction, and tell theta_M: the paper's open question.

    Exit code: 0 done, 2 bad input.
    """
    from kaidan import files
    from kaidan.errors import InputError, shown
    from kaidan.lab.calibration.effects import effects as found_by
    from kaidan.units import parse

    pictures = output.checked(figure, csv)
    parts = about.split(",")
    if len(parts) != 4:
        raise InputError(f"--about {shown(about)}: write HEIGHT,SPACING,STIFFNESS,FRICTION")
    kinds = ("length", "length", "stiffness", "number")
    base = [
        round(parse(text.strip(), kind, option="--about"), 9)
        for text, kind in zip(parts, kinds, strict=True)
    ]
    from kaidan.robot import Robot

    sheet = Robot.named(robot)
    options_of: dict[str, Any] = {
        "base": dict(zip(("height", "spacing", "stiffness", "friction"), base, strict=True)),
        "varied": {
            "height": _list(height, "length", "--height"),
            "spacing": _list(spacing, "length", "--spacing"),
            "stiffness": _list(stiffness, "stiffness", "--stiffness"),
            "friction": _list(friction, "number", "--friction"),
        },
        "nosing_spacing": parse(nosing_spacing, "length", option="--nosing-spacing"),
        "step": _step(step),
    }
    with _bench(store, workers, seed, trials, nosings) as bench:
        found = found_by(bench, sheet, **options_of)
    contents: output.Contents = {}
    if csv is not None:
        contents[csv] = files.csv_text(found.columns())

    def draw() -> "output.Figure":
        from kaidan.lab.calibration.figure import effects_figure

        return effects_figure(found)

    output.put_out(found, contents | output.drawn(pictures, draw), as_json=as_json)


def _calibrate(
    kind: str,
    robot: str,
    grid: Any,
    trials: int,
    seed: int,
    judged: int,
    step: str,
    store: Path | None,
    workers: int | None,
    figure: output.FigureFiles,
    as_json: bool,
) -> None:
    from kaidan.lab.calibration.report import calibrate

    pictures = output.checked(figure)
    width = _step(step)
    with _bench(store, workers, seed, trials) as bench:
        found = calibrate(bench, robot, kind, grid, judged=judged, step=width)

    def draw() -> "output.Figure":
        from kaidan.lab.calibration.figure import calibration_figure

        return calibration_figure(found)

    output.put_out(found, output.drawn(pictures, draw), as_json=as_json)


@group.command("theta-m")
def theta_m(
    robot: RobotName = "kenaf",
    criterion: Annotated[
        float, typer.Option(min=2.0, max=80.0, help="Beyond the stairs, counted as a fall [deg].")
    ] = 15.0,
    trials: Trials = 3,
    seed: Seed = 0,
    step: Step = "1deg",
    store: StoreFolder = None,
    workers: Workers = None,
    as_json: options.AsJson = False,
) -> None:
    """Vary eleven things that the paper does not state, and tell their effects on theta_M.

    24 runs of about 170 trials, two minutes on two quiet cores. Exit code: 0 done, 2 bad input.
    """
    from kaidan.lab.calibration.theta_m import theta_m_study
    from kaidan.robot import Robot

    sheet = Robot.named(robot)
    with _bench(store, workers, seed, trials) as bench:
        found = theta_m_study(bench, sheet, criterion=criterion, step=_step(step))
    output.put_out(found, {}, as_json=as_json)


@group.command("engagement")
def engagement(
    trials: Annotated[int, typer.Option(min=1, max=1000, help="A cell.")] = 2,
    seed: Seed = 0,
    store: StoreFolder = None,
    workers: Workers = None,
    as_json: options.AsJson = False,
) -> None:
    """Try driven grousers on slopes and frictions against the rule of traction.

    168 trials of some seconds each. Exit code: 0 done, 2 bad input.
    """
    from kaidan.lab.calibration.engagement import engagement as found_by
    from kaidan.lab.calibration.engagement import in_store

    with _kept(store) as folder:
        runner = in_store(folder, workers=workers, progress=True)
        found = found_by(runner, trials=trials, seed=seed)
    output.put_out(found, {}, as_json=as_json)


@contextmanager
def _kept(store: Path | None) -> "Iterator[Path]":
    with tempfile.TemporaryDirectory() as passing:
        try:
            yield store or Path(passing) / "store"
        except KeyboardInterrupt:
            kept = "" if store is None else f"; the same command goes on with {store}"
            typer.echo(f"kaidan: broken off{kept}", err=True)
            raise typer.Exit(130) from None


@contextmanager
def _bench(
    store: Path | None, workers: int | None, seed: int, trials: int, nosings: int = 2
) -> "Iterator[Bench]":
    from kaidan.lab.calibration.bench import Bench, in_store

    with _kept(store) as folder:
        runner = in_store(folder, workers=workers, progress=True)
        yield Bench(runner, seed=seed, trials=trials, nosings=nosings)


def _list(text: str, kind: str, option: str) -> list[float]:
    """Quantities of a list, each once, increasing; the last one's unit is that of bare numbers."""
    from kaidan.units import parse

    parts = [part.strip() for part in text.split(",")]
    unit = parts[-1].lstrip("+-0123456789.")
    whole = [part if part.lstrip("+-0123456789.") else part + unit for part in parts]
    # rounded, so that 17.5mm is the 0.0175 of the default grids and finds its trials in a store
    return sorted({round(parse(part, kind, option=option), 9) for part in whole})


def _step(text: str) -> float:
    import math

    from kaidan.errors import InputError, shown
    from kaidan.units import parse

    step = math.degrees(parse(text, "angle", option="--step"))
    if not 0.1 <= step <= 5.0:
        raise InputError(f"--step {shown(text)} is not within 0.1 to 5 deg")
    return step
