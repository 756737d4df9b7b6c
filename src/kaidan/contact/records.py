"""What a traverse leaves behind, by name: poses, events, rotations, margins, the criterion's rows.

Thin views on the kernel's tables. A property is an array with one value a row, SI and radians;
events and rotations are also sequences of records. ``table`` is the array underneath, for the
kernel alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import columns as at
from kaidan.contact.codes import Event, RotationOutcome
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
    table: FloatArray

    def __len__(self) -> int:
        return len(self.table)

    def _column(self, column: int) -> FloatArray:
        return self.table[:, column]

    def _whole(self, column: int) -> IntArray:
        return self.table[:, column].astype(np.int64)


class Ground(_Table):
    """The terrain as driven on: its corners and the segments between them."""

    @property
    def points(self) -> FloatArray:
        """Corners (n, 2), along and up [m]."""
        return self.table[:, [at.X, at.Z]]

    @property
    def x(self) -> FloatArray:
        """Corners, along [m]."""
        return self._column(at.X)

    @property
    def z(self) -> FloatArray:
        """Corners, up [m]."""
        return self._column(at.Z)

    @property
    def convex(self) -> BoolArray:
        """Which corners stick out."""
        return np.asarray(self.table[:, at.CONVEX] == 1.0)


class Body(_Table):
    """The underside of the robot as driven, in the body frame at the centroid."""

    @property
    def kind(self) -> IntArray:
        """`PartKind` of each part."""
        return self._whole(at.KIND)

    @property
    def discs(self) -> FloatArray:
        """x1, z1, r1, x2, z2, r2 of each part (m, 6) [m]."""
        return self.table[:, : 2 * at.DISC]

    @property
    def flat_length(self) -> FloatArray:
        """Length of the straight underside of each part [m]."""
        return self._column(at.FLAT)


class Poses(_Table):
    """Stable poses of a path in their order."""

    def __getitem__(self, rows: Rows) -> Poses:
        return Poses(self.table[rows])

    @property
    def s(self) -> FloatArray:
        """Arclength [m]: of the centroid's path, with the inclination times 0.3 m."""
        return self._column(at.POSE_S)

    @property
    def x(self) -> FloatArray:
        """Centroid, along [m]."""
        return self._column(at.POSE_X)

    @property
    def z(self) -> FloatArray:
        """Centroid, up [m]."""
        return self._column(at.POSE_Z)

    @property
    def inclination(self) -> FloatArray:
        """Inclination of the body, nose up positive [rad]."""
        return self._column(at.POSE_PHI)

    @cached_property
    def rear(self) -> IntArray:
        """Feature that carries behind the centroid, read by `Feature.of`."""
        return self._whole(at.POSE_REAR)

    @cached_property
    def front(self) -> IntArray:
        """Feature that carries ahead of the centroid, read by `Feature.of`."""
        return self._whole(at.POSE_FRONT)

    @property
    def rear_point(self) -> FloatArray:
        """Point of the rear contact (n, 2) [m]."""
        return self.table[:, at.REAR_X : at.REAR_Z + 1]

    @property
    def front_point(self) -> FloatArray:
        """Point of the front contact (n, 2) [m]."""
        return self.table[:, at.FRONT_X : at.FRONT_Z + 1]

    @property
    def rear_normal(self) -> FloatArray:
        """Unit normal of the rear contact, into the belt as it gives way (n, 2)."""
        return self.table[:, at.REAR_N_X : at.REAR_N_Z + 1]

    @property
    def front_normal(self) -> FloatArray:
        """Unit normal of the front contact, into the belt as it gives way (n, 2)."""
        return self.table[:, at.FRONT_N_X : at.FRONT_N_Z + 1]

    @property
    def rear_lean(self) -> FloatArray:
        """Tilt of the rear contact's normal on the rigid outline, ahead positive [rad]."""
        return self._column(at.REAR_LEAN)

    @property
    def path_direction(self) -> FloatArray:
        """Direction of the centroid's path above the horizontal [rad]."""
        return self._column(at.POSE_PSI)

    @cached_property
    def leg(self) -> IntArray:
        """Number of the line of poses: it grows by one with every rotation."""
        return self._whole(at.POSE_LEG)

    @cached_property
    def leads_on(self) -> BoolArray:
        """Whether the path leads on from each pose to the next along one line of poses (n - 1)."""
        s, leg = self.s, self.leg
        return np.asarray((leg[1:] == leg[:-1]) & (s[1:] - s[:-1] > ONE_PLACE))

    @property
    def placements(self) -> FloatArray:
        """x, z and inclination together (n, 3)."""
        return self.table[:, at.POSE_X : at.POSE_PHI + 1]

    def placement(self, row: int) -> Placement:
        """Where the body is at one pose."""
        return Placement(*self.placements[row].tolist())


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

    @classmethod
    def of(cls, records: Iterable[EventRecord]) -> Events:
        """Table of some records."""
        rows = [tuple(map(float, record)) for record in records]
        return cls(np.array(rows, dtype=np.float64).reshape(-1, at.EVENT_COLUMNS))

    def merged(self, other: Events) -> Events:
        """Both in the order of their arclengths."""
        both = np.vstack([self.table, other.table])
        return Events(both[np.argsort(both[:, at.EVENT_S], kind="stable")])

    @property
    def kind(self) -> IntArray:
        """`Event` of each."""
        return self._whole(at.EVENT_KIND)

    @property
    def s(self) -> FloatArray:
        """Arclength [m]."""
        return self._column(at.EVENT_S)

    @property
    def feature(self) -> IntArray:
        """What each happens to, read by `Feature.of`; -1: nothing."""
        return self._whole(at.EVENT_FEATURE)

    @property
    def pose(self) -> IntArray:
        """Row of the pose of each."""
        return self._whole(at.EVENT_POSE)

    def __iter__(self) -> Iterator[EventRecord]:
        for kind, s, x, z, inclination, feature, other, pose in self.table.tolist():
            yield EventRecord(
                Event(int(kind)), s, x, z, inclination, int(feature), int(other), int(pose)
            )

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
    barrier_across: float
    """How far the centroid has moved across effective gravity then, along x [m]."""
    topples_with_momentum: bool
    """Whether it has that energy, or was not arrested at all."""
    outcome: RotationOutcome
    pivot_point: tuple[float, float]
    """Point of the first pivot [m]."""

    @property
    def arrested(self) -> bool:
        """Whether the next contact arrested it."""
        return self.outcome is RotationOutcome.ARRESTED


