"""The criterion of no rotation on nosings: the closed form on even ones, by hand on uneven ones."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kaidan import Question, Robot, Stairs
from kaidan.mechanics.margin import theta_s_inf, theta_s_sup
from kaidan.models.quasi_static import traverse_of
from kaidan.modes import Phase
from kaidan.traversal.criterion import Criterion, Loss, Seesaw, Tread
from kaidan.traversal.static_criterion import flights_of, static_criterion

KENAF = Tread(0.470, 0.196, 0.071, 0.06, 0.06, 0.2)


def flight(slope, p, n=14):
    k = np.arange(n)
    return np.c_[k * p * math.cos(slope), k * p * math.sin(slope)]


@given(
    L=st.floats(0.3, 1.5),
    C_L=st.floats(0.2, 0.8),
    C_N=st.floats(0.05, 0.5),
    p=st.floats(0.15, 0.49),
    slope=st.floats(0.1, 1.2),
    a=st.floats(-2.0, 2.0),
)
def test_on_even_nosings_it_is_the_closed_form(L, C_L, C_N, p, slope, a):
    """docs/theory/uneven.md: all chords have one slope."""
    C_L, C_N, p = C_L * L, C_N * L, p * L
    sup = theta_s_sup(L=L, p=p, C_L=C_L, C_N=C_N, a=a)
    inf = theta_s_inf(p=p, C_L=C_L, C_N=C_N, a=a)
    found = static_criterion(
        flight(slope, p), Tread(L, C_L, C_N, 0.05, 0.05, L / 3), acceleration=a
    )
    down, up = found.smallest(downhill=True), found.smallest(downhill=False)
    if not math.isnan(sup):
        assert down.margin == pytest.approx(sup - slope, abs=1e-9)
    if not math.isnan(inf):
        assert up.margin == pytest.approx(slope - inf, abs=1e-9)
    assert found.rocking == pytest.approx(0.0, abs=1e-9)


def test_kenaf_of_the_paper():
    """The paper's Eqs. (19)-(23): 60.2 deg at 150 mm, and so on to 37.3 at 220 mm."""
    for p, sup in ((0.150, 60.205), (0.180, 52.936), (0.200, 46.185), (0.220, 37.255)):
        slope = math.radians(30.0)
        worst = static_criterion(flight(slope, p), KENAF).smallest(downhill=True)
        assert math.degrees(worst.margin + slope) == pytest.approx(sup, abs=5e-4)


def test_each_loss_and_gain_of_a_short_flight_by_hand():
    """Five nosings 1 m apart on a slope of 3 in 4, under a flat of 2.5 m.

    As one is left the nosing behind it lies 1.5 m within the tip; as one is reached, 2 m. The
    centroid may move by that, less its place and C_N tan of the slope. Over the landing above the
    downhill end leaves one more nosing, the uphill end none.
    """
    C_L, C_N, slope = 0.75, 0.4, math.atan2(3, 4)
    found = static_criterion(flight(slope, 1.0, 5), Tread(2.5, C_L, C_N, 0.0, 0.0, 1.0))
    up, down = C_N * 0.75, 2.5 - C_L  # beyond the lever: uphill end and downhill end

    def by_hand(downhill, nosing, lever, contacts, place, landing=False):
        sign = 1 if downhill else -1
        margin = math.atan2(lever, C_N) - sign * slope
        spare = lever - sign * up
        rise = math.hypot(lever, C_N) - sign * lever * 0.6 - C_N * 0.8
        place = 0.8 * place - 0.6 * C_N
        figures = (sign * slope, lever, margin, spare, 0.0, 0.0, rise)
        return (downhill, nosing, *figures, 0.0, contacts, landing, place)

    expected = [
        *(by_hand(True, i, 1.5 - C_L, 2, i + down, i == 2) for i in range(3)),
        *(by_hand(True, m, 2.0 - C_L, 2, m - C_L) for m in (3, 4)),
        *(by_hand(False, i, 1.5 - down, 2, i - C_L) for i in (4, 3)),
        *(by_hand(False, m, 2.0 - down, 2, m + down) for m in (1, 0)),
    ]
    assert [tuple(each) for each in found.losses] == [
        pytest.approx(each, abs=1e-12) for each in expected
    ]
    assert found.tops == (pytest.approx(3.2),)
    assert found.seesaw == pytest.approx((0.0, 0.0), abs=1e-12)
    assert found.holds is True
    assert not found.alone


