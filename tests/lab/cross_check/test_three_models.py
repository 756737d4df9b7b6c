"""Closed form, contact model and physics on the same questions: `kaidan.lab.agree`."""

import math

import jsonschema
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from kaidan.contact import Status, steepest_flight
from kaidan.lab.cross_check import Agreement, agree
from kaidan.lab.cross_check.bands import FALLING, falling
from kaidan.lab.cross_check.bisection import steepest_climbed
from kaidan.lab.cross_check.common_question import (
    at_angle,
    common,
    flight_traverse,
    slopes,
    steepest_arrested,
    trial_of,
)
from kaidan.physics.initial_pose import course_of
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs
from physics_cases import FORMULA, QUASI_STATIC, SPACINGS, robot


def inclined(angle, spacing):
    return Stairs.inclined(angle=math.radians(angle), nosing_spacing=spacing)


def answers(found):
    return {each.name: each.answers for each in found.comparisons}


def differences(found):
    return {(each.comparison, each.of, each.less): each for each in found.differences}


@pytest.fixture(scope="module")
def kenaf():
    return agree(Question.in_one_posture(robot(), inclined(58.0, 0.150)))


def test_the_steepest_flight_of_each_model(kenaf):
    # docs/theory/margin.md; docs/theory/contact.md, figures of the prototypes
    limits = answers(kenaf)["steepest_flight"]
    assert limits["closed_form"] == pytest.approx(FORMULA[0.150], abs=5e-4)
    assert limits["contact"] == pytest.approx(QUASI_STATIC[0.150], abs=0.01)
    # docs/lab/physics.md: 63.45 deg from rest at 100 mm/s; bisection and start are good to 1 deg
    assert limits["physics"] == pytest.approx(63.45, abs=1.0)


def test_what_is_the_same_criterion_is_the_same_to_1e_6_rad(kenaf):
    one = differences(kenaf)["steepest_flight", "static_criterion", "closed_form"]
    assert abs(one.value_deg) < math.degrees(1e-6)
    assert one.within


def test_on_a_flight_that_all_hold_all_agree(kenaf):
    assert set(answers(kenaf)["stairs"].values()) == {"holds"}
    assert answers(kenaf)["friction"]["closed_form"] == pytest.approx(math.tan(math.radians(58)))
    assert kenaf.agrees
    assert all(each.within for each in kenaf.differences)


def test_it_is_the_same_after_json(kenaf):
    assert Agreement.from_json(kenaf.to_json()) == kenaf
    jsonschema.validate(kenaf.to_dict(), Agreement.json_schema())


def test_bisection_is_that_of_the_contact_model():
    question = common(Question.in_one_posture(robot(), inclined(50.0, 0.150)))
    low, high = slopes(question)

    def flight(angle):
        course = course_of(trial_of(at_angle(question, angle)))
        return course.profile.points, course.x, course.x + course.distance * math.cos(angle)

    parts = question.outline.parts
    theirs = steepest_flight(flight, parts, low=low, high=high, tolerance=1e-4)
    # 2e-4 rad: both brackets
    assert steepest_arrested(question, 1e-4) == pytest.approx(theirs, abs=2e-4)


@pytest.mark.parametrize("spacing", SPACINGS)
def test_excess_over_the_contact_model_is_in_the_band(spacing):
    question = common(Question.in_one_posture(robot(), inclined(40.0, spacing)))
    found = steepest_climbed(question, QUASI_STATIC[spacing] + 1.0, 0.25)
    # docs/lab/physics.md: at 100 mm/s 0.9 to 1.1 deg above the quasi-static model
    assert 0.5 < found.value - QUASI_STATIC[spacing] < falling(0.1)


def test_absolem_flat_on_178_279_is_one_story():
    # no rotation: docs/theory/contact.md, figures of the prototypes
    question = Question.in_one_posture("absolem", Stairs(rise=0.178, going=0.279), flippers="flat")
    found = agree(question, resolution=1.0)
    assert set(answers(found)["stairs"].values()) == {"holds"}
    assert answers(found)["extra"]["contact"] == pytest.approx(0.0, abs=0.01)
    assert answers(found)["extra"]["physics"] == pytest.approx(0.0, abs=0.1)
    assert found.agrees


@pytest.mark.parametrize("begin", ["flight", "landing"])
def test_ozbot_on_241_241_is_one_story_too(begin):
    # falls over: docs/theory/contact.md, figures of the prototypes
    question = Question.in_one_posture("ozbot-atr", Stairs(rise=0.241, going=0.241))
    found = agree(question, begin=begin, resolution=1.0)
    assert set(answers(found)["stairs"].values()) == {"tips"}
    assert found.agrees


def test_faster_than_it_can_fall_is_said():
    question = Question.in_one_posture("ozbot-atr", Stairs(rise=0.241, going=0.241), speed=0.4)
    found = agree(question, resolution=1.0)
    late = differences(found)["stairs", "physics", "contact"]
    assert late.within is False
    assert late.cause.startswith("at 0.4 m/s the robot drives on faster than it can fall")
    assert not found.agrees


def test_beyond_half_the_flat_length_the_closed_form_is_not_compared():
    found = agree(
        Question.in_one_posture("absolem", Stairs(rise=0.178, going=0.279)), resolution=1.0
    )
    assert answers(found)["steepest_flight"]["closed_form"] is None
    assert answers(found)["stairs"]["closed_form"] == "outside"
    one = differences(found)["stairs", "static_criterion", "closed_form"]
    assert one.within is None
    assert one.cause.startswith("outside the closed form: the nosing spacing of 331 mm is more")


def test_too_little_friction_slides_in_all_of_them():
    found = agree(
        Question.in_one_posture(robot(), inclined(50.0, 0.150), friction=0.8), resolution=1.0
    )
    assert set(answers(found)["stairs"].values()) == {"slides"}


def test_uncertainties_and_allowances_play_no_part():
    plain = Question.in_one_posture(robot(), inclined(58.0, 0.150), friction=2.0)
    doubted = Question.in_one_posture(
        robot(), inclined(58.0, 0.150), friction=(2.0, 2.5), theta_d="3deg",
        uncertainty="com_from_front=20mm,angle=2deg", risk=0.3,
    )  # fmt: skip
    assert common(doubted) == common(plain).changed(risk=0.3)


def test_the_excess_is_read_from_what_was_measured():
    assert falling(FALLING[-1][0]) == pytest.approx(1.3 * FALLING[-1][1])
    assert falling(0.21) is None


def test_a_robot_that_cannot_stand_is_an_answer():
    question = Question.in_one_posture(robot(), inclined(75.0, 0.220))
    assert flight_traverse(common(question)).status is not Status.OK
    found = agree(question, resolution=1.0)
    assert answers(found)["stairs"]["physics"] in ("tips", "outside")
    assert differences(found)["extra", "physics", "contact"].within is None


def test_from_the_landing_the_largest_inclination_is_not_compared():
    question = Question.in_one_posture(robot(), inclined(50.0, 0.150))
    found = agree(question, begin="landing", resolution=1.0)
    assert answers(found)["stairs"]["physics"] == "holds"
    extra = differences(found)["extra", "physics", "contact"]
    assert extra.within is None
    assert extra.cause.startswith("the trial enters and lands")
