"""Inputs that are in doubt, and limits of the stairs that a robot is beyond, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Profile, Question, Robot, Stairs
from kaidan.allowance import Allowance
from kaidan.assessment.limits import limits
from kaidan.assessment.uncertain_inputs import Doubt, doubts_of, without
from kaidan.mechanics.transitions import largest_step_height

FLIGHT = Stairs(rise=0.174, going=0.27, steps=8)
KENAF = Robot.named("kenaf")
SURE = {"friction": 0.9, "theta_d": 0.0, "theta_M": 0.0}


def asked(robot=KENAF, terrain=FLIGHT, **given):
    return Question.in_one_posture(robot, terrain, **(SURE | given))


def sheet(**sigmas):
    return KENAF.model_copy(update={"uncertainty": KENAF.uncertainty.model_copy(update=sigmas)})


def test_doubts_are_standard_uncertainties_and_the_width_of_ranges():
    """Of an even distribution from low to high: a twelfth of the square of its width."""
    none = dict.fromkeys(type(KENAF.uncertainty).model_fields, 0.0)
    exact = sheet(**none)
    assert doubts_of(asked(exact)) == ()
    some = asked(
        sheet(**none | {"com_height": 0.004}), friction=(0.5, 0.9), theta_d=(0.01, 0.04),
        theta_M=(0.02, 0.03),
    )  # fmt: skip
    height, friction, d, m = doubts_of(some)
    assert height == Doubt(height.name, 0.004, None)
    assert height.group == "centroid"
    assert friction == Doubt("friction", pytest.approx(0.4 / math.sqrt(12)), (0.5, 0.9))
    assert d == Doubt("theta_d", pytest.approx(0.03 / math.sqrt(12)), (0.04, 0.01))
    assert m == Doubt("theta_M", pytest.approx(0.01 / math.sqrt(12)), (0.03, 0.02))


def test_each_group_measured_alone():
    doubted = FLIGHT.model_copy(
        update={"uncertainty": FLIGHT.uncertainty.model_copy(update={"rise": 0.002})}
    )
    question = asked(
        sheet(com_height=0.004, com_from_front=0.003, flat_length=0.002), doubted,
        friction=(0.5, 0.9), theta_d=(0.01, 0.04), theta_M=(0.02, 0.03),
    )  # fmt: skip
    every = {each.group for each in doubts_of(question)}
    assert every == {"centroid", "length", "stairs", "friction", "theta_d", "theta_M"}
    for group in every:
        left = doubts_of(without(question, group))
        assert {each.group for each in left} == every - {group}
    assert without(question, "friction").friction == (0.9, 0.9)
    assert without(question, "theta_d").allowance_d == Allowance(low=0.01, high=0.01)
    assert without(asked(terrain=Profile.of_stairs(FLIGHT)), "stairs") is None
    assert without(Question.in_one_posture(KENAF, FLIGHT), "friction") is None


L, C_N, FRONT, REAR = 0.52, 0.146, 0.08, 0.09


def beyond(terrain, com_from_front=0.255, *, tips_below=False, facing="nose-first"):
    flight = terrain if isinstance(terrain, Stairs) else None
    question = SimpleNamespace(
        flight=flight, flights=(), facing=facing, direction="up",
        profile=terrain if flight is None else Profile.of_stairs(flight),
        stance=SimpleNamespace(
            flat_length=L, com_from_front=com_from_front, com_height=C_N, tips_below=tips_below
        ),
        robot=SimpleNamespace(
            com_range=None, track=SimpleNamespace(front_radius=FRONT, rear_radius=REAR)
        ),
    )  # fmt: skip
    return {each.figure: each for each in limits(question)}


def takes(C_L, R):
    return float(largest_step_height(l_c=L - C_L, C_N=C_N, R=R))


def test_limits_are_of_the_longest_spacing_and_the_highest_riser():
    uneven = Stairs(rises=(0.1, 0.15, 0.174, 0.12), goings=(0.25, 0.27, 0.2))
    found = beyond(uneven)
    assert found["nosing_spacing"].has_m == pytest.approx(math.hypot(0.174, 0.27))
    riser = found["rise"]
    assert (riser.has_m, riser.takes_m) == pytest.approx((0.174, takes(0.255, REAR)))
    # the next millimetre would be too much, for a tenth of one that is found to
    needs = riser.needs_m
    assert round(1e3 * needs, 9) == round(1e3 * needs)
    assert takes(needs, REAR) >= 0.174 > takes(needs + 1.1e-3, REAR)
    tail = beyond(uneven, 0.255, facing="tail-first")["rise"]
    assert tail.takes_m == pytest.approx(takes(L - 0.255, FRONT))
    assert beyond(uneven, tips_below=True).keys() == {"nosing_spacing"}


def test_limits_of_a_profile_are_of_its_risers():
    """Its first riser too, from wherever it begins."""
    up = Profile.of_points([(-2, 1), (0, 1), (0, 1.2), (0.27, 1.2), (0.27, 1.3), (3, 1.3)])
    found = beyond(up)
    assert found.keys() == {"rise"}
    assert found["rise"].has_m == pytest.approx(0.2)
    assert beyond(Profile.of_points([(-2, 0), (2, 0)])) == {}
    low = np.array([(-2, 0), (0, 0), (0, takes(0.255, REAR) - 1e-6), (2, 0)])
    low[3, 1] = low[2, 1]
    assert beyond(Profile.of_points(low)) == {}
