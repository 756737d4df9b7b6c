"""The running simulation of a model: its state as the trial sees it, and how it is advanced."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.physics.belt_speed import Belt
from kaidan.physics.engine import engine
from kaidan.physics.forces import Forces
from kaidan.physics.model import ROBOT, Model
from kaidan.physics.moving_body import WILD, MovingBody

Array = NDArray[np.float64]

SETTLE = {"smooth-belt": 0.1, "sprung-noses": 0.4, "driven-grousers": 0.4, "shoe-chain": 0.4}
"""Time on the tether [s], by model of the track."""
STANDS = 0.5
"""Time free with the track at rest [s], in which what cannot stand begins to fall."""


class Simulation(MovingBody):
    """One run of a model in MuJoCo."""

    def __init__(self, model: Model) -> None:
        self.mujoco = engine()
        self.model, self.spec, self.course = model, model.spec, model.course
        self.compiled = model.compiled
        self.data = self.mujoco.MjData(self.compiled)
        self.body = int(self.compiled.body(ROBOT).id)
        self.joints = self._addresses() if self.spec.dimensions == 2 else None
        at_once = bool(model.field.any()) and model.motion is None
        self.belt = Belt(self.spec, self.course, at_once=at_once)
        self.forces = Forces(model)

    def _addresses(self) -> tuple[Any, Any]:
        place = [int(self.compiled.joint(name).qposadr[0]) for name in ("x", "z", "phi")]
        speed = [int(self.compiled.joint(name).dofadr[0]) for name in ("x", "z", "phi")]
        return np.array(place), np.array(speed)

    def pose(self) -> tuple[float, float, float]:
        """Centroid x, z [m] and inclination [rad]."""
        if self.joints is not None:
            x, z, phi = self.data.qpos[self.joints[0]].tolist()
            return x, z, phi
        axes = self.axes
        ahead, up = axes[:, 0], axes[:, 2]
        level = math.hypot(ahead[0], ahead[1])
        phi = math.atan2(ahead[2], level if up[2] >= 0 else -level)
        return float(self.data.qpos[0]), float(self.data.qpos[2]), phi

    @property
    def axes(self) -> Array:
        """Axes of the body as columns, in space."""
        whole = np.zeros(9)
        self.mujoco.mju_quat2Mat(whole, self.data.qpos[3:7])
        return whole.reshape(3, 3)

    def point(self, along: float, up: float) -> tuple[float, float]:
        """Place x, z [m] of a point of the robot, from the centroid along the track and up."""
        if self.joints is not None:
            return super().point(along, up)
        x, z, _ = self.pose()
        away = self.axes @ np.array([along, 0.0, up])
        return x + float(away[0]), z + float(away[2])

    def rates(self) -> tuple[float, float]:
        """Velocity of the centroid in x and z [m/s]."""
        places = (0, 2) if self.joints is None else self.joints[1][:2]
        v_x, v_z = self.data.qvel[list(places)].tolist()
        return v_x, v_z

    def velocity(self) -> float:
        """Speed of the centroid along the track [m/s]."""
        if self.joints is not None:
            return super().velocity()
        return float(self.data.qvel[:3] @ self.axes[:, 0])

    def contact_forces(self) -> tuple[Array, Array, int]:
        """Forces of nosings and on grousers at this moment, and the number of contacts."""
        return self.forces.read(self.data)

    def configuration(self) -> Array:
        """State of the model."""
        return np.array(self.data.qpos)

    def in_space(self) -> tuple[float, ...]:
        """Place across [m], yaw and roll [deg]; nothing in the plane."""
        if self.joints is not None:
            return ()
        axes = self.axes
        yaw = math.atan2(axes[1, 0], axes[0, 0])
        roll = math.atan2(axes[2, 1], axes[2, 2])
        return float(self.data.qpos[1]), math.degrees(yaw), math.degrees(roll)

    @property
    def tether(self) -> tuple[tuple[float, float], ...]:
        """It settles on the tether, then stands free."""
        return (1.0, SETTLE[self.spec.track.kind]), (0.0, STANDS)

    def pull(self, force: float) -> None:
        """Pull at the centroid up the line of the nosings [N]."""
        slope = self.course.slope
        self.data.xfrc_applied[self.body, 0] = force * math.cos(slope)
        self.data.xfrc_applied[self.body, 2] = force * math.sin(slope)

    def diverged(self) -> bool:
        """Whether the simulation has left the realm of robots."""
        if any(int(self.data.warning[k].number) for k in self._bad):
            return True
        speed = self.data.qvel if self.joints is None else self.data.qvel[self.joints[1][:2]]
        return not (np.isfinite(self.data.qpos).all() and bool((np.abs(speed) < WILD).all()))

    @property
    def _bad(self) -> tuple[int, ...]:
        kinds = self.mujoco.mjtWarning
        names = ("mjWARN_BADQPOS", "mjWARN_BADQVEL", "mjWARN_BADQACC")
        return tuple(int(getattr(kinds, name)) for name in names)

    def drive(self, time: float, steps: int, on: bool) -> None:
        """Advance by some steps, the belt at its speed (or at rest)."""
        motion, data, step = self.model.motion, self.data, self.mujoco.mj_step
        steady = not on or self.belt.steady(time)
        self.set_surface(self.belt.speed(time) if on else 0.0)
        if steady and motion is None:
            step(self.compiled, data, steps)
            return
        for k in range(steps):  # in as many strides as a change of speed or of places takes
            now = time + k * self.spec.step
            if not steady:
                self.set_surface(self.belt.speed(now))
            if motion is not None:
                data.ctrl[:] = motion.targets(self.belt.run(now) if on else 0.0)
            step(self.compiled, data)

    def set_surface(self, speed: float) -> None:
        """Let the belt run at a speed [m/s]."""
        if self.model.field.any():
            self.compiled.geom_surfacevel[:] = self.model.field * speed
        else:  # the sprocket of a chain
            sprocket = self.compiled.geom("sprocket")
            self.compiled.geom_surfacevel[sprocket.id, 5] = speed / float(sprocket.size[0])

    def set_going(self) -> None:
        """Give the robot the belt's speed, where it starts moving."""
        if self.belt.ramp > 0.0:
            return
        speed, way = self.belt.speed(0.0), self.sets_out
        if self.joints is not None:
            self.data.qvel[self.joints[1]] += (speed * math.cos(way), speed * math.sin(way), 0.0)
            return
        ahead = self.axes[:, 0] * (1.0, 1.0, self.spec.begin == "flight")
        self.data.qvel[:3] += speed * ahead / np.linalg.norm(ahead)
