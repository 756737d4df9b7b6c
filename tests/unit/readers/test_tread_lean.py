"""What treads say of which way is up, and what becomes of up with it."""

import math

import numpy as np
import pytest

import cloud_campaign as campaign
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points as interpreter
from kaidan.readers.stairfit.gravity import Upward, leant
from kaidan.readers.stairfit.staircase_line import StairLine
from kaidan.readers.stairfit.tread_lean import tread_lean

LINE = StairLine(s0=0.0, z0=0.2, going=0.3, rise=0.2, first=0, last=4)
LEVELS = 0.2 * np.arange(1.0, 6.0)
EYE = np.array([-1.5, 0.4, 1.4])


def treads(slope, seen=1.0, noise=0.0, count=20_000):
    """Points of four treads, of the front part of each, that rise with s; noise along the rays."""
    rng = np.random.default_rng(0)
    k = rng.integers(0, 4, count)
    u = 0.3 * seen * rng.random(count)
    points = np.array([0.3 * k + u, 0.8 * rng.random(count), 0.2 * (k + 1) + slope * (u - 0.15)])
    ray = points - EYE[:, None]
    return points + ray / np.linalg.norm(ray, axis=0) * rng.normal(0, noise, count)


def lean(points, **known):
    known = {"eye": EYE, "width": 0.03, "range_error": 0.005, "out_of_true": 0.0} | known
    return tread_lean(LINE, LEVELS, *points, **known)


def test_treads_that_rise_ahead_say_that_up_leans_back():
    """By hand: treads that seem to rise by 0.02 have a normal that leans back by arctan 0.02."""
    angle, _ = lean(treads(0.02))
    assert angle == pytest.approx(-math.atan(0.02))


@pytest.mark.parametrize("seen", [1.0, 0.6])
def test_noise_along_the_rays_gives_no_slope(seen):
    """8 mm: near the ends of what is seen it would, by 0.5 deg where 60 % is."""
    angle, doubt = lean(treads(0.0, seen, noise=0.008))
    assert abs(angle) < 3 * doubt
    assert abs(angle) < math.radians(0.12)


def test_its_doubt_is_that_of_the_range_and_of_what_was_built():
    """By hand: four treads out of true by 0.01 rad each, of a range that is exact."""
    _, doubt = lean(treads(0.0), range_error=0.0, out_of_true=0.01)
    assert doubt == pytest.approx(0.005)
    _, doubt = lean(treads(0.0))
    assert 0.0005 < doubt < 0.005  # sqrt(2) 0.25 0.5 % sin^2 / 0.16, of 20 to 40 deg


def test_few_treads_say_nothing():
    s, t, z = treads(0.02)
    assert np.isnan(lean((s[s < 0.3], t[s < 0.3], z[s < 0.3]))[0])


def test_up_follows_by_the_variances_and_a_contradiction_is_a_doubt():
    """By hand: 0.004 and 0.003 rad; weights 9 and 16 of 25, so 0.64 of the way, and 0.0024 left."""
    up, ahead = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
    before = Upward(up, 0.004, up, 0.004**2 * np.eye(3))
    after = leant(before, ahead, 0.001, 0.003, up, math.radians(20.0))
    assert after.built[0] == pytest.approx(0.00064, rel=1e-3)
    assert after.against[0, 0] == pytest.approx(0.0024**2)
    after = leant(before, ahead, 0.02, 0.003, up, math.radians(20.0))  # 4 sigma of 0.005
    assert after.built[0] == pytest.approx(0.0128, rel=1e-3)
    assert after.against[0, 0] == pytest.approx((4 * 0.0024) ** 2)
    assert after.against[1, 1] == pytest.approx((4 * 0.004) ** 2)


@pytest.mark.parametrize("number", [300_021, 300_081])
def test_treads_are_weighed_against_a_wrong_plane(number):
    """From the landing and from the foot: up was off by 2.0 and 1.8 deg, with a doubt of 0.5."""
    made = campaign.case(number)
    (stairs,) = interpreter.found(campaign.cloud(made.seen, up=None), Hints()).staircases
    (flight,) = stairs.flights
    line = flight.line()
    truth = made.truth.rises[1] / made.truth.goings[0]
    angle = math.atan2(*(line[-2] - line[0])[::-1])
    off = angle - math.atan(truth)  # along what was built
    assert abs(off) < 2 * flight.gravity
    assert abs(off) < math.radians(1.4)
