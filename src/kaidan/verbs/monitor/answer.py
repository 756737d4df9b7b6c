"""Answer of the monitor: what became of each sample, and of all of them."""

from enum import StrEnum
from typing import ClassVar

from kaidan.answer import Answer, Part
from kaidan.verbs.monitor.alarm import Cause

LEAST_SHARE = 0.5
"""Share of the samples that must have been judged for an answer of no alarm."""


class SampleStatus(StrEnum):
    """What became of a sample."""

    OK = "ok"
    """Judged."""
    TIME_DOUBTFUL = "time-doubtful"
    """Judged in the worst position: its time is missing, or not after that of the sample before.
    It may raise the alarm and does not clear it."""
    POSITION_DOUBTFUL = "position-doubtful"
    """Judged in the worst position: the one given is impossible, or too far from the last."""
    NOT_FINITE = "not-finite"
    """Not judged: a value is missing, NaN or infinite."""
    IMPLAUSIBLE = "implausible"
    """Not judged: a value that no robot has, degrees for radians perhaps."""
    UNREADABLE = "unreadable"
    """Not judged: a row that cannot be read."""
    OUTSIDE_MODEL = "outside-model"
    """Not judged: two nosings do not carry the robot everywhere on these stairs."""
    MISSING = "missing"
    """No sample: none came in time."""


class MonitorState(Part):
    """What the monitor says of one sample; angles and times are None where it was not judged."""

    t_s: float | None
    """Time of the sample [s]; None if it has none."""
    row: int
    """Its line or number."""
    status: SampleStatus
    """What became of it."""
    message: str
    """What is wrong with it; empty if nothing."""
    margin_deg: float | None
    """Smaller of the two angles [deg]."""
    margin_downhill_deg: float | None
    """Angle left before the robot tips over its lowest contact [deg]."""
    margin_uphill_deg: float | None
    """Angle left before it tips over its highest contact [deg]."""
    centroid_margin_mm: float | None
    """Distance of the zero moment point from the nearer end of the support [mm]."""
    time_to_tip_s: float | None
    """Time until an angle is used up [s]; 0 if it is, None if it is not within the horizon."""
    alarm: bool
    """Whether the alarm is on."""
    causes: tuple[Cause, ...]
    """Why it is on, the most urgent first."""
    due_s: float | None
    """Time within which the next sample has to arrive [s]; None in a recording. Who takes states
    over a line that may break off has an alarm if none comes for longer."""

    @property
    def judged(self) -> bool:
        """Whether there is a margin."""
        return self.margin_deg is not None


class MonitorAnswer(Answer):
    """Answer of `monitor`: what the samples said of tipping over."""

    text_module: ClassVar[str] = "monitor"

    robot: str
    """Name of the robot."""
    stairs: str
    """Name of the stairs."""
    samples: int
    """Samples that came."""
    judged: int
    """Samples that could be judged."""
    statuses: dict[str, int]
    """Number of samples by status."""
    first_unjudged: str
    """What is wrong with the first sample that could not be judged; empty if there is none."""
    lowest_margin_deg: float | None
    """Lowest margin of all samples [deg]; None if none was judged."""
    lowest_margin_t_s: float | None
    """Time of that sample [s]."""
    alarms: int
    """Times that the alarm was raised."""
    raised: dict[str, int]
    """Times that it was raised by each cause."""
    first_alarm_row: int | None
    """Line or number of the sample that raised it first."""
    first_alarm_t_s: float | None
    """Time of that sample [s]."""
    rate_hz: float | None
    """Samples a second, at the end [Hz]; None if their stamps do not tell."""
    inside_model: bool
    """Whether two nosings carry the robot everywhere on these stairs."""
    states: tuple[MonitorState, ...] = ()
    """One a sample; empty if they were given out one by one."""

    @property
    def unjudged_share(self) -> float:
        """Share of the samples that could not be judged, from 0 to 1."""
        return 1.0 - self.judged / self.samples

    @property
    def exit_code(self) -> int:
        """Code with which the command ends.

        3 outside the model, 1 the alarm was raised, 2 more than half of the samples could not be
        judged, else 0.
        """
        if not self.inside_model:
            return 3
        if self.alarms:
            return 1
        return 2 if self.unjudged_share > 1.0 - LEAST_SHARE else 0
