"""What can be varied of a question, by name, and the question of such values.

Every argument of `kaidan.Question.of`; the robot's own figures (`com_height`, as in ``override``);
the shape of uniform stairs (`rise`, `steps`); any figure of the robot's sheet by its dotted name
(`track.front_radius`, `front_flippers.length`); and those of its one payload (`payload.height`).
"""

import math
from collections.abc import Mapping
from functools import cache
from typing import Any, NamedTuple

from kaidan.errors import InputError, did_you_mean, listed, shown
from kaidan.override import OVERRIDES, unit_of_figure
from kaidan.question import Question
from kaidan.robot import Payload, Robot
from kaidan.spelling import own_figures, payloads_of, sheet_of, surface_of, terrain_of
from kaidan.terrain.stairs import Stairs
from kaidan.units import kind_of_unit

WORDS = (
    "robot",
    "stairs",
    "surface",
    "direction",
    "facing",
    "flippers",
    "payload",
    "model",
    "uniform_across",
    "override",
    "uncertainty",
)
"""Arguments of a question that are no numbers."""
NUMBERS = {
    "friction": "number",
    "acceleration": "acceleration",
    "speed": "speed",
    "theta_d": "angle",
    "theta_M": "angle",
    "fall_reserve": "angle",
    "flipper_tolerance": "angle",
    "yaw": "angle",
    "risk": "number",
}
"""Arguments of a question that are numbers, and what they measure."""
SHAPE = {
    "rise": "length",
    "going": "length",
    "angle": "angle",
    "nosing_spacing": "length",
    "steps": "number",
    "lower_landing": "length",
    "upper_landing": "length",
    "lower_leaf": "length",
    "upper_leaf": "length",
    "lower_landing_width": "length",
    "upper_landing_width": "length",
    "lower_passage": "length",
    "upper_passage": "length",
    "width": "length",
    "headroom": "length",
}
"""Figures of uniform stairs, and what they measure."""
UNITS = {
    "number": "1",
    "length": "m",
    "angle": "rad",
    "mass": "kg",
    "acceleration": "m/s^2",
    "speed": "m/s",
}
"""SI unit of each of these kinds."""
UNDRIVEN = frozenset(("surface", "friction", "theta_d", "theta_M", "risk", "fall_reserve", "speed"))
"""Parameters that play no part in how the robot moves: cells that differ in them alone share a
traverse."""
_PAYLOAD = "payload"


class Parameter(NamedTuple):
    """Something of a question that can be varied."""

    name: str
    kind: str | None
    """What it measures, as `kaidan.units` has it; None: a word or a sheet."""
    unit: str
    """SI unit; empty for words."""


@cache
def parameter(name: str) -> Parameter:
    """Parameter of a name.

    Examples
    --------
    >>> parameter("front_flippers.length")
    Parameter(name='front_flippers.length', kind='length', unit='m')
    """
    if name in WORDS:
        return Parameter(name, None, "")
    kind = (NUMBERS | OVERRIDES | SHAPE).get(name)
    if kind is not None:
        return Parameter(name, kind, UNITS[kind])
    if "." in name:
        of, _, field = name.partition(".")
        unit = unit_of_figure(field, Payload) if of == _PAYLOAD else unit_of_figure(name)
        return Parameter(name, "number" if unit == "1" else kind_of_unit(unit), unit)
    known = (*NUMBERS, *OVERRIDES, *SHAPE, *WORDS)
    raise InputError(
        f"unknown parameter {shown(name)}; known: {listed(known)}, and figures of the robot's "
        f"sheet such as track.front_radius or payload.height{did_you_mean(name, known)}"
    )


def settled(name: str, value: Any) -> Any:
    """Value with sheets in place of their names and files, so that it says the same elsewhere."""
    if value is None:
        return None
    if name == "robot":
        return sheet_of(value, Robot)
    if name == "stairs":
        return terrain_of(value)
    if name == "surface":
        return surface_of(value, None, {})
    if name == _PAYLOAD:
        return tuple(payloads_of(value))
    return value


