"""A building and its flights, as text."""

from collections import Counter
from typing import TYPE_CHECKING, Any

from kaidan.modes import Phase, Verdict
from kaidan.text.comparison import SIGNS, short
from kaidan.text.tables import table
from kaidan.text.words import end_first

if TYPE_CHECKING:
    from kaidan.readers.solids.stated import Stated
    from kaidan.verbs.building.answer import (
        BuildingAnswer,
        CellShown,
        DoorShown,
        ElementShown,
        FlightShown,
        WayShown,
    )

_HEADS = {
    "flight": "flight",
    "storey": "storey",
    "steps": "n",
    "rise_m": "rise",
    "first_rise_m": "first",
    "last_rise_m": "last",
    "going_m": "going",
    "angle_deg": "[deg]",
    "width_m": "width",
    "headroom_m": "headroom",
}

OUTCOMES = ("judged", "judged in part", "refused", "not understood")
"""What may have become of an element, the best first."""


def text(found: "BuildingAnswer") -> str:
    """The flights and their verdicts as a table, then the ways to each storey."""
    lines = [heading(found), *filter(None, [account(found)])]
    if found.flights:
        lines += ["", _table(found), "", key(), *(f"  {each}" for each in plans(found))]
    for each in found.flights:
        lines += [f"  {each.name}: {note}." for note in each.notes]
    if found.ways:
        lines += ["", f"Ways from {found.start}"]
    for robot in found.robots:
        for way in found.ways:
            if way.robot == robot:
                lines += way_lines(found, way)
    said = not_judged(found)
    lines += ["", "Not judged", *(f"  {each}" for each in said)] if said else []
    lines += [f"Note: {each}{'' if each.endswith('?') else '.'}" for each in notes(found)]
    return "\n".join(lines)


def heading(found: "BuildingAnswer") -> str:
    """What was read, and what holds for all of it."""
    ground = found.surface or "friction not stated"
    flights = _count(len(found.flights), "straight flight")
    return (
        f"{found.path}: {found.ifc_schema}, {_count(len(found.storeys), 'storey')}, {flights}; "
        f"going {found.direction}, {ground}"
    )


def account(found: "BuildingAnswer") -> str:
    """How many elements for going up there are, and what became of them; empty: there are none."""
    if not found.elements:
        return ""
    kinds = Counter(each.kind or "other element" for each in found.elements)
    outcomes = Counter(str(each.outcome) for each in found.elements)
    parts = ", ".join(_count(number, kind) for kind, number in kinds.items())
    became = ", ".join(f"{outcomes[name]} {name}" for name in OUTCOMES if outcomes[name])
    return f"{parts}: {became}"


def not_judged(found: "BuildingAnswer") -> list[str]:
    """Elements that are not judged, or not all of them, each with its reason."""
    return [f"{named(each)}: {why}" for each in found.elements for why in each.reasons]


def named(element: "ElementShown") -> str:
    """Name of an element, what it is, and its GlobalId."""
    return f"{element.name} ({element.kind or element.category}, {element.identity})"


def notes(found: "BuildingAnswer") -> list[str]:
    """What was repaired in the file, and what elements state otherwise than they are drawn."""
    return [
        *found.notes,
        *(f"{each.name}: {note}" for each in found.elements for note in each.notes),
    ]


def key() -> str:
    """What the signs of the table mean."""
    signs = ", ".join(f"{sign} {short(verdict)}" for verdict, sign in SIGNS.items())
    return f"{signs} the model. Lengths in mm; number: smallest margin [deg], in the worst case."


def plans(found: "BuildingAnswer") -> list[str]:
    """Plans by phase, or with the tail first, one line for all flights that a robot takes so."""
    names = {each.identity: each.name for each in found.flights}
    groups: dict[tuple[str, str, str], list[str]] = {}
    for cell in found.cells:
        if not _plain(cell):
            plan = (cell.robot, cell.facing, cell.flippers)
            groups.setdefault(plan, []).append(names[cell.flight])
    return [
        f"{robot} on {', '.join(flights)}: "
        f"{'; '.join(filter(None, (end_first(facing), in_words(flippers))))}"
        for (robot, facing, flippers), flights in groups.items()
    ]


def _plain(cell: "CellShown") -> bool:
    """Whether a column's head tells the posture."""
    return "/" not in cell.flippers and cell.facing == "nose-first"


def way_lines(found: "BuildingAnswer", way: "WayShown") -> list[str]:
    """A way in one line, and one more for each change of posture."""
    if way.verdict is None:
        return [f"  {way.robot} to {way.storey}: {way.reason}"]
    names = {each.identity: each.name for each in found.flights}
    by = ", ".join(names[each] for each in way.flights)
    lines = [
        f"  {way.robot} to {way.storey}: {way.verdict.label} by {by}; {way.binds} decides "
        f"({way.where}). {way.reason}"
    ]
    return lines + [f"    {each}" for each in way.postures]


def steps_of(flight: "FlightShown") -> str:
    """Steps of a flight in a few words."""
    width, headroom = flight.width_m * 1e3, flight.headroom_m
    above = "" if headroom is None else f", headroom {headroom * 1e3:.0f}"
    first = "not drawn" if flight.first_rise_m is None else f"{flight.first_rise_m * 1e3:.1f}"
    return (
        f"{flight.steps} risers of {flight.rise_m * 1e3:.1f} by {flight.going_m * 1e3:.1f} mm, "
        f"first {first}, last {flight.last_rise_m * 1e3:.1f} mm, {flight.angle_deg:.1f} deg, "
        f"width {width:.0f}{above} mm"
    )


def cell_text(cell: "CellShown") -> str:
    """Verdict of a pair in a cell."""
    number = "" if cell.margin_deg is None else f" {cell.margin_deg:+.1f}"
    decides = "" if cell.verdict is Verdict.GO else f" {cell.binds}"
    return f"{SIGNS[cell.verdict]} {short(cell.verdict)}{number}{decides}"


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


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _table(found: "BuildingAnswer") -> str:
    wide = len(found.robots)
    rows = []
    for number, flight in enumerate(found.flights):
        row: dict[str, Any] = {"flight": flight.name}
        row |= {name: getattr(flight, name) for name in list(_HEADS)[1:]}
        cells = found.cells[number * wide : (number + 1) * wide]
        rows.append(row | {cell.robot: cell_text(cell) for cell in cells})
    heads = {}
    for name in found.robots:
        of_robot = [cell for cell in found.cells if cell.robot == name]
        one, *others = {cell.flippers if _plain(cell) else "" for cell in of_robot}
        heads[name] = f"{name} ({one})" if one and not others else name
    return table(rows, _HEADS | heads)
