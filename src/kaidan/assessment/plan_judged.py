"""Plans driven in one go and judged: their order, and the terrain on which they are compared."""

import math
from typing import NamedTuple

from kaidan.assessment.plan_scores import ENOUGH
from kaidan.assessment.plans import cost_of, cost_of_drop
from kaidan.assessment.verdict import Conclusion, conclude
from kaidan.models.findings import Findings
from kaidan.models.quasi_static import Basis
from kaidan.modes import FALLS, Verdict
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Traverse

Standing = tuple[int, bool, int, float]
"""Order of plans that were judged; larger is better."""


class Judged(NamedTuple):
    """A plan driven in one go, at its angles or off them."""

    question: Question
    findings: Findings
    conclusion: Conclusion
    drop: float
    """Largest rotation [deg]."""
    arrives: bool
    """Whether it gets to the end, whatever the verdict."""
    whole: bool = False
    """Whether its findings are those of the whole terrain, pose by pose."""

    @property
    def merit(self) -> Standing:
        """Verdict, whether it arrives, what fails, margin less what drop and changes cost."""
        margin = math.degrees(self.conclusion.margin)
        falls = self.conclusion.governs in {mode.key for mode in FALLS}
        if math.isnan(margin) or (falls and self.conclusion.verdict is Verdict.NO_GO):
            margin = -90.0  # a fall from less far is no help
        margin = min(margin, ENOUGH)
        cost = cost_of_drop(self.drop)
        cost += cost_of(self.question.robot, list(self.question.postures.values()))
        return (
            -self.conclusion.verdict.rank,
            self.arrives,
            -len(self.conclusion.doubts),
            round(margin - cost, 6),
        )


def judged_of(question: Question, found: Findings) -> Judged:
    """What findings of a plan come to, beside those of others."""
    traverses: list[Traverse] = []
    if isinstance(found.basis, Basis):
        driven = found.basis.traverse
        traverses = [driven] if isinstance(driven, Traverse) else [p.traverse for p in driven.parts]
    drop = max((_drop(each) for each in traverses), default=0.0)
    arrives = all(each.arrived for each in traverses)
    return Judged(question, found, conclude(question, found), drop, arrives)


def _drop(found: Traverse) -> float:
    """Largest rotation of a traverse [deg]."""
    return max((math.degrees(abs(each.angle)) for each in found.chains), default=0.0)


def shortened(question: Question) -> Question:
    """Same question on a flight just long enough for what repeats; others stay as they are.

    A uniform flight repeats itself once the robot has left the lower landing: as many nosings as
    the robot spans, its flippers stretched, and two more hold every pose of the whole flight, since
    for the way from one nosing to the next it is on none of the landings.
    """
    stairs = question.terrain
    if not isinstance(stairs, Stairs) or stairs.rise is None or stairs.gaps:
        return question
    enough = max(5, math.ceil(stretched(question.robot) / stairs.nosing_spacing) + 2)
    if stairs.steps <= enough:
        return question
    return question.changed(terrain=stairs.model_copy(update={"steps": enough}))


def stretched(robot: Robot) -> float:
    """Length of a robot with its flippers stretched [m]."""
    outline = Outline.of(robot)
    stance, (behind, ahead) = outline.stance, outline.reach
    to_tip = {"front": stance.com_from_front, "rear": stance.flat_length - stance.com_from_front}
    beyond = {"front": ahead, "rear": behind}
    for end, pair in robot.flippers().items():
        reach = to_tip[end] - pair.pivot_inset + pair.length + pair.tip_radius
        beyond[end] = max(beyond[end], reach)
    return sum(beyond.values())
