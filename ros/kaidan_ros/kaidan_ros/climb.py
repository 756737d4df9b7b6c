"""What the node does, without ROS: a question of parameters, and the monitor of a climb."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import kaidan
from kaidan.errors import KaidanError
from kaidan.verbs.monitor import AlarmLimits, Cause
from kaidan.verbs.monitor.live import LiveMonitor, LiveState
from kaidan.verbs.monitor.recordings import sample_of_imu

PARAMETERS: dict[str, Any] = {
    "robot": "",
    "stairs": "",
    "surface": "",
    "friction": "",
    "flippers": "stowed",
    "direction": "",
    "facing": "",
    "speed": "",
    "payload": "",
    "alarm_margin_deg": 5.2,
    "clear_margin_deg": 7.2,
    "alarm_time_s": 0.5,
    "clear_time_s": 1.0,
    "no_data_s": 0.0,
    "resolution_deg": 0.0,
}
"""Parameters of the node with their defaults; texts are written as on the command line, and 0 s
without data is the limit that goes with the rate of the sensor."""
_LIMITS = {
    "alarm_margin_deg",
    "clear_margin_deg",
    "alarm_time_s",
    "clear_time_s",
    "no_data_s",
    "resolution_deg",
}
OK, WARN, ERROR, STALE = range(4)
"""Levels of a diagnostic status."""


class Assessed(NamedTuple):
    """Answer of the service."""

    success: bool
    """Whether the verdict is GO; ROUGH and UNSURE are for a person to decide."""
    message: str
    """The answer as JSON; the reason where there is none."""


class Status(NamedTuple):
    """Diagnostic status."""

    level: int
    message: str
    values: tuple[tuple[str, str], ...]


class Climb:
    """One robot on one flight, as parameters say.

    Parameters
    ----------
    parameters : mapping
        Values of `PARAMETERS`.

    Raises
    ------
    kaidan.InputError
        A value without physical meaning, or a robot or stairs that nobody knows.
    """

    def __init__(self, parameters: Mapping[str, Any]) -> None:
        values = {**PARAMETERS, **parameters}
        given = {name: each for name, each in values.items() if name not in _LIMITS and each != ""}
        robot, stairs = given.pop("robot", None), given.pop("stairs", None)
        if robot is None or stairs is None:
            raise kaidan.InputError("parameters robot and stairs: name both")
        self.question = kaidan.Question.of(robot, stairs, **given)
        self.limits = AlarmLimits(
            margin_on=math.radians(values["alarm_margin_deg"]),
            margin_off=math.radians(values["clear_margin_deg"]),
            time_on=values["alarm_time_s"],
            time_off=values["clear_time_s"],
            no_data_on=values["no_data_s"] or None,
            resolution=math.radians(values["resolution_deg"]),
        )
        self._watch = LiveMonitor(self.question, limits=self.limits)
        self._last: LiveState | None = None
        self._row = 0

    def assess(self) -> Assessed:
        """Answer to the question of the parameters."""
        try:
            answer = kaidan.assess(self.question)
        except KaidanError as error:
            return Assessed(False, str(error))
        return Assessed(answer.verdict == "go", answer.to_json())

    def feed(self, message: Any, now: float) -> LiveState:
        """Take an Imu message that came at a time [s]."""
        self._row += 1
        stamp = message.header.stamp
        t = float(stamp.sec) + 1e-9 * float(stamp.nanosec)
        sample = sample_of_imu(message, t, nose_up=self.question.nose_up, row=self._row)
        self._last = self._watch.feed(sample, now)
        return self._last

    def overdue(self, now: float) -> LiveState | None:
        """State if the next message has not come in time at a time [s], else None."""
        missing = self._watch.overdue(now)
        self._last = missing or self._last
        return missing

    def status(self) -> Status:
        """Diagnostic status: a sensor that is silent is worse than an alarm."""
        last = self._last
        if last is None:
            return Status(STALE, "no sample has come", self._values(None))
        causes = ", ".join(last.causes)
        if Cause.SILENT in last.causes:
            return Status(STALE, f"alarm: {causes}", self._values(last))
        if last.alarm:
            return Status(ERROR, f"alarm: {causes}", self._values(last))
        if not last.judged:
            return Status(WARN, last.message or last.status.value, self._values(last))
        return Status(OK, "no alarm", self._values(last))

    def _values(self, state: LiveState | None) -> tuple[tuple[str, str], ...]:
        names = (("robot", self.question.robot.name), ("stairs", self.question.terrain_name))
        if state is None:
            return names
        return (
            *names,
            ("phase", state.phase.value),
            ("tilt_deg", _shown(state.tilt_deg)),
            ("margin_deg", _shown(state.margin_deg)),
            ("time_to_tip_s", _shown(state.time_to_tip_s)),
        )


def _shown(value: float | None) -> str:
    return "" if value is None else f"{value:.2f}"
