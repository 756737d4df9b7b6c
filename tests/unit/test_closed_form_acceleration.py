"""Bounds of the acceleration by the closed form, what is safe, and the areas of the d-a plane."""

import math
from math import cos, radians, sin, tan

import numpy as np
import pytest

from closed_form_cases import BARE, C_L, C_N, G, L, assess, flight, kenaf, robot


def swept_limits(angle, p, mu, steps=20_001):
    """Oracle: smallest a_r0 and largest a_rn by trying every progress, contacts counted."""
    theta = radians(angle)
    lowest, highest = math.inf, -math.inf
    for d in np.linspace(0, p, steps)[:-1]:
        under = [d + k * p for k in range(20) if d + k * p < L]
        lowest = min(lowest, G * ((under[-1] - C_L) / C_N * cos(theta) - sin(theta)))
        highest = max(highest, G * ((under[0] - C_L) / C_N * cos(theta) - sin(theta)))
    return G * (mu * cos(theta) - sin(theta)), lowest, highest


@pytest.mark.parametrize(("angle", "p", "mu"), [(50, 0.150, 0.8), (30, 0.220, 3.0), (6, 0.2, 0.1)])
def test_the_papers_own_quantities(angle, p, mu):
    # oracle: a sweep over the progress, whose 20,000 steps of p cost g / C_N p / 20,000 < 2e-3
    a_S, min_a_r0, max_a_rn = swept_limits(angle, p, mu)
    paper = kenaf(angle, p, friction=mu).closed_form.paper
    assert paper.a_S == pytest.approx(a_S, rel=1e-12)
    assert paper.min_a_r0 == pytest.approx(min_a_r0, abs=2e-3)
    assert paper.max_a_rn == pytest.approx(max_a_rn, abs=2e-3)
    assert paper.a_max == min(paper.a_S, paper.min_a_r0)  # Eq. (17)
    assert paper.a_min == paper.max_a_rn  # Eq. (18): no downhill slip in it


def test_bounds_by_hand():
    # hand: Kenaf, 150 mm, 50 deg, mu 0.8
    found, theta = kenaf(50, 0.150, friction=0.8).closed_form, radians(50)
    assert found.a_slides_down == pytest.approx(G * (0.8 * cos(theta) - sin(theta)), rel=1e-12)
    assert found.a_slides_up == pytest.approx(-G * (0.8 * cos(theta) + sin(theta)), rel=1e-12)
    assert found.a_tip_downhill == pytest.approx(G * (124 / 71 * cos(theta) - sin(theta)), 1e-12)
    assert found.a_tip_uphill == pytest.approx(-G * (46 / 71 * cos(theta) + sin(theta)), 1e-12)
    assert found.a_max == found.a_slides_down
    # -12.55 by slip, -11.60 by tipping: the larger bounds
    assert found.a_min == found.a_tip_uphill > found.a_slides_up
    assert found.paper.a_min == found.a_tip_uphill


def test_allowances_narrow_the_safe_band():
    found, theta = kenaf(40, 0.150).closed_form, radians(40)
    tilted, sunk = theta + radians(5.2), theta - radians(2.6)
    assert found.a_max_safe == pytest.approx(G * (124 / 71 * cos(tilted) - sin(tilted)), 1e-12)
    assert found.a_min_safe == pytest.approx(-G * (46 / 71 * cos(sunk) + sin(sunk)), 1e-12)
    assert found.a_min < found.a_min_safe < found.a_max_safe < found.a_max
    assert kenaf(40, 0.150, **BARE).closed_form.a_max_safe == pytest.approx(found.a_max, rel=1e-15)


def test_band_ends_at_the_verdict():
    # just inside the safe band GO, just outside NO-GO, either way
    band = kenaf(40, 0.150, theta_d=0.01, theta_M=0.02).closed_form
    for edge, sign in ((band.a_max_safe, 1), (band.a_min_safe, -1)):
        if abs(edge) < 9.8:
            for step, verdict in ((-1e-9, "go"), (1e-9, "no-go")):
                asked = edge + sign * step
                found = kenaf(40, 0.150, theta_d=0.01, theta_M=0.02, acceleration=asked)
                assert found.verdict == verdict


def test_an_empty_band_is_null():
    # hand: Kenaf at 220 mm and 10 deg with mu 0.2: the nose drops below +1.56, it slips above 0.23
    answer = kenaf(10, 0.220, friction=0.2)
    found = answer.closed_form
    theta = radians(10)
    assert found.a_tip_uphill == pytest.approx(G * (24 / 71 * cos(theta) - sin(theta)), rel=1e-12)
    assert found.a_slides_down == pytest.approx(G * (0.2 * cos(theta) - sin(theta)), rel=1e-12)
    assert found.a_tip_uphill > found.a_slides_down
    assert found.a_max is found.a_min is found.a_max_safe is found.a_min_safe is None
    assert found.max_start is found.max_braking is None
    assert answer.verdict == "no-go"


@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_max_start_acceleration_and_braking(facing):
    # hand: a symmetric robot that only slips: up to g (0.8 cos 30 - sin 30) uphill,
    # g (0.8 cos 30 + sin 30) downhill; starting upward and braking downward push uphill
    flat = robot(com_height=0.02, com_from_front=0.25)
    uphill = G * (0.8 * cos(radians(30)) - sin(radians(30)))
    downhill = G * (0.8 * cos(radians(30)) + sin(radians(30)))
    question = {"friction": 0.8, "facing": facing, **BARE}
    up, down = (
        assess(flat, flight(30, 0.1), direction=way, **question).closed_form
        for way in ("up", "down")
    )
    assert up.max_start == pytest.approx(uphill, rel=1e-12)
    assert up.max_braking == pytest.approx(downhill, rel=1e-12)
    assert down.max_start == pytest.approx(downhill, rel=1e-12)
    assert down.max_braking == pytest.approx(uphill, rel=1e-12)


def test_no_safe_start_where_the_band_lies_below_zero():
    # at 57 deg with 5.2 deg off the band's upper end is negative: it may only slow down
    found = kenaf(57, 0.150).closed_form
    assert found.a_max_safe < 0
    assert found.max_start is None
    assert found.max_braking > 0


def test_required_friction():
    # hand: |tan(theta) + a / (g cos(theta))|
    for a in (0.0, 0.7, -0.7, -6.0):
        expected = abs(tan(radians(30)) + a / (G * cos(radians(30))))
        assert kenaf(30, 0.150, acceleration=a).required_friction == pytest.approx(expected, 1e-12)


@pytest.mark.parametrize(
    ("angle", "question", "area"),
    [
        (30, {}, "D"),
        (30, {"friction": 0.5}, "A"),  # tan 30 deg = 0.577
        (61, {}, "B"),
        (15, {"p": 0.220}, "C"),
        (20, {"friction": 0.6, "acceleration": -9.0}, "DOWNHILL_SLIP"),
        (30, {"friction": None}, "D"),
    ],
)
def test_area(angle, question, area):
    question = {"p": 0.150} | question
    assert kenaf(angle, question.pop("p"), **BARE, **question).closed_form.area == area
