"""What people state of a robot that they weigh, and how mass and centroid follow from it."""

import math
from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple

from kaidan.errors import InputError
from kaidan.mechanics.weighing import (
    com_height_by_slope,
    com_height_by_tipping,
    plumb_position,
)
from kaidan.robot import Robot, Track
from kaidan.sheet import bounds
from kaidan.units import value_of

GENTLEST = math.radians(3.0)
"""Gentlest slope that says anything of the height of the centroid [rad]."""
Along = Literal["two scales", "balance point"]
Height = Literal["scales on a slope", "balanced on its end", "tipped on a ramp"]
End = Literal["front", "rear"]
Way = Literal["end", "ramp"]


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
INPUTS = {
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
    "u_scale": _Input("mass", 0.0, 20.0, "scale"),
    "u_tape": _Input("length", 0.0, 0.1, "tape"),
    "u_angle": _Input("angle", 0.0, math.radians(5.0), "angle"),
}
"""With the standard uncertainties of the tools; larger ones are mistakes."""


def stated_value(key: str, given: Any) -> float:
    """What was given for one of `INPUTS`, in SI, within its bounds."""
    wanted = INPUTS[key]
    value = value_of(given, wanted.kind, option=key)
    if not wanted.low <= value <= wanted.high:
        unit = {"mass": "kg", "length": "m", "angle": "rad"}[wanted.kind]
        raise InputError(
            f"{key} = {value:g} {unit} is not within {wanted.low:g} to {wanted.high:g} {unit}"
        )
    return value


def way_along(at: Mapping[str, float]) -> Along:
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


def way_up(at: Mapping[str, float], over: End, on: Way) -> Height | None:
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


ALONG: dict[Along, Callable[..., float]] = {
    "two scales": lambda **a: _scales(a, "front_scale", "rear_scale"),
    "balance point": lambda **a: a["balance"],
}


def height_formula(height: Height, over: End, place: Callable[..., float]) -> Callable[..., float]:
    """C_N as a function of `INPUTS`, C_L being *place* of them [m]."""

    def by_slope(**a: float) -> float:
        slope = _scales(a, "front_on_slope", "rear_on_slope")
        return float(com_height_by_slope(x_level=place(**a), x_slope=slope, phi=a["slope"]))

    def by_tipping(**a: float) -> float:
        behind = place(**a)
        arm = behind if over == "front" else a["flat_length"] - behind
        radius = a[f"{over}_radius"] if height == "balanced on its end" else 0.0
        return float(com_height_by_tipping(l_c=arm, phi=a["tips_at"], R=radius))

    return by_slope if height == "scales on a slope" else by_tipping


def mass_formula(at: Mapping[str, float]) -> Callable[..., float] | None:
    """Mass as a function of `INPUTS` [kg]; None: nothing says it."""
    if "mass" in at:
        return lambda **a: a["mass"]
    if "front_scale" in at and "rear_scale" in at:
        return lambda **a: a["front_scale"] + a["rear_scale"]
    if "front_on_slope" in at and "rear_on_slope" in at:
        return lambda **a: a["front_on_slope"] + a["rear_on_slope"]
    return None
