"""Forces and margins of poses, the criterion's rows and the summaries of a batch, by name."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from kaidan.contact import columns as at
from kaidan.contact.records import BoolArray, Rows, _Table
from kaidan.contact.tables import FloatArray, IntArray


class Margins(_Table):
    """Forces and margins at each pose of a path; margins are positive when safe."""

    def __getitem__(self, rows: Rows) -> Margins:
        return Margins(self.table[rows])

    @property
    def required_friction(self) -> FloatArray:
        """Least friction coefficient with which the contacts hold the robot [1]; inf: none does.

        Of the active pair where a contact is just being exchanged, else the least over all pairs
        of contacts: at the least coefficient the load lies on the surface of the cone of all
        contact forces, on a facet between two edges, so two contacts carry it.
        """
        return self._column(at.FRICTION)

    @property
    def rear_load(self) -> FloatArray:
        """Normal force at the rear contact [N/kg]."""
        return self._column(at.REAR_N)

    @property
    def rear_traction(self) -> FloatArray:
        """Tangential force at the rear contact, driving ahead positive [N/kg]."""
        return self._column(at.REAR_T)

    @property
    def front_load(self) -> FloatArray:
        """Normal force at the front contact [N/kg]."""
        return self._column(at.FRONT_N)

    @property
    def front_traction(self) -> FloatArray:
        """Tangential force at the front contact, driving ahead positive [N/kg]."""
        return self._column(at.FRONT_T)

    @property
    def traction(self) -> FloatArray:
        """Force along the path, g sin psi + a [N/kg]."""
        return self._column(at.TRACTION)

    @property
    def back(self) -> FloatArray:
        """Static stability margin to the back: rear contact to gravity line [m]."""
        return self._column(at.BACK)

    @property
    def front(self) -> FloatArray:
        """Static stability margin to the front: gravity line to front contact [m]."""
        return self._column(at.FRONT)

    @property
    def back_rise(self) -> FloatArray:
        """Rise of the centroid until it stands over the fixed rear contact (Hirose) [m]."""
        return self._column(at.BACK_RISE)

    @property
    def front_rise(self) -> FloatArray:
        """Rise of the centroid until it stands over the fixed front contact (Hirose) [m]."""
        return self._column(at.FRONT_RISE)

    @property
    def energy(self) -> FloatArray:
        """Energy margin along the flow, the smaller of both sides [m]; NaN until worked out."""
        return self._column(at.ENERGY)

    @property
    def energy_side(self) -> FloatArray:
        """Side of `energy`, +1 back, -1 front; NaN until worked out."""
        return self._column(at.ENERGY_SIDE)

    @property
    def bounded(self) -> BoolArray:
        """Whether `energy` is the rise itself; else a lower bound.

        It is a bound where the robot wedges or does not come over the contact within 90 degrees.
        """
        return np.asarray(self.table[:, at.BOUNDED] == 1.0)

    @property
    def force_angle(self) -> FloatArray:
        """Force-angle measure of Papadopoulos and Rey [rad m N/kg]."""
        return self._column(at.FORCE_ANGLE)

    @property
    def zmp(self) -> FloatArray:
        """Where the gravity line meets the line of the contacts, 0 rear to 1 front."""
        return self._column(at.ZMP)

    @property
    def contacts(self) -> IntArray:
        """Number of contacts."""
        return self._whole(at.CONTACTS)

    @property
    def outermost(self) -> IntArray:
        """Features of the outermost contacts (n, 2), rear and front, read by `Feature.of`."""
        return self.table[:, at.OUTER_REAR : at.OUTER_FRONT + 1].astype(np.int64)

    @property
    def belly_touches(self) -> BoolArray:
        """Whether the belly touches the ground."""
        return self.table[:, at.BELLY_TOUCHES] > 0.0

    @property
    def steepest_face(self) -> FloatArray:
        """Largest angle of a contact normal from the vertical [rad]."""
        return self._column(at.STEEPEST)

    @property
    def tilt(self) -> FloatArray:
        """Tilt of effective gravity: its horizontal over its vertical part, backward positive."""
        return self._column(at.TILT)


class Job(NamedTuple):
    """One traverse of a batch."""

    terrain: int
    """Number of the terrain."""
    robot: int
    """Number of the robot."""
    x_start: float
    """Centroid at the start [m]."""
    x_end: float
    """Centroid at the end [m]."""
    inclination: float = 0.0
    """From which the robot settles at the start [rad]."""
    acceleration: float = 0.0
    """Along the path of the centroid [m/s^2]."""
    gyration: float = 0.2
    """Radius of gyration about the centroid [m]."""
    reference: float = 0.0
    """Inclination above which `Summaries.extra` counts [rad]."""


class Summaries(_Table):
    """One row a job of a batch."""

    @property
    def status(self) -> IntArray:
        """`Status` of each."""
        return self._whole(at.SUMMARY_STATUS)

    @property
    def poses(self) -> IntArray:
        """Number of poses."""
        return self._whole(at.SUMMARY_POSES)

    @property
    def events(self) -> IntArray:
        """Number of events."""
        return self._whole(at.SUMMARY_EVENTS)

    @property
    def rotations(self) -> IntArray:
        """Number of rotations."""
        return self._whole(at.SUMMARY_ROTATIONS)

    @property
    def largest_inclination(self) -> FloatArray:
        """Largest inclination reached [rad]."""
        return self._column(at.SUMMARY_HIGHEST)

    @property
    def smallest_inclination(self) -> FloatArray:
        """Smallest inclination reached [rad]."""
        return self._column(at.SUMMARY_LOWEST)

    @property
    def extra(self) -> FloatArray:
        """Largest inclination above the reference [rad]."""
        return self._column(at.SUMMARY_EXTRA)

    @property
    def largest_rotation(self) -> FloatArray:
        """Largest angle of a rotation [rad]."""
        return self._column(at.SUMMARY_ANGLE)

    @property
    def topples_with_momentum(self) -> BoolArray:
        """Whether some rotation topples with the momentum gained."""
        return self.table[:, at.SUMMARY_TOPPLES] > 0.0

    @property
    def x(self) -> FloatArray:
        """Centroid reached [m]."""
        return self._column(at.SUMMARY_REACHED)

    @property
    def required_friction(self) -> FloatArray:
        """Largest required friction [1]; NaN without margins."""
        return self._column(at.SUMMARY_FRICTION)

    @property
    def static_margin(self) -> FloatArray:
        """Smallest static stability margin [m]; NaN without margins."""
        return self._column(at.SUMMARY_STABILITY)

    @property
    def energy(self) -> FloatArray:
        """Smallest energy margin along the flow [m]; NaN without margins."""
        return self._column(at.SUMMARY_ENERGY)

    @property
    def belly_touches(self) -> BoolArray:
        """Whether the belly touches the ground somewhere."""
        return self.table[:, at.SUMMARY_BELLY] > 0.0
