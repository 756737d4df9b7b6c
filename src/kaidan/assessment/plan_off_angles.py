"""Plans judged off their angles, by the tolerance of a question: whether a verdict holds there."""

import math
from typing import NamedTuple

from kaidan.assessment.plan_drives import Drives
from kaidan.assessment.plan_hopes import Search
from kaidan.assessment.plan_judged import Judged, Standing, judged_of, shortened
from kaidan.assessment.plans import off_angles
from kaidan.modes import Verdict
from kaidan.question import Question


class OffAngles(NamedTuple):
    """A plan judged at its angles and off them."""

    judged: Judged
    worst: Standing
    """Merit with the worst verdict off its angles, or with a better one where it is not tested."""
    tested: bool
    """Whether every way off its angles was judged that may be the worst."""

    @property
    def robust(self) -> bool:
        """Whether its verdict holds off its angles."""
        return self.worst[0] == self.judged.merit[0]


def judged_off(
    plan: Judged, beaten: Standing | None, drives: Drives, search: Search | None = None
) -> OffAngles:
    """A plan judged off its angles, as long as its verdict may be better than what is beaten.

    One that is NO-GO at its angles is no worse off them.
    """
    worst = plan.merit
    if worst[0] <= -Verdict.NO_GO.rank:
        return OffAngles(plan, worst, tested=True)
    each = list(off_angles(plan.question))
    for off in each if search is None else search.weakest_first(each):
        if beaten is not None and worst <= beaten:
            return OffAngles(plan, worst, tested=False)
        if worst[0] == -Verdict.UNSURE.rank and drives.is_no_failure(off):
            continue
        worst = (min(worst[0], drives.rank(off)), *worst[1:])
        if worst[0] <= -Verdict.NO_GO.rank:
            break
    return OffAngles(plan, worst, tested=True)


def holds_off_its_angles(question: Question, drives: Drives | None = None) -> bool:
    """Whether a stated plan has no worse verdict off its angles, judged as the search judges.

    question: its `tolerance` is how far off they are.
    """
    drives = Drives() if drives is None else drives
    middle = question.changed(robot=question.robot.middle)
    short = shortened(middle)
    judged = judged_of(short, drives.judge(short))
    # any worse verdict tells
    worse = (judged.merit[0] - 1, True, 0, math.inf)
    return judged_off(judged, worse, drives).robust


def friction_off_its_angles(question: Question, drives: Drives | None = None) -> float:
    """Friction that a stated plan requires off its angles, judged as the search judges [1].

    question: its `tolerance` is how far off they are; 0: nothing is required there.
    """
    drives = Drives() if drives is None else drives
    middle = shortened(question.changed(robot=question.robot.middle))
    each = (drives.required_friction(off) for off in off_angles(middle))
    return max((one for one in each if math.isfinite(one)), default=0.0)
