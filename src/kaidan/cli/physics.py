"""``kaidan physics``: a trial in MuJoCo, and its model for MuJoCo's own viewer."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from kaidan.cli import options
from kaidan.cli.tables import echo

if TYPE_CHECKING:
    from kaidan.physics import TrackModel, TrialResult, TrialSpec

group = typer.Typer(
    name="physics", help="A trial in MuJoCo, and its model.", no_args_is_help=True
)  # fmt: skip

Names = Annotated[
    list[str],
    typer.Argument(
        metavar="[STAIRS] FILE.xml",
        help="Catalogue name or TOML file of the stairs, unless options give their shape; and the "
        "file to write.",
    ),
]
Track = Annotated[
    str,
    typer.Option(help="Model: smooth-belt, sprung-noses, driven-grousers or shoe-chain."),
]
Stiffness = Annotated[
    str | None,
    typer.Option(help="Of a nosing (sprung-noses) or a grouser (driven-grousers): 30kN/m."),
]
GrouserHeight = Annotated[str | None, typer.Option(help="Above the belt, for example 10mm.")]
GrouserSpacing = Annotated[str | None, typer.Option(help="Along the belt, for example 33mm.")]
Shoes = Annotated[int | None, typer.Option(help="Number of shoes of the chain [40].")]
Begin = Annotated[
    str, typer.Option(help="Where it begins: flight (as in the paper) or landing (the whole way).")
]
Releases = Annotated[
    int, typer.Option(help="Nosings that the downhill end passes, beginning on the flight.")
]
Ground = Annotated[str, typer.Option(help="steps, or noses: a rig of nosings and nothing else.")]
Dimensions = Annotated[
    int, typer.Option(help="2: in the plane; 3: two tracks in space (smooth-belt).")
]
LateralOffset = Annotated[
    str, typer.Option(help="Centroid left of the robot's middle, for example 20mm (3-D).")
]
StartOffset = Annotated[
    float | None, typer.Option(help="Share of a spacing by which it overhangs at the start.")
]
Seed = Annotated[int, typer.Option(min=0, help="Of the start offset and the grousers' phase.")]
Timestep = Annotated[str | None, typer.Option(help="Of the simulation, for example 0.5ms.")]
Speed = Annotated[str, typer.Option(help="Of the belt, for example 0.1m/s.")]
LogFile = Annotated[
    Path | None, typer.Option("--log", metavar="FILE", help="Log over time: .csv or .parquet.")
]
FigureFile = Annotated[
    Path | None, typer.Option("--figure", metavar="FILE", help="Log drawn: .png, .svg or .pdf.")
]
VideoFile = Annotated[
    Path | None, typer.Option("--video", metavar="FILE", help="Film: .mp4 or .gif.")
]
PictureFile = Annotated[
    Path | None,
    typer.Option("--picture", metavar="FILE", help="Where it was turned furthest: .png."),
]


def register(app: typer.Typer) -> None:
    """Add ``physics`` to the command line."""
    app.add_typer(group)


@group.command("export")
def export(
    robot: options.RobotName,
    names: Names,
    rise: options.Rise = None,
    going: options.Going = None,
    angle: options.Angle = None,
    nosing_spacing: options.NosingSpacing = None,
    steps: options.Steps = None,
    surface: options.SurfaceName = None,
    friction: options.Friction = None,
    speed: Speed = "0.1m/s",
    direction: options.Direction = None,
    facing: options.Facing = "nose-first",
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    override: options.Override = None,
    track: Track = "smooth-belt",
    stiffness: Stiffness = None,
    grouser_height: GrouserHeight = None,
    grouser_spacing: GrouserSpacing = None,
    shoes: Shoes = None,
    begin: Begin = "flight",
    ground: Ground = "steps",
    dimensions: Dimensions = 2,
    yaw: options.Yaw = "0deg",
    lateral_offset: LateralOffset = "0mm",
    start_offset: StartOffset = None,
    seed: Seed = 0,
    timestep: Timestep = None,
) -> None:
    """Write the model of a trial as MJCF, which MuJoCo's own viewer opens.

    A belt runs at once; what drives grousers and chains is no part of MJCF, so they stand still.
    """
    from kaidan.errors import InputError
    from kaidan.physics import mjcf
    from kaidan.report import files

    *stairs, file = names
    if len(stairs) > 1:
        raise InputError(f"kaidan physics export ROBOT STAIRS FILE.xml: {len(names)} names given")
    path = Path(file)
    if path.suffix.lower() != ".xml":
        raise InputError(f"model {file!r}: a file of MuJoCo ends in .xml")
    spec = _spec(
        robot, stairs[0] if stairs else None, rise, going, angle, nosing_spacing, steps,
        surface=surface, friction=friction, acceleration="0m/s2", speed=speed,
        direction=direction, facing=facing, flippers=flippers, payload=payload, override=override,
        track=track_model(track, stiffness, grouser_height, grouser_spacing, shoes), begin=begin,
        releases=2, ground=ground, dimensions=dimensions, yaw=yaw, lateral_offset=lateral_offset,
        start_offset=start_offset, seed=seed, timestep=timestep,
    )  # fmt: skip
    files.write_all({path: mjcf(spec)})
    typer.echo(f"wrote {path}")


@group.command("trial")
def trial(
    robot: options.RobotName,
    stairs: options.StairsName = None,
    rise: options.Rise = None,
    going: options.Going = None,
    angle: options.Angle = None,
    nosing_spacing: options.NosingSpacing = None,
    steps: options.Steps = None,
    surface: options.SurfaceName = None,
    friction: options.Friction = None,
    acceleration: options.Acceleration = "0m/s2",
    speed: Speed = "0.1m/s",
    direction: options.Direction = None,
    facing: options.Facing = "nose-first",
    flippers: options.Flippers = "stowed",
    payload: options.PayloadText = None,
    override: options.Override = None,
    track: Track = "smooth-belt",
    stiffness: Stiffness = None,
    grouser_height: GrouserHeight = None,
    grouser_spacing: GrouserSpacing = None,
    shoes: Shoes = None,
    begin: Begin = "flight",
    releases: Releases = 2,
    ground: Ground = "steps",
    dimensions: Dimensions = 2,
    yaw: options.Yaw = "0deg",
    lateral_offset: LateralOffset = "0mm",
    start_offset: StartOffset = None,
    seed: Seed = 0,
    timestep: Timestep = None,
    log: LogFile = None,
    figure: FigureFile = None,
    picture: PictureFile = None,
    video: VideoFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Drive ROBOT over STAIRS in MuJoCo and tell what happens.

    Without a surface friction is 3, which isolates tipping (grousers: 0.8); of a range the low end
    counts.

    Exit code: 0 climbed, 1 not, 2 bad input, 3 the simulation diverged.
    """
    from kaidan.errors import InputError
    from kaidan.physics import Outcome, run
    from kaidan.report import files, trial_files

    form = None if figure is None else files.figure_format(figure)
    write_log = None if log is None else trial_files.log_writer(log)
    film = None if video is None else trial_files.film_writer(video)
    if picture is not None and picture.suffix.lower() != ".png":
        raise InputError(f"picture {str(picture)!r}: a picture ends in .png")
    spec = _spec(
        robot, stairs, rise, going, angle, nosing_spacing, steps,
        surface=surface, friction=friction, acceleration=acceleration, speed=speed,
        direction=direction, facing=facing, flippers=flippers, payload=payload, override=override,
        track=track_model(track, stiffness, grouser_height, grouser_spacing, shoes), begin=begin,
        releases=releases, ground=ground, dimensions=dimensions, yaw=yaw,
        lateral_offset=lateral_offset, start_offset=start_offset, seed=seed, timestep=timestep,
    )  # fmt: skip
    result = run(spec, log=any(path is not None for path in (log, figure, picture, video)))
    contents: dict[Path, bytes | str] = {}
    if log is not None and write_log is not None:
        contents[log] = write_log(result)
    if figure is not None and form is not None:
        from kaidan.report.trial_figure import trial_figure

        contents[figure] = files.figure_bytes(trial_figure(result), form)
    if picture is not None:
        contents[picture] = trial_files.picture_bytes(result)
    if video is not None and film is not None:
        contents[video] = film(result)
    files.write_all(contents)
    if as_json:
        typer.echo(files.json_text(result.as_dict()), nl=False)
    else:
        _show(result)
    for path in contents:
        typer.echo(f"wrote {path}", err=as_json)
    climbed = result.outcome is Outcome.CLIMBED
    raise typer.Exit(0 if climbed else 3 if result.outcome is Outcome.UNSTABLE else 1)


