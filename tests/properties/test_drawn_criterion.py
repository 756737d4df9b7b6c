"""The criterion on many draws at once is the criterion on each of them."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan.traversal import static_criterion as static
from kaidan.traversal.criterion import Tread
from kaidan.traversal.drawn_criterion import DrawnTread, _Losses, drawn_criterion
from kaidan.traversal.static_criterion import flights_of, static_criterion


def flights(seed, count):
    """Uneven flights under one robot that is not quite known either."""
    rng = np.random.default_rng(seed)
    L, n = rng.uniform(0.4, 1.2), int(rng.integers(2, 16))
    tread = Tread(
        L, L * rng.uniform(0.3, 0.6), L * rng.uniform(0.1, 0.3),
        rng.uniform(0.0, 0.2), rng.uniform(0.0, 0.2), 0.3 * L,
    )  # fmt: skip
    p, slope = rng.uniform(0.15, 0.7) * L, rng.uniform(0.3, 0.9)
    k = np.arange(n)[:, None]
    nosings = k * p * np.array([[math.cos(slope), math.sin(slope)]])
    if rng.random() < 0.3:
        nosings[n // 2 :, 0] += 1.5 * L  # a landing
    sigma = rng.choice([0.0, 1e-3, 1e-2])
    drawn = nosings + rng.normal(0.0, sigma, (count, *nosings.shape))
    each = (value + rng.normal(0.0, 5e-3, count) for value in tread[:3])
    return nosings, drawn, tread, DrawnTread(*each), rng.choice([0.0, 0.5, -1.0, 20.0])


def losses_of(found, *, landing=False):
    return [each for each in found.losses if bool(each.landing) is landing]


def margin_of(found, *, downhill, landing=False):
    some = losses_of(found, landing=landing)
    return min((each.margin for each in some if each.downhill is downhill), default=math.inf)


def rise_of(found, *, landing=False):
    some = losses_of(found, landing=landing)
    return min((max(each.rise - each.freed, 0.0) for each in some), default=math.inf)


@pytest.mark.parametrize("seed", range(60))
def test_each_draw_is_the_criterion_of_that_draw(seed, monkeypatch):
    nosings, drawn, tread, on, a = flights(seed, 20)
    monkeypatch.setattr("kaidan.traversal.drawn_criterion.BLOCK", 7 * len(nosings))
    within = (0.2, 1.5) if seed % 3 == 0 else (-math.inf, math.inf)
    agrees(nosings, drawn, tread, on, a, within)


def agrees(nosings, drawn, tread, on, a, within=(-math.inf, math.inf)):
    found = drawn_criterion(nosings, drawn, tread, on, acceleration=a, within=within)
    cuts = flights_of(nosings, tread.L)
    for k, one in enumerate(drawn):
        mine = tread._replace(L=on.L[k], C_L=on.C_L[k], C_N=on.C_N[k])
        if flights_of(one, mine.L) != cuts:
            continue  # where the draw is a landing and the flight none, nothing is compared
        alone = static_criterion(one, mine, acceleration=a).within(*within)
        # rad: rounding of functions of libm and numpy
        assert found.downhill[k] == pytest.approx(margin_of(alone, downhill=True), abs=1e-9)
        assert found.uphill[k] == pytest.approx(margin_of(alone, downhill=False), abs=1e-9)
        landing = margin_of(alone, downhill=True, landing=True)
        assert found.landing[k] == pytest.approx(landing, abs=1e-9)
        assert found.rocking[k] == pytest.approx(alone.rocking, abs=1e-9)
        assert found.rise[k] == pytest.approx(rise_of(alone), abs=1e-9)
        assert found.landing_rise[k] == pytest.approx(rise_of(alone, landing=True), abs=1e-9)


@pytest.mark.parametrize("a", [0.0, 2.0, -2.0])
@pytest.mark.parametrize("under", [2, 3])
@pytest.mark.parametrize("of", ["flat", "centroid ahead", "centroid behind"])
def test_draws_that_differ_in_how_many_nosings_lie_under(of, under, a):
    """Under the flat, or under the part of it ahead of or behind the foot of the gravity line."""
    rng = np.random.default_rng(under)
    p, slope, C_N, n, count = 0.3, 0.6, 0.2, 8, 12
    up = C_N * (math.tan(slope) + a / (9.80665 * math.cos(slope)))
    L = under * p + 0.05 + 0.4 * (of != "flat")
    C_L = 0.5 * L - up
    if of == "flat":
        L = under * p
    elif of == "centroid ahead":
        C_L = under * p - up
    else:
        C_L = L - under * p - up
    tread = Tread(L, C_L, C_N, 0.1, 0.1, 0.3)
    nosings = np.arange(n)[:, None] * p * np.array([[math.cos(slope), math.sin(slope)]])
    drawn = nosings + rng.normal(0.0, 0.01, (count, *nosings.shape))
    agrees(nosings, drawn, tread, DrawnTread(*(np.full(count, each) for each in tread[:3])), a)


def test_a_draw_of_which_no_step_lies_within_the_flat_loses_nothing():
    """Steps of 0.99 m under a flat of 1 m, and under one that is drawn shorter than they are."""
    nosings = 0.99 * np.arange(5)[:, None] * np.array([[0.8, 0.6]])
    on = DrawnTread(np.array([1.0, 0.98]), np.full(2, 0.4), np.full(2, 0.1))
    found = drawn_criterion(
        nosings, np.stack([nosings] * 2), Tread(1.0, 0.4, 0.1, 0.1, 0.1, 0.3), on
    )
    assert np.isfinite([found.downhill[0], found.uphill[0]]).all()
    assert found.downhill[1] == found.uphill[1] == math.inf


def test_how_far_the_centroid_may_move_towards_an_end():
    """By hand, on a slope of 3 in 4: 0.5 m less 0.2 m times (0.75 + (g/2) / (g 0.8))."""
    on = DrawnTread(*np.array([[1.0], [0.5], [0.2]]))
    of = SimpleNamespace(on=on, a=9.80665 / 2)
    beyond = _Losses._beyond(of, np.array([math.atan(0.75)]), np.array([0.5]))
    assert beyond == pytest.approx(0.5 - 0.2 * 1.375)


@pytest.mark.parametrize("seed", range(60, 76))
def test_of_any_part_of_a_flight_the_same_counts(seed):
    """Parts of a fifth of it: what decides the whole is left out of most of them."""
    nosings, drawn, tread, on, a = flights(seed, 6)
    cuts = flights_of(nosings, tread.L)
    first, last = nosings[0, 0], nosings[-1, 0]
    each = []
    for k, one in enumerate(drawn):
        mine = tread._replace(L=on.L[k], C_L=on.C_L[k], C_N=on.C_N[k])
        if flights_of(one, mine.L) == cuts:
            each.append((k, static_criterion(one, mine, acceleration=a)))
    for share in np.linspace(-0.2, 1.0, 9):
        within = first + share * (last - first), first + (share + 0.2) * (last - first)
        found = drawn_criterion(nosings, drawn, tread, on, acceleration=a, within=within)
        for k, alone in each:
            part = alone.within(*within)
            figures = (
                (found.downhill, margin_of(part, downhill=True)),
                (found.uphill, margin_of(part, downhill=False)),
                (found.landing, margin_of(part, downhill=True, landing=True)),
                (found.rocking, part.rocking),
                (found.rise, rise_of(part)),
                (found.landing_rise, rise_of(part, landing=True)),
            )
            for drawn_ones, by_itself in figures:
                # rad, m: rounding of functions of libm and numpy
                assert drawn_ones[k] == pytest.approx(by_itself, abs=1e-9)


@pytest.mark.parametrize("seed", range(20))
def test_the_steepest_inclination_is_that_of_the_losses(seed, monkeypatch):
    """Going up, before or after each, on the flight and with the uphill end over the landing."""
    nosings, drawn, tread, on, a = flights(seed, 10)
    found = drawn_criterion(nosings, drawn, tread, on, acceleration=a)
    monkeypatch.setattr(static, "_gains", lambda *given: [])
    for k, one in enumerate(drawn):
        mine = tread._replace(L=on.L[k], C_L=on.C_L[k], C_N=on.C_N[k])
        if flights_of(one, mine.L) != flights_of(nosings, tread.L):
            continue
        alone = static._of_nosings.__wrapped__(one.tobytes(), mine, a)
        for drawn_ones, landing in ((found.inclination, False), (found.landing_inclination, True)):
            slopes = [each.slope for each in losses_of(alone, landing=landing) if each.downhill]
            assert drawn_ones[k] == pytest.approx(max(slopes, default=-math.inf), abs=1e-9)


def test_where_there_is_no_flight_nothing_is_said():
    tread = Tread(1.0, 0.4, 0.1, 0.1, 0.1, 0.3)
    on = DrawnTread(*(np.full(3, each) for each in tread[:3]))
    for nosings in (np.zeros((1, 2)), np.array([[0.0, 0.0], [1.2, 0.5]])):
        found = drawn_criterion(nosings, np.repeat(nosings[None], 3, axis=0), tread, on)
        inf = math.inf
        expected = (inf, inf, inf, 0.0, inf, inf, -inf, -inf)
        for each, one in zip(found, expected, strict=True):
            assert each.tolist() == [one] * 3
