"""Doubt of single nosings and steps: covariance, draws, JSON, what is refused."""

import math

import numpy as np
import pytest

from kaidan import Profile, Question, Stairs
from kaidan.errors import InputError
from kaidan.terrain.doubt import MOST_DOUBTED
from kaidan.terrain.stairs_uncertainty import StairsUncertainty

FLIGHT = Stairs(rise=0.2, going=0.3, steps=3)
POINTS = Profile.of_stairs(FLIGHT).points
ROUNDING = 1e-12


def doubted(**sigma):
    return Stairs(rise=0.2, going=0.3, steps=3, uncertainty=StairsUncertainty(**sigma))


def test_an_exact_flight_has_no_covariance():
    assert Profile.of_stairs(FLIGHT).covariance is None
    assert Profile.of_points(POINTS).covariance is None
    assert Profile.of_points(POINTS, sigma=(0.0, 0.0)).covariance is None
    assert "covariance" not in Profile.of_points(POINTS).to_dict()


def test_doubt_of_steps_adds_up_from_nosing_to_nosing():
    """By hand: the k-th nosing is k rises above the landing, k - 1 goings from the first."""
    found = Profile.of_stairs(doubted(rise=3e-3, going=2e-3)).covariance
    k = np.arange(3)
    np.testing.assert_allclose(found[1::2, 1::2], 9e-6 * (1 + np.minimum.outer(k, k)))
    np.testing.assert_allclose(found[::2, ::2], 4e-6 * np.minimum.outer(k, k))
    assert not found[::2, 1::2].any()
    same = Profile.of_points(POINTS).with_doubt(rise=3e-3, going=2e-3)
    np.testing.assert_array_equal(same.covariance, found)


def test_the_last_rise_may_be_known_worse_than_the_others():
    """By hand: 3 mm of each, 5 mm of the last one, which moves the last nosing alone."""
    known, worse = (
        Profile.of_stairs(doubted(rise=3e-3, last_rise=last)).covariance for last in (0.0, 5e-3)
    )
    assert worse[5, 5] == pytest.approx(9e-6 + 9e-6 + 25e-6)
    np.testing.assert_array_equal(worse[:5, :5], known[:5, :5])
    alone = Profile.of_stairs(doubted(last_rise=5e-3)).covariance
    assert np.sqrt(np.diag(alone)) == pytest.approx([0, 0, 0, 0, 0, 5e-3])
    np.testing.assert_array_equal(known, Profile.of_stairs(doubted(rise=3e-3)).covariance)


def test_the_first_rise_may_be_known_worse_and_lifts_all():
    known, worse = (
        Profile.of_stairs(doubted(rise=3e-3, first_rise=first)).covariance for first in (0.0, 5e-3)
    )
    np.testing.assert_allclose((worse - known)[1::2, 1::2], np.full((3, 3), 16e-6))
    np.testing.assert_array_equal(worse[::2], known[::2])


def test_doubt_of_nosings_apart():
    found = Profile.of_points(POINTS, sigma=(1e-3, 2e-3))
    np.testing.assert_allclose(found.covariance, np.diag([1e-6, 4e-6] * 3))
    each = Profile.of_points(POINTS, sigma=[(1e-3, 2e-3)] * 3)
    assert each == found
    assert found != Profile.of_points(POINTS)
    assert found != Profile.of_points(POINTS, sigma=(1e-3, 1e-3))


def test_flights_one_after_the_other_have_a_common_doubt_each():
    """By hand: tilted by 0.01, a going of 300 mm rises 3 mm more; what follows is moved along."""
    profile = Profile.of_flights([doubted(angle=0.01), doubted(nosing_spacing=5e-3)])
    sigma = np.sqrt(np.diag(profile.covariance)).reshape(6, 2)
    tilted = [(0, 0), (2e-3, 3e-3), (4e-3, 6e-3)]
    p = math.hypot(0.2, 0.3)
    longer = [5e-3 * k * np.array([0.3, 0.2]) / p for k in range(3)]
    np.testing.assert_allclose(sigma[:3], tilted, atol=ROUNDING)
    np.testing.assert_allclose(
        sigma[3:], [np.hypot(tilted[2], each) for each in longer], atol=ROUNDING
    )


@pytest.mark.parametrize("singular", [True, False])
def test_draws_have_the_covariance(singular):
    """Unit vectors in place of normals give its columns."""
    rng = np.random.default_rng(1)
    mixed = 1e-3 * rng.normal(size=(6, 2 if singular else 6))
    profile = Profile.of_points(POINTS, covariance=mixed @ mixed.T)
    off = (profile.drawn_nosings(np.eye(6)) - profile.nosings).reshape(6, 6)
    # m^2: entries are 1e-6, pivots below 1e-9 of the largest are dropped
    np.testing.assert_allclose(off.T @ off, profile.covariance, atol=1e-14)


