import numpy as np
import pytest
from scipy.optimize import brentq

from kaidan.mechanics.drive import (
    drive_acceleration,
    drive_force,
    drive_power,
    drive_slope,
)

THREE_FOUR_FIVE = np.arctan(0.75)  # sin = 0.6, cos = 0.8


def test_drive_force():
    # hand: 60 + 20 + 16 N; moving down the rolling resistance helps to hold
    pose = {"M": 10.0, "a": 2.0, "theta_s": THREE_FOUR_FIVE, "g": 10.0}
    assert drive_force(**pose, c_rr=0.2) == pytest.approx(96.0, abs=1e-12)
    assert drive_force(**pose, c_rr=-0.2) == pytest.approx(64.0, abs=1e-12)
    assert drive_force(M=1.0, a=0.0, theta_s=0.0, c_rr=0.5) == pytest.approx(4.903325, abs=1e-12)


def test_drive_power():
    # hand; holding back on the way down takes power up, times the efficiency
    assert drive_power(F=100.0, v=0.5, eta=0.5) == pytest.approx(100.0, rel=1e-15)
    assert drive_power(F=100.0, v=-0.5, eta=0.5) == pytest.approx(-25.0, rel=1e-15)
    assert drive_power(F=-100.0, v=-0.5, eta=0.5) == pytest.approx(100.0, rel=1e-15)


def test_drive_acceleration_uses_the_force_up():
    # hand: see test_drive_force
    pose = {"M": 10.0, "theta_s": THREE_FOUR_FIVE, "g": 10.0}
    assert drive_acceleration(**pose, F=96.0, c_rr=0.2) == pytest.approx(2.0, abs=1e-13)
    assert drive_acceleration(F=0.0, M=1.0, theta_s=0.0, c_rr=1.0) == pytest.approx(
        -9.80665, abs=1e-13
    )


@pytest.mark.parametrize("c_rr", [-0.1, 0.0, 0.15])
@pytest.mark.parametrize("a", [-1.0, 0.0, 2.0])
def test_drive_slope_by_root_finding(a, c_rr):
    # oracle: the slope at which drive_force asks for exactly F; below pi/2 - arctan(c_rr) it rises
    F, M = 90.0, 14.0
    peak = np.pi / 2 - np.arctan(c_rr)
    slope = brentq(
        lambda theta: drive_force(M=M, a=a, theta_s=theta, c_rr=c_rr) - F, -1.4, peak, xtol=1e-14
    )
    assert drive_slope(F=F, M=M, a=a, c_rr=c_rr) == pytest.approx(slope, abs=1e-12)


def test_drive_slope_outside_validity_is_nan():
    # limit: enough for a wall (s = 1), more than that, and not enough for a fall
    assert drive_slope(F=100.0, M=10.0, a=0.0, c_rr=0.0, g=10.0) == pytest.approx(np.pi / 2)
    assert np.isnan(drive_slope(F=100.1, M=10.0, a=0.0, c_rr=0.0, g=10.0))
    assert drive_slope(F=0.0, M=10.0, a=10.0, c_rr=0.0, g=10.0) == pytest.approx(-np.pi / 2)
    assert np.isnan(drive_slope(F=0.0, M=10.0, a=10.1, c_rr=0.0, g=10.0))
