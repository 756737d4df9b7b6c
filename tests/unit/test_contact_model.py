"""The contact model's verdict: rules of the issue, uncertain inputs, yaw.

Robots and stairs are chosen so that the numbers follow from docs/theory/margin.md by hand.
"""

import json
import math
from dataclasses import replace

import numpy as np
import pytest

from amounts import fast_and_slow
from kaidan.assessment import answer_to, judged
from kaidan.errors import InputError
from kaidan.models.quasi_static import LONG_FLIGHT, Basis, findings_of, traverse_of
from kaidan.models.support_polygon import margins_of, yaw_limit
from kaidan.question import Question
from kaidan.robot import Robot, Track, Uncertainty
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.terrain.stairs_uncertainty import StairsUncertainty
from one_posture import assess

KENAF = Robot.named("kenaf")
UNMEASURED = KENAF.model_copy(update={"theta_d": None, "theta_M": None})
WITH_GAUGE = KENAF.model_copy(
    update={"track": KENAF.track.model_copy(update={"gauge": 0.3, "width": 0.05})}
)
AS_PRINTED = 5e-3
"""docs/theory/margin.md prints angles to three decimals, allowances to one [deg]."""


def at(angle, p=0.150, steps=8):
    return Stairs.inclined(angle=math.radians(angle), nosing_spacing=p, steps=steps)


def sure(**more):
    return {"friction": 2.5, "theta_d": 0.0, "theta_M": 0.0} | more


def test_go_with_the_papers_margin():
    """Paper: 60.205 deg at 150 mm."""
    answer = assess(KENAF, at(50), **sure())
    assert answer.verdict == "go"
    assert answer.model == "contact"
    assert answer.margin_deg == pytest.approx(10.205, abs=AS_PRINTED)
    assert (answer.governs, answer.phase) == ("tip_downhill", "traverse")
    assert answer.contact.grades.no_rotation
    # 0.51 mm of 0.1 m/s, times what a sudden stop leaves to a rotation: 71^2 / (71^2 + 126^2)
    assert answer.contact.energy_threshold_mm == pytest.approx(0.123, abs=1e-3)
    assert [each.phase for each in answer.contact.phases] == ["enter", "traverse", "land"]


def test_allowances_come_off():
    """By hand: 2.6 deg each unless measured."""
    answer = assess(UNMEASURED, at(50), friction=2.5)
    assert answer.margin_deg == pytest.approx(10.205 - 5.2, abs=AS_PRINTED)
    assert answer.margin_best_deg == pytest.approx(10.205, abs=AS_PRINTED)


def test_unknown_friction_is_never_a_go():
    answer = assess(KENAF, at(50), theta_d=0.0, theta_M=0.0)
    assert (answer.verdict, answer.governs) == ("unsure", "friction_unknown")


def test_lack_of_friction_is_a_no_go():
    """By hand: a slope of 50 deg asks for 1.19."""
    answer = assess(KENAF, at(50), **sure(friction=1.1))
    assert (answer.verdict, answer.governs) == ("no-go", "slides_down")
    by_hand = math.degrees(math.atan(1.1)) - 50
    assert answer.margin_deg == pytest.approx(by_hand, abs=1e-4)


def test_past_the_papers_limit_an_arrested_rotation_is_at_best_rough():
    """docs/theory/contact.md: between 60.2 deg and 62.48 deg, grade two, it is arrested."""
    few = assess(KENAF, at(61.5), **sure())
    assert (few.verdict, few.governs) == ("no-go", "fall_downhill")
    answer = assess(KENAF, at(61.5), **sure(fall_reserve=math.radians(0.5)))
    assert (answer.verdict, answer.governs) == ("rough", "tip_downhill")
    assert answer.margin_deg == pytest.approx(60.205 - 61.5, abs=AS_PRINTED)
    assert answer.contact.grades.no_rotation is False
    assert answer.contact.grades.arrested
    assert "deg from falling" in answer.reason


def test_a_fall_is_a_no_go():
    answer = assess(KENAF, at(70), **sure())
    assert answer.verdict == "no-go"
    assert answer.falls_over == "tail"
    assert answer.exit_code == 1


def test_fewer_than_two_nosings_rock():
    """p > L/2: by hand the nose drops below atan((p - C_L)/C_N) = 59 deg."""
    flat = Robot(
        name="flat",
        com_from_front=0.25,
        com_height=0.03,
        track=Track(flat_length=0.5, front_radius=0.1, rear_radius=0.1),
    )
    answer = assess(flat, at(15, p=0.3), **sure())
    assert answer.verdict == "rough"
    assert answer.contact.grades.no_rotation is False
    assert any("p > L/2" in note for note in answer.notes)


