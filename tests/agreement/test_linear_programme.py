"""Closed forms against the linear programme of `oracle`, at random poses and over whole flights.

The band is 1e-9 g: the programme's vertices are exact to a few times 1e-14, and the flight test
steps 1e-11 of a spacing aside of every event, which costs up to 2e-10 g.
"""

import numpy as np
import pytest
from oracle import Pose, extreme_accelerations

from amounts import fast_and_slow
from formulas.paper import tip_acceleration_downhill, tip_acceleration_uphill
from kaidan.mechanics.margin import theta_s_inf, theta_s_sup
from kaidan.mechanics.margins import acceleration_bounds, margins
from kaidan.mechanics.plane import lowest_contact
from kaidan.mechanics.slipping import slip_acceleration_down, slip_acceleration_up
from kaidan.mechanics.tipping import a_r0, a_rn
from kaidan.mechanics.triangle import theta_alpha, theta_beta

BAND = 1e-9  # g
BATCH = 200  # poses in one programme: 0.1 ms a pose, against 1.6 ms one by one
STEP = 1e-11  # of a spacing, aside of an event


def robots_on_stairs(count, seed):
    """Random robots and stairs: n from 2 to 12, facing up and down, slip and tips alike likely."""
    rng = np.random.default_rng(seed)
    L = rng.uniform(0.3, 2.0, count)
    p = L / (rng.integers(2, 13, count) + rng.uniform(0.0, 1.0, count))
    from_front = rng.uniform(0.05, 0.95, count) * L
    faces_up = rng.random(count) < 0.5
    return {
        "L": L,
        "p": p,
        "C_L": np.where(faces_up, from_front, L - from_front),
        "C_N": rng.uniform(0.03, 0.6, count) * L,
        "theta_s": rng.uniform(-0.2, 1.3, count),
        "mu_s": np.exp(rng.uniform(np.log(0.05), np.log(30.0), count)),
    }, rng


def poses(robots, uphill_tip):
    """The same in the world's words: a long flight, and where the uphill tip of the flat is."""
    return [
        Pose(
            nosings=p * np.arange(60),
            tips=(u - L, u),
            com=(u - C_L, C_N),
            slope=theta_s,
            friction=mu_s,
        )
        for L, p, C_L, C_N, theta_s, mu_s, u in zip(*robots.values(), uphill_tip, strict=True)
    ]


def judged(all_poses, sense):
    """Extreme accelerations of many poses [g], batch by batch."""
    batches = range(0, len(all_poses), BATCH)
    return np.concatenate([extreme_accelerations(all_poses[i : i + BATCH], sense) for i in batches])


def tip_limits(robots, d):
    pose = {key: robots[key] for key in ("theta_s", "C_L", "C_N")}
    s = lowest_contact(d=d, L=robots["L"], p=robots["p"])
    return a_r0(s=s, **pose, g=1.0), a_rn(d=d, **pose, g=1.0)


def slip_limits(robots):
    grip = {key: robots[key] for key in ("mu_s", "theta_s")}
    return slip_acceleration_up(**grip, g=1.0), slip_acceleration_down(**grip, g=1.0)


@pytest.mark.parametrize("count", fast_and_slow(5_000, 20_000))
def test_bounds_of_the_acceleration_at_random_poses(count):
    robots, rng = robots_on_stairs(count, seed=2016)
    uphill_tip = (20.0 + rng.uniform(0.0, 1.0, count)) * robots["p"]
    d = uphill_tip - 20.0 * robots["p"]
    a_tip, a_fall = tip_limits(robots, d)
    a_S, a_down = slip_limits(robots)
    upper, lower = np.minimum(a_S, a_tip), np.maximum(a_down, a_fall)
    possible = lower <= upper

    # every failure mode governs often enough to be tested
    for governs in (a_S < a_tip, a_S > a_tip, a_down > a_fall, a_down < a_fall):
        assert np.sum(governs & possible) > 0.15 * count
    assert np.sum(~possible) > count / 200

    all_poses = poses(robots, uphill_tip)
    largest, smallest = judged(all_poses, 1.0), judged(all_poses, -1.0)
    np.testing.assert_array_equal(np.isnan(largest), ~possible)
    np.testing.assert_array_equal(np.isnan(smallest), ~possible)
    np.testing.assert_allclose(largest[possible], upper[possible], rtol=0, atol=BAND)
    np.testing.assert_allclose(smallest[possible], lower[possible], rtol=0, atol=BAND)

    # the paper's angle form is the same limit; 1/tan of angles down to 0.02 costs two digits
    n = np.round((lowest_contact(d=d, L=robots["L"], p=robots["p"]) - d) / robots["p"])
    triangle = {key: robots[key] for key in ("C_L", "C_N")}
    angle_0 = theta_alpha(d=d, k=n, p=robots["p"], **triangle)
    angle_n = theta_beta(d=d, **triangle)
    slope = {"theta_s": robots["theta_s"], "g": 1.0}
    np.testing.assert_allclose(
        tip_acceleration_downhill(theta_alpha=angle_0, **slope), a_tip, rtol=0, atol=1e-12
    )
    np.testing.assert_allclose(
        tip_acceleration_uphill(theta_beta=angle_n, **slope), a_fall, rtol=0, atol=1e-12
    )


