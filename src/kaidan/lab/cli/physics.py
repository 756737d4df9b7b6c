"""``kaidan lab physics``: a trial in MuJoCo, and its model for MuJoCo's own viewer."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from kaidan.cli import options, output
from kaidan.cli.question import question_of, question_options, shared

if TYPE_CHECKING:
    from kaidan.physics import TrackModel, TrialSpec

group = typer.Typer(
    name="physics", help="Run one trial in MuJoCo, or write its model.", no_args_is_help=True
)  # fmt: skip

Track = Annotated[
    str,
    typer.Option(
        help="Model: smooth-belt, yielding-belt, sprung-noses (stairs that yield), "
        "driven-grousers or shoe-chain."
    ),
]
Stiffness = Annotated[
    str | None,
    typer.Option(
        help="Stiffness of the track at a nosing (yielding-belt), of a step (sprung-noses) or of a "
        "grouser (driven-grousers): 30kN/m."
    ),
]
ShearRatio = Annotated[
    float | None,
    typer.Option(help="Stiffness along the track to that across it (yielding-belt) [1]."),
]
GrouserHeight = Annotated[
    str | None, typer.Option(help="Height of the grousers above the belt, for example 10mm.")
]
GrouserSpacing = Annotated[
    str | None, typer.Option(help="Spacing of the grousers along the belt, for example 33mm.")
]
Shoes = Annotated[int | None, typer.Option(help="Number of shoes of the chain [40].")]
Begin = Annotated[
    str,
    typer.Option(help="Where it begins: flight (as in the paper) or landing, from end to end."),
]
Nosings = Annotated[
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
Seed = Annotated[int, typer.Option(min=0, help="Seed of the start offset and the grousers' phase.")]
Timestep = Annotated[
    str | None, typer.Option(help="Time step of the simulation, for example 0.5ms.")
]
Speed = Annotated[str, typer.Option(help="Speed of the belt, for example 0.1m/s.")]
ModelFile = Annotated[
    Path, typer.Option("--file", metavar="FILE.xml", help="File to write.", show_default=False)
]
LogFile = Annotated[
    Path | None, typer.Option("--log", metavar="FILE", help="Log over time: .csv or .parquet.")
]
VideoFile = Annotated[
    Path | None, typer.Option("--video", metavar="FILE", help="Film: .mp4 or .gif.")
]
PictureFile = Annotated[
    Path | None,
    typer.Option("--picture", metavar="FILE", help="Robot at its largest inclination: .png."),
]

RerunFile = Annotated[
    Path | None,
    typer.Option("--rerun", metavar="FILE.rrd", help="Write a recording for the viewer of Rerun."),
]


def register(app: typer.Typer) -> None:
    """Add ``physics`` to the command line."""
    app.add_typer(group)


def _options(
    track: Track = "smooth-belt",
    stiffness: Stiffness = None,
    shear_ratio: ShearRatio = None,
    grouser_height: GrouserHeight = None,
    grouser_spacing: GrouserSpacing = None,
    shoes: Shoes = None,
    begin: Begin = "flight",
    nosings: Nosings = 2,
    ground: Ground = "steps",
    dimensions: Dimensions = 2,
    lateral_offset: LateralOffset = "0mm",
    start_offset: StartOffset = None,
    seed: Seed = 0,
    timestep: Timestep = None,
) -> None:
    """Only its signature counts: the options of a trial beside those of its question."""


def _spec(
    *,
    track: str,
    stiffness: str | None,
    shear_ratio: float | None,
    grouser_height: str | None,
    grouser_spacing: str | None,
    shoes: int | None,
    begin: str,
    nosings: int,
    ground: str,
    dimensions: int,
    lateral_offset: str,
    start_offset: float | None,
    seed: int,
    timestep: str | None,
    **of_question: Any,
) -> "TrialSpec":
    """Trial of the options' values."""
    from kaidan.physics import TrialSpec
    from kaidan.units import parse

    return TrialSpec.model_validate(
        {
            "question": question_of(**of_question),
            "track": track_model(
                track, stiffness, shear_ratio, grouser_height, grouser_spacing, shoes
            ),
            "begin": begin,
            "nosings": nosings,
            "ground": ground,
            "dimensions": dimensions,
            "lateral_offset": parse(lateral_offset, "length", option="--lateral-offset"),
            "start_offset": start_offset,
            "seed": seed,
            "timestep": None if timestep is None else parse(timestep, "time", option="--timestep"),
        }
    )


