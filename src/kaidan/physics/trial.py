"""A trial from start to end: settle, release, drive, tell what happened.

`run` is a pure function of its `TrialSpec`: the same in any process and on any machine with the
same MuJoCo.
"""

import math
from importlib.metadata import version
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics.engine import engine, engine_version, quiet
from kaidan.physics.forces import Forces
from kaidan.physics.model import ROBOT, Model, model_of
from kaidan.physics.outcome import Outcome, TrialLog, TrialResult
from kaidan.physics.pace import Belt
from kaidan.physics.spec import TrialSpec

Array = NDArray[np.float64]

SETTLE = {"smooth-belt": 0.1, "sprung-noses": 0.4, "driven-grousers": 0.4, "shoe-chain": 0.4}
"""Time on the tether [s], by model of the track."""
STANDS = 0.5
"""Time free with the track at rest [s], in which what cannot stand begins to fall."""
FALLEN = math.radians(45.0)
"""Turn beyond the line of the nosings, or beyond level, from which it has fallen [rad]."""
STARTED_TO_FALL = math.radians(15.0)
"""Turn before the track moves that counts as a fall at the start [rad]."""
SWINGING = math.radians(3.0)
"""Turn beyond which slipping is first of all a part of the swing [rad]."""
RESTED = math.radians(15.0)
"""Turn beyond which a robot at the end of its course is still falling [rad]."""
PATIENCE = 2.0
"""Times the time it takes, after which it is given up, and `GRACE` more."""
GRACE = 2.0
WILD = 30.0
"""Speed that nothing here reaches [m/s]: beyond it the simulation has diverged."""
CHUNK = 0.02
"""Longest time between looks at what happens [s]."""


def run(spec: TrialSpec, *, log: bool = False) -> TrialResult:
    """Run a trial.

    Parameters
    ----------
    spec : TrialSpec
        All that it depends on.
    log : bool
        Whether to keep what happened over time.

    Returns
    -------
    TrialResult
        A simulation that diverges is the outcome `unstable`.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed.
    """
    began = perf_counter()
    with quiet():
        return Simulation(model_of(spec), keep=log).result(began)


