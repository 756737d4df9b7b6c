"""Stairs of a building: what is not judged, and where a model contradicts itself."""

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.readers.solids.stated import Stated

OTHER_ANGLE = "sheets know turns of 90 and 180 deg (kaidan building judges any in a model)"
"""Why a turn by another angle is not judged."""


def not_judged(turn: float, below: str, why: str) -> str:
    """Why a turn that was seen between two flights is not in their sheets.

    turn: to the left positive [rad].
    """
    return (
        f"On the landing above {below} the way turns by {math.degrees(abs(turn)):.0f} deg, which "
        f"is not judged: {why}. Measure that landing."
    )


def disagreement(one: "Stated") -> str:
    """A stated figure that no unit makes the measured one, with both numbers."""
    if one.quantity in ("height", "finish"):
        said = f"drawn {one.measured:.2f} m, stated {one.value:.2f} m ({one.name})"
        return f"{said}: floor finish missing?" if one.quantity == "finish" else said
    if one.quantity in ("risers", "treads"):
        return f"{one.name} states {one.value:.0f} {one.quantity}, {one.measured:.0f} are drawn"
    return (
        f"{one.name} states {one.value:g}, which is {one.in_model_unit * 1e3:.1f} mm in the unit "
        f"of the model; {one.measured * 1e3:.1f} mm are drawn"
    )
