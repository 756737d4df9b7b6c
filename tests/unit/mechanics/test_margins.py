import numpy as np
import pytest

from kaidan.mechanics.margins import Mode, margins

# L - p - C_L = C_L - p = 1/8 m over C_N = 1/8 m: both tip limits at 45 degrees, exactly
EVEN = {"L": 0.5, "C_L": 0.25, "C_N": 0.125, "p": 0.125}


def governing(**changes):
    m = margins(**{**EVEN, "theta_s": 0.0, "mu_s": 0.5, **changes})
    return Mode(int(m.governs)), float(m.worst)


@pytest.mark.parametrize(
    ("changes", "mode", "worst"),
    [
        # hand: limits in tangents: tip 1, slip mu
        ({"theta_s": 0.2}, Mode.SLIP_UP, np.arctan(0.5) - 0.2),
        ({"theta_s": -0.2}, Mode.SLIP_DOWN, np.arctan(0.5) - 0.2),
        ({"theta_s": 0.2, "mu_s": 2.0}, Mode.TIP_DOWNHILL, np.pi / 4 - 0.2),
        ({"theta_s": -0.2, "mu_s": 2.0}, Mode.TIP_UPHILL, np.pi / 4 - 0.2),
        ({"theta_s": 0.2, "mu_s": np.nan}, Mode.TIP_DOWNHILL, np.pi / 4 - 0.2),
        ({"mu_s": 2.0, "theta_M": 0.1}, Mode.TIP_DOWNHILL, np.pi / 4 - 0.1),
        ({"theta_s": -0.1, "mu_s": 2.0, "theta_d": 0.1}, Mode.TIP_UPHILL, np.pi / 4 - 0.2),
        # ties go to the first of the list
        ({}, Mode.SLIP_UP, np.arctan(0.5)),
        ({"mu_s": 2.0}, Mode.TIP_DOWNHILL, np.pi / 4),
        ({"mu_s": 1.0}, Mode.TIP_DOWNHILL, np.pi / 4),
        ({"mu_s": 1.0, "theta_s": -0.25}, Mode.TIP_UPHILL, np.pi / 4 - 0.25),
    ],
)
def test_what_governs(changes, mode, worst):
    found = governing(**changes)
    assert found[0] == mode
    assert found[1] == pytest.approx(worst, abs=1e-15)
