"""Verdicts of the closed form in words, which end falls, and what slips."""

from math import atan, cos, degrees, radians, tan

import pytest

from amounts import fast_and_slow
from closed_form_cases import ANGLE, BARE, GRIP, G, assess, flight, kenaf, robot
from kaidan import Surface

# The verdict


@pytest.mark.parametrize(
    ("angle", "verdict"), [(55.00, "go"), (55.01, "unsure"), (60.20, "unsure"), (60.21, "no-go")]
)
def test_verdict_with_unmeasured_allowances(angle, verdict):
    # hand: 60.2054 - 2 x 2.6 = 55.0054; GO with both subtracted, UNSURE if they may be zero
    assert kenaf(angle, 0.150).verdict == verdict


@pytest.mark.parametrize(("angle", "verdict"), [(60.20, "go"), (60.21, "no-go")])
def test_verdict_with_measured_allowances(angle, verdict):
    assert kenaf(angle, 0.150, **BARE).verdict == verdict


def test_verdict_where_only_the_friction_is_in_doubt():
    # hand: tan 35 deg = 0.700, atan 0.6 = 30.96 deg, atan 1 = 45 deg; Kenaf does not tip there
    def ground(low, high):
        return {"surface": Surface(friction_low=low, friction_high=high), "friction": None}

    wide = kenaf(35, 0.150, **ground(0.6, 1.0))
    assert (wide.verdict, wide.governs) == ("unsure", "slides_down")
    assert wide.margin_deg == pytest.approx(degrees(atan(0.6)) - 35, **ANGLE)
    assert wide.margin_best_deg == pytest.approx(45 - 35, **ANGLE)
    assert wide.friction == (0.6, 1.0)
    assert kenaf(35, 0.150, **ground(0.71, 1.0)).verdict == "go"
    assert kenaf(35, 0.150, **ground(0.6, 0.69)).verdict == "no-go"


def test_unknown_friction_is_at_best_unsure():
    answer = kenaf(30, 0.150, friction=None)
    assert (answer.verdict, answer.governs) == ("unsure", "friction_unknown")
    # hand: the margin is the tip's: 60.205 - 5.2 - 30
    assert answer.margin_deg == pytest.approx(degrees(atan(124 / 71)) - 35.2, **ANGLE)
    assert answer.friction is answer.question.surface is None
    assert answer.margins_deg["slides_down"] is answer.margins_deg["slides_up"] is None
    found = answer.closed_form
    assert found.a_slides_down is found.a_slides_up is found.paper.a_S is None
    assert found.a_max == found.a_tip_downhill
    assert found.a_min == found.a_tip_uphill
    assert kenaf(58, 0.150, friction=None).verdict == "unsure"  # tips only in the worst case
    assert kenaf(61, 0.150, friction=None).verdict == "no-go"
    # tan 30 deg, and a little more
    assert answer.required_friction == pytest.approx(tan(radians(30)), rel=1e-12)
    assert answer.what_would_help[0].change == "Make sure of a friction of 0.59 or more"
    assert answer.what_would_help[0].verdict == "go"


@pytest.mark.parametrize("every", fast_and_slow(5, 1))
@pytest.mark.parametrize("p", [0.150, 0.200, 0.220])
@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_the_margin_never_disagrees_with_the_verdict(p, direction, facing, every):
    for angle in range(8, 70, every):
        for question in ({}, BARE, {"friction": 0.7}, {"acceleration": -1.0}):
            answer = kenaf(angle, p, direction=direction, facing=facing, **question)
            if answer.verdict == "go":
                assert answer.margin_deg > 0
            elif answer.verdict == "no-go":
                assert answer.margin_deg <= 0
            assert answer.margin_deg == min(
                margin for margin in answer.margins_deg.values() if margin is not None
            )
            assert answer.margin_best_deg >= answer.margin_deg


@pytest.mark.parametrize(
    ("question", "reason"),
    [
        ({}, "It holds with 15.0 deg to spare; nearest is tipping over its downhill end."),
        ({"direction": "down"}, "It tips over its downhill end, 9.7 deg beyond the limit."),
        ({"friction": 0.5}, "Friction decides: 0.84 is required, 0.50 is stated."),
        ({"friction": (0.5, 1.0)}, "Friction decides: 0.84 is required, 0.50 to 1.00 is stated."),
        ({"friction": None}, "Friction decides: 0.84 is required, none is stated."),
        (
            {"angle": 57},
            "The margin against tipping over its downhill end is -2.0 to +3.2 deg, by the ranges "
            "of what is not measured.",
        ),
    ],
)
def test_the_reason_in_one_sentence(question, reason):
    # hand: 60.205 - 45.2; 32.939 - 42.6; tan 40 = 0.839; 60.205 - 62.2 and 60.205 - 57
    question = {"angle": 40} | question
    assert kenaf(question.pop("angle"), 0.150, **question).reason == reason


