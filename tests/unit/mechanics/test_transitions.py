import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from kaidan.mechanics.transitions import (
    best_inclination,
    largest_step_height,
    step_height,
)

ROBOTS = [  # l_c, C_N, R
    (0.274, 0.071, 0.060),  # Kenaf's centroid with an end radius of ours
    (0.3, 0.1, 0.1),
    (0.2, 0.15, 0.0),
    (0.5, 0.08, 0.12),  # R > C_N and yet on the flat
]


def edge_under_the_centroid(theta, l_c, C_N, R):
    """Height of the point of the flat plumb under the centroid, from coordinates."""
    forward = np.array([np.cos(theta), np.sin(theta)])
    normal = np.array([-np.sin(theta), np.cos(theta)])
    rear_tip = np.array([0.0, R]) - R * normal
    com = rear_tip + l_c * forward + C_N * normal
    s = (com[0] - rear_tip[0]) / forward[0]
    return (rear_tip + s * forward)[1]


@pytest.mark.parametrize(("l_c", "C_N", "R"), ROBOTS)
@pytest.mark.parametrize("theta", [0.0, 0.2, 0.7])
def test_step_height_by_coordinates(theta, l_c, C_N, R):
    # oracle
    height = step_height(theta=theta, l_c=l_c, C_N=C_N, R=R)
    assert height == pytest.approx(edge_under_the_centroid(theta, l_c, C_N, R), abs=1e-14)


def test_step_height_ends_where_the_plumb_line_leaves_the_flat():
    # limit: C_N tan(theta) = l_c, where only the tail's own height is left
    theta = np.arctan(2.0)
    inside = step_height(theta=theta - 1e-9, l_c=0.2, C_N=0.1, R=0.05)
    assert inside == pytest.approx(0.05 * (1.0 - np.cos(theta)), abs=1e-8)
    assert np.isnan(step_height(theta=theta + 1e-9, l_c=0.2, C_N=0.1, R=0.05))
    assert step_height(theta=0.0, l_c=0.0, C_N=0.1, R=0.05) == 0.0  # equality is still on it


@pytest.mark.parametrize(("l_c", "C_N", "R"), ROBOTS)
def test_best_inclination_maximises_the_step(l_c, C_N, R):
    # oracle: bounded numerical maximum; flat top, so the angle is good to sqrt(1e-16) only
    found = minimize_scalar(
        lambda theta: -edge_under_the_centroid(theta, l_c, C_N, R),
        bounds=(0.0, np.pi / 2 - 1e-3),
        method="bounded",
        options={"xatol": 1e-10},
    )
    assert best_inclination(l_c=l_c, C_N=C_N, R=R) == pytest.approx(found.x, abs=1e-6)
    assert largest_step_height(l_c=l_c, C_N=C_N, R=R) == pytest.approx(-found.fun, abs=1e-14)


def test_best_inclination_solves_the_cubic():
    # hand: t = 1 for C_N = R, l_c = 2 R; t = 1 for R = 0, l_c = 3 C_N
    assert best_inclination(l_c=0.2, C_N=0.1, R=0.1) == pytest.approx(np.pi / 4, abs=1e-15)
    assert best_inclination(l_c=0.3, C_N=0.1, R=0.0) == pytest.approx(np.pi / 4, abs=1e-15)


def test_best_inclination_where_the_edge_would_meet_the_rear_end():
    # hand: R = 1.5 C_N gives t^3 + t/2 = Q; t = Q at Q^2 = 1/2
    limit = np.sqrt(0.5) * 0.1
    assert np.isnan(best_inclination(l_c=limit * (1.0 - 1e-9), C_N=0.1, R=0.15))
    found = best_inclination(l_c=limit * (1.0 + 1e-9), C_N=0.1, R=0.15)
    assert np.tan(found) == pytest.approx(np.sqrt(0.5), abs=1e-8)


def test_centroid_over_the_rear_tip_climbs_nothing():
    # limit: l_c = 0 with R = C_N: t^3 + t = 0, the edge at the rear tip itself
    assert best_inclination(l_c=0.0, C_N=0.1, R=0.1) == 0.0
    assert largest_step_height(l_c=0.0, C_N=0.1, R=0.1) == 0.0


def test_best_inclination_without_a_closed_form_is_nan():
    # R = 2 C_N and beyond; no warning on the way
    assert np.isnan(best_inclination(l_c=0.3, C_N=0.1, R=0.2))
    assert np.isnan(largest_step_height(l_c=0.3, C_N=0.1, R=0.25))


def test_large_step_of_a_flat_robot():
    # limit: C_N -> 0 is a plank, which balances at any inclination: the step tends to l_c
    assert largest_step_height(l_c=1.0, C_N=1e-9, R=0.0) == pytest.approx(1.0, abs=1e-5)
