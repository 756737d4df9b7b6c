"""Mass, length and centroid of a robot from scales, a tape and an angle, with their doubt."""

import math
from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Literal, NamedTuple

from kaidan.answer import Answer, Part
from kaidan.errors import InputError
from kaidan.mechanics.weighing import (
    com_height_by_slope,
    com_height_by_tipping,
    combined_uncertainty,
    plumb_position,
)
from kaidan.robot import Robot, Track
from kaidan.sheet import bounds
from kaidan.spelling import word_of
from kaidan.units import value_of

SCALE = "50g"
TAPE = "1mm"
ANGLE = "0.2deg"
"""Standard uncertainty of a scale, of a tape and of a digital level, where nobody states it."""
GENTLEST = math.radians(3.0)
"""Gentlest slope that says anything of the height of the centroid [rad]."""
DISAGREE = 4.0
"""Standard uncertainties by which two sums of the scales may differ."""

Along = Literal["two scales", "balance point"]
Height = Literal["scales on a slope", "balanced on its end", "tipped on a ramp"]
End = Literal["front", "rear"]
Way = Literal["end", "ramp"]


class Measured(Part):
    """A figure of the sheet with its doubt."""

    value: float
    """In the unit that the figure's own docstring names."""
    uncertainty: float
    """Standard uncertainty (one sigma), in the same unit."""
    shares: dict[str, float]
    """Share of each input in the square of the uncertainty, the largest first [1]."""


class RobotMeasurement(Answer):
    """Mass, L, C_L and C_N of a robot with their standard uncertainties."""

    text_module: ClassVar[str] = "robot_measurement"

    name: str
    mass: Measured | None
    """Mass [kg]; null: nothing says it."""
    flat_length: Measured
    """L [m]."""
    com_from_front: Measured
    """C_L, centroid behind the front tip of the flat [m]."""
    com_height: Measured | None
    """C_N, centroid above the underside [m]; null: no slope and no tilt was stated."""
    along: Along
    """How C_L was found."""
    height: Height | None
    """How C_N was found."""
    over: End | None
    """End on which it balanced or tipped."""
    inputs: dict[str, float]
    """What was stated, SI: masses [kg], lengths [m], angles [rad]."""
    radii_m: tuple[float | None, float | None]
    """Front and rear end radius, where stated [m]."""
    notes: tuple[str, ...]
    """What the reader must know."""

    @property
    def figures(self) -> dict[str, float | str]:
        """Figures of a robot's sheet by their dotted names, with the sources of those measured."""
        from kaidan.text.robot_measurement import source

        found: dict[str, float | str] = {}
        said: dict[str, float | str] = {}
        each = {
            "mass": self.mass,
            "com_from_front": self.com_from_front,
            "com_height": self.com_height,
            "track.flat_length": self.flat_length,
        }
        for name, one in each.items():
            if one is not None:
                found[name] = round(one.value, 4)
                said[f"sources.{name}"] = source(self, name)
        for end, radius in zip(("front", "rear"), self.radii_m, strict=True):
            if radius is not None:
                found[f"track.{end}_radius"] = radius
                said[f"sources.track.{end}_radius"] = source(self, "radius")
        for name in ("com_from_front", "com_height", "track.flat_length"):
            one = each[name]
            if one is not None:
                found[f"uncertainty.{name.rpartition('.')[2]}"] = round(one.uncertainty, 5)
        return found | said


class _Input(NamedTuple):
    """Something that a user states about a robot."""

    kind: str
    low: float
    high: float
    tool: Literal["scale", "tape", "angle"]


