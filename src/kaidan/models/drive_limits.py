"""What the drive can do: the traction it brings, and the slope that takes it."""

import math
from typing import Any

import numpy as np

from kaidan.mechanics.drive import drive_slope
from kaidan.question import Question


def traction_limit(question: Question, speed: float | None = None) -> float | None:
    """Largest sum of tractive forces [N] at a speed, the requested one without; None: not known.

    The power counts only on the way up: what the drive can brake on the way down is another
    figure, which no sheet gives.
    """
    drive = question.robot.drive
    limits = [drive.max_traction] if drive.max_traction is not None else []
    speed = question.speed if speed is None else speed
    if drive.max_power is not None and speed and question.direction == "up":
        limits.append(drive.max_power * drive.efficiency / speed)
    return min(limits) if limits else None


def steepest_for_drive(question: Question, a: Any) -> Any:
    """Steepest slope on which the drive brings the traction for an acceleration.

    question: `a` stands for its acceleration.
    a: acceleration up the stairs [m/s^2].

    Slope [rad], at most pi/2; NaN where traction or mass is not known.
    """
    force, mass = traction_limit(question), question.stance.mass
    if force is None or mass is None:
        return math.nan
    with np.errstate(invalid="ignore"):
        limit = drive_slope(a=a, F=force, M=mass, c_rr=question.rolling_resistance)
    any_or_none = np.where(force > mass * a, math.pi / 2, -math.pi / 2)
    return np.minimum(np.where(np.isnan(limit), any_or_none, limit), math.pi / 2)
