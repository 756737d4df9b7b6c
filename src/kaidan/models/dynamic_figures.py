"""What trials in MuJoCo know; apart, so that an answer can be read without physics."""

from typing import ClassVar, Literal

from kaidan.answer import Part
from kaidan.modes import Phase

OutcomeName = Literal[
    "climbed",
    "fell_backward",
    "fell_forward",
    "slid",
    "stalled",
    "timed_out",
    "unstable",
    "start_fall",
]


class TrialFigures(Part):
    """One trial."""

    draw: int
    """Number of its inputs; trials of one draw differ by their friction."""
    friction: float
    """Static friction that was simulated [1]."""
    outcome: OutcomeName
    """How it ended."""
    phase: Phase | None
    """Part of the traverse in which it fell, slid, stalled or was given up; null: none."""
    step: int | None
    """Nosing that the leading end had reached then, counted from the bottom; null likewise."""
    largest_extra_deg: float
    """Largest inclination beyond the line of the nosings, towards the downhill end [deg]."""
    slip_mm: float
    """How much further the belt ran than the robot drove [mm]."""
    time_s: float
    """Time simulated [s]."""


class PhysicsFigures(Part):
    """Trials in MuJoCo, or of a yielding belt in the plane, from landing to landing."""

    shown_as: ClassVar[str] = "physics"

    track: Literal["smooth-belt", "yielding-belt", "driven-grousers"]
    """Model of the track."""
    speed_m_s: float
    """Speed of the belt, the lowest if it changes [m/s]."""
    draws: int
    """Times the inputs were drawn."""
    failed: int
    """Draws that fail in the worst case: with the smallest or the largest friction."""
    failed_best: int
    """Draws that fail in the best case: with both."""
    failure_interval: tuple[float, float]
    """95 % interval (Clopper-Pearson) of the probability of failing in the worst case [1]."""
    trials: tuple[TrialFigures, ...]
    """Of each draw one with the smallest friction, and one with the largest where it differs."""
