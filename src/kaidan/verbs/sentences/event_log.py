"""What each entry of the event log says."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.traversal.event_log import Place


def where(place: "Place") -> str:
    """Name and number of a place: "nosing 3"."""
    return place.what if place.number is None else f"{place.what} {place.number}"


def touched(place: "Place") -> str:
    """The same, with the part of the robot that touches it, unless that is its track."""
    return where(place) if place.part == "track" else f"{where(place)} ({place.part})"


def sentence(
    kind: str,
    places: "Sequence[Place]",
    end: str | None,
    rotation_deg: float = 0.0,
    topples_with_momentum: bool = False,
) -> str:
    """What an entry says.

    kind: as `kaidan.traversal.event_log.LogEntry` has it.
    places: what it leads to, then what it comes from.
    rotation_deg: angle of a rotation [deg].
    """
    if kind == "arrives":
        return "stands on the landing"
    first = places[0]
    if kind in ("reached", "left"):
        return f"{where(first)} {'comes under' if kind == 'reached' else 'leaves'} the {first.part}"
    if kind in ("rests", "passes"):
        other = places[1]
        if (first.what, first.number) == (other.what, other.number) and first.part != other.part:
            return f"contact passes from {other.part} to {first.part}, on {where(other)}"
        if kind == "rests":
            return f"{end} comes to rest on {touched(first)}, off {touched(other)}"
        return f"contact passes from {touched(other)} to {touched(first)}"
    if kind in ("drops", "rises"):
        text = (
            f"{end} {kind} by {rotation_deg:.1f} deg about {touched(places[1])}, arrested by "
            f"{touched(first)}"
        )
        return text + ("; the momentum topples it" if topples_with_momentum else "")
    if kind == "falls":
        return f"falls over its {end}, about {touched(first)}"
    if kind == "stuck":
        return f"is stuck on {touched(first)}"
    return "the solver set it down again, within 10 mm"


def change(
    posture: str, turn_deg: float, time_s: float | None, torque_Nm: float, *, stands: bool
) -> str:
    """What the change to another posture says; a torque of NaN is not known."""
    if not stands:
        return f"does not stand while its posture changes to {posture}"
    time = "time not known" if time_s is None else f"{time_s:.1f} s"
    torque = "" if torque_Nm != torque_Nm else f", {torque_Nm:.0f} N m"
    return f"stands, changes its posture to {posture} ({turn_deg:.0f} deg, {time}{torque})"
