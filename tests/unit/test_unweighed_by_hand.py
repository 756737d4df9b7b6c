"""Findings over the range of a centroid, of places judged by hand."""

import math

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs
from kaidan.errors import InputError
from kaidan.models.findings import Finding, Findings
from kaidan.models.unweighed import HEIGHTS, PLACES, judge_range, places
from kaidan.modes import (
    ENERGY,
    IMPACT,
    MOMENTUM,
    SLIDES_DOWN,
    TIP_DOWNHILL,
    TIP_UPHILL,
    UNWEIGHED,
    Phase,
    Verdict,
)
from kaidan.text import unweighed as text

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
        up = finding(TIP_UPHILL, along - 0.3, along - 0.2, failing=Verdict.CAUTION)
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
    assert nobody.failing is Verdict.CAUTION


def test_the_best_place_is_where_it_arrives_then_where_nothing_fails_then_by_its_margin():
    places_of = places((0.24, 0.48), PLACES)
    low, high = places_of[0], places_of[-1]

    def best(*, low_fails=(), high_fails=(), margins=(0.1, 0.2)):
        def judge(along, height):
            margin, fails = (-1.0, (TIP_UPHILL,))
            if along in (low, high):
                k = int(along == high)
                margin, fails = margins[k], (low_fails, high_fails)[k]
            tips = finding(TIP_DOWNHILL, margin, step=round(100 * along))
            failing = {MOMENTUM: Verdict.CAUTION}
            each = [finding(mode, -0.1, failing=failing.get(mode, Verdict.NO_GO)) for mode in fails]
            return judged(tips, *each)

        return over(judge)[1][TIP_DOWNHILL].best.tolist()[0]

    assert best() == 0.2
    assert best(margins=(0.3, 0.2)) == 0.3
    assert best(high_fails=(MOMENTUM,)) == 0.1
    assert best(low_fails=(IMPACT,), high_fails=(MOMENTUM,)) == 0.2
    assert best(low_fails=(MOMENTUM,), high_fails=(IMPACT,)) == 0.1
    assert best(low_fails=(MOMENTUM,), high_fails=(MOMENTUM,)) == 0.2
    assert best(margins=(0.0, -0.1)) == 0.0  # zero fails, by less
    assert best(low_fails=(MOMENTUM,), margins=(0.3, math.nan)) == pytest.approx(
        math.nan, nan_ok=True
    )


def test_what_only_some_places_know():
    """A failure mode that the best place has not is no failure there; what is not known is not
    the worst.
    """
    first, *_, last = places((0.24, 0.48), PLACES)

    def judge(along, height):
        tips = finding(TIP_DOWNHILL, 0.5 if along == last else 0.1, failing=Verdict.CAUTION)
        energy = finding(ENERGY, -0.01 if along == first else math.nan, step=round(100 * along))
        impact = [finding(IMPACT, -0.2)] if along == first else []
        return judged(tips, energy, *impact)

    _, modes = over(judge)
    assert (modes[IMPACT].best.tolist(), modes[IMPACT].failing) == ([math.inf], Verdict.CAUTION)
    assert (modes[ENERGY].worst.tolist(), modes[ENERGY].step) == ([-0.01], 24)
    assert modes[TIP_DOWNHILL].failing is Verdict.CAUTION
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
    found, modes = over(lambda along, height: judged(outside="nowhere"))
    assert (found.outside, modes) == ("nowhere", {})
    assert len(found.basis) == HEIGHTS * PLACES


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
