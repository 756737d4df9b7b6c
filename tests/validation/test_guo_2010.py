"""Single step after Guo, Song, Bao, Zhang & Tang 2010, doi:10.5772/10493.

Their text was not at hand; the question is theirs (how the place of the centroid decides the step
that a tracked robot can climb), the formulas are re-derived, the expected values are by hand.
"""

import numpy as np
import pytest

from kaidan.mechanics.transitions import (
    best_inclination,
    largest_step_height,
    step_height,
)

ROUNDING = 1e-14  # lengths below one metre


def test_step_height_of_a_point_on_a_plank():
    # hand: R = 0, C_N = 0: the lever alone
    assert step_height(theta=np.pi / 6, l_c=0.4, C_N=0.0, R=0.0) == pytest.approx(0.2, abs=ROUNDING)


def test_step_height_by_hand():
    # hand: sin = 0.6, cos = 0.8: 0.2 * 0.06 + 0.6 * (0.3 - 0.75 * 0.08)
    assert step_height(theta=np.arctan(0.75), l_c=0.3, C_N=0.08, R=0.06) == pytest.approx(
        0.012 + 0.144, abs=ROUNDING
    )


@pytest.mark.parametrize("t", [0.5, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("P", [1.0, 1.5, 2.0])
def test_cubic_by_construction(t, P):
    # hand: choose the root, take l_c = (t^3 + P t) C_N and R = (2 - P) C_N
    C_N = 0.09
    found = best_inclination(l_c=(t**3 + P * t) * C_N, C_N=C_N, R=(2.0 - P) * C_N)
    assert np.tan(found) == pytest.approx(t, rel=1e-13)


def test_highest_step_beats_every_other_inclination():
    # oracle: a scan
    robot = {"l_c": 0.274, "C_N": 0.071, "R": 0.06}
    theta = np.linspace(0.0, np.arctan(0.274 / 0.071) - 1e-9, 20_001)
    scan = step_height(theta=theta, **robot)
    best = largest_step_height(**robot)
    assert np.max(scan) <= best
    # flat top: half a cell of 7e-5 rad squared, times a curvature of order one
    assert np.max(scan) == pytest.approx(best, abs=1e-8)


def test_centroid_forward_and_low_climbs_higher():
    # paper (title and abstract): the centroid decides; hand: dH/dl_c = sin > 0,
    # dH/dC_N = -sin tan < 0 at the best inclination
    forward = largest_step_height(l_c=np.linspace(0.15, 0.4, 20), C_N=0.07, R=0.06)
    high = largest_step_height(l_c=0.27, C_N=np.linspace(0.062, 0.2, 20), R=0.06)
    assert np.all(np.diff(forward) > 0.0)
    assert np.all(np.diff(high) < 0.0)
