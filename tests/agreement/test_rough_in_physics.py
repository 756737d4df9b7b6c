"""No ROUGH that falls: questions of the catalogue that are ROUGH, driven in the physics.

A robot may slide down the last risers as it lands at the foot, where its answer says so.
"""

import random
from itertools import product

import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from amounts import fast_and_slow
from kaidan import Robot, assess
from kaidan.catalog import names
from kaidan.models import judge
from kaidan.models.dynamic import failure_of
from kaidan.modes import SLIDES_DOWN, SLIDES_UP, STUCK, Phase


def rough_answers(count, seed):
    """Answers of one posture that are ROUGH."""
    manners = list(
        product(
            sorted(set(names("robots")) - set(names("unweighed"))), names("stairs"),
            ("up", "down"), ("nose-first", "tail-first"), ("flat", "stowed"), (0.9, 1.5),
        )
    )  # fmt: skip
    random.Random(seed).shuffle(manners)
    for robot, stairs, direction, facing, flippers, friction in manners:
        asked = {"direction": direction, "facing": facing, "friction": friction}
        if Robot.named(robot).flippers():
            asked["flippers"] = flippers
        answer = assess(robot, stairs, **asked)
        if answer.verdict == "rough":
            yield answer
            count -= 1
        if not count:
            return


def slides_as_it_lands(answer):
    """Whether the answer tells of the slide down the last risers."""
    land = next(each for each in answer.contact.phases if each.phase == Phase.LAND)
    return land.slides_below is not None and land.slides_below > answer.friction[0]


@pytest.mark.parametrize("count", fast_and_slow(2, 60))
def test_what_is_rough_does_not_fall(count):
    driven = 0
    for answer in rough_answers(count, seed=31):
        (trials,) = judge(answer.question.changed(model="physics")).basis
        failed = {mode for trial in trials if (mode := failure_of(trial)) is not None}
        if not slides_as_it_lands(answer):
            assert not failed, answer.question.to_json()
        assert failed <= {SLIDES_DOWN, SLIDES_UP, STUCK}, answer.question.to_json()
        driven += 1
    assert driven == count
