"""Answers of the support polygon: both tracks' contacts on a regular flight, at any yaw.

Its margins against contacts laid out in space are in tests/agreement/test_support_polygon.py.
"""

import math
from functools import partial

import pytest

import kaidan
import one_posture
from closed_form_cases import ANGLE, BARE, GRIP, G, flight, robot
from kaidan import InputError, Profile, Stairs, Surface
from kaidan.robot import FlipperPair, Track, Uncertainty

assess = partial(one_posture.assess, model="support-polygon")
GAUGED = robot(track={"flat_length": 0.5, "gauge": 0.3})


def gauged(**changes):
    return robot(track={"flat_length": 0.5, "gauge": 0.3}, **changes)


@pytest.mark.parametrize(
    "manner",
    [
        {"friction": GRIP},
        {"friction": 0.5},
        {"friction": None},
        {"friction": (0.5, 1.0), **BARE},
        {"friction": GRIP, "direction": "down"},
        {"friction": GRIP, "facing": "tail-first", "acceleration": -1.0},
    ],
)
@pytest.mark.parametrize("angle", [20, 35, 45])
def test_straight_on_it_is_the_closed_form(angle, manner):
    # both tracks meet and leave every nosing together
    ours = assess(GAUGED, flight(angle, 0.15), **manner)
    theirs = kaidan.assess(GAUGED, flight(angle, 0.15), **manner, model="closed-form")
    assert ours.verdict == theirs.verdict
    for mode in ("tip_downhill", "tip_uphill", "drive"):
        found, expected = ours.findings[mode], theirs.findings[mode]
        assert found.margin == (expected.margin and pytest.approx(expected.margin, **ANGLE))
        assert found.margin_best == (
            expected.margin_best and pytest.approx(expected.margin_best, **ANGLE)
        )
    assert ours.required_friction == pytest.approx(theirs.required_friction, rel=1e-12)
    assert ours.findings["slides_down"].holds is theirs.findings["slides_down"].holds


def test_at_constant_speed_the_required_friction_depends_on_no_yaw():
    # hand: along and across the track together it is the slope's, tan 30 deg
    for yaw in (0.0, 0.3, -0.3, 1.0):
        answer = assess(GAUGED, flight(30, 0.15), friction=1.0, yaw=yaw)
        assert answer.required_friction == pytest.approx(math.tan(math.radians(30)), rel=1e-12)
        assert answer.margins_deg["slides_down"] == pytest.approx(45 - 30, **ANGLE)


def test_friction_under_an_acceleration_at_a_yaw():
    # hand: along tan 30 cos 0.3 + 0.5 / (g cos 30), across tan 30 sin 0.3
    theta = math.radians(30)
    along = math.tan(theta) * math.cos(0.3) + 0.5 / (G * math.cos(theta))
    needed = math.hypot(along, math.tan(theta) * math.sin(0.3))
    answer = assess(GAUGED, flight(30, 0.15), friction=1.0, yaw=0.3, acceleration=0.5)
    assert answer.required_friction == pytest.approx(needed, rel=1e-12)
    braking = assess(GAUGED, flight(30, 0.15), friction=1.0, yaw=0.3, acceleration=-6.0)
    assert "slides_up" in braking.findings


def test_left_and_right_are_alike():
    left, right = (assess(GAUGED, flight(40, 0.15), friction=GRIP, yaw=yaw) for yaw in (0.4, -0.4))
    assert left.findings == right.findings
    assert left.support_polygon == right.support_polygon


def test_a_tall_narrow_robot_tips_over_its_side():
    # hand: tan(theta) sin(psi) = gauge / (2 C_N): with gauge = C_N and 30 deg of yaw at 45 deg
    tall = robot(
        com_from_front=0.8, com_height=0.3, track={"flat_length": 2.0, "gauge": 0.3}
    )  # fmt: skip
    psi = math.radians(30)
    answer = assess(tall, flight(44, 0.15, steps=20), friction=GRIP, yaw=psi, **BARE)
    assert answer.margins_deg["tip_sideways"] == pytest.approx(1.0, **ANGLE)
    answer = assess(tall, flight(46, 0.15, steps=20), friction=GRIP, yaw=psi, **BARE)
    assert (answer.verdict, answer.governs) == ("no-go", "tip_sideways")
    assert answer.margin_deg == pytest.approx(-1.0, **ANGLE)
    assert answer.reason == "It tips over its side, 1.0 deg beyond the limit (traverse)."
    assert answer.falls_over is None
    # theta_d leans the robot that way too; the grousers hold along the track alone
    answer = assess(tall, flight(44, 0.15, steps=20), friction=GRIP, yaw=psi, theta_d=0.01)
    assert answer.margins_deg["tip_sideways"] == pytest.approx(1.0 - math.degrees(0.01), **ANGLE)


def test_the_drive_climbs_the_slope_along_the_heading():
    # hand: 10 kg and 49.03325 N are half the weight, 30 deg; at 60 deg of yaw sin 40 cos 60 = 0.32
    strong = gauged(drive={"max_traction": 10 * G / 2})
    straight = assess(strong, flight(40, 0.15), friction=GRIP, **BARE)
    assert straight.margins_deg["drive"] == pytest.approx(30 - 40, **ANGLE)
    assert (straight.verdict, straight.governs) == ("no-go", "drive")
    psi = math.radians(60)
    inclination = math.degrees(math.asin(math.sin(math.radians(40)) * math.cos(psi)))
    aslant = assess(strong, flight(40, 0.12), friction=GRIP, yaw=psi, **BARE)
    assert aslant.margins_deg["drive"] == pytest.approx(30 - inclination, **ANGLE)


