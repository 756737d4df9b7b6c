"""Room on a flight whose sheet states width, headroom or gaps: findings beside any model's own.

Best case: the robot goes straight up the strip where it fits best, flat on the nosings. Worst case:
it is off line by what a driver needs for corrections, and rears as it does when it meets a riser.
"""

import math
from dataclasses import replace

import numpy as np

from kaidan.models.findings import Finding, Findings, Later
from kaidan.modes import GAP, LOW, NARROW, FailureMode, Phase
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.robot import Posture
from kaidan.terrain import sentences as text
from kaidan.terrain.gap import Gap
from kaidan.terrain.room import Room
from kaidan.terrain.stairs import Stairs

KEPT = 0.1
"""Distance that centroid and turning centre keep from the flight below while the robot stands on a
landing and turns, or moves its flippers [m]: beyond the nosing it would tip back down."""


def findings_of(question: Question, room: Room, model: str) -> tuple[Finding, ...]:
    """Width and headroom, where they are stated; of a robot of unknown size not known.

    The width is that of the widest strip which is free up to the height that the robot needs, the
    headroom that over the strip which the robot needs. So what is too narrow at every height, or
    too low at every place, is stated as that.
    """
    needs = question.needs
    each = []
    if math.isfinite(room.widest):
        wide, narrow = (room.width_up_to(height) for height in (needs.flat, needs.rearing))
        each.append(_between(NARROW, narrow - needs.off_line, wide - needs.straight, model))
    if math.isfinite(room.headroom):
        high, low = (
            room.height_over(width if width < room.widest else room.widest)
            for width in (needs.straight, needs.off_line)
        )
        each.append(_between(LOW, low - needs.rearing, high - needs.flat, model))
    return tuple(each)


def with_gap(question: Question, found: Findings, flight: Stairs, gap: Gap) -> Findings:
    """Findings with whether an end of the robot fits into a gap: at most UNSURE then.

    A round end rolls over a gap that is shorter than it is wide; into a longer one it may drop,
    and no trial has been driven over one. Where no floor was found nobody knows what is there.

    Parameters
    ----------
    question : Question
    found : Findings
        Of any model.
    flight : Stairs
        With the gap.
    gap : Gap
        The longest that the robot must cross.

    Returns
    -------
    Findings
    """
    margin = question.narrowest_end - (gap.length or math.inf)
    finding = Finding.certain(GAP, margin, model=found.model)
    before = found.notes
    notes = Later(lambda: (*before, text.stated(gap, flight.nosing_places)))
    return replace(found, each=(*found.each, finding), notes=notes)


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
