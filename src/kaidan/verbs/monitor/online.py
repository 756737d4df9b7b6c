"""Online prediction of tip-over: a monitor that takes one sample after the other."""

import math
from collections.abc import Iterable
from typing import Literal, Self

import numpy as np

from kaidan.errors import InputError, shown
from kaidan.mechanics.loads import zero_moment_point
from kaidan.mechanics.measures import zero_moment_margin
from kaidan.mechanics.plane import two_contacts_remain
from kaidan.mechanics.tipover import Motion, Outlook
from kaidan.question import Question
from kaidan.robot import Payload, Posture, Robot
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.monitor.alarm import Alarm, AlarmLimits
from kaidan.verbs.monitor.answer import MonitorAnswer, MonitorState, SampleStatus
from kaidan.verbs.monitor.liveness import Liveness
from kaidan.verbs.monitor.samples import Sample
from kaidan.verbs.monitor.tally import UNJUDGED, Tally

REGULAR = 1e-6
"""Largest irregularity of stairs on which a position says where the nosings are [m]."""
LARGEST_ACCELERATION = 500.0
"""Largest acceleration taken for one of a robot [m/s^2]: impacts on stairs stay below 50 g."""
LARGEST_RATE = 100.0
"""Largest rate of inclination taken for one of a robot [rad/s]."""
LARGEST_POSITION = 1e4
"""Largest position on a flight [m]: no flight is longer."""
LARGEST_SPEED = 10.0
"""Largest speed between two positions [m/s]: no tracked robot is faster on stairs."""
_NO_FIGURES = (math.nan,) * 4


