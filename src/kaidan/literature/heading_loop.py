"""Closed loop of the heading on stairs: does it settle, and from which heading does it lose?

Kinematics of a robot whose tracks creep on the nosings, an accelerometer with noise behind a
low-pass, the law, and a drive that saturates. After Martens & Newman 1994.
"""

import math
from dataclasses import dataclass
from enum import StrEnum
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError
from kaidan.literature.heading import (
    difference_limit,
    heading_error,
    specific_force,
    speed_difference,
)
from kaidan.mechanics.oblique_support import sideways_limit
from kaidan.robot import Robot
from kaidan.sheet import Sheet, quantity
from kaidan.terrain.stairs import Stairs

Array = NDArray[np.float64]

MOST_STEPS = 1_000_000
"""Largest number of control periods of a run: a minute's work."""
_GRID = 33


class HeadingLoop(Sheet):
    """Control, sensor and ground of a closed loop."""

    label: ClassVar[str] = "heading loop"

    speed: float = quantity("m/s", 0.001, 10.0, "mean speed of the tracks")
    gain: float = quantity("1/s", 0.001, 1000.0, "gain k of the law", default=1.0)
    period: float = quantity("s", 1e-4, 1.0, "control period", default=0.02)
    filter_time: float = quantity(
        "s", 0.0, 10.0, "time constant of the low-pass behind the accelerometer", default=0.0
    )
    noise: float = quantity(
        "m/s^2", 0.0, 50.0, "standard deviation of each sample of the accelerometer", default=0.0
    )
    grip: float = quantity(
        "1", 0.01, 1.0, "share of the tracks' turning rate that the robot turns", default=1.0
    )
    divergence: float = quantity(
        "1/s", 0.0, 100.0, "rate at which the stairs turn it away, over sin(psi)", default=0.0
    )
    drift: float = quantity(
        "rad/s", -10.0, 10.0, "turning rate of its own, to the left positive", default=0.0
    )


class Outcome(StrEnum):
    """How a run ended."""

    SETTLED = "settled"
    """Within the tolerance from some time on, for a tenth of the run at least."""
    UNSETTLED = "unsettled"
    """Neither settled nor lost by the end."""
    TURNED_ACROSS = "turned-across"
    """It came to stand across the stairs, at 90 degrees; the run ends there."""
    TIPPED_SIDEWAYS = "tipped-sideways"
    """It tipped over its lower track before that; the run ends there."""


@dataclass(frozen=True, kw_only=True)
class HeadingRun:
    """A closed loop over time; arrays of shape (n,)."""

    outcome: Outcome
    t: Array
    """Time [s]."""
    heading: Array
    """Heading off the line of steepest ascent, to the left positive [rad]."""
    measured: Array
    """What the law is given [rad]."""
    difference: Array
    """Speed of the right track less that of the left one, from each time on [m/s]."""
    saturated: NDArray[np.bool_]
    """Whether the drive is at its limit."""
    across: Array
    """Way across the stairs, to the left [m]."""
    settled_at: float
    """Time from which the heading stays within the tolerance [s]; NaN if it did not settle."""

    @property
    def lost(self) -> bool:
        """Whether the loop lost the robot."""
        return self.outcome in (Outcome.TURNED_ACROSS, Outcome.TIPPED_SIDEWAYS)


class _Plant(NamedTuple):
    loop: HeadingLoop
    theta_s: float
    gauge: float
    C_N: float
    limit: float

    def tips(self, psi: Array) -> NDArray[np.bool_]:
        limit = sideways_limit(gauge=self.gauge, C_N=self.C_N, psi=psi)
        return np.asarray(limit <= self.theta_s)

    def lost(self, psi: Array) -> NDArray[np.bool_]:
        return np.asarray(self.tips(psi) | (np.abs(psi) >= math.pi / 2))

    def moved(self, psi: Array, difference: Array) -> tuple[Array, Array]:
        """Heading after a period, and the way across in it (Runge and Kutta's method)."""
        loop, h = self.loop, self.loop.period
        turn = loop.grip * difference / self.gauge + loop.drift

        def rate(at: Array) -> Array:
            return np.asarray(turn + loop.divergence * np.sin(at))

        k1 = rate(psi)
        k2 = rate(psi + h / 2 * k1)
        k3 = rate(psi + h / 2 * k2)
        k4 = rate(psi + h * k3)
        after = psi + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        middle = psi + h / 2 * k2
        across = loop.speed * h / 6 * (np.sin(psi) + 4 * np.sin(middle) + np.sin(after))
        return after, across


