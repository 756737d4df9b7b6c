"""Figures of an answer that the findings alone decide, on findings made by hand."""

import math

import numpy as np
import pytest

from kaidan import Profile, Question, Robot, Stairs
from kaidan.assessment import judged
from kaidan.models.findings import Finding, Findings
from kaidan.modes import ENERGY, FALL_DOWNHILL, FALL_UPHILL, SLIDES_DOWN, TIP_DOWNHILL

G = 9.80665
KENAF = Robot.model_validate(Robot.named("kenaf").model_dump() | {"mass": 20.0})
ANGLE = math.radians(50)
FLIGHT = Stairs.inclined(angle=ANGLE, nosing_spacing=0.150)
RAMP = Profile.of_points([(-3, 0), (0, 0), (2, 1), (5, 1)])


def finding(mode, worst, best=None, **others):
    worst = np.atleast_1d(np.asarray(worst, dtype=float))
    best = worst if best is None else np.broadcast_to(np.asarray(best, dtype=float), worst.shape)
    return Finding(mode=mode, worst=worst, best=best, model="contact", **others)


def answer(*each, terrain=FLIGHT, robot=KENAF, **manner):
    question = Question.in_one_posture(robot, terrain, **({"friction": 2.0} | manner))
    return judged(question, Findings(model="contact", each=each), advice=False)


@pytest.mark.parametrize(
    ("margin", "slope"),
    [  # beyond 1.5 rad the tangent is no longer told
        (0.1, ANGLE + 0.1),
        (-0.2, ANGLE - 0.2),
        (math.inf, 1.5),
        (1.0, 1.5),
        (-math.pi / 2 - ANGLE, -1.5),
        (-3.0, -1.5),
    ],
)
def test_force_that_uses_the_margin_up(margin, slope):
    """By hand: (m g sin(beta) + F)/(m g cos(beta)) = tan(beta + margin) on a slope beta."""
    by_hand = 20 * G * (math.tan(slope) * math.cos(ANGLE) - math.sin(ANGLE))
    found = answer(finding(TIP_DOWNHILL, margin))
    assert found.margin_force_N == pytest.approx(by_hand, rel=1e-12)


def test_force_on_what_is_no_flight():
    found = answer(finding(TIP_DOWNHILL, 0.1), terrain=RAMP)
    assert found.margin_force_N == pytest.approx(20 * G * math.tan(0.1), rel=1e-12)
    assert found.angle_deg is found.nosing_spacing_m is None


def test_no_force_without_a_mass_or_a_margin():
    assert answer(finding(TIP_DOWNHILL, 0.1), robot="kenaf").margin_force_N is None
    assert answer(finding(TIP_DOWNHILL, math.nan)).margin_force_N is None


def test_figures_of_a_flight():
    found = answer(finding(TIP_DOWNHILL, 0.1))
    assert found.angle_deg == pytest.approx(50)
    assert found.nosing_spacing_m == pytest.approx(0.150)


def test_a_finding_as_people_read_it():
    shown = answer(finding(TIP_DOWNHILL, -0.1, 0.2), finding(ENERGY, 0.0)).findings
    tip, energy = shown["tip_downhill"], shown["energy"]
    assert (tip.margin, tip.margin_best) == pytest.approx((math.degrees(-0.1), math.degrees(0.2)))
    assert (tip.holds, tip.probability) == (False, None)
    assert (energy.margin, energy.holds) == (0.0, False)  # zero is no margin
    unknown = answer(finding(SLIDES_DOWN, math.nan)).findings["slides_down"]
    assert (unknown.margin, unknown.holds, unknown.probability) == (None, None, None)


def test_probability_and_interval_by_hand():
    """1000 samples from -0.02 up in steps of 1 mrad: 21 are zero or less, 25 and 975 are beyond."""
    worst = (np.arange(1000) - 20) * 1e-3
    found = answer(finding(TIP_DOWNHILL, worst, 0.5))
    assert found.failure_probability == found.findings["tip_downhill"].probability == 0.021
    expected = [math.degrees(5e-3), math.degrees(0.955)]
    assert found.margin_interval_deg == pytest.approx(expected)


def test_with_a_sample_that_has_no_margin_there_is_no_interval():
    worst = np.where(np.arange(1000) < 1, np.nan, 0.2)
    found = answer(finding(TIP_DOWNHILL, worst))
    assert found.margin_interval_deg is None
    shown = found.findings["tip_downhill"]
    assert (shown.holds, shown.probability) == (True, 0.0)
    assert found.failure_probability == 0.001  # what is not known is not safe
    low = np.where(np.arange(1000) < 30, -np.inf, 0.2)  # no slope holds
    assert answer(finding(TIP_DOWNHILL, low)).margin_interval_deg is None


@pytest.mark.parametrize(
    ("each", "end"),
    [
        ((finding(FALL_DOWNHILL, -0.1),), "tail"),
        ((finding(FALL_UPHILL, -0.1),), "nose"),
        ((finding(FALL_DOWNHILL, -0.1, 0.1),), None),  # may fall
        ((finding(TIP_DOWNHILL, 0.3), finding(SLIDES_DOWN, -0.1)), None),  # slides, and falls not
    ],
)
def test_the_end_that_it_falls_over(each, end):
    assert answer(*each).falls_over == end
    other = {"tail": "nose", "nose": "tail", None: None}[end]
    assert answer(*each, direction="down").falls_over == other
    assert answer(*each, facing="tail-first").falls_over == other


def test_without_advice_nothing_is_looked_for_that_would_help(monkeypatch):
    monkeypatch.setattr("kaidan.assessment.advice.what_would_help", lambda *_, **__: 1 / 0)
    assert answer(finding(SLIDES_DOWN, -0.1)).what_would_help == ()