_MASS = _Input("mass", 0.0, bounds(Robot.model_fields["mass"])[2], "scale")
_LENGTH = _Input("length", *bounds(Track.model_fields["flat_length"])[1:], "tape")
_INSET = _Input("length", -1.0, 2.0, "tape")
_RADIUS = _Input("length", *bounds(Track.model_fields["front_radius"])[1:], "tape")
_ANGLE = _Input("angle", math.radians(-80.0), math.radians(130.0), "angle")
_INPUTS = {
    "flat_length": _LENGTH,
    "front_scale": _MASS,
    "rear_scale": _MASS,
    "balance": _Input("length", -1.0, 6.0, "tape"),
    "mass": _MASS,
    "slope": _ANGLE,
    "front_on_slope": _MASS,
    "rear_on_slope": _MASS,
    "tips_at": _ANGLE,
    "front_radius": _RADIUS,
    "rear_radius": _RADIUS,
    "front_inset": _INSET,
    "rear_inset": _INSET,
}


def measure_robot(
    *,
    name: str = "robot",
    flat_length: Any,
    front_scale: Any = None,
    rear_scale: Any = None,
    balance: Any = None,
    mass: Any = None,
    slope: Any = None,
    front_on_slope: Any = None,
    rear_on_slope: Any = None,
    tips_at: Any = None,
    over: End = "rear",
    on: Way = "end",
    front_radius: Any = None,
    rear_radius: Any = None,
    front_inset: Any = 0.0,
    rear_inset: Any = 0.0,
    u_scale: Any = SCALE,
    u_tape: Any = TAPE,
    u_angle: Any = ANGLE,
) -> RobotMeasurement:
    """Mass, length and centroid of a robot, with standard uncertainties.

    Along the track from two scales (`front_scale`, `rear_scale`) or a `balance` point; the height
    from the scales again on a known `slope`, or from the inclination `tips_at` at which it tips.

    Parameters
    ----------
    name : str
        Of the robot.
    flat_length : float or str
        Flat underside, L [m]; or a text such as "620mm", as all of these.
    front_scale, rear_scale : float or str, optional
        What the scales under the front and the rear of the flat show, robot level [kg].
    balance : float or str, optional
        Balance point on an edge, robot level, behind the front tip of the flat [m].
    mass : float or str, optional
        Mass [kg], where one scale weighed the whole robot.
    slope : float or str, optional
        Inclination of the flat at the second weighing, nose up positive [rad].
    front_on_slope, rear_on_slope : float or str, optional
        What the scales show then [kg].
    tips_at : float or str, optional
        Inclination of the flat at which it balances on one end, or tips over it [rad].
    over : {"rear", "front"}
        End on which.
    on : {"end", "ramp"}
        Balanced by hand on its round end, or tipped on a ramp that grew steeper.
    front_radius, rear_radius : float or str, optional
        Radius of the ends, belt included [m].
    front_inset, rear_inset : float or str
        Supports of the scales inward of the tips of the flat [m].
    u_scale, u_tape, u_angle : float or str
        Standard uncertainty of what a scale [kg], a tape [m] and a level [rad] show.

    Returns
    -------
    RobotMeasurement

    Raises
    ------
    InputError
        An input without physical meaning, too few of them, or some that contradict each other.

    Examples
    --------
    >>> found = measure_robot(flat_length=0.5, front_scale=12.0, rear_scale=8.0, slope="20deg",
    ...                       front_on_slope=10.544, rear_on_slope=9.456)
    >>> round(found.com_from_front.value, 4), round(found.com_height.value, 4)
    (0.2, 0.1)
    """
    stated = {
        "flat_length": flat_length,
        "front_scale": front_scale,
        "rear_scale": rear_scale,
        "balance": balance,
        "mass": mass,
        "slope": slope,
        "front_on_slope": front_on_slope,
        "rear_on_slope": rear_on_slope,
        "tips_at": tips_at,
        "front_radius": front_radius,
        "rear_radius": rear_radius,
        "front_inset": front_inset,
        "rear_inset": rear_inset,
    }
    tools = {
        "scale": _positive(u_scale, "mass", "u_scale"),
        "tape": _positive(u_tape, "length", "u_tape"),
        "angle": _positive(u_angle, "angle", "u_angle"),
    }
    at = {key: _value(key, given) for key, given in stated.items() if given is not None}
    over, on = word_of("over", over, ("front", "rear")), word_of("on", on, ("end", "ramp"))
    along = _along(at)
    height = _height(at, over, on)
    u = {key: tools[_INPUTS[key].tool] for key in at}
    for key in ("front_inset", "rear_inset"):
        if at[key] == 0.0:  # a support that stands at the tip as well as one can see
            u[key] = tools["tape"]
    weight = _mass_formula(at)
    place = _ALONG[along]
    raised = None if height is None else _height_formula(height, over, place)
    found = RobotMeasurement(
        name=name,
        mass=None if weight is None else _measured(weight, at, u),
        flat_length=_measured(lambda **a: a["flat_length"], at, u),
        com_from_front=_measured(place, at, u),
        com_height=None if raised is None else _measured(raised, at, u),
        along=along,
        height=height,
        over=over if height in ("balanced on its end", "tipped on a ramp") else None,
        inputs=at,
        radii_m=(at.get("front_radius"), at.get("rear_radius")),
        notes=_notes(at, tools["scale"]),
    )
    _plausible(found)
    return found


