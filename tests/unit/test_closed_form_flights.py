"""Measured flights: the worst step, in every way that a step can be the worst."""

from math import atan, degrees, hypot

import numpy as np
import pytest

from closed_form_cases import ANGLE, BARE, C_L, C_N, GRIP, SPREAD, L, assess, doubtful, flight
from kaidan import Stairs, Surface


def test_an_irregular_flight_is_judged_by_its_worst_step():
    # hand: 100 x 120 mm but one step of 108 mm: steeper and longer, worse in every way
    rises = (0.1, 0.1, 0.108, 0.1, 0.1, 0.1)
    answer = assess("kenaf", Stairs(rises=rises, goings=(0.12,) * 5), friction=GRIP)
    worst = assess("kenaf", Stairs(rise=0.108, going=0.12), friction=GRIP)
    for field in ("margin_deg", "required_friction"):
        assert getattr(answer, field) == pytest.approx(getattr(worst, field), rel=1e-12), field
    for field in ("angle_deg", "nosing_spacing_m", "a_max_safe"):
        found, expected = (getattr(each.closed_form, field) for each in (answer, worst))
        assert found == pytest.approx(expected, rel=1e-12), field
    # hand: the line through the nosings rises by 408 on 480 mm, first and last riser left out
    assert answer.angle_deg == pytest.approx(degrees(atan(0.408 / 0.48)), **ANGLE)
    assert any("8.0 mm" in note for note in answer.notes)
    # the first riser belongs to entering, the last to landing
    ends = (0.3, 0.1, 0.1, 0.1, 0.1, 0.3)
    answer = assess("kenaf", Stairs(rises=ends, goings=(0.12,) * 5), friction=GRIP)
    assert answer.angle_deg == pytest.approx(degrees(atan(0.1 / 0.12)), **ANGLE)


def test_bounds_hold_on_every_step():
    # a steep step and a gentle, longer one: each is the worst in its own way
    steep, gentle = (0.094, 0.19), (0.085, 0.1985)
    flights = Stairs(rises=(0.09, steep[0], gentle[0], 0.09), goings=(steep[1], gentle[1], 0.19))
    answer = assess("kenaf", flights, friction=0.9)
    alone = [assess("kenaf", Stairs(rise=r, going=g), friction=0.9) for r, g in (steep, gentle)]
    tightest = {
        "a_tip_downhill": min,
        "a_tip_uphill": max,
        "a_slides_down": min,
        "a_slides_up": max,
    }
    for name, choose in tightest.items():
        values = [getattr(each.closed_form, name) for each in alone]
        assert values[0] != pytest.approx(values[1], abs=0.01)
        assert getattr(answer.closed_form, name) == pytest.approx(choose(values), rel=1e-12)
    assert answer.closed_form.a_max_safe == pytest.approx(
        min(each.closed_form.a_max_safe for each in alone), rel=1e-12
    )
    assert answer.closed_form.a_min_safe == pytest.approx(
        max(each.closed_form.a_min_safe for each in alone), rel=1e-12
    )
    assert answer.margin_deg == pytest.approx(min(each.margin_deg for each in alone), rel=1e-12)


def test_the_worst_step_may_be_neither_the_longest_nor_the_steepest():
    # the gentle step is shorter too, but its slope lets the nose drop
    steep, gentle = (0.100, 0.195), (0.092, 0.1985)
    assert hypot(*steep) > hypot(*gentle)
    flights = Stairs(rises=(0.1, steep[0], gentle[0], 0.1), goings=(steep[1], gentle[1], 0.19))
    answer = assess("kenaf", flights, friction=GRIP)
    alone = [assess("kenaf", Stairs(rise=r, going=g), friction=GRIP) for r, g in (steep, gentle)]
    uphill = [each.margins_deg["tip_uphill"] for each in alone]
    assert uphill[1] < uphill[0] - 1
    assert answer.margins_deg["tip_uphill"] == pytest.approx(uphill[1], **ANGLE)
    assert answer.closed_form.a_tip_uphill == pytest.approx(
        alone[1].closed_form.a_tip_uphill, rel=1e-12
    )


def test_too_irregular_is_outside():
    # IBC 1011.5.4 allows 9.5 mm
    def spread(by):
        return assess(
            "kenaf", Stairs(rises=(0.1, 0.1, 0.1 + by, 0.1), goings=(0.12,) * 3), friction=GRIP
        )

    assert spread(0.0095).verdict == "go"
    wide = spread(0.0096)
    assert wide.verdict == "outside-model"
    assert "9.6 mm" in wide.reason


@pytest.mark.parametrize(("steps", "verdict"), [(3, "outside-model"), (4, "go")])
def test_too_short_a_flight_is_outside(steps, verdict):
    # hand: floor(470 / 150) + 1 = 4 nosings touch at once
    answer = assess("kenaf", flight(40, 0.150, steps=steps), friction=GRIP)
    assert answer.verdict == verdict
    if verdict != "go":
        assert answer.reason == (
            "The closed form has no answer: the flight's 3 nosings are fewer than the track holds "
            "at once."
        )


def test_worst_step_among_hundreds():
    # hundreds of different steps, each worth its own verdict; the worst one is the answer's
    draw = np.random.default_rng(7)
    rises = np.round(0.1 + draw.uniform(0, 0.009, 400), 7).tolist()
    goings = np.round(0.12 + draw.uniform(0, 0.009, 399), 7).tolist()
    answer = assess("kenaf", Stairs(rises=rises, goings=goings), friction=GRIP, **BARE)
    margins = [
        min(
            atan((L - C_L - hypot(r, g)) / C_N) - atan(r / g),
            atan(r / g) - atan((hypot(r, g) - C_L) / C_N),
        )
        for r, g in list(zip(rises[1:], goings, strict=True))[:-1]
    ]
    assert answer.margin_deg == pytest.approx(degrees(min(margins)), **ANGLE)


def test_blocks_of_steps_are_judged_like_one(monkeypatch):
    # longer is gentler, so that no step outdoes another and all are judged
    more = np.linspace(0, 0.009, 60)
    rises = (0.1 - more).tolist()
    goings = (0.12 + 0.9 * more).tolist()[:-1]
    doubt = doubtful(**SPREAD)
    question = {"surface": Surface.of_friction(0.9, 0.02)}
    stairs = Stairs(rises=rises, goings=goings)
    at_once = assess(doubt, stairs, **question)
    steps = list(zip(rises[1:], goings, strict=True))[:-1]
    for block in (2048 * 7, 1):
        monkeypatch.setattr("kaidan.models.samples.BLOCK", block)
        assert assess(doubt, stairs, **question).to_json() == at_once.to_json()
    alone = [assess(doubt, Stairs(rise=r, going=g), **question) for r, g in steps]
    # the same samples for all steps, but the worst step is not the same in all of them
    assert at_once.margin_deg <= min(answer.margin_deg for answer in alone)
    assert at_once.margin_deg == pytest.approx(min(answer.margin_deg for answer in alone), abs=0.3)
    assert at_once.failure_probability >= max(answer.failure_probability for answer in alone)
    assert at_once.closed_form.a_max_safe <= min(answer.closed_form.a_max_safe for answer in alone)
    assert at_once.closed_form.a_min_safe >= max(answer.closed_form.a_min_safe for answer in alone)
