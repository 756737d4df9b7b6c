"""The search among plans put together by hand: which phase first, which plans, what is known."""

import math
from types import SimpleNamespace

import pytest

from kaidan import Question, Robot, Stairs
from kaidan.assessment import plan_finalists as finalists
from kaidan.assessment import plan_off_angles
from kaidan.assessment import plan_search as module
from kaidan.assessment.plan_drives import Drives
from kaidan.assessment.plan_hopes import KEPT, Search
from kaidan.assessment.plan_judged import Judged
from kaidan.assessment.plan_off_angles import (
    friction_off_its_angles,
    holds_off_its_angles,
    judged_off,
)
from kaidan.assessment.plan_scores import ENOUGH, FAILED, Score
from kaidan.modes import Phase, Verdict
from kaidan.robot import Posture

ABSOLEM = Robot.named("absolem")
STAIRS = Stairs(rise=0.17, going=0.29, steps=6)
GO, ROUGH, UNSURE, NO_GO, _ = (-each.rank for each in Verdict)
ENTER, TRAVERSE, LAND = Phase


def degrees(*angles):
    return [Posture(front=math.radians(each)) for each in angles]


# postures of each phase


class Stated:
    """Scores of postures stated by phase and front angle [deg], stowed by None."""

    def __init__(self, margins, facing="nose-first"):
        self.margins, self.facing, self.phases = margins, facing, tuple(margins)

    def of(self, phase, posture):
        angle = posture.front
        at = round(math.degrees(angle)) if isinstance(angle, float) else angle
        return Score(GO, 0, self.margins[phase].get(at, -80.0), 0.0)

    off = of

    def bound(self, phase):
        return ENOUGH

    def work_out(self, wanted):
        for _ in wanted:
            pass


def searching(margins, facing="nose-first", robot=ABSOLEM):
    question = Question.in_one_posture(robot, STAIRS, friction=1.0)
    search = Search(question, facing, (math.radians(-60.0), math.radians(60.0)))
    search.scores = Stated(margins, facing)
    return search


def test_the_weakest_phase_is_looked_at_first_and_what_is_enough_follows_it():
    """By the best of the postures that have a name: 4, 9 and 2 deg, stowed or flat."""
    margins = {
        ENTER: {None: 4.0, "flat": 1.0}, TRAVERSE: {None: 0.0, "flat": 9.0}, LAND: {None: 2.0}
    }  # fmt: skip
    search = searching(margins)
    scanned, kept = [], []

    def scan(phase, known, enough):
        scanned.append((phase, enough))
        better = degrees({LAND: 10.0, ENTER: 20.0, TRAVERSE: 30.0}[phase])[0]
        margins[phase][round(math.degrees(better.front))] = {LAND: 6.0, ENTER: 5.0}.get(phase, 7.0)
        search._allowed[phase][better] = None

    search._scan = scan
    search._together = lambda choices: kept.extend(choices)
    search.hopes()
    assert scanned == [(LAND, math.inf), (ENTER, 6.0), (TRAVERSE, 5.0)]
    # of each phase those with a name, its own best ones, and the best one of each other phase
    assert [len(each) == len(set(each)) for each in kept] == [True] * 3
    best = dict(zip((LAND, ENTER), degrees(10.0, 20.0), strict=True))
    for each in kept:
        assert {best[LAND], best[ENTER], Posture()} <= {*each}
        assert len(each) >= KEPT


@pytest.mark.parametrize(("facing", "order"), [("nose-first", ["front", "rear"]),
                                               ("tail-first", ["rear", "front"])])  # fmt: skip
def test_the_leading_pair_is_turned_first_from_the_best_posture(facing, order):
    search = searching({ENTER: {None: 1.0, 10: 3.0, 20: 2.0}}, facing)
    begun, known = [], [Posture(), *degrees(10.0, 20.0)]

    def better(phase, best, end, angles, enough):
        begun.append((best, end))
        return best

    search._better = better
    search._scan(ENTER, known, 5.0)
    assert begun[0][0] == known[1]
    assert [end for _, end in begun] == order * 3  # the grid, then twice about the best


