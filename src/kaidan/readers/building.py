"""A building: its flights, the floors and landings that they join, and its doors."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.estimate import Refusal
from kaidan.readers.flight import FlightEstimate
from kaidan.readers.kinds import Provenance
from kaidan.readers.solids.stated import Stated

Array = NDArray[np.float64]
OPPOSITE = math.cos(math.radians(45.0))
"""Cosine of the angle from which a door faces another way than the flight."""

SAME_FLOOR, WALL = 0.3, 0.6
"""Difference of the levels of a sill and its floor, and thickness of a wall with a door, at most
[m]."""


@dataclass(frozen=True)
class Storey:
    """A storey."""

    identity: str
    name: str
    level: float
    """[m]"""


@dataclass(frozen=True, eq=False)
class Floor:
    """Where flights begin and end: the floor of a storey, or a landing."""

    key: str
    name: str
    level: float
    """[m]"""
    storey: str
    """Identity of the storey that it is the floor of; empty: a landing between storeys."""
    outlines: tuple[Array, ...] = ()
    """Clear outlines of what is drawn of it, corners of shape (n, 2) [m]."""
    walls: Array = field(default_factory=lambda: np.zeros((0, 4)))
    """What stands on it, segments of shape (n, 4) [m]."""


@dataclass(frozen=True, eq=False)
class Flight:
    """A straight flight of a building."""

    identity: str
    """GlobalId of what it is drawn as; with a number where several flights are one element."""
    name: str
    category: str
    parents: tuple[str, ...]
    """GlobalIds and names by which it is meant too: of the whole staircase."""
    elements: tuple[str, ...]
    """GlobalIds of all that its treads are drawn as, the one with most of them first, and of what
    these are part of."""
    storey: str
    """Name of the storey that it belongs to."""
    estimate: FlightEstimate
    lane: Array
    """Corners of the clear lane in the plan, the foot's right one first, shape (4, 2) [m]."""
    lower: str
    """Key of the floor at its foot."""
    upper: str
    """Key of the floor at its head."""


Outcome = Literal["judged", "judged in part", "refused", "not understood"]
"""What became of an element: flights, flights and something else, a reason, or no idea."""


@dataclass(frozen=True, eq=False)
class Element:
    """A stair, a flight, a ramp, a lift or an escalator of the file, and what became of it."""

    identity: str
    """GlobalId."""
    name: str
    category: str
    kind: str
    """Stair, flight, ramp, ramp flight, lift, escalator, moving walk, transport element; empty: it
    is called none of these, and flights are drawn as it."""
    storey: str
    """Name of the storey that the file puts it into; empty: none."""
    flights: tuple[str, ...]
    """Identities of its flights."""
    outcome: Outcome
    """Of itself and of its parts."""
    refusals: tuple[Refusal, ...]
    """Why what is drawn of itself is not judged; of its parts they say it themselves."""
    stated: tuple[Stated, ...]
    """What it states, beside what all of its flights are."""


@dataclass(frozen=True)
class Doorway:
    """A door."""

    identity: str
    name: str
    x: float
    y: float
    level: float
    """Of its sill [m]."""
    width: float
    """Of the whole door, frame included [m]."""
    height: float
    leaf: float = math.nan
    """Width of a leaf that opens about a hinge [m]; zero: none does, NaN: not stated."""
    opens: tuple[float, float] = (0.0, 0.0)
    """Direction in the plan in which it opens, a unit vector."""
    both: bool = False
    """Whether a leaf opens to the other side too."""

    def opens_onto(self, start: Array, heading: float, wide: float) -> bool:
        """Whether its leaf opens towards the end of a flight that it stands opposite of.

        Parameters
        ----------
        start : array, shape (2,)
            End of the flight in the plan [m].
        heading : float
            Direction from there away from the flight [rad].
        wide : float
            Width of the flight [m].
        """
        ahead = np.array([math.cos(heading), math.sin(heading)])
        way = np.array([self.x, self.y]) - start
        across = abs(float(ahead[0] * way[1] - ahead[1] * way[0]))
        towards = -float(ahead @ self.opens)
        faces = abs(towards) > OPPOSITE if self.both else towards > OPPOSITE
        opposite = float(ahead @ way) > 0.0 and across < (wide + self.width) / 2
        return self.leaf > 0.0 and faces and opposite


@dataclass(frozen=True, eq=False)
class Building:
    """What stairs a building has."""

    storeys: tuple[Storey, ...]
    """From the lowest up."""
    floors: Mapping[str, Floor]
    flights: tuple[Flight, ...]
    doors: tuple[Doorway, ...]
    elements: tuple[Element, ...]
    """All elements for going up, and others that flights are drawn as."""
    provenance: Provenance

    @property
    def refusals(self) -> tuple[Refusal, ...]:
        """Why elements are not judged, or not all of them."""
        return tuple(refusal for each in self.elements for refusal in each.refusals)

    @cached_property
    def staircases(self) -> tuple[tuple[Flight, ...], ...]:
        """Flights that landings join, from the lowest up."""
        groups: list[list[Flight]] = []
        for flight in sorted(self.flights, key=lambda one: float(one.estimate.middle[0, 2])):
            joined = [
                group
                for group in groups
                if any(
                    {flight.lower, flight.upper} & {each.lower, each.upper} & self._landings
                    for each in group
                )
            ]
            groups = [group for group in groups if group not in joined]
            groups.append([each for group in joined for each in group] + [flight])
        return tuple(tuple(group) for group in groups)

    @cached_property
    def _landings(self) -> set[str]:
        return {key for key, floor in self.floors.items() if not floor.storey}

    def named(self, element: str) -> tuple[Flight, ...]:
        """Flights of an element: a GlobalId or a name, of a flight or of a whole staircase.

        Several of them are joined by colons: flights that no element of the file holds together.
        """
        parts = [self.named(each) for each in element.split(":")] if ":" in element else []
        if parts and all(parts):
            return tuple(each for each in self.flights if any(each in part for part in parts))
        wanted = element.strip().lower()
        exact = [each for each in self.flights if element in (each.identity, *each.parents)]
        return tuple(exact) or tuple(
            each
            for each in self.flights
            if wanted in (each.identity.lower(), each.name.lower(), *map(str.lower, each.parents))
        )
