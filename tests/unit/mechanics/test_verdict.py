"""The verdict of many pairs against the formulas it is made of, one by one."""

import itertools
import math

import numpy as np
import pytest

from kaidan.mechanics.margin import (
    centroid_margin_downhill,
    centroid_margin_uphill,
)
from kaidan.mechanics.margins import acceleration_bounds, margins
from kaidan.mechanics.slipping import required_friction
from kaidan.mechanics.verdict import judged
from kaidan.modes import FORMULAS, SLIDES_DOWN, SLIDES_UP, TIP_DOWNHILL, TIP_UPHILL, Verdict

KENAF = {"L": 0.470, "C_L": 0.196, "C_N": 0.071}
"""paper, Table 1"""
ANGLES = [math.radians(angle) for angle in (10.0, 32.5, 50.0, 59.0, 62.0)]
CASES = list(itertools.product(ANGLES, (0.15, 0.2, 0.235), (0.4, 2.0, math.nan), (-1.5, 0.0, 2.0)))
ALLOWANCES = {"theta_d": 0.03, "theta_M": 0.02}
BY_RANK = {verdict.rank: verdict for verdict in Verdict}


def word(found):
    """Verdict of a pair, in arrays its rank."""
    return BY_RANK[int(found.verdict)]


@pytest.mark.parametrize(("theta_s", "p", "mu_s", "a"), CASES)
def test_every_figure_is_that_of_its_formula(theta_s, p, mu_s, a):
    at = {**KENAF, "theta_s": theta_s, "p": p, "mu_s": mu_s}
    found = judged(**at, a=a, **ALLOWANCES)
    one = margins(**at, a=a, **ALLOWANCES)
    band = acceleration_bounds(**at)
    for name in (
        "theta_s_sup",
        "tip_downhill",
        "tip_uphill",
        "slides_down",
        "slides_up",
    ):
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
        (54.9, math.nan, 0.0, Verdict.UNSURE),
        (55.1, 2.0, 0.0, Verdict.NO_GO),
        (55.1, math.nan, 0.0, Verdict.NO_GO),
        (55.1, 2.0, 2.6, Verdict.UNSURE),
        (55.1, math.nan, 2.6, Verdict.UNSURE),
        (60.1, 2.0, 2.6, Verdict.UNSURE),
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
    assert word(found) is expected


def test_only_theta_d_is_given_back_at_the_uphill_end():
    # hand: theta_s_inf is 18.68 deg at 220 mm; at 18 deg nothing of theta_M may help
    at = {**KENAF, "p": 0.220, "theta_s": math.radians(18.0), "mu_s": 2.0}
    found = judged(**at, theta_M=0.04, spare_M=0.04)
    assert word(found) is Verdict.NO_GO
    assert FORMULAS[int(found.governs)] is TIP_UPHILL
    above = judged(**at | {"theta_s": math.radians(19.0)}, theta_d=0.04, spare_d=0.04)
    assert word(above) is Verdict.UNSURE


def test_outside_the_model():
    found = judged(**KENAF, p=0.236, theta_s=0.3, mu_s=2.0)
    assert word(found) is Verdict.OUTSIDE_MODEL
    assert all(np.isnan([found.margin, found.a_max, found.a_min, found.centroid]))


def test_a_margin_of_exactly_zero_is_no_go():
    # the paper: equality is in none of its areas; here it is never GO, nor UNSURE
    slope = judged(**KENAF, p=0.150, theta_s=0.5, mu_s=9.0).theta_s_sup
    found = judged(**KENAF, p=0.150, theta_s=slope, mu_s=9.0)
    assert found.tip_downhill == found.margin == 0.0
    assert word(found) is Verdict.NO_GO
    # -0.125 + 0.125: numbers that subtract exactly
    level = judged(L=0.5, C_L=0.3, C_N=0.1, p=0.2, theta_s=0.0, mu_s=9.0, theta_M=0.125)
    assert level.tip_downhill == -0.125
    spared = judged(
        L=0.5, C_L=0.3, C_N=0.1, p=0.2, theta_s=0.0, mu_s=9.0, theta_M=0.125, spare_M=0.125
    )
    assert word(spared) is Verdict.NO_GO


