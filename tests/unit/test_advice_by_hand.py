"""What counts as help and what is tried, on conclusions made by hand."""

import math

import numpy as np
import pytest

from kaidan import Payload, Question, Robot, Stairs
from kaidan.assessment.advice import (
    LARGEST_FRICTION,
    WORTH_TELLING,
    _centroid_moved,
    _is_better,
    _more_friction,
    _slower,
    _tips_over,
)
from kaidan.assessment.verdict import Conclusion, conclude
from kaidan.models.findings import Finding, Findings
from kaidan.modes import SLIDES_DOWN, TIP_DOWNHILL, TIP_SIDEWAYS, TIP_UPHILL, Verdict

G = 9.80665
KENAF = Question.in_one_posture("kenaf", Stairs(rise=0.1, going=0.15), friction=1.0)


def concluded(verdict, margin=0.1):
    return Conclusion(verdict, "", None, None, margin, margin, np.array([margin]), ())


@pytest.mark.parametrize(
    ("then", "now", "better"),
    [
        (Verdict.GO, Verdict.CAUTION, True),
        (Verdict.CAUTION, Verdict.NO_GO, True),
        (Verdict.NO_GO, Verdict.CAUTION, False),
        (Verdict.OUTSIDE_MODEL, Verdict.NO_GO, False),
        (Verdict.NO_GO, Verdict.OUTSIDE_MODEL, False),  # a refusal known is no help
        (Verdict.CAUTION, Verdict.OUTSIDE_MODEL, True),
    ],
)
def test_a_better_verdict_is_help(then, now, better):
    assert _is_better(concluded(then), concluded(now)) is better


def test_of_one_verdict_a_margin_worth_telling_is_help():
    now = concluded(Verdict.CAUTION, 0.1)
    for gain, better in ((2 * WORTH_TELLING, True), (0.5 * WORTH_TELLING, False), (0.0, False)):
        assert _is_better(concluded(Verdict.CAUTION, 0.1 + gain), now) is better
    assert not _is_better(concluded(Verdict.CAUTION, math.nan), now)


@pytest.mark.parametrize(
    ("energy", "speed"),
    [
        (5e-4, 0.09),  # 0.0990 m/s lift by 0.5 mm: 0.09 is below it
        (0.03**2 / (2 * G) * 1.01, 0.03),
        (0.015**2 / (2 * G), 0.01),
        (0.009**2 / (2 * G), None),  # slower than anybody is advised
        (0.0, None),
        (-1e-3, None),
    ],
)
def test_a_slower_speed_has_less_kinetic_energy_than_is_left(energy, speed):
    found = [each.question.speed for each in _slower(KENAF, energy)]
    assert found == ([] if speed is None else [pytest.approx(speed)])


@pytest.mark.parametrize(
    ("required", "enough"),
    [
        (0.5, 0.51),
        (0.505, 0.52),
        (LARGEST_FRICTION - 0.01, LARGEST_FRICTION),
        (LARGEST_FRICTION - 0.005, None),
        (math.inf, None),
        (math.nan, None),
    ],
)
def test_more_friction_is_a_hundredth_more_than_required(required, enough):
    needs = Findings(model="by hand", required_friction=required)
    found = [each.question.friction for each in _more_friction(KENAF, needs)]
    assert found == ([] if enough is None else [pytest.approx((enough, enough))])


def finding(mode, margin):
    return Finding.certain(mode, margin, model="by hand")


@pytest.mark.parametrize(
    ("margins", "end"),
    [
        ({TIP_DOWNHILL: 0.1, TIP_UPHILL: 0.2}, TIP_DOWNHILL),
        ({TIP_DOWNHILL: 0.2, TIP_UPHILL: 0.1}, TIP_UPHILL),
        ({TIP_DOWNHILL: -0.1, TIP_UPHILL: -0.2}, TIP_UPHILL),
        ({TIP_DOWNHILL: -0.1, TIP_UPHILL: 0.1, TIP_SIDEWAYS: -0.2}, TIP_DOWNHILL),
        ({TIP_DOWNHILL: 0.3, TIP_SIDEWAYS: -0.2}, TIP_DOWNHILL),  # a shift along it is no help
        ({TIP_DOWNHILL: math.nan, TIP_UPHILL: 0.1}, TIP_UPHILL),
        ({TIP_DOWNHILL: 0.1, SLIDES_DOWN: -0.1}, TIP_DOWNHILL),
        ({SLIDES_DOWN: -0.1}, None),
        ({TIP_DOWNHILL: math.nan}, None),
    ],
)
def test_the_end_over_which_it_tips(margins, end):
    found = Findings(
        model="by hand", each=tuple(finding(mode, margin) for mode, margin in margins.items())
    )
    assert _tips_over(KENAF, found, conclude(KENAF, found)) is end


@pytest.mark.parametrize(("load", "share"), [(None, 1.0), (0.5, 20.5 / 20), (2.0, 22 / 20)])
def test_a_centroid_that_is_moved_moves_that_of_robot_and_payload(load, share):
    """By hand: a shift of all is a longer one of the robot, whose payload stays."""
    flight = Stairs.inclined(angle=math.radians(62), nosing_spacing=0.150)
    robot = Robot.model_validate(Robot.named("kenaf").model_dump() | {"mass": 20.0})
    stance = robot.com_from_front, robot.com_height
    payload = [] if load is None else [Payload(mass=load, from_front=stance[0], height=stance[1])]
    question = Question.in_one_posture(robot, flight, friction=3.0, payload=payload)
    found = Findings(model="by hand", each=(finding(TIP_DOWNHILL, -0.1),))
    (one,) = _centroid_moved(question, found, conclude(question, found))
    moved = robot.com_from_front - one.question.robot.com_from_front
    shift = question.stance.com_from_front - one.question.stance.com_from_front
    assert moved == pytest.approx(shift * share)
    assert round(1e3 * shift, 6) == round(1e3 * shift)  # whole millimetres
    assert f"{1e3 * shift:.0f} mm towards the front" in one.change
    if load is not None:
        assert f"{1e3 * shift * (20 + load) / load:.0f} mm" in one.change
