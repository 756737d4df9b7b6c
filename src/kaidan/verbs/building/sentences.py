"""A building and its flights: what stands within the answer."""

from typing import TYPE_CHECKING

from kaidan.modes import Phase
from kaidan.words import end_first

if TYPE_CHECKING:
    from kaidan.verbs.building.answer import DoorShown


def hooking(robot: str, radius: float, clear: float) -> str:
    """An end of a robot that may get under a nosing."""
    return (
        f"its risers are open, up to {clear * 1e3:.0f} mm high: {robot}, with an end of "
        f"{radius * 1e3:.0f} mm radius, may hook under a nosing"
    )


def no_way(start: str) -> str:
    """No flights lead to a storey."""
    return f"no straight flights lead there from {start}."


def posture_for(flight: str, flippers: str, facing: str) -> str:
    """What to do before a flight: flippers, leading end, or both; empty what stays as it is."""
    said = [f"turn to go {end_first(facing)}"] if facing else []
    said += [f"set the flippers to {in_words(flippers)}"] if flippers else []
    return f"Before {flight} {' and '.join(said)}."


def in_words(flippers: str) -> str:
    """Postures by phase, as an option writes them, in a few words."""
    for phase, when in ((Phase.TRAVERSE, "to traverse"), (Phase.LAND, "to land")):
        flippers = flippers.replace(f"/{phase}:", f"; {when} ")
    return flippers


def door(best: "DoorShown", straight: float, needed: float) -> str:
    """Why the doors of a floor are too narrow or too low."""
    return (
        f"The widest door there leaves {best.clear_width_m * 1e3:.0f} by {best.height_m * 1e3:.0f} "
        f"mm; the robot needs {straight * 1e3:.0f} mm of width going straight, "
        f"{needed * 1e3:.0f} mm off line."
    )