def _positive(given: Any, kind: str, name: str) -> float:
    value = value_of(given, kind, option=name)
    if value < 0:
        raise InputError(f"{name} = {value:g} is negative")
    return value


def _value(key: str, given: Any) -> float:
    wanted = _INPUTS[key]
    value = value_of(given, wanted.kind, option=key)
    if not wanted.low <= value <= wanted.high:
        unit = {"mass": "kg", "length": "m", "angle": "rad"}[wanted.kind]
        raise InputError(
            f"{key} = {value:g} {unit} is not within {wanted.low:g} to {wanted.high:g} {unit}"
        )
    return value


def _along(at: Mapping[str, float]) -> Along:
    """How the place along the track is found."""
    scales = {"front_scale", "rear_scale"} & at.keys()
    if "balance" in at:
        if scales and "slope" not in at:
            raise InputError("give either two scales or a balance point, not both")
        return "balance point"
    if len(scales) != 2:
        missing = "front_scale and rear_scale" if not scales else ", ".join(
            sorted({"front_scale", "rear_scale"} - scales)
        )  # fmt: skip
        raise InputError(
            f"{missing}: missing; state what two scales show under the front and the rear of the "
            "flat, or the balance point"
        )
    if at["front_scale"] + at["rear_scale"] <= 0:
        raise InputError("front_scale and rear_scale show nothing together")
    return "two scales"


def _height(at: Mapping[str, float], over: End, on: Way) -> Height | None:
    """How the height is found; None: nothing says it."""
    on_slope = {"slope", "front_on_slope", "rear_on_slope"} & at.keys()
    if on_slope and "tips_at" in at:
        raise InputError("give either a slope with scales or an angle at which it tips, not both")
    if on_slope:
        if len(on_slope) != 3:
            raise InputError("a slope needs slope, front_on_slope and rear_on_slope together")
        if abs(at["slope"]) < GENTLEST:
            raise InputError(
                f"slope = {math.degrees(at['slope']):g} deg is too gentle to say how high the "
                "centroid is; take 15 deg or more"
            )
        if abs(at["slope"]) > math.radians(60.0):
            raise InputError(
                f"slope = {math.degrees(at['slope']):g} deg is not within -60 to 60 deg"
            )
        return "scales on a slope"
    if "tips_at" not in at:
        return None
    if not math.radians(5.0) <= at["tips_at"] <= math.radians(130.0):
        raise InputError(
            f"tips_at = {math.degrees(at['tips_at']):g} deg is not within 5 to 130 deg"
        )
    if on == "ramp":
        return "tipped on a ramp"
    if f"{over}_radius" not in at:
        raise InputError(
            f"{over}_radius is missing: balanced on its {over} end, the robot stands on that disc"
        )
    return "balanced on its end"


