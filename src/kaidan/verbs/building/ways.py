"""Ways from storey to storey: the flights between them, and what decides."""

import heapq
import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from kaidan.mechanics.clearance import OFF_LINE, YAW, door_clear_width, lane_width
from kaidan.models.sentences import turning
from kaidan.modes import Verdict
from kaidan.outline import Outline, footprint_of, height_of
from kaidan.readers.building import Building, Flight
from kaidan.robot import Posture, Robot
from kaidan.verbs.building import sentences as text
from kaidan.verbs.building.answer import (
    Binding,
    CellShown,
    DoorShown,
    StoreyShown,
    TurnShown,
    WayShown,
)

TURNED = ("spin", "corner", "manoeuvre")
"""Ways in which a robot turns on a landing."""
NEAR = 2.5
"""Distance from the end of a flight up to which a door is one of its floor's [m]."""
FRAME = 0.1
"""Width that frame and leaf of a door take [m]."""


class Leg(NamedTuple):
    """A flight, in a direction."""

    flight: Flight
    up: bool

    @property
    def ends(self) -> tuple[str, str]:
        """Keys of the floors where it begins and ends."""
        lower, upper = self.flight.lower, self.flight.upper
        return (lower, upper) if self.up else (upper, lower)


class Hindrance(NamedTuple):
    """Something on a way, and its verdict."""

    verdict: Verdict
    binds: Binding
    where: str
    reason: str
    margin: float


def doors_of(building: Building) -> Iterator[DoorShown]:
    """Doors at the ends of flights."""
    seen = set()
    for flight in building.flights:
        for key, at in ((flight.lower, 0), (flight.upper, -1)):
            x, y, _ = flight.estimate.middle[at]
            level = building.floors[key].level
            for door in building.doors:
                close = math.hypot(door.x - x, door.y - y) <= NEAR and abs(door.level - level) < 0.3
                if close and (door.identity, key) not in seen:
                    seen.add((door.identity, key))
                    yield DoorShown(
                        identity=door.identity,
                        name=door.name,
                        floor=key,
                        clear_width_m=door_clear_width(opening=door.width, leaf=FRAME),
                        height_m=door.height,
                        threshold_m=door.level - level,
                        leaf_m=door.leaf,
                        x=door.x,
                        y=door.y,
                    )


def ways_of(
    building: Building,
    robot: Robot,
    start: StoreyShown,
    storeys: Sequence[StoreyShown],
    *,
    cell: Callable[[Flight, bool], CellShown],
    turn: Callable[[Flight, Flight], TurnShown],
    doors: Sequence[DoorShown],
) -> Iterator[WayShown]:
    """Best way of a robot to each other storey."""
    by_storey = {floor.storey: key for key, floor in building.floors.items() if floor.storey}

    def hindrances(before: Leg | None, leg: Leg) -> Iterator[Hindrance]:
        shown = cell(leg.flight, leg.up)
        yield Hindrance(
            shown.verdict,
            shown.binds,
            leg.flight.name,
            shown.reason,
            math.inf if shown.margin_deg is None else shown.margin_deg,
        )
        if before is not None and before.flight.identity != leg.flight.identity:
            yield from _turning(building, before, leg, turn)
        for key in leg.ends:
            yield from _doors(robot, [each for each in doors if each.floor == key], shown.flippers)

    found = _searched(building, by_storey.get(start.identity), hindrances)
    for storey in storeys:
        if storey.identity == start.identity:
            continue
        key = by_storey.get(storey.identity)
        if key is None or key not in found:
            yield WayShown(
                robot=robot.name,
                storey=storey.name,
                verdict=None,
                binds="",
                where="",
                reason=text.no_way(start.name),
                flights=(),
                postures=(),
            )
            continue
        legs, met = found[key]
        decides = max(met, key=lambda one: (one.verdict.rank, -one.margin))
        yield WayShown(
            robot=robot.name,
            storey=storey.name,
            verdict=decides.verdict,
            binds=decides.binds,
            where=decides.where,
            reason=decides.reason,
            flights=[leg.flight.identity for leg in legs],
            postures=list(_postures(building, legs, cell, turn)),
        )


