"""Findings over the range of a centroid, of places judged by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs, assessment
from kaidan.assessment import plan_off_angles, plan_search
from kaidan.assessment import unweighed as module
from kaidan.errors import InputError
from kaidan.models import unweighed as module_of_range
from kaidan.models.findings import Finding, Findings
from kaidan.models.sentences import unweighed as text
from kaidan.models.unweighed import HEIGHTS, PLACES, Placed, judge_range, places
from kaidan.modes import (
    ENERGY,
    FAILS,
    IMPACT,
    MOMENTUM,
    OPEN,
    POSTURE_TOLERANCE,
    SLIDES_DOWN,
    STUCK,
    TIP_DOWNHILL,
    TIP_UPHILL,
    UNWEIGHED,
    Phase,
    Verdict,
)

SHEET = {
    "name": "r", "track": {"flat_length": 0.8, "front_radius": 0.1, "rear_radius": 0.1},
    "com_range": {"from_front": (0.24, 0.48), "height": (0.1, 0.2)},
}  # fmt: skip
QUESTION = Question.in_one_posture(
    Robot.model_validate(SHEET), Stairs(rise=0.18, going=0.28), friction=1.0
)


def finding(mode, worst, best=None, **more):
    worst = np.atleast_1d(np.asarray(worst, dtype=float))
    best = worst if best is None else np.atleast_1d(np.asarray(best, dtype=float))
    return Finding(mode=mode, worst=worst, best=best, model="by hand", **more)


def judged(*each, **more):
    return Findings(model="by hand", each=each, **more)


def over(judge):
    """Findings of the range, of a judge by place along and height."""

    def of(question):
        return judge(question.robot.com_from_front, question.robot.com_height)

    found = judge_range(QUESTION, of)
    return found, {one.mode: one for one in found.each}


def test_places_of_a_range():
    assert places((0.1, 0.3), 3) == pytest.approx([0.1, 0.2, 0.3])
    assert places((0.2, 0.2), 5) == [0.2]


def test_the_worst_place_decides_the_worst_case_and_the_best_place_the_best_one():
    """Downhill the margin falls with C_L and C_N, uphill it grows with C_L."""

    def judge(along, height):
        down = [0.5 - along - height, 0.4 - along - height]
        tips = finding(TIP_DOWNHILL, down, [0.9 - along, 0.9 - along], phase=Phase.LAND,
                       step=round(100 * along))  # fmt: skip
        up = finding(TIP_UPHILL, along - 0.3, along - 0.2)
        return judged(tips, up, required_friction=along + height, notes=(f"{along:.2f}",))

    found, modes = over(judge)
    down = modes[TIP_DOWNHILL]
    assert down.worst == pytest.approx([0.5 - 0.68, 0.4 - 0.68])
    assert (down.phase, down.step) == (Phase.LAND, 48)
    # of what does not fail the place with the largest of the least margins: 0.9 - C_L = C_L - 0.2
    best = max(places((0.24, 0.48), PLACES), key=lambda along: min(0.9 - along, along - 0.2))
    assert down.best == pytest.approx([0.9 - best] * 2)
    assert modes[TIP_UPHILL].worst == pytest.approx([0.24 - 0.3])
    assert modes[TIP_UPHILL].best == pytest.approx([best - 0.2])
    assert found.required_friction == pytest.approx(0.68)
    assert found.notes == (text.OF_THE_MIDDLE, "0.36")  # the figures are of the middle
    assert len(found.basis) == HEIGHTS * PLACES
    nobody = modes[UNWEIGHED]
    assert (nobody.worst.tolist(), nobody.best.tolist()) == ([-math.inf], [math.inf])
    assert nobody.if_fails is OPEN


def test_the_best_place_is_where_it_arrives_then_where_nothing_fails_then_by_its_margin():
    places_of = places((0.24, 0.48), PLACES)
    low, high = places_of[0], places_of[-1]

    def best(*, low_fails=(), high_fails=(), margins=(0.1, 0.2), by=-0.1):
        def judge(along, height):
            margin, fails = (-1.0, (STUCK,))
            if along in (low, high):
                k = int(along == high)
                margin, fails = margins[k], (low_fails, high_fails)[k]
            tips = finding(TIP_DOWNHILL, margin, step=round(100 * along))
            each = [finding(mode, by) for mode in fails]
            return judged(tips, *each)

        return over(judge)[1][TIP_DOWNHILL].best.tolist()[0]

    assert best() == 0.2
    assert best(margins=(0.3, 0.2)) == 0.3
    assert best(high_fails=(MOMENTUM,)) == 0.1
    assert best(low_fails=(STUCK,), high_fails=(MOMENTUM,)) == 0.2
    assert best(low_fails=(MOMENTUM,), high_fails=(STUCK,)) == 0.1
    assert best(low_fails=(MOMENTUM,), high_fails=(MOMENTUM,)) == 0.2
    assert best(margins=(0.0, -0.1)) == 0.0  # zero fails, by less
    assert best(low_fails=(STUCK,), margins=(0.3, 0.2), by=0.0) == 0.2
    assert best(margins=(0.3, math.nan)) == 0.3  # what is not known is the least
    assert best(low_fails=(MOMENTUM,), margins=(0.3, math.nan)) == pytest.approx(
        math.nan, nan_ok=True
    )


def test_what_only_some_places_know():
    """A failure mode that the best place has not is no failure there; what is not known is not
    the worst.
    """
    first, *_, last = places((0.24, 0.48), PLACES)

    def judge(along, height):
        tips = finding(TIP_DOWNHILL, 0.5 if along == last else 0.1, instead=FAILS)
        low = [-0.01, math.nan] if along == last else [math.nan, math.nan]
        energy = finding(ENERGY, low, step=round(100 * along))
        impact = [finding(IMPACT, -0.2)] if along == first else []
        return judged(tips, energy, *impact)

    _, modes = over(judge)
    assert (modes[IMPACT].best.tolist(), modes[IMPACT].instead) == ([math.inf], None)
    assert (modes[ENERGY].worst[0], modes[ENERGY].step) == (-0.01, 48)
    assert modes[TIP_DOWNHILL].instead is FAILS
    assert SLIDES_DOWN not in modes


def test_sliding_is_told_where_most_friction_is_required():
    first, *_ = places((0.24, 0.48), PLACES)

    def judge(along, height):
        most = along == first
        slides = finding(SLIDES_DOWN, 0.3 if most else 0.2, step=round(100 * along))
        return judged(slides, required_friction=0.9 if most else 0.5)

    found, modes = over(judge)
    assert found.required_friction == 0.9
    assert (modes[SLIDES_DOWN].worst.tolist(), modes[SLIDES_DOWN].step) == ([0.2], 24)


def test_places_without_an_answer():
    def judge(along, height):
        outside = "too short" if along < 0.3 else ""
        return judged(finding(TIP_DOWNHILL, along), outside=outside, required_friction=along)

    found, modes = over(judge)
    assert modes[TIP_DOWNHILL].worst[0] >= 0.3
    assert found.notes == (text.OF_THE_MIDDLE, text.OUTSIDE_SOMEWHERE)
    assert found.outside == ""
    # of no place at all it says why of the first
    found, modes = over(lambda along, height: judged(outside=f"not at {along}, {height}"))
    assert (found.outside, modes) == ("not at 0.24, 0.1", {})
    assert len(found.basis) == HEIGHTS * PLACES


@pytest.mark.parametrize("off", [-0.03, 0.03])
def test_of_two_places_alike_the_nearer_height_is_in_the_middle(off):
    """The middle of the range lies 0.36 m behind the front, 0.15 m high."""

    def away(along, height):
        return module_of_range._off_the_middle(Placed(along, height, None, None), QUESTION)

    assert away(0.36, 0.15) == pytest.approx(0.0, abs=1e-12)
    assert away(0.36, 0.15 + off) > away(0.36, 0.15 + 0.9 * off) > 0.0
    # along it first, by any height
    assert away(0.36 + off, 0.15) > away(0.36, 0.15 + off)


def test_places_that_the_robot_cannot_have():
    def judge(along, height):
        if along < 0.3 or along > limit:
            raise InputError("no such place")
        return judged(finding(TIP_DOWNHILL, along))

    limit = 1.0
    found, modes = over(judge)
    assert modes[TIP_DOWNHILL].worst[0] >= 0.3
    assert len(found.basis) < HEIGHTS * PLACES
    assert text.OUTSIDE_SOMEWHERE not in found.notes
    limit = 0.0
    with pytest.raises(InputError, match="no such place"):
        over(judge)


# where the verdict changes


@pytest.fixture
def stretches(monkeypatch):
    """Stretches of one height, from places along it and what a place has as its verdict."""

    def of(verdict_at, *rows, refused=()):
        def placed(question, along, height, judge):
            if any(low < along < high for low, high in refused):
                raise InputError("no such place")
            return Placed(along, height, (along, height), None)

        def concluded(place, found):
            verdict = verdict_at(*place)
            return SimpleNamespace(verdict=verdict, governs=f"{verdict.value} at {place[0]:g}")

        monkeypatch.setattr(module, "at", placed)
        monkeypatch.setattr(module, "conclude", concluded)
        basis = [Placed(*each, each, None) for each in rows]
        shown = module.stretches(QUESTION, judged(basis=basis))
        assert (shown.from_front_m, shown.height_m) == ((0.24, 0.48), (0.1, 0.2))
        return [(e.height_m, e.from_m, e.to_m, e.verdict, e.governs) for e in shown.stretches]

    return of


def test_the_verdict_changes_where_it_is_halved_out(stretches):
    def verdict(along, height):
        if along < 0.3131:
            return Verdict.NO_GO
        return Verdict.UNSURE if height > 0.15 or along < 0.4242 else Verdict.GO

    rows = [(along, height) for height in (0.1, 0.2) for along in (0.24, 0.30, 0.36, 0.42, 0.48)]
    first, second, third, fourth, fifth = stretches(verdict, *rows)
    near = module.FINE
    assert first == (0.1, 0.24, pytest.approx(0.3131, abs=near), "no-go", "no-go at 0.24")
    assert second == (
        0.1, first[2], pytest.approx(0.4242, abs=near), "unsure", "unsure at 0.36",
    )  # fmt: skip
    assert third == (0.1, second[2], 0.48, "go", "go at 0.48")
    assert fourth == (0.2, 0.24, first[2], "no-go", "no-go at 0.24")
    assert fifth == (0.2, first[2], 0.48, "unsure", "unsure at 0.36")


def test_one_verdict_all_along_is_one_stretch(stretches):
    rows = [(0.24, 0.1), (0.36, 0.1), (0.48, 0.1)]
    assert stretches(lambda *_: Verdict.GO, *rows) == [(0.1, 0.24, 0.48, "go", "go at 0.24")]
    assert stretches(lambda *_: Verdict.GO, rows[0])[0][1:3] == (0.24, 0.24)


def test_where_the_robot_cannot_have_the_place_between(stretches):
    rows = [(0.24, 0.1), (0.48, 0.1)]
    first, second = stretches(
        lambda along, height: Verdict.GO if along < 0.3 else Verdict.UNSURE, *rows,
        refused=[(0.25, 0.47)],
    )  # fmt: skip
    assert (first[2], second[1]) == (0.36, 0.36)


# the plan of such a robot


def test_a_plan_is_that_of_the_middle_judged_all_over_the_range(monkeypatch):
    """And found within the limits stated; that of a weighed robot is judged already."""
    plans, judged_ = [], []

    def found_of(question, limits):
        plans.append((question.robot.com_range, limits))
        found = question.changed(facing="tail-first", best_of=())
        return SimpleNamespace(question=found, findings="of the search", robust=True)

    def judge(question):
        judged_.append(question.robot)
        return "judged"

    monkeypatch.setattr(plan_search, "found_of", found_of)
    monkeypatch.setattr(assessment, "judge", judge)
    asked = QUESTION.changed(best_of=("facing",))
    planned, found, search = assessment.with_plan(asked)
    assert (planned.facing, planned.robot, found) == ("tail-first", asked.robot, "judged")
    assert (plans, judged_) == ([(None, plan_search.LIMITS)], [asked.robot])
    assert search.question.robot == asked.robot.middle
    weighed = asked.changed(robot=asked.robot.middle)
    planned, found, _ = assessment.with_plan(weighed, limits=(-0.1, 0.2))
    assert (planned.facing, found, len(judged_)) == ("tail-first", "of the search", 1)
    assert plans[1] == (None, (-0.1, 0.2))
    assert assessment.found_plan(asked, limits=(-0.3, 0.2))[0].facing == "tail-first"
    assert plans[2] == (None, (-0.3, 0.2))
    assert assessment.with_plan(QUESTION) == (QUESTION, "judged", None)


def test_what_does_not_hold_off_its_angles_is_a_finding_more(monkeypatch):
    found, asked = judged(finding(TIP_DOWNHILL, 0.1)), []

    def holds(question):
        asked.append(question)
        return len(asked) == 1

    monkeypatch.setattr(plan_off_angles, "holds_off_its_angles", holds)
    loose = QUESTION.changed(flipper_tolerance=0.05)
    assert assessment.off_plan(QUESTION.changed(flipper_tolerance=0.0), found) is found
    assert assessment.off_plan(loose, found) is found
    one, off = assessment.off_plan(loose, found).each
    assert one is found.each[0]
    assert (off.mode, off.worst.tolist(), off.if_fails) == (POSTURE_TOLERANCE, [-math.inf], OPEN)
    for robust, count in ((True, 1), (False, 2)):
        search = SimpleNamespace(robust=robust)
        assert len(assessment.off_plan(loose, found, search).each) == count
    assert len(asked) == 2
