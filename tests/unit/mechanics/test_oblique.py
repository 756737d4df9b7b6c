import numpy as np
import pytest

from kaidan.mechanics.oblique import (
    body_inclination,
    equivalent_slope_across,
    equivalent_slope_along,
    oblique_friction,
    oblique_spacing,
    roll,
    track_lag,
)

CASES = [(0.5, 0.0), (0.6, 0.4), (0.9, -0.7), (-0.3, 1.2)]


def axes(theta_s, psi):
    """Heading, left axis and normal of the body in level coordinates (x ahead of the stairs)."""
    uphill = np.array([np.cos(theta_s), 0.0, np.sin(theta_s)])
    across = np.array([0.0, 1.0, 0.0])  # to the left of somebody who looks up the stairs
    heading = np.cos(psi) * uphill + np.sin(psi) * across
    left = -np.sin(psi) * uphill + np.cos(psi) * across
    return heading, left, np.cross(heading, left)


def rotation(yaw, inclination, roll):
    """Yaw about up, then the nose up by the inclination, then roll about the heading."""
    cy, sy, ci, si, cr, sr = (f(x) for x in (yaw, inclination, roll) for f in (np.cos, np.sin))
    turn = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    nose_up = np.array([[ci, 0, -si], [0, 1, 0], [si, 0, ci]])
    lean = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    return turn @ nose_up @ lean


def test_oblique_spacing():
    # hand: 3-4-5
    assert oblique_spacing(p=0.2, psi=np.arctan(0.75)) == pytest.approx(0.25, abs=1e-15)
    assert oblique_spacing(p=0.2, psi=-np.arctan(0.75)) == pytest.approx(0.25, abs=1e-15)
    assert oblique_spacing(p=0.2, psi=1.5) == pytest.approx(0.2 / np.cos(1.5), abs=1e-15)
    assert np.isnan(oblique_spacing(p=0.2, psi=np.pi / 2))
    assert np.isnan(oblique_spacing(p=0.2, psi=-2.0))


@pytest.mark.parametrize(("theta_s", "psi"), CASES)
def test_equivalent_slopes_split_the_weight(theta_s, psi):
    # oracle: components of weight and inertia in the axes of the body
    a, g = 1.3, 9.8
    heading, left, normal = axes(theta_s, psi)
    load = np.array([0.0, 0.0, -g]) - a * heading
    press = -load @ normal
    along = equivalent_slope_along(theta_s=theta_s, psi=psi, a=a, g=g)
    across = equivalent_slope_across(theta_s=theta_s, psi=psi)
    assert along == pytest.approx(-load @ heading / press, abs=1e-14)
    assert across == pytest.approx(load @ left / press, abs=1e-14)
    tangential = np.linalg.norm(load + press * normal)
    friction = oblique_friction(theta_s=theta_s, psi=psi, a=a, g=g)
    assert friction == pytest.approx(tangential / press, abs=1e-14)


def test_standard_gravity_is_the_default():
    # hand: one g along the heading on the level is a slope of 45 degrees
    assert equivalent_slope_along(theta_s=0.0, psi=0.3, a=9.80665) == pytest.approx(1.0, abs=1e-15)
    assert oblique_friction(theta_s=0.0, psi=0.3, a=9.80665) == pytest.approx(1.0, abs=1e-15)


def test_required_friction_does_not_depend_on_the_yaw():
    # hand: the weight is the same
    psi = np.linspace(-3.0, 3.0, 13)
    np.testing.assert_allclose(
        oblique_friction(theta_s=np.arctan(0.75), psi=psi, a=0.0), 0.75, rtol=1e-15
    )


@pytest.mark.parametrize(("theta_s", "psi"), CASES)
def test_track_lag_by_coordinates(theta_s, psi):
    # oracle: nosings are lines of constant distance up the slope; a point half a gauge to the
    # right of the middle must go that much further back to meet the one the left point meets
    gauge = 0.3
    uphill = np.array([np.cos(theta_s), 0.0, np.sin(theta_s)])
    heading, left, _ = axes(theta_s, psi)
    left_point, right_point = gauge / 2 * left, -gauge / 2 * left
    lead_of_right = (right_point - left_point) @ uphill / (heading @ uphill)
    assert track_lag(gauge=gauge, psi=psi) == pytest.approx(lead_of_right, abs=1e-14)


def test_track_lag_outside_validity_is_nan():
    assert track_lag(gauge=0.3, psi=1.5) == pytest.approx(0.3 * np.tan(1.5), abs=1e-14)
    assert np.isnan(track_lag(gauge=0.3, psi=np.pi / 2))
    assert np.isnan(track_lag(gauge=0.3, psi=-np.pi / 2))


@pytest.mark.parametrize(("theta_s", "psi"), CASES)
def test_inclination_and_roll_rebuild_the_body(theta_s, psi):
    # oracle: yaw, inclination and roll composed must give the body's axes again
    heading, left, normal = axes(theta_s, psi)
    yaw = np.arctan2(heading[1], heading[0])
    turned = rotation(
        yaw, body_inclination(theta_s=theta_s, psi=psi), roll(theta_s=theta_s, psi=psi)
    )
    np.testing.assert_allclose(turned, np.column_stack([heading, left, normal]), atol=1e-14)


def test_heading_left_leaves_the_left_side_low():
    # hand: half across a 45 degree slope: tan = sin 30
    assert roll(theta_s=np.pi / 4, psi=np.pi / 6) == pytest.approx(-np.arctan(0.5), abs=1e-15)