def test_little_energy_is_unsure():
    """docs/theory/measures.md: at (200 mm, 44 deg) 0.07 mm of energy margin are left."""
    answer = assess(KENAF, at(44, p=0.200), **sure())
    assert (answer.verdict, answer.governs) == ("unsure", "energy")
    assert answer.contact.phases[1].energy_margin_mm == pytest.approx(0.07, abs=5e-3)
    slowly = assess(KENAF, at(44, p=0.200), **sure(speed=0.01))  # v^2/2g = 0.005 mm
    assert slowly.verdict == "go"


def test_a_landing_shorter_than_the_robot_is_unsure():
    short = at(50).model_copy(update={"upper_landing": 0.3})
    answer = assess(KENAF, short, **sure())
    assert answer.verdict == "unsure"
    # by hand: Kenaf is 470 + 2 x 65 mm long
    assert answer.findings["landing_room"].margin == pytest.approx(300 - 600, abs=1e-6)
    assert answer.reason == "A landing is 300 mm shorter than the robot."


def test_a_robot_that_cannot_stand_at_the_start_has_no_answer():
    """By hand: C_N a / g = 600 mm, past the 250 mm to its end: the level landing tips it."""
    tall = Robot(
        name="tall",
        com_from_front=0.25,
        com_height=0.6,
        track=Track(flat_length=0.5, front_radius=0.06, rear_radius=0.06),
    )
    answer = assess(tall, at(30, p=0.12), **sure(acceleration=-9.8))
    assert (answer.verdict, answer.governs, answer.exit_code) == (
        "outside-model", "outside_model", 3,
    )  # fmt: skip
    assert (answer.margin_deg, answer.findings, answer.contact) == (None, {}, None)
    assert answer.reason == "The contact model has no answer: no stable pose at the start."
    closed = assess(tall, at(30, p=0.12), **sure(acceleration=-9.8), model="closed-form")
    assert (closed.verdict, closed.falls_over) == ("no-go", "nose")


def doubtful(com=0.001, height=0.0007, length=0.0007):
    doubts = Uncertainty(com_from_front=com, com_height=height, flat_length=length)
    return KENAF.model_copy(update={"uncertainty": doubts})


def test_certain_inputs_have_no_probability():
    answer = assess(KENAF, at(50), **sure())
    assert answer.failure_probability is None
    assert {one.probability for one in answer.findings.values()} == {None}
    assert answer.margin_interval_deg is None


def test_the_centroids_doubt_is_the_formulas():
    """docs/theory/margin.md: d theta_sup/dC_L = -C_N/(x^2 + C_N^2); 1 % is 2.326 sigma off."""
    answer = assess(doubtful(com=0.001, height=0.0, length=0.0), at(50), **sure())
    sigma = 0.001 * 0.071 / (0.124**2 + 0.071**2)
    margin = math.degrees(math.radians(10.2050) - 2.3263 * sigma)
    # deg: one sample of 2048 lies 0.03 sigma from the next one there, sigma is 0.2 deg; and the
    # second order, (2.3 sigma)^2 times a bend of 1 per rad
    assert answer.margin_deg == pytest.approx(margin, abs=0.02)
    low, high = answer.margin_interval_deg
    assert high - low == pytest.approx(math.degrees(2 * 1.96 * sigma), abs=0.05)
    assert answer.findings["tip_downhill"].probability == 0.0


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("direction", ["up", "down"])
def test_uncertain_margins_are_the_closed_forms(direction, facing):
    """On a flight of known steps the criterion is the closed form, sample by sample."""
    stairs = at(30).model_copy(
        update={"uncertainty": StairsUncertainty(angle=0.003, nosing_spacing=0.0003)}
    )
    surface = Surface.of_friction(1.2, uncertainty=0.02)
    question = Question.in_one_posture(
        doubtful(), stairs, surface=surface, direction=direction, facing=facing, theta_d=0.0,
        theta_M=0.0,
    )  # fmt: skip
    contact, closed = (
        answer_to(question.changed(model=model)) for model in ("contact", "closed-form")
    )
    for mode in ("tip_downhill", "tip_uphill"):
        assert contact.margins_deg[mode] == pytest.approx(closed.margins_deg[mode], abs=1e-9)
        mine, theirs = contact.findings[mode], closed.findings[mode]
        assert mine.probability == theirs.probability
    # entering asks for a little more friction than the flight
    assert contact.failure_probability == pytest.approx(closed.failure_probability, abs=0.005)


