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
from kaidan.traversal.static_criterion import Tread, static_criterion

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
