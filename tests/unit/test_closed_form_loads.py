"""Contacts, forces and published measures at the governing pose."""

import math
from math import cos, hypot, radians, sin, tan

import pytest

from closed_form_cases import GRIP, G, assess, flight, kenaf, robot
from kaidan.robot import Drive


def test_contacts_carry_the_weight_and_the_traction():
    # hand: just after the loss the contacts lie L - p and every p above it behind the uphill end
    tracks = robot()
    answer = assess(tracks, flight(20, 0.12), friction=GRIP, acceleration=0.4)
    found = answer.closed_form
    theta = radians(20)
    places = [contact.behind_uphill_tip_m for contact in found.contacts]
    assert places == pytest.approx([0.02, 0.14, 0.26, 0.38], abs=1e-12)
    assert found.contacts_n == 4
    assert sum(contact.load_share for contact in found.contacts) == pytest.approx(1, abs=1e-12)
    normal = sum(contact.normal_N for contact in found.contacts)
    assert normal == pytest.approx(10 * G * cos(theta), rel=1e-12)
    traction = sum(contact.traction_N for contact in found.contacts)
    assert traction == pytest.approx(10 * (G * sin(theta) + 0.4), rel=1e-12)
    assert found.traction_N == pytest.approx(traction, rel=1e-12)
    # moments about the uphill end: the resultant passes through x_z
    x_z = 0.25 + 0.1 * (tan(theta) + 0.4 / (G * cos(theta)))
    moment = sum(c.load_share * c.behind_uphill_tip_m for c in found.contacts)
    assert moment == pytest.approx(x_z, rel=1e-12)
    for contact in found.contacts:
        assert contact.required_friction == pytest.approx(answer.required_friction, rel=1e-12)


def test_forces_take_a_mass():
    answer = kenaf(30, 0.150, speed=0.1)
    found = answer.closed_form
    assert found.traction_N is found.power_W is None
    assert all(c.normal_N is c.traction_N is None for c in found.contacts)
    assert found.measures.force_angle_Nm_rad is None
    assert any("not known and not judged" in note for note in answer.notes)


def test_traction_and_power():
    # hand: 10 kg at 30 deg with c_rr 0.1 and efficiency 0.5, at 0.2 m/s
    drive = Drive(rolling_resistance=0.1, efficiency=0.5, max_speed=1.0)
    tracks = robot(drive=drive.model_dump())
    theta = radians(30)
    up = assess(tracks, flight(30, 0.12), friction=GRIP, speed=0.2).closed_form
    assert up.traction_N == pytest.approx(10 * G * (sin(theta) + 0.1 * cos(theta)), rel=1e-12)
    assert up.power_W == pytest.approx(up.traction_N * 0.2 / 0.5, rel=1e-12)
    # going down the rolling resistance helps to hold, and the losses take their part
    down = assess(tracks, flight(30, 0.12), friction=GRIP, speed=0.2, direction="down")
    down = down.closed_form
    assert down.traction_N == pytest.approx(10 * G * (sin(theta) - 0.1 * cos(theta)), rel=1e-12)
    assert down.power_W == pytest.approx(-down.traction_N * 0.2 * 0.5, rel=1e-12)
    assert assess(tracks, flight(30, 0.12), friction=GRIP).closed_form.power_W is None


def test_measures_by_hand():
    # hand: contacts at 0.14 and 0.38 m, centroid at 0.25 m, 0.1 m high, 20 deg, 10 kg, a = 0
    theta = radians(20)
    found = assess(robot(), flight(20, 0.24), friction=GRIP, speed=0.4).closed_form.measures
    low, high = 0.26, 0.02
    static = min(
        (low - 0.25) * cos(theta) - 0.1 * sin(theta), (0.25 - high) * cos(theta) + 0.1 * sin(theta)
    )
    assert found.static_margin_mm == pytest.approx(1e3 * static, rel=1e-9)
    x_z = 0.25 + 0.1 * tan(theta)
    assert found.zmp_margin_mm == pytest.approx(1e3 * min(low - x_z, x_z - high), rel=1e-9)
    # energy: the centroid turns about a contact until it stands above it
    arms = [(low - 0.25, 0.1), (0.25 - high, 0.1)]
    heights = [
        hypot(*arm) - (arm[1] * cos(theta) + sign * arm[0] * sin(theta))
        for arm, sign in zip(arms, (1, -1), strict=True)
    ]
    energy = math.copysign(heights[0], static)  # already past its lower contact
    assert found.energy_margin_mm == pytest.approx(1e3 * energy, rel=1e-9)
    assert found.speed_height_mm == pytest.approx(1e3 * 0.16 / (2 * G), rel=1e-12)
