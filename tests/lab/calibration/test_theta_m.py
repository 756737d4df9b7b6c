"""The designed study of theta_M: the design itself, and effects that are put in by hand."""

import math

import numpy as np
import pytest

from kaidan.lab.calibration import theta_m
from kaidan.lab.calibration.bench import Bench
from kaidan.lab.calibration.theta_m import FACTORS, design, setting_of, theta_m_study
from kaidan.robot import Robot

KENAF = Robot.named("kenaf")


def test_effects_are_told_apart_from_each_other_and_from_pairs():
    coded = design()
    assert coded.shape == (24, len(FACTORS))
    np.testing.assert_array_equal(coded.T @ coded, 24 * np.eye(11))
    # every product of two columns is orthogonal to every column
    pairs = np.einsum("ri,rj->rij", coded, coded).reshape(24, -1)
    np.testing.assert_array_equal(coded.T @ pairs, 0)


def stub(margin):
    """Runner whose trials fall beyond a margin of their setting [deg]."""

    def run(specs):
        found = []
        for spec in specs:
            slope = math.degrees(spec.question.flight.angle)
            extra = 60.0 if slope > margin(spec) + 0.5 else 1.0
            found.append(("fell_backward" if extra > 30 else "climbed", extra, 2))
        return found

    return run


def test_effects_that_are_put_in_come_out():
    def margin(spec):
        up = 55.0 if spec.ground == "steps" else 57.0
        if spec.question.direction == "up":
            return up
        # 4 degrees more with the higher friction, 2 with the lower
        return up + (4.0 if spec.static_friction > 3.0 else 2.0)

    found = theta_m_study(Bench(stub(margin), trials=2), KENAF, step=1.0)
    by = {each.factor: each for each in found.effects}
    assert found.effects[0].factor == "friction"
    assert by["friction"].theta_M_deg == pytest.approx(2.0)
    assert by["treads"].up_deg == pytest.approx(-2.0)
    others = [each for name, each in by.items() if name != "friction"]
    assert all(abs(each.theta_M_deg) < 1e-9 for each in others)
    assert found.mean_deg == pytest.approx(3.0)
    assert found.scatter_deg == pytest.approx(0.0, abs=1e-9)
    text = str(found)
    assert "theta_M 3.0 deg over 24 of 24 runs" in text
    assert type(found).from_json(found.to_json()) == found


def test_the_criterion_is_the_studys_own():
    def run(specs):
        return [("climbed", 20.0, 2) for _ in specs]

    bench = Bench(run, trials=2)
    strict = theta_m_study(bench, KENAF, criterion=15.0)
    assert all(each.up_deg is None for each in strict.runs)  # every trial falls
    assert strict.mean_deg is None
    loose = theta_m_study(bench, KENAF, criterion=45.0)
    assert all(each.up_deg is None for each in loose.runs)  # none does


def test_a_setting_has_what_its_levels_say():
    levels = {name: high for name, (_, high) in FACTORS.items()}
    setting = setting_of(KENAF, levels)
    assert setting.robot.track.gap == pytest.approx(0.120)
    assert setting.robot.com_from_front == pytest.approx(0.201)
    assert setting.robot.track.front_radius == pytest.approx(0.020)
    assert setting.track.stiffness == pytest.approx(theta_m.MASS * 9.80665 / 0.005)
    assert (setting.ground, setting.friction, setting.speed) == ("steps", 4.0, 0.1)


@pytest.mark.slow
def test_shear_and_damping_decide_theta_m():
    """As the page has it: the stiffer the shear and the lighter the damping, the smaller."""
    pytest.importorskip("numba", reason="skipped: numba not installed")
    from calibration_cases import here

    found = theta_m_study(Bench(here, trials=2), KENAF, step=2.0)
    by = {each.factor: each.theta_M_deg for each in found.effects}
    assert by["shear_ratio"] < -1.0
    assert by["damping_ratio"] > 1.0
    assert found.scatter_deg < 1.0
