"""Closed form of a track that yields, against an equilibrium solved apart and a dynamic model."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq, minimize

from kaidan.mechanics.margin import theta_s_sup
from kaidan.mechanics.yielding import (
    drop_at_most,
    theta_d_at_limit,
    theta_d_two_contacts,
    theta_s_sup_yielding,
)

KENAF = {"L": 0.470, "C_L": 0.196, "C_N": 0.071}
SPACINGS = (0.150, 0.180, 0.200, 0.220)


def equilibrium(theta, x, p, w_n, nosings=3):
    """Depth at t_0 and extra inclination of least energy; unilateral springs, weight 1.

    The robot stands with its centroid `x` ahead of t_0 along the flat, which friction holds. Depths
    of nosings ahead of t_0 follow from the inclination; the energy is that of springs and weight.
    """

    def energy(unknown):
        depth, psi = unknown
        depths = depth - np.arange(nosings) * p * math.sin(psi)
        springs = np.sum(np.maximum(depths, 0.0) ** 2) / (2 * w_n)
        a = theta + psi
        return springs + x * math.sin(a) + (KENAF["C_N"] - depth) * math.cos(a)

    found = minimize(energy, (w_n * math.cos(theta), 0.01), method="BFGS", tol=1e-13)
    return found.x


@pytest.mark.parametrize("p", SPACINGS)
@pytest.mark.parametrize("w_n", [0.002, 0.008])
def test_limit_is_where_gravity_passes_the_only_contact(p, w_n):
    theta = float(theta_s_sup_yielding(p=p, w_n=w_n, **KENAF))
    # bodies on t_0 alone: torque about the nosing, by hand
    a = brentq(lambda each: each - theta - math.asin(w_n * math.cos(each) / p), 0.1, 1.5)
    eta, psi = w_n * math.cos(a), a - theta
    x = KENAF["L"] - p * math.cos(psi) - KENAF["C_L"]
    torque = x * math.cos(a) - (KENAF["C_N"] - eta) * math.sin(a)
    assert torque == pytest.approx(0.0, abs=1e-12)
    assert psi == pytest.approx(float(theta_d_at_limit(eta=eta, p=p)))


@pytest.mark.parametrize("p", SPACINGS)
def test_inclination_below_the_limit_against_least_energy(p):
    w_n = 0.004
    x = KENAF["L"] - p - KENAF["C_L"]
    theta = float(theta_s_sup_yielding(p=p, w_n=w_n, **KENAF)) - math.radians(1.0)
    _, psi = equilibrium(theta, x, p, w_n)
    closed = theta_d_two_contacts(p=p, theta_s=theta, w_n=w_n, **KENAF)
    # 5 %: second order in eta/p
    assert float(closed) == pytest.approx(psi, rel=0.05)


@pytest.mark.parametrize("p", SPACINGS)
def test_rigid_limit_is_the_paper_s(p):
    for R in (0.0, 0.03):
        found = theta_s_sup_yielding(p=p, w_n=1e-12, R=R, **KENAF)
        assert found == pytest.approx(theta_s_sup(p=p, **KENAF), abs=1e-4)


@pytest.mark.parametrize(
    ("p", "by_eta", "by_drop"),
    [(0.150, -0.03, -0.20), (0.180, 0.07, -0.29), (0.200, 0.12, -0.39), (0.220, 0.13, -0.51)],
)
def test_degrees_a_millimetre_by_hand(p, by_eta, by_drop):
    # first order: -(1/p)(1 - p x/h^2) and -C_N/h^2
    x = KENAF["L"] - p - KENAF["C_L"]
    h2 = x**2 + KENAF["C_N"] ** 2
    assert math.degrees(-(1 - p * x / h2) / p) / 1e3 == pytest.approx(by_eta, abs=0.006)
    assert math.degrees(-KENAF["C_N"] / h2) / 1e3 == pytest.approx(by_drop, abs=0.006)
    rigid, step = float(theta_s_sup(p=p, **KENAF)), 1e-5
    pressed = theta_s_sup_yielding(p=p, w_n=step / math.cos(rigid), **KENAF)
    dropped = theta_s_sup_yielding(p=p, w_n=0.0, drop=step / math.sin(rigid), **KENAF)
    assert math.degrees(pressed - rigid) / (1e3 * step) == pytest.approx(by_eta, abs=0.006)
    assert math.degrees(dropped - rigid) / (1e3 * step) == pytest.approx(by_drop, abs=0.006)


def test_arrays_pass_and_what_does_not_hold_is_nan():
    found = theta_s_sup_yielding(p=np.array(SPACINGS), w_n=0.004, R=0.005, **KENAF)
    assert found.shape == (4,)
    # 2 eta < R: 4 mm times the cosine of 62, 55, 49 and 42 deg is 1.9, 2.3, 2.6, 3.0 mm
    assert np.isfinite(found).tolist() == [True, True, False, False]
    assert math.isnan(theta_d_two_contacts(p=0.150, theta_s=1.3, w_n=0.004, **KENAF))


@pytest.mark.slow
@pytest.mark.parametrize("p", [0.180, 0.200, 0.220])
@pytest.mark.parametrize("ratio", [1.0, 0.35])
def test_slow_dynamics_lie_between_the_bounds(p, ratio):
    pytest.importorskip("numba")
    from kaidan.physics import YieldingBelt
    from physics_cases import climbs_up_to

    stiffness = 6e4
    w_n = 20.0 * 9.80665 / stiffness
    drop = float(drop_at_most(w_t=w_n / ratio, contacts=3))
    low, high = (
        math.degrees(theta_s_sup_yielding(p=p, w_n=w_n, drop=each, **KENAF)) for each in (drop, 0.0)
    )
    # 0.7 deg: ends of 2 mm lengthen the flat, up to 0.5 deg a millimetre; falling takes time
    assert climbs_up_to(
        low - 0.2, high + 0.7, p, radius=0.002, speed=0.005, friction=4.0, ground="noses",
        track=YieldingBelt(stiffness=stiffness, shear_ratio=ratio, damping_ratio=1.0),
    )  # fmt: skip
