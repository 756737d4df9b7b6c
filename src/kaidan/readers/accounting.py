"""Every element for going up, and what became of it: nothing of a building is lost without a word.

An element answers for what is drawn of it and of its parts that are no such elements themselves.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from kaidan.readers.building import Element, Flight, Outcome
from kaidan.readers.estimate import Refusal
from kaidan.readers.kinds import Body, Provenance
from kaidan.readers.solids.levels import Plate
from kaidan.readers.solids.runs import RISES
from kaidan.readers.solids.stated import Stated, cross_checked

MOVING = {"lift": "lift", "escalator": "escalator", "moving walk": "moving-walk",
          "transport element": "transport"}  # fmt: skip
"""Kinds that nobody drives on, with the words of their refusals."""
RAMPS = ("ramp", "ramp flight")
NOT_UNDERSTOOD = ("no-flight", "left-over", "no-treads", "no-slope", "undrawn", "damaged")
"""Refusals that say that the reader does not know what it sees."""
STEPPED = 0.45
"""Least length of a surface that may be a tread [m]: no flight for people is narrower."""
GENTLEST, STEEPEST = math.radians(0.5), math.radians(45.0)
"""Slopes of ramps [rad]."""
SLOPING = 0.1
"""Part of the plan that slopes where an element is a ramp [1], and no slab with bevelled edges."""


class Refused(NamedTuple):
    """Surfaces that make up no straight flight, and why."""

    owner: int
    """Number of the body that most of them belong to."""
    plates: frozenset[int]
    refusal: Refusal


@dataclass(frozen=True, eq=False)
class Drawn:
    """What the solids of a building came to."""

    bodies: Sequence[Body]
    plates: Sequence[Plate]
    used: frozenset[int]
    """Numbers of the plates that flights climb, begin on or lead to."""
    flights: Sequence[Flight]
    refused: Sequence[Refused]
    storeys: Mapping[str, str]
    """Names by identity."""
    unit: float
    """Length of the model's unit [m]."""
    provenance: Provenance


def accounted(drawn: Drawn) -> tuple[Element, ...]:
    """Elements for going up, and others that flights are drawn as, in the order of the file."""
    return _Account(drawn).elements()


