"""What was measured of a robot, with its doubt, and how to measure it better."""

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.verbs.measure_robot import Measured, RobotMeasurement

SHOWN = {
    "flat_length": "the length L",
    "front_scale": "the front scale",
    "rear_scale": "the rear scale",
    "balance": "the balance point",
    "mass": "the scale",
    "slope": "the angle of the slope",
    "front_on_slope": "the front scale on the slope",
    "rear_on_slope": "the rear scale on the slope",
    "tips_at": "the angle at which it tips",
    "front_radius": "the front radius",
    "rear_radius": "the rear radius",
    "front_inset": "the place of the front support",
    "rear_inset": "the place of the rear support",
}
"""Inputs as people call them."""


def text(found: "RobotMeasurement") -> str:
    """Figures with their doubt, what the doubt comes from, and what is missing."""
    lines = [f"{found.name}, measured"]
    if found.mass is not None:
        lines.append(_row("mass", f"{found.mass.value:.2f} +- {found.mass.uncertainty:.2f} kg"))
    else:
        lines.append(_row("mass", "not known"))
    lines.append(_row("L", _length(found.flat_length)))
    lines.append(_row("C_L", f"{_length(found.com_from_front)}, by {_along(found)}"))
    lines.append(_row("", _largest(found.com_from_front)))
    if found.com_height is None:
        lines.append(
            _row("C_N", "not known: weigh it again on a slope, or find the angle at which it tips")
        )
    else:
        lines.append(_row("C_N", f"{_length(found.com_height)}, by {_height(found)}"))
        lines.append(_row("", _largest(found.com_height)))
    missing = [
        f"{end} end radius R"
        for end, radius in zip(("front", "rear"), found.radii_m, strict=True)
        if radius is None
    ]
    if missing:
        lines.append(_row("not stated", ", ".join(missing)))
    return "\n".join([*lines, *(f"  {note}" for note in found.notes)])


def source(found: "RobotMeasurement", name: str) -> str:
    """Where a figure of the sheet comes from, with its status letter."""
    how = {
        "mass": "on a scale",
        "track.flat_length": "by tape",
        "radius": "by tape",
        "com_from_front": f"by {_along(found)}",
        "com_height": f"by {_height(found)}",
    }[name]
    return f"V: measured {how} (kaidan measure robot)"


def _row(name: str, value: str) -> str:
    return f"  {name:<12}{value}"


def _length(one: "Measured") -> str:
    return f"{1e3 * one.value:.1f} +- {1e3 * one.uncertainty:.1f} mm"


def _largest(one: "Measured") -> str:
    """What most of the doubt comes from."""
    key, share = next(iter(one.shares.items()), ("", 0.0))
    return f"{100 * share:.0f} % of its doubt is {SHOWN[key]}" if key else "taken as exact"


def _along(found: "RobotMeasurement") -> str:
    if found.along == "balance point":
        return "its balance point"
    front, rear = found.inputs["front_scale"], found.inputs["rear_scale"]
    return f"two scales, front {front:.2f} kg, rear {rear:.2f} kg"


def _height(found: "RobotMeasurement") -> str:
    at = found.inputs
    if found.height == "scales on a slope":
        return (
            f"the scales on a slope of {math.degrees(at['slope']):.1f} deg, front "
            f"{at['front_on_slope']:.2f} kg, rear {at['rear_on_slope']:.2f} kg"
        )
    angle = math.degrees(at["tips_at"]) if "tips_at" in at else math.nan
    does = "balances on" if found.height == "balanced on its end" else "tips on a ramp over"
    return f"the {angle:.1f} deg at which it {does} its {found.over} end"