def test_little_energy_is_unsure():
    # hand: v^2 / 2g of 0.5 m/s is 12.7 mm, of which a sudden stop leaves 45 % to a rotation: the
    # centroid is 0.1 m high; half the inertia of an even box of 0.5 by 0.2 m
    answer = assess(GAUGED, flight(35, 0.15), friction=GRIP, speed=0.5, **BARE)
    energy = answer.support_polygon.energy_margin_mm
    height = 1e3 * 0.25 / (2 * G) * 0.01 / (0.01 + (0.5**2 + 0.2**2) / 24)
    assert (answer.verdict, answer.governs) == ("unsure", "energy")
    assert answer.findings["energy"].margin == pytest.approx(energy - height, rel=1e-9)
    assert answer.reason == (
        f"The energy margin of {energy:.2f} mm is below the 5.77 mm of a sudden stop or start: the "
        "robot may rock (traverse)."
    )


def test_yaw_limit_is_where_the_verdict_ends():
    stairs = flight(35, 0.15)
    limit = assess(GAUGED, stairs, friction=GRIP).support_polygon.yaw_limit_deg
    for by, holds in ((-0.01, True), (0.01, False)):
        answer = assess(GAUGED, stairs, friction=GRIP, yaw=math.radians(limit + by))
        assert (answer.verdict == "go") is holds
        assert answer.support_polygon.yaw_limit_deg == limit  # whichever yaw is asked about
    long = robot(com_from_front=0.5, track={"flat_length": 1.0, "gauge": 0.3})
    gentle = assess(long, flight(26, 0.05, steps=30), friction=GRIP)
    assert (gentle.verdict, gentle.support_polygon.yaw_limit_deg) == ("go", None)
    steep = assess(GAUGED, flight(50, 0.15), friction=GRIP)
    assert (steep.verdict, steep.support_polygon.yaw_limit_deg) == ("no-go", None)


def test_uncertain_inputs_spread_its_margins():
    doubtful = gauged(uncertainty=Uncertainty(com_from_front=0.005).model_dump())
    straight = {"friction": GRIP, **BARE}
    ours = assess(doubtful, flight(43, 0.15), **straight)
    theirs = kaidan.assess(doubtful, flight(43, 0.15), **straight, model="closed-form")
    assert ours.margin_deg == pytest.approx(theirs.margin_deg, **ANGLE)
    assert ours.failure_probability == pytest.approx(theirs.failure_probability, abs=1e-12)
    rough = assess(GAUGED, flight(30, 0.15), surface=Surface.of_friction(0.65, 0.05), yaw=0.2)
    # hand: 0.65 - tan 30 deg = 0.0726, 1.45 sigma: 7.3 %
    assert rough.findings["slides_down"].probability == pytest.approx(0.0731, abs=1e-3)
    assert (rough.verdict, rough.governs) == ("no-go", "slides_down")


def test_it_says_that_it_judges_the_flight_alone():
    answer = assess(GAUGED, flight(30, 0.15), friction=GRIP, yaw=0.1)
    assert (
        "The support polygon judges the traverse of the regular flight, not entering or landing."
    ) in answer.notes
    assert answer.contact is answer.closed_form is None


FLIPPERS = FlipperPair(length=0.3, root_radius=0.06, tip_radius=0.04, pivot_height=0.06)
GAPPED = Track(flat_length=0.5, gauge=0.3, gap=0.1)


@pytest.mark.parametrize(
    ("tracked", "stairs", "flippers", "why"),
    [
        (gauged(), flight(40, 0.15, steps=3), "stowed", "the flight's 3 nosings are fewer than"),
        (
            gauged(),
            Stairs(rises=(0.1, 0.1, 0.11, 0.1), goings=(0.12,) * 3),
            "stowed",
            "the steps differ by 10.0 mm",
        ),
        (
            gauged(front_flippers=FLIPPERS.model_dump()),
            flight(30, 0.15),
            "-30deg",
            "a flipper reaches below",
        ),
        (robot(track=GAPPED.model_dump()), flight(30, 0.15), "stowed", "100 mm in the middle of"),
        (gauged(), [flight(30, 0.15)] * 2, "stowed", "the terrain is no single flight of stairs"),
        (
            gauged(),
            Profile.of_points([(0.0, 0.0), (4.0, 0.0)]),
            "stowed",
            "the terrain is no single flight of stairs",
        ),
    ],
)
def test_where_it_does_not_apply_it_says_so(tracked, stairs, flippers, why):
    answer = assess(tracked, stairs, friction=GRIP, flippers=flippers)
    assert (answer.verdict, answer.governs) == ("outside-model", "outside_model")
    assert answer.reason.startswith(f"The support polygon has no answer: {why}")


def test_it_needs_the_distance_of_the_tracks():
    with pytest.raises(InputError, match=r"'round': track\.gauge is not known"):
        assess(robot(), flight(30, 0.15), friction=GRIP)