def test_every_doubt_is_reported_with_its_own_margin():
    # hand: nose first down 40 deg it tips 9.66 deg beyond the limit; atan 0.4 is 18.2 deg short
    answer = kenaf(40, 0.150, direction="down", friction=0.4)
    assert (answer.governs, answer.doubts) == ("slides_down", ("slides_down", "tip_downhill"))
    assert answer.reason == "Friction decides: 0.84 is required, 0.40 is stated."
    assert "It tips over its downhill end, 9.7 deg beyond the limit." in answer.notes
    # hand: 58 + 5.2 - 60.205 = 2.99 deg beyond, 2.21 deg to spare at best
    answer = kenaf(58, 0.150, friction=1.5)
    assert (answer.verdict, answer.governs) == ("no-go", "slides_down")
    assert (
        "The margin against tipping over its downhill end is -3.0 to +2.2 deg, by the ranges of "
        "what is not measured."
    ) in answer.notes


def test_what_may_hold_does_not_govern_a_no_go():
    # hand: atan 1.58 = 57.67 deg, 0.33 deg short of 58; the tip is 2.99 deg short, or 2.21 over
    answer = kenaf(58, 0.150, friction=1.58)
    assert (answer.verdict, answer.governs) == ("no-go", "slides_down")
    assert answer.doubts == ("slides_down", "tip_downhill")
    assert answer.margin_deg == answer.findings["tip_downhill"].margin


def test_on_the_limit_it_is_no_go():
    # hand: tan(45 deg) = 1 = (0.5 - 0.15 - 0.25) / 0.1, and a friction of 1 slips there too
    for friction in (GRIP, 1.0):
        answer = assess(robot(), flight(45, 0.15), friction=friction, **BARE)
        assert answer.verdict == "no-go"
        assert answer.margin_deg == pytest.approx(0, abs=1e-12)


# Which end falls, which direction


@pytest.mark.parametrize(
    ("direction", "facing", "nose_up"),
    [
        ("up", "nose-first", True),
        ("up", "tail-first", False),
        ("down", "nose-first", False),
        ("down", "tail-first", True),
    ],
)
@pytest.mark.parametrize("by", ["slope", "acceleration"])
def test_the_end_it_falls_over(direction, facing, nose_up, by):
    # hand: centroid 0.2 m behind the uphill end, p = 0.24: holds from atan(0.4) to atan(0.6)
    of_kind = robot(com_from_front=0.2 if nose_up else 0.3)

    def ask(angle, a):
        return assess(
            of_kind,
            flight(angle, 0.24),
            friction=GRIP,
            direction=direction,
            facing=facing,
            acceleration=a,
            **BARE,
        )

    middle = ask(26, 0.0)
    assert (middle.verdict, middle.falls_over) == ("go", None)
    assert middle.closed_form.margin_angle_deg == pytest.approx(degrees(atan(0.6)), **ANGLE)
    assert middle.closed_form.lower_angle_deg == pytest.approx(degrees(atan(0.4)), **ANGLE)
    downhill, uphill = (ask(40, 0.0), ask(10, 0.0)) if by == "slope" else (ask(26, 2), ask(26, -2))
    assert (downhill.verdict, downhill.governs) == ("no-go", "tip_downhill")
    assert downhill.falls_over == ("tail" if nose_up else "nose")
    assert (uphill.verdict, uphill.governs) == ("no-go", "tip_uphill")
    assert uphill.falls_over == ("nose" if nose_up else "tail")


def test_slipping_is_no_fall():
    answer = kenaf(30, 0.150, friction=0.3)
    assert (answer.verdict, answer.governs, answer.closed_form.area) == (
        "no-go",
        "slides_down",
        "A",
    )
    assert answer.falls_over is None
    # hand: braking at -9 m/s^2 on 20 deg needs |tan 20 - 9 / (g cos 20)| = 0.613 downhill
    answer = kenaf(20, 0.150, friction=0.6, acceleration=-9.0, **BARE)
    assert (answer.verdict, answer.governs) == ("no-go", "slides_up")
    assert answer.closed_form.area == "DOWNHILL_SLIP"
    assert answer.required_friction == pytest.approx(
        abs(tan(radians(20)) - 9 / (G * cos(radians(20)))), rel=1e-12
    )


def test_exit_codes():
    assert kenaf(30, 0.150).exit_code == 0
    assert kenaf(58, 0.150).exit_code == 5
    assert kenaf(62, 0.150).exit_code == 1
    assert assess("kenaf", "ibc").exit_code == 3


def test_notes_say_what_was_assumed():
    notes = " ".join(kenaf(30, 0.150, friction=None).notes)
    assert "not entering or landing" in notes
    assert "theta_d is not measured" in notes
    assert "theta_M is not measured" in notes
    assert "No friction was stated, so no GO can be given." in notes
    measured = " ".join(kenaf(30, 0.150, **BARE).notes)
    assert "not measured" not in measured