def test_the_last_loss_over_the_landing():
    """The centroid has passed the last nosing if it lies behind the nose by no more than
    1.5 - 1 m, less C_N tan of the slope: then the end comes down on the landing.
    """
    for C_L, count in ((0.19, 2), (0.21, 3)):
        found = static_criterion(
            flight(math.atan2(3, 4), 1.0, 5), Tread(2.5, C_L, 0.4, 0.0, 0.0, 1.0)
        )
        losses = [each for each in found.losses if each.downhill and each.nosing < 3]
        assert len(losses) == count


def test_what_a_criterion_says_of_its_losses():
    """By hand: over the landing nothing counts for the flight."""
    loss = Loss(True, 1, 0.5, 0.1, 0.2, 0.05, 0.015, 0.01, 0.004, 0.001, 2, False, 1.0)
    lands = loss._replace(margin=-0.1, contacts=1, landing=True, turn=0.05, rocking=0.03)
    found = Criterion((loss, lands), Seesaw(0.04, 0.02), (1.0, 2.0))
    assert (found.holds, found.alone, found.turn, found.rocking) == (True, False, 0.05, 0.03)
    assert Criterion((lands,)).holds is None
    for margin, holds in ((0.0, False), (-0.1, False), (0.1, True)):
        both = Criterion((loss, loss._replace(margin=margin)))
        assert both.holds is holds
    one = Criterion((loss, loss._replace(contacts=1)), Seesaw(0.04, 0.02))
    assert (one.alone, one.turn, one.rocking) == (True, 0.04, 0.02)
    # both ends count
    for part, losses, tops in (((1.0, 2.0), 2, (1.0, 2.0)), ((1.1, 1.9), 0, ()), ((0, 1), 2, (1,))):
        within = found.within(*part)
        assert (len(within.losses), within.tops) == (losses, tops)
    # of those that are alike the first
    alike = [loss._replace(nosing=k, margin=0.2 + 4e-13 * m) for k, m in ((1, 1), (2, 0), (3, 3))]
    assert Criterion(tuple(alike)).smallest(downhill=True).nosing == 1
    assert Criterion(tuple(alike)).smallest(downhill=False) is None


def test_landings_cut_the_nosings_into_flights():
    """A distance of the flat's length is a landing; one nosing between two is no flight."""
    x = np.array([0.0, 1.0, 3.0, 5.5, 8.0, 9.0])
    assert flights_of(np.c_[x, 0 * x], 2.5) == [(0, 2), (4, 5)]
    assert flights_of(np.c_[x, 0 * x][:2], 2.5) == [(0, 1)]
    assert flights_of(np.c_[x, 0 * x][:1], 2.5) == []


def test_no_slope_tips_where_the_acceleration_alone_holds_it_down():
    """a/g C_N above the distance of the centroid from the pivot: no slope balances it."""
    slope, tread = math.atan2(3, 4), Tread(2.5, 0.75, 0.4, 0.0, 0.0, 1.0)
    first = {
        a: static_criterion(flight(slope, 1.0, 5), tread, acceleration=a).losses[0]
        for a in (-30.0, 30.0)
    }
    # 0.4 * 30 / 9.80665 is more than hypot(0.75, 0.4)
    assert first[-30.0].margin == pytest.approx(math.pi / 2)
    assert first[30.0].margin == pytest.approx(-math.pi / 2)
    for a, loss in first.items():
        assert loss.centroid == pytest.approx(0.45 - 0.4 * a / (9.80665 * 0.8))


@pytest.mark.parametrize("h", [1e-6, 1e-4, 1e-3])
def test_every_other_nosing_higher_by_h_rocks_by_hand(h):
    """Two high nosings, 2 p apart, carry; the low one between them lies h below their chord.

    As a high one is left the flat falls back onto the low one: an angle of atan(h/p) to first
    order.
    """
    p, slope = 0.100, math.radians(40.0)
    nosings = flight(slope, p)
    nosings[::2] += h * np.array([-math.sin(slope), math.cos(slope)])
    found = static_criterion(nosings, KENAF)
    assert found.rocking == pytest.approx(h / p, rel=0.02)
    even = static_criterion(flight(slope, p), KENAF).smallest(downhill=True).margin
    uneven = found.smallest(downhill=True).margin
    assert even - 2.5 * h / p <= uneven <= even + 1e-12


def test_no_more_rocks_than_is_off_the_mean_slope_by_hand():
    """Of five nosings 1 m apart the middle one stands out by h, at right angles to the slope.

    As the tip leaves the one below it, the flat turns about it from atan(h) beyond the slope to as
    much short of it, and see-saws so.
    """
    slope, h = math.atan2(3, 4), 0.02
    nosings = flight(slope, 1.0, 5)
    nosings[2] += h * np.array([-0.6, 0.8])
    tread = Tread(2.5, 0.75, 0.4, 0.0, 0.0, 1.0)
    found = static_criterion(nosings, tread)
    assert found.turn == pytest.approx(2 * math.atan(h))
    assert found.rocking == pytest.approx(math.atan(h))
    (loss,) = (each for each in found.losses if each.downhill and each.turn > 0.03)
    assert (loss.nosing, loss.rocking) == (1, pytest.approx(math.atan(h)))
    assert found.seesaw == pytest.approx((2 * math.atan(h), math.atan(h)))


