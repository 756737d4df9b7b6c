"""Entering after Guo et al. 2010: the centroid against the first step, asked both ways round."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kaidan.errors import InputError
from kaidan.literature.entering import (
    balance_inclination,
    edge_start_friction,
    ends_of,
    first_step,
    least_lever,
    start_friction,
    tail_gap,
)
from kaidan.mechanics.transitions import (
    best_inclination,
    largest_step_height,
    riser_start_friction,
    step_height,
)
from kaidan.outline import Outline
from kaidan.robot import FlipperPair, Payload, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import traverse

ROUNDING = 1e-13  # lengths and tangents of order one through a cube root and back
BODY = st.tuples(st.floats(0.03, 0.4), st.floats(0.0, 1.0), st.floats(0.05, 1.5))


@given(BODY)
def test_the_two_questions_are_each_others_inverse(body):
    # oracle: the mechanics' cubic, in tan(theta), against this one, in 1 / cos(theta)
    C_N, share, l_c = body
    at = {"C_N": C_N, "R": share * C_N}
    h = largest_step_height(l_c=l_c, **at)
    if h < 1e-3:  # the stairs' sheet has no lower riser
        return
    assert least_lever(h=h, **at) == pytest.approx(l_c, rel=ROUNDING)
    best = best_inclination(l_c=l_c, **at)
    assert balance_inclination(h=h, **at) == pytest.approx(best, rel=1e-9)  # flat there: sqrt


@pytest.mark.parametrize("R", [0.0, 0.05, 0.09])
@pytest.mark.parametrize("h", [0.02, 0.18, 0.4])
def test_no_inclination_asks_for_a_shorter_lever(h, R):
    # oracle: a scan of the definition
    theta = np.linspace(1e-3, 1.5, 20_001)
    scan = (h - R * (1 - np.cos(theta))) / np.sin(theta) + 0.1 * np.tan(theta)
    least = least_lever(h=h, C_N=0.1, R=R)
    assert least <= scan.min() + 1e-15
    assert scan.min() == pytest.approx(least, rel=1e-5)  # half a cell squared
    assert step_height(
        theta=balance_inclination(h=h, C_N=0.1, R=R), l_c=least, C_N=0.1, R=R
    ) == pytest.approx(h, abs=ROUNDING)


def test_balance_by_hand():
    # hand: u^3 - u = 6, u = 2; w < 1 with R = C_N, h = R: u^3 = 2 u
    assert balance_inclination(h=0.6, C_N=0.1, R=0.0) == pytest.approx(math.pi / 3, abs=1e-15)
    assert balance_inclination(h=0.1, C_N=0.1, R=0.1) == pytest.approx(math.pi / 4, abs=1e-15)


def test_outside_the_formula_is_nan():
    with np.errstate(invalid="ignore"):
        assert math.isnan(balance_inclination(h=0.1, C_N=0.1, R=0.11))
        assert math.isnan(balance_inclination(h=0.0, C_N=0.1, R=0.05))
        assert math.isnan(edge_start_friction(h=0.11, l_c=0.3, C_L=0.2, R=0.1))


@given(st.floats(0.05, 1.0), st.floats(0.0, 1.0), st.floats(0.01, 0.3), st.floats(0.01, 1.0))
def test_reactions_at_the_start_meet_under_the_centroid(l_c, C_L, R, share):
    # oracle: three forces balance if their lines meet in one point
    mu = edge_start_friction(h=share * R, l_c=l_c, C_L=C_L, R=R)
    delta = math.acos(1 - share)
    height = l_c / mu
    ahead = (height - share * R) * math.tan(delta - math.atan(mu))
    assert ahead == pytest.approx(C_L + R * math.sin(delta), abs=1e-11)


def test_start_over_an_edge_at_its_limits():
    # limit: an edge as high as the end is a riser; a low one asks for delta l_c / L
    at = {"l_c": 0.3, "C_L": 0.2, "R": 0.1}
    assert edge_start_friction(h=0.1, **at) == pytest.approx(riser_start_friction(**at), abs=1e-15)
    delta = 1e-4
    low = edge_start_friction(h=0.1 * (1 - math.cos(delta)), **at)
    assert low == pytest.approx(delta * 0.3 / 0.5, rel=1e-3)  # next order in delta


def test_tail_gap_by_hand():
    # hand: level, the edge under the centroid: l_c + R - R ahead of the tail
    assert tail_gap(theta=0.0, l_c=0.3, C_N=0.1, R=0.1) == pytest.approx(0.2, abs=1e-15)


@given(BODY, st.floats(0.1, 10.0), st.floats(0.01, 0.5))
def test_scaling(body, k, h):
    # property: lengths times k
    C_N, share, l_c = body
    R = share * C_N
    big = {"C_N": k * C_N, "R": k * R}
    assert least_lever(h=k * h, **big) == pytest.approx(k * least_lever(h=h, C_N=C_N, R=R))
    one = edge_start_friction(h=R, l_c=l_c, C_L=0.2, R=R) if R else 0.0
    if R:
        many = edge_start_friction(h=k * R, l_c=k * l_c, C_L=k * 0.2, R=k * R)
        assert many == pytest.approx(one)


@pytest.mark.parametrize("name", ["kenaf", "csiro-dtr"])
@pytest.mark.parametrize("aside", [-5e-4, 5e-4])
def test_the_contact_model_agrees(name, aside):
    # agreement: half a millimetre lower is climbed, half a millimetre higher is not
    robot = Robot.named(name)
    asked = first_step(robot, Stairs(rise=0.17, going=0.3))
    assert asked.largest_rise > 0.05
    h = asked.largest_rise + aside
    step = Profile.of_points([(-1, 0), (0, 0), (0, h), (1, h)])
    assert traverse(step, Outline.of(robot), with_margins=False).arrived == (aside < 0)


def test_the_contact_model_agrees_on_random_robots():
    # agreement: as above; where the formula says that it does not hold, nothing is compared
    draw = np.random.default_rng(2010)
    compared = 0
    while compared < 40:
        L, R = draw.uniform(0.3, 1.2), draw.uniform(0.01, 0.15)
        body = Robot(
            name="random",
            com_from_front=L * draw.uniform(0.15, 0.85),
            com_height=R * draw.uniform(1.0, 3.0),
            track=Track(flat_length=L, front_radius=R, rear_radius=R),
        )
        asked = first_step(body, Stairs(rise=0.2, going=0.3))
        if math.isnan(asked.largest_rise) or asked.largest_rise < 0.01:
            continue
        compared += 1
        for aside in (-5e-4, 5e-4):
            h = asked.largest_rise + aside
            step = Profile.of_points([(-2, 0), (0, 0), (0, h), (2, h)])
            found = traverse(step, Outline.of(body), with_margins=False)
            assert found.arrived == (aside < 0)


def test_kenaf_does_not_get_over_the_ibcs_first_step():
    found = first_step(Robot.named("kenaf"), Stairs.named("ibc"))
    assert found.holds is False
    assert found.rise == 0.178
    assert found.rise_margin < 0
    assert found.centroid_margin < 0
    # oracle: with the centroid at the limit the riser is the highest
    R, C_N = found.ends.R_rear, found.ends.C_N
    assert largest_step_height(l_c=0.470 - found.com_limit, C_N=C_N, R=R) == pytest.approx(0.178)


def test_only_the_first_riser_counts():
    robot = Robot.named("kenaf")
    low = first_step(robot, Stairs(rise=0.3, going=0.3, first_rise=0.1))
    assert low.holds is True
    assert low == first_step(robot, Stairs(rise=0.1, going=0.2))


def test_a_payload_behind_is_bad_and_in_front_is_good():
    robot = Robot.named("marmotte")
    stairs = Stairs.named("ibc")
    before = first_step(robot, stairs).centroid_margin
    at = {"mass": 5.0, "height": robot.com_height}
    behind = first_step(robot, stairs, payload=[Payload(from_front=0.7, **at)]).centroid_margin
    ahead = first_step(robot, stairs, payload=[Payload(from_front=0.0, **at)]).centroid_margin
    assert behind < before < ahead


def robot(**changes):
    pair = FlipperPair(length=0.3, root_radius=0.06, tip_radius=0.03, pivot_height=0.03, mass=1.0)
    sheet = {
        "name": "toy",
        "mass": 20.0,
        "com_from_front": 0.2,
        "com_height": 0.1,
        "track": Track(flat_length=0.5, front_radius=0.06, rear_radius=0.07),
        "front_flippers": pair,
        "rear_flippers": pair,
    }
    return Robot(**(sheet | changes))


def test_the_start_changes_its_formula_where_the_riser_passes_the_radius():
    # limit: continuous there, since at h = R both are the same; hand: constant above, less below
    ends = ends_of(robot(), robot().stance())
    at = riser_start_friction(l_c=0.3, C_L=0.2, R=0.06)
    assert start_friction(ends, 0.06) == pytest.approx(at, abs=1e-15)
    assert start_friction(ends, 0.0601) == start_friction(ends, 0.2) == at
    assert start_friction(ends, 0.05) < at


def test_ends_turn_round_with_the_robot():
    toy = robot()
    stance = toy.stance()
    assert ends_of(toy, stance) == (0.5, 0.2, 0.1, 0.06, 0.07)
    assert ends_of(toy, stance, "tail-first") == (0.5, 0.3, 0.1, 0.07, 0.06)


def test_mirror():
    # property: tail first is the robot with its ends swapped, nose first
    stairs = Stairs(rise=0.15, going=0.3)
    swapped = robot(
        com_from_front=0.3, track=Track(flat_length=0.5, front_radius=0.07, rear_radius=0.06)
    )
    one, other = first_step(robot(), stairs, facing="tail-first"), first_step(swapped, stairs)
    assert one.ends == pytest.approx(other.ends)
    assert one.largest_rise == pytest.approx(other.largest_rise)
    assert one.com_limit == pytest.approx(other.com_limit)
    assert one.start_friction == pytest.approx(other.start_friction)


def test_flippers_in_line_lend_their_ends():
    from kaidan.robot import Posture

    toy = robot()
    front = ends_of(toy, toy.stance(Posture(front="flat")))
    rear = ends_of(toy, toy.stance(Posture(rear="flat")))
    assert (front.L, front.R_front, front.R_rear) == pytest.approx((0.8, 0.03, 0.07))
    assert (rear.L, rear.R_front, rear.R_rear) == pytest.approx((0.8, 0.06, 0.03))


def test_outside_is_told_and_an_unknown_facing_refused():
    outside = first_step(
        robot(track=Track(flat_length=0.5, rear_radius=0.12)), Stairs(rise=0.15, going=0.3)
    )
    assert outside.holds is None
    assert math.isnan(outside.largest_rise)
    assert math.isnan(outside.com_limit)
    with pytest.raises(InputError) as refused:
        first_step(robot(), Stairs(rise=0.15, going=0.3), facing="sideways")
    assert str(refused.value) == "facing = 'sideways' is not known; known: nose-first, tail-first"


def test_a_tail_that_meets_the_riser_is_outside():
    # hand: tan = 0.76 nearly solves t^3 + t = 1.2: (0.12 - 0.076) 0.796 + 0.0605 - 0.1 = -0.0045
    theta = best_inclination(l_c=0.12, C_N=0.1, R=0.1)
    assert tail_gap(theta=theta, l_c=0.12, C_N=0.1, R=0.1) == pytest.approx(-0.0045, abs=2e-4)
    short = robot(com_from_front=0.38, track=Track(flat_length=0.5, rear_radius=0.1))
    found = first_step(short, Stairs(rise=0.15, going=0.3))
    assert found.holds is None
    assert math.isnan(found.largest_rise)