_Found = dict[str, tuple[tuple[Leg, ...], tuple[Hindrance, ...]]]


def _searched(
    building: Building,
    start: str | None,
    hindrances: Callable[[Leg | None, Leg], Iterator[Hindrance]],
) -> _Found:
    """Way with the least bad worst verdict to each floor, then the one of fewest flights."""
    found: _Found = {}
    if start is None:
        return found
    legs = [Leg(flight, up) for flight in building.flights for up in (True, False)]
    count = itertools.count()
    queue: list[tuple[int, int, int, str, tuple[Leg, ...], tuple[Hindrance, ...]]]
    queue = [(0, 0, next(count), start, (), ())]
    done: set[tuple[str, str]] = set()
    while queue:
        rank, length, _, at, way, met = heapq.heappop(queue)
        last = way[-1] if way else None
        state = (at, last.flight.identity if last else "")
        if state in done:
            continue
        done.add(state)
        if at not in found:
            found[at] = (way, met)
        for leg in legs:
            begin, end = leg.ends
            if begin != at or any(leg.flight.identity == one.flight.identity for one in way):
                continue
            more = tuple(hindrances(last, leg))
            worst = max(rank, *(one.verdict.rank for one in more))
            heapq.heappush(queue, (worst, length + 1, next(count), end, (*way, leg), (*met, *more)))
    return found


def _turning(
    building: Building, before: Leg, leg: Leg, turn: Callable[[Flight, Flight], TurnShown]
) -> Iterator[Hindrance]:
    floor = building.floors[leg.ends[0]]
    if floor.storey or before.up != leg.up:
        return  # there is room to go round, or it is a way there and back
    lower, upper = (before, leg) if leg.up else (leg, before)
    shown = turn(lower.flight, upper.flight)
    if shown.holds:
        return
    verdict = Verdict.NO_GO if shown.way == "none" else Verdict.UNSURE
    yield Hindrance(verdict, "turning", floor.name, turning.turning(shown), -math.inf)


def _doors(robot: Robot, doors: Sequence[DoorShown], flippers: str) -> Iterator[Hindrance]:
    """Doors of a floor, where the robot fits through none of them."""
    outline = Outline.of(robot, Posture.parse("stowed", robot))
    footprint, height = footprint_of(robot, outline), height_of(robot, outline)
    needed = float(
        lane_width(
            w=footprint.width, length=footprint.front + footprint.rear, psi=YAW, error=OFF_LINE
        )
    )
    if not doors or math.isnan(footprint.width):
        return
    best = max(doors, key=lambda one: one.clear_width_m)
    too_low = all(one.height_m < height for one in doors)
    if best.clear_width_m >= needed and not too_low:
        return
    fits = best.clear_width_m >= footprint.width and not too_low
    verdict = Verdict.UNSURE if fits else Verdict.NO_GO
    yield Hindrance(
        verdict, "doors", best.name, text.door(best, footprint.width, needed), -math.inf
    )


def _postures(
    building: Building,
    legs: Sequence[Leg],
    cell: Callable[[Flight, bool], CellShown],
    turn: Callable[[Flight, Flight], TurnShown],
) -> Iterator[str]:
    """What to do with the flippers on the way."""
    before: Leg | None = None
    at, lead = "stowed", "nose-first"
    for leg in legs:
        judged = cell(leg.flight, leg.up)
        if before is not None and before.up == leg.up:
            floor = building.floors[leg.ends[0]]
            lower, upper = (before, leg) if leg.up else (leg, before)
            if not floor.storey:
                shown = turn(lower.flight, upper.flight)
                place = floor.name if floor.name.startswith("landing") else f"floor {floor.name}"
                if shown.way in TURNED:
                    yield turning.turned(shown, place)
                    at = shown.flippers if shown.changed else at
        flippers = "" if judged.flippers == at else judged.flippers
        facing = "" if judged.facing == lead else judged.facing
        if flippers or facing:
            yield text.posture_for(leg.flight.name, flippers, facing)
            at, lead = judged.flippers.rpartition("/")[2].rpartition(":")[2], judged.facing
        before = leg
