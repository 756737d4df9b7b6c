"""The best plan with one end leading: of the most promising ones, judged in one go.

Plans put together of the best of each phase are driven in one go, changes included, and judged by
the verdict policy, at the angles found and a little off them.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from kaidan.assessment.plan_drives import Drives
from kaidan.assessment.plan_hopes import Hope, Merit, Search
from kaidan.assessment.plan_judged import Judged, Standing, judged_of
from kaidan.assessment.plan_off_angles import OffAngles, judged_off
from kaidan.assessment.plan_sturdy import Sturdier
from kaidan.assessment.plans import Plan, off_angles
from kaidan.models import judge
from kaidan.modes import CONTACT, Verdict
from kaidan.question import Question

FINALISTS = 3
"""Plans that are driven in one go and judged at most: the best one at its angles too."""
SLACK = 0.5
"""Margin by which a plan may be better than its scores [deg]."""
NEARLY = 0.1
"""Difference of two scores from which on both plans are judged [deg]."""


class Candidate(NamedTuple):
    """A plan that may be the best, and what the scores of its phases let one hope for."""

    plan: Plan
    hope: Merit
    """At its angles."""
    off: Merit
    """The worst off them, as far as it is scored."""


def sturdiest(
    search: Search, beaten: Standing | None, drives: Drives, stated: Question | None = None
) -> OffAngles | None:
    """Best plan of a search: the most promising off their angles, judged in one go.

    Of plans that are no better than what is beaten it is any; None: no plan promised to be better.
    """
    holding: list[Candidate] = []
    others: list[Candidate] = []
    for each in _candidates(search):
        (holding if search.may_hold(each.plan) else others).append(each)
    at_them: dict[Plan, Judged] = {}
    best, first = _best_of(holding, search, None, beaten, drives, stated, at_them)
    if first is None and others:
        at_them = {
            each.plan: _judged(each.plan.question(search.question), drives) for each in others
        }
        first = max(at_them.values(), key=lambda one: one.merit)
    plan = _to_steady(search, first)
    if plan is not None and not (best is not None and best.worst[0] == -Verdict.GO.rank):
        steadied = _steadied(search, plan, _better(beaten, best), drives)
        best = max((each for each in (best, steadied) if each), key=_worst, default=None)
    if best is not None and best.worst[0] == -Verdict.GO.rank:
        return best
    return _best_of(others, search, best, beaten, drives, stated, at_them)[0]


def _worst(plan: OffAngles) -> Standing:
    return plan.worst


def _best_of(
    candidates: Sequence[Candidate],
    search: Search,
    best: OffAngles | None,
    beaten: Standing | None,
    drives: Drives,
    stated: Question | None,
    known: Mapping[Plan, Judged],
) -> tuple[OffAngles | None, Judged | None]:
    """The best of some plans and of what is known already, and the best of those judged at them.

    Of `known` plans it is known what they come to at their angles.
    """
    first: Judged | None = None
    of_best: Candidate | None = None
    for each in candidates:
        bar = _better(beaten, best)
        if bar is not None and not _may_be_better(search, each, bar, of_best, drives):
            continue
        judged = known.get(each.plan)
        if judged is None:
            judged = _judged_at(each, search, drives, stated if bar is None else None)
        first = max(first or judged, judged, key=lambda one: one.merit)
        found = judged_off(judged, bar, drives, search)
        if best is None or found.worst > best.worst:
            best = found
            as_hoped = found.robust and -judged.merit[0] == _rank(search, each.off)
            of_best = each if as_hoped else None
    return best, first


def _to_steady(search: Search, first: Judged | None) -> Plan | None:
    """Plan about which others are sought that hold off their angles; None: none will."""
    if first is None:
        return None
    hoped, grips = first.conclusion.verdict, search.question.robot.track.has_grousers
    if hoped.rank > (Verdict.UNSURE if grips else Verdict.GO).rank:
        return None
    at = first.question.postures
    return Plan(search.scores.facing, tuple((phase, at[phase]) for phase in search.scores.phases))


def _steadied(
    search: Search, plan: Plan, beaten: Standing | None, drives: Drives
) -> OffAngles | None:
    """A plan like another one that holds off its angles; None: none is found."""
    sturdier = Sturdier(search.scores, search.limits, drives).plan(plan)
    if sturdier is None:
        return None
    return judged_off(_judged(sturdier.question(search.question), drives), beaten, drives)


def _judged_at(each: Candidate, search: Search, drives: Drives, stated: Question | None) -> Judged:
    """A plan judged at its angles; where it promises GO first on the whole of what is stated.

    As a rule it is one, and needs no other judgement at its angles.
    """
    question = each.plan.question(search.question)
    goes = each.off[0] == -Verdict.GO.rank
    if stated is not None and stated.model == CONTACT.name and goes:
        whole = question.changed(terrain=stated.terrain)
        judged = judged_of(question, judge(whole))._replace(whole=True)
        if judged.conclusion.verdict is Verdict.GO:
            return judged
    return _judged(question, drives)


def _better(beaten: Standing | None, best: OffAngles | None) -> Standing | None:
    """The larger of two merits to beat."""
    if best is None or beaten is None:
        return beaten if best is None else best.worst
    return max(beaten, best.worst)


def _candidates(search: Search) -> list[Candidate]:
    """Plans to judge, the first first: by the verdict that they promise off their angles."""
    hopes = search.hopes()
    dearest = max(hopes, key=lambda hope: hope.merit)
    merits = {hope.plan: hope.merit for hope in hopes}
    plans = dict.fromkeys([*_best_off(search, hopes, FINALISTS - 1), dearest.plan])
    each = [Candidate(plan, merits[plan], search.off(plan)) for plan in plans]
    return sorted(each, key=lambda one: (-_rank(search, one.off), one.hope), reverse=True)


def _rank(search: Search, merit: Merit) -> int:
    """Rank of the verdict that a merit promises; grousers may do better than friction alone."""
    return Verdict.GO.rank if search.question.robot.track.has_grousers else -merit[0]


def _may_be_better(
    search: Search,
    each: Candidate,
    bar: Standing,
    of_best: Candidate | None,
    drives: Drives,
) -> bool:
    """Whether a plan may be better than what is beaten.

    of_best: the plan that has it, where it came to what it promised.
    """
    rank = _rank(search, each.hope)
    if rank != -bar[0]:
        return rank < -bar[0]
    known = not search.question.robot.track.has_grousers
    if known and bar[2] >= -1 and each.hope[2] + SLACK <= bar[3]:
        return False
    if of_best is not None and known and each.hope[2] <= of_best.hope[2] + NEARLY:
        return False
    if _rank(search, each.off) <= -bar[0]:
        return True
    # where the plan promises to fail: one judgement tells
    off = search.weakest_first(off_angles(each.plan.question(search.question)))
    return not off or drives.rank(off[0]) >= bar[0]


def _best_off(search: Search, hopes: Sequence[Hope], count: int) -> list[Plan]:
    """Plans of the largest merit off their angles, which is never larger than at them."""
    best: list[tuple[Merit, Merit, Plan]] = []
    for hope in sorted(hopes, key=lambda hope: hope.merit, reverse=True):
        if len(best) == count and hope.merit < best[-1][0]:
            break
        best.append((search.off(hope.plan), hope.merit, hope.plan))
        best = sorted(best, key=lambda each: each[:2], reverse=True)[:count]
    return [plan for *_, plan in best]


def _judged(question: Question, drives: Drives) -> Judged:
    return judged_of(question, drives.judge(question))
