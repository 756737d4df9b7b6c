import numpy as np
import pytest

from kaidan.mechanics.margin import theta_s_sup
from kaidan.mechanics.oblique import (
    body_inclination,
    equivalent_slope_across,
    equivalent_slope_along,
    oblique_friction,
    oblique_spacing,
    track_lag,
)
from kaidan.mechanics.oblique_support import (
    edge_energy,
    edge_limit,
    edge_slack,
    other_offset,
    sideways_limit,
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
    roll = -np.arctan(np.tan(theta_s) * np.sin(psi))
    turned = rotation(yaw, body_inclination(theta_s=theta_s, psi=psi), roll)
    np.testing.assert_allclose(turned, np.column_stack([heading, left, normal]), atol=1e-14)


# --- the polygon of both tracks' contacts -------------------------------------------------------

GAUGE, C_N, G = 0.5, 0.2, 9.8
EDGES = [
    (0.5, 0.0, 0.30, 0.30),
    (0.6, 0.4, 0.10, 0.25),
    (0.9, -0.7, 0.35, 0.05),
    (0.4, 1.0, 0.2, 0),
]
"""Slope, yaw, distances of the left and the right contact downhill of the centroid's foot."""


@pytest.mark.parametrize("a", [0.0, 1.3, -2.0])
@pytest.mark.parametrize(("theta_s", "psi", "left_at", "right_at"), EDGES)
def test_slack_of_an_edge_in_space(theta_s, psi, left_at, right_at, a):
    # oracle: where the resultant through the centroid meets the underside, and how far ahead of
    # the line through both contacts that is
    heading, left, normal = axes(theta_s, psi)
    load = np.array([0.0, 0.0, -G]) - a * heading
    meets = C_N * normal - load * C_N / (load @ normal)
    share = (meets @ left + GAUGE / 2) / GAUGE  # 0 at the right track, 1 at the left
    edge = -right_at + share * (right_at - left_at)
    # l - r: the left contact lies that much farther from the rear tip
    kappa = np.cos(psi) + (right_at - left_at) * np.sin(psi) / GAUGE
    x = (left_at + right_at) / 2
    found = edge_slack(x=x, kappa=kappa, C_N=C_N, theta_s=theta_s, a=a, g=G)
    assert found == pytest.approx(meets @ heading - edge, abs=1e-14)


@pytest.mark.parametrize("a", [0.0, 1.3, -2.0])
@pytest.mark.parametrize(("x", "kappa"), [(0.3, 1.0), (0.1, 0.4), (-0.05, 1.3)])
def test_at_the_limit_the_slack_is_used_up(x, kappa, a):
    at = {"x": x, "kappa": kappa, "C_N": C_N, "a": a, "g": G}
    assert edge_slack(theta_s=edge_limit(**at), **at) == pytest.approx(0.0, abs=1e-14)


def test_limit_of_an_edge_straight_on_is_the_papers_margin():
    L, C_L, p, a = 0.470, 0.196, 0.150, 0.7
    found = edge_limit(x=L - p - C_L, kappa=1.0, C_N=0.071, a=a)
    assert found == pytest.approx(theta_s_sup(L=L, p=p, C_L=C_L, C_N=0.071, a=a), abs=1e-14)


def test_where_there_is_no_limit_of_an_edge():
    # hand: 3-4-5; at a = 12.5 with g = 10 the ratio is 1, arccos 0
    at = {"x": 0.3, "C_N": 0.4, "g": 10.0}
    assert edge_limit(kappa=1.0, a=12.5, **at) == pytest.approx(-np.arctan2(4, 3), abs=1e-15)
    assert np.isnan(edge_limit(kappa=1.0, a=12.6, **at))
    assert np.isnan(edge_limit(kappa=1.0, a=-12.6, **at))
    assert np.isnan(edge_limit(kappa=0.0, a=0.0, **at))


def test_standard_gravity_is_that_of_the_edges():
    # hand: one g along the heading on the level moves the point by C_N
    one_g = 9.80665
    at = {"kappa": 1.0, "C_N": C_N, "a": one_g}
    assert edge_slack(x=0.3, theta_s=0.0, **at) == pytest.approx(0.1, abs=1e-15)
    assert edge_limit(x=C_N, **at) == pytest.approx(0.0, abs=1e-15)
    lean = {"slope": 0.0, "C_N": 1.0, "theta_s": 0.0, "psi": 0.0, "a": one_g}
    assert edge_energy(x=1.0, **lean) == pytest.approx(0.0, abs=1e-15)  # 45 degrees both


@pytest.mark.parametrize(
    ("gauge", "psi", "tangent"),
    [(0.6, np.pi / 2, 0.75), (0.6, np.pi / 6, 1.5), (0.3, -np.pi / 6, 0.75), (0.6, 0.0, np.inf)],
)
def test_sideways_limit(gauge, psi, tangent):
    # hand: gauge / (2 C_N |sin psi|) with C_N = 0.4
    found = sideways_limit(gauge=gauge, C_N=0.4, psi=psi)
    assert found == pytest.approx(np.arctan(tangent), abs=1e-15)


@pytest.mark.parametrize("a", [0.0, 1.3, -2.0])
@pytest.mark.parametrize(("theta_s", "psi", "left_at", "right_at"), EDGES)
def test_energy_over_an_edge_is_the_highest_rise_of_a_rotation(theta_s, psi, left_at, right_at, a):
    # oracle: rotate the centroid about the line through both contacts and watch its height
    # against the direction that counts as up
    heading, left, normal = axes(theta_s, psi)
    up = np.array([0.0, 0.0, 1.0]) + a / G * heading
    at_left = -left_at * heading + GAUGE / 2 * left
    at_right = -right_at * heading - GAUGE / 2 * left
    axis = (at_left - at_right) / np.linalg.norm(at_left - at_right)
    r = C_N * normal - at_right
    r = r - (r @ axis) * axis
    angle = np.linspace(-np.pi, np.pi, 200_001)
    heights = np.cos(angle) * (r @ up) + np.sin(angle) * (np.cross(axis, r) @ up)
    found = edge_energy(
        x=(left_at + right_at) / 2, slope=(right_at - left_at) / GAUGE, C_N=C_N,
        theta_s=theta_s, psi=psi, a=a, g=G,
    )  # fmt: skip
    assert found == pytest.approx(heights.max() - r @ up, abs=1e-9)  # grid: 3e-5 rad, squared


def test_offset_of_the_other_track():
    # hand: q = 0.125; the left track's nosings stand 0.6 * 0.75 = 0.45 ahead: 0.45 = 3 q + 0.075
    psi = np.arctan(0.75)
    at = {"p": 0.1, "gauge": 0.6}
    assert other_offset(psi=psi, **at) == pytest.approx(0.075, abs=1e-15)
    assert other_offset(psi=-psi, **at) == pytest.approx(0.05, abs=1e-15)
    assert other_offset(psi=0.0, **at) == pytest.approx(0.1, abs=1e-15)
