"""The robot in motion as a trial sees it, whatever advances it."""

import math
from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics.belt_speed import Belt
from kaidan.physics.initial_pose import Course
from kaidan.physics.outcome import Outcome
from kaidan.physics.spec import TrialSpec

Array = NDArray[np.float64]

FALLEN = math.radians(45.0)
"""Inclination beyond the line of the nosings, or beyond level, from which it has fallen [rad]."""
STARTED_TO_FALL = math.radians(15.0)
"""Rotation before the track moves that counts as a fall at the start [rad]."""
LEFT_ITS_PLACE = 0.5
"""Spacings by which a robot that stands does not move before the track does."""
WILD = 30.0
"""Speed that nothing here reaches [m/s]: beyond it the simulation has diverged."""


class MovingBody(ABC):
    """A robot that can be driven and looked at."""

    spec: TrialSpec
    course: Course
    belt: Belt

    @abstractmethod
    def pose(self) -> tuple[float, float, float]:
        """Centroid x, z [m] and inclination [rad]."""

    @abstractmethod
    def rates(self) -> tuple[float, float]:
        """Velocity of the centroid in x and z [m/s]."""

    @abstractmethod
    def drive(self, time: float, steps: int, on: bool) -> None:
        """Advance by some steps, the belt at its speed (or at rest)."""

    @abstractmethod
    def pull(self, force: float) -> None:
        """Pull at the centroid up the line of the nosings [N], from now on."""

    @abstractmethod
    def set_going(self) -> None:
        """Give the robot the belt's speed, where it starts moving."""

    @property
    def sets_out(self) -> float:
        """Inclination at which it sets out [rad]: its own on the flight, level on the landing."""
        return self.pose()[2] if self.spec.begin == "flight" else 0.0

    @abstractmethod
    def diverged(self) -> bool:
        """Whether the simulation has left the realm of robots."""

    @abstractmethod
    def contact_forces(self) -> tuple[Array, Array, int]:
        """Forces along the line of the nosings and normal to it [N], and the number of contacts.

        On the robot from each nosing, shape (nosings, 2), and on each grouser, (grousers, 2).
        """

    @abstractmethod
    def configuration(self) -> Array:
        """State from which a picture is drawn."""

    def in_space(self) -> tuple[float, ...]:
        """Place across [m], yaw and roll [deg]; nothing in the plane."""
        return ()

    @property
    @abstractmethod
    def tether(self) -> tuple[tuple[float, float], ...]:
        """Shares of the slope's pull that a tether carries while it settles, each with a time [s].

        At last it stands free.
        """

    def point(self, along: float, up: float) -> tuple[float, float]:
        """Place x, z [m] of a point of the robot, from the centroid along the track and up."""
        x, z, phi = self.pose()
        c, s = math.cos(phi), math.sin(phi)
        return x + c * along - s * up, z + s * along + c * up

    def along_nosings(self, end: float) -> float:
        """Place of an end of the flat along the line of the nosings [m].

        end: along the track from the centroid [m].
        """
        place = self.point(end, -self.course.outline.stance.com_height)
        return float(np.array(place) @ self.course.along)

    def velocity(self) -> float:
        """Speed of the centroid along the track [m/s]."""
        (v_x, v_z), phi = self.rates(), self.pose()[2]
        return v_x * math.cos(phi) + v_z * math.sin(phi)

    def extra(self, phi: float) -> float:
        """Inclination beyond the line of the nosings towards the downhill end [rad]."""
        beyond = phi - self.heading_slope
        return -beyond if self.course.down else beyond

    @property
    def heading_slope(self) -> float:
        """Slope of the nosings along the heading [rad]."""
        return math.asin(math.sin(self.course.slope) * math.cos(self.spec.question.yaw))

    def fallen(self, phi: float) -> bool:
        """Whether it has tipped over either end."""
        low, high = min(0.0, self.course.slope), max(0.0, self.course.slope)
        return not low - FALLEN <= phi <= high + FALLEN

    def settle(self) -> Outcome | None:
        """Let it rest, on a tether and then free: how that ended; None: it stands in its place.

        On the landing no slope pulls at it, and the tether is slack.
        """
        course, on_the_flight = self.course, self.spec.begin == "flight"
        pull = self.spec.mass()[0] * STANDARD_GRAVITY * math.sin(course.slope) * on_the_flight
        phi, place = self.pose()[2], self.along_nosings(course.downhill_end)
        for share, time in self.tether:
            steps = max(4, round(time / self.spec.step))
            self.pull(share * pull)
            for part in range(4):
                self.drive(0.0, steps // 4 + (part < steps % 4), on=False)
                now = self.pose()[2]
                if self.diverged():
                    return Outcome.UNSTABLE
                if abs(now - phi) > STARTED_TO_FALL or self.fallen(now):
                    return Outcome.START_FALL
                moved = self.along_nosings(course.downhill_end) - place
                if abs(moved) > LEFT_ITS_PLACE * course.spacing:
                    return Outcome.SLID
        return None