class _Sensor:
    """Accelerometer with noise behind a low-pass, and the law behind it."""

    def __init__(self, plant: _Plant, noise: np.random.Generator | None) -> None:
        self._plant, self._noise = plant, noise
        loop = plant.loop
        self._share = loop.period / (loop.filter_time + loop.period) if loop.filter_time else 1.0
        self._kept: tuple[Array, Array] | None = None

    def heading(self, psi: Array) -> Array:
        shown = list(specific_force(theta_s=self._plant.theta_s, psi=psi))[:2]
        if self._noise is not None:
            for axis, part in enumerate(shown):
                shown[axis] = part + self._noise.normal(0.0, self._plant.loop.noise, psi.shape)
        if self._kept is None:
            self._kept = (shown[0], shown[1])
        f_x, f_y = (
            kept + self._share * (part - kept) for kept, part in zip(self._kept, shown, strict=True)
        )
        self._kept = (f_x, f_y)
        return np.asarray(heading_error(f_x=f_x, f_y=f_y))

    def difference(self, measured: Array) -> Array:
        at = {"k": self._plant.loop.gain, "gauge": self._plant.gauge, "limit": self._plant.limit}
        return np.asarray(speed_difference(psi=measured, **at))


def heading_run(
    robot: Robot,
    stairs: Stairs,
    loop: HeadingLoop,
    *,
    start: float,
    duration: float = 20.0,
    tolerance: float = math.radians(2.0),
    seed: int = 0,
) -> HeadingRun:
    """Closed loop of the heading on a flight, after Martens & Newman 1994.

    Parameters
    ----------
    robot : Robot
        Robot, of which the gauge, the largest speed and the height of the centroid count.
    stairs : Stairs
        Flight, of which the angle counts; taken as long enough.
    loop : HeadingLoop
        Control, sensor and ground.
    start : float
        Heading at the beginning, to the left positive [rad].
    duration : float
        Length of the run [s].
    tolerance : float
        Heading that counts as kept [rad].
    seed : int
        Seed of the noise: the same seed gives the same run.

    Returns
    -------
    HeadingRun
        A robot that is lost is an answer, not an error.

    Raises
    ------
    InputError
        A gauge or largest speed that the sheet does not give, a speed beyond it, a start not
        within -pi/2 to pi/2, a duration shorter than a period or longer than `MOST_STEPS` of them.

    References
    ----------
    After Martens & Newman 1994, "Stabilization of a mobile robot climbing stairs", IEEE ICRA,
    pp. 2501-2507; their text was not at hand, the model of the ground is ours.
    """
    plant = _plant(robot, stairs, loop)
    if not abs(start) <= math.pi / 2:
        raise InputError(f"start = {start:g} rad is not within -1.5708 to 1.5708 rad")
    steps = _steps(loop, duration)
    sensor = _Sensor(plant, np.random.default_rng(seed) if loop.noise else None)
    psi, way = np.array([start]), np.zeros(1)
    rows = []
    for _ in range(steps + 1):
        measured = sensor.heading(psi)
        difference = sensor.difference(measured)
        rows.append((psi[0], measured[0], difference[0], way[0]))
        if plant.lost(psi)[0]:
            break
        psi, across = plant.moved(psi, difference)
        way = way + across
    heading, shown, difference, across = np.array(rows).T
    t = np.asarray(loop.period * np.arange(len(rows)), dtype=np.float64)
    settled_at = _settled_at(t, heading, tolerance)
    outcome = Outcome.SETTLED if settled_at <= 0.9 * t[-1] else Outcome.UNSETTLED
    if plant.lost(heading[-1:])[0]:
        tipped = bool(plant.tips(heading[-1:])[0])
        outcome = Outcome.TIPPED_SIDEWAYS if tipped else Outcome.TURNED_ACROSS
    return HeadingRun(
        outcome=outcome,
        t=t,
        heading=heading,
        measured=shown,
        difference=difference,
        saturated=np.abs(difference) >= plant.limit,
        across=across,
        settled_at=settled_at if outcome is Outcome.SETTLED else math.nan,
    )


