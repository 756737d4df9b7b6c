"""What a file is and what was found in it, in words: figures to confirm, doubt, reasons."""

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.verbs.read import FileAnswer
    from kaidan.verbs.read_robot import RobotRead
    from kaidan.verbs.read_stairs import FlightRead, StaircaseRead

HOW_KNOWN = {
    "file": "as the file says",
    "format": "as the format has it",
    "person": "as stated",
    "scored": "the one that makes stairs of it",
    "assumed": "assumed",
}
"""How a unit or an axis is known."""

SYMBOLS = {
    "track.flat_length": "L",
    "com_from_front": "C_L",
    "com_height": "C_N",
    "track.front_radius": "R front",
    "track.rear_radius": "R rear",
}
"""Figures that the answer of a robot depends on most."""

CONFIRM = (
    "Compare these with the robot; --override FIGURE=VALUE replaces one. Mass and centroid are "
    "best weighed (kaidan measure robot)."
)


def text(found: "FileAnswer") -> str:
    """What the file is, and everything that was found in it."""
    count = [
        f"{len(each)} {one if len(each) == 1 else many}"
        for each, one, many in (
            (found.robots, "robot", "robots"),
            (found.staircases, "staircase", "staircases"),
        )
        if each
    ]
    lines = [f"{found.file}: {found.title}, {' and '.join(count) or 'nothing to judge'}"]
    known = [
        f"{name} {fact[0]} ({HOW_KNOWN[fact[1]]})"
        for name, fact in (("unit", found.unit), ("up", found.up))
        if fact is not None
    ]
    if known:
        lines.append(f"  {', '.join(known)}")
    for robot in found.robots:
        lines += _robot(robot)
    for staircase in found.staircases:
        lines += _staircase(staircase)
    for refusal in found.refusals:
        where = " #".join(filter(None, (refusal.name, refusal.element)))
        where = f"{where}: " if where else ""
        lines.append(f"  {where}{refusal.sentence}")
    lines += [f"  {note}" for note in found.notes]
    return "\n".join(lines)


def _robot(robot: "RobotRead") -> list[str]:
    from kaidan.text.tables import table

    rows = [
        {"symbol": SYMBOLS.get(each.field, ""), "field": each.field, "value": each.shown,
         "how": each.how}
        for each in robot.figures
    ]  # fmt: skip
    heads = {"field": "figure", "symbol": "symbol", "value": "value", "how": "from"}
    lines = ["", robot.title or robot.name, table(rows, heads, below="how")]
    if robot.as_in_file:
        at = {key: f"{1e3 * value:.0f}" for key, value in robot.as_in_file.items()}
        lines.append(
            f"As the file has it, flippers included: L {at['flat_length']}, "
            f"C_L {at['com_from_front']}, C_N {at['com_height']} mm."
        )
    lines += list(robot.notes)
    return [*lines, CONFIRM]


def _staircase(staircase: "StaircaseRead") -> list[str]:
    name = staircase.name if not staircase.element else f"{staircase.name} #{staircase.element}"
    many = len(staircase.flights) > 1
    lines = ["", name]
    for number, flight in enumerate(staircase.flights, start=1):
        lines += _flight(flight, f"flight {number}" if many else "flight")
    between = [
        f"{1e3 * each.depth_m:.0f} mm deep" + (
            f", turn of {each.turn_deg:.0f} deg" if abs(each.turn_deg) > 1.0 else ""
        )
        for each in staircase.landings
        if each.depth_m is not None
    ]  # fmt: skip
    if between:
        lines.append(f"  {'landings':<10}{'; '.join(between)}")
    lines += [
        f"  {key:<10}{value}" for key, value in staircase.facts.items() if value[:1] not in "[{"
    ]
    return [*lines, *(f"  {note}" for note in staircase.notes)]


def _flight(flight: "FlightRead", name: str) -> list[str]:
    if flight.rise_m is None or flight.going_m is None:
        lines = [f"  {name:<10}one step of {_mm(flight.nosings[0][1])}"]
    elif not (flight.rise_sigma_m or flight.going_sigma_m):
        lines = [
            f"  {name:<10}{flight.steps} steps, rise {_mm(flight.rise_m)}, going "
            f"{_mm(flight.going_m)}, as drawn",
            f"  {'':<10}{flight.angle_deg:.2f} deg, nosing to nosing {_mm(flight.spacing_m)}",
        ]
    else:
        lines = [
            f"  {name:<10}{flight.steps} steps, rise {_mm(flight.rise_m)}, going "
            f"{_mm(flight.going_m)}, single steps +- {_mm(flight.rise_sigma_m)} and "
            f"{_mm(flight.going_sigma_m)}",
            f"  {'':<10}{flight.angle_deg:.2f} +- {flight.angle_sigma_deg:.2f} deg, nosing to "
            f"nosing {_mm(flight.spacing_m)} +- {_mm(flight.spacing_sigma_m)}",
        ]
    ends = [
        f"{label} {_mm(value)}"
        for label, value in (
            ("first riser", flight.first_rise_m),
            ("last riser", flight.last_rise_m),
        )
        if value is not None
    ]
    if ends:
        lines.append(f"  {'':<10}{', '.join(ends)}")
    seen = [
        f"{label} {_mm(value)}"
        for label, value in (("clear width", flight.width_m), ("headroom", flight.headroom_m))
        if value is not None
    ]
    if flight.roughness_m:
        seen.append(f"scatter {_mm(flight.roughness_m)}")
    if not flight.floor_seen:
        seen.append("lower floor not seen")
    if not flight.landing_seen:
        seen.append("upper landing not seen")
    if seen:
        lines.append(f"  {'':<10}{', '.join(seen)}")
    lines += [f"  {'':<10}{note}" for note in flight.notes]
    if flight.no_sheet:
        lines.append(f"  {'':<10}no sheet: {flight.no_sheet}")
    return lines


def _mm(length: float | None) -> str:
    return "-" if length is None or not math.isfinite(length) else f"{1e3 * length:.1f} mm"
