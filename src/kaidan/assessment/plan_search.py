"""The search for a plan: which end leads, and the posture of each phase.

Each phase is driven from a start of its own, so that a posture that is good for landing is found
although it would never have come so far. Postures are compared by a cheap score; plans put
together of the best of each phase are then driven in one go, changes included, and judged by the
verdict policy, at the angles found and a little off them. A change has to gain something.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

from kaidan.assessment.plan_drives import Drives
from kaidan.assessment.plan_finalists import sturdiest
from kaidan.assessment.plan_hopes import LIMITS as LIMITS
from kaidan.assessment.plan_hopes import Search
from kaidan.assessment.plan_judged import Judged, Standing, judged_of, shortened
from kaidan.assessment.plan_off_angles import OffAngles, holds_off_its_angles, judged_off
from kaidan.assessment.plans import Plan, words
from kaidan.assessment.plans import off_angles as off_angles
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.models.findings import Findings
from kaidan.modes import CONTACT, Facing, Phase, Verdict
from kaidan.question import Question
from kaidan.surface import Surface

UNKNOWN = 1.0
"""Friction at which plans are compared where nobody states one [1]."""
OTHER_FRICTIONS = (1.0, 0.7, 1.3)
"""Frictions of which the best plan is tried too where that at the friction stated is no GO; more
than the first where it is no GO with that either [1]."""


class Found(NamedTuple):
    """What a search came upon."""

    question: Question
    """With the plan."""
    findings: Findings
    """Of that question."""
    robust: bool
    """Whether its verdict holds off its angles by the question's tolerance."""
    short: Question
    """On which it searched: a long uniform flight repeats itself."""
    drives: Drives
    """What was driven for it in one go."""
    tried: int = 0
    """Drives of a phase."""
    ends: tuple[Facing, ...] = ()
    """Ends that were tried first: the other one only where the nose is no GO."""
    others: tuple[Question, ...] = ()
    """With plans that are a GO at another friction, on what it searched."""

    @property
    def best_of(self) -> tuple[str, ...]:
        """What was searched, as a question has it."""
        return ("flippers", "facing") if len(self.ends) > 1 else ("flippers",)


def found_of(
    question: Question, limits: tuple[float, float] = LIMITS, *, drives: Drives | None = None
) -> Found:
    """Best plan of a question whose posture is to be found; see `better_than`."""
    found = better_than(None, question, limits, drives=drives)
    assert found is not None
    return found


def better_than(
    verdict: Verdict | None,
    question: Question,
    limits: tuple[float, float] = LIMITS,
    *,
    drives: Drives | None = None,
    other_frictions: bool = True,
) -> Found | None:
    """Best plan of a question whose posture is to be found; None: none has a better verdict.

    verdict: that a plan has to exceed; without it any plan is looked at.
    question: with `best_of`.
    limits: angles allowed [rad]; the stowed angle and lying flat always are.
    other_frictions: whether the best plans at `OTHER_FRICTIONS` are tried too.
    """
    kept = question.tolerance or None
    stated = question.changed(best_of=(), changes=(), flipper_tolerance=kept)
    facings: tuple[Facing, ...] = (stated.facing,)
    if "facing" in question.best_of:
        facings = ("nose-first", "tail-first")
    drives = Drives() if drives is None else drives
    if not stated.plannable:
        return _fixed(stated, facings, drives)
    if stated.surface is None:
        return _at_unknown_friction(verdict, question, limits, drives)
    short = shortened(stated)
    ends = _Ends(facings, limits, drives)
    beaten = None if verdict is None else _most(-verdict.rank)
    plans = ends.plans(short, beaten, stated)
    others: list[Question] = []
    for friction in OTHER_FRICTIONS if other_frictions and _may_pass_over(stated) else ():
        best = max((each.worst for each in plans), default=beaten)
        if best is not None and best[0] == -Verdict.GO.rank:
            break
        surface = Surface.of_friction(friction)
        if surface == stated.surface or (others and friction > OTHER_FRICTIONS[0]):
            continue
        bar = None if best is None else _most(best[0])
        at_that = ends.plans(short.changed(surface=surface), bar)
        if not at_that:
            continue
        there = max(at_that, key=lambda each: each.worst)
        question = there.judged.question.changed(surface=short.surface)
        here = judged_off(judged_of(question, drives.judge(question)), best, drives)
        if best is None or here.worst > best:
            plans.append(here)
        if here.worst[0] < there.worst[0] == -Verdict.GO.rank:
            others.append(question)
    if not plans and verdict is not None:
        return None
    ranked = sorted(plans, key=lambda each: each.worst, reverse=True)
    found = _on_the_whole(stated, ranked, drives)
    return found._replace(tried=ends.tried, ends=tuple(ends.first), others=tuple(others))


