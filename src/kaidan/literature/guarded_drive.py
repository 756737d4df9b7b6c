"""A drive that watches its margin and avoids rolling over (after Ohno et al. 2009).

The rule of `kaidan.literature.rollover` in a loop over a profile: before each step the contact
model foretells the margin, the rule decides, the robot moves. What is foretold is what happens:
slip, slopes across and dynamics are not in it.

Source: Ohno et al. 2009, see `kaidan.literature.rollover`.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import Status
from kaidan.errors import InputError
from kaidan.literature import rollover, stepping
from kaidan.literature.rollover import STRIDE, Action, Decision, avoid_rollover
from kaidan.literature.stepping import RANGE, Angles, Course, Stand
from kaidan.mechanics.measures import kinetic_energy_height
from kaidan.robot import Posture, Robot
from kaidan.terrain.profile import Profile

Array = NDArray[np.float64]

SPEED = 0.1
"""Speed where the robot's sheet states none [m/s]: the paper's."""
STEEPEST = math.radians(60.0)
"""Inclination that the rule does not go beyond [rad]: to hold a robot there takes a friction of
tan 60 deg = 1.7, more than any catalogued surface gives a track."""


@dataclass(frozen=True)
class GuardedDrive:
    """A drive with or without avoidance; see `drive_guarded`. Arrays: one entry a step."""

    status: Status
    stopped: bool
    """Whether the rule stopped the robot."""
    arrived: bool
    x: Array
    """Centroid, along [m]."""
    z: Array
    """Centroid, up [m]."""
    inclination: Array
    """Nose up positive [rad]."""
    front: Array
    """Angle of the front flippers [rad]; NaN without them."""
    rear: Array
    margin: Array
    """Smallest margin since the entry before [m]; 0 if it lost its balance and was arrested, minus
    infinity if it fell."""
    actions: tuple[Action, ...]
    """Decision before each step; all GO without avoidance."""
    time: float
    """Time taken, standing included [s]."""
    threshold: float
    """Margin that was to be kept [m]."""

    @property
    def fell(self) -> bool:
        """Whether the robot went over."""
        return self.status in (Status.FELL_BACKWARD, Status.FELL_FORWARD)


def drive_guarded(
    robot: Robot,
    profile: Profile,
    *,
    posture: Posture | None = None,
    avoidance: bool = True,
    threshold: float | None = None,
    speed: float | None = None,
    limits: tuple[float, float] = RANGE,
    steepest: float = STEEPEST,
    step: float = 0.02,
) -> GuardedDrive:
    """Drive a robot over a profile, nose first, while the rule watches its margin.

    Parameters
    ----------
    robot : Robot
        Robot with flippers; without them the rule can only stop it.
    profile : Profile
        Terrain, driven from its first to its last landing.
    posture : Posture, optional
        Flippers at the start; stowed without one.
    avoidance : bool
        False: drive whatever the margin is.
    threshold : float, optional
        Margin to be kept [m]; without one what a sudden stop from the speed sets free,
        ``v^2 / (2 g)``.
    speed : float, optional
        Speed of the drive [m/s]; without one the sheet's largest, or 0.1 m/s.
    limits : (float, float)
        Joint range of the flippers [rad].
    steepest : float
        Inclination, either way, that counts as no margin at all [rad].
    step : float
        Way between two decisions [m].

    Returns
    -------
    GuardedDrive
        A robot that falls, or is stopped, is an answer.

    Raises
    ------
    InputError
        A speed or step that is not positive, a threshold or limits without meaning, or a posture
        for flippers that the robot does not have.
    """
    v = speed if speed is not None else robot.drive.max_speed or SPEED
    if not (0.0 < v < math.inf and 0.0 < step < math.inf):
        raise InputError(f"speed = {v:g} m/s, step = {step:g} m: write positive ones")
    keep = float(kinetic_energy_height(v=v)) if threshold is None else threshold
    pairs = (robot.front_flippers, robot.rear_flippers)
    rates = [0.0 if pair is None else pair.max_speed or 0.0 for pair in pairs]
    reach = (rates[0] * step / v, rates[1] * step / v)
    rollover.check(keep, reach, limits)
    course = Course.of(robot, profile, posture)
    at = stepping.begin(course)
    stands, margins, actions = [at], [at.least_margin()], []
    time, stopped = 0.0, False
    most = 3 * int((course.x_end - course.x_start + float(np.ptp(profile.points[:, 1]))) / step)
    for _ in range(most + 50):
        if at.status is not Status.OK or stepping.arrived(course, at):
            break
        decision = Decision(
            action=Action.GO, angles=at.angles, margin=math.nan, margin_then=math.nan, turn=0.0
        )  # fmt: skip
        before = at
        if avoidance:
            foresight = _Foresight(course, at, step, keep, steepest)
            decision = avoid_rollover(
                at.angles, foresight.predict, threshold=keep, reach=reach, limits=limits
            )
            before = foresight.known.get(decision.angles, at)
        actions.append(decision.action)
        if decision.action is Action.STOP:
            stopped = True
            break
        if decision.action is Action.WAIT:
            time += decision.turn / min(rate for rate in rates if rate > 0.0)
        at = stepping.ahead(course, before, step)
        time += step / v
        stands.append(at)
        margins.append(at.least_margin(before))
    return GuardedDrive(
        status=at.status if at.status is not Status.OK or stopped or stepping.arrived(course, at)
        else Status.TOO_LONG,
        stopped=stopped,
        arrived=stepping.arrived(course, at),
        x=np.array([each.x for each in stands]),
        z=np.array([each.z for each in stands]),
        inclination=np.array([each.inclination for each in stands]),
        front=_column(each.angles.front for each in stands),
        rear=_column(each.angles.rear for each in stands),
        margin=np.array(margins),
        actions=tuple(actions),
        time=time,
        threshold=keep,
    )  # fmt: skip


def turn_steadily(course: Course, at: Stand, angles: Angles) -> Stand:
    """Turn the flippers in strides short enough to follow; the largest rotation counts."""
    first, rotation = at.angles, 0.0
    many = max(1, math.ceil(_apart(first, angles) / STRIDE - 1e-9))
    for k in range(1, many + 1):
        part = [
            new if new is None or old is None or k == many else old + (new - old) * k / many
            for new, old in zip(angles, first, strict=True)
        ]
        turned = stepping.turned(course, at, Angles(*part))
        if turned is not at:
            at, rotation = turned, max(rotation, turned.rotation)
    return at if at.angles == first else replace(at, rotation=rotation)


class _Foresight:
    """What the robot would meet with its flippers at other angles, and the stands on the way."""

    def __init__(
        self, course: Course, at: Stand, step: float, threshold: float, steepest: float
    ) -> None:
        self.course, self.at, self.step = course, at, step
        here = at.energy_margin  # how the pose was reached is past
        self.floor = min(threshold, here)
        self.steepest = max(steepest, abs(at.inclination))
        self.known = {at.angles: at}
        self.here = {at.angles: here}

    def predict(self, angles: Angles) -> tuple[float, float]:
        """Margins here and one step ahead [m]."""
        if angles not in self.known:
            # longer turns begin where shorter ones have ended safely
            nearest = min(self.known, key=lambda each: _apart(each, angles))
            there = turn_steadily(self.course, self.known[nearest], angles)
            if there.angles != angles:  # held, as at a face
                return self.predict(self.at.angles)
            here = there.least_margin()
            if here < self.floor:
                return here, here
            self.known[angles], self.here[angles] = there, here
        there = self.known[angles]
        then = stepping.ahead(self.course, there, self.step)
        if abs(then.inclination) > self.steepest:
            return self.here[angles], -math.inf
        return self.here[angles], then.least_margin(there)


def _apart(one: Angles, other: Angles) -> float:
    """Distance of two postures by their larger turn [rad]."""
    return max(abs((a or 0.0) - (b or 0.0)) for a, b in zip(one, other, strict=True))


def _column(values: Iterable[float | None]) -> Array:
    return np.array([math.nan if each is None else each for each in values])
