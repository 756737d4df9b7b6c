"""Building models: every staircase of straight flights, with its landings and what is stated."""

import math
from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from kaidan.errors import InputError, did_you_mean, shown
from kaidan.readers.assembly import building_of
from kaidan.readers.building import SAME_FLOOR, WALL, Building, Element, Flight, Floor
from kaidan.readers.estimate import Found, LandingEstimate, Refusal, StairsEstimate
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Array, Bodies
from kaidan.readers.sentences.buildings import disagreement
from kaidan.terrain.stairs import Stairs

DEEPEST = 5.0
"""Length of a landing beyond which it makes no difference [m]."""
GLOBAL_ID = 22
"""Characters of one."""


def found(contents: Bodies, hints: Hints) -> Found:
    """Staircases of a building model, or of the element that is named.

    hints: `element`: GlobalId or name of a flight or a staircase, or several joined by colons.
    """
    building = building_of(contents)
    groups, refusals = building.staircases, building.refusals
    if hints.element:
        flights = building.named(hints.element)
        wanted = {hints.element, *hints.element.split(":")}
        meant = {each.identity for each in contents.bodies if wanted & {each.identity, each.name}}
        meant |= {each.identity for each in contents.bodies if each.parent in meant}
        refusals = tuple(r for r in refusals if r.provenance.element in meant)
        groups = tuple(
            group
            for each in building.staircases
            if (group := tuple(one for one in each if one in flights))
        )
        if not groups and not refusals:
            raise _unknown(building, contents, hints.element)
    elif not groups and not refusals:
        refusals = (Refusal("none", {}, building.provenance),)
    return Found(
        provenance=building.provenance,
        staircases=tuple(_staircase(building, group) for group in groups),
        refusals=refusals,
        contents=contents,
    )


def _unknown(building: Building, contents: Bodies, element: str) -> Exception:
    names = sorted({each.identity for each in building.flights})
    hint = did_you_mean(element, [*names, *(each.name for each in building.flights)])
    listed = ", ".join(names[:8]) + (", …" if len(names) > 8 else "")
    what = f"; flights: {listed}" if names else "; it has no straight flights"
    drawn = any(element in (each.identity, each.name) for each in contents.bodies)
    says = "is no stair of straight flights" if drawn else "is not in it"
    return InputError(f"{building.provenance.path}: {shown(element)} {says}{hint or what}")


def _staircase(building: Building, flights: Sequence[Flight]) -> StairsEstimate:
    floors = building.floors
    ends = [floors[flights[0].lower], *(floors[each.upper] for each in flights)]
    landings = [
        _landing(
            building,
            floor,
            flights[k - 1] if k else None,
            flights[k] if k < len(flights) else None,
        )
        for k, floor in enumerate(ends)
    ]
    name = flights[0].name if len(flights) == 1 else _shared_name(flights)
    elements = [each for each in building.elements if _of(each, flights)]
    notes = [f"{each.name}: {note}" for each in flights for note in each.estimate.notes] + [
        f"{each.name}: {disagreement(one)}"
        for each in elements
        for one in each.stated
        if not one.agrees
    ]
    return StairsEstimate(
        flights=tuple(each.estimate for each in flights),
        landings=tuple(landings),
        provenance=replace(building.provenance, element=_element(building, flights)),
        name=name,
        facts=MappingProxyType(
            {
                "storey": flights[0].storey,
                "elements": [each.identity for each in flights],
                "stated": {
                    each.identity: {one.name: one.value for one in each.stated}
                    for each in elements
                    if each.stated
                },
            }
        ),
        notes=tuple(notes),
    )


def _element(building: Building, flights: Sequence[Flight]) -> str:
    """GlobalId that means these flights and no other, else theirs joined by colons."""
    shared = set.intersection(*({each.identity, *each.parents} for each in flights))
    whole = [
        each
        for each in shared
        if len(each) == GLOBAL_ID and len(building.named(each)) == len(flights)
    ]
    return min(whole, default=":".join(each.identity for each in flights))


def _shared_name(flights: Sequence[Flight]) -> str:
    shared = set.intersection(*({*each.parents} for each in flights))
    names = sorted((each for each in shared if each and len(each) != 22), key=len)
    return names[0] if names else flights[0].name


def _of(element: Element, flights: Sequence[Flight]) -> bool:
    """Whether all flights of an element are among these."""
    return bool(element.flights) and set(element.flights) <= {each.identity for each in flights}


def flight_sheet(building: Building, flight: Flight) -> Stairs:
    """Data sheet of one flight, with what is clear at its foot and at its head.

    The same that a question about ``FILE#PART`` takes.
    """
    (sheet,) = _staircase(building, (flight,)).stairs()
    return sheet


def _landing(
    building: Building, floor: Floor, below: Flight | None, above: Flight | None
) -> LandingEstimate:
    """Landing between two flights, or before the first or behind the last."""
    turn = 0.0
    if below is not None and above is not None:
        turn = math.remainder(above.estimate.heading - below.estimate.heading, 2 * math.pi)
    flight, at = (below, -1) if below is not None else (above, 0)
    assert flight is not None
    away = flight.estimate.heading if below is not None else flight.estimate.heading + math.pi
    start = flight.estimate.middle[at, :2]
    depth, width = room_on(floor, start, away)
    depth, leaf = _to_a_door(building, floor, start, away, min(depth, DEEPEST), flight)
    return LandingEstimate(depth=depth, width=width, level=floor.level, turn=turn, leaf=leaf)


def _to_a_door(
    building: Building, floor: Floor, at: Array, heading: float, depth: float, flight: Flight
) -> tuple[float, float]:
    """Length of a landing, to a door whose leaf opens onto it if one does, and that leaf [m]."""
    ahead = np.array([math.cos(heading), math.sin(heading)])
    end = depth if math.isfinite(depth) else DEEPEST
    found = []
    for door in building.doors:
        away = float(ahead @ (np.array([door.x, door.y]) - at))
        beside = abs(door.level - floor.level) < SAME_FLOOR and away < end + WALL
        if beside and door.opens_onto(at, heading, flight.estimate.width):
            found.append((min(away, end), door.leaf))
    return min(found, key=lambda one: one[0] - one[1], default=(depth, 0.0))


def room_on(floor: Floor, start: Array, heading: float) -> tuple[float, float]:
    """Clear depth of a floor from the end of a flight on, and its width there [m]; NaN: unknown."""
    ahead = np.array([math.cos(heading), math.sin(heading)])
    side = np.array([-ahead[1], ahead[0]])
    for outline in floor.outlines:
        depth = _free(outline, start + 0.01 * ahead, ahead)
        if math.isfinite(depth):
            middle = start + min(depth, 2.0) / 2 * ahead
            return depth + 0.01, _free(outline, middle, side) + _free(outline, middle, -side)
    return math.nan, math.nan


def _free(outline: Array, start: Array, ahead: Array) -> float:
    """Distance from a point to the outline [m]; NaN: it never meets it, or begins outside."""
    a, b = outline - start, np.roll(outline, -1, axis=0) - start
    side = np.array([-ahead[1], ahead[0]])
    t_a, t_b = a @ side, b @ side
    cuts = (t_a > 0) != (t_b > 0)
    share = t_a[cuts] / (t_a[cuts] - t_b[cuts])
    s = a[cuts] @ ahead + share * ((b - a)[cuts] @ ahead)
    beyond = np.sort(s[s > 0])
    return float(beyond[0]) if len(beyond) % 2 else math.nan
