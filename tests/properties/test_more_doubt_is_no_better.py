"""More doubt is no better: of what holds, doubling a doubt raises neither verdict nor P(GO).

Of what holds in fewer than half of the draws no such thing is true: the more an input may differ,
the likelier is one that helps.
"""

import math

import numpy as np
import pytest

from kaidan import Question, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.models.contact_model import judge
from kaidan.modes import FALL_DOWNHILL, Verdict

SIGMA = {
    "com_from_front": 4e-3,
    "com_height": 3e-3,
    "angle": 0.01,
    "nosing_spacing": 2e-3,
    "rise": 1.5e-3,
    "going": 1.5e-3,
    "friction": 0.1,
}
ONE_DRAW = 1 / 2048
"""Margins bend: where one doubt is doubled beside others, a draw at the edge may just hold."""


def judged(flight, manner, sigma):
    question = Question.in_one_posture("kenaf", flight, uncertainty=sigma, risk=0.2, **manner)
    found = judge(question)
    fails = np.logical_or.reduce(np.broadcast_arrays(*(each.fails() for each in found.each)))
    return conclude(question, found).verdict, 1 - float(fails.mean())


def question_that_holds(rng):
    while True:
        flight = Stairs.inclined(
            angle=math.radians(rng.uniform(35, 52)), nosing_spacing=rng.uniform(0.13, 0.18), steps=9
        )
        manner = {
            "friction": float(rng.uniform(1.0, 2.0)),
            "theta_d": (0, 0),
            "theta_M": (0, 0),
            "speed": 0.02,
        }
        if judged(flight, manner, {})[0] is Verdict.GO:
            return flight, manner


@pytest.mark.parametrize("seed", range(6))
def test_doubling_a_doubt_never_makes_it_better(seed):
    rng = np.random.default_rng(seed)
    flight, manner = question_that_holds(rng)
    sigma = {name: one * float(rng.choice([0.0, 0.3, 1.0])) for name, one in SIGMA.items()}
    verdict, p = judged(flight, manner, sigma)
    doubled = [sigma | {name: 2 * one} for name, one in sigma.items() if one]
    for more in (*doubled, {name: 2 * one for name, one in sigma.items()}):
        then, less = judged(flight, manner, more)
        assert verdict is Verdict.GO or then is not Verdict.GO
        if p >= 0.5:
            assert less <= p + ONE_DRAW


FORETOLD = 0.01
"""A sample's tilt to the fall is that of its own drive near the reserve alone."""


def holds_though_it_rocks(flight, manner, sigma):
    """Whether it arrives, and share of the draws in which it is ROUGH at worst."""
    question = Question.in_one_posture("kenaf", flight, uncertainty=sigma, risk=0.2, **manner)
    found = judge(question)
    assert found.of(FALL_DOWNHILL) is not None
    ranks = np.maximum.reduce(np.broadcast_arrays(*(each.verdicts() for each in found.each)))
    arrives = conclude(question, found).verdict in (Verdict.GO, Verdict.ROUGH)
    return arrives, float((ranks <= Verdict.ROUGH.rank).mean())


def check_rocking(seed, reserves):
    rng = np.random.default_rng(seed)
    flight = Stairs.inclined(
        angle=math.radians(rng.uniform(43, 45)), nosing_spacing=rng.uniform(0.195, 0.205), steps=8
    )
    sigma = {name: SIGMA[name] for name in ("com_from_front", "com_height", "rise", "going")}
    for reserve in reserves:
        manner = {"friction": 2.0, "speed": 0.02, "fall_reserve": math.radians(reserve)}
        arrives, p = holds_though_it_rocks(flight, manner, sigma)
        doubled = [sigma | {name: 2 * one} for name, one in sigma.items()]
        for more in (*doubled, {name: 2 * one for name, one in sigma.items()}):
            then, less = holds_though_it_rocks(flight, manner, more)
            assert arrives or not then
            if p >= 0.5:
                assert less <= p + FORETOLD


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_doubling_a_doubt_never_makes_a_robot_that_rocks_better(seed):
    check_rocking(seed, (5.0, 7.0, 8.0, 9.0))