def test_draws_of_an_exact_profile_are_its_nosings():
    found = Profile.of_points(POINTS).drawn_nosings(np.eye(6))
    np.testing.assert_array_equal(found, [Profile.of_points(POINTS).nosings] * 6)


def test_reflected_twice_is_the_same():
    profile = Profile.of_stairs(doubted(rise=3e-3, going=2e-3))
    turned = profile.reflected()
    np.testing.assert_array_equal(turned.reflected().covariance, profile.covariance)
    unit = np.eye(6)
    back = (turned.nosings - turned.drawn_nosings(unit))[:, ::-1] * [-1.0, 1.0]
    off = profile.nosings - profile.drawn_nosings(unit)
    np.testing.assert_allclose(
        np.einsum("dix,djy->ixjy", back, back), np.einsum("dix,djy->ixjy", off, off), atol=1e-14
    )


@pytest.mark.parametrize("given", [{"sigma": [[1e-3, 2e-3]] * 3}, {"covariance": None}])
def test_a_question_is_the_same_after_json(given):
    if given == {"covariance": None}:
        given = {"covariance": Profile.of_stairs(doubted(rise=3e-3)).covariance.tolist()}
    question = Question.in_one_posture(
        "kenaf", Profile.from_dict({"points": POINTS.tolist()} | given)
    )
    assert question.steps_uncertain
    assert Question.model_validate_json(question.model_dump_json()) == question
    spelled = Question.in_one_posture("kenaf", FLIGHT, uncertainty="rise=3mm,going=2mm")
    assert spelled.terrain.uncertainty == StairsUncertainty(rise=3e-3, going=2e-3)
    assert Question.model_validate_json(spelled.model_dump_json()) == spelled


def test_steps_of_any_terrain_take_a_doubt():
    for terrain in (FLIGHT, (FLIGHT, FLIGHT), Profile.of_points(POINTS)):
        question = Question.in_one_posture("kenaf", terrain, uncertainty={"rise": 3e-3})
        assert question.uncertain
        assert question.profile.covariance[1, 1] == pytest.approx(9e-6)
        assert not any(question.spread)


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"sigma": (1e-3, 1e-3), "covariance": np.eye(6)},
         "profile: give either sigma or covariance, not both"),
        ({"sigma": [(1e-3, 1e-3)] * 2},
         "profile: sigma has shape (2, 2), not (3, 2): 3 nosings were found"),
        ({"covariance": np.eye(5)},
         "profile: covariance has shape (5, 5), not (6, 6): 3 nosings were found"),
        ({"sigma": "wide"}, "profile: sigma must be numbers"),
        ({"sigma": (-1e-3, 0.0)},
         "profile: sigma has standard uncertainties not within 0 to 0.2 m"),
        ({"sigma": (3.0, 3.0)},
         "profile: sigma has standard uncertainties not within 0 to 0.2 m"),
        ({"covariance": np.full((6, 6), np.nan)},
         "profile: covariance has standard uncertainties not within 0 to 0.2 m"),
        ({"covariance": 1e-6 * np.tril(np.ones((6, 6)))}, "profile: covariance is not symmetric"),
        ({"covariance": 1e-6 * (2 * np.ones((6, 6)) - np.eye(6))},
         "profile: covariance is not positive semidefinite"),
    ],
)  # fmt: skip
def test_what_is_refused(given, text):
    with pytest.raises(InputError) as refused:
        Profile.of_points(POINTS, **given)
    assert str(refused.value) == text


def test_too_many_nosings_to_doubt_each():
    flight = Stairs(
        rise=0.2, going=0.3, steps=MOST_DOUBTED + 1, uncertainty=StairsUncertainty(rise=1e-3)
    )
    with pytest.raises(InputError) as refused:
        Profile.of_stairs(flight)
    assert str(refused.value) == (
        "501 nosings with a doubt of their own are more than 500: state the doubt of angle and "
        "nosing spacing, or fewer steps"
    )


def test_a_falling_profile_takes_no_doubt():
    down = POINTS[::-1] * [-1.0, 1.0]
    bump = np.vstack([down, [(1.0, 0.0), (1.0, 0.1), (2.0, 0.1)]])
    with pytest.raises(InputError) as refused:
        Question.in_one_posture(
            "kenaf", Profile.of_points(bump, sigma=(1e-3, 1e-3)), direction="down"
        )
    assert str(refused.value) == (
        "profile: it falls from left to right: give the points, and the doubt of the nosings, the "
        "other way round"
    )
