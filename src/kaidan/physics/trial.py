"""A trial from start to end: settle, set going, drive, report what happened.

`run` is a pure function of its `TrialSpec`: the same in any process and on any machine with the
same MuJoCo.
"""

import math
from importlib.metadata import version
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from kaidan.modes import Phase
from kaidan.physics.engine import engine_version, quiet
from kaidan.physics.mean_forces import MeanForces
from kaidan.physics.model import model_of
from kaidan.physics.moving_body import MovingBody
from kaidan.physics.outcome import Outcome, TrialLog, TrialResult
from kaidan.physics.planar import RubberBody
from kaidan.physics.simulation import Simulation
from kaidan.physics.spec import TrialSpec
from kaidan.physics.tracks import YieldingBelt
from kaidan.traversal.phases import flights_span, step_at

Array = NDArray[np.float64]

UPRIGHT = math.radians(5.0)
"""Extra inclination up to which it is not falling: where it was so last is where it fell [rad]."""
ROTATING = math.radians(3.0)
"""Extra inclination beyond which slip is first of all a part of a rotation [rad]."""
RESTED = math.radians(15.0)
"""Extra inclination beyond which a robot at the end of its course is still falling [rad]."""
PATIENCE = 2.0
"""Times the time it takes, after which it is given up, and `GRACE` more."""
GRACE = 2.0
LONGEST = 3600.0
"""Time of the robot that a trial may take [s]: half a minute of computing for a smooth belt."""
CHUNK = 0.02
"""Longest time between looks at what happens [s]."""

_COLUMNS = (
    "time_s", "belt_m", "x_m", "z_m", "inclination_deg", "extra_deg", "path_m", "slip_m",
    "speed_m_s", "normal_N", "traction_N", "torque_Nm", "power_W", "contacts",
)  # fmt: skip
_IN_SPACE = ("y_m", "yaw_deg", "roll_deg")


def run(spec: TrialSpec) -> TrialResult:
    """Run a trial.

    Parameters
    ----------
    spec : TrialSpec
        All that it depends on.

    Returns
    -------
    TrialResult
        A simulation that diverges is the outcome `unstable`.

    Raises
    ------
    InputError
        A terrain of too many boxes, or a trial that takes longer than an hour.
    MissingExtraError
        MuJoCo is not installed.
    """
    return record(spec).result


def record(spec: TrialSpec) -> TrialLog:
    """Run a trial and keep what happened over time.

    Parameters
    ----------
    spec : TrialSpec
        All that it depends on.

    Returns
    -------
    TrialLog
        With the result that `run` gives.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed.
    """
    began = perf_counter()
    if isinstance(spec.track, YieldingBelt):
        drive = _Drive(RubberBody(spec))
        return drive.log(drive.outcome(), began)
    with quiet():
        drive = _Drive(Simulation(model_of(spec)))
        return drive.log(drive.outcome(), began)