def test_those_that_are_not_scored_in_every_phase_come_last():
    search = searching({ENTER: {}, LAND: {}})
    search.scores.known = {
        (phase, posture): Score(GO, 0, margin, 0.0)
        for posture, margin in zip(degrees(10.0, 20.0), (3.0, 1.0), strict=True)
        for phase in (ENTER, LAND)
    }
    search.scores.known[ENTER, degrees(30.0)[0]] = FAILED
    questions = [
        Question.in_one_posture(ABSOLEM, STAIRS, friction=1.0).changed(posture=each)
        for each in degrees(40.0, 10.0, 30.0, 20.0)
    ]
    order = [round(math.degrees(each.posture.front)) for each in search.weakest_first(questions)]
    assert order == [20, 10, 40, 30]


# plans


def conclusion(verdict, margin=0.1):
    return SimpleNamespace(verdict=verdict, margin=margin, governs="tip_downhill", doubts=())


def judged(verdict=Verdict.GO, question="own"):
    return Judged(question, "findings", conclusion(verdict), 0.0, True)


@pytest.fixture
def searched(monkeypatch):
    """A search of each end that leads: its best plan, and how many drives it took."""

    def of(*ends, best_of=("flippers", "facing"), known=False, verdict=None):
        left, ranked = list(ends), []

        def search(question, facing, limits):
            count, _ = left[0]
            return SimpleNamespace(scores=SimpleNamespace(known=range(count)))

        def sturdiest(search, beaten, drives, stated):
            assert (drives == "known") if known else isinstance(drives, Drives)
            assert stated.tolerance == question.tolerance
            assert (stated.best_of, stated.changes) == ((), ())
            return left.pop(0)[1]

        def on_the_whole(stated, plans, drives):
            ranked.extend(plans)
            return module.Found("question", "findings", True, "short", drives)

        monkeypatch.setattr(module, "Search", search)
        monkeypatch.setattr(module, "sturdiest", sturdiest)
        monkeypatch.setattr(module, "_on_the_whole", on_the_whole)
        question = Question.of(ABSOLEM, STAIRS, friction=1.0).changed(best_of=best_of)
        return module.better_than(verdict, question, drives="known" if known else None), ranked

    return of


def off(verdict, value, *, robust=True):
    plan = judged(verdict)
    worst = (-verdict.rank if robust else NO_GO, True, 0, value)
    return SimpleNamespace(judged=plan, worst=worst, robust=robust)


def test_the_other_end_is_tried_where_the_nose_is_no_sturdy_go(searched):
    go, loose = off(Verdict.GO, 5.0), off(Verdict.GO, 9.0, robust=False)
    unsure = off(Verdict.UNSURE, 3.0)
    for first, second, ends in (
        (go, None, 1), (loose, go, 2), (unsure, go, 2), (go, unsure, 1), (None, unsure, 2),
        (None, None, 2),
    ):  # fmt: skip
        found, ranked = searched((30, first), (4, second))
        assert found.ends == ("nose-first", "tail-first")[:ends]
        assert found.tried == (30, 34)[ends - 1]
        plans = [each for each in (first, second)[:ends] if each is not None]
        assert ranked == sorted(plans, key=lambda each: each.worst, reverse=True)
    found, _ = searched((30, unsure), best_of=("flippers",), known=True)
    assert (found.ends, found.tried) == (("nose-first",), 30)


@pytest.mark.parametrize(
    ("verdict", "plan", "better"),
    [
        (Verdict.UNSURE, Verdict.GO, True),
        (Verdict.UNSURE, Verdict.UNSURE, False),
        (Verdict.NO_GO, Verdict.UNSURE, True),
        (Verdict.NO_GO, None, False),
        (None, Verdict.NO_GO, True),
    ],
)
def test_a_verdict_is_exceeded_by_a_better_one_alone(searched, verdict, plan, better):
    """Of one verdict no margin is enough."""
    one = None if plan is None else off(plan, 80.0, robust=plan is Verdict.GO)
    if plan is Verdict.UNSURE:
        one.worst = (UNSURE, True, 0, 80.0)
    found, ranked = searched((3, one), best_of=("flippers",), verdict=verdict)
    assert (found is not None) == better
    assert ranked == ([one] if better else [])


GROUSERS = ABSOLEM.model_copy(
    update={"track": ABSOLEM.track.model_copy(update={"belt": "grousers"})}
)


