"""The path of one traverse: its poses, events, rotations and margins."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact.codes import PartKind, Status
from kaidan.contact.contacts import Contact, contacts_of
from kaidan.contact.door import Records, stacked, zeros
from kaidan.contact.features import Feature
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import Margin, Pose, Pull
from kaidan.contact.records import (
    Body,
    Events,
    Ground,
    Margins,
    Placement,
    Poses,
    Rotations,
)
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray
from kaidan.mechanics import STANDARD_GRAVITY


@dataclass(frozen=True)
class Path:
    """What the robot does from one place to another.

    Attributes
    ----------
    status
        How it ended.
    poses
        Stable poses, in lines between which it rotates.
    events
        Contacts made and lost, rotations, the end.
    rotations
        Rotations about contacts.
    margins
        Forces and margins of each pose, or None.
    ground, body
        Terrain and robot as driven, to read features by.
    bodies
        Robot at each pose (n, m), where its posture is not the same in all; else None.
    """

    status: Status
    poses: Poses
    events: Events
    rotations: Rotations
    margins: Margins | None
    ground: Ground
    body: Body
    bodies: Records | None = None

    @property
    def scene(self) -> tuple[Records, Records]:
        """Terrain and robot, as the kernel takes them."""
        return self.ground.table, self.body.table

    @property
    def s(self) -> FloatArray:
        """Arclength of the poses [m]."""
        return self.poses.s

    @property
    def x(self) -> FloatArray:
        """Centroid, along [m]."""
        return self.poses.x

    @property
    def z(self) -> FloatArray:
        """Centroid, up [m]."""
        return self.poses.z

    @property
    def inclination(self) -> FloatArray:
        """Inclination of the body, nose up positive [rad]."""
        return self.poses.inclination

    @property
    def largest_rotation(self) -> float:
        """Grade two: the largest angle of any rotation that was arrested [rad]."""
        return float(self.rotations.angle[self.rotations.arrested].max(initial=0.0))

    @property
    def arrives_with_momentum(self) -> bool:
        """Grade three: it arrived and no rotation topples with the momentum gained."""
        return self.status is Status.OK and not bool(self.rotations.topples_with_momentum.any())

    @property
    def reach(self) -> float:
        """Distance from the centroid that no part of the robot exceeds [m]."""
        tables = self.body.table if self.bodies is None else self.bodies.ravel()
        return float(np.abs(Body(tables).discs).sum(axis=1).max())

    def first(self) -> Path:
        """First pose alone, with its margins; neither events nor rotations."""
        assert self.margins is not None
        return self.with_poses(self.poses.table[:1], self.margins.table[:1])

    def row_before(self, s: float) -> int:
        """Row of the last pose of a line of poses that ends at an arclength [m].

        A rotation lies between two rows of one arclength, before it and after it.
        """
        row: int = kernel().row_before(self.poses.table, s)
        return row

    def energy(self, rows: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Energy margin along the flow at some poses.

        Parameters
        ----------
        rows
            Shape (k,): rows of the poses.

        Returns
        -------
        rise : ndarray (k,)
            Rise of the centroid [m], the smaller of both sides.
        side : ndarray (k,)
            That side, +1 back, -1 front.
        """
        if self.margins is None:
            raise ValueError("traverse: energy needs with_margins=True")
        chosen = np.atleast_1d(np.asarray(rows, dtype=np.int64))
        missing = chosen[np.isnan(self.margins.energy[chosen])]
        if len(missing):
            kernel().flow_energy(self.scene, self.poses.table, self.margins.table, missing)
        return self.margins.energy[chosen], self.margins.energy_side[chosen]

    def contacts_at(self, place: Placement, touch: float = 1e-7) -> tuple[Contact, ...]:
        """Contacts of the robot at a place: gaps up to ``touch`` [m]."""
        return contacts_of(self.scene, *place, touch)

    def carrying(self, row: int) -> tuple[Contact, Contact]:
        """Rear and front contact of a pose."""
        poses, kinds = self.poses, self.body.kind
        codes = (int(poses.rear[row]), int(poses.front[row]))
        points = (poses.rear_point[row].tolist(), poses.front_point[row].tolist())
        normals = (poses.rear_normal[row].tolist(), poses.front_normal[row].tolist())
        rear, front = (
            Contact(tuple(point), tuple(normal), code, 0.0, PartKind(kinds[Feature.of(code).part]))
            for code, point, normal in zip(codes, points, normals, strict=True)
        )
        return rear, front

    def _margins(self, poses: Records, pull: Pull) -> Records:
        table = zeros(Margin, len(poses))
        kernel().pose_margins(self.scene, np.ascontiguousarray(poses), pull, table)
        return table

    def between(
        self, rows: IntArray, shares: FloatArray, *, acceleration: float = 0.0,
        gravity: float = STANDARD_GRAVITY,
    ) -> Path:  # fmt: skip
        """Poses between those of some rows and the next of the same line.

        Parameters
        ----------
        rows
            The first of each two.
        shares
            Of the arclength to the next (0 to 1).
        acceleration
            Along the path of the centroid [m/s^2].
        gravity
            [m/s^2]

        Returns
        -------
        Path
            A pose for each, with its margins; neither events nor rotations.
        """
        poses = self.table_between(rows, shares)
        return self.with_poses(poses, self._margins(poses, Pull(acceleration, gravity)))

    def table_between(self, rows: IntArray, shares: FloatArray) -> Records:
        """Those poses as a table, without margins."""
        poses = zeros(Pose, len(rows))
        kernel().poses_between(self.scene, self.poses.table, rows, shares, poses)
        return poses

    def with_poses(self, poses: Records, margins: Records) -> Path:
        """Other poses of it, as tables; neither events nor rotations."""
        return Path(
            self.status, Poses(poses), self.events[:0], self.rotations[:0], Margins(margins),
            self.ground, self.body, self.bodies,
        )  # fmt: skip

    def is_on_flat(self, feature: int, row: int) -> bool:
        """Whether a contact of a pose is a vertex under the straight underside of its part."""
        x, z, phi = self.poses.placement(row)
        return bool(kernel().on_flat(self.scene, feature, placed(x, z, phi)))

    def largest_inclination(self) -> float:
        """Largest inclination reached, ends of rotations included [rad]."""
        return float(
            max(self.inclination.max(), self.rotations.end_inclination.max(initial=-math.inf))
        )


def joined(paths: Sequence[Path]) -> Path:
    """Poses and margins of several paths over one ground as one, the first in all else."""
    margins = [each.margins.table for each in paths if each.margins is not None]
    return replace(
        paths[0],
        poses=Poses(stacked([each.poses.table for each in paths])),
        margins=Margins(stacked(margins)) if len(margins) == len(paths) else None,
    )
