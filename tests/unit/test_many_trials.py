"""Many trials as an answer: inputs drawn of their doubt, how many fail, and how sure that is."""

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

import kaidan
from kaidan import Assessment, InputError, Profile, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.models import dynamic
from kaidan.models.drawn_trials import drawn, drawn_specs, track_of
from kaidan.models.proportion import interval
from kaidan.models.spread import moved_profile
from kaidan.modes import Verdict
from kaidan.physics import Outcome
from kaidan.question import Question
from physics_cases import robot

GENTLE = Stairs(rise=0.1, going=0.2, steps=3)


def ask(stairs=GENTLE, **manner):
    return Question.of(manner.pop("sheet", robot()), stairs, model="physics", **manner)


def test_the_interval_by_hand():
    # none of n: the upper end solves (1 - p)^n = 0.025; all of n mirror it
    for n in (1, 5, 300):
        low, high = interval(0, n)
        assert low == 0.0
        assert (1 - high) ** n == pytest.approx(0.025, rel=1e-9)
        assert interval(n, n) == (pytest.approx(1 - high, abs=1e-12), 1.0)


def test_the_interval_against_the_beta_distribution():
    beta = pytest.importorskip("scipy.stats").beta
    for k, n in ((1, 8), (3, 20), (50, 1000)):
        expected = beta.ppf(0.025, k, n - k + 1), beta.ppf(0.975, k + 1, n - k)
        assert interval(k, n) == pytest.approx(expected, rel=1e-9)


def test_draws_have_the_spread_that_is_stated():
    question = ask(
        trials=200,
        friction=1.0,
        uncertainty="com_height=5mm,com_from_front=8mm,flat_length=3mm,friction=0.05,rise=2mm",
    )
    each = list(drawn(question))
    for values, mean, sigma in (
        ([one.robot.com_height for one in each], question.robot.com_height, 0.005),
        ([one.robot.com_from_front for one in each], question.robot.com_from_front, 0.008),
        ([one.robot.track.flat_length for one in each], question.robot.track.flat_length, 0.003),
        ([one.friction[0] for one in each], 1.0, 0.05),
        ([one.terrain.rises[1] for one in each], 0.1, 0.002),
    ):
        # means of a Latin hypercube of exact normals; rises are drawn of several rows
        assert np.mean(values) == pytest.approx(mean, abs=0.2 * sigma)
        assert np.std(values) == pytest.approx(sigma, rel=0.15)
    assert not any(one.uncertain for one in each)


def test_trials_of_one_question_begin_apart_and_are_the_same_every_time():
    question = ask(trials=4, friction=(0.6, 1.0))
    specs = list(drawn_specs(question))
    assert [len(each) for each in specs] == [2] * 4
    assert sorted(each[0].start_offset for each in specs) == [0.125, 0.375, 0.625, 0.875]
    assert specs == list(drawn_specs(question))


def test_a_profile_moves_with_its_nosings_by_hand():
    profile = Profile.of_points([(-1, 0), (0, 0), (0, 0.1), (0.2, 0.1), (0.2, 0.2), (1, 0.2)])
    moved = moved_profile(profile, np.add(profile.nosings, [[0.01, 0.02], [-0.01, 0.03]]))
    expected = [(-0.99, 0), (0.01, 0), (0.01, 0.12), (0.19, 0.12), (0.19, 0.23), (0.99, 0.23)]
    np.testing.assert_allclose(moved.points, expected, atol=1e-12)
    np.testing.assert_allclose(moved.nosings, [(0.01, 0.12), (0.19, 0.23)], atol=1e-12)
    # and a flight that is drawn as a profile is the one that is drawn as stairs
    flight = ask(trials=3, friction=1.0, uncertainty="rise=3mm,going=3mm")
    line = flight.changed(terrain=flight.profile)
    for one, other in zip(drawn(flight), drawn(line), strict=True):
        np.testing.assert_allclose(one.profile.nosings, other.profile.nosings, atol=1e-12)
        np.testing.assert_allclose(one.profile.points[1:-1], other.profile.points[1:-1], atol=1e-12)