class Monitor:
    """Online tip-over monitor of one robot on one flight, after Liu & Liu 2009.

    Feed it the samples in order. It remembers the last judged sample, the alarm and counts.

    Without a position it takes the worst one: the lowest nosing has just left, the next one uphill
    is just about to be met. With one, on regular stairs, it knows which nosings carry; with two,
    the speed, and foresees the next loss. While the speed is not known, what is ahead is foreseen
    for the worst position.

    Parameters
    ----------
    robot : Robot
        Robot.
    stairs : Stairs
        Flight; the longest nosing spacing of its regular steps counts.
    posture : Posture, optional
        Angles of the flippers; stowed without one.
    payload : iterable of Payload
        Masses fixed to the robot.
    nose : {"up", "down"}
        Which way the nose points; inclination and rate count nose up, so they are negative on
        stairs with the nose down.
    limits : AlarmLimits, optional
        When the alarm is raised and cleared.
    strict : bool
        Refuse a sample that cannot be judged as it stands instead of giving it a status.

    Raises
    ------
    InputError
        A posture or payload that the robot cannot have, an unknown nose.

    References
    ----------
    After Liu & Liu 2009, "Track-stair interaction analysis and online tipover prediction for a
    self-reconfigurable tracked mobile robot climbing stairs", IEEE/ASME Trans. Mechatronics 14(5),
    pp. 528-538; their text was not at hand.
    """

    def __init__(
        self,
        robot: Robot,
        stairs: Stairs,
        *,
        posture: Posture | None = None,
        payload: Iterable[Payload] = (),
        nose: Literal["up", "down"] = "up",
        limits: AlarmLimits | None = None,
        strict: bool = False,
    ) -> None:
        if nose not in ("up", "down"):
            raise InputError(f"nose = {shown(nose)} is not known; known: up, down")
        stance = robot.stance(posture, payload)
        self.strict = strict
        limits = AlarmLimits() if limits is None else limits
        if not isinstance(limits, AlarmLimits):
            raise InputError(f"limits = {shown(limits)} are no AlarmLimits")
        self._alarm, self._liveness = Alarm(limits), Liveness(limits)
        self._tally = Tally(robot.name, stairs.name)
        self._sign = 1.0 if nose == "up" else -1.0
        L, front = stance.flat_length, stance.com_from_front
        self._outlook = Outlook(
            L=L,
            C_L=front if nose == "up" else L - front,
            C_N=stance.com_height,
            p=max(math.hypot(*step) for step in stairs.regular_steps),
        )
        self._regular = stairs.irregularity <= REGULAR
        self._last: Sample | None = None
        self._row = 0

    @classmethod
    def of(
        cls, question: Question, *, limits: AlarmLimits | None = None, strict: bool = False
    ) -> Self:
        """Monitor of a question: its robot, stairs, posture, payload and way of facing.

        Of several flights it knows the steepest.

        Raises
        ------
        InputError
            A terrain without steps.
        """
        flight = question.steepest_flight
        if flight is None:
            raise InputError(f"{question.terrain_name}: the monitor needs the spacing of its steps")
        return cls(
            question.robot.weighed,
            flight,
            posture=question.posture,
            payload=question.payload,
            nose="up" if question.nose_up else "down",
            limits=limits,
            strict=strict,
        )

    @property
    def inside_model(self) -> bool:
        """Whether two nosings carry the robot everywhere, so that there is a prediction."""
        return bool(two_contacts_remain(L=self._outlook.L, p=self._outlook.p))

    def feed(self, sample: Sample, arrived: float | None = None) -> MonitorState:
        """Take one sample.

        Parameters
        ----------
        sample : Sample
            The next one.
        arrived : float, optional
            When it came, by a clock that never goes back [s]; None in a recording, in which the
            stamps alone tell the time.

        Raises
        ------
        InputError
            A sample whose status is not ok, with its row, if the monitor is strict.
        """
        status, message = self._check(sample)
        outside = status is SampleStatus.OUTSIDE_MODEL
        if self.strict and status is not SampleStatus.OK and not outside:
            raise InputError(f"samples, row {sample.row}: {message}")
        judged = status not in UNJUDGED
        self._liveness.take(sample, judged=judged, arrived=arrived)
        self._row = sample.row
        figures = self._judge(sample, status) if judged else _NO_FIGURES
        return self._tally.count(self._state(sample, status, message, figures))

    def overdue(self, now: float) -> MonitorState | None:
        """State if the next sample has not arrived in time, which raises the alarm.

        Parameters
        ----------
        now : float
            By the clock of the arrivals [s].

        Returns
        -------
        MonitorState or None
            None while nothing is overdue, or no sample has come.
        """
        if not self._liveness.overdue(now):
            return None
        missing = Sample(math.nan, math.nan, math.nan, math.nan, row=self._row)
        text = f"no sample came for {self._liveness.limit:.2g} s"
        return self._tally.count(self._state(missing, SampleStatus.MISSING, text, _NO_FIGURES))

    def answer(self, states: Iterable[MonitorState] = ()) -> MonitorAnswer:
        """Answer to all samples so far.

        Parameters
        ----------
        states : iterable of MonitorState
            What `feed` returned, if it is to stand in the answer.

        Raises
        ------
        InputError
            No sample has come.
        """
        rate, inside = self._liveness.rate, self.inside_model
        return self._tally.answer(states, rate=rate, inside_model=inside)

    def _judge(self, sample: Sample, status: SampleStatus) -> tuple[float, ...]:
        """Both angles [rad], centroid margin [m] and time [s] of a sample; sets the alarm."""
        motion = self._motion(sample, status)
        here, now = motion._replace(speed=0.0), np.zeros(1)
        downhill, uphill = (float(angle[0]) for angle in self._outlook.angles(here, now))
        lowest, highest = (float(place[0]) for place in self._outlook.contacts(here, now))
        body = {"C_L": self._outlook.C_L, "C_N": self._outlook.C_N}
        x_z = zero_moment_point(theta_s=motion.phi, a=motion.a, **body)
        zmp = float(zero_moment_margin(x_z=x_z, x_0=lowest, x_n=highest))
        if math.isnan(motion.speed):
            motion = here._replace(position=math.nan)
        time = self._outlook.time_to_tip(motion, self._alarm.limits.horizon)
        at_rest = self._outlook.angles(here._replace(a=0.0), now)
        self._alarm.judged(
            min(downhill, uphill),
            time,
            tipped=float(np.minimum(*at_rest)[0]) <= 0,
            may_clear=status is not SampleStatus.TIME_DOUBTFUL and not self._liveness.raised,
        )
        if math.isfinite(sample.t):
            self._last = sample._replace(position=self._position(sample))
        return downhill, uphill, zmp, time

    def _state(
        self, sample: Sample, status: SampleStatus, message: str, figures: tuple[float, ...]
    ) -> MonitorState:
        downhill, uphill, zmp, time = figures
        tipping = () if self._alarm.cause is None else (self._alarm.cause,)
        causes = (*tipping, *self._liveness.raised)
        return MonitorState(
            t_s=sample.t,
            row=sample.row,
            status=status,
            message=message,
            margin_deg=math.degrees(min(downhill, uphill)),
            margin_downhill_deg=math.degrees(downhill),
            margin_uphill_deg=math.degrees(uphill),
            centroid_margin_mm=1e3 * zmp,
            time_to_tip_s=time,
            alarm=bool(causes),
            causes=causes,
            due_s=self._liveness.due,
        )

    def _check(self, sample: Sample) -> tuple[SampleStatus, str]:
        """Status of a sample and what is wrong with it."""
        if not self.inside_model:
            p, L = self._outlook.p, self._outlook.L
            text = f"p = {p:.4g} m is more than L / 2 = {L / 2:.4g} m"
            return SampleStatus.OUTSIDE_MODEL, text
        if sample.fault:
            return SampleStatus.UNREADABLE, sample.fault
        values = {
            "inclination": (sample.inclination, math.pi, "rad"),
            "inclination_rate": (sample.inclination_rate, LARGEST_RATE, "rad/s"),
            "acceleration": (sample.acceleration, LARGEST_ACCELERATION, "m/s^2"),
        }
        for name, (value, _, _) in values.items():
            if not math.isfinite(value):
                return SampleStatus.NOT_FINITE, f"{name} is {value:g}"
        for name, (value, largest, unit) in values.items():
            if abs(value) > largest:
                text = f"{name} = {value:g} {unit} is not within -{largest:g} to {largest:g} {unit}"
                hint = " (in degrees?)" if name == "inclination" else ""
                return SampleStatus.IMPLAUSIBLE, text + hint
        if not math.isfinite(sample.t):
            return SampleStatus.TIME_DOUBTFUL, f"t is {sample.t:g}"
        if self._last is not None and sample.t <= self._last.t:
            text = f"t = {sample.t:.12g} s is not later than {self._last.t:.12g} s"
            return SampleStatus.TIME_DOUBTFUL, text
        return self._check_position(sample)

    def _check_position(self, sample: Sample) -> tuple[SampleStatus, str]:
        position = sample.position
        if math.isnan(position):
            return SampleStatus.OK, ""
        if abs(position) > LARGEST_POSITION:
            allowed = f"-{LARGEST_POSITION:g} to {LARGEST_POSITION:g} m"
            text = f"position = {position:g} m is not within {allowed}"
            return SampleStatus.POSITION_DOUBTFUL, text
        last = self._last
        if last is not None and abs(position - last.position) > LARGEST_SPEED * (sample.t - last.t):
            text = f"position = {position:g} m is {abs(position - last.position):g} m from the last"
            return SampleStatus.POSITION_DOUBTFUL, text
        return SampleStatus.OK, ""

    def _position(self, sample: Sample) -> float:
        """Position that may be one [m], else NaN."""
        possible = self._regular and abs(sample.position) <= LARGEST_POSITION
        return sample.position if possible else math.nan

    def _motion(self, sample: Sample, status: SampleStatus) -> Motion:
        """Motion up the stairs; its speed is that from the last position to this, else NaN."""
        last, position, speed = self._last, math.nan, math.nan
        if status is SampleStatus.OK:
            position = self._position(sample)
            if last is not None and sample.t - last.t <= self._alarm.limits.horizon:
                speed = (position - last.position) / (sample.t - last.t)
        return Motion(
            phi=self._sign * sample.inclination,
            rate=self._sign * sample.inclination_rate,
            a=sample.acceleration,
            position=position,
            speed=speed,
        )
