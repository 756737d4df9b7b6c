"""Calibration on the paper's text: what docs/lab/calibration.md records, in short where that tells.

The sources of expected figures: the text of Endo & Nagatani 2016, or our own record, tagged.
"""

import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from calibration_cases import here
from kaidan import Robot
from kaidan.lab.calibration.bench import Bench
from kaidan.lab.calibration.effects import effects
from kaidan.lab.calibration.evidence import PAPER
from kaidan.lab.calibration.fitting import compliance_grid, fit
from kaidan.lab.calibration.report import calibrate, theta_d_reproduced, zone_reproduced

KENAF = Robot.named("kenaf")


def test_compliance_alone_explains_theta_d_and_not_the_fall_zone():
    grid = compliance_grid(KENAF, (3.2e4, 1.28e5), (0.03,), ("steps",))
    found = fit(Bench(here, trials=2), PAPER, "sprung-noses", grid)
    assert found.best.values["stiffness_N_m"] == 3.2e4  # own record
    assert theta_d_reproduced(PAPER, found.best)  # text: 2.6 deg
    assert not zone_reproduced(found.best)  # own record: it does not fall at 57 deg


@pytest.mark.slow
def test_figures_of_the_calibration(capsys):
    """A small grid of the compliance; the whole of it is `kaidan lab calibrate compliance`."""
    grid = compliance_grid(KENAF, (2.2e4, 3.2e4, 4.5e4), (0.02, 0.03), ("steps", "noses"))
    found = calibrate(Bench(here), "kenaf", "sprung-noses", grid, judged=2)
    with capsys.disabled():
        for line in found.lines:
            print(f"\n{'yes' if line.reproduced else 'NO'} {line.text}", end="")
    assert found.lines[1].reproduced  # theta_d; text: 2.6 deg
    told = {each.name: each for each in found.blind[0].predictions}
    assert told["falls"].value == 0  # text: no fall at (200 mm, 44.0 deg)
    assert told["rotation"].reproduced  # text: the body swings
    # own record: right sign, too large; see docs/lab/calibration.md
    assert told["theta_M"].off > 0
    assert not any(each.value is None for each in told.values())


@pytest.mark.slow
def test_figures_of_the_grousers(capsys):
    """The grousers of the table 28 mm apart; the whole of it is `kaidan lab calibrate effects`."""
    found = effects(
        Bench(here, trials=2, nosings=10), KENAF, varied={"spacing": (0.028,)}, step=3.0
    )
    smooth, usual = found.effects
    with capsys.disabled():
        for each in (smooth, usual):
            print(f"\n{each.varied}: up {each.up.value_deg:.1f}, down {each.down.value_deg:.1f}, "
                  f"theta_M {each.theta_M_deg:.1f} +- {each.deviation_deg:.1f}",
                  end="")  # fmt: skip
    # own record, docs/lab/calibration.md: 62.5, 56.5 up, 70.5, 55.5 down; 3 deg: the grid's step
    assert smooth.up.value_deg == pytest.approx(62.5, abs=3.0)
    assert usual.up.value_deg == pytest.approx(56.5, abs=3.0)
    assert smooth.down.value_deg == pytest.approx(70.5, abs=3.0)
    assert usual.down.value_deg == pytest.approx(55.5, abs=3.0)
    assert usual.theta_M_deg < PAPER.theta_M[0]  # text: 1.2 to 2.6 deg; not reproduced