class _Drive:
    """A simulation driven to its end, and what is noted on the path."""

    def __init__(self, simulation: MovingBody) -> None:
        self.simulation = simulation
        self.spec, self.course = simulation.spec, simulation.course
        self.rows: list[tuple[float, ...]] = []
        self.by_nosing: list[Array] = []
        self.by_grouser: list[Array] = []
        self.poses: list[Array] = []
        self.driven = 0.0
        """How far the robot drove along its track [m]."""
        self.start = 0.0
        """Place of the downhill end along the nosings at the start [m]."""
        self.behind_at_start = 0
        self.largest = 0.0
        self.passed = 0
        self.furthest, self.slip_then = 0, 0.0
        """Nosings that both ends had reached at most, and the slip by then [m]."""
        self.forces = MeanForces(simulation)
        self.ends = (0.0, 0.0)
        """x of the trailing and the leading end of the flat when it was upright last [m]."""

    def outcome(self) -> Outcome:
        """Drive to the end."""
        simulation, course, spec = self.simulation, self.course, self.spec
        expected = simulation.belt.duration(course.distance)
        if expected > LONGEST:
            raise spec.refuse(
                f"it takes {expected / 3600:.1f} h at {spec.speed:g} m/s; at most "
                f"{LONGEST / 3600:g} h is simulated"
            )
        ended = simulation.settle()
        if ended is not None:
            return ended
        simulation.set_going()
        self.start = simulation.along_nosings(course.downhill_end)
        self.behind_at_start = int((course.nosings <= self.start).sum())
        limit = PATIENCE * expected + GRACE
        steps = max(1, round(min(spec.log_interval, CHUNK) / spec.step))
        every = max(1, round(spec.log_interval / (steps * spec.step)))
        self.forces.look(0.0)
        time, looks = 0.0, 0
        while time < limit:
            before = simulation.velocity()
            simulation.drive(time, steps, on=True)
            time += steps * spec.step
            looks += 1
            if simulation.diverged():
                return Outcome.UNSTABLE
            self.driven += 0.5 * (before + simulation.velocity()) * steps * spec.step
            ended = self._look(time, noted=looks % every == 0)
            if ended is not None:
                return ended
        return Outcome.TIMED_OUT

    def _look(self, time: float, *, noted: bool) -> Outcome | None:
        """How the trial ended; None: it goes on."""
        simulation, course = self.simulation, self.course
        x, z, phi = simulation.pose()
        at = simulation.along_nosings(course.downhill_end)
        self.passed = max(self.passed, int((course.nosings <= at).sum()) - self.behind_at_start)
        extra = simulation.extra(phi)
        self.largest = max(self.largest, extra)
        slip = simulation.belt.run(time) - self.driven
        self.forces.look(time)
        if noted:
            self._note(time, x, z, phi, at, slip)
        if extra < UPRIGHT:
            low = -course.outline.stance.com_height
            self.ends = (
                simulation.point(course.rear, low)[0],
                simulation.point(course.front, low)[0],
            )
        if simulation.fallen(phi):
            nose_up = (phi > course.slope) == (self.spec.question.facing == "nose-first")
            return Outcome.FELL_BACKWARD if nose_up else Outcome.FELL_FORWARD
        if self._slides(slip, extra):
            return Outcome.STALLED if self._would_hold(phi) else Outcome.SLID
        done = at >= course.goal or simulation.point(course.rear, 0.0)[0] >= course.goal_x
        return Outcome.CLIMBED if done and extra < RESTED else None

    def _slides(self, slip: float, extra: float) -> bool:
        """Whether it has lost too much since it reached a further nosing."""
        uphill = self.simulation.along_nosings(self.course.uphill_end)
        reached = self.passed + int((self.course.nosings <= uphill).sum())
        if reached > self.furthest:  # it gets on; what it lost in a rotation is forgotten
            self.furthest, self.slip_then = reached, max(slip, 0.0)
        lost = max(slip - self.slip_then, -2.0 * slip)  # running away, half as much tells
        return lost > self._allowed_slip * (1.0 if abs(extra) < ROTATING else 4.0)

    def _would_hold(self, phi: float) -> bool:
        """Whether it is on the flight, and friction more than what it takes to rest there."""
        steepest = max(abs(phi), abs(self.course.slope))
        return self._place()[0] is Phase.TRAVERSE and self.spec.static_friction > math.tan(
            min(steepest, 0.5 * math.pi - 1e-9)
        )

    @property
    def _allowed_slip(self) -> float:
        """Slip since the last nosing was passed beyond which it slides [m].

        Going over an edge, belt and centroid differ by less than that.
        """
        if self.spec.begin == "flight":
            return self.course.spacing
        back, ahead = self.course.outline.reach
        return back + ahead

    def _place(self) -> tuple[Phase, int]:
        """Part of the traverse, and nosing that the leading end had reached, when last upright."""
        rear, front = self.ends
        profile, down = self.course.profile, self.spec.downhill
        first, last = flights_span(profile, down)
        step = max(1, step_at(profile, front, down))
        if front > last:
            return Phase.LAND, step
        return (Phase.ENTER if rear < first else Phase.TRAVERSE), step

    def _note(self, time: float, x: float, z: float, phi: float, at: float, slip: float) -> None:
        """Add a row to the log."""
        simulation = self.simulation
        by_nosing, by_grouser, contacts = simulation.contact_forces()
        forces = self.forces
        row = [
            time, simulation.belt.run(time), x, z, math.degrees(phi),
            math.degrees(simulation.extra(phi)), at - self.start, slip, simulation.velocity(),
            forces.normal, forces.traction, forces.traction * self._sprocket_radius,
            forces.traction * simulation.belt.speed(time), float(contacts),
        ]  # fmt: skip
        self.rows.append((*row, *simulation.in_space()))
        self.by_nosing.append(by_nosing)
        self.by_grouser.append(by_grouser)
        self.poses.append(simulation.configuration())

    @property
    def _sprocket_radius(self) -> float:
        """Radius at which the belt is driven [m]; NaN: not known."""
        robot = self.spec.question.robot
        return robot.drive.sprocket_radius or robot.track.rear_radius or math.nan

    def log(self, outcome: Outcome, began: float) -> TrialLog:
        """All that was noted, with the result."""
        names = _COLUMNS if self.spec.dimensions == 2 else (*_COLUMNS, *_IN_SPACE)
        table = np.array(self.rows) if self.rows else np.zeros((0, len(names)))
        columns = {name: table[:, k].copy() for k, name in enumerate(names)}
        forces, grousers = (
            np.array(each) if each else np.zeros((0, 0, 2))
            for each in (self.by_nosing, self.by_grouser)
        )
        return TrialLog(
            result=self._result(outcome, columns, began),
            columns=columns,
            forces=forces,
            grousers=grousers,
            poses=np.array(self.poses),
        )

    def _result(self, outcome: Outcome, columns: dict[str, Array], began: float) -> TrialResult:
        spec = self.spec
        offset, grouser_phase, _ = spec.drawn()
        mass, assumed = spec.mass()
        yields = isinstance(spec.track, YieldingBelt)
        nowhere = outcome in (Outcome.CLIMBED, Outcome.UNSTABLE, Outcome.START_FALL)
        phase, step = (None, None) if nowhere else self._place()
        forces, radius = self.forces, self._sprocket_radius
        return TrialResult(
            spec=spec,
            outcome=outcome,
            phase=phase,
            step=step,
            nosings_passed=self.passed,
            largest_extra_deg=math.degrees(self.largest),
            largest_normal_N=forces.largest_normal,
            largest_traction_N=forces.largest_traction,
            largest_torque_Nm=None if math.isnan(radius) else forces.largest_traction * radius,
            largest_power_W=forces.largest_power,
            slip_m=_last(columns["slip_m"]),
            time_s=_last(columns["time_s"]),
            friction=spec.static_friction,
            stiffness_N_m=spec.stiffness,
            speed_m_s=spec.speed,
            timestep_s=spec.step,
            contact_time_s=None if yields else spec.softness,
            start_offset=offset,
            grouser_phase=grouser_phase,
            mass_kg=mass,
            mass_assumed=assumed,
            inertia_estimated=self.course.outline.gyration_estimated,
            wall_time_s=perf_counter() - began,
            versions={"kaidan": version("kaidan")}
            | ({} if yields else {"mujoco": engine_version()}),
        )


def _last(values: Array) -> float:
    return float(values[-1]) if len(values) else 0.0
