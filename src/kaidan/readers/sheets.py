"""Files where a question expects a name: the one robot or the one staircase that a file holds."""

from pathlib import Path

from kaidan.errors import InputError, RefusedError, short
from kaidan.readers import NO_HINTS, found_in
from kaidan.readers.estimate import Found, StairsEstimate
from kaidan.readers.hints import Hints
from kaidan.readers.opening import Source, split_element
from kaidan.readers.recognition import known
from kaidan.readers.robots.estimate import RobotEstimate
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs

MOST_NAMES = 8
"""Parts of a file that an error lists."""


def robot_sheet(name: str, hints: Hints = NO_HINTS) -> Robot | None:
    """Data sheet of the one robot in a file; None: the name is of no file of a known format.

    name: path, or ``path#part``.
    """
    found = _found(name, hints)
    return None if found is None else the_robot(found, name).robot()


def staircase_sheets(name: str, hints: Hints = NO_HINTS) -> tuple[Stairs, ...] | None:
    """Data sheets of the flights of the one staircase in a file, from bottom to top.

    What the reader must know of them stands in their notes. See `robot_sheet`.
    """
    found = _found(name, hints)
    if found is None:
        return None
    stairs = the_staircase(found, name)
    whole = " ".join((*found.provenance.notes, *stairs.notes))
    said = [" ".join(note for note in each.notes if note not in whole) for each in stairs.flights]
    return tuple(
        sheet.model_copy(update={"notes": " ".join(filter(None, (first, notes, sheet.notes)))})
        for sheet, notes, first in zip(
            stairs.stairs(), said, (whole, *[""] * (len(said) - 1)), strict=True
        )
    )


def the_robot(found: Found, name: str) -> RobotEstimate:
    """The one robot that was found."""
    if not found.robots:
        raise _without(found, name, "a robot", "stairs" if found.staircases else "")
    robot: RobotEstimate = found.robots[0]
    return robot


def the_staircase(found: Found, name: str) -> StairsEstimate:
    """The one staircase that was found."""
    if not found.staircases:
        raise _without(found, name, "stairs", "a robot" if found.robots else "")
    if len(found.staircases) > 1:
        parts = [each.provenance.element or each.name for each in found.staircases]
        more = f" and {len(parts) - MOST_NAMES} more" if len(parts) > MOST_NAMES else ""
        raise InputError(
            f"{short(name)}: holds {len(parts)} staircases; write FILE#PART with one of "
            f"{', '.join(short(part) for part in parts[:MOST_NAMES])}{more}"
        )
    return found.staircases[0]


def _found(name: str, hints: Hints) -> Found | None:
    path, element = split_element(name)
    try:
        if not path or not Path(path).exists() or known(Source.of(path)) is None:
            return None
    except (OSError, ValueError):
        return None
    return found_in(path, replace_element(hints, element))


def replace_element(hints: Hints, element: str) -> Hints:
    """Hints with the part of the file that its name states."""
    return Hints(**dict(hints) | {"element": element}) if element else hints


def _without(found: Found, name: str, what: str, other: str) -> InputError:
    if other:
        return InputError(f"{short(name)}: holds {other}, not {what}")
    why = " ".join(dict.fromkeys(str(each) for each in found.refusals[:3]))
    return RefusedError(f"{short(name)}: holds no {what.removeprefix('a ')}: {why}")