def _most(rank: int) -> Standing:
    """Merit that no plan exceeds whose verdict has a rank, its sign turned."""
    return rank, True, 0, math.inf


def _may_pass_over(question: Question) -> bool:
    """Whether the search may pass over a plan at one friction that it finds at another.

    The scores that lead it know friction and no grousers. A plan that is GO at less friction is GO
    at more.
    """
    robot = question.robot
    return robot.track.has_grousers and bool(robot.flippers() or robot.states)


class _Ends:
    """Searches with one end leading, and with the other where the first has no robust GO."""

    def __init__(
        self, facings: tuple[Facing, ...], limits: tuple[float, float], drives: Drives
    ) -> None:
        self.facings, self.limits, self.drives = facings, limits, drives
        self.tried = 0
        """Drives of a phase."""
        self.first: dict[Facing, None] = {}
        """Ends that were tried, in their order."""

    def plans(
        self, short: Question, beaten: Standing | None, stated: Question | None = None
    ) -> list[OffAngles]:
        """Best plan of each end that is tried, of those that exceed what is beaten."""
        plans: list[OffAngles] = []
        for facing in self.facings:
            search = Search(short, facing, self.limits)
            bar = plans[-1].worst if plans else beaten
            found = sturdiest(search, bar, self.drives, stated)
            self.first[facing] = None
            self.tried += len(search.scores.known)
            if found is None or (beaten is not None and found.worst <= beaten):
                continue
            plans.append(found)
            if found.robust and found.judged.conclusion.verdict is Verdict.GO:
                break
        return plans


def _at_unknown_friction(
    verdict: Verdict | None, question: Question, limits: tuple[float, float], drives: Drives
) -> Found | None:
    """Best plan where no friction is stated: the best at a friction of `UNKNOWN`.

    So of two plans the one is better that needs less of it. Without a friction nothing is known to
    hold: no plan is a GO. None: it has no better verdict than the one given.
    """
    if verdict is not None and verdict.rank <= Verdict.UNSURE.rank:
        return None
    found = found_of(question.changed(surface=Surface.of_friction(UNKNOWN)), limits, drives=drives)
    asked = found.question.changed(surface=None)
    findings = judge(asked)
    if verdict is not None and conclude(asked, findings).verdict.rank >= verdict.rank:
        return None
    robust = found.robust or holds_off_its_angles(asked, drives)
    return found._replace(
        question=asked,
        findings=findings,
        robust=robust,
        short=found.short.changed(surface=None),
    )


def _on_the_whole(stated: Question, plans: Sequence[OffAngles], drives: Drives) -> Found:
    """First of some plans whose verdict the whole terrain, pose by pose, does not lower."""
    each = []
    for plan in plans:
        tested = plan if plan.tested else judged_off(plan.judged, None, drives)
        each.append((_on_all_of(stated, plan.judged), tested))
        if each[-1][0].merit[0] >= plan.judged.merit[0]:
            break
    whole, plan = max(each, key=lambda one: one[0].merit[0])
    return Found(whole.question, whole.findings, plan.robust, plan.judged.question, drives)


def _on_all_of(stated: Question, plan: Judged) -> Judged:
    """A plan judged on the whole terrain, pose by pose."""
    question = plan.question.changed(terrain=stated.terrain)
    if plan.whole:
        return plan._replace(question=question)
    return judged_of(question, judge(question))


def _fixed(question: Question, facings: tuple[Facing, ...], drives: Drives) -> Found:
    """Best of the words for postures, for a model that judges one posture throughout."""
    known = list(words(question.robot))
    plans = [
        Plan(facing, ((Phase.ENTER, posture),)).question(question)
        for facing in facings
        for posture in known
    ]
    each = [judged_of(plan, drives.judge(plan)) for plan in plans]
    best = max(each, key=lambda one: one.merit)
    coarse = question.model == CONTACT.name
    found = judge(best.question) if coarse else best.findings
    return Found(best.question, found, True, question, drives, len(each), facings)
