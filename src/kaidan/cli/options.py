"""Options that several commands share, and what becomes of their texts."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from kaidan.terrain.stairs import Stairs


def _names(*folders: str) -> Any:
    """Names of catalogues that begin with what a shell's user has typed."""

    def names(incomplete: str) -> list[str]:
        from kaidan import catalog

        every = [name for folder in folders for name in catalog.names(folder)]
        return [name for name in every if name.startswith(incomplete)]

    return names


RobotName = Annotated[
    str,
    typer.Argument(
        metavar="ROBOT",
        help="Catalogue name (kaidan robots), TOML file (kaidan measure robot, kaidan new), or a "
        "description: URDF, SDF, MJCF (kaidan read).",
        autocompletion=_names("robots", "unweighed"),
    ),
]


TerrainName = Annotated[
    str | None,
    typer.Argument(
        metavar="[STAIRS]",
        help="Catalogue name (kaidan stairs), TOML file (kaidan measure stairs), or a model or "
        "scan (kaidan read), FILE#PART; several flights, from bottom to top, joined by +.",
        autocompletion=_names("stairs"),
    ),
]
PointsFile = Annotated[
    Path | None,
    typer.Option(
        "--points",
        metavar="FILE",
        help="Own profile instead of STAIRS: CSV with columns x,z in metres, from bottom to top.",
    ),
]
UniformAcross = Annotated[
    bool,
    typer.Option(
        "--uniform-across",
        help="Both tracks meet the same profile, although it is no flight, step, ramp or "
        "threshold.",
    ),
]
Rise = Annotated[str | None, typer.Option(help="Rise of uniform stairs, for example 180mm or 7in.")]
Going = Annotated[str | None, typer.Option(help="Going of uniform stairs, for example 280mm.")]
Angle = Annotated[str | None, typer.Option(help="Angle of uniform stairs, for example 50deg.")]
NosingSpacing = Annotated[
    str | None, typer.Option(help="Nosing to nosing along the slope, for example 150mm.")
]
Steps = Annotated[int | None, typer.Option(help="Number of risers of uniform stairs [12].")]
SurfaceName = Annotated[
    str | None,
    typer.Option(
        "--surface",
        help="Catalogue name (kaidan surfaces) or TOML file.",
        autocompletion=_names("surfaces"),
    ),
]
Friction = Annotated[
    str | None,
    typer.Option(help="Static friction of the tracks on the nosings: 0.8, or a range 0.6..1.0."),
]
Acceleration = Annotated[
    str, typer.Option(help="Acceleration UP the stairs, whichever way it goes, e.g. 0.3m/s2.")
]
Speed = Annotated[str | None, typer.Option(help="Speed, for example 0.1m/s.")]
Direction = Annotated[str | None, typer.Option(help="up or down [up].")]
Facing = Annotated[
    str | None,
    typer.Option(help="nose-first or tail-first [nose-first; with best flippers the better one]."),
]
Flippers = Annotated[
    str | None,
    typer.Option(
        help="stowed, flat (in line with the track), the angles of front and rear: 20deg,-5deg, "
        "a plan by phase: flat/land:-60deg,-20deg, or best: kaidan finds the plan (commands that "
        "judge plans do so without this option)."
    ),
]
PayloadText = Annotated[
    list[str] | None,
    typer.Option(
        "--payload",
        help="MASS@BEHIND_FRONT,HEIGHT, for example 5kg@200mm,300mm; may be given again.",
    ),
]
ThetaD = Annotated[
    str | None,
    typer.Option(help="Measured inclination from track deformation, 2.6deg or 1deg..2.6deg."),
]
ThetaM = Annotated[
    str | None, typer.Option("--theta-m", help="Measured loss from grousers, 1.2deg..2.6deg.")
]
FlipperTolerance = Annotated[
    str | None,
    typer.Option(help="How far off their angles the flippers may lie [2deg with best, else 0]."),
]
FallReserve = Annotated[
    str | None,
    typer.Option(help="Tilt to the fall that a robot that rocks must keep [8deg]."),
]
Override = Annotated[
    list[str] | None,
    typer.Option(
        "--override",
        help="Own figure for the robot: com_from_front=200mm, com_height=, flat_length=, "
        "gauge=, mass=20kg, or any of its sheet: track.front_radius=90mm, track.belt=grousers.",
    ),
]
UncertaintyText = Annotated[
    list[str] | None,
    typer.Option(
        "--uncertainty",
        help="Standard uncertainty: com_from_front=5mm, com_height=, flat_length=, angle=0.5deg, "
        "nosing_spacing=, rise=3mm, going= (of each step), friction=0.05; may be given again.",
    ),
]
Yaw = Annotated[
    str, typer.Option(help="Heading off the line of steepest ascent, to the left positive: 10deg.")
]
Model = Annotated[
    str,
    typer.Option(help="Which model answers: contact, closed-form, support-polygon or physics."),
]
Risk = Annotated[float, typer.Option(help="Probability of failure that is accepted.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


def stairs_of(
    name: str | None,
    *,
    rise: str | None,
    going: str | None,
    angle: str | None,
    nosing_spacing: str | None,
    steps: int | None,
) -> "Stairs":
    """Stairs from a name or from the shape given by options; exactly one of the three ways."""
    from kaidan.errors import InputError, shown
    from kaidan.spelling import sheet_of
    from kaidan.terrain.stairs import Stairs
    from kaidan.units import parse

    shape = {"--rise": rise, "--going": going, "--angle": angle, "--nosing-spacing": nosing_spacing}
    given = {option for option, value in shape.items() if value is not None}
    if name is not None:
        if given or steps is not None:
            extra = ", ".join(sorted(given) or ["--steps"])
            raise InputError(f"give either the stairs {name!r} or {extra}, not both")
        return sheet_of(name, Stairs)
    count = {} if steps is None else {"steps": steps}
    if given == {"--rise", "--going"}:
        assert rise is not None
        assert going is not None
        return Stairs(
            name=f"{rise} x {going}",
            rise=parse(rise, "length", option="--rise"),
            going=parse(going, "length", option="--going"),
            **count,
        )
    if given == {"--angle", "--nosing-spacing"}:
        assert angle is not None
        assert nosing_spacing is not None
        slope = parse(angle, "angle", option="--angle")
        if not 0 < slope < 1.5533:
            raise InputError(f"--angle {shown(angle)} is not within 0 to 89 deg")
        return Stairs.inclined(
            angle=slope,
            nosing_spacing=parse(nosing_spacing, "length", option="--nosing-spacing"),
            **count,
        )
    raise InputError(
        "no stairs: give a catalogue name (kaidan stairs), a TOML file, --rise with --going, or "
        "--angle with --nosing-spacing"
    )


def terrain_of(name: str | None, points: Path | None, **shape: Any) -> Any:
    """Stairs, several flights by name, or a profile through points; one of these ways."""
    from kaidan.errors import InputError
    from kaidan.files import points_of
    from kaidan.spelling import JOINT
    from kaidan.terrain.profile import Profile

    if points is not None:
        if name is not None or any(value is not None for value in shape.values()):
            raise InputError("give either --points or stairs, not both")
        line = points_of(points)
        try:
            return Profile.of_points(line, name=points.name)
        except InputError as error:
            raise InputError(f"{points}: {error}") from None
    if name is not None and all(value is None for value in shape.values()):
        return name
    if name is not None and JOINT in name and not Path(name).exists():
        raise InputError(f"give either the stairs {name!r} or a shape, not both")
    return stairs_of(name, **shape)
