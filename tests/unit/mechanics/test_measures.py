import numpy as np
import pytest

from kaidan.mechanics.measures import (
    energy_margin,
    energy_margin_backward,
    energy_margin_forward,
    force_angle_measure,
    kinetic_energy_height,
    static_margin_downhill,
    static_margin_uphill,
    zero_moment_margin,
)

ROUNDING = 1e-13  # a few operations on lengths below one metre


def world(x, z, theta_s):
    """Point x behind the uphill tip and z above the underside, in level coordinates."""
    return np.array(
        [-x * np.cos(theta_s) - z * np.sin(theta_s), -x * np.sin(theta_s) + z * np.cos(theta_s)]
    )


POSE = {"x_0": 0.42, "x_n": 0.05, "C_L": 0.21, "C_N": 0.08}


@pytest.mark.parametrize("theta_s", [-0.4, 0.0, 0.7, 1.3])
def test_static_margins_are_horizontal_distances(theta_s):
    # oracle: rotate the three points and take the difference of abscissae
    lowest, highest, com = (
        world(POSE["x_0"], 0.0, theta_s),
        world(POSE["x_n"], 0.0, theta_s),
        world(POSE["C_L"], POSE["C_N"], theta_s),
    )
    downhill = static_margin_downhill(x_0=0.42, C_L=0.21, C_N=0.08, theta_s=theta_s)
    uphill = static_margin_uphill(x_n=0.05, C_L=0.21, C_N=0.08, theta_s=theta_s)
    assert downhill == pytest.approx(com[0] - lowest[0], abs=ROUNDING)
    assert uphill == pytest.approx(highest[0] - com[0], abs=ROUNDING)


def test_static_margin_vanishes_at_the_limit_slope():
    # hand: tan = (0.42 - 0.21) / 0.08
    theta = np.arctan(0.21 / 0.08)
    margin = static_margin_downhill(x_0=0.42, C_L=0.21, C_N=0.08, theta_s=theta)
    assert margin == pytest.approx(0.0, abs=ROUNDING)


def test_zero_moment_margin_takes_the_nearer_end():
    # hand
    assert zero_moment_margin(x_z=0.3, x_0=0.5, x_n=0.2) == pytest.approx(0.1, abs=ROUNDING)
    assert zero_moment_margin(x_z=0.45, x_0=0.5, x_n=0.2) == pytest.approx(0.05, abs=ROUNDING)
    assert zero_moment_margin(x_z=0.55, x_0=0.5, x_n=0.2) == pytest.approx(-0.05, abs=ROUNDING)


def test_zero_moment_margin_projects_to_the_static_margin():
    # hand: at constant speed x_z - C_L = C_N tan(theta_s), so the projections agree
    theta = 0.6
    x_z = 0.21 + 0.08 * np.tan(theta)
    static = static_margin_downhill(x_0=0.42, C_L=0.21, C_N=0.08, theta_s=theta)
    along = zero_moment_margin(x_z=x_z, x_0=0.42, x_n=-10.0)
    assert along * np.cos(theta) == pytest.approx(static, abs=ROUNDING)


def highest_on_the_way(pivot, com, turn):
    """Rise of the centroid turned about the pivot by up to half a turn, on a fine grid."""
    angles = turn * np.linspace(0.0, np.pi, 200_001)
    arm = com - pivot
    heights = arm[0] * np.sin(angles) + arm[1] * np.cos(angles)
    return np.max(heights) - arm[1]


@pytest.mark.parametrize("theta_s", [0.0, 0.3, 0.9])
def test_energy_margins_are_the_rise_to_the_highest_point(theta_s):
    # oracle: turn the centroid about the contact; the grid misses the top by < 1e-10 of alpha
    lowest, highest, com = (
        world(POSE["x_0"], 0.0, theta_s),
        world(POSE["x_n"], 0.0, theta_s),
        world(POSE["C_L"], POSE["C_N"], theta_s),
    )
    alpha, beta = np.hypot(0.21, 0.08), np.hypot(0.16, 0.08)
    back = energy_margin_backward(alpha=alpha, theta_alpha=np.arctan2(0.08, 0.21), theta_s=theta_s)
    fwd = energy_margin_forward(beta=beta, theta_beta=np.arctan2(0.08, 0.16), theta_s=theta_s)
    assert back == pytest.approx(highest_on_the_way(lowest, com, 1.0), abs=1e-10)
    assert fwd == pytest.approx(highest_on_the_way(highest, com, -1.0), abs=1e-10)