@pytest.fixture
def at_frictions(monkeypatch):
    """Best plans by the friction at which they are searched, and what each comes to at 0.5."""

    def of(at, comes_to, *, verdict=None, robot=GROUSERS, friction=0.5, best_of=("flippers",),
           **manner):  # fmt: skip
        searched, judged_there = [], []

        def plan(question, merit):
            one = judged(question=question)._replace(drop=merit[3])
            return SimpleNamespace(judged=one, worst=merit, robust=merit[0] == GO)

        def sturdiest(search, beaten, drives, stated):
            mu = round(search.question.friction[0], 6)
            searched.append((mu, beaten))
            assert (stated is None) == (mu != friction)
            merit = at.get((mu, search.facing), at.get(mu))
            if merit is None:
                return None
            posture = {"front": mu} if robot.flippers() else {}
            return plan(search.question.changed(posture=posture, facing=search.facing), merit)

        def judged_of(question, found):
            assert question.friction == (friction, friction)
            judged_there.append(question.posture.front)
            return judged(question=question)

        def judged_off(plan_, bar, drives):
            return plan(plan_.question, comes_to[plan_.question.posture.front])

        def on_the_whole(stated, plans, drives):
            best = plans[0].judged.question
            return module.Found(best, "findings", True, "short", drives)

        monkeypatch.setattr(module, "Search", lambda question, facing, limits: SimpleNamespace(
            question=question, facing=facing, scores=SimpleNamespace(known=range(10))
        ))  # fmt: skip
        monkeypatch.setattr(module, "sturdiest", sturdiest)
        monkeypatch.setattr(module, "judged_of", judged_of)
        monkeypatch.setattr(module, "judged_off", judged_off)
        monkeypatch.setattr(module, "_on_the_whole", on_the_whole)
        question = Question.of(robot, STAIRS, friction=friction).changed(best_of=best_of)
        drives = SimpleNamespace(judge=lambda question: "found")
        found = module.better_than(verdict, question, drives=drives, **manner)
        return found, searched, judged_there

    return of


def standing(rank, margin=0.0):
    return rank, True, 0, margin


def test_where_no_plan_is_a_go_those_of_other_frictions_are_tried(at_frictions):
    """On grousers: of 1.0, then of 0.7 and 1.3; the best counts as it is at the friction stated."""
    low, middle = standing(UNSURE, 1.0), standing(UNSURE, 2.0)
    bar = UNSURE, True, 0, math.inf
    sought = [(0.5, None), (1.0, bar), (0.7, bar), (1.3, bar)]
    go = standing(GO, 3.0)
    found, searched, tried = at_frictions({0.5: low, 1.0: go, 0.7: go}, {1.0: middle, 0.7: go})
    assert (searched, tried) == (sought[:3], [1.0, 0.7])
    assert found.question.posture.front == 0.7
    assert found.tried == 30  # of three searches
    # the one that is a GO at 1.0 alone is told for what it needs
    assert [each.posture.front for each in found.others] == [1.0]
    assert found.others[0].friction == (0.5, 0.5)
    # a GO needs no other
    found, searched, tried = at_frictions({0.5: low, 1.0: go, 0.7: go}, {1.0: go})
    assert (searched, tried, found.question.posture.front) == (sought[:2], [1.0], 1.0)
    assert found.others == ()
    found, searched, _ = at_frictions({0.5: go}, {})
    assert (searched, found.question.posture.front) == (sought[:1], 0.5)
    # none that is better there is judged here, and what is no better here is none
    found, searched, tried = at_frictions({0.5: middle, 1.0: None, 0.7: middle}, {0.7: low})
    assert (searched, tried, found.question.posture.front) == (sought, [], 0.5)
    assert found.others == ()
    found, searched, _ = at_frictions({0.5: middle, 1.0: go, 1.3: go}, {1.0: low})
    assert (found.question.posture.front, len(found.others)) == (0.5, 1)
    assert searched == sought[:3]  # what needs more than 1.0 is no help
    found, searched, _ = at_frictions({0.5: middle, 1.3: go}, {1.3: low})
    assert [each.posture.front for each in found.others] == [1.3]
    # a UNSURE at another friction, where the own plan is a NO-GO, is no GO anywhere
    bad = standing(NO_GO)
    found, _, tried = at_frictions({0.5: bad, 1.0: middle}, {1.0: low})
    assert (found.question.posture.front, found.others, tried) == (1.0, (), [1.0])


