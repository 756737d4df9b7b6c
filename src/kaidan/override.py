"""Figures of a robot's sheet that a person replaces: by short names, or by dotted ones."""

from collections.abc import Mapping
from typing import Any

from pydantic.fields import FieldInfo

from kaidan.errors import InputError, did_you_mean, listed
from kaidan.robot import Robot
from kaidan.sheet import Sheet, bounds, table_of, words_of
from kaidan.units import kind_of_unit

OVERRIDES = {
    "com_from_front": "length",
    "com_height": "length",
    "flat_length": "length",
    "gauge": "length",
    "mass": "mass",
}
"""Figures of a robot's sheet that a question may replace by a short name, and what they measure."""
_IN_TRACK = ("flat_length", "gauge")


def kind_of_figure(name: str) -> str:
    """What a figure measures, by its dotted name such as track.front_radius."""
    unit = unit_of_figure(name)
    return "number" if unit == "1" else kind_of_unit(unit) or "number"


def unit_of_figure(name: str, sheet: type[Sheet] = Robot) -> str:
    """SI unit of a figure of a sheet, by its dotted name."""
    fields = _beside(name, sheet)
    unit = bounds(fields.get(_last(name)))[0]
    if unit is None:
        known = [each for each, field in fields.items() if bounds(field)[0] is not None]
        words = [each for each, field in fields.items() if words_of(field.annotation)]
        meant = did_you_mean(_last(name), [*known, *words])
        hint = f"{' K' if meant else '; k'}nown there: {listed(known)}" if known else ""
        raise InputError(f"{name!r} is no figure of a robot's sheet{meant}{hint}")
    return unit


def words_of_figure(name: str) -> tuple[str, ...]:
    """Words that a robot's sheet takes under a dotted name such as track.belt; else none."""
    field = _beside(name, Robot).get(_last(name))
    return () if field is None else words_of(field.annotation)


def _last(name: str) -> str:
    return name.rpartition(".")[2]


def _beside(name: str, sheet: type[Sheet]) -> dict[str, FieldInfo]:
    """Fields of the part of a sheet in which a dotted name is; none: there is no such part."""
    place: type[Sheet] | None = sheet
    for part in name.split(".")[:-1]:
        field = None if place is None else place.model_fields.get(part)
        place = None if field is None else table_of(field)
    return {} if place is None else place.model_fields


def paths_of(own: Mapping[str, float | str]) -> dict[str, float | str]:
    """Figures by their places in a sheet: track.flat_length for flat_length."""
    return {f"track.{name}" if name in _IN_TRACK else name: each for name, each in own.items()}


def overridden(robot: Robot, own: Mapping[str, float | str]) -> Robot:
    """Robot with the user's own figures in place of the sheet's."""
    if not own:
        return robot
    sheet = robot.model_dump()
    for name, value in paths_of(own).items():
        *path, last = name.split(".")
        place = sheet
        for part in path:
            place = place[part]
            if place is None:
                raise InputError(f"robot {robot.name!r} has no {'.'.join(path)}, so no {name}")
        place[last] = value
    if robot.com_range is not None:
        sheet["com_range"] = _narrowed(robot.com_range.model_dump(), own)
    return Robot.model_validate(sheet)


def _narrowed(stated: dict[str, Any], own: Mapping[str, float | str]) -> dict[str, Any] | None:
    """Range of a centroid of which some is stated; None where all of it is."""
    known = {"from_front": "com_from_front", "height": "com_height"}
    if all(name in own for name in known.values()):
        return None
    return {
        axis: (own[name], own[name]) if name in own else stated[axis]
        for axis, name in known.items()
    }