def test_energy_margins_are_signed():
    # hand: 30 degrees past the upright the centroid is alpha (1 - cos 30) below the top
    lost = 1.0 - np.sqrt(0.75)
    back = energy_margin_backward(alpha=1.0, theta_alpha=np.radians(60.0), theta_s=np.radians(60.0))
    fwd = energy_margin_forward(beta=1.0, theta_beta=np.radians(150.0), theta_s=np.radians(30.0))
    assert back == pytest.approx(-lost, abs=ROUNDING)
    assert fwd == pytest.approx(-lost, abs=ROUNDING)


def test_energy_margin_scales_with_its_arm():
    # hand: 1 - sin 30
    assert energy_margin_backward(alpha=0.3, theta_alpha=np.pi / 6, theta_s=0.0) == pytest.approx(
        0.15, abs=ROUNDING
    )
    assert energy_margin_forward(beta=0.3, theta_beta=np.pi / 6, theta_s=0.0) == pytest.approx(
        0.15, abs=ROUNDING
    )


def test_energy_margin_keeps_its_digits_near_the_upright():
    # limit: alpha w^2 / 2 with w = 1e-8; 1 - sin would give zero
    back = energy_margin_backward(alpha=2.0, theta_alpha=np.pi / 4, theta_s=np.pi / 4 - 1e-8)
    assert back == pytest.approx(1e-16, rel=1e-6)


def test_energy_margin_is_the_smaller():
    assert energy_margin(backward=0.2, forward=0.1) == 0.1
    assert energy_margin(backward=-0.2, forward=0.1) == -0.2


def force_angle_in_space(*, x_0, x_n, C_L, C_N, theta_s, a, M, g):
    """Papadopoulos & Rey's construction with vectors in three dimensions, axis by axis."""
    com = np.array([*world(C_L, C_N, theta_s), 0.0])
    up = np.array([np.cos(theta_s), np.sin(theta_s), 0.0])
    f = M * (np.array([0.0, -g, 0.0]) - a * up)
    measures = []
    for x, axis in ((x_0, np.array([0.0, 0.0, 1.0])), (x_n, np.array([0.0, 0.0, -1.0]))):
        to_axis = np.array([*world(x, 0.0, theta_s), 0.0]) - com
        f_hat = f / np.linalg.norm(f)
        l_hat = to_axis / np.linalg.norm(to_axis)
        sine = np.dot(np.cross(l_hat, f_hat), axis)  # positive: f passes inside of the axis
        angle = np.arctan2(sine, np.dot(l_hat, f_hat))
        d = np.linalg.norm(to_axis - np.dot(to_axis, f_hat) * f_hat)
        measures.append(angle * d * np.linalg.norm(f))
    return min(measures)


@pytest.mark.parametrize("theta_s", [-0.5, 0.0, 0.6, 1.1, 1.3])
@pytest.mark.parametrize("a", [-6.0, 0.0, 4.0])
def test_force_angle_measure_by_vectors(theta_s, a):
    # oracle
    pose = {**POSE, "theta_s": theta_s, "a": a, "M": 23.0, "g": 9.8}
    assert force_angle_measure(**pose) == pytest.approx(
        force_angle_in_space(**pose),
        abs=1e-10,  # 100 N m of rounding at 1e-12
    )


def test_force_angle_measure_by_hand():
    # hand: level, both angles 45 degrees, d = 0.1 m, |f| = 100 N
    pose = {"x_0": 0.3, "x_n": 0.1, "C_L": 0.2, "C_N": 0.1, "theta_s": 0.0, "a": 0.0, "M": 10.0}
    assert force_angle_measure(**pose, g=10.0) == pytest.approx(np.pi / 4 * 0.1 * 100.0, abs=1e-11)
    assert force_angle_measure(**pose) == pytest.approx(np.pi / 4 * 9.80665, abs=1e-11)


def test_force_angle_measure_changes_sign_where_the_robot_tips():
    # limit: tan(theta) = (x_0 - C_L) / C_N and its counterpart downhill
    pose = {**POSE, "a": 0.0, "M": 10.0}
    for limit in (np.arctan(0.21 / 0.08), np.arctan(-0.16 / 0.08)):
        inside = force_angle_measure(**pose, theta_s=limit - np.copysign(1e-3, limit))
        outside = force_angle_measure(**pose, theta_s=limit + np.copysign(1e-3, limit))
        assert inside > 0.0 > outside


def test_kinetic_energy_height():
    # hand: 0.1 m/s is half a millimetre
    assert kinetic_energy_height(v=0.1, g=10.0) == pytest.approx(0.0005, abs=1e-16)
    assert kinetic_energy_height(v=-4.0) == pytest.approx(16.0 / 19.6133, abs=1e-13)
