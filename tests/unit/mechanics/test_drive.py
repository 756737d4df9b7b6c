import numpy as np
import pytest
from scipy.optimize import brentq

from kaidan.mechanics.drive import (
    drive_acceleration,
    drive_force,
    drive_power,
    drive_slope,
    grouser_friction,
    sprocket_torque,
    torque_force,
)

THREE_FOUR_FIVE = np.arctan(0.75)  # sin = 0.6, cos = 0.8


def test_drive_force():
    # hand: 60 + 20 + 16 N; moving down the rolling resistance helps to hold
    pose = {"M": 10.0, "a": 2.0, "theta_s": THREE_FOUR_FIVE, "g": 10.0}
    assert drive_force(**pose, c_rr=0.2) == pytest.approx(96.0, abs=1e-12)
    assert drive_force(**pose, c_rr=-0.2) == pytest.approx(64.0, abs=1e-12)
    assert drive_force(M=1.0, a=0.0, theta_s=0.0, c_rr=0.5) == pytest.approx(4.903325, abs=1e-12)


def test_sprocket_torque_driving_and_braking():
    # hand: 80 N * 0.05 m / 2 = 2 N m at the ground
    assert sprocket_torque(F=80.0, r=0.05, eta=0.8) == pytest.approx(2.5, abs=1e-14)
    assert sprocket_torque(F=-80.0, r=0.05, eta=0.8) == pytest.approx(-1.6, abs=1e-14)
    assert sprocket_torque(F=0.0, r=0.05, eta=0.8) == 0.0


def test_torque_and_speed_make_the_power():
    # hand: two sprockets turning at v / r
    for F in (120.0, -120.0):
        T = sprocket_torque(F=F, r=0.06, eta=0.7)
        assert drive_power(F=F, v=0.3, eta=0.7) == pytest.approx(2.0 * T * 0.3 / 0.06, rel=1e-14)


def test_drive_power():
    # hand; holding back on the way down takes power up, times the efficiency
    assert drive_power(F=100.0, v=0.5, eta=0.5) == pytest.approx(100.0, rel=1e-15)
    assert drive_power(F=100.0, v=-0.5, eta=0.5) == pytest.approx(-25.0, rel=1e-15)
    assert drive_power(F=-100.0, v=-0.5, eta=0.5) == pytest.approx(100.0, rel=1e-15)


def test_torque_force_is_the_inverse():
    # hand: 2 * 0.8 * 2.5 / 0.05
    assert torque_force(T=2.5, r=0.05, eta=0.8) == pytest.approx(80.0, rel=1e-14)


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


def test_grouser_friction():
    # hand: tan(45 + arctan 1/3) = (1 + 1/3) / (1 - 1/3); a flat track is its own friction
    assert grouser_friction(gamma=np.pi / 4, mu_s=1.0 / 3.0) == pytest.approx(2.0, abs=1e-14)
    assert grouser_friction(gamma=0.0, mu_s=0.6) == pytest.approx(0.6, abs=1e-15)
    assert grouser_friction(gamma=np.pi / 4, mu_s=0.0) == pytest.approx(1.0, abs=1e-15)


def test_grouser_friction_by_forces():
    # oracle: forces on the flank at the verge of sliding, resolved along the track and normal to it
    gamma, mu = 0.5, 0.4
    normal = np.array([np.sin(gamma), np.cos(gamma)])  # of the flank; components (along, normal)
    down_the_flank = np.array([np.cos(gamma), -np.sin(gamma)])
    force = normal + mu * down_the_flank
    assert grouser_friction(gamma=gamma, mu_s=mu) == pytest.approx(force[0] / force[1], abs=1e-14)


def test_locked_grouser_is_nan():
    # limit: 45 degrees of flank and friction 1 lock
    assert grouser_friction(gamma=np.pi / 4, mu_s=0.999) > 1e3
    assert np.isnan(grouser_friction(gamma=np.pi / 4, mu_s=1.001))
    assert np.isnan(grouser_friction(gamma=np.pi / 2, mu_s=0.0))
