"""Online prediction of tip-over from an inertial measurement unit, after Liu & Liu 2009.

Each sample gives the angle left between the resultant of weight and inertia and the contact over
which the robot would turn, and the time until none is left if the body goes on turning, and the
robot driving, as it does. An alarm with hysteresis follows. Nothing but the samples goes in, so
the same samples give the same readings.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar, Literal, Self

import numpy as np

from kaidan.errors import InputError
from kaidan.mechanics.loads import zero_moment_point
from kaidan.mechanics.measures import zero_moment_margin
from kaidan.mechanics.plane import two_contacts_remain
from kaidan.neighbours.samples import Sample
from kaidan.neighbours.tipover import Motion, Outlook
from kaidan.robot import Payload, Posture, Robot
from kaidan.sheet import Sheet, model_validator, quantity
from kaidan.stairs import Stairs

REGULAR = 1e-6
"""Largest irregularity of stairs on which a position says where the nosings are [m]."""
LARGEST_ACCELERATION = 500.0
"""Largest acceleration taken for one of a robot [m/s^2]: impacts on stairs stay below 50 g."""
LARGEST_RATE = 100.0
"""Largest rate of inclination taken for one of a robot [rad/s]."""


class AlarmLimits(Sheet):
    """When the alarm is raised, and when it is taken back."""

    label: ClassVar[str] = "alarm"

    # 2.6 deg of track deformation and 2.6 deg of grouser moment, the largest that Endo & Nagatani
    # print: the rig fell that much before the rigid prediction
    margin_on: float = quantity(
        "rad", 0.0, 1.5, "margin below which it is raised", default=math.radians(5.2)
    )
    margin_off: float = quantity(
        "rad", 0.0, 1.5, "margin above which it may be taken back", default=math.radians(7.2)
    )
    time_on: float = quantity(
        "s", 0.0, 60.0, "time to tip-over below which it is raised", default=0.5
    )
    time_off: float = quantity(
        "s", 0.0, 60.0, "time to tip-over above which it may be taken back", default=1.0
    )
    horizon: float = quantity("s", 0.0, 60.0, "how far ahead is predicted", default=2.0)

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        for name, low, high in (
            ("margin_off", self.margin_on, self.margin_off),
            ("time_off", self.time_on, self.time_off),
            ("horizon", self.time_off, self.horizon),
        ):
            if high < low:
                raise self.refuse(f"{name} = {high:g} is not within {low:g} to inf")
        return self


class Status(StrEnum):
    """What became of a sample."""

    OK = "ok"
    """Judged."""
    NOT_FINITE = "not-finite"
    """A figure is missing, NaN or infinite; the alarm stays as it was."""
    IMPLAUSIBLE = "implausible"
    """A figure no robot has, degrees for radians perhaps; the alarm stays as it was."""
    TIME_NOT_LATER = "time-not-later"
    """Its time is not after that of the last good sample; the alarm stays as it was."""
    OUTSIDE_MODEL = "outside-model"
    """Two nosings do not carry the robot everywhere on these stairs: no prediction."""


@dataclass(frozen=True, kw_only=True)
class Reading:
    """What the monitor says of one sample; angles and times NaN where it was not judged."""

    t: float
    """Time of the sample [s]."""
    row: int
    """Its line or number."""
    status: Status
    message: str
    """What is wrong with it; empty if nothing."""
    margin_downhill: float
    """Angle left before the robot turns over its lowest contact [rad]."""
    margin_uphill: float
    """Angle left before it turns over its highest contact [rad]."""
    centroid_margin: float
    """Distance of the zero moment point to the nearer end of the support [m]."""
    time_to_tip: float
    """Time until an angle is used up [s]; 0 if it is, inf if it is not within the horizon."""
    alarm: bool

    @property
    def margin(self) -> float:
        """Smaller of the two angles [rad]."""
        return min(self.margin_downhill, self.margin_uphill)


class Monitor:
    """Online tip-over monitor of one robot on one flight, after Liu & Liu 2009.

    Feed it the samples in order. Its only memory is the last good sample and the alarm.

    Without a position it takes the worst one: the lowest nosing has just left, the next one uphill
    is just about to be met. With one, on regular stairs, it knows which nosings carry, and sees
    the next loss coming.

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
        When the alarm is raised and taken back.
    strict : bool
        Refuse a bad sample instead of giving it a status.

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
            raise InputError(f"nose = {nose!r} is not known; known: up, down")
        stance = robot.stance(posture, payload)
        self.limits = AlarmLimits() if limits is None else limits
        self.strict = strict
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
        self._alarm = False

    @property
    def inside_model(self) -> bool:
        """Whether two nosings carry the robot everywhere, so that there is a prediction."""
        return bool(two_contacts_remain(L=self._outlook.L, p=self._outlook.p))

    def feed(self, sample: Sample) -> Reading:
        """Take one sample.

        Parameters
        ----------
        sample : Sample
            The next one.

        Returns
        -------
        Reading

        Raises
        ------
        InputError
            A bad sample, with its row, if the monitor is strict.
        """
        status, message = self._check(sample)
        if status is not Status.OK and self.strict and status is not Status.OUTSIDE_MODEL:
            raise InputError(f"samples, row {sample.row}: {message}")
        if status is not Status.OK:
            return self._reading(sample, status, message, (math.nan,) * 4)
        motion, now = self._motion(sample), np.zeros(1)
        downhill, uphill = (float(angle[0]) for angle in self._outlook.angles(motion, now))
        lowest, highest = (float(place[0]) for place in self._outlook.contacts(motion, now))
        body = {"C_L": self._outlook.C_L, "C_N": self._outlook.C_N}
        x_z = zero_moment_point(theta_s=motion.phi, a=motion.a, **body)
        zmp = float(zero_moment_margin(x_z=x_z, x_0=lowest, x_n=highest))
        time = self._outlook.time_to_tip(motion, self.limits.horizon)
        margin = min(downhill, uphill)
        on, off = self.limits.margin_on, self.limits.margin_off
        if margin < on or time < self.limits.time_on:
            self._alarm = True
        elif margin > off and time > self.limits.time_off:
            self._alarm = False
        self._last = sample
        return self._reading(sample, status, message, (downhill, uphill, zmp, time))

    def _reading(
        self, sample: Sample, status: Status, message: str, found: tuple[float, ...]
    ) -> Reading:
        downhill, uphill, zmp, time = found
        return Reading(
            t=sample.t,
            row=sample.row,
            status=status,
            message=message,
            margin_downhill=downhill,
            margin_uphill=uphill,
            centroid_margin=zmp,
            time_to_tip=time,
            alarm=self._alarm,
        )

    def _check(self, sample: Sample) -> tuple[Status, str]:
        figures = {
            "t": (sample.t, math.inf, "s"),
            "inclination": (sample.inclination, math.pi, "rad"),
            "inclination_rate": (sample.inclination_rate, LARGEST_RATE, "rad/s"),
            "acceleration": (sample.acceleration, LARGEST_ACCELERATION, "m/s^2"),
        }
        for name, (value, _, _) in figures.items():
            if not math.isfinite(value):
                return Status.NOT_FINITE, f"{name} is {value:g}"
        for name, (value, largest, unit) in figures.items():
            if abs(value) > largest:
                text = f"{name} = {value:g} {unit} is not within -{largest:g} to {largest:g} {unit}"
                hint = " (in degrees?)" if name == "inclination" else ""
                return Status.IMPLAUSIBLE, text + hint
        if self._last is not None and sample.t <= self._last.t:
            text = f"t = {sample.t:.12g} s is not later than {self._last.t:.12g} s"
            return Status.TIME_NOT_LATER, text
        if not self.inside_model:
            p, L = self._outlook.p, self._outlook.L
            text = f"p = {p:.4g} m is more than L / 2 = {L / 2:.4g} m"
            return Status.OUTSIDE_MODEL, text
        return Status.OK, ""

    def _motion(self, sample: Sample) -> Motion:
        """Motion up the stairs; its speed is that from the last position to this."""
        last, speed = self._last, 0.0
        position = sample.position if self._regular else math.nan
        placed = math.isfinite(position) and last is not None and math.isfinite(last.position)
        if last is not None and placed and sample.t - last.t <= self.limits.horizon:
            speed = (position - last.position) / (sample.t - last.t)
        return Motion(
            phi=self._sign * sample.inclination,
            rate=self._sign * sample.inclination_rate,
            a=sample.acceleration,
            position=position if math.isfinite(position) else math.nan,
            speed=speed,
        )


def readings(
    samples: Iterable[Sample],
    robot: Robot,
    stairs: Stairs,
    *,
    posture: Posture | None = None,
    payload: Iterable[Payload] = (),
    nose: Literal["up", "down"] = "up",
    limits: AlarmLimits | None = None,
    strict: bool = False,
) -> Iterator[Reading]:
    """Readings of a monitor for samples from anywhere, each as soon as its sample is there.

    Parameters
    ----------
    samples : iterable of Sample
        Samples in order, a list, a generator or `kaidan.neighbours.samples.samples_of`.
    robot, stairs, posture, payload, nose, limits, strict
        As of `Monitor`.

    Yields
    ------
    Reading
        One a sample.

    Raises
    ------
    InputError
        As `Monitor` and its `feed`.
    """
    monitor = Monitor(
        robot,
        stairs,
        posture=posture,
        payload=payload,
        nose=nose,
        limits=limits,
        strict=strict,
    )
    return map(monitor.feed, samples)
