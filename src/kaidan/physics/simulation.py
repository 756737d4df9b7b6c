"""The running simulation of a model: its state as the trial sees it, and how it is advanced."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics.belt_speed import Belt
from kaidan.physics.engine import engine
from kaidan.physics.forces import Forces
from kaidan.physics.model import ROBOT, Model

Array = NDArray[np.float64]

SETTLE = {"smooth-belt": 0.1, "sprung-noses": 0.4, "driven-grousers": 0.4, "shoe-chain": 0.4}
"""Time on the tether [s], by model of the track."""
STANDS = 0.5
"""Time free with the track at rest [s], in which what cannot stand begins to fall."""
FALLEN = math.radians(45.0)
"""Inclination beyond the line of the nosings, or beyond level, from which it has fallen [rad]."""
STARTED_TO_FALL = math.radians(15.0)
"""Rotation before the track moves that counts as a fall at the start [rad]."""
WILD = 30.0
"""Speed that nothing here reaches [m/s]: beyond it the simulation has diverged."""


class Simulation:
    """One run of a model."""

    def __init__(self, model: Model) -> None:
        self.mujoco = engine()
        self.model, self.spec, self.course = model, model.spec, model.course
        self.compiled = model.compiled
        self.data = self.mujoco.MjData(self.compiled)
        self.body = int(self.compiled.body(ROBOT).id)
        self.joints = self._addresses() if self.spec.dimensions == 2 else None
        self.belt = Belt(model)
        self.forces = Forces(model)
        self.heading_slope = math.asin(
            math.sin(self.course.slope) * math.cos(self.spec.question.yaw)
        )

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
        x, z, phi = self.pose()
        if self.joints is not None:
            c, s = math.cos(phi), math.sin(phi)
            return x + c * along - s * up, z + s * along + c * up
        away = self.axes @ np.array([along, 0.0, up])
        return x + float(away[0]), z + float(away[2])

    def along_nosings(self, end: float) -> float:
        """Place of an end of the flat along the line of the nosings [m].

        Parameters
        ----------
        end : float
            Along the track from the centroid [m].
        """
        place = self.point(end, -self.course.outline.stance.com_height)
        return float(np.array(place) @ self.course.along)

    def velocity(self) -> float:
        """Speed of the centroid along the track [m/s]."""
        if self.joints is not None:
            v_x, v_z, _ = self.data.qvel[self.joints[1]]
            phi = self.data.qpos[self.joints[0][2]]
            return float(v_x * math.cos(phi) + v_z * math.sin(phi))
        return float(self.data.qvel[:3] @ self.axes[:, 0])

    def extra(self, phi: float) -> float:
        """Inclination beyond the line of the nosings towards the downhill end [rad]."""
        beyond = phi - self.heading_slope
        return -beyond if self.course.down else beyond

    def fallen(self, phi: float) -> bool:
        """Whether it has tipped over either end."""
        low, high = min(0.0, self.course.slope), max(0.0, self.course.slope)
        return not low - FALLEN <= phi <= high + FALLEN

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

    def settle(self) -> bool:
        """Let it rest, on a tether and then free; whether it stands."""
        mass, slope = self.spec.mass()[0], self.course.slope
        pull = mass * STANDARD_GRAVITY * math.sin(slope)
        phi = self.pose()[2]
        for tether, time in ((pull, SETTLE[self.spec.track.kind]), (0.0, STANDS)):
            steps = max(4, round(time / self.spec.step))
            self.data.xfrc_applied[self.body, 0] = tether * math.cos(slope)
            self.data.xfrc_applied[self.body, 2] = tether * math.sin(slope)
            for part in range(4):
                self.drive(0.0, steps // 4 + (part < steps % 4), on=False)
                now = self.pose()[2]
                if self.diverged():
                    return False
                if abs(now - phi) > STARTED_TO_FALL or self.fallen(now):
                    return False
        return True

    def set_going(self) -> None:
        """Give the robot the belt's speed, where it starts moving."""
        if self.belt.ramp > 0.0:
            return
        speed = self.belt.speed(0.0)
        phi = self.pose()[2]
        if self.joints is not None:
            self.data.qvel[self.joints[1]] += (speed * math.cos(phi), speed * math.sin(phi), 0.0)
            return
        self.data.qvel[:3] += speed * self.axes[:, 0]

    def servo_power(self) -> float:
        """Power that the grousers take from the belt [W].

        From the state at the end of the step, as the integrator sees the servos; the force that
        the engine reports is that at its beginning, off by stiffness times a step's path.
        """
        joints = self.compiled.actuator_trnid[:, 0]
        place = self.data.qpos[self.compiled.jnt_qposadr[joints]]
        speed = self.data.qvel[self.compiled.jnt_dofadr[joints]]
        stiff, damping = self.compiled.actuator_gainprm[:, 0], self.compiled.actuator_biasprm[:, 2]
        return float((stiff * (self.data.ctrl - place) + damping * speed) @ speed)
