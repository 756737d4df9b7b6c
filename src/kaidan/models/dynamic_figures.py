"""What a trial in MuJoCo knows; apart, so that an answer can be read without physics."""

from typing import Literal

from kaidan.answer import Part
from kaidan.modes import Phase

OutcomeName = Literal[
    "climbed", "fell_backward", "fell_forward", "slid", "timed_out", "unstable", "start_fall"
]


class TrialFigures(Part):
    """One trial."""

    friction: float
    """Static friction that was simulated [1]."""
    outcome: OutcomeName
    """How it ended."""
    phase: Phase | None
    """Part of the traverse in which it fell, slid or was given up; null if it did not."""
    step: int | None
    """Nosing that the leading end had reached then, counted from the bottom; null likewise."""
    largest_extra_deg: float
    """Largest inclination beyond the line of the nosings, towards the downhill end [deg]."""
    slip_mm: float
    """How much further the belt ran than the robot drove [mm]."""
    time_s: float
    """Time simulated [s]."""


class PhysicsFigures(Part):
    """Trials in MuJoCo with a smooth rigid belt, from landing to landing."""

    speed_m_s: float
    """Speed of the belt, the lowest if it changes [m/s]."""
    trials: tuple[TrialFigures, ...]
    """One with the smallest friction, and one with the largest where it differs."""
