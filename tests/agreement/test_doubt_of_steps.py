"""Doubt of every step: the probability of an answer against flights drawn one by one.

Brute force draws nosings with a generator of its own, makes exact flights of them, and drives the
contact model over each. The answer's own samples ask the criterion alone.
"""

import math

import numpy as np
import pytest

from kaidan import Profile, Question, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.models.quasi_static import judge
from kaidan.modes import Verdict

NO_ALLOWANCES = {"theta_d": (0, 0), "theta_M": (0, 0)}
CASES = {
    "kenaf": ("kenaf", Stairs.inclined(angle="40deg", nosing_spacing="190mm"), (1e-3, 1e-3),
              {"acceleration": 0.5} | NO_ALLOWANCES),
    "kenaf, steep": ("kenaf", Stairs.inclined(angle="52deg", nosing_spacing="150mm"), (3e-3, 3e-3),
                     {"fall_reserve": 0.0} | NO_ALLOWANCES),
    "ozbot": ("ozbot-atr", Stairs.named("ibc"), (4e-3, 4e-3),
              {"theta_d": (0.0, math.radians(3.0)), "theta_M": (0.0, math.radians(3.7))}),
    "ozbot, gentle": ("ozbot-atr", Stairs.named("ada"), (6e-3, 4e-3),
                      {"theta_d": (0.0, math.radians(2.6)), "theta_M": (0.0, math.radians(2.6))}),
}  # fmt: skip
PROFILES = {
    "kenaf": ((0.5e-3, 1e-3), CASES["kenaf"]),
    "ozbot": ((4e-3, 5e-3), CASES["ozbot"]),
}


def in_doubt(robot, flight, sigma, manner):
    return Question.in_one_posture(
        robot, flight, friction=3.0, uncertainty={"rise": sigma[0], "going": sigma[1]}, **manner
    )


def steps_drawn(flight, sigma, rng):
    rises = np.array(flight.step_rises) + rng.normal(0.0, sigma[0], flight.steps)
    goings = np.array(flight.step_goings) + rng.normal(0.0, sigma[1], flight.steps - 1)
    return Stairs(rises=tuple(rises), goings=tuple(goings))


def nosings_drawn(flight, sigma, rng):
    nosings = Profile.of_stairs(flight).nosings
    nosings = nosings + rng.normal(0.0, 1.0, nosings.shape) * sigma
    return Stairs(
        rises=tuple(np.diff(nosings[:, 1], prepend=0.0)), goings=tuple(np.diff(nosings[:, 0]))
    )


def predicted(question):
    """Shares of samples that tip, and that are no GO."""
    found = judge(question)
    fails = np.logical_or.reduce(np.broadcast_arrays(*(each.fails() for each in found.each)))
    return np.array([(conclude(question, found).samples <= 0).mean(), fails.mean()])


def brute_force(question, draw, count):
    """The same of exact flights."""
    rng = np.random.default_rng(11)
    shares = np.zeros(2)
    for _ in range(count):
        one = question.changed(terrain=draw(rng))
        conclusion = conclude(one, judge(one))
        shares += conclusion.margin <= 0, conclusion.verdict is not Verdict.GO
    return shares / count


def band(p, count):
    """0.02, the proof's, and twice the standard deviation of so many draws."""
    return 0.02 + 2 * np.sqrt(p * (1 - p) / count)


def check(question, draw, count):
    p = predicted(question)
    found = brute_force(question, draw, count)
    assert (np.abs(found - p) <= band(p, count)).all(), (p, found)


def check_list(name, count):
    robot, flight, sigma, manner = CASES[name]
    question = in_doubt(robot, flight, sigma, manner)
    check(question, lambda rng: steps_drawn(flight, sigma, rng), count)


@pytest.mark.parametrize("name", CASES)
def test_probability_of_a_list_of_steps(name):
    check_list(name, 80)


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_probability_of_a_list_of_steps_by_1000_flights(name):
    check_list(name, 1000)


@pytest.mark.slow
@pytest.mark.parametrize("name", PROFILES)
def test_probability_of_a_profile_by_1000_flights(name):
    sigma, (robot, flight, _, manner) = PROFILES[name]
    profile = Profile.of_points(Profile.of_stairs(flight).points, sigma=sigma)
    question = Question.in_one_posture(robot, profile, friction=3.0, **manner)
    check(question, lambda rng: nosings_drawn(flight, sigma, rng), 1000)


@pytest.mark.parametrize("direction", ["up", "down"])
def test_a_profile_with_a_covariance_is_the_list_of_its_steps(direction):
    robot, flight, sigma, manner = CASES["ozbot"]
    listed = in_doubt(robot, flight, sigma, manner | {"direction": direction})
    line = Profile.of_stairs(flight)
    drawn = Profile.of_stairs(listed.terrain)
    profile = Profile.of_points(line.points, covariance=drawn.covariance)
    for terrain in (profile, Profile.of_points(line.points).with_doubt(rise=4e-3, going=4e-3)):
        one, other = (
            {each.mode.key: each for each in judge(question).each}
            for question in (listed, listed.changed(terrain=terrain))
        )
        assert one.keys() == other.keys()
        for key, each in one.items():
            # rad, m: the points of a profile are sums of steps
            np.testing.assert_allclose(other[key].worst, each.worst, atol=1e-9, err_msg=key)