def test_a_micrometre_moves_nothing():
    rng = np.random.default_rng(0)
    for p in (0.15, 0.18, 0.2):
        nosings = flight(math.radians(40.0), p)
        even = static_criterion(nosings, KENAF)
        other = static_criterion(nosings + rng.uniform(-1e-6, 1e-6, nosings.shape), KENAF)
        for side in (True, False):
            change = other.smallest(downhill=side).margin - even.smallest(downhill=side).margin
            assert abs(math.degrees(change)) < 0.01
        assert math.degrees(other.rocking) < 0.01


def test_margins_and_rocking_know_no_scale():
    rng = np.random.default_rng(1)
    nosings = flight(0.7, 0.15) + rng.uniform(-3e-3, 3e-3, (14, 2))
    one = static_criterion(nosings, KENAF)
    ten = static_criterion(10 * nosings, Tread(*(10 * value for value in KENAF)))
    assert ten.rocking == pytest.approx(one.rocking)
    for side in (True, False):
        a, b = one.smallest(downhill=side), ten.smallest(downhill=side)
        assert b.margin == pytest.approx(a.margin)
        assert b.rise == pytest.approx(10 * a.rise)


def test_seen_from_the_other_side_the_ends_change_places():
    """x to -x, the other end's radius, the centroid from the other tip, slope and margin alike."""
    rng = np.random.default_rng(2)
    nosings = flight(0.5, 0.16) + rng.uniform(-3e-3, 3e-3, (14, 2))
    mirrored = nosings[::-1] * np.array([-1.0, 1.0])
    one = static_criterion(nosings, KENAF)
    other = static_criterion(mirrored, KENAF.mirrored())
    assert other.smallest(downhill=True).margin == pytest.approx(
        one.smallest(downhill=False).margin
    )
    assert other.rocking == pytest.approx(one.rocking)


@pytest.mark.parametrize("p", [0.236, 0.24, 0.3, 0.4])
def test_past_half_the_flat_the_formula_goes_on(p):
    """p > L/2 = 235 mm: one nosing stays, and one of the two limits is passed."""
    found = static_criterion(flight(0.5, p), KENAF)
    assert found.alone
    assert len(found.losses) == 24  # twelve at either end; nothing carries as one is reached
    sup = math.atan2(0.470 - p - 0.196, 0.071)
    inf = math.atan2(p - 0.196, 0.071)
    assert found.smallest(downhill=True).margin == pytest.approx(sup - 0.5, abs=1e-9)
    assert found.smallest(downhill=False).margin == pytest.approx(0.5 - inf, abs=1e-9)
    assert found.holds is False


def test_no_flight_says_nothing():
    assert static_criterion(np.empty((0, 2)), KENAF).holds is None
    assert static_criterion(flight(0.5, 0.6), KENAF).holds is None  # landings in between


def test_going_down_what_is_over_the_upper_landing_enters():
    """The energy margin of landing below is not that of nosings lost above."""
    up, down = (
        traverse_of(
            Question.in_one_posture("kenaf", Stairs.inclined(angle=0.7, nosing_spacing=0.15), **way)
        )
        for way in ({"direction": "up"}, {"direction": "down", "facing": "tail-first"})
    )
    over = {each.phase: each.energy_margin for each in up.phases}[Phase.LAND]
    of_down = {each.phase: each.energy_margin for each in down.phases}
    assert of_down[Phase.ENTER] == pytest.approx(over, rel=1e-6)
    assert of_down[Phase.LAND] > 2.0 * over


def test_a_step_longer_than_the_flat_in_a_chain_of_flights_is_judged_as_alone():
    kenaf = Robot.named("kenaf")
    short = Stairs.inclined(angle=math.radians(35.0), nosing_spacing=0.15, steps=8)
    long = Stairs.inclined(angle=math.radians(15.0), nosing_spacing=0.50, steps=6)
    alone, *chains = (
        traverse_of(Question.in_one_posture(kenaf, each, friction=2.0)).downhill_margin
        for each in (long, (short, long), (long, short))
    )
    # both from a bisection to 0.1 deg
    assert chains == pytest.approx([alone, alone], abs=math.radians(0.2))
