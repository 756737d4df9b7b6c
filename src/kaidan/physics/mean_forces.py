"""Forces on a robot from what it does to its momentum: means over a time, whatever the time step.

A blow of a rigid belt on a rigid riser lasts as long as the contact's stiffness and the time step
let it: its peak is a property of the simulation, its impulse one of the robot. So what is reported
as largest is the mean over `WINDOW`.
"""

import math

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics.moving_body import MovingBody

WINDOW = 0.02
"""Time over which forces are averaged [s]."""


class MeanForces:
    """Forces of the ground on the robot, mean over the last 20 ms, and the largest of them."""

    def __init__(self, body: MovingBody) -> None:
        self.body = body
        self.seen: list[tuple[float, float, float]] = []
        """Time [s] and velocity in x and z [m/s] within the window."""
        self.normal = self.traction = math.nan
        """Normal to the line of the nosings; along the track, what drives the robot [N]."""
        self.largest_normal = self.largest_traction = self.largest_power = 0.0

    def look(self, time: float) -> None:
        """Take the velocity at a time since the drive began [s]."""
        body = self.body
        self.seen.append((time, *body.rates()))
        while len(self.seen) > 2 and time - self.seen[1][0] > WINDOW * (1.0 - 1e-9):
            self.seen.pop(0)
        began, was_x, was_z = self.seen[0]
        if time <= began:
            return
        mass, phi = body.spec.mass()[0], body.pose()[2]
        v_x, v_z = body.rates()
        f_x = mass * (v_x - was_x) / (time - began)
        f_z = mass * ((v_z - was_z) / (time - began) + STANDARD_GRAVITY)
        along = body.course.along
        self.normal = float(f_z * along[0] - f_x * along[1])
        self.traction = f_x * math.cos(phi) + f_z * math.sin(phi)
        self.largest_normal = max(self.largest_normal, self.normal)
        if abs(self.traction) > self.largest_traction:
            self.largest_traction = abs(self.traction)
        power = abs(self.traction) * body.belt.speed(time)
        self.largest_power = max(self.largest_power, power)