def flight(robots, rng):
    """Extremes over one spacing of travel, up or down: aside of every event and at random."""
    p, L = robots["p"], robots["L"]
    met = 20.0 * p  # a nosing at the uphill tip
    lost = L + p * np.ceil((met - L) / p)  # a nosing at the downhill tip
    places = [event + side * STEP * p for event in (met, lost) for side in (-1.0, 1.0)]
    places += [met + rng.uniform(0.0, 1.0, p.size) * p for _ in range(3)]
    every = [pose for place in places for pose in poses(robots, place)]
    shape = (len(places), p.size)
    return judged(every, 1.0).reshape(shape), judged(every, -1.0).reshape(shape)


@pytest.mark.parametrize("count", fast_and_slow(600, 2_500))
def test_bounds_of_the_acceleration_over_a_whole_flight(count):
    robots, rng = robots_on_stairs(count, seed=3020)
    largest, smallest = flight(robots, rng)
    bounds = acceleration_bounds(**robots, g=1.0)
    stuck = np.isnan(largest).any(axis=0)
    assert count / 250 < np.sum(stuck) < count / 5
    assert np.all(bounds.a_max[stuck] < bounds.a_min[stuck])  # the band is empty there
    np.testing.assert_allclose(
        np.min(largest, axis=0)[~stuck], bounds.a_max[~stuck], rtol=0, atol=BAND
    )
    np.testing.assert_allclose(
        np.max(smallest, axis=0)[~stuck], bounds.a_min[~stuck], rtol=0, atol=BAND
    )


@pytest.mark.parametrize("count", fast_and_slow(500, 1_500))
def test_the_two_tip_limits_over_a_whole_flight(count):
    # friction out of the way: min a_r0 and max a_rn themselves
    robots, rng = robots_on_stairs(count, seed=19)
    robots["mu_s"] = np.full(count, 1e3)
    largest, smallest = flight(robots, rng)
    bounds = acceleration_bounds(**robots, g=1.0)
    assert not np.isnan(largest).any()
    # forces of 1e3 g in the cone cost three digits more: still inside the band
    np.testing.assert_allclose(np.min(largest, axis=0), bounds.tip_downhill, rtol=0, atol=BAND)
    np.testing.assert_allclose(np.max(smallest, axis=0), bounds.tip_uphill, rtol=0, atol=BAND)


@pytest.mark.parametrize("a", [pytest.param(-0.4, marks=pytest.mark.slow), 0.0, 0.3])
def test_limit_slopes_for_an_acceleration(a):
    # on the slope theta_s_sup(a) the programme's largest acceleration is a itself; and downhill
    robots, rng = robots_on_stairs(300, seed=24)
    robots["mu_s"] = np.full(300, 1e3)
    shape = {key: robots[key] for key in ("p", "C_L", "C_N")}
    for slope, index, pick in (
        (theta_s_sup(L=robots["L"], **shape, a=a, g=1.0), 0, np.min),
        (theta_s_inf(**shape, a=a, g=1.0), 1, np.max),
    ):
        # a slope nearer to the vertical than 0.05 is no stair, and 1/cos would widen the band
        real = np.abs(slope) < np.pi / 2 - 0.05
        assert np.sum(real) > 200
        chosen = {key: value[real] for key, value in robots.items()} | {"theta_s": slope[real]}
        np.testing.assert_allclose(pick(flight(chosen, rng)[index], axis=0), a, rtol=0, atol=BAND)


@pytest.mark.parametrize("count", fast_and_slow(300, 1_000))
def test_positive_margins_mean_inside_the_band(count):
    robots, rng = robots_on_stairs(count, seed=5)
    a = rng.uniform(-0.6, 0.6, count)
    largest, smallest = flight(robots, rng)
    with np.errstate(invalid="ignore"):  # poses that nothing holds are NaN: not inside
        inside = (np.min(largest, axis=0) > a) & (np.max(smallest, axis=0) < a)
    worst = margins(**robots, a=a, g=1.0).worst
    assert 0.1 * count < np.sum(inside) < 0.9 * count
    np.testing.assert_array_equal(worst > 0.0, inside)
