"""Alarm of a monitor: why it is on, when it is raised, and when it is cleared."""

import math
from enum import StrEnum
from typing import ClassVar, Self

from kaidan.sheet import Sheet, model_validator, quantity


class Cause(StrEnum):
    """Why the alarm is on, the most urgent first."""

    TIPPED_OVER = "tipped over"
    """The robot has tipped over: gravity alone turns it farther."""
    TIP_OVER = "tip-over"
    """The robot may tip over: margin or time to tip-over are small."""
    SILENT = "silent"
    """No sample came in time, or a source is too slow for the limit that is not stated."""
    NO_DATA = "no data"
    """Samples came in time, and none could be judged."""
    HALF_BLIND = "half blind"
    """Half of the samples, or more, could not be judged, or did not come."""
    FROZEN = "frozen"
    """All values stay the same, which no stated resolution explains."""
    CLOCK = "clock"
    """Stamps stand, jump, or come from two clocks."""


class AlarmLimits(Sheet):
    """When the alarm is raised and cleared, and what of the sensor decides on it."""

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
    no_data_on: float | None = quantity(
        "s",
        0.05,
        60.0,
        "time without data at which it is raised; without one 0.2 s or 3 periods of the source, "
        "whichever is longer, of at least 5 samples a second",
        default=None,
    )
    resolution: float = quantity(
        "rad",
        0.0,
        0.1,
        "resolution of the inclination: values that stay the same are not frozen where the rate "
        "changes it by no more within 0.5 s",
        default=0.0,
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
    """Alarm of tipping over, with hysteresis.

    Parameters
    ----------
    limits : AlarmLimits
        When it is raised and cleared.
    """

    def __init__(self, limits: AlarmLimits) -> None:
        self.limits = limits
        self.cause: Cause | None = None
        """Why it is on; None while it is off."""

    def judged(self, margin: float, time: float, *, tipped: bool, may_clear: bool) -> None:
        """Take a sample that was judged.

        Parameters
        ----------
        margin : float
            Margin [rad].
        time : float
            Time to tip-over [s].
        tipped : bool
            Whether gravity alone turns the robot over.
        may_clear : bool
            Whether the sample is good enough to clear the alarm.
        """
        near = margin < self.limits.margin_on or time < self.limits.time_on
        calm = margin > self.limits.margin_off and time > self.limits.time_off
        if tipped:
            self.cause = Cause.TIPPED_OVER
        elif self.cause is Cause.TIPPED_OVER and not may_clear:
            return
        elif near or (self.cause is not None and not (calm and may_clear)):
            self.cause = Cause.TIP_OVER
        else:
            self.cause = None
