"""Doubt of every step: the probability of an answer against flights drawn one by one.

Brute force draws nosings with a generator of its own, makes exact flights of them, and drives the
contact model over each. The answer's own samples ask the criterion alone.
"""

import math

import numpy as np
import pytest

from amounts import fast_and_slow
from kaidan import Profile, Question, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.models.balance import _drawn
from kaidan.models.contact_model import judge
from kaidan.models.drawn_falls import _changed
from kaidan.models.spread import drawn_of_all, moved_profile, nosings_of, spread
from kaidan.modes import FALL_DOWNHILL, Verdict
from kaidan.override import overridden
from kaidan.traversal import traverse

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


REGULAR = Stairs.inclined(angle="46deg", nosing_spacing="200mm")
FALLS = {
    "kenaf": ("kenaf", REGULAR, (3e-3, 3e-3), {"fall_reserve": math.radians(6.7)}),
    "kenaf, more": ("kenaf", REGULAR, (5e-3, 4e-3), {"fall_reserve": math.radians(6.2)}),
    "marmotte": ("marmotte", Stairs.named("uk-general"), (4e-3, 4e-3),
                 {"fall_reserve": math.radians(4.2)}),
}  # fmt: skip
"""Robots that rock in nearly every draw, with a reserve that about half of the draws keep."""


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


def falls(question):
    """Shares of samples that have less than the reserve to the fall."""
    found = judge(question).of(FALL_DOWNHILL)
    return 0.0 if found is None else float(found.fails().mean())


def check_falls(draw, question, count):
    rng, p = np.random.default_rng(12), falls(question)
    share = sum(falls(question.changed(terrain=draw(rng))) for _ in range(count)) / count
    assert abs(share - p) <= band(p, count), (p, share)


@pytest.mark.parametrize(("name", "count"), [
    ("kenaf", 80), *(pytest.param(name, 1000, marks=pytest.mark.slow) for name in FALLS)
])  # fmt: skip
def test_probability_of_a_fall(name, count):
    """Each draw is driven under tilted gravity until it falls, as no sample of the answer is."""
    robot, flight, sigma, manner = FALLS[name]
    question = in_doubt(robot, flight, sigma, manner)
    check_falls(lambda rng: steps_drawn(flight, sigma, rng), question, count)


@pytest.mark.slow
def test_probability_of_a_fall_on_a_profile():
    robot, flight, _, manner = FALLS["kenaf"]
    sigma = (3e-3, 3e-3)
    profile = Profile.of_points(Profile.of_stairs(flight).points, sigma=sigma)
    question = Question.in_one_posture(robot, profile, friction=3.0, **manner)
    check_falls(lambda rng: nosings_drawn(flight, sigma, rng), question, 1000)


def test_the_robot_of_a_sample_is_that_of_a_sheet_with_its_figures():
    robot, flight, _, manner = FALLS["kenaf"]
    sure = Question.in_one_posture(robot, flight, friction=3.0, **manner)
    body = _changed(sure.outline, 0.02, 0.01, 0.005)
    L, C_L, C_N = (
        sure.stance.flat_length, sure.stance.com_from_front, sure.stance.com_height
    )  # fmt: skip
    sheet = overridden(
        sure.robot,
        {"flat_length": L + 0.02, "com_from_front": C_L + 0.01, "com_height": C_N + 0.005},
    )
    own = Question.in_one_posture(sheet, flight, friction=3.0, **manner).outline
    np.testing.assert_allclose(body.parts, own.parts, atol=1e-12)


def check_list(name, count):
    robot, flight, sigma, manner = CASES[name]
    question = in_doubt(robot, flight, sigma, manner)
    check(question, lambda rng: steps_drawn(flight, sigma, rng), count)


@pytest.mark.parametrize("name", ["kenaf, steep", "ozbot, gentle"])
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
    one = {each.mode.key: each for each in judge(listed).each}
    for terrain in (profile, Profile.of_points(line.points).with_doubt(rise=4e-3, going=4e-3)):
        other = {each.mode.key: each for each in judge(listed.changed(terrain=terrain)).each}
        assert one.keys() == other.keys()
        for key, each in one.items():
            # rad, m: the points of a profile are sums of steps
            np.testing.assert_allclose(other[key].worst, each.worst, atol=1e-9, err_msg=key)


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("count", fast_and_slow(4, 100))
def test_each_sample_rocks_where_its_own_traverse_does(direction, count):
    """Nosings lost on the flight and over the landing are those of one sample."""
    flight = Stairs.inclined(angle="40deg", nosing_spacing="150mm", steps=12)
    question = in_doubt("kenaf", flight, (2e-3, 2e-3), NO_ALLOWANCES | {"direction": direction})
    driven, found = judge(question).basis
    samples = _drawn(found, spread(driven, found), found.first_rock(downhill=True), True, None)
    drawn = drawn_of_all(driven)
    nosings = nosings_of(driven.profile, drawn)
    for k in range(count):
        own = traverse(
            moved_profile(driven.profile, nosings[k]),
            _changed(driven.outline, *drawn[:3, k].tolist()),
            descending=found.descending,
        )
        assert samples[k] == pytest.approx(own.first_rock(downhill=True).margin, abs=1e-9)