def test_of_another_friction_the_better_end_counts_and_any_plan_where_there_is_none(at_frictions):
    low, middle = standing(UNSURE, 1.0), standing(UNSURE, 2.0)
    for nose, tail, facing in ((low, middle, "tail-first"), (middle, low, "nose-first")):
        at = {0.5: standing(NO_GO), (1.0, "nose-first"): nose, (1.0, "tail-first"): tail}
        found, _, tried = at_frictions(at, {1.0: low}, best_of=("flippers", "facing"))
        assert (found.question.posture.front, found.question.facing) == (1.0, facing)
        assert tried == [1.0]
    found, searched, _ = at_frictions({1.0: low}, {1.0: low})
    assert found.question.posture.front == 1.0
    assert searched[:2] == [(0.5, None), (1.0, None)]


@pytest.mark.parametrize("friction", [1.0, 0.7, 1.3])
def test_the_friction_stated_is_no_other_one(at_frictions, friction):
    low = standing(UNSURE)
    _, searched, _ = at_frictions({friction: low}, {}, friction=friction)
    others = [mu for mu in (1.0, 0.7, 1.3) if mu != friction]
    assert [mu for mu, _ in searched] == [friction, *others]


def test_other_frictions_are_tried_on_grousers_of_postures_to_choose_where_asked_for(at_frictions):
    low = {0.5: standing(UNSURE)}
    flat = Robot.named("kenaf")
    teeth = flat.model_copy(update={"track": flat.track.model_copy(update={"belt": "grousers"})})
    for robot in (ABSOLEM, teeth):
        assert len(at_frictions(low, {}, robot=robot)[1]) == 1
    assert len(at_frictions(low, {}, other_frictions=False)[1]) == 1
    assert len(at_frictions(low, {})[1]) == 4
    # of a verdict that is to be exceeded, at other frictions too
    beaten = (UNSURE, True, 0, math.inf)
    found, searched, _ = at_frictions({}, {}, verdict=Verdict.UNSURE)
    assert found is None
    assert searched == [(mu, beaten) for mu in (0.5, 1.0, 0.7, 1.3)]
    assert len(at_frictions({}, {}, verdict=Verdict.GO)[1]) == 1
    found, _, _ = at_frictions({0.7: standing(GO)}, {0.7: standing(GO)}, verdict=Verdict.UNSURE)
    assert found.question.posture.front == 0.7


@pytest.mark.parametrize("verdict", [None, Verdict.UNSURE])
@pytest.mark.parametrize("surface", ["unknown", "known"])
def test_without_a_friction_the_best_at_one_is_taken(monkeypatch, verdict, surface):
    stated = SimpleNamespace(
        surface=None if surface == "unknown" else "known", plannable=True, facing="nose-first",
        robot=ABSOLEM,
    )  # fmt: skip
    question = SimpleNamespace(tolerance=0.0, best_of=(), changed=lambda **changes: stated)
    monkeypatch.setattr(module, "_at_unknown_friction", lambda *given: given[0])
    monkeypatch.setattr(module, "shortened", lambda asked: asked)
    monkeypatch.setattr(
        module, "Search", lambda *given: SimpleNamespace(scores=SimpleNamespace(known=()))
    )
    monkeypatch.setattr(module, "sturdiest", lambda *given: off(Verdict.GO, 1.0))
    monkeypatch.setattr(
        module, "_on_the_whole", lambda *given: module.Found("own", "its", True, "short", None)
    )
    found = module.better_than(verdict, question, (-1.0, 1.0), drives="known")
    assert (found is verdict) == (surface == "unknown")


@pytest.mark.parametrize(
    ("robust", "holds"), [(True, False), (False, True), (False, False), (True, True)]
)
def test_at_an_unknown_friction_it_holds_as_it_does_at_one_or_without(monkeypatch, robust, holds):
    question = Question.of(ABSOLEM, STAIRS)
    found = module.Found(question, "at one", robust, question, "drives")
    monkeypatch.setattr(module, "found_of", lambda *given, **named: found)
    monkeypatch.setattr(module, "holds_off_its_angles", lambda asked, drives: holds)
    monkeypatch.setattr(module, "judge", lambda asked: ("judged", asked.surface))
    told = module._at_unknown_friction(None, question, (-1.0, 1.0), "drives")
    assert told.robust == (robust or holds)
    assert told.findings == ("judged", None)
    assert told.question.surface is told.short.surface is None


