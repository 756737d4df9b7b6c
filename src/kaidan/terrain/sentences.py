"""Gaps in a flight or its landings, and floors that nobody found, as sentences."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.terrain.gap import Gap

FLOOR_UNSEEN = (
    "The floor before the first riser was not seen: the flight may begin lower, and its first "
    "riser is assumed to be like the others."
)
_SAME = 1e-6
"""Length that is rounding [m]."""
_AT = 0.05
"""Distance up to which a floor ends at a nosing [m]."""


def stated(gap: "Gap", nosings: Sequence[float]) -> str:
    """A gap as a fact of the flight whose nosings are at these places [m]."""
    said = in_words(gap, nosings)
    return f"{said[0].upper()}{said[1:]}."


def in_words(gap: "Gap", nosings: Sequence[float]) -> str:
    """The same as a part of a sentence."""
    where = place(gap, nosings)
    if gap.length is None:
        return f"no floor was found {where}"
    return f"a gap of {gap.length * 1e3:.0f} mm, {gap.depth:.2f} m deep, lies {where}"


def reason(gap: "Gap", nosings: Sequence[float], end: float) -> str:
    """Why a gap is no GO for a robot whose narrowest end has a diameter [m]."""
    where = place(gap, nosings)
    if gap.length is None:
        return f"No floor was found {where}: look there before you drive."
    return (
        f"A gap of {gap.length * 1e3:.0f} mm lies {where}: an end of the robot, {end * 1e3:.0f} mm "
        "across, may drop in."
    )


def place(gap: "Gap", nosings: Sequence[float]) -> str:
    """Where it lies: "before step 3"; where its floor ends, if that is not at a nosing."""
    if gap.start is None or (gap.end is not None and gap.end <= nosings[0] + _SAME):
        away = nosings[0] - (gap.end or 0.0)
        far = gap.start is None and away >= _AT
        return f"from {away:.2f} m before the first riser on" if far else "before the first riser"
    if gap.end is None:
        away = gap.start - nosings[-1]
        return (
            f"from {away:.2f} m behind the last nosing on" if away >= _AT
            else "behind the last nosing"
        )  # fmt: skip
    behind = sum(each < gap.end - _SAME for each in nosings)
    return "behind the last nosing" if behind == len(nosings) else f"before step {behind + 1}"
