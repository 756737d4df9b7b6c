"""How fast the belt runs: constant, or at the acceleration of the question."""

import math

from kaidan.physics.initial_pose import Course
from kaidan.physics.spec import TrialSpec

RAMP = 0.4
"""Time in which grousers and chains come to speed [s]; belts start with the robot moving."""


class Belt:
    """How fast the belt runs and how far it has run.

    at_once: whether the robot moves when the drive begins; else it comes to speed in `RAMP`.
    """

    def __init__(self, spec: TrialSpec, course: Course, *, at_once: bool) -> None:
        self.lowest = spec.speed
        acceleration = spec.question.acceleration
        self.along = -acceleration if spec.downhill else acceleration
        self.ramp = 0.0 if at_once else RAMP
        gain = 2 * abs(self.along) * course.distance
        self.first = math.sqrt(spec.speed**2 + gain) if self.along < 0 else spec.speed
        self.coasting = (
            (self.lowest - self.first) / self.along if self.along < 0 else math.inf
        )  # when it has come down to the lowest speed

    def speed(self, time: float) -> float:
        """Speed [m/s] at a time since the drive began [s]."""
        if time < self.ramp:
            return self.first * time / self.ramp
        return self.first + self.along * min(time - self.ramp, self.coasting)

    def steady(self, time: float) -> bool:
        """Whether the speed changes no more after that time."""
        return time >= self.ramp and (self.along == 0.0 or time - self.ramp >= self.coasting)

    def run(self, time: float) -> float:
        """How far the belt has run [m]."""
        if time < self.ramp:
            return 0.5 * self.first * time**2 / self.ramp
        since = time - self.ramp
        gained = min(since, self.coasting)
        after = (since - gained) * self.lowest if since > gained else 0.0
        return (
            0.5 * self.first * self.ramp
            + self.first * gained
            + 0.5 * self.along * gained**2
            + after
        )

    def duration(self, distance: float) -> float:
        """Time for a distance [s]."""
        low, high = 0.0, self.ramp + distance / self.lowest + 1.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if self.run(middle) < distance else (low, middle)
        return high
