"""Keywords of a body as sheets, ranges and postures: names of the catalogue and tables, no path."""

from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeVar

from kaidan import catalog
from kaidan.arguments import refuse_unknown
from kaidan.errors import InputError, UnknownNameError, shown
from kaidan.robot import Payload, Posture, PostureChange, Robot
from kaidan.spelling import JOINT
from kaidan.surface import Surface
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.units import range_of

_Sheet = TypeVar("_Sheet", Robot, Stairs, Surface)
_CATALOGUES: dict[type[Any], tuple[catalog.Folder, ...]] = {
    Robot: ("robots", "unweighed"),
    Stairs: ("stairs",),
    Surface: ("surfaces",),
}


def made(values: Mapping[str, Any], several: Collection[str] = ()) -> dict[str, Any]:
    """Keywords with sheets for what is more than a number or a text."""
    return {
        name: READ[name](value, name in several) if name in READ else value
        for name, value in values.items()
    }


def robot_of(given: Any, many: bool = False) -> Any:
    """Robot of a name or a table; several where many are allowed."""
    if many and isinstance(given, list):
        return [robot_of(each) for each in given]
    return sheet_of(given, Robot)


def _stairs(given: Any, many: bool = False) -> Any:
    """Flight, flights from bottom to top or profile, of names, tables or points.

    Where many are allowed a list is that many.
    """
    if isinstance(given, str) and JOINT in given:
        return tuple(sheet_of(each, Stairs) for each in given.split(JOINT))
    if isinstance(given, list):
        if not many and given and all(isinstance(each, list) for each in given):
            return Profile.of_points(given)
        found = [_stairs(each) if many else sheet_of(each, Stairs) for each in given]
        return found if many else tuple(found)
    if isinstance(given, Mapping) and "points" in given:
        return Profile.from_dict(given)
    if isinstance(given, Mapping) and given.keys() >= {"angle", "nosing_spacing"}:
        refuse_unknown("stairs", given, ("angle", "nosing_spacing", "steps"))
        return Stairs.inclined(**given)
    return sheet_of(given, Stairs)


def _surface(given: Any, many: bool = False) -> Any:
    """Surface of a name or a table; several where many are allowed."""
    if many and isinstance(given, list):
        return [_surface(each) for each in given]
    return sheet_of(given, Surface)


def sheet_of(given: Any, kind: type[_Sheet]) -> _Sheet:
    """Sheet of a name of the catalogue or a table."""
    if isinstance(given, Mapping):
        return kind.model_validate(given)
    if not isinstance(given, str):
        raise InputError(
            f"{kind.label} = {shown(given)} is not a name of the catalogue or a {kind.label} sheet"
        )
    stem = given.strip().lower()
    known = [name for folder in _CATALOGUES[kind] for name in catalog.names(folder)]
    if stem not in known and not (kind is Robot and stem in catalog.gross_robots()):
        raise UnknownNameError(kind.label, given, known)
    return kind.named(stem)


def _flippers(given: Any, many: bool) -> Any:
    if many and isinstance(given, list):
        return given
    if isinstance(given, Mapping):
        return Posture.model_validate(given)
    if isinstance(given, list) and given:
        changes = (PostureChange.model_validate(each) for each in given[1:])
        return (Posture.model_validate(given[0]), *changes)
    return given


def _limits(given: Any, many: bool) -> Any:
    return range_of(given, "angle", option="limits")


def _payload(given: Any, many: bool) -> Any:
    if isinstance(given, Mapping):
        return Payload.model_validate(given)
    if isinstance(given, list):
        return [_payload(each, many) for each in given]
    return given


READ: Mapping[str, Callable[[Any, bool], Any]] = {
    "robot": robot_of,
    "robots": robot_of,
    "stairs": _stairs,
    "surface": _surface,
    "flippers": _flippers,
    "payload": _payload,
    "limits": _limits,
}
"""What becomes of those that are more than a number or a text."""
