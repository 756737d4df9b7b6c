"""What the drive can do, as the closed form judges it."""

import math
from math import cos, degrees, radians, sin

import pytest

from closed_form_cases import BARE, GRIP, G, assess, flight, robot
from kaidan.robot import Drive


def driven(angle, direction="up", speed=None, a=0.0, **drive):
    tracks = robot(drive=Drive(**drive).model_dump(), com_height=0.02)
    return assess(
        tracks,
        flight(angle, 0.12),
        friction=5.0,
        direction=direction,
        speed=speed,
        acceleration=a,
        **BARE,
    )


def test_traction_limits_the_slope():
    # hand: 49.03325 N is half the weight: 30 deg
    for angle, verdict in ((29.9, "go"), (30.1, "no-go")):
        answer = driven(angle, max_traction=10 * G / 2)
        assert answer.verdict == verdict
        assert answer.governs == "drive"
        assert answer.margins_deg["drive"] == pytest.approx(30 - angle, abs=1e-9)
    assert driven(29, max_traction=10 * G / 2, a=0.2).verdict == "no-go"
    assert driven(20).margins_deg["drive"] is None


def test_rolling_resistance_takes_traction_and_gives_it_back_downhill():
    # hand: sin 30 + 0.2 cos 30 = 0.673; going down sin 30 - 0.2 cos 30 = 0.327
    for direction, sign in (("up", 1), ("down", -1)):
        needed = 10 * G * (0.5 + sign * 0.2 * cos(radians(30)))
        for force, verdict in ((1.001 * needed, "go"), (0.999 * needed, "no-go")):
            answer = driven(30, direction, max_traction=force, rolling_resistance=0.2)
            assert answer.verdict == verdict, direction
        assert driven(30, direction, max_traction=needed, rolling_resistance=0.2).margins_deg[
            "drive"
        ] == pytest.approx(0, abs=1e-9)


def test_traction_of_the_weight_is_not_enough_where_the_tracks_resist():
    # hand: 1.05 of the weight; at 55 deg with c_rr 0.5 it takes 0.819 + 0.287 = 1.106
    assert sin(radians(55)) + 0.5 * cos(radians(55)) > 1.05
    answer = driven(55, max_traction=1.05 * 10 * G, rolling_resistance=0.5)
    assert (answer.verdict, answer.governs) == ("no-go", "drive")
    # limit: past sqrt(1 + c_rr^2) of the weight any slope will do
    answer = driven(55, max_traction=1.12 * 10 * G, rolling_resistance=0.5)
    assert answer.verdict == "go"
    assert answer.margins_deg["drive"] == pytest.approx(90 - 55, abs=1e-9)
    # limit: no slope at all where the force does not even bring the acceleration
    answer = driven(10, max_traction=5.0, a=3.0)
    assert answer.margins_deg["drive"] == pytest.approx(
        degrees(math.asin(0.5 / G - 3 / G)) - 10, abs=1e-9
    )
    assert driven(10, max_traction=1.0, rolling_resistance=0.5, a=9.8).verdict == "no-go"


def test_power_limits_the_traction_at_a_speed():
    # hand: 100 W x 0.5 / 0.5 m/s = 100 N > 10 g sin 30 = 49 N > 100 x 0.5 / 1.1
    known = {"max_power": 100.0, "efficiency": 0.5, "max_speed": 2.0}
    assert driven(30, speed=0.5, **known).verdict == "go"
    answer = driven(30, speed=1.1, **known)
    assert (answer.verdict, answer.governs) == ("no-go", "drive")
    unjudged = driven(30, **known)
    assert unjudged.margins_deg["drive"] is None
    assert any("takes the speed" in note for note in unjudged.notes)
    # what the drive can brake on the way down is another figure, which no sheet gives
    down = driven(30, "down", speed=1.1, **known)
    assert (down.verdict, down.margins_deg["drive"]) == ("go", None)
    # the smaller of both counts
    assert driven(30, speed=0.5, **known, max_traction=40.0).verdict == "no-go"


def test_a_drive_does_not_bring_a_robot_into_the_model():
    # hand: L is 0.5 m with a sigma of 6 mm, and below 2 p = 483.8 mm with Phi(-2.7) = 0.35 % or 7
    # of 2048 samples: less than the risk; whether it tips there is not known, so it counts as
    # failed; over its uphill end, 32 deg away whatever L is, it tips nowhere else
    tracks = robot(drive={"max_traction": 1e4}, uncertainty={"flat_length": 0.006}, com_height=0.02)
    answer = assess(tracks, flight(10, 0.2419), friction=GRIP, **BARE)
    probability = {key: each.probability for key, each in answer.findings.items()}
    assert probability["tip_uphill"] == 7 / 2048
    assert answer.failure_probability == probability["tip_downhill"] >= probability["tip_uphill"]
    assert probability["drive"] == 0.0