_trial = shared(
    (question_options, _options),
    _spec,
    without=("uniform_across", "theta_d", "theta_m", "uncertainty", "risk", "model"),
    speed="0.1m/s",
    flippers="stowed",
)
"""Decorator of a command whose first argument is a `TrialSpec`."""


@group.command("export")
@_trial
def export(spec: "TrialSpec", file: ModelFile) -> None:
    """Write the model of a trial as MJCF, which MuJoCo's own viewer opens.

    A belt runs at once; what drives grousers and chains is no part of MJCF, so they stand still,
    and a yielding belt is rigid there.
    """
    from kaidan import files
    from kaidan.errors import InputError, short
    from kaidan.physics import mjcf

    if file.suffix.lower() != ".xml":
        raise InputError(f"model {short(file)!r}: a file of MuJoCo ends in .xml")
    files.write_all({file: mjcf(spec)})
    typer.echo(f"wrote {file}")


@group.command("trial")
@_trial
def trial(
    spec: "TrialSpec",
    log: LogFile = None,
    figure: output.FigureFiles = None,
    picture: PictureFile = None,
    video: VideoFile = None,
    rerun: RerunFile = None,
    as_json: options.AsJson = False,
) -> None:
    """Drive ROBOT over STAIRS in MuJoCo.

    Without a surface friction is 3, which isolates tipping (grousers: 0.8); of a range the low end
    counts.

    Exit code: 0 climbed, 1 not, 2 bad input, 3 the simulation diverged.
    """
    from kaidan.errors import InputError, short
    from kaidan.films import film_format
    from kaidan.lab.physics import trial_files
    from kaidan.physics import record

    pictures = output.checked(figure, log, picture, video, rerun)
    if rerun is not None:
        from kaidan.lab.rerun.recording import recording_file

        recording_file(rerun)
    write_log = None if log is None else trial_files.log_writer(log)
    film = None if video is None else film_format(video, "video")
    if picture is not None and picture.suffix.lower() != ".png":
        raise InputError(f"picture {short(picture)!r}: a picture ends in .png")
    found = record(spec)
    contents: output.Contents = {}
    if log is not None and write_log is not None:
        contents[log] = write_log(found)

    def draw() -> "output.Figure":
        from kaidan.lab.physics.figure import trial_figure

        return trial_figure(found)

    contents |= output.drawn(pictures, draw)

    if rerun is not None:
        from kaidan.lab.rerun.recording import trial_recording

        contents[rerun] = trial_recording(found)
    if picture is not None:
        contents[picture] = trial_files.picture_bytes(found)
    if video is not None and film is not None:
        contents[video] = trial_files.trial_film(found, film)
    output.put_out(found.result, contents, as_json=as_json)
    raise typer.Exit(found.result.outcome.exit_code)


def track_model(
    kind: str,
    stiffness: str | None = None,
    shear_ratio: float | None = None,
    height: str | None = None,
    spacing: str | None = None,
    shoes: int | None = None,
) -> "TrackModel":
    """Model of the track from the options that go with its kind."""
    from kaidan.errors import InputError, shown
    from kaidan.physics import KINDS
    from kaidan.units import parse

    if kind not in KINDS:
        raise InputError(f"--track {shown(kind)} is not a model; known: {', '.join(KINDS)}")
    given: dict[str, Any] = {}
    for option, field, text, what in (
        ("--stiffness", "stiffness", stiffness, "stiffness"),
        ("--shear-ratio", "shear_ratio", shear_ratio, None),
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
