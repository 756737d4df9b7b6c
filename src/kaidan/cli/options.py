"""Options that several commands share, and what becomes of their texts."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from kaidan.assessment.case import Case
    from kaidan.assessment.terrain import Terrain
    from kaidan.robot import Payload, Posture, Robot
    from kaidan.stairs import Stairs

RobotName = Annotated[
    str, typer.Argument(metavar="ROBOT", help="Catalogue name (kaidan robots) or TOML file.")
]
StairsName = Annotated[
    str | None,
    typer.Argument(metavar="[STAIRS]", help="Catalogue name (kaidan stairs) or TOML file."),
]
TerrainName = Annotated[
    str | None,
    typer.Argument(
        metavar="[STAIRS]",
        help="Catalogue name (kaidan stairs) or TOML file; several flights, from bottom to top, "
        "joined by +.",
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
Rise = Annotated[str | None, typer.Option(help="Rise of uniform stairs, for example 180mm or 7in.")]
Going = Annotated[str | None, typer.Option(help="Going of uniform stairs, for example 280mm.")]
Angle = Annotated[str | None, typer.Option(help="Angle of uniform stairs, for example 50deg.")]
NosingSpacing = Annotated[
    str | None, typer.Option(help="Nosing to nosing along the slope, for example 150mm.")
]
Steps = Annotated[int | None, typer.Option(help="Number of risers of uniform stairs [12].")]
SurfaceName = Annotated[
    str | None, typer.Option("--surface", help="Catalogue name (kaidan surfaces) or TOML file.")
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
Facing = Annotated[str, typer.Option(help="nose-first or tail-first.")]
Flippers = Annotated[
    str,
    typer.Option(
        help="stowed, flat (in line with the track), or the angles of front and rear: 20deg,-5deg."
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
Override = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        help="Own figure for the robot: com_from_front=200mm, com_height=, flat_length=, "
        "gauge=, mass=20kg.",
    ),
]
UncertaintyText = Annotated[
    list[str] | None,
    typer.Option(
        "--uncertainty",
        help="Standard uncertainty: com_from_front=5mm, com_height=, flat_length=, angle=0.5deg, "
        "nosing_spacing=, friction=0.05; may be given again.",
    ),
]
Yaw = Annotated[
    str, typer.Option(help="Heading off the line of steepest ascent, to the left positive: 10deg.")
]
Model = Annotated[str, typer.Option(help="Which model judges: contact or closed-form.")]
Risk = Annotated[float, typer.Option(help="Probability of failure that is accepted.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]

_OVERRIDES = {
    "com_from_front": "length",
    "com_height": "length",
    "flat_length": "length",
    "gauge": "length",
    "mass": "mass",
}
_UNCERTAINTIES = {
    "com_from_front": "length",
    "com_height": "length",
    "flat_length": "length",
    "angle": "angle",
    "nosing_spacing": "length",
    "friction": "number",
}


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
    from kaidan.errors import InputError
    from kaidan.stairs import Stairs
    from kaidan.units import parse

    shape = {"--rise": rise, "--going": going, "--angle": angle, "--nosing-spacing": nosing_spacing}
    given = {option for option, value in shape.items() if value is not None}
    if name is not None:
        if given or steps is not None:
            extra = ", ".join(sorted(given) or ["--steps"])
            raise InputError(f"give either the stairs {name!r} or {extra}, not both")
        return Stairs.named(name)
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
            raise InputError(f"--angle {angle!r} is not within 0 to 89 deg")
        return Stairs.inclined(
            angle=slope,
            nosing_spacing=parse(nosing_spacing, "length", option="--nosing-spacing"),
            **count,
        )
    raise InputError(
        "no stairs: give a catalogue name (kaidan stairs), a TOML file, --rise with --going, or "
        "--angle with --nosing-spacing"
    )


def terrain_of(name: str | None, points: Path | None, **shape: Any) -> "Terrain":
    """Stairs, several flights by name, or a profile through points; one of these ways."""
    from kaidan.assessment.terrain import JOINT
    from kaidan.errors import InputError
    from kaidan.profile import Profile
    from kaidan.report.files import points_of

    if points is not None:
        if name is not None or any(value is not None for value in shape.values()):
            raise InputError("give either --points or stairs, not both")
        return Profile.of_points(points_of(points))
    if name is not None and JOINT in name and not Path(name).exists():
        if any(value is not None for value in shape.values()):
            raise InputError(f"give either the stairs {name!r} or a shape, not both")
        return name.split(JOINT)
    return stairs_of(name, **shape)


def robot_of(name: str, overrides: list[str] | None) -> "Robot":
    """Robot by name with the user's own figures in place of the sheet's."""
    from kaidan.robot import Robot

    robot = Robot.named(name)
    own = _pairs(overrides, _OVERRIDES, "--set")
    if not own:
        return robot
    sheet = robot.model_dump()
    for name in ("flat_length", "gauge"):
        if name in own:
            sheet["track"][name] = own.pop(name)
    return Robot.model_validate(sheet | own)


def case_from(
    robot: str,
    stairs: "Terrain",
    *,
    surface: str | None = None,
    friction: str | None = None,
    acceleration: str = "0m/s2",
    speed: str | None = None,
    direction: str | None = None,
    facing: str = "nose-first",
    flippers: str = "stowed",
    payload: list[str] | None = None,
    theta_d: str | None = None,
    theta_m: str | None = None,
    override: list[str] | None = None,
    uncertainty: list[str] | None = None,
    yaw: str = "0deg",
    risk: float = 0.01,
    points: Path | None = None,
) -> "Case":
    """Case from the texts of the shared options; a profile is called after its file of points."""
    from kaidan.assessment import case_of
    from kaidan.errors import InputError
    from kaidan.surface import Surface
    from kaidan.units import parse

    sheet = robot_of(robot, override)
    doubts = _pairs(uncertainty, _UNCERTAINTIES, "--uncertainty")
    ground = None if surface is None else Surface.named(surface)
    if friction is not None:
        if ground is not None:
            raise InputError("give either --surface or --friction, not both")
        low, high = _range(friction, "--friction", lambda text: _number(text, "--friction"))
        ground = Surface(name=f"friction {friction}", friction_low=low, friction_high=high)
    if "friction" in doubts and ground is None:
        raise InputError("--uncertainty friction needs --friction or --surface")
    ground = _doubted(ground, {"friction_uncertainty": doubts.get("friction")})
    sheet = sheet.model_copy(
        update={
            "uncertainty": _doubted(
                sheet.uncertainty, _only(doubts, "com_from_front", "com_height", "flat_length")
            )
        }
    )

    def allowance(text: str | None, option: str) -> Any:
        if text is None:
            return None
        return _range(text, option, lambda part: parse(part, "angle", option=option))

    case = case_of(
        sheet,
        stairs,
        surface=ground,
        acceleration=parse(acceleration, "acceleration", option="--acceleration"),
        speed=None if speed is None else parse(speed, "speed", option="--speed"),
        direction=direction,  # type: ignore[arg-type]
        facing=facing,  # type: ignore[arg-type]
        flippers=_flippers(flippers),
        payload=[_payload(text) for text in payload or ()],
        theta_d=allowance(theta_d, "--theta-d"),
        theta_M=allowance(theta_m, "--theta-m"),
        yaw=parse(yaw, "angle", option="--yaw"),
        risk=risk,
    )
    of_steps = _doubted(case.stairs.uncertainty, _only(doubts, "angle", "nosing_spacing"))
    own: dict[str, Any] = {"uncertainty": of_steps}
    if points is not None:
        own["name"] = points.name
    return case.changed(stairs=case.stairs.model_copy(update=own))


def _pairs(texts: list[str] | None, kinds: dict[str, str], option: str) -> dict[str, float]:
    from kaidan.errors import InputError
    from kaidan.units import parse

    values = {}
    for text in ",".join(texts or ()).split(",") if texts else ():
        name, equals, value = text.partition("=")
        name = name.strip()
        if not equals or name not in kinds:
            raise InputError(
                f"{option} {text!r}: write NAME=VALUE with a name of {', '.join(kinds)}"
            )
        if name in values:
            raise InputError(f"{option} {name} is given twice")
        where = f"{option} {name}"
        number = kinds[name] == "number"
        values[name] = _number(value, where) if number else parse(value, kinds[name], option=where)
    return values


def _only(values: dict[str, float], *names: str) -> dict[str, float | None]:
    return {name: values.get(name) for name in names}


def _doubted(sheet: Any, doubts: dict[str, float | None]) -> Any:
    stated = {name: value for name, value in doubts.items() if value is not None}
    return type(sheet).model_validate(sheet.model_dump() | stated) if stated else sheet


def _number(text: str, option: str) -> float:
    from kaidan.errors import InputError

    if not re.fullmatch(r"\s*[+-]?(\d+(\.\d*)?|\.\d+)\s*", text, re.ASCII):
        raise InputError(f"{option} {text!r} is not a plain number such as 0.8")
    return float(text)


def _range(text: str, option: str, read: Callable[[str], float]) -> tuple[float, float]:
    from kaidan.errors import InputError

    low, dots, high = text.partition("..")
    if not dots:
        value = read(text)
        return value, value
    if not low.strip() or not high.strip():
        raise InputError(f"{option} {text!r}: a range has two ends, LOW..HIGH")
    return read(low), read(high)


def _flippers(text: str) -> "Posture | Any":
    from kaidan.robot import Posture
    from kaidan.units import parse

    if "," not in text:
        return text.strip()
    ends: list[float | str | None] = []
    for part in text.split(",", 1):
        word = part.strip()
        if word == "stowed":
            ends.append(None)
        else:
            ends.append(word if word == "flat" else parse(word, "angle", option="--flippers"))
    return Posture(front=ends[0], rear=ends[1])


def _payload(text: str) -> "Payload":
    from kaidan.errors import InputError
    from kaidan.robot import Payload
    from kaidan.units import parse

    mass, at, place = text.partition("@")
    behind, comma, height = place.partition(",")
    if not at or not comma:
        raise InputError(
            f"--payload {text!r}: write MASS@BEHIND_FRONT,HEIGHT, for example 5kg@200mm,300mm"
        )
    return Payload(
        mass=parse(mass, "mass", option="--payload"),
        from_front=parse(behind, "length", option="--payload"),
        height=parse(height, "length", option="--payload"),
    )