@pytest.mark.parametrize("than", [Verdict.GO, Verdict.UNSURE, Verdict.NO_GO])
@pytest.mark.parametrize("comes_to", [Verdict.UNSURE, Verdict.NO_GO])
def test_without_a_friction_no_plan_is_a_go(monkeypatch, than, comes_to):
    """So it is better than a NO-GO alone, by what it comes to where none is stated."""
    question, sought = Question.of(ABSOLEM, STAIRS), []
    found = module.Found(question, "at one", True, question, "drives")
    monkeypatch.setattr(module, "found_of", lambda *given, **named: sought.append(1) or found)
    monkeypatch.setattr(module, "judge", lambda asked: "judged")
    monkeypatch.setattr(
        module, "conclude", lambda asked, findings: SimpleNamespace(verdict=comes_to)
    )
    told = module._at_unknown_friction(than, question, (-1.0, 1.0), "drives")
    assert (told is not None) == (than is Verdict.NO_GO and comes_to is Verdict.UNSURE)
    assert bool(sought) == (than is Verdict.NO_GO)


def test_where_no_plan_may_hold_the_best_at_its_angles_is_steadied(monkeypatch):
    class OfVerdict:
        def __init__(self, verdict):
            self.verdict = verdict

        def question(self, asked):
            return self.verdict

    plans = [OfVerdict(each) for each in (Verdict.UNSURE, Verdict.GO, Verdict.NO_GO)]
    each = [finalists.Candidate(plan, (GO, 0, 0.0), (GO, 0, 0.0)) for plan in plans]
    search, steadied = SimpleNamespace(may_hold=lambda plan: False, question="asked"), []
    monkeypatch.setattr(finalists, "_candidates", lambda search: each)
    monkeypatch.setattr(
        finalists, "_judged", lambda verdict, drives: SimpleNamespace(merit=(-verdict.rank,))
    )
    monkeypatch.setattr(finalists, "_to_steady", lambda search, first: steadied.append(first.merit))
    monkeypatch.setattr(finalists, "_best_of", lambda some, *given: (some or None, None))
    assert finalists.sturdiest(search, None, "drives") == each
    assert steadied == [(GO,)]


@pytest.mark.parametrize(
    ("merit", "verdict", "stated", "whole"),
    [
        ((GO, 0, 5.0), Verdict.GO, {}, True),
        ((GO, 0, 5.0), Verdict.UNSURE, {}, False),
        ((ROUGH, -1, 5.0), Verdict.GO, {}, False),
        ((NO_GO, 0, 5.0), Verdict.GO, {}, False),
        ((GO, 0, 5.0), Verdict.GO, None, False),
    ],
)
def test_what_promises_go_is_judged_on_the_whole_terrain(
    merit, verdict, stated, whole, monkeypatch
):
    monkeypatch.setattr(finalists, "judge", lambda question: "of the whole")
    monkeypatch.setattr(
        finalists, "judged_of", lambda question, found: judged(verdict, (question, found))
    )
    monkeypatch.setattr(finalists, "_judged", lambda question, drives: judged(verdict, "short"))
    question = Question.in_one_posture(ABSOLEM, STAIRS, friction=1.0)
    each = finalists.Candidate(SimpleNamespace(question=lambda asked: asked), merit, merit)
    search = SimpleNamespace(question=question)
    asked = None if stated is None else question.changed(**stated)
    found = finalists._judged_at(each, search, None, asked)
    assert found.whole is whole
    assert found.question == ((question, "of the whole") if whole else "short")


def test_of_two_plans_alike_the_second_is_not_judged(monkeypatch):
    """A tenth of a degree more than the best one's is alike; nor what promises its verdict."""
    robot = SimpleNamespace(track=SimpleNamespace(has_grousers=False))
    search = SimpleNamespace(question=SimpleNamespace(surface="known", robot=robot))

    def candidate(hope, *, failing=0):
        return finalists.Candidate("plan", (GO, 0, hope), (GO, failing, 0.0))

    def may(each, of_best=None):
        return finalists._may_be_better(search, each, (GO, True, 0, 0.0), of_best, None)

    best = candidate(0.0)
    assert not may(candidate(finalists.NEARLY), best)
    assert may(candidate(finalists.NEARLY + 1e-9 + finalists.SLACK), best)
    # nothing is judged to say that: off its angles it promises as much
    assert may(candidate(9.0), best)
    rocks = finalists.Candidate("plan", (ROUGH, -1, 9.0), (ROUGH, -1, 0.0))
    assert finalists._may_be_better(search, rocks, (UNSURE, True, -2, 0.0), None, None)