def _scales(a: Mapping[str, float], front: str, rear: str) -> float:
    return float(
        plumb_position(
            m_f=a[front],
            m_r=a[rear],
            x_f=a["front_inset"],
            x_r=a["flat_length"] - a["rear_inset"],
        )
    )


_ALONG: dict[Along, Callable[..., float]] = {
    "two scales": lambda **a: _scales(a, "front_scale", "rear_scale"),
    "balance point": lambda **a: a["balance"],
}


def _height_formula(height: Height, over: End, place: Callable[..., float]) -> Callable[..., float]:
    def by_slope(**a: float) -> float:
        slope = _scales(a, "front_on_slope", "rear_on_slope")
        return float(com_height_by_slope(x_level=place(**a), x_slope=slope, phi=a["slope"]))

    def by_tipping(**a: float) -> float:
        behind = place(**a)
        arm = behind if over == "front" else a["flat_length"] - behind
        radius = a[f"{over}_radius"] if height == "balanced on its end" else 0.0
        return float(com_height_by_tipping(l_c=arm, phi=a["tips_at"], R=radius))

    return by_slope if height == "scales on a slope" else by_tipping


def _mass_formula(at: Mapping[str, float]) -> Callable[..., float] | None:
    if "mass" in at:
        return lambda **a: a["mass"]
    if "front_scale" in at and "rear_scale" in at:
        return lambda **a: a["front_scale"] + a["rear_scale"]
    if "front_on_slope" in at and "rear_on_slope" in at:
        return lambda **a: a["front_on_slope"] + a["rear_on_slope"]
    return None


def _measured(
    formula: Callable[..., float], at: Mapping[str, float], u: Mapping[str, float]
) -> Measured:
    alone = {key: combined_uncertainty(formula, at, {key: each}) for key, each in u.items()}
    whole = math.sqrt(sum(each**2 for each in alone.values()))
    shares = {key: (each / whole) ** 2 for key, each in alone.items() if each > 0}
    largest = sorted(shares, key=lambda key: -shares[key])
    return Measured(
        value=formula(**at), uncertainty=whole, shares={key: shares[key] for key in largest}
    )


def _notes(at: Mapping[str, float], u_scale: float) -> tuple[str, ...]:
    """Sums of the scales that differ by more than the scales do."""
    from kaidan.text.robot_measurement import sums_differ

    pairs = (("front_scale", "rear_scale"), ("front_on_slope", "rear_on_slope"), ("mass",))
    sums = [sum(at[key] for key in pair) for pair in pairs if all(key in at for key in pair)]
    least, most = min(sums, default=0.0), max(sums, default=0.0)
    allowed = DISAGREE * 2 * u_scale
    return (sums_differ(least, most),) if most - least > allowed else ()


def _plausible(found: RobotMeasurement) -> None:
    """Refuse what no robot is: front and rear exchanged, a slope that was none."""
    at, L = found.com_from_front.value, found.flat_length.value
    reach = max(*(radius or 0.0 for radius in found.radii_m), 0.3)
    if not -reach <= at <= L + reach:
        raise InputError(
            f"com_from_front = {1e3 * at:.0f} mm: the centroid is not above a flat of "
            f"{1e3 * L:.0f} mm; front and rear may be exchanged"
        )
    if found.com_height is None:
        return
    _, low, high = bounds(Robot.model_fields["com_height"])
    if not low <= found.com_height.value <= high:
        hint = (
            "nose up, the rear scale must show more than on the level"
            if found.height == "scales on a slope"
            else "the balance point and the angle contradict each other"
        )
        raise InputError(
            f"com_height = {1e3 * found.com_height.value:.0f} mm is not within "
            f"{1e3 * low:g} to {1e3 * high:g} mm: {hint}"
        )
