"""What would help, by the closed form: the same question with something changed."""

from math import atan, degrees

import pytest

from closed_form_cases import ANGLE, GRIP, assess, flight, kenaf, robot
from kaidan import Payload


def test_go_down_in_reverse():
    # hand: nose first 32.9 deg, tail first 60.2 deg
    answer = kenaf(45, 0.150, direction="down")
    assert answer.verdict == "no-go"
    best = answer.what_would_help[0]
    assert (best.change, best.verdict) == ("Go down tail first", "go")
    assert best.margin_deg == pytest.approx(degrees(atan(124 / 71)) - 47.6, **ANGLE)


@pytest.mark.parametrize(
    ("asked", "again"),
    [
        (
            {"friction": 1.5, "acceleration": 1.5, "direction": "down"},
            {
                "Go down tail first": {"facing": "tail-first"},
                "Keep the speed constant": {"acceleration": 0.0},
            },
        ),
        # hand: tan 42 deg + 1.5 / (g cos 42 deg) = 1.106
        (
            {"friction": 0.8, "acceleration": 1.5},
            {
                "Keep the speed constant": {"acceleration": 0.0},
                "A surface with a friction of 1.12 or more": {"friction": 1.12},
            },
        ),
    ],
)
def test_advice_is_the_same_question_asked_again(asked, again):
    changes = {each.change: each for each in kenaf(42, 0.150, **asked).what_would_help}
    assert set(again) <= set(changes)
    for text, changed in again.items():
        found = kenaf(42, 0.150, **(asked | changed))
        assert found.verdict == changes[text].verdict
        assert found.margin_deg == pytest.approx(changes[text].margin_deg, **ANGLE)


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize("load", [0.0, 5.0])
def test_moving_the_centroid_as_told_helps(facing, load):
    payload = Payload(mass=load, from_front=0.25, height=0.1)
    question = {"friction": GRIP, "facing": facing}
    answer = assess(robot(), flight(42, 0.15), payload=payload, **question)
    assert answer.verdict != "go"
    told = next(c for c in answer.what_would_help if c.change.startswith("Move the centroid"))
    mm = float(told.change.split()[3])
    end = "front" if facing == "nose-first" else "rear"
    assert f"towards the {end}" in told.change
    shift = (mm if end == "rear" else -mm) / 1e3
    # the robot without its payload moves by more, the payload by more still
    moved = robot(com_from_front=0.25 + shift * (10 + load) / 10)
    after = assess(moved, flight(42, 0.15), payload=payload, **question)
    assert after.verdict == told.verdict == "go"
    assert after.margin_deg == pytest.approx(told.margin_deg, **ANGLE)
    if load:
        travel = float(told.change.split("payload by ")[1].split()[0])
        assert travel == pytest.approx(mm * 15 / 5, abs=0.5)  # to a whole millimetre
        by_load = Payload(mass=load, from_front=0.25 + shift * 15 / 5, height=0.1)
        after = assess(robot(), flight(42, 0.15), payload=by_load, **question)
        assert after.verdict == "go"


def test_no_advice_for_a_go_and_only_better_advice_else():
    assert kenaf(40, 0.150).what_would_help == ()
    rank = ("go", "unsure", "no-go", "outside-model")
    for angle in (35, 48, 56, 58, 62, 70, 80):
        for friction in (0.4, GRIP, None):
            answer = kenaf(angle, 0.200, friction=friction, direction="down")
            for change in answer.what_would_help:
                worse = rank.index(change.verdict) - rank.index(answer.verdict)
                assert worse < 0 or (worse == 0 and change.margin_deg > answer.margin_deg)


def test_laying_the_flippers_flat_helps():
    answer = assess("absolem", "ibc", friction=1.5)
    assert answer.verdict == "outside-model"
    told = answer.what_would_help[0]
    assert (told.change, told.verdict) == ("Lay the flippers flat, in line with the track", "go")
    flat = assess("absolem", "ibc", friction=1.5, flippers="flat")
    assert told.margin_deg == pytest.approx(flat.margin_deg, **ANGLE)
    steep = assess("absolem", flight(60, 0.3), friction=5.0, flippers="flat")
    assert not any("flippers" in change.change for change in steep.what_would_help)


def test_measuring_the_allowances_helps():
    answer = kenaf(58, 0.150)
    told = next(c for c in answer.what_would_help if c.change.startswith("Measure"))
    assert told.change == "Measure theta_d and theta_M: at best, if they are zero"
    assert told.verdict == "go"
    assert told.margin_deg == pytest.approx(degrees(atan(124 / 71)) - 58, **ANGLE)


def test_no_staircase_is_too_steep_to_be_judged():
    # friction of tan 80 deg = 5.7 is beyond every sheet: no advice, but no exception either
    for friction in (0.5, GRIP, None):
        assert kenaf(80, 0.150, friction=friction).verdict == "no-go"
    # advice that would put the centroid out of the robot is no advice
    odd = robot(com_from_front=0.45, com_height=0.25)
    answer = assess(odd, flight(20, 0.2), friction=0.3, acceleration=0.4, facing="tail-first")
    assert answer.verdict == "no-go"
