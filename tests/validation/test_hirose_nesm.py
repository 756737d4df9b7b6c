"""Normalised energy stability margin of Hirose, Tsukagoshi & Yoneda (CLAWAR 1998).

Their text was not at hand: everything here is by hand from the definition, the height by which
the centroid must rise before the robot goes over.
"""

import numpy as np
import pytest

from kaidan.mechanics.measures import (
    energy_margin,
    energy_margin_backward,
    energy_margin_forward,
    static_margin_downhill,
)
from kaidan.mechanics.triangle import alpha, beta, theta_alpha, theta_beta

ROUNDING = 1e-14  # lengths of order one


def margins_of(*, x_0, x_n, C_L, C_N, theta_s):
    """Both sides for contacts at x_0 and x_n behind the uphill tip."""
    pose = {"C_L": C_L, "C_N": C_N}
    span = {"d": x_n, "k": 1, "p": x_0 - x_n, **pose}
    back = energy_margin_backward(
        alpha=alpha(**span), theta_alpha=theta_alpha(**span), theta_s=theta_s
    )
    forward = energy_margin_forward(
        beta=beta(d=x_n, **pose), theta_beta=theta_beta(d=x_n, **pose), theta_s=theta_s
    )
    return back, forward


CUBE = {"x_0": 2.0, "x_n": 0.0, "C_L": 1.0, "C_N": 1.0}


def test_cube_on_the_level():
    # hand: half the diagonal minus half the side
    for side in margins_of(**CUBE, theta_s=0.0):
        assert side == pytest.approx(np.sqrt(2.0) - 1.0, abs=ROUNDING)


def test_cube_on_a_slope_of_45_degrees():
    # hand: on its edge downhill; uphill it must climb from level with the edge to the diagonal
    back, forward = margins_of(**CUBE, theta_s=np.pi / 4)
    assert back == pytest.approx(0.0, abs=ROUNDING)
    assert forward == pytest.approx(np.sqrt(2.0), abs=ROUNDING)
    assert energy_margin(backward=back, forward=forward) == back


def test_cube_beyond_its_edge():
    # hand: 15 degrees past the upright
    back, _ = margins_of(**CUBE, theta_s=np.radians(60.0))
    assert back == pytest.approx(np.sqrt(2.0) * (np.cos(np.radians(15.0)) - 1.0), abs=ROUNDING)


def test_point_on_the_ground_needs_its_whole_distance():
    # limit: C_N = 0: it must rise by its distance from the edge
    back, forward = margins_of(x_0=3.0, x_n=0.0, C_L=1.0, C_N=0.0, theta_s=0.0)
    assert (back, forward) == pytest.approx((2.0, 1.0), abs=ROUNDING)


def test_same_static_margin_but_a_lower_robot_is_safer():
    # hand: why an energy margin is wanted: sqrt(1 + h^2) - h falls with h, the static one does not
    low = margins_of(x_0=2.0, x_n=0.0, C_L=1.0, C_N=0.5, theta_s=0.0)[0]
    high = margins_of(x_0=2.0, x_n=0.0, C_L=1.0, C_N=2.0, theta_s=0.0)[0]
    assert low == pytest.approx(np.sqrt(1.25) - 0.5, abs=ROUNDING)
    assert high == pytest.approx(np.sqrt(5.0) - 2.0, abs=ROUNDING)
    static = [
        static_margin_downhill(x_0=2.0, C_L=1.0, C_N=height, theta_s=0.0) for height in (0.5, 2.0)
    ]
    assert static[0] == static[1] == 1.0


def test_sign_agrees_with_the_static_margin():
    # hand: both vanish at tan(theta_s) = (x_0 - C_L) / C_N
    theta_s = np.linspace(-1.0, 1.5, 101)
    pose = {"x_0": 0.32, "C_L": 0.196, "C_N": 0.071}
    back, _ = margins_of(**pose, x_n=0.02, theta_s=theta_s)
    static = static_margin_downhill(**pose, theta_s=theta_s)
    np.testing.assert_array_equal(np.sign(back), np.sign(static))


def test_published_form_with_one_minus_cosine():
    # hand: h (1 - cos(theta)), theta the turn to the upright, is the form used in the literature
    pose = {"x_0": 0.32, "x_n": 0.02, "C_L": 0.196, "C_N": 0.071}
    theta_s = 0.4
    back, forward = margins_of(**pose, theta_s=theta_s)
    to_upright = np.arctan2(0.124, 0.071) - theta_s
    assert back == pytest.approx(np.hypot(0.124, 0.071) * (1 - np.cos(to_upright)), abs=ROUNDING)
    to_upright = np.arctan2(0.176, 0.071) + theta_s
    assert forward == pytest.approx(np.hypot(0.176, 0.071) * (1 - np.cos(to_upright)), abs=ROUNDING)