def test_a_doubt_that_reaches_past_two_nosings():
    """2 p = 440 mm of 470 mm, known to 10 mm: past p = L/2 the criterion's formula goes on."""
    robot = doubtful(com=0.0, height=0.0, length=0.010)
    answer = assess(robot, at(30, p=0.220), **sure(risk=0.001))
    tip = answer.findings["tip_downhill"]
    # by hand: 3.09 sigma lie beyond a risk of 0.001
    assert tip.margin == pytest.approx(math.degrees(math.atan2(23.1, 71)) - 30, abs=0.5)


def test_long_flights_are_driven_on_what_repeats():
    few, many = (assess(KENAF, at(50, steps=n), **sure()) for n in (LONG_FLIGHT, 10_000))
    assert few.verdict == many.verdict == "go"
    assert few.margin_deg == many.margin_deg
    assert any(f"{LONG_FLIGHT} of them are driven" in note for note in many.notes)
    assert few.findings == many.findings


def test_where_no_friction_is_enough_the_answer_says_null():
    """JSON has no infinity. Rare on real stairs, so the requirement is made."""
    question = Question.in_one_posture(KENAF, at(40), **sure(friction=1.0))
    driven = traverse_of(question)
    enter, *others = driven.phases
    vars(driven)["phases"] = (replace(enter, required_friction=math.inf), *others)
    answer = judged(question, findings_of(question, Basis(question, driven)))
    assert answer.contact.phases[0].required_friction is None
    assert (answer.verdict, answer.governs) == ("no-go", "slides_down")
    assert answer.required_friction is None
    # by hand: atan(1) less a right angle
    assert answer.findings["slides_down"].margin == pytest.approx(45 - 90, abs=1e-9)
    assert "Infinity" not in answer.to_json()
    assert "no friction is enough" in answer.details()
    assert answer.reason == ("Friction decides (enter, step 1): none is enough, 1.00 is stated.")


def test_json_holds_no_nan():
    answer = assess(WITH_GAUGE, at(61.5), **sure(), yaw=0.1)
    assert json.loads(answer.to_json())["question"]["yaw"] == 0.1
    assert type(answer).from_json(answer.to_json()) == answer


def test_a_yaw_needs_the_gauge_and_the_contact_model():
    with pytest.raises(InputError, match=r"'kenaf': track\.gauge is not known"):
        assess(KENAF, at(50), **sure(), yaw=0.1)
    with pytest.raises(InputError, match="closed form knows no yaw"):
        assess(WITH_GAUGE, at(50), **sure(), yaw=0.1, model="closed-form")
    with pytest.raises(InputError, match="yaw = 2 rad is not within"):
        assess(WITH_GAUGE, at(50), **sure(), yaw=2.0)
    assert any("track.gauge" in note for note in assess(KENAF, at(50), **sure()).notes)


def test_yaw_limit_is_where_the_margin_ends():
    question = Question.in_one_posture(WITH_GAUGE, at(50), **sure(speed=1e-6))
    limit = yaw_limit(question, question.flight)
    before, after = margins_of(question, question.flight, limit + np.array([-0.01, 0.01]))[..., 0].T
    assert (before > 0).all()
    assert not (after > 0).all()
    assert assess(WITH_GAUGE, at(50), **sure(), yaw=limit - 0.02).margin_deg > 0
    after = assess(WITH_GAUGE, at(50), **sure(speed=1e-6), yaw=limit + 0.02)
    assert after.verdict != "go"
    assert after.support_polygon.yaw_limit_deg == pytest.approx(math.degrees(limit), abs=1e-6)


def test_a_tall_narrow_robot_tips_sideways():
    """By hand: tan(theta) sin(psi) = gauge/(2 C_N): 30 deg of yaw on 45 deg with gauge = C_N."""
    narrow = Robot(
        name="narrow",
        com_from_front=0.8,
        com_height=0.3,
        track=Track(flat_length=2.0, front_radius=0.1, rear_radius=0.1, gauge=0.3),
    )
    question = Question.in_one_posture(
        narrow, at(45, p=0.15, steps=20), friction=2.0, theta_d=0.0, theta_M=0.0
    )
    flight = question.flight
    _, _, sideways = margins_of(question, flight, np.array([math.radians(30)]))[:, 0]
    assert sideways[0] == pytest.approx(0.0, abs=1e-12)
    assert math.degrees(yaw_limit(question, flight)) < 30.0


@pytest.mark.parametrize("risk", fast_and_slow(5e-3, 1e-3))
def test_a_small_risk_takes_more_samples_at_a_yaw_too(risk):
    doubts = Uncertainty(com_height=0.004)
    robot = Robot.named("absolem").model_copy(update={"uncertainty": doubts})
    answer = assess(robot, "ibc", flippers="flat", friction=1.5, yaw=0.1, risk=risk)
    assert answer.margin_interval_deg[0] < answer.margin_interval_deg[1]
