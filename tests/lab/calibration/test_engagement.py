"""Engagement of grousers: a log read by hand, forces in balance, and the study's own counts."""

import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

from calibration_cases import engaged_here
from kaidan.lab.calibration.engagement import (
    BASE,
    ROBOT,
    Engaged,
    designs,
    engaged,
    engagement,
    in_store,
    rule,
    trial_of,
)
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.physics import DrivenGrousers, record
from physics_cases import spec

HOLDS = {**BASE, "angle": math.radians(32.5), "friction": 0.6}


def test_a_log_is_read_as_by_hand():
    log = record(spec(30.0, log_interval=0.004))  # hangs 0.3 of 150 mm over, passes two nosings
    assert log.result.nosings_passed == 2
    rows = 100
    path = np.linspace(0.0, 0.3, rows)
    slip = np.where(path < 0.045, 0.5, np.where(path < 0.195, 0.010, 0.014))
    columns = {**log.columns, "path_m": path, "slip_m": slip, "speed_m_s": np.full(rows, 0.1)}
    columns["speed_m_s"][50] = -0.5
    columns["time_s"] = path
    forces = np.zeros((rows, 2, 2))
    forces[10:15, 0] = (30.0, 40.0)  # 50 N for 20 ms
    forces[40, 1] = (0.0, 200.0)  # a blow: one sample of five, so a mean of 40 N
    found = engaged(replace(log, columns=columns, grousers=forces))
    assert found.outcome == "climbed"
    assert found.slip == pytest.approx(0.004)
    assert found.slip_height == pytest.approx(0.25 / (2 * STANDARD_GRAVITY))
    assert found.grouser_force == pytest.approx(50.0 / (20.0 * STANDARD_GRAVITY))


def test_what_grousers_and_nosings_bear_is_the_weight():
    # by hand: at rest the ground bears the weight, on 10 mm grousers all of it through them
    log = record(
        spec(32.0, 0.2, robot=ROBOT, friction=0.8, track=DrivenGrousers(), speed=0.02, nosings=1,
             log_interval=0.02, start_offset=0.1)
    )  # fmt: skip
    early = slice(0, 5)
    weight = 20.0 * STANDARD_GRAVITY
    slope = math.radians(32.0)
    total = log.forces[early].sum(axis=1).mean(axis=0)
    assert total == pytest.approx([weight * math.sin(slope), weight * math.cos(slope)], rel=0.03)
    assert (np.abs(log.grousers[early]).sum(axis=(1, 2)) > 0).all()
    on_belt = log.forces[early].sum(axis=1) - log.grousers[early].sum(axis=1)
    assert (on_belt[:, 1] > -1e-9).all()
    assert record(spec(30.0, nosings=1, start_offset=0.1)).grousers.shape[1] == 0


def stub(specs):
    """Trials that climb from a friction of 0.4 on."""
    return [
        Engaged("climbed" if each.static_friction >= 0.4 else "slid", 0.01 * k, 0.002, 0.5)
        for k, each in enumerate(specs, start=1)
    ]


def test_cells_have_the_largest_of_their_trials_and_the_rule():
    found = engagement(stub, trials=2, slopes=(32.5,), frictions=(0.2, 0.6))
    assert len(found.cells) == 2 * len(designs())
    slides, climbs = found.cells[:2]
    assert (slides.outcomes, slides.slip_m, slides.climbed) == ({"slid": 2}, None, False)
    assert (climbs.outcomes, climbs.slip_m) == ({"climbed": 2}, pytest.approx(0.04))
    required, height, energy = rule(**HOLDS)
    assert climbs.required_friction == pytest.approx(required)
    assert climbs.rule_slip_height_m == pytest.approx(height)
    assert climbs.energy_margin_m == pytest.approx(energy)
    assert climbs.rule_holds is (required <= 0.6)
    assert found.wrong == []
    text = str(found)
    assert "x 2 of 2" in text
    assert f"40, {0.002 / energy:.2f}, 0.5" in text
    assert type(found).from_json(found.to_json()) == found
    low = engagement(
        lambda specs: [Engaged("slid", 0.0, 0.0, 0.0)] * len(specs), slopes=(32.5,),
        frictions=(0.9,), trials=1,
    )  # fmt: skip
    assert low.wrong
    assert all(each.rule_holds for each in low.wrong)


def test_a_slip_by_a_spacing_is_the_closed_forms():
    # by hand: s (sin - mu_k cos) on a flight, mu_k 0.8 of mu
    angle, s = HOLDS["angle"], BASE["spacing"]
    by_hand = s * (math.sin(angle) - 0.8 * 0.2 * math.cos(angle))
    assert rule(**{**HOLDS, "friction": 0.2})[1] == pytest.approx(by_hand, rel=0.05)


def test_trials_are_kept_and_found_again(tmp_path):
    short = {"nosings": 1, "log_interval": 0.02, "start_offset": 0.1}
    trial = trial_of(**HOLDS, seed=1).model_copy(update=short)
    kept = in_store(tmp_path / "store", workers=1)
    assert kept([trial]) == engaged_here([trial]) == kept([trial])


@pytest.mark.slow
def test_no_trial_slides_for_good_where_the_rule_says_that_it_holds():
    found = engagement(engaged_here, trials=1, slopes=(32.5, 44.0), frictions=(0.4, 0.6, 1.0))
    assert sum(each.rule_holds for each in found.cells) >= 15
    assert found.wrong == []
    assert all(
        each.slip_m <= each.spacing_m + 0.005 for each in found.cells if each.slip_m is not None
    )
