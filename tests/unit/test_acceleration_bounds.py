"""Bounds of the acceleration over steps and samples, and over a flight, by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Question, Robot, Stairs
from kaidan.mechanics.acceleration import tip_band
from kaidan.mechanics.drive import drive_acceleration
from kaidan.mechanics.margin import semi_stable_limit
from kaidan.models import acceleration
from kaidan.models.acceleration import _SIGN, _tightest, flight_band, semi_stable_angle
from kaidan.models.samples import nominal
from kaidan.robot import Drive

FLIGHT = Stairs(rise=0.10, going=0.12, steps=4)
KENAF = Robot.named("kenaf")


def bounds(*upper):
    """Bounds of samples and steps: lower ones have the other sign."""
    block = np.array(upper, dtype=float)
    return type(_SIGN)(*(sign * block for sign in _SIGN))


@pytest.mark.parametrize(("risk", "least"), [(0.0, 1.0), (0.4, 4.0)])
def test_of_steps_and_parts_the_tightest_bound_counts_and_of_samples_that_at_the_risk(risk, least):
    """Of the samples 2, 4 and 8, and 1, 6 and 7: 1, 4 and 7."""
    parts = [bounds([3, 2], [5, 4], [9, 8]), bounds([1], [6], [7])]
    found = _tightest(parts, risk)
    assert [sign * each for sign, each in zip(_SIGN, found, strict=True)] == [least] * 6


def test_the_slope_of_area_e_is_that_of_the_sheets_figures():
    L, C_L, C_N = (np.array([[0.47, 0.9], [0.8, 0.7]]) * k for k in (1.0, 0.4, 0.15))
    p = np.array([[0.15, 0.18], [0.2, 0.21]])
    at = SimpleNamespace(L=L, C_L=C_L, C_N=C_N, p=p)
    for step in (0, 1):
        by_hand = semi_stable_limit(L=0.47, p=p[0, step], C_L=0.188, C_N=0.0705)
        assert semi_stable_angle(at, step) == pytest.approx(float(by_hand))


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("force", [None, 120.0])
@pytest.mark.parametrize("C_L", [None, 0.05])
def test_the_band_of_a_flight_less_the_allowances(direction, force, C_L):
    """Friction never decides here: tips and the drive do, spacing after spacing.

    A centroid at the uphill end tips over it unless it is kept there.
    """
    drive = Drive(max_traction=force, max_acceleration=4.0, max_deceleration=3.0)
    robot = KENAF.model_copy(update={"mass": 20.0, "drive": drive})
    if C_L is not None:
        C_F = C_L if direction == "up" else KENAF.track.flat_length - C_L
        robot = robot.with_centroid(C_F, 0.03)
    question = Question.in_one_posture(
        robot, FLIGHT, friction=5.0, theta_d=(0.0, 0.02), theta_M=(0.0, 0.05), direction=direction
    )
    at = nominal(question, FLIGHT)
    figures = {
        "L": float(at.L[0, 0]), "C_L": float(at.C_L[0, 0]), "C_N": float(at.C_N[0, 0]),
        "p": FLIGHT.nosing_spacing,
    }  # fmt: skip
    theta = FLIGHT.angle
    down, up = (tip_band(**figures, theta_s=slope) for slope in (theta + 0.07, theta - 0.02))
    upper, lower, width = down.upper, up.lower, np.diff(down.edges)
    if force is not None:
        of_drive = {"M": 20.0, "c_rr": question.rolling_resistance, "theta_s": theta}
        upper = np.minimum(upper, float(drive_acceleration(F=force, **of_drive)))
        lower = np.maximum(lower, float(drive_acceleration(F=-force, **of_drive)))
    if direction == "down":
        lower, upper, width = -upper[::-1], -lower[::-1], width[::-1]
    found = flight_band(question, at, 0)
    spans = len(FLIGHT.regular_steps)
    assert spans > 1
    for one, expected in zip(
        found, (np.maximum(lower, -3.0), np.minimum(upper, 4.0), width), strict=True
    ):
        np.testing.assert_allclose(one, np.tile(expected, spans))


@pytest.mark.parametrize(
    ("lower", "upper", "reserve", "holds"),
    [
        (0.0, 0.0, 0.0, True),
        (0.0, 1.0, 0.1, True),
        (-1.0, 0.0, 0.1, True),
        (0.1, 1.0, 0.1, False),  # it gains speed from nosing to nosing
        (-1.0, -0.1, 0.1, False),
        (-1.0, 1.0, -0.1, False),
        (-1.0, 1.0, math.nan, False),  # no plan
    ],
)
def test_what_just_keeps_its_speed_and_just_has_a_plan_is_semi_stable(
    lower, upper, reserve, holds, monkeypatch
):
    """Two cells of 0.05 and 0.1 m, with the same limits in both."""
    drive = Drive(acceleration_control=True, max_speed=0.5)
    question = Question.in_one_posture(KENAF.model_copy(update={"drive": drive}), FLIGHT)
    band = np.full(2, lower), np.full(2, upper), np.array([0.05, 0.1])
    asked = []

    def plan(question, at, step, *, v_min):
        asked.append(v_min)
        return SimpleNamespace(reserve=reserve)

    monkeypatch.setattr(acceleration, "flight_band", lambda question, at, step: band)
    monkeypatch.setattr(acceleration, "plan_acceleration", plan)
    at = nominal(question, FLIGHT)
    assert acceleration.semi_stable(question, at, 0) is holds
    assert asked == ([] if lower > 0 or upper < 0 else [pytest.approx(0.025)])
    for other in (Drive(max_speed=0.5), Drive(acceleration_control=True)):
        robot = KENAF.model_copy(update={"drive": other})
        assert acceleration.semi_stable(question.changed(robot=robot), at, 0) is False