class Simulation:
    """One run of a model."""

    def __init__(self, model: Model, *, keep: bool) -> None:
        self.mujoco = engine()
        self.model, self.spec, self.course = model, model.spec, model.course
        self.keep = keep
        self.compiled = model.compiled
        self.data = self.mujoco.MjData(self.compiled)
        self.body = int(self.compiled.body(ROBOT).id)
        self.flat = self.spec.dimensions == 2
        self.joints = None if not self.flat else self._addresses()
        self.belt = Belt(model)
        self.forces = Forces(model)
        self.heading_slope = math.asin(math.sin(self.course.slope) * math.cos(self.spec.yaw))
        self.rows: list[tuple[float, ...]] = []
        self.by_nosing: list[Array] = []
        self.poses: list[Array] = []
        self.progress = 0.0
        self.way_at_start = 0.0
        self.largest = 0.0
        self.passed = 0

    def _addresses(self) -> tuple[Any, Any]:
        place = [int(self.compiled.joint(name).qposadr[0]) for name in ("x", "z", "phi")]
        speed = [int(self.compiled.joint(name).dofadr[0]) for name in ("x", "z", "phi")]
        return np.array(place), np.array(speed)

    def pose(self) -> tuple[float, float, float]:
        """Centroid x, z [m] and inclination [rad]."""
        if self.joints is not None:
            x, z, phi = self.data.qpos[self.joints[0]].tolist()
            return x, z, phi
        ahead, up = self._turn[:, 0], self._turn[:, 2]
        level = math.hypot(ahead[0], ahead[1])
        phi = math.atan2(ahead[2], level if up[2] >= 0 else -level)
        return float(self.data.qpos[0]), float(self.data.qpos[2]), phi

    @property
    def _turn(self) -> Array:
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
        away = self._turn @ np.array([along, 0.0, up])
        return x + float(away[0]), z + float(away[2])

    def velocity(self) -> float:
        """Speed of the centroid along the track [m/s]."""
        if self.joints is not None:
            v_x, v_z, _ = self.data.qvel[self.joints[1]]
            phi = self.data.qpos[self.joints[0][2]]
            return float(v_x * math.cos(phi) + v_z * math.sin(phi))
        return float(self.data.qvel[:3] @ self._turn[:, 0])

    def extra(self, phi: float) -> float:
        """Turn beyond the line of the nosings towards the downhill end [rad]."""
        turn = phi - self.heading_slope
        return -turn if self.course.down else turn

    def fallen(self, phi: float) -> bool:
        """Whether it has turned over either end."""
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
        self._set_surface(self.belt.speed(time) if on else 0.0)
        if steady and motion is None:
            step(self.compiled, data, steps)
            return
        for k in range(steps):  # in as many strides as a change of speed or of places asks for
            now = time + k * self.spec.step
            if not steady:
                self._set_surface(self.belt.speed(now))
            if motion is not None:
                data.ctrl[:] = motion.targets(self.belt.run(now) if on else 0.0)
            step(self.compiled, data)

    def _set_surface(self, speed: float) -> None:
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
        self.data.qvel[:3] += speed * self._turn[:, 0]

    def result(self, began: float) -> TrialResult:
        """Run it and tell."""
        outcome = self._until_the_end()
        offset, phase = self.spec.drawn()
        table = np.array(self.rows) if self.rows else np.zeros((0, len(self.names)))
        columns = {name: table[:, k].copy() for k, name in enumerate(self.names)}
        forces = np.array(self.by_nosing) if self.by_nosing else np.zeros((0, 0, 2))
        failed = outcome in (Outcome.FELL_BACKWARD, Outcome.FELL_FORWARD, Outcome.SLID)
        torque = columns["torque_Nm"]
        mass, assumed = self.spec.mass()
        return TrialResult(
            spec=self.spec,
            outcome=outcome,
            largest_extra_deg=math.degrees(self.largest),
            release=self.passed_at_worst if failed else None,
            releases=self.passed,
            largest_normal=float(forces[..., 1].max(initial=0.0)),
            largest_traction=float(np.abs(columns["traction_N"]).max(initial=0.0)),
            largest_torque=None
            if np.isnan(torque).any()
            else float(np.abs(torque).max(initial=0.0)),
            largest_power=float(np.abs(columns["power_W"]).max(initial=0.0)),
            slip=float(columns["slip_m"][-1]) if len(table) else 0.0,
            time=float(columns["time_s"][-1]) if len(table) else 0.0,
            start_offset=offset,
            grouser_phase=phase,
            mass=mass,
            mass_assumed=assumed,
            inertia_estimated=self.course.outline.gyration_estimated,
            wall_time=perf_counter() - began,
            versions={"kaidan": version("kaidan"), "mujoco": engine_version()},
            log=TrialLog(
                columns=columns, forces=forces, poses=np.array(self.poses)
            ) if self.keep else None,
        )  # fmt: skip

    @property
    def names(self) -> tuple[str, ...]:
        """Columns of the log."""
        space = () if self.flat else ("y_m", "yaw_deg", "roll_deg")
        return (
            "time_s", "belt_m", "x_m", "z_m", "inclination_deg", "extra_deg", "way_m", "slip_m",
            "speed_m_s", "normal_N", "traction_N", "torque_Nm", "power_W", "contacts", *space,
        )  # fmt: skip

    def _until_the_end(self) -> Outcome:
        self.passed_at_worst = 0
        if not self.settle():
            return Outcome.UNSTABLE if self.diverged() else Outcome.START_FALL
        self.set_going()
        course, spec = self.course, self.spec
        ways = course.nosings
        self.way_at_start = self._end_way()
        ahead_at_start = int((ways <= self.way_at_start).sum())
        expected = self.belt.duration(course.distance)
        limit = PATIENCE * expected + GRACE
        steps = max(1, round(min(spec.log_interval, CHUNK) / spec.step))
        every = max(1, round(spec.log_interval / (steps * spec.step)))
        time, turn = 0.0, 0
        furthest, slip_then = 0, 0.0
        allowed = self._allowed_slip()
        while time < limit:
            before = self.velocity()
            self.drive(time, steps, on=True)
            time += steps * spec.step
            turn += 1
            if self.diverged():
                return Outcome.UNSTABLE
            self.progress += 0.5 * (before + self.velocity()) * steps * spec.step
            x, z, phi = self.pose()
            way = self._end_way()
            self.passed = max(self.passed, int((ways <= way).sum()) - ahead_at_start)
            extra = self.extra(phi)
            self.largest = max(self.largest, extra)
            slip = self.belt.run(time) - self.progress
            if turn % every == 0:
                self._note(time, x, z, phi, way, slip)
            if extra < math.radians(5.0):
                self.passed_at_worst = self.passed
            if self.fallen(phi):
                nose_up = (phi > course.slope) == (spec.facing == "nose-first")
                return Outcome.FELL_BACKWARD if nose_up else Outcome.FELL_FORWARD
            reached = self.passed + int((ways <= self._end_way(uphill=True)).sum())
            if reached > furthest:  # it gets on; what it lost in a swing is forgotten
                furthest, slip_then = reached, max(slip, 0.0)
            lost = max(slip - slip_then, -2.0 * slip)  # running away, half as much tells
            if lost > allowed * (1.0 if abs(extra) < SWINGING else 4.0):
                return Outcome.SLID
            done = way >= course.goal or self.point(course.rear, 0.0)[0] >= course.goal_x
            if done and extra < RESTED:
                return Outcome.CLIMBED
        return Outcome.TIMED_OUT

    def _allowed_slip(self) -> float:
        """Slip since the last nosing was passed beyond which it slides [m].

        Going over an edge, belt and centroid differ by less than that.
        """
        if self.spec.begin == "flight":
            return self.course.spacing
        back, ahead = self.course.outline.reach
        return back + ahead

    def _end_way(self, *, uphill: bool = False) -> float:
        """Way of the downhill (or uphill) end of the flat along the line of the nosings [m]."""
        place = self.course.uphill_end if uphill else self.course.downhill_end
        end = self.point(place, -self.course.outline.stance.com_height)
        return float(np.array(end) @ self.course.along)

    def _servo_power(self) -> float:
        """Power that the grousers take from the belt [W].

        From the state at the end of the step, as the integrator sees the servos; the force that
        the engine reports is that at its beginning, off by stiffness times a step's way.
        """
        joints = self.compiled.actuator_trnid[:, 0]
        place = self.data.qpos[self.compiled.jnt_qposadr[joints]]
        speed = self.data.qvel[self.compiled.jnt_dofadr[joints]]
        stiff, damping = self.compiled.actuator_gainprm[:, 0], self.compiled.actuator_biasprm[:, 2]
        return float((stiff * (self.data.ctrl - place) + damping * speed) @ speed)

    def _note(self, time: float, x: float, z: float, phi: float, way: float, slip: float) -> None:
        """Add a row to the log."""
        by_nosing, normal, traction, contacts = self.forces.read(self.data)
        speed = self.belt.speed(time)
        if self.model.motion is not None and speed > 0.0:
            traction += self._servo_power() / speed
        radius = self.spec.robot.drive.sprocket_radius or self.spec.robot.track.rear_radius
        torque = traction * radius if radius else math.nan
        row = [
            time, self.belt.run(time), x, z, math.degrees(phi), math.degrees(self.extra(phi)),
            way - self.way_at_start, slip, self.velocity(), normal, traction, torque,
            traction * speed, float(contacts),
        ]  # fmt: skip
        if not self.flat:
            turn = self._turn
            yaw = math.atan2(turn[1, 0], turn[0, 0])
            roll = math.atan2(turn[2, 1], turn[2, 2])
            row += [float(self.data.qpos[1]), math.degrees(yaw), math.degrees(roll)]
        self.rows.append(tuple(row))
        self.by_nosing.append(by_nosing)
        if self.keep:
            self.poses.append(self.data.qpos.copy())