def test_nothing_is_taken_off_or_given_back_unasked():
    bare = judged(**KENAF, p=0.150, theta_s=1.0, mu_s=9.0)
    asked = judged(
        **KENAF, p=0.150, theta_s=1.0, mu_s=9.0, a=0.0, theta_d=0.0, theta_M=0.0, spare_d=0.0,
        spare_M=0.0,
    )  # fmt: skip
    assert bare == asked
    beyond = judged(**KENAF, p=0.150, theta_s=1.2, mu_s=9.0)
    assert word(beyond) is Verdict.NO_GO


def test_codes_are_whole_numbers():
    found = judged(**KENAF, p=np.array([0.15, 0.236]), theta_s=0.3, mu_s=2.0)
    assert found.verdict.dtype.kind == found.governs.dtype.kind == "i"


# L - p - C_L = C_L - p = 1/8 m over C_N = 1/8 m: both tip limits at 45 degrees, exactly
EVEN = {"L": 0.5, "C_L": 0.25, "C_N": 0.125, "p": 0.125}


def governing(**changes):
    found = judged(**{**EVEN, "theta_s": 0.0, "mu_s": 0.5, **changes})
    return FORMULAS[int(found.governs)], float(found.margin)


@pytest.mark.parametrize(
    ("changes", "mode", "worst"),
    [
        # hand: limits in tangents: tip 1, slip mu
        ({"theta_s": 0.2}, SLIDES_DOWN, math.atan(0.5) - 0.2),
        ({"theta_s": -0.2}, SLIDES_UP, math.atan(0.5) - 0.2),
        ({"theta_s": 0.2, "mu_s": 2.0}, TIP_DOWNHILL, math.pi / 4 - 0.2),
        ({"theta_s": -0.2, "mu_s": 2.0}, TIP_UPHILL, math.pi / 4 - 0.2),
        ({"theta_s": 0.2, "mu_s": math.nan}, TIP_DOWNHILL, math.pi / 4 - 0.2),
        ({"mu_s": 2.0, "theta_M": 0.1}, TIP_DOWNHILL, math.pi / 4 - 0.1),
        ({"theta_s": -0.1, "mu_s": 2.0, "theta_d": 0.1}, TIP_UPHILL, math.pi / 4 - 0.2),
        # ties go to the first of the list
        ({}, SLIDES_DOWN, math.atan(0.5)),
        ({"mu_s": 2.0}, TIP_DOWNHILL, math.pi / 4),
        ({"mu_s": 1.0}, TIP_DOWNHILL, math.pi / 4),
        ({"mu_s": 1.0, "theta_s": -0.25}, TIP_UPHILL, math.pi / 4 - 0.25),
    ],
)
def test_what_governs(changes, mode, worst):
    found = governing(**changes)
    assert found[0] is mode
    assert found[1] == pytest.approx(worst, abs=1e-15)


@pytest.mark.parametrize(
    ("changes", "mode"),
    [
        # hand: 0.1 beyond the tip limit, 0.05 beyond friction; what is given back saves the tip
        ({"theta_s": math.pi / 4 - 0.1, "spare_d": 0.15}, SLIDES_DOWN),
        ({"theta_s": math.pi / 4 - 0.1, "spare_d": 0.04}, TIP_DOWNHILL),
        ({"theta_s": math.pi / 4 - 0.1, "spare_d": 0.06}, SLIDES_DOWN),
        ({"theta_s": math.pi / 4 - 0.1, "spare_M": 0.15}, SLIDES_DOWN),
        ({"theta_s": 0.1 - math.pi / 4, "spare_d": 0.15}, SLIDES_UP),
        # theta_M is no matter of the uphill end
        ({"theta_s": 0.1 - math.pi / 4, "spare_M": 0.15}, TIP_UPHILL),
        # a UNSURE is in doubt by the smallest margin, although it may hold
        ({"theta_s": math.pi / 4 - 0.1, "mu_s": 2.0, "spare_d": 0.15}, TIP_DOWNHILL),
        # hand: p = L/2, both limits level: -0.5 downhill, at best +0.1; -0.3 uphill, -0.1
        (
            {
                "p": 0.25,
                "theta_s": -0.1,
                "theta_M": 0.4,
                "mu_s": 2.0,
                "spare_d": 0.2,
                "spare_M": 0.4,
            },
            TIP_UPHILL,
        ),
    ],
)
def test_what_may_hold_does_not_decide_a_no_go(changes, mode):
    grip = math.tan(math.pi / 4 - 0.15)
    at = {**EVEN, "theta_d": 0.2, "mu_s": grip, "theta_s": 0.0, **changes}
    assert FORMULAS[int(judged(**at).governs)] is mode
