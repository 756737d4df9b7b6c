"""How far the centroid has to be shifted, on samples and steps made by hand."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.models import centroid

NEARLY_NONE = 1e-16
"""Height of the centroid that leans by 1.63 m on a slope that stands upright to rounding [m]."""


@pytest.fixture
def shift(monkeypatch):
    """Shift of a robot 1 m long, of blocks of (nosing spacing, slope), each sample by step."""

    def of(*blocks, C_L, C_N=0.1, downhill=True, risk=0.0):
        def draws(question, at):
            for p, theta_s in blocks:
                p, theta_s = np.broadcast_arrays(np.array(p, dtype=float), theta_s)
                L, C_F, C = (np.full((len(p), 1), each) for each in (1.0, C_L, C_N))
                yield SimpleNamespace(L=L, C_L=C_F, C_N=C, p=p, theta_s=theta_s)

        monkeypatch.setattr(centroid, "nominal", lambda question, flight: None)
        monkeypatch.setattr(centroid, "draws", draws)
        none = SimpleNamespace(high=0.0)
        question = SimpleNamespace(
            steepest_flight="a flight", yaw=0.0, allowance_d=none, allowance_M=none,
            acceleration=0.0, risk=risk,
        )  # fmt: skip
        return centroid.shift_of_centroid(question, downhill=downhill)

    return of


@pytest.mark.parametrize(("risk", "lacks"), [(0.0, 0.25), (0.4, 0.05)])
def test_the_worst_step_of_each_sample_and_the_sample_at_the_risk(shift, risk, lacks):
    """Level: downhill L - p - C_L is left, 0.95 m from the other end -0.25, -0.05 and -0.05."""
    blocks = (
        ([[0.1, 0.2], [0.1, 0.1], [0.1, 0.1]], 0.0),
        ([[0.1, 0.3], [0.1, 0.1], [0.1, 0.1]], 0.0),
    )
    for order in (blocks, blocks[::-1]):
        assert shift(*order, C_L=0.95, risk=risk) == pytest.approx(lacks)
        # uphill C_L - p is left
        assert shift(*order, C_L=0.05, risk=risk, downhill=False) == pytest.approx(lacks)


def test_a_step_for_which_any_shift_is_too_far_leaves_none(shift):
    """Longer than half of the track, 1 - 2 p < 0; half of it is just enough."""
    assert shift(([[0.1, 0.6]], 0.0), C_L=0.95) is None
    assert shift(([[0.1, 0.6]], 0.0), C_L=0.05, downhill=False) is None
    assert shift(([[0.1, 0.5]], 0.0), C_L=0.95) == pytest.approx(0.45)


@pytest.mark.parametrize(("slope", "C_N"), [(1.6, 0.01), (math.pi / 2, NEARLY_NONE)])
def test_a_step_that_leans_over_leaves_none(shift, slope, C_N):
    """Its tangent is negative, or as good as infinite: no margin of it is one."""
    assert shift(([[0.1, 0.1]], [[0.0, slope]]), C_L=0.95, C_N=C_N) is None
    assert shift(([[0.1, 0.1]], [[0.0, 0.0]]), C_L=0.95, C_N=C_N) == pytest.approx(0.05)


def test_what_stands_just_so_needs_no_shift(shift):
    assert shift(([[0.1]], 0.0), C_L=0.9) is None
