"""What a traverse leaves behind, by name: poses, events, rotations, margins, ratings.

Thin views on the kernel's tables. An attribute is an array with one value a row, SI and radians: a
field of the record of that name in `kaidan.contact.layout`. Events and rotations are also sequences
of records. ``table`` is the array underneath, for the kernel alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import layout
from kaidan.contact.codes import Event, RotationOutcome
from kaidan.contact.door import Records, picked, stacked, table_of, zeros
from kaidan.contact.tables import FloatArray, IntArray

ONE_PLACE = 1e-8
"""Distance of poses that stand at one place, where several contacts are exchanged [m]."""

BoolArray = NDArray[np.bool_]
Rows = slice | NDArray[np.int64] | NDArray[np.bool_]


class Placement(NamedTuple):
    """Where the body is: centroid [m] and inclination, nose up positive [rad]."""

    x: float
    z: float
    inclination: float


@dataclass(frozen=True, eq=False)
class _Table:
    table: Records
    record: ClassVar[Any]
    """What a row holds."""

    @classmethod
    def none(cls) -> Any:
        """A table without rows."""
        return cls(zeros(cls.record, 0))

    def __len__(self) -> int:
        return len(self.table)

    def __getattr__(self, name: str) -> NDArray[Any]:
        """Return a field of all rows."""
        if name not in getattr(type(self).record, "__slots__", ()):
            raise AttributeError(f"{type(self).__name__} has no {name!r}")
        return self.table[name]


def _beside(*columns: NDArray[Any]) -> FloatArray:
    beside = np.empty((len(columns[0]), len(columns)))
    for k, column in enumerate(columns):
        beside[:, k] = column
    return beside


class Ground(_Table):
    """The terrain as driven on: its corners and the segments between them."""

    record = layout.Point

    @property
    def points(self) -> FloatArray:
        """Corners (n, 2), along and up [m]."""
        return _beside(self.x, self.z)


class Body(_Table):
    """The underside of the robot as driven, in the body frame at the centroid."""

    record = layout.Part

    @property
    def discs(self) -> FloatArray:
        """x1, z1, r1, x2, z2, r2 of each part (m, 6) [m]."""
        one, two = self.table["one"], self.table["two"]
        return _beside(*(disc[name] for disc in (one, two) for name in ("x", "z", "r")))


class Poses(_Table):
    """Stable poses of a path in their order."""

    record = layout.Pose

    def __getitem__(self, rows: Rows) -> Poses:
        return Poses(picked(self.table, rows))

    @property
    def rear(self) -> IntArray:
        """Feature that carries behind the centroid, read by `Feature.of`."""
        return self.table["rear"]["feature"]

    @property
    def front(self) -> IntArray:
        """Feature that carries ahead of the centroid, read by `Feature.of`."""
        return self.table["front"]["feature"]

    @cached_property
    def rear_point(self) -> FloatArray:
        """Point of the rear contact (n, 2) [m]."""
        return _beside(self.table["rear"]["x"], self.table["rear"]["z"])

    @cached_property
    def front_point(self) -> FloatArray:
        """Point of the front contact (n, 2) [m]."""
        return _beside(self.table["front"]["x"], self.table["front"]["z"])

    @cached_property
    def rear_normal(self) -> FloatArray:
        """Unit normal of the rear contact, into the belt as it gives way (n, 2)."""
        return _beside(self.table["rear"]["n_x"], self.table["rear"]["n_z"])

    @cached_property
    def front_normal(self) -> FloatArray:
        """Unit normal of the front contact, into the belt as it gives way (n, 2)."""
        return _beside(self.table["front"]["n_x"], self.table["front"]["n_z"])

    @cached_property
    def leads_on(self) -> BoolArray:
        """Whether the path leads on from each pose to the next along one line of poses (n - 1)."""
        s, leg = self.s, self.leg
        return np.asarray((leg[1:] == leg[:-1]) & (s[1:] - s[:-1] > ONE_PLACE))

    @cached_property
    def placements(self) -> FloatArray:
        """x, z and inclination together (n, 3)."""
        return _beside(self.x, self.z, self.inclination)

    def placement(self, row: int) -> Placement:
        """Where the body is at one pose."""
        pose = self.table[row]
        return Placement(*(float(pose[name]) for name in Placement._fields))


class EventRecord(NamedTuple):
    """One event along a path."""

    kind: Event
    s: float
    """Arclength [m]."""
    x: float
    """Centroid, along [m]."""
    z: float
    """Centroid, up [m]."""
    inclination: float
    """[rad]"""
    feature: int
    """What it happens to, read by `Feature.of`; -1: nothing."""
    other: int
    """The other feature that takes part; -1: none."""
    pose: int
    """Row of the pose."""


class Events(_Table, Sequence[EventRecord]):
    """Events of a path in their order."""

    record = layout.EventRow

    @classmethod
    def of(cls, records: Iterable[EventRecord]) -> Events:
        """Table of some records."""
        return cls(table_of(layout.EventRow, records))

    def merged(self, other: Events) -> Events:
        """Both in the order of their arclengths."""
        both = stacked([self.table, other.table])
        return Events(picked(both, np.argsort(both["s"], kind="stable")))

    def __iter__(self) -> Iterator[EventRecord]:
        for kind, *rest in self.table.tolist():
            yield EventRecord(Event(kind), *rest)

    @overload
    def __getitem__(self, row: int) -> EventRecord: ...
    @overload
    def __getitem__(self, row: slice) -> Events: ...
    def __getitem__(self, row: int | slice) -> EventRecord | Events:
        if isinstance(row, slice):
            return Events(self.table[row])
        return next(iter(Events(self.table[row][None])))


class RotationRecord(NamedTuple):
    """One rotation about contacts, from where the centroid passed over one to where it ended."""

    sense: float
    """+1 nose up, -1 nose down."""
    s: float
    """Arclength at which it began [m]."""
    pivot: int
    """Contact that it began about, read by `Feature.of`."""
    start: Placement
    end: Placement
    angle: float
    """How far it turned [rad]."""
    rate_before: float
    """Just before the last impact [rad/s]."""
    rate_after: float
    """Just after the last impact, which is plastic [rad/s]."""
    kinetic: float
    """Energy of each kilogram after the last impact [J/kg]."""
    barrier: float
    """Energy of each kilogram that going on to topple would need there [J/kg]."""
    topples_with_momentum: bool
    """Whether it has that energy, or was not arrested at all."""
    outcome: RotationOutcome
    pivot_point: tuple[float, float]
    """Point of the first pivot [m]."""
    barrier_across: float
    """How far the centroid has moved across effective gravity where it needs that, along x [m]."""

    @property
    def arrested(self) -> bool:
        """Whether the next contact arrested it."""
        return self.outcome is RotationOutcome.ARRESTED


class Rotations(_Table, Sequence[RotationRecord]):
    """Rotations of a path in their order."""

    record = layout.RotationRow

    @property
    def end_inclination(self) -> FloatArray:
        """Inclination at the end of each [rad]."""
        return self.table["end"]["inclination"]

    @property
    def arrested(self) -> BoolArray:
        """Which the next contact arrested."""
        return np.asarray(self.table["outcome"] == RotationOutcome.ARRESTED)

    @cached_property
    def _records(self) -> list[RotationRecord]:
        return [
            RotationRecord._make((
                sense, s, pivot, Placement(*start), Placement(*end), *rest,
                RotationOutcome(outcome), (pivot_x, pivot_z), across,
            ))
            for sense, s, pivot, start, end, *rest, outcome, pivot_x, pivot_z, across
            in self.table.tolist()
        ]  # fmt: skip

    def __iter__(self) -> Iterator[RotationRecord]:
        return iter(self._records)

    @overload
    def __getitem__(self, row: int) -> RotationRecord: ...
    @overload
    def __getitem__(self, row: Rows) -> Rotations: ...
    def __getitem__(self, row: int | Rows) -> RotationRecord | Rotations:
        if isinstance(row, int | np.integer):
            return next(iter(Rotations(self.table[row][None])))
        return Rotations(picked(self.table, row))


class Margins(_Table):
    """Forces and margins at each pose of a path; margins are positive when safe."""

    record = layout.Margin

    def __getitem__(self, rows: Rows) -> Margins:
        return Margins(picked(self.table, rows))

    @property
    def outermost(self) -> IntArray:
        """Features of the outermost contacts (n, 2), rear and front, read by `Feature.of`."""
        return np.stack([self.outer_rear, self.outer_front], axis=-1)


class Summaries(_Table):
    """One row a job of a batch."""

    record = layout.Summary


class Ratings(_Table):
    """One row a job of a batch that is rated."""

    record = layout.Rating
