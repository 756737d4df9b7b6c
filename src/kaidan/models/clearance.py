"""Room on a flight whose sheet states width or headroom: findings beside any model's own.

Best case: the robot goes straight up the middle, flat on the nosings. Worst case: it is off line by
what a driver needs for corrections, and rears as it does when it meets a riser.
"""

import math

import numpy as np

from kaidan.mechanics.clearance import headroom_needed, lane_width
from kaidan.models.findings import Finding
from kaidan.modes import LOW, NARROW, FailureMode
from kaidan.outline import Outline, footprint_of, height_of
from kaidan.question import Question

YAW = math.radians(3.0)
"""Yaw off the line of the flight that a driver corrects [rad]."""
OFF_LINE = 0.03
"""Distance off the middle of the flight that a driver corrects [m]."""
REARING = math.radians(15.0)
"""Inclination beyond that of the flight, of a robot that meets a riser [rad]."""


def findings_of(
    question: Question, room: tuple[float | None, float | None], model: str
) -> tuple[Finding, ...]:
    """Width and headroom, where they are stated; of a robot of unknown size not known.

    Parameters
    ----------
    question : Question
    room : (float or None, float or None)
        Clear width and headroom [m].
    model : str
        Model beside whose findings these stand.

    Returns
    -------
    tuple of Finding
    """
    each = []
    width, headroom = room
    outlines = [
        Outline.of(question.robot, posture, question.payload)
        for posture in dict.fromkeys(question.postures.values())
    ]
    length = max(sum(outline.reach) for outline in outlines)
    if width is not None:
        w = max(footprint_of(question.robot, outline).width for outline in outlines)
        needed = lane_width(w=w, length=length, psi=YAW, error=OFF_LINE)
        each.append(_between(NARROW, width - needed, width - w, model))
    if headroom is not None:
        H = max(height_of(question.robot, outline) for outline in outlines)
        slope = question.flight.angle if question.flight else 0.0
        flat, rearing = (
            float(headroom_needed(height=H, length=length, theta_s=slope, phi=slope + more))
            for more in (0.0, REARING)
        )
        each.append(_between(LOW, headroom - rearing, headroom - flat, model))
    return tuple(each)


def _between(mode: FailureMode, worst: float, best: float, model: str) -> Finding:
    return Finding(mode=mode, worst=np.array([worst]), best=np.array([best]), model=model)
