"""What an interpreter finds: staircases with their landings, robots, refusals."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from kaidan.errors import InputError
from kaidan.readers.flight import MICROMETRE, FlightEstimate
from kaidan.readers.kinds import Array, Provenance
from kaidan.terrain.landings import TURNS
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import UNSTATED_LANDING, Stairs
from kaidan.text.refusals import sentence
from kaidan.text.turning import OTHER_ANGLE, not_judged

STRAIGHT_ON = math.radians(15.0)
"""Angle between two flights up to which the robot goes straight on [rad]."""
AS_STATED = math.radians(5.0)
"""Difference from a quarter or a half up to which a turn is one [rad]."""


@dataclass(frozen=True)
class Refusal:
    """Why something holds no stairs that can be judged: a result, not an error."""

    why: str
    """A word of ``kaidan.text.refusals``."""
    numbers: Mapping[str, float | str]
    """What was measured, by the names that the sentence uses."""
    provenance: Provenance
    name: str = ""
    """What the file calls the part of it that this is about."""

    def __str__(self) -> str:
        return sentence(self.why, self.numbers)


@dataclass(frozen=True)
class LandingEstimate:
    """A level place before, between or behind flights; NaN: its end was not seen."""

    depth: float = math.nan
    """Along the heading of the flight below, of the first one along that of the flight above [m]"""
    width: float = math.nan
    """Across it [m]."""
    level: float = math.nan
    """Height in the frame of the flights [m]."""
    turn: float = 0.0
    """Heading of the flight above less that of the flight below, to the left positive [rad]."""
    leaf: float = 0.0
    """Leaf of a door opposite that opens onto it [m]."""


@dataclass(frozen=True, eq=False)
class StairsEstimate:
    """A staircase: flights from bottom to top, and the landings before, between and behind."""

    flights: tuple[FlightEstimate, ...]
    landings: tuple[LandingEstimate, ...]
    """One more than the flights."""
    provenance: Provenance
    name: str = "stairs"
    facts: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    """What else is known of it: storey, property sets and what they contradict."""
    notes: tuple[str, ...] = ()
    """What the reader must know, as sentences."""
    frame: Array | None = None
    """Rotation from the file's frame to that of the flights, shape (3, 3); None: the one that lifts
    the up axis."""

    def __post_init__(self) -> None:
        if not self.flights or len(self.landings) != len(self.flights) + 1:
            raise InputError(
                f"stairs {self.name!r}: {len(self.flights)} flights need "
                f"{len(self.flights) + 1} landings, not {len(self.landings)}"
            )

    def stairs(self) -> tuple[Stairs, ...]:
        """Data sheets of the flights from bottom to top, as a question takes them.

        A landing between two flights has the turn on it, a quarter or a half, where it was seen to
        be as wide as both flights side by side. Where it was not, or the way turns by another
        angle, the turn is unknown, and the notes of the lower flight's sheet say why.
        """
        sheets = [
            flight.stairs(
                self.name if len(self.flights) == 1 else f"{self.name}-{number + 1}",
                lower=below.depth,
                upper=above.depth,
                leaves=(below.leaf, above.leaf),
            )
            for number, (flight, below, above) in enumerate(
                zip(self.flights, self.landings, self.landings[1:], strict=False)
            )
        ]
        inner = enumerate(zip(sheets[:-1], self.landings[1:-1], strict=True))
        for number, (sheet, landing) in inner:
            sheets[number] = _turning(sheet, landing)
        return tuple(sheets)

    def profile(self, flight: int = 0, *, lateral: float = 0.0) -> Profile:
        """Terrain of one flight with its landings.

        See `kaidan.readers.flight.FlightEstimate.profile`.
        """
        below, above = self.landings[flight], self.landings[flight + 1]
        return self.flights[flight].profile(
            self.name,
            lateral=lateral,
            lower=_or_unseen(below.depth),
            upper=_or_unseen(above.depth),
        )


@dataclass(frozen=True, eq=False)
class Found:
    """All that a file holds."""

    provenance: Provenance
    staircases: tuple[StairsEstimate, ...] = ()
    refusals: tuple[Refusal, ...] = ()
    robots: tuple[Any, ...] = ()
    contents: Any = None
    """What was interpreted, for drawing: one of `kinds`; None: nothing was read."""


def _turning(sheet: Stairs, landing: LandingEstimate) -> Stairs:
    """Sheet of the flight below a landing with the turn on it, or with why it is not judged."""
    if abs(landing.turn) < STRAIGHT_ON:
        return sheet
    stated = {name: getattr(sheet, name) for name in sheet.model_fields_set}
    sizes = (
        {"upper_landing_width": round(landing.width, MICROMETRE)}
        if math.isfinite(landing.width)
        else {}
    )
    why = OTHER_ANGLE
    for turn, angle in TURNS.items():
        if abs(abs(landing.turn) - angle) > AS_STATED:
            continue
        try:
            return Stairs(**stated | sizes | {"upper_turn": turn})
        except InputError as error:
            why = str(error).removeprefix(f"{Stairs.label}: ")
    notes = not_judged(landing.turn, sheet.name, why)
    return Stairs(**stated | {"upper_turn": "unknown", "notes": notes})


def _or_unseen(length: float) -> float:
    return length if math.isfinite(length) else UNSTATED_LANDING