class _Account:
    """Which element answers for what."""

    def __init__(self, drawn: Drawn) -> None:
        self.drawn = drawn
        self.number = {each.identity: k for k, each in enumerate(drawn.bodies)}
        self.slopes = [
            _slope([each]) if each.facts.get("kind") in RAMPS else None for each in drawn.bodies
        ]
        self.kinds = [self._kind(k) for k in range(len(drawn.bodies))]
        self.answering = [self._answers(k) for k in range(len(drawn.bodies))]
        self.plates: dict[int, list[int]] = {}
        for number, plate in enumerate(drawn.plates):
            self.plates.setdefault(self.answering[plate.owners[0]], []).append(number)
        self.parts: dict[int, list[int]] = {}
        for k, by in enumerate(self.answering):
            self.parts.setdefault(by, []).append(k)
        kinded = (k for k, kind in enumerate(self.kinds) if kind)
        self.climbing: dict[str, list[Flight]] = {}
        for flight in drawn.flights:
            for identity in flight.elements:
                self.climbing.setdefault(identity, []).append(flight)
        self.wholes = {above for k in kinded for above in self._above(k) if above != k}

    def _kind(self, k: int) -> str:
        """Kind of an element; a slab that is called a ramp is one only if it slopes."""
        body = self.drawn.bodies[k]
        kind: str = body.facts.get("kind", "")
        return "" if body.category == "IfcSlab" and self.slopes[k] is None else kind

    def _above(self, k: int) -> Iterator[int]:
        """An element, what it is part of, and so on up."""
        seen: set[int] = set()
        at: int | None = k
        while at is not None and at not in seen:
            yield at
            seen.add(at)
            at = self.number.get(self.drawn.bodies[at].parent)

    def _answers(self, k: int) -> int:
        return next((each for each in self._above(k) if self.kinds[each]), k)

    def elements(self) -> tuple[Element, ...]:
        owners = {self.answering[each.owner] for each in self.drawn.refused}
        owners |= {self.answering[self.number[each.elements[0]]] for each in self.drawn.flights}
        wanted = [k for k, kind in enumerate(self.kinds) if kind or k in owners]
        own = {k: self._own_refusals(k) for k in wanted}
        below: dict[int, list[Refusal]] = {k: list(own[k]) for k in wanted}
        for k in wanted:
            for above in self._above(k):
                if above != k and above in below:
                    below[above] += own[k]
        return tuple(self._element(k, own[k], below[k]) for k in wanted)

    def _element(self, k: int, own: list[Refusal], all_: list[Refusal]) -> Element:
        body, flights = self.drawn.bodies[k], self._flights(k)
        storeys = (str(self.drawn.bodies[each].facts.get("storey")) for each in self._above(k))
        names = [self.drawn.storeys[each] for each in storeys if each in self.drawn.storeys]
        return Element(
            identity=body.identity,
            name=body.name or body.category,
            category=body.category,
            kind=self.kinds[k],
            storey=names[0] if names else "",
            flights=tuple(each.identity for each in flights),
            outcome=_outcome(flights, all_),
            refusals=tuple(replace(each, name=body.name or body.category) for each in own),
            stated=tuple(self._stated(body, flights, whole=not all_) if flights else ()),
        )

    def _flights(self, k: int) -> list[Flight]:
        """Flights that an element is drawn as, or that begin or end on it where it is a landing."""
        found, plates = self.climbing.get(self.drawn.bodies[k].identity, []), self.plates.get(k, [])
        if found or not plates or self._levels(k, others=True):
            return found
        ends = {f"landing:{number}" for number in plates}
        return [each for each in self.drawn.flights if ends & {each.lower, each.upper}]

    def _own_refusals(self, k: int) -> list[Refusal]:
        kind = self.kinds[k]
        if kind in MOVING:
            return [self._refusal(k, MOVING[kind])]
        if kind in RAMPS:
            return self._of_ramp(k)
        refused = [each for each in self.drawn.refused if self.answering[each.owner] == k]
        plates = set(self.plates.get(k, []))
        if not refused and not self._flights(k):
            refused = [each for each in self.drawn.refused if each.plates & plates]
        if refused:
            distinct = {each.refusal.why: each.refusal for each in refused}
            identity = self.drawn.bodies[k].identity
            return [
                replace(each, provenance=replace(each.provenance, element=identity))
                for each in distinct.values()
            ]
        return self._of_stairs(k) if kind else []

    def _refusal(self, k: int, why: str, **numbers: float | str) -> Refusal:
        provenance = replace(self.drawn.provenance, element=self.drawn.bodies[k].identity)
        return Refusal(why, numbers, provenance)

    def _shaped(self, k: int) -> list[Body]:
        bodies = [self.drawn.bodies[each] for each in self.parts[k]]
        return [each for each in bodies if len(each.faces)]

    def _undrawn(self, k: int) -> list[Refusal]:
        """Why an element without a shape is not judged; nothing where its parts answer for it."""
        if k in self.wholes:
            return []
        parts = (self.drawn.bodies[each] for each in self.parts[k])
        damaged = any(each.facts.get("represented") for each in parts)
        return [self._refusal(k, "damaged" if damaged else "undrawn")]

    def _of_ramp(self, k: int) -> list[Refusal]:
        shaped = self._shaped(k)
        if not shaped:
            return self._undrawn(k)
        slope = _slope(shaped)
        if slope is None:
            return [self._refusal(k, "no-slope")]
        return [self._refusal(k, "ramp-element", angle_deg=slope[0], height_m=slope[1])]

    def _of_stairs(self, k: int) -> list[Refusal]:
        """What of stairs makes no flight: all of them, or levels that none of their flights has."""
        shaped, flights = self._shaped(k), self._flights(k)
        if not shaped:
            return [] if flights else self._undrawn(k)
        levels = self._levels(k, others=bool(flights))
        if flights or k in self.wholes:
            rises = (high - low for low, high in pairwise(levels))
            if not any(RISES[0] <= rise <= RISES[1] for rise in rises):
                return []
            return [self._refusal(k, "left-over", low_m=levels[0], high_m=levels[-1])]
        if not levels:
            return [self._refusal(k, "no-treads")]
        foot = min(float(each.vertices[:, 2].min()) for each in shaped)
        if len(levels) == 1 and RISES[0] <= levels[0] - foot <= RISES[1]:
            return [self._refusal(k, "single-step", rise_mm=1e3 * (levels[0] - foot))]
        numbers = {"count": len(levels), "low_m": levels[0], "high_m": levels[-1]}
        return [self._refusal(k, "no-flight", **numbers)]

    def _levels(self, k: int, *, others: bool) -> list[float]:
        """Levels of what may be treads of an element; others: than flights climb or end on."""
        own = self.plates.get(k, [])
        known = [self.drawn.plates[n].level for n in own if others and n in self.drawn.used]
        found: list[float] = []
        for number in own:
            plate = self.drawn.plates[number]
            near = any(abs(plate.level - each) < RISES[0] for each in (*known, *found))
            if plate.box[0] >= STEPPED and not near:
                found.append(plate.level)
        return sorted(found)

    def _stated(self, body: Body, flights: Sequence[Flight], *, whole: bool) -> Iterator[Stated]:
        """What an element states beside what all of its flights are; counts of the whole alone."""
        stated = body.facts.get("stated", {})
        estimates = [each.estimate for each in flights]
        risers = sum(map(len, estimates))
        measured = {
            "rise": tuple(each.typical_step[0] for each in estimates),
            "going": tuple(each.typical_step[1] for each in estimates),
        }
        if whole:  # landings between its flights may count as treads
            measured["risers"] = (float(risers),)
            measured["treads"] = tuple(float(risers - 1 - k) for k in range(len(flights)))
            measured["height"] = (float(sum(each.drawn_rises.sum() for each in estimates)),)
        ends = sum(each.drawn_rises.sum() - each.line()[-1, 1] for each in estimates)
        return cross_checked(stated, measured, self.drawn.unit, float(ends))


def _outcome(flights: Sequence[Flight], refusals: Sequence[Refusal]) -> Outcome:
    if flights:
        return "judged in part" if refusals else "judged"
    understood = refusals and all(each.why not in NOT_UNDERSTOOD for each in refusals)
    return "refused" if understood else "not understood"


def _slope(bodies: Sequence[Body]) -> tuple[float, float] | None:
    """Slope of a ramp [deg] and height over which it slopes [m]; None: nothing of it slopes."""
    corners = np.concatenate([np.zeros((0, 3, 3)), *(each.vertices[each.faces] for each in bodies)])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat, length = np.abs(normals[:, 2]), np.linalg.norm(normals, axis=1)
    angle = np.arccos(np.clip(flat / np.maximum(length, 1e-12), 0.0, 1.0))
    sloping = (angle >= GENTLEST) & (angle <= STEEPEST)
    if not flat[sloping].sum() > SLOPING * flat.sum():
        return None
    order = np.argsort(-angle[sloping])
    share = np.cumsum(flat[sloping][order])
    steepest = order[int(np.searchsorted(share, SLOPING * share[-1]))]
    heights = corners[sloping][:, :, 2]
    return math.degrees(angle[sloping][steepest]), float(np.ptp(heights))
