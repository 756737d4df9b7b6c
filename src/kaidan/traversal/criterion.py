"""What the criterion of no rotation says of a flight: nosings lost and met, and see-saws."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple


class Tread(NamedTuple):
    """Underside on the flight, seen from the side."""

    L: float
    """Length of the flat [m]."""
    C_L: float
    """Centroid behind the uphill tip of the flat [m]."""
    C_N: float
    """Centroid above the flat [m]."""
    R: float
    """Radius of the uphill end [m]."""
    R_downhill: float
    """Radius of the downhill end [m]."""
    gyration: float
    """Radius of gyration about the centroid [m]."""
    whole: bool = True
    """Whether a track carries all along it."""

    def mirrored(self) -> "Tread":
        """Seen from the other side."""
        return self._replace(C_L=self.L - self.C_L, R=self.R_downhill, R_downhill=self.R)


class Loss(NamedTuple):
    """A nosing that an end of the flat leaves, or is about to reach."""

    downhill: bool
    """Whether the downhill end is judged; else the uphill one."""
    nosing: int
    """Which nosing the end is at, counted from 0 at the bottom."""
    slope: float
    """Steeper (uphill end: gentler) inclination of the flat before and after [rad]."""
    lever: float
    """Pivot that stays, beyond the centroid along the flat [m]."""
    margin: float
    """Slope that it could be steeper (uphill end: gentler) before it tips [rad]."""
    centroid: float
    """How far the centroid may move towards that end [m]."""
    turn: float
    """Angle between the inclinations before and after [rad]."""
    rocking: float
    """What of it counts as rocking [rad]."""
    rise: float
    """Rise of the centroid on its way over the pivot [m]."""
    freed: float
    """Drop of the centroid in rocking, times the share that a plastic impact leaves [m]."""
    contacts: int
    """Nosings under the flat that stay."""
    landing: bool
    """Whether the uphill end is over the landing already, so that it says nothing of the flight."""
    place: float
    """Centroid, along [m]."""


class Seesaw(NamedTuple):
    """The largest about any nosing under the centroid, from behind it to ahead."""

    turn: float = 0.0
    """Angle [rad]."""
    rocking: float = 0.0
    """What of it counts as rocking [rad]."""


NO_SEESAW = Seesaw()


@dataclass(frozen=True)
class Criterion:
    """What the criterion says of a flight."""

    losses: tuple[Loss, ...]
    seesaw: Seesaw = NO_SEESAW
    tops: tuple[float, ...] = ()
    """Place of the last nosing of each flight [m]."""

    @cached_property
    def on_flight(self) -> tuple[Loss, ...]:
        """Losses and gains with the whole flat on the flight, which the criterion judges."""
        return tuple(each for each in self.losses if not each.landing)

    @property
    def holds(self) -> bool | None:
        """Whether nothing tips, without allowances; None where no nosing is ever lost or met."""
        if not self.on_flight:
            return None
        return all(each.margin > 0 for each in self.on_flight)

    @property
    def alone(self) -> bool:
        """Whether somewhere fewer than two nosings stay, where the paper's equations end."""
        return any(each.contacts < 2 for each in self.on_flight)

    def within(self, first: float, last: float) -> "Criterion":
        """The same of a part of the flight, by the place of the centroid [m]."""
        there = tuple(each for each in self.losses if first <= each.place <= last)
        tops = tuple(top for top in self.tops if first <= top <= last)
        return replace(self, losses=there, tops=tops)

    def smallest(self, *, downhill: bool, landing: bool = False) -> Loss | None:
        """Loss with the smallest margin at one end; the first of those that are alike.

        With `landing` of those with the uphill end over the landing, else of the others.
        """
        return self._smallest.get((downhill, landing))

    @cached_property
    def _smallest(self) -> dict[tuple[bool, bool], Loss]:
        """Loss with the smallest margin by end and landing."""
        found: dict[tuple[bool, bool], Loss] = {}
        for each in sorted(self.losses, key=lambda each: round(each.margin, 12)):
            found.setdefault((each.downhill, each.landing), each)
        return found

    @property
    def turn(self) -> float:
        """Largest angle by which it turns [rad]."""
        return max((self.seesaw.turn, *(each.turn for each in self.losses)))

    @property
    def rocking(self) -> float:
        """Largest rocking [rad]."""
        return max((self.seesaw.rocking, *(each.rocking for each in self.losses)))
