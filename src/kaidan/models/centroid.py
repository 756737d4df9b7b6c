"""Where the centroid would have to be for a robot that tips on a regular flight."""

import math

import numpy as np

from kaidan.mechanics.margin import centroid_margin_downhill, centroid_margin_uphill
from kaidan.models.findings import at_risk
from kaidan.models.samples import draws, nominal
from kaidan.question import Question


def shift_of_centroid(question: Question, *, downhill: bool) -> float | None:
    """Shift along the track, away from the end that it tips over, that gives a margin of zero.

    Shift [m] in the worst case at the risk; None where none is needed, the track is too short for
    any, or the terrain has no regular steps or the robot heads off.
    """
    flight = question.steepest_flight
    if flight is None or question.yaw:
        return None
    at = nominal(question, flight)
    d, M = question.allowance_d.high, question.allowance_M.high
    short = []
    for block in draws(question, at):
        geometry = {"p": block.p, "C_L": block.C_L, "C_N": block.C_N, "a": question.acceleration}
        tilted = block.theta_s + d + M
        down = centroid_margin_downhill(L=block.L, theta_s=tilted, **geometry)
        up = centroid_margin_uphill(theta_s=block.theta_s - d, **geometry)
        room = down + up
        margin = np.where(tilted < math.pi / 2, down, -np.inf) if downhill else up
        short.append(np.where(room < 0, -np.inf, margin).min(axis=-1))
    shift = -at_risk(np.minimum.reduce(short), question.risk)
    return shift if math.isfinite(shift) and shift > 0 else None
