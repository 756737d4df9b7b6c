"""Nosings that differ from left to right, in a question and its answer."""

import math

import numpy as np
import pytest

import kaidan
from kaidan import InputError, Robot, Stairs
from kaidan.readers.flight import FlightEstimate, independent
from one_posture import assess

MANNER = {"friction": 2.0, "theta_d": 0.0, "theta_M": 0.0}
BOX = Robot(
    name="box", mass=30.0, com_from_front=0.6, com_height=0.3,
    track={"flat_length": 1.2, "front_radius": 0.1, "rear_radius": 0.1, "gauge": 0.4},
)  # fmt: skip
STEPS = {"rises": (0.15,) * 12, "goings": (0.3,) * 11}


def answer(**across):
    return assess(BOX, Stairs(**STEPS, **across), **MANNER)


def test_even_nosings_are_judged_in_the_plane():
    assert "twist" not in answer().findings
    assert "twist" not in answer(cross_slopes=(0.0,)).findings


@pytest.mark.parametrize("degrees", [5.0, 19.9])
def test_nosings_that_slope_across(degrees):
    """By hand: atan(0.2 / 0.3) = 33.7 deg, less a roll of atan(tan(c) cos(26.57 deg)).

    Over the edge downhill it tips a little later than in the plane.
    """
    found = answer(cross_slopes=(math.radians(degrees),))
    roll = math.degrees(math.atan(math.tan(math.radians(degrees)) * math.cos(math.atan(0.5))))
    side = math.degrees(math.atan2(0.2, 0.3)) - roll
    assert found.findings["twist"].margin <= side + 1e-9
    assert found.findings["twist"].margin > 0
    assert any(f"it rolls by up to {roll:.1f} deg" in note for note in found.notes)
    assert kaidan.Assessment.from_json(found.to_json()) == found


def test_a_roll_that_tips_it_is_no_go():
    """By hand: 19.9 deg across roll it by 19.65; it tips at 21.8 deg, 18.4 with C_N 0.6 m."""
    for height, verdict in ((0.5, True), (0.6, False)):
        tall = BOX.model_copy(update={"com_height": height})
        flight = Stairs(rises=(0.05,) * 12, goings=(0.3,) * 11, cross_slopes=(0.3473,))
        found = assess(tall, flight, **MANNER)
        assert (found.findings["twist"].margin > 0) is verdict
    assert found.verdict == "no-go"
    assert found.governs == "twist"
    assert "nosings that differ from left to right" in found.reason


def test_a_yaw_on_steps_that_differ():
    rises = (0.15, 0.16, 0.14) * 4
    flight = Stairs(rises=rises, goings=(0.3,) * 11)
    found = assess(BOX, flight, yaw="10deg", **MANNER)
    assert found.findings["twist"].margin > 0
    straight = assess(BOX, flight, **MANNER)
    assert "twist" not in straight.findings


def test_without_a_gauge_roll_is_said_to_be_open():
    narrow = BOX.model_copy(update={"track": BOX.track.model_copy(update={"gauge": None})})
    found = assess(narrow, Stairs(**STEPS, cross_slopes=(0.05,)), **MANNER)
    assert "twist" not in found.findings
    assert any(note.endswith("is not known: roll is not judged.") for note in found.notes)


def test_a_robot_longer_than_the_flight_is_said_to_be_open():
    found = assess(BOX, Stairs(rises=(0.15,) * 3, goings=(0.3,) * 2, skews=(0.1,)), **MANNER)
    assert "twist" not in found.findings
    assert any("nowhere do both tracks have two of them" in note for note in found.notes)


def test_other_counts_than_of_risers_are_refused():
    with pytest.raises(InputError) as raised:
        Stairs(**STEPS, skews=(0.1, 0.2))
    assert str(raised.value) == (
        "stairs: skews has 2 values; allowed are one for all nosings or one for each of the 12"
    )


def test_segments_of_a_file_become_slopes_across_and_skews():
    """By hand: 1 m wide nosings, left ends 30 mm higher and 20 mm ahead: 1.72 and 1.15 deg."""
    number = np.arange(6.0)
    right = np.column_stack([0.3 * number, np.zeros(6), 0.15 * (number + 1)])
    left = right + np.array([0.02, 1.0, 0.03])

    def sheet(sigma):
        return FlightEstimate(
            left=left, right=right, heading=0.0, gravity=0.0, scale=0.0, floor=0.0,
            covariance=independent(np.tile(np.eye(2) * sigma**2, (6, 1, 1))),
        ).stairs()  # fmt: skip

    assert sheet(0.001).cross_slopes == pytest.approx((math.atan(0.03),) * 6)
    assert sheet(0.001).skews == pytest.approx((math.atan(0.02),) * 6)
    assert sheet(0.006).cross_slopes == sheet(0.006).skews == ()  # within 3 of 12 mm a metre