def _settled_at(t: Array, heading: Array, tolerance: float) -> float:
    """Time from which the heading stays within the tolerance; infinite if it ends beyond it."""
    beyond = np.flatnonzero(np.abs(heading) > tolerance)
    after = int(beyond[-1]) + 1 if len(beyond) else 0
    return float(t[after]) if after < len(t) else math.inf


def losing_start(
    robot: Robot, stairs: Stairs, loop: HeadingLoop, *, duration: float = 20.0
) -> tuple[float, float]:
    """Smallest headings at the beginning from which the closed loop loses the robot.

    Runs without noise from many headings at once, refined three times. A run loses when the robot
    is lost, or ends further off than it began.

    Parameters
    ----------
    robot, stairs, loop
        As of `heading_run`; the noise plays no part.
    duration : float
        Length of each run [s]; near the limit losing takes long.

    Returns
    -------
    tuple of float
        To the left and to the right [rad], both positive, to 1e-4 rad; pi/2 where it brings the
        robot back from everywhere, 0 where it cannot even keep it straight.

    Raises
    ------
    InputError
        As `heading_run`.
    """
    plant = _plant(robot, stairs, loop)
    steps = _steps(loop, duration)
    return _losing(plant, steps, 1.0), _losing(plant, steps, -1.0)


def _losing(plant: _Plant, steps: int, side: float) -> float:
    low, high = 0.0, math.pi / 2
    while high - low > 1e-4:
        starts = np.linspace(low, high, _GRID)[1:]
        loses = _loses(plant, steps, side * starts)
        first = int(np.argmax(loses)) if loses.any() else len(starts) - 1
        low, high = float(starts[first] - (high - low) / (_GRID - 1)), float(starts[first])
    return high if high > 1.01e-4 else 0.0


def _loses(plant: _Plant, steps: int, starts: Array) -> NDArray[np.bool_]:
    sensor = _Sensor(plant, None)
    psi, lost = starts, plant.lost(starts)
    for _ in range(steps):
        after, _way = plant.moved(psi, sensor.difference(sensor.heading(psi)))
        psi = np.where(lost, psi, after)
        lost |= plant.lost(psi)
    return np.asarray(lost | (np.abs(psi) > np.abs(starts)))


def _plant(robot: Robot, stairs: Stairs, loop: HeadingLoop) -> _Plant:
    gauge, v_max = robot.track.gauge, robot.drive.max_speed
    if gauge is None:
        raise InputError(f"robot {robot.name!r}: track.gauge is not known, and turning needs it")
    if v_max is None:
        raise InputError(
            f"robot {robot.name!r}: drive.max_speed is not known, and turning needs it"
        )
    if loop.speed > v_max:
        raise InputError(
            f"heading loop: speed = {loop.speed:g} m/s is more than the {v_max:g} m/s of robot "
            f"{robot.name!r}"
        )
    limit = float(difference_limit(v=loop.speed, v_max=v_max))
    return _Plant(loop, stairs.angle, gauge, robot.com_height, limit)


def _steps(loop: HeadingLoop, duration: float) -> int:
    longest = MOST_STEPS * loop.period
    if not loop.period <= duration <= longest:
        raise InputError(
            f"duration = {duration:g} s is not within {loop.period:g} to {longest:g} s"
        )
    return round(duration / loop.period)
