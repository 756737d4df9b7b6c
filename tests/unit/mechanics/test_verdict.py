"""The verdict of many pairs against the formulas it is made of, one by one."""

import itertools
import math

import numpy as np
import pytest

from kaidan.mechanics.margin import (
    centroid_margin_downhill,
    centroid_margin_uphill,
)
from kaidan.mechanics.margins import Mode, acceleration_bounds, margins
from kaidan.mechanics.slipping import required_friction
from kaidan.mechanics.verdict import Verdict, judged

KENAF = {"L": 0.470, "C_L": 0.196, "C_N": 0.071}
"""paper, Table 1"""
ANGLES = [math.radians(angle) for angle in (10.0, 32.5, 50.0, 59.0, 62.0)]
CASES = list(itertools.product(ANGLES, (0.15, 0.2, 0.235), (0.4, 2.0, math.nan), (-1.5, 0.0, 2.0)))
ALLOWANCES = {"theta_d": 0.03, "theta_M": 0.02}


@pytest.mark.parametrize(("theta_s", "p", "mu_s", "a"), CASES)
def test_every_figure_is_that_of_its_formula(theta_s, p, mu_s, a):
    at = {**KENAF, "theta_s": theta_s, "p": p, "mu_s": mu_s}
    found = judged(**at, a=a, **ALLOWANCES)
    one = margins(**at, a=a, **ALLOWANCES)
    band = acceleration_bounds(**at)
    for name in ("theta_s_sup", "tip_downhill", "tip_uphill", "slip_up", "slip_down", "governs"):
        assert getattr(found, name) == pytest.approx(getattr(one, name), abs=0, nan_ok=True)
    assert found.margin == one.worst
    # sin and cos taken from the tangent: a few units of rounding of g
    assert found.a_max == pytest.approx(band.a_max, abs=1e-13)
    assert found.a_min == pytest.approx(band.a_min, abs=1e-13)
    centroid = min(
        centroid_margin_downhill(**KENAF, p=p, theta_s=theta_s + 0.05, a=a),
        centroid_margin_uphill(C_L=0.196, C_N=0.071, p=p, theta_s=theta_s - 0.03, a=a),
    )
    assert found.centroid == pytest.approx(centroid, abs=1e-14)  # rounding of lengths below 1 m
    assert found.required_friction == pytest.approx(required_friction(theta_s=theta_s, a=a))


def test_gravity_is_passed_on():
    # scaling: twice the gravity and twice the acceleration change no angle and double the bounds
    at = {**KENAF, "theta_s": 0.9, "p": 0.15, "mu_s": 2.0, **ALLOWANCES}
    once, twice = judged(**at, a=1.0, g=9.0), judged(**at, a=2.0, g=18.0)
    assert twice.margin == pytest.approx(once.margin, rel=1e-14)
    assert twice.centroid == pytest.approx(once.centroid, rel=1e-13)
    assert twice.required_friction == pytest.approx(once.required_friction, rel=1e-14)
    assert (twice.a_max, twice.a_min) == pytest.approx((2 * once.a_max, 2 * once.a_min), rel=1e-14)


# hand: theta_s_sup is 60.205 deg at 150 mm; 2.6 deg each are taken off, so 55.005 deg is left
@pytest.mark.parametrize(
    ("angle", "mu_s", "spare", "expected"),
    [
        (54.9, 2.0, 0.0, Verdict.GO),
        (54.9, math.nan, 0.0, Verdict.CAUTION),
        (55.1, 2.0, 0.0, Verdict.NO_GO),
        (55.1, math.nan, 0.0, Verdict.NO_GO),
        (55.1, 2.0, 2.6, Verdict.CAUTION),
        (55.1, math.nan, 2.6, Verdict.CAUTION),
        (60.1, 2.0, 2.6, Verdict.CAUTION),
        (60.3, 2.0, 2.6, Verdict.NO_GO),
        (57.5, 1.5, 2.6, Verdict.NO_GO),  # atan 1.5 = 56.3 deg: slips however kind the rest
    ],
)
def test_words(angle, mu_s, spare, expected):
    allowance, back = math.radians(2.6), math.radians(spare)
    found = judged(
        **KENAF, p=0.150, theta_s=math.radians(angle), mu_s=mu_s,
        theta_d=allowance, theta_M=allowance, spare_d=back, spare_M=back,
    )  # fmt: skip
    assert Verdict(int(found.verdict)) is expected


def test_only_theta_d_is_given_back_at_the_uphill_end():
    # hand: theta_s_inf is 18.68 deg at 220 mm; at 18 deg nothing of theta_M may help
    at = {**KENAF, "p": 0.220, "theta_s": math.radians(18.0), "mu_s": 2.0}
    found = judged(**at, theta_M=0.04, spare_M=0.04)
    assert Verdict(int(found.verdict)) is Verdict.NO_GO
    assert Mode(int(found.governs)) is Mode.TIP_UPHILL
    above = judged(**at | {"theta_s": math.radians(19.0)}, theta_d=0.04, spare_d=0.04)
    assert Verdict(int(above.verdict)) is Verdict.CAUTION


def test_outside_the_model():
    found = judged(**KENAF, p=0.236, theta_s=0.3, mu_s=2.0)
    assert Verdict(int(found.verdict)) is Verdict.OUTSIDE_MODEL
    assert all(np.isnan([found.margin, found.a_max, found.a_min, found.centroid]))


def test_a_margin_of_exactly_zero_is_no_go():
    # the paper: equality is in none of its areas; here it is never GO, nor CAUTION
    slope = judged(**KENAF, p=0.150, theta_s=0.5, mu_s=9.0).theta_s_sup
    found = judged(**KENAF, p=0.150, theta_s=slope, mu_s=9.0)
    assert found.tip_downhill == found.margin == 0.0
    assert Verdict(int(found.verdict)) is Verdict.NO_GO
    # -0.125 + 0.125: numbers that subtract exactly
    level = judged(L=0.5, C_L=0.3, C_N=0.1, p=0.2, theta_s=0.0, mu_s=9.0, theta_M=0.125)
    assert level.tip_downhill == -0.125
    spared = judged(
        L=0.5, C_L=0.3, C_N=0.1, p=0.2, theta_s=0.0, mu_s=9.0, theta_M=0.125, spare_M=0.125
    )
    assert Verdict(int(spared.verdict)) is Verdict.NO_GO


def test_nothing_is_taken_off_or_given_back_unasked():
    bare = judged(**KENAF, p=0.150, theta_s=1.0, mu_s=9.0)
    asked = judged(
        **KENAF, p=0.150, theta_s=1.0, mu_s=9.0, a=0.0, theta_d=0.0, theta_M=0.0, spare_d=0.0,
        spare_M=0.0,
    )  # fmt: skip
    assert bare == asked
    beyond = judged(**KENAF, p=0.150, theta_s=1.2, mu_s=9.0)
    assert Verdict(int(beyond.verdict)) is Verdict.NO_GO


def test_codes_are_whole_numbers():
    found = judged(**KENAF, p=np.array([0.15, 0.236]), theta_s=0.3, mu_s=2.0)
    assert found.verdict.dtype.kind == found.governs.dtype.kind == "i"
