"""Room on a flight whose sheet states width or headroom: findings beside any model's own.

Best case: the robot goes straight up the middle, flat on the nosings. Worst case: it is off line by
what a driver needs for corrections, and rears as it does when it meets a riser.
"""

import math

import numpy as np

from kaidan.mechanics.clearance import headroom_needed, lane_width
from kaidan.models.findings import Finding
from kaidan.modes import LOW, NARROW, FailureMode, Phase
from kaidan.outline import Outline, footprint_of, height_of
from kaidan.question import Question
from kaidan.robot import Posture

YAW = math.radians(3.0)
"""Yaw off the line of the flight that a driver corrects [rad]."""
OFF_LINE = 0.03
"""Distance off the middle of the flight that a driver corrects [m]."""
KEPT = 0.1
"""Distance that centroid and turning centre keep from the flight below while the robot stands on a
landing and turns, or moves its flippers [m]: beyond the nosing it would tip back down."""
REARING = math.radians(15.0)
"""Inclination beyond that of the flight, of a robot that meets a riser [rad]."""


def findings_of(
    question: Question, room: tuple[float | None, float | None], model: str
) -> tuple[Finding, ...]:
    """Width and headroom, where they are stated; of a robot of unknown size not known.

    room: clear width and headroom [m].
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
        flight = question.steepest_flight
        slope = 0.0 if flight is None else flight.angle
        flat, rearing = (
            float(headroom_needed(height=H, length=length, theta_s=slope, phi=slope + more))
            for more in (0.0, REARING)
        )
        each.append(_between(LOW, headroom - rearing, headroom - flat, model))
    return tuple(each)


def room_when_stowed(question: Question) -> float:
    """Length that both landings leave free of a robot that stows its flippers on them [m].

    It comes onto a landing in its posture, stops with the centroid `KEPT` beyond the last nosing or
    more, stows the flippers there and drives on. It sets out stowed, up to the first nosing, and
    takes up its posture there, with its trailing flippers over the landing.
    """
    robot, payload = question.robot, question.payload
    enter, land = (question.postures[phase] for phase in (Phase.ENTER, Phase.LAND))
    ends = list(zip(question.profile.landings, question.leaves, strict=True))
    nose = question.facing == "nose-first"

    def reach(posture: Posture) -> tuple[float, float]:
        behind, ahead = Outline.of(robot, posture, payload).reach
        return (behind, ahead) if nose else (ahead, behind)

    room = []
    for (depth, leaf), posture, sets_out in zip(
        ends[:: -1 if question.direction == "down" else 1], (enter, land), (True, False),
        strict=True,
    ):  # fmt: skip
        (behind, ahead), stowed = reach(posture), reach(Posture(state=posture.state))
        meanwhile = behind + stowed[1] if sets_out else ahead + KEPT
        folded = max(sum(stowed), meanwhile)
        room.append(depth - leaf - min(behind + ahead, folded))
    return min(room)


def _between(mode: FailureMode, worst: float, best: float, model: str) -> Finding:
    return Finding(mode=mode, worst=np.array([worst]), best=np.array([best]), model=model)
