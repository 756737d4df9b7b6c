"""Yielding tracks: inclination and deflections chosen, the length that they take worked out."""

import math

import numpy as np
import pytest

from kaidan.mechanics.yielding import (
    REST,
    tail_grips,
    theta_d_two_contacts,
    theta_s_sup_yielding,
    yielding_loss,
)

P, C_L, C_N = 0.15, 0.2, 0.08
NEAR = 1e-10
"""rad: eighty rounds of a fixed point."""


@pytest.mark.parametrize("drop", [0.0, 0.004])
@pytest.mark.parametrize("R", [0.0, 0.06])
@pytest.mark.parametrize("a", [0.6, 1.0])
def test_steepest_slope_of_a_track_that_yields(a, R, drop):
    w_n = 0.005
    eta = w_n * math.cos(a)
    theta_d = math.asin(eta / P)
    past = math.sqrt(4 * R * eta - 4 * eta**2) if R else 0.0
    L = (C_N - eta) * math.tan(a) - past + P * math.cos(theta_d) + C_L + drop * math.sin(a)
    found = theta_s_sup_yielding(L=L, p=P, C_L=C_L, C_N=C_N, w_n=w_n, drop=drop, R=R)
    assert found == pytest.approx(a - theta_d, abs=NEAR)


def test_an_end_that_is_pressed_in_by_half_of_its_radius_carries_nothing():
    given = {"L": 0.5, "p": P, "C_L": C_L, "C_N": C_N}
    rigid = math.atan2(0.15, C_N)
    eta = 0.01 * math.cos(rigid)
    found = theta_s_sup_yielding(w_n=0.01, R=np.array([1.8 * eta, 2.6 * eta, 3.0, 0.0]), **given)
    assert np.isnan(found).tolist() == [True, False, False, False]
    # shapes of any of the lengths
    for name in ("w_n", "drop", "R"):
        others = given | {"w_n": 0.0} | {name: np.zeros(2)}
        assert theta_s_sup_yielding(**others) == pytest.approx([rigid] * 2)


@pytest.mark.parametrize("q", [0.0, 0.3, 0.9])
def test_two_nosings_share_the_weight(q):
    a, w_n = 0.8, 0.01
    eta = w_n * math.cos(a) * (1 - q)
    theta_d = w_n * math.cos(a) / P * (1 - 2 * q)
    L = q * P + P + C_L + (C_N - eta) * math.tan(a)
    given = {"p": P, "C_L": C_L, "C_N": C_N, "theta_s": a - theta_d, "w_n": w_n}
    assert theta_d_two_contacts(L=L + 1e-9, **given) == pytest.approx(theta_d, abs=1e-7)
    assert math.isnan(theta_d_two_contacts(L=L - (q + 0.2) * P, **given))
    assert math.isnan(theta_d_two_contacts(L=L + (1.2 - q) * P, **given))


def test_an_end_grips_from_a_radius_on():
    # hand: mu = 3/4 turns by atan(4/3), where the end has risen by R (1 - 3/5)
    assert tail_grips(w_n=0.4 + 1e-9, R=1.0, mu=0.75)
    assert not tail_grips(w_n=0.4 - 1e-9, R=1.0, mu=0.75)


@pytest.mark.parametrize(("p", "lift"), [(0.2, 5.0 - 1.6), (0.7, 0.0)])
def test_what_a_gripping_tail_costs(p, lift):
    """H = 0.5 m as of 0.3 and 0.4: the body turns at 0.1 m/s (1/p - 0.4/0.25)."""
    given = {"L": 0.8 + p, "p": p, "C_L": 0.5, "C_N": 0.4, "w_n": 0.004}
    more = {"w_t": 0.01, "speed": 0.1, "gyration": 0.3, "R": 0.05}
    tau = math.sqrt((0.09 + 0.25) / (9.80665 * 0.5))
    rigid = math.atan2(0.3, 0.4)
    held = rigid - theta_s_sup_yielding(drop=0.01, **given)
    grips = rigid - theta_s_sup_yielding(drop=0.02, **given) + tau * 0.1 * lift + REST
    assert yielding_loss(mu=0.0, **given, **more) == pytest.approx(held)
    assert yielding_loss(mu=math.inf, **given, **more) == pytest.approx(grips)
    assert math.isnan(yielding_loss(mu=0.0, **given | {"L": 0.49 + p}, **more))
