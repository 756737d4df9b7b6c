"""Payload, flippers, and robots that the closed form does not know."""

import json
import math
from math import atan, atan2, degrees

import pytest

from closed_form_cases import ANGLE, GRIP, assess, flight, robot
from kaidan import Payload, Posture, Stairs
from kaidan.robot import FlipperPair, Track


def test_payload_moves_the_centroid():
    # hand: (10 x 0.25 + 5 x 0.4) / 15 = 0.3; (10 x 0.1 + 5 x 0.4) / 15 = 0.2
    load = Payload(mass=5, from_front=0.4, height=0.4)
    for payload in (load, [load], (load,), iter([load])):
        answer = assess(robot(), flight(10, 0.12), friction=GRIP, payload=payload)
        assert answer.com_from_front_m == pytest.approx(0.3, abs=1e-15)
        assert answer.com_height_m == pytest.approx(0.2, abs=1e-15)
        assert answer.mass_kg == 15
        # hand: atan((0.5 - 0.12 - 0.3) / 0.2)
        assert answer.closed_form.margin_angle_deg == pytest.approx(degrees(atan(0.4)), **ANGLE)
    two = [Payload(mass=2.5, from_front=0.4, height=0.4)] * 2
    assert assess(robot(), flight(10, 0.12), payload=two).com_height_m == pytest.approx(0.2)


FLIPPERS = FlipperPair(
    length=0.3,
    root_radius=0.06,
    tip_radius=0.04,
    pivot_height=0.06,
    pivot_inset=0.01,
    mass=2.0,
    com_from_pivot=0.15,
)


def test_flippers_in_line_lengthen_the_track():
    # hand: the tip lies 20 mm below the pivot: reach sqrt(0.3^2 - 0.02^2) - 0.01
    reach = math.sqrt(0.3**2 - 0.02**2)
    tracks = robot(front_flippers=FLIPPERS, rear_flippers=FLIPPERS)
    answer = assess(tracks, flight(10, 0.12), friction=GRIP, flippers="flat")
    assert answer.flat_length_m == pytest.approx(0.5 + 2 * (reach - 0.01), abs=1e-12)
    # both move alike: the centroid stays in the middle and sinks by 2 x 2 kg x 0.15 m x (1 + 1/15)
    assert answer.com_from_front_m == pytest.approx(answer.flat_length_m / 2, abs=1e-12)
    assert answer.com_height_m == pytest.approx(0.1 - 2 * 0.3 / 10 * (1 + 0.02 / 0.3), abs=1e-12)
    front = assess(tracks, flight(10, 0.12), friction=GRIP, flippers=Posture(front="flat"))
    assert front.flat_length_m == pytest.approx(0.5 + reach - 0.01, abs=1e-12)
    # from upright to in line the front pair moves its 2 kg by 0.15 reach / 0.3 forward
    shift = 2.0 * 0.15 * reach / 0.3 / 10
    assert front.com_from_front_m == pytest.approx(0.25 - shift + reach - 0.01, abs=1e-12)
    assert assess(tracks, flight(10, 0.12)).flat_length_m == 0.5


def test_a_flipper_below_the_track_is_outside():
    tracks = robot(front_flippers=FLIPPERS)
    lowered = assess(tracks, flight(10, 0.12), friction=GRIP, flippers=Posture(front=-0.3))
    assert (lowered.verdict, lowered.governs) == ("outside-model", "outside_model")
    assert "a flipper reaches below" in lowered.reason
    raised = assess(tracks, flight(10, 0.12), friction=GRIP, flippers=Posture(front=0.3))
    assert raised.verdict == "go"


CODES = ("ibc", "ada", "osha", "din-general", "din-dwelling", "uk-general", "uk-private")
CODES += ("uk-utility", "iso-14122-3", "japan-dwelling", "ibc-dwelling")


@pytest.mark.parametrize("code", CODES)
def test_flippers_bring_absolem_inside_the_model(code):
    for question in ({"robot": "absolem", "flippers": "flat"}, {"robot": "absolem-flat"}):
        answer = assess(stairs=code, friction=1.5, **question)
        assert answer.verdict in ("go", "unsure", "no-go")
        assert answer.model == "closed-form"
        assert answer.margin_deg is not None
        # hand: the sheets' figures through atan((L - p - C_L) / C_N)
        from_end = answer.flat_length_m - answer.nosing_spacing_m - answer.com_from_front_m
        expected = atan2(from_end, answer.com_height_m)
        assert answer.closed_form.margin_angle_deg == pytest.approx(degrees(expected), **ANGLE)
        assert answer.flat_length_m == pytest.approx(1.145, abs=0.005)  # 1.141 and 1.149


@pytest.mark.parametrize("code", CODES)
def test_bare_kenaf_is_outside_the_model_on_the_codes(code):
    answer = assess("kenaf", code, friction=GRIP)
    assert (answer.verdict, answer.governs) == ("outside-model", "outside_model")
    assert answer.exit_code == 3
    assert "p > L/2" in answer.reason
    assert f"{1e3 * Stairs.named(code).nosing_spacing:.0f} mm" in answer.reason
    assert "470 mm" in answer.reason


def test_outside_the_model_there_is_no_number_that_looks_valid():
    outside = [
        assess("kenaf", "ibc", friction=GRIP),
        assess(robot(front_flippers=FLIPPERS), flight(10, 0.12), flippers=Posture(front=-0.3)),
        assess("kenaf", flight(40, 0.1, steps=2), friction=GRIP),
    ]
    for answer in outside:
        assert answer.verdict == "outside-model"
        assert answer.falls_over is None
        numbers = json.loads(answer.to_json())
        nulls = """margin_deg margin_best_deg margin_interval_deg margin_force_N phase step
            failure_probability contact closed_form support_polygon physics"""
        assert {name: numbers[name] for name in nulls.split()} == dict.fromkeys(nulls.split())
        assert numbers["findings"] == {}
        assert numbers["doubts"] == []


def test_the_track_is_kept_apart_from_its_gap():
    # two tracks in line with nothing between them: the closed form knows no such underside
    gapped = robot(track=Track(flat_length=0.5, gap=0.1).model_dump())
    answer = assess(gapped, flight(10, 0.12), friction=GRIP)
    assert answer.verdict == "outside-model"
    assert "100 mm in the middle of the underside have no track" in answer.reason
