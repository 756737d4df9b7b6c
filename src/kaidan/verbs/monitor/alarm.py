"""When the alarm of a monitor is raised, and when it is cleared: two thresholds each."""

import math
from typing import ClassVar, Self

from kaidan.sheet import Sheet, model_validator, quantity


class AlarmLimits(Sheet):
    """When the alarm is raised, and when it is cleared."""

    label: ClassVar[str] = "alarm"

    # 2.6 deg of track deformation and 2.6 deg of grouser moment, the largest that Endo & Nagatani
    # print: the rig fell that much before the rigid prediction
    margin_on: float = quantity(
        "rad", 0.0, 1.5, "margin below which it is raised", default=math.radians(5.2)
    )
    margin_off: float = quantity(
        "rad", 0.0, 1.5, "margin above which it may be cleared", default=math.radians(7.2)
    )
    time_on: float = quantity(
        "s", 0.0, 60.0, "time to tip-over below which it is raised", default=0.5
    )
    time_off: float = quantity(
        "s", 0.0, 60.0, "time to tip-over above which it may be cleared", default=1.0
    )
    horizon: float = quantity("s", 0.0, 60.0, "how far ahead is predicted", default=2.0)
    unjudged_on: float = quantity(
        "1", 1.0, 1e9, "samples in a row that cannot be judged at which it is raised", default=10.0
    )

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


class Alarm:
    """Alarm with hysteresis.

    Parameters
    ----------
    limits : AlarmLimits
        When it is raised and cleared.
    """

    def __init__(self, limits: AlarmLimits) -> None:
        self.limits = limits
        self.on = False
        self._unjudged = 0

    def judged(self, margin: float, time: float, *, may_clear: bool) -> None:
        """Take the margin [rad] and the time to tip-over [s] of a sample."""
        self._unjudged = 0
        if margin < self.limits.margin_on or time < self.limits.time_on:
            self.on = True
        elif may_clear and margin > self.limits.margin_off and time > self.limits.time_off:
            self.on = False

    def not_judged(self) -> str:
        """Take a sample that could not be judged; text of why it raises the alarm, if it does."""
        self._unjudged += 1
        if self._unjudged != self.limits.unjudged_on:
            return ""
        self.on = True
        return f"; {self._unjudged} samples in a row not judged"
