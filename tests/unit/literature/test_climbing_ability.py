"""Conditions of climbing ability after Liu J. et al. 2005: each margin on its own."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kaidan.assessment import assess
from kaidan.errors import InputError
from kaidan.literature.climbing_ability import Name, climbing_conditions
from kaidan.robot import Drive, Payload, Robot, Track
from kaidan.terrain.stairs import Stairs

KENAF = Robot.named("kenaf")


def toy(**changes):
    sheet = {
        "name": "toy",
        "mass": 20.0,
        "com_from_front": 0.2,
        "com_height": 0.1,
        "track": Track(flat_length=0.6, front_radius=0.06, rear_radius=0.06),
    }
    return Robot(**(sheet | changes))


THREE_FOUR_FIVE = Stairs(rise=0.15, going=0.20, steps=8)  # p = 0.25, tan 0.75


def test_every_margin_by_hand():
    # hand: sin = 0.6, cos = 0.8, p = 0.25
    robot = toy(drive=Drive(max_traction=200.0, rolling_resistance=0.05))
    found = climbing_conditions(robot, THREE_FOUR_FIVE, friction=1.0)
    slope = math.atan(0.75)
    assert found["two-nosings"].margin == pytest.approx(0.1, abs=1e-15)
    assert found["no-tip-downhill"].margin == pytest.approx(math.atan(1.5) - slope, abs=1e-14)
    assert found["no-tip-uphill"].margin == pytest.approx(slope - math.atan(0.5), abs=1e-14)
    assert found["no-slip"].margin == pytest.approx(math.pi / 4 - slope, abs=1e-14)
    assert found["drive"].margin == pytest.approx(200 - 20 * 9.80665 * (0.6 + 0.04), abs=1e-9)
    assert found["landing"].margin == pytest.approx(0.6 - 0.2 - 0.075, abs=1e-14)
    # hand: riser above R: (C_L + R) mu^2 + R mu = l_c, 0.26 mu^2 + 0.06 mu = 0.4
    needed = (-0.06 + math.sqrt(0.06**2 + 4 * 0.26 * 0.4)) / (2 * 0.26)
    assert found["nose-up"].margin == pytest.approx(1.0 - needed, abs=1e-14)
    assert [each.name for each in found.conditions] == list(Name)


def test_the_centroid_over_the_first_step_by_hand():
    # hand: t = 1 solves t^3 + t = l_c / C_N for R = C_N = 0.1, l_c = 0.2: highest step 0.1
    robot = toy(com_from_front=0.4, track=Track(flat_length=0.6, front_radius=0.1, rear_radius=0.1))
    stairs = Stairs(rise=0.15, going=0.2, first_rise=0.08)
    found = climbing_conditions(robot, stairs, friction=1.0)["first-step"]
    assert found.margin == pytest.approx(0.02, abs=1e-14)
    assert found.step == 1


@pytest.mark.parametrize("acceleration", [0.0, 0.4, -0.6])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
@pytest.mark.parametrize(
    "stairs",
    [
        Stairs.inclined(angle=math.radians(50), nosing_spacing=0.15),
        Stairs.inclined(angle=math.radians(20), nosing_spacing=0.22),
        Stairs(rises=(0.1, 0.105, 0.1, 0.1), goings=(0.18, 0.18, 0.185)),
    ],
    ids=str,
)
def test_the_worst_condition_is_the_margin_of_assess(stairs, facing, acceleration):
    # agreement: the closed form without allowances; its margin is the smallest of these
    found = climbing_conditions(
        KENAF, stairs, friction=1.6, acceleration=acceleration, facing=facing
    )
    answer = assess(
        KENAF, stairs, friction=1.6, acceleration=acceleration, facing=facing,
        theta_d=(0.0, 0.0), theta_M=(0.0, 0.0), model="closed-form",
    )  # fmt: skip
    flight = [found[name] for name in ("no-tip-downhill", "no-tip-uphill", "no-slip")]
    worst = min(flight, key=lambda each: each.margin)
    assert math.degrees(worst.margin) == pytest.approx(answer.margin_deg, abs=1e-9)
    words = {"tip_downhill": "no-tip-downhill", "tip_uphill": "no-tip-uphill"}
    assert worst.name == words.get(answer.governs, "no-slip")


def test_kenaf_on_the_papers_stairs():
    # paper: predicted 60.2 degrees at 150 mm
    stairs = Stairs.inclined(angle=math.radians(50), nosing_spacing=0.15)
    found = climbing_conditions(KENAF, stairs, friction=2.0)
    assert math.degrees(found["no-tip-downhill"].margin) == pytest.approx(10.2, abs=0.05)


def test_too_short_a_flat_leaves_tipping_open():
    found = climbing_conditions(KENAF, Stairs.named("ibc"), friction=1.0)
    assert found.holds is False
    assert Name.TWO_NOSINGS in found.failing
    assert {Name.NO_TIP_DOWNHILL, Name.NO_TIP_UPHILL, Name.DRIVE} == set(found.unknown)
    assert found["no-tip-uphill"].why_unknown == "two nosings do not carry it everywhere"
    assert found["no-tip-uphill"].holds is None
    assert found["drive"].why_unknown == "mass is not known"


def test_exactly_two_nosings_hold():
    # limit: p = L / 2, whatever rounding does to it: 0.42 - 2 hypot(0.126, 0.168) = -6e-17
    robot = toy(track=Track(flat_length=0.42, front_radius=0.06, rear_radius=0.06))
    found = climbing_conditions(robot, Stairs(rise=0.126, going=0.168), friction=1.0)
    assert found["two-nosings"].margin == pytest.approx(0.0, abs=1e-15)
    assert found["two-nosings"].holds is True
    assert found["no-tip-downhill"].holds is not None


def test_the_worst_step_is_named():
    # hand: the longest spacing is that of the fourth riser
    stairs = Stairs(rises=(0.1, 0.1, 0.1, 0.11, 0.1), goings=(0.18, 0.18, 0.18, 0.18))
    found = climbing_conditions(KENAF, stairs, friction=1.6)
    assert found["two-nosings"].step == 4
    assert found["no-tip-downhill"].step == 4
    assert found["landing"].step == 5


def test_what_is_not_given_is_not_judged():
    found = climbing_conditions(toy(), THREE_FOUR_FIVE)
    assert found.unknown == (Name.NOSE_UP, Name.NO_SLIP, Name.DRIVE)
    assert found["no-slip"].why_unknown == "friction is not given"
    assert found["drive"].why_unknown == "drive.max_traction is not known"
    assert found.holds is None
    strong = climbing_conditions(
        toy(drive=Drive(max_traction=500.0)), THREE_FOUR_FIVE, friction=1.2
    )
    assert strong.holds is True
    assert strong.failing == strong.unknown == ()


def test_an_acceleration_beyond_any_slope():
    # hand: 100 m/s2 turn it over downhill on every slope, and never uphill
    found = climbing_conditions(toy(), THREE_FOUR_FIVE, friction=1.0, acceleration=100.0)
    assert found["no-tip-downhill"].margin == -math.pi / 2
    assert found["no-tip-uphill"].margin == math.pi / 2
    down = climbing_conditions(toy(), THREE_FOUR_FIVE, friction=1.0, acceleration=-100.0)
    assert down["no-tip-downhill"].margin == math.pi / 2
    assert down["no-tip-uphill"].margin == -math.pi / 2
    assert found["no-slip"].margin == down["no-slip"].margin == -math.pi / 2


@given(st.floats(0.05, 0.55), st.floats(0.062, 0.3))
def test_mirror(C_L, C_N):
    # property: tail first is the robot with its ends swapped
    one = climbing_conditions(
        toy(com_from_front=C_L, com_height=C_N), THREE_FOUR_FIVE, friction=1.0,
        facing="tail-first",
    )  # fmt: skip
    other = climbing_conditions(
        toy(com_from_front=0.6 - C_L, com_height=C_N), THREE_FOUR_FIVE, friction=1.0
    )
    for a, b in zip(one.conditions, other.conditions, strict=True):
        assert a.name == b.name
        assert a.margin == pytest.approx(b.margin, abs=1e-12, nan_ok=True)


@given(st.floats(0.3, 1.9))
def test_scaling(k):
    # property: lengths times k; angles and friction stay
    one = climbing_conditions(toy(), THREE_FOUR_FIVE, friction=1.0)
    big = climbing_conditions(
        toy(
            com_from_front=0.2 * k,
            com_height=0.1 * k,
            track=Track(flat_length=0.6 * k, front_radius=0.06 * k, rear_radius=0.06 * k),
        ),
        Stairs(rise=0.15 * k, going=0.2 * k, steps=8),
        friction=1.0,
    )
    for a, b in zip(one.conditions, big.conditions, strict=True):
        factor = k if a.unit == "m" else 1.0
        assert b.margin == pytest.approx(factor * a.margin, abs=1e-12, nan_ok=True)


def test_a_payload_on_the_tail_takes_margin_off():
    before = climbing_conditions(toy(), THREE_FOUR_FIVE, friction=1.0)
    load = Payload(mass=5.0, from_front=0.6, height=0.3)
    after = climbing_conditions(toy(), THREE_FOUR_FIVE, friction=1.0, payload=iter([load]))
    for name in ("first-step", "no-tip-downhill", "landing"):
        assert after[name].margin < before[name].margin


def test_refusals():
    for wrong, text in (
        ({"friction": -0.1}, "friction = -0.1 is not within 0 to inf"),
        ({"friction": math.nan}, "friction = nan is not within 0 to inf"),
        ({"acceleration": math.inf}, "acceleration = inf m/s^2 is not a finite number"),
    ):
        with pytest.raises(InputError) as refused:
            climbing_conditions(KENAF, THREE_FOUR_FIVE, **wrong)
        assert str(refused.value) == text
    with pytest.raises(InputError) as refused:
        climbing_conditions(KENAF, THREE_FOUR_FIVE)["luck"]
    assert str(refused.value) == (
        "condition 'luck' is not known; known: nose-up, first-step, two-nosings, "
        "no-tip-downhill, no-tip-uphill, no-slip, drive, landing"
    )