def track_model(
    kind: str, stiffness: str | None, height: str | None, spacing: str | None, shoes: int | None
) -> "TrackModel":
    """Model of the track from the options that go with its kind."""
    from kaidan.errors import InputError
    from kaidan.physics import KINDS
    from kaidan.units import parse

    if kind not in KINDS:
        raise InputError(f"--track {kind!r} is not a model; known: {', '.join(KINDS)}")
    given: dict[str, Any] = {}
    for option, field, text, what in (
        ("--stiffness", "stiffness", stiffness, "stiffness"),
        ("--grouser-height", "height", height, "length"),
        ("--grouser-spacing", "spacing", spacing, "length"),
        ("--shoes", "shoes", shoes, None),
    ):
        if text is None:
            continue
        if field not in KINDS[kind].model_fields:
            raise InputError(f"{option} does not go with --track {kind}")
        given[field] = parse(str(text), what, option=option) if what else text
    return KINDS[kind](**given)


def _spec(
    robot: str,
    stairs: str | None,
    rise: str | None,
    going: str | None,
    angle: str | None,
    nosing_spacing: str | None,
    steps: int | None,
    *,
    track: "TrackModel",
    begin: str,
    releases: int,
    ground: str,
    dimensions: int,
    lateral_offset: str,
    start_offset: float | None,
    seed: int,
    timestep: str | None,
    **shared: Any,
) -> "TrialSpec":
    """Trial from the texts of the options."""
    from kaidan.physics import TrialSpec
    from kaidan.units import parse

    flight = options.stairs_of(
        stairs, rise=rise, going=going, angle=angle, nosing_spacing=nosing_spacing, steps=steps
    )
    case = options.case_from(robot, flight, **shared)
    friction = {} if case.surface is None else {"friction": case.surface.friction_low}
    return TrialSpec(
        robot=case.robot,
        stairs=case.stairs,
        posture=case.posture,
        payload=case.payload,
        speed=case.speed,
        acceleration=case.acceleration,
        direction=case.direction,
        facing=case.facing,
        track=track,
        begin=begin,
        releases=releases,
        ground=ground,
        dimensions=dimensions,
        yaw=case.yaw,
        lateral_offset=parse(lateral_offset, "length", option="--lateral-offset"),
        start_offset=start_offset,
        seed=seed,
        timestep=None if timestep is None else parse(timestep, "time", option="--timestep"),
        **friction,
    )