def test_the_track_is_the_sheets_unless_it_is_named():
    soft = robot(stiffness=4e4)
    assert track_of(ask()).kind == "smooth-belt"
    assert track_of(ask(sheet=soft)).kind == "yielding-belt"
    assert track_of(ask(sheet=soft, track="driven-grousers")).kind == "driven-grousers"
    assert track_of(ask(sheet=robot(stiffness=4e4, gauge=0.3), yaw=0.1)).kind == "smooth-belt"
    millimetres = robot(indentation=0.004, sag=0.008)
    (spec,), *_ = drawn_specs(ask(sheet=millimetres))
    # 20 kg are assumed: 196 N over 4 mm, and half of that along the track
    assert spec.stiffness == pytest.approx(20 * 9.80665 / 0.004)
    assert spec.shear_stiffness == pytest.approx(spec.stiffness / 2)


def trials_of(question, fails):
    """Draws of results without a simulation: those numbered fall over the tail."""
    (spec,), *_ = drawn_specs(question)
    fallen = dynamic.run(spec).model_copy(update={"outcome": Outcome.FELL_BACKWARD})
    climbed = fallen.model_copy(update={"outcome": Outcome.CLIMBED})
    return [(fallen,) if k in fails else (climbed,) for k in range(question.trials)]


@pytest.mark.parametrize(
    ("trials", "failing", "verdict"),
    [
        # 95 % interval of none of 20: 0 to 17 %; of 1 of 20: 0.13 to 25 %; of 3: 3.2 to 38 %
        (20, 0, Verdict.UNSURE),
        (20, 1, Verdict.UNSURE),
        (20, 3, Verdict.NO_GO),
        # within the accepted 1 %: nothing is told to fail, but no margin is known either
        (200, 2, Verdict.UNSURE),
    ],
)
def test_a_share_is_a_no_go_where_its_interval_lies_above_the_risk(trials, failing, verdict):
    question = ask(trials=trials, friction=1.0)
    draws = trials_of(question, range(failing))
    found = dynamic.findings_of(draws, risk=question.risk)
    concluded = conclude(question, found)
    assert concluded.verdict is verdict
    (figures,) = found.figures
    assert (figures.draws, figures.failed, figures.failed_best) == (trials, failing, failing)
    told = failing > 0.01 * trials
    assert [one.mode.key for one in found.each] == (["tip_downhill"] if told else [])
    if told:
        assert found.each[0].fails().sum() == failing


def test_the_answer_says_how_sure_it_is():
    answer = kaidan.assess(robot(), GENTLE, friction=1.0, model="physics", trials=3)
    assert answer.verdict == "unsure"
    assert answer.reason == (
        "None of 3 trials fails: 71 % or less would, with 95 % confidence; trials know no margin."
    )
    assert answer.physics.failure_interval == (0.0, pytest.approx(1 - 0.025 ** (1 / 3)))
    assert "  trial           3 climbed" in answer.details().splitlines()
    assert Assessment.from_json(answer.to_json()) == answer


def test_the_share_of_a_slope_of_friction_is_that_of_the_normal():
    # friction 0.5 +- 0.1 on 26.6 deg: a belt slides below tan = 0.5, half of all draws
    answer = kaidan.assess(
        robot(),
        Stairs(rise=0.05, going=0.1, steps=6),
        friction=0.55,
        uncertainty="friction=0.05",
        speed=0.3,
        model="physics",
        trials=10,
    )
    # 16 % of the normal lie below one deviation; entering asks for more than the flight
    assert answer.physics.failed >= 1
    assert answer.findings["slides_down"].probability == answer.physics.failed / 10


def test_nonsense_is_refused():
    for manner, text in (
        ({"trials": 0}, "trials"),
        ({"trials": 2.5}, "trials"),
        ({"track": "rubber"}, "track = 'rubber' is not known; known: smooth-belt, yielding-belt"),
    ):
        with pytest.raises(InputError, match=text):
            ask(**manner)
    for manner in ({"trials": 3}, {"track": "smooth-belt"}):
        with pytest.raises(InputError, match="goes with the physics alone; give model = physics"):
            Question.of("kenaf", "ibc", **manner)
    with pytest.raises(InputError, match="give either indentation or stiffness, not both"):
        robot(stiffness=1e4, indentation=0.004)
    answer = kaidan.assess(robot(), GENTLE, model="physics", track="yielding-belt")
    assert answer.verdict == "outside-model"
    assert "yielding-belt needs a stiffness" in answer.reason