def test_any_worse_verdict_tells_that_a_plan_does_not_hold(monkeypatch):
    beaten = []

    def judged_off(plan, worse, drives):
        beaten.append(worse)
        return SimpleNamespace(robust="robust")

    monkeypatch.setattr(
        plan_off_angles, "judged_of", lambda question, found: judged(Verdict.UNSURE)
    )
    monkeypatch.setattr(plan_off_angles, "judged_off", judged_off)
    question = Question.in_one_posture(ABSOLEM, STAIRS, friction=1.0)
    plan = SimpleNamespace(robot=SimpleNamespace(middle=ABSOLEM), changed=lambda *, robot: question)
    with monkeypatch.context() as patch:
        patch.setattr(Judged, "merit", property(lambda self: (UNSURE, True, 0, 5.0)))
        assert holds_off_its_angles(plan, SimpleNamespace(judge=lambda short: None)) == "robust"
    (worse,) = beaten
    assert (NO_GO, True, 0, 1e9) <= worse < (UNSURE, False, -9, -90.0)


@pytest.mark.parametrize(
    ("each", "most"),
    [((0.3, 0.5, 0.4), 0.5), ((0.3, math.inf), 0.3), ((math.nan,), 0.0), ((), 0.0)],
)
def test_friction_off_the_angles_is_the_most_that_is_known(each, most, monkeypatch):
    question = Question.in_one_posture(ABSOLEM, STAIRS, friction=1.0)
    monkeypatch.setattr(plan_off_angles, "off_angles", lambda question: each)
    monkeypatch.setattr(Drives, "required_friction", lambda self, off: off)
    assert friction_off_its_angles(question) == most
    other = SimpleNamespace(required_friction=lambda off: 2 * off)
    found = friction_off_its_angles(question, other)
    assert found == (2 * most if most else 0.0)


def test_as_many_plans_as_asked_are_the_best_off_their_angles():
    """Of the three best the third is to be beaten, not the second."""
    hopes = [SimpleNamespace(plan=name, merit=(GO, 0, value))
             for name, value in zip("abcd", (10.0, 9.0, 8.0, 7.0), strict=True)]  # fmt: skip
    at = {"a": 9.5, "b": 8.5, "c": 1.0, "d": 6.0}
    search = SimpleNamespace(off=lambda plan: (GO, 0, at[plan]))
    assert finalists._best_off(search, hopes, 3) == ["a", "b", "d"]


def test_what_is_no_failure_may_still_be_less_than_go(monkeypatch):
    """It is passed over only where the worst is a UNSURE already."""
    asked = []
    drives = SimpleNamespace(
        is_no_failure=lambda k: True, rank=lambda k: (asked.append(k), UNSURE)[1]
    )
    monkeypatch.setattr(plan_off_angles, "off_angles", lambda question: range(3))
    question = Question.in_one_posture(ABSOLEM, STAIRS, friction=1.0)
    plan = judged(question=question)
    found = judged_off(plan, None, drives)
    assert (found.worst[0], asked) == (UNSURE, [0])


@pytest.mark.parametrize("model", ["contact", "physics"])
def test_a_model_of_one_posture_takes_the_best_word(model, monkeypatch):
    question = Question.in_one_posture(ABSOLEM, STAIRS, friction=1.0).changed(model=model)
    margins = iter((0.1, 0.3, 0.2, 0.05))

    def judged_each(asked, found):
        return Judged(asked, found, conclusion(Verdict.GO, next(margins)), 0.0, True)

    monkeypatch.setattr(module, "judged_of", judged_each)
    monkeypatch.setattr(module, "words", lambda robot: [Posture(), Posture(front="flat")])
    monkeypatch.setattr(module, "judge", lambda asked: "fine")
    drives = SimpleNamespace(judge=lambda asked: "coarse")
    found = module._fixed(question, ("nose-first", "tail-first"), drives)
    assert (found.question.facing, found.question.posture) == ("nose-first", Posture(front="flat"))
    assert found.findings == ("fine" if model == "contact" else "coarse")
    assert (found.robust, found.tried) == (True, 4)
    assert found.ends == ("nose-first", "tail-first")