def question_of(values: Mapping[str, Any]) -> Question:
    """Question of values by the names of parameters.

    Parameters
    ----------
    values : mapping of str to object
        `robot`, and `stairs` unless the shape is given whole; anything else is optional.

    Raises
    ------
    InputError
        Values that contradict each other, or are without physical meaning.

    Examples
    --------
    >>> question = question_of({"robot": "kenaf", "rise": 0.15, "going": 0.3, "com_height": 0.1})
    >>> question.robot.com_height, question.terrain.rise
    (0.1, 0.15)
    """
    rest = dict(values)
    own = {name: rest.pop(name) for name in OVERRIDES if name in rest}
    shape = {name: rest.pop(name) for name in SHAPE if name in rest}
    dotted = {name: rest.pop(name) for name in list(rest) if "." in name}
    robot, stairs = rest.pop("robot"), rest.pop("stairs", None)
    for name, value in dotted.items():
        if name.startswith(f"{_PAYLOAD}."):
            rest[_PAYLOAD] = _moved(rest.get(_PAYLOAD), name, value)
        else:
            own[name] = value
    if own:
        rest["override"] = own_figures(rest.get("override", ())) | own
    return Question.of(robot, shaped(stairs, shape), **rest)


def _moved(payload: Any, name: str, value: float) -> tuple[Payload, ...]:
    """The one payload with a figure replaced."""
    each = tuple(payloads_of(payload))
    if len(each) != 1:
        raise InputError(f"{name} needs one payload, not {len(each)}: give one, 5kg@200mm,300mm")
    return (Payload.model_validate(dict(each[0]) | {name.partition(".")[2]: value}),)


def shaped(stairs: Any, shape: Mapping[str, Any]) -> Any:
    """Stairs with another shape, or of a shape alone."""
    if not shape:
        return stairs
    sides, slope = shape.keys() & {"rise", "going"}, shape.keys() & {"angle", "nosing_spacing"}
    if sides and slope:
        raise InputError("vary either rise and going or angle and nosing_spacing, not both")
    if stairs is None:
        if len(sides) != 2 and len(slope) != 2:
            raise InputError("no stairs: give them, or rise and going, or angle and nosing_spacing")
        stated: dict[str, Any] = {}
        angle, spacing = 0.0, 0.0
    else:
        flight = sheet_of(stairs, Stairs)
        if flight.rise is None:
            raise InputError(
                f"stairs {flight.name!r} are not uniform; their shape cannot be varied"
            )
        stated = {name: getattr(flight, name) for name in flight.model_fields_set}
        angle, spacing = flight.angle, flight.nosing_spacing
    changes = {name: value for name, value in shape.items() if name not in slope}
    if "steps" in changes:
        changes["steps"] = round(changes["steps"])
    if slope:
        angle, spacing = shape.get("angle", angle), shape.get("nosing_spacing", spacing)
        changes |= {"rise": spacing * math.sin(angle), "going": spacing * math.cos(angle)}
    return Stairs(**stated | changes)


def value_now(values: Mapping[str, Any], name: str) -> float | None:
    """Value that a parameter has as it stands; None where the sheet or the question has none.

    values: as `question_of` takes them.

    Examples
    --------
    >>> value_now({"robot": "kenaf", "stairs": "ibc"}, "flat_length")
    0.47
    """
    if name in values:
        return None if isinstance(values[name], tuple) else float(values[name])
    if name in SHAPE and values.get("stairs") is None:
        return None
    if name in SHAPE:
        flight = sheet_of(values["stairs"], Stairs)
        return None if flight.rise is None else float(getattr(flight, name))
    if name in NUMBERS:
        return None
    own = own_figures(values.get("override", ()))
    if name in own:
        return float(own[name])
    place: Any = sheet_of(values["robot"], Robot)
    path = name.split(".")
    if path[0] == _PAYLOAD:
        each = tuple(payloads_of(values.get(_PAYLOAD, ())))
        return float(getattr(each[0], path[1])) if len(each) == 1 else None
    if name in ("flat_length", "gauge"):
        place = place.track
    for part in path:
        place = getattr(place, part, None)
    return None if place is None else float(place)