def _show(result: "TrialResult") -> None:
    spec = result.spec
    told = result.outcome.value.replace("_", " ")
    where = "" if result.release is None else f" at release {result.release}"
    echo(
        f"{told.upper()}{where}  {spec.robot.name} on {spec.stairs.name}, {spec.direction} "
        f"{spec.facing.replace('-', ' ')}"
    )
    assumed = ", assumed: the sheet gives none" if result.mass_assumed else ""
    estimated = ", inertia estimated" if result.inertia_estimated else ""
    torque = "" if result.largest_torque is None else f", {result.largest_torque:.1f} N m"
    rows = (
        ("model", f"{spec.track.kind}, {spec.dimensions}-D, steps of {1e3 * spec.step:g} ms"),
        ("friction", f"{spec.static_friction:g}"),
        ("speed", f"{spec.speed:g} m/s, {spec.acceleration:g} m/s2 up the stairs"),
        ("mass", f"{result.mass:g} kg{assumed}{estimated}"),
        ("extra inclination", f"{result.largest_extra_deg:.2f} deg at most"),
        ("releases", f"{result.releases}, begun at {result.start_offset:.3f} of a spacing"),
        ("largest forces", f"{result.largest_normal:.0f} N on a nosing, traction "
                           f"{result.largest_traction:.0f} N{torque}"),
        ("slip", f"{1e3 * result.slip:.1f} mm"),
        ("time", f"{result.time:.2f} s"),
        ("made with", f"MuJoCo {result.versions['mujoco']}, seed {spec.seed}"),
    )  # fmt: skip
    for name, text in rows:
        echo(f"  {name:<18} {text}")
