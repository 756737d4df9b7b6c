"""What to do, in words."""

import math
from collections.abc import Sequence

from kaidan.models.sentences.traction import usual

STRAIGHT = "Head straight along the stairs"
STEADY = "Keep the speed constant"
FLAT = "Lay the flippers flat, in line with the track"

STOWED = "Stow the flippers on the landings, 100 mm clear of the nosings"


def turned_round(direction: str, facing: str) -> str:
    """Go with the other end first."""
    return f"Go {direction} {facing.replace('-', ' ')}"


def raised(end: str, angle: float) -> str:
    """Raise a pair of flippers to an angle [rad]."""
    return f"Raise the {end} flippers to {math.degrees(angle):.0f} deg"


def set_closer(tolerance: float) -> str:
    """Set the flippers to their angles within some tolerance [rad]."""
    return f"Keep the flippers within {math.degrees(tolerance):.3g} deg of their angles"


def friction(enough: float, *, known: bool) -> str:
    """Have a friction [1]."""
    if known:
        return f"A surface with a friction of {enough:.2f} or more"
    return f"Make sure of a friction of {enough:.2f} or more"


def grousers() -> str:
    """Have belts with grousers."""
    return f"Belts with {usual()}"


def state_grousers() -> str:
    """State that the belts have grousers, in the robot's sheet or instead of it."""
    return "If its belts have grousers, state it (track.belt=grousers)"


def with_another_plan(change: str) -> str:
    """A change after which another plan is the best."""
    return f"{change}, with another plan"


def nosings(radius: int) -> str:
    """Have round nosings of at most some radius [mm]."""
    return f"Make sure that the nosings' radius is {radius} mm or less"


def slower(speed: float) -> str:
    """Drive at a speed [m/s]."""
    return f"Drive at {speed:.2f} m/s or less"


def measured(names: Sequence[str]) -> str:
    """Measure allowances."""
    zero = "it is" if len(names) == 1 else "they are"
    return f"Measure {' and '.join(names)}: at best, if {zero} zero"


def centroid(shift: float, end: str, *, of_payload: float | None) -> str:
    """Move the centroid [m], or the payload with it [m]."""
    text = f"Move the centroid {1e3 * shift:.0f} mm towards the {end}"
    return text if of_payload is None else f"{text} (the payload by {1e3 * of_payload:.0f} mm)"