class Rotations(_Table, Sequence[RotationRecord]):
    """Rotations of a path in their order."""

    @property
    def s(self) -> FloatArray:
        """Arclength at which each began [m]."""
        return self._column(at.ROTATION_S)

    @property
    def angle(self) -> FloatArray:
        """How far each turned [rad]."""
        return self._column(at.ROTATION_ANGLE)

    @property
    def end_inclination(self) -> FloatArray:
        """Inclination at the end of each [rad]."""
        return self._column(at.END_PHI)

    @property
    def arrested(self) -> BoolArray:
        """Which the next contact arrested."""
        return np.asarray(self.table[:, at.OUTCOME] == float(RotationOutcome.ARRESTED))

    @property
    def topples_with_momentum(self) -> BoolArray:
        """Which go on to topple with the momentum gained."""
        return self.table[:, at.TOPPLES] > 0.0

    @cached_property
    def _records(self) -> list[RotationRecord]:
        return [
            RotationRecord(
                sense=row[at.ROTATION_SENSE],
                s=row[at.ROTATION_S],
                pivot=int(row[at.ROTATION_PIVOT]),
                start=Placement(row[at.START_X], row[at.START_Z], row[at.START_PHI]),
                end=Placement(row[at.END_X], row[at.END_Z], row[at.END_PHI]),
                angle=row[at.ROTATION_ANGLE],
                rate_before=row[at.RATE_BEFORE],
                rate_after=row[at.RATE_AFTER],
                kinetic=row[at.KINETIC],
                barrier=row[at.BARRIER],
                barrier_across=row[at.BARRIER_ACROSS],
                topples_with_momentum=row[at.TOPPLES] > 0.0,
                outcome=RotationOutcome(int(row[at.OUTCOME])),
                pivot_point=(row[at.PIVOT_X], row[at.PIVOT_Z]),
            )
            for row in self.table.tolist()
        ]

    def __iter__(self) -> Iterator[RotationRecord]:
        return iter(self._records)

    @overload
    def __getitem__(self, row: int) -> RotationRecord: ...
    @overload
    def __getitem__(self, row: Rows) -> Rotations: ...
    def __getitem__(self, row: int | Rows) -> RotationRecord | Rotations:
        if isinstance(row, int | np.integer):
            return next(iter(Rotations(self.table[row][None])))
        return Rotations(self.table[row])
