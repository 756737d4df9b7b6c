"""Room in plain lengths: by hand, by brute force over corners and points, and in limits."""

import math

import numpy as np
import pytest

from kaidan.mechanics.clearance import (
    corner_margin,
    headroom_needed,
    lane_width,
    run_up_margin,
    spin_circle,
)
from kaidan.mechanics.footprint import Footprint, blocked, inscribed_circle, inside, walls_of
from kaidan.mechanics.turning import Goal, manoeuvre, on_the_spot


def corners(front, rear, w, x=0.0, y=0.0, psi=0.0, fill=1):
    """Corners of a footprint, or a grid of points all over it."""
    side = np.linspace(-1.0, 1.0, fill + 1)
    along = (front - rear) / 2 + side * (front + rear) / 2
    across = side * w / 2
    a, b = (each.ravel() for each in np.meshgrid(along, across))
    return np.column_stack(
        [x + a * np.cos(psi) - b * np.sin(psi), y + a * np.sin(psi) + b * np.cos(psi)]
    )


@pytest.mark.parametrize("psi", [0.0, 0.1, -0.4, 1.2])
def test_a_lane_is_as_wide_as_the_corners_of_the_rectangle(psi):
    y = corners(0.7, 0.5, 0.5, psi=psi)[:, 1]
    assert lane_width(w=0.5, length=1.2, psi=psi, error=0.04) == pytest.approx(np.ptp(y) + 0.08)


def test_for_small_yaw_it_is_the_rule_of_thumb():
    """w + 2 (e + psi l / 2), from above within the second order."""
    found = lane_width(w=0.5, length=1.2, psi=0.02, error=0.03)
    assert 0.5 + 2 * (0.03 + 0.02 * 0.6) - 0.5 * 0.02**2 <= found < 0.5 + 2 * (0.03 + 0.02 * 0.6)


@pytest.mark.parametrize(("theta", "beta"), [(0.0, 0.0), (0.6, 0.0), (0.6, 0.25), (0.3, 0.9)])
def test_headroom_is_that_of_the_highest_corner_above_the_line(theta, beta):
    H, length, phi = 0.7, 1.2, theta + beta
    x = [length * math.cos(phi) - H * math.sin(phi), -H * math.sin(phi)]
    z = [length * math.sin(phi) + H * math.cos(phi), H * math.cos(phi)]
    above = max(b - a * math.tan(theta) for a, b in zip(x, z, strict=True))
    found = headroom_needed(height=H, length=length, theta_s=theta, phi=phi)
    assert found == pytest.approx(above)


@pytest.mark.parametrize(
    ("length", "w", "circle"),
    [(0.678, 0.594, 0.90), (1.207, 0.594, 1.345), (0.978, 0.62, 1.16)],
    ids=["absolem stowed", "absolem flat", "hd2"],
)
def test_circles_of_real_robots(length, w, circle):
    """Lengths and widths over all of the models; Pythagoras, to the centimetre."""
    assert spin_circle(front=length / 2, rear=length / 2, w=w) == pytest.approx(circle, abs=0.005)


@pytest.mark.parametrize(("length", "w", "a", "b"), [(1.2, 0.5, 1.0, 0.9), (2.0, 0.3, 1.2, 0.8)])
def test_a_corner_by_brute_force(length, w, a, b):
    """The inner corner's distance to a line through two points, without the formula."""
    room = []
    for psi in np.linspace(0.0, math.pi / 2, 2001):
        p, q = np.array([length * math.sin(psi), 0.0]), np.array([0.0, length * math.cos(psi)])
        side = (q - p) / length
        off = np.array([b, a]) - p
        room.append(abs(side[0] * off[1] - side[1] * off[0]) - w)
    assert corner_margin(w=w, length=length, a=a, b=b) == pytest.approx(min(room), abs=1e-4)


def test_a_door_that_opens_onto_the_landing_takes_its_leaf():
    assert run_up_margin(depth=1.5, length=1.2, leaf=0.9) == pytest.approx(-0.6)


def test_a_wall_blocks_just_where_a_point_of_the_footprint_lies_beyond_it():
    """Exact test of segments against a fine grid of points, over random poses in an L."""
    ell = np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], dtype=float)
    random = np.random.default_rng(3)
    poses = np.column_stack([random.uniform(0, 2, (400, 2)), random.uniform(-4, 4, 400)])
    footprint = Footprint(0.35, 0.25, 0.4)
    found = blocked(footprint, poses, walls_of(ell))
    for pose, is_blocked in zip(poses, found, strict=True):
        within = inside(corners(*footprint, *pose, fill=60), ell)
        if not is_blocked:
            assert within.all() or not within.any()
        else:  # shrunk by what a grid of 10 mm does not see
            grown = corners(0.37, 0.27, 0.44, *pose, fill=60)
            assert not inside(grown, ell).all()


def half_turn(depth, lane=1.0, gap=0.2):
    across = 2 * lane + gap
    landing = np.array([(0, 0), (depth, 0), (depth, across), (0, across)])
    room = np.array([(-2, 0), (depth, 0), (depth, across), (0, across), (0, lane), (-2, lane)])
    return {
        "start": (0.02, lane / 2, 0.0),
        "goal": Goal(0.0, across - lane / 2, math.pi, lane),
        "landing": landing,
        "walls": walls_of(room),
    }, room


STOWED, FLAT = Footprint(0.339, 0.339, 0.594), Footprint(0.6035, 0.6035, 0.594)


@pytest.mark.parametrize(
    ("footprint", "depth", "turns"),
    [(STOWED, 1.0, True), (STOWED, 0.6, False), (FLAT, 1.4, True), (FLAT, 1.2, False)],
    ids=["stowed 1.0 m", "stowed 0.6 m", "flat 1.4 m", "flat 1.2 m"],
)
def test_absolem_on_a_half_turn_landing(footprint, depth, turns):
    """Flat it needs 1.35 m; shorter than its stowed length there is no turn at all."""
    asked, room = half_turn(depth)
    found = manoeuvre(footprint, **asked)
    assert (found is not None) is turns
    if found is not None:
        for pose in found.poses:
            shrunk = Footprint(*(each - 1e-6 for each in footprint))
            assert inside(corners(*shrunk, *pose, fill=20), room).all()
        assert abs(found.poses[-1, 2]) == pytest.approx(math.pi)


def test_a_turn_with_the_tail_over_the_flight_needs_less_than_the_circle():
    """1.25 m deep where the circle takes 1.30 m: the tail passes over the flight below."""
    landing = np.array([(0, 0), (1.25, 0), (1.25, 1.4), (0, 1.4)])
    room = np.array([(-2, 0), (1.25, 0), (1.25, 1.4), (-2, 1.4)])
    found = manoeuvre(
        FLAT,
        start=(0.02, 0.7, 0.0),
        goal=Goal(0.625, 1.4, math.pi / 2, 1.25),
        landing=landing,
        walls=walls_of(room),
    )
    assert found is not None
    assert np.all(found.poses[:, 0] > 0)


def test_a_robot_moves_aside_by_angles_that_take_it_less_than_a_cell_aside_in_a_stride():
    """OzBot in its lane is 884 - 750 mm short of the middle of the circle in which it turns."""
    asked, _ = half_turn(2.0, lane=1.5, gap=0.0)
    found = manoeuvre(Footprint(0.803, 0.780, 0.738), **asked)
    assert found is not None
    _, y, _ = found.poses.T
    assert y.max() > 1.5


def test_it_turns_on_the_spot_farther_on_where_the_shortest_drive_across_is_not_free():
    """By hand: a landing of 1.63 m whose middle part is only 1.3 m deep, and which ends 7 mm before
    the riser, as precast ones do. A circle of 0.9 m passes the corner 0.77 m beyond the edge."""
    landing = np.array([(0, 0), (1.63, 0), (1.63, 2.4), (0.23, 2.4), (0.23, 1.3), (0.33, 1.3),
                        (0.33, 1.08), (0, 1.08)])  # fmt: skip
    room = np.vstack([walls_of(landing)[:-1], [(-1.5, 0, 0, 0), (-1.5, 1.08, 0, 1.08)]])
    found = on_the_spot(
        STOWED,
        start=(0.11, 0.54, 0.0),
        goal=Goal(0.223, 1.86, math.pi, 1.08),
        landing=landing,
        walls=room,
    )
    assert found is not None
    assert (found.moves, found.reversals) == (5, 0)
    assert not blocked(STOWED, found.poses, room).any()
    assert found.poses[np.abs(found.poses[:, 1] - 1.2) < 0.2, 0] == pytest.approx(0.79, abs=0.03)


def test_the_largest_circle_of_a_rectangle_and_of_a_triangle():
    rectangle = np.array([(0, 0), (2, 0), (2, 1.2), (0, 1.2)])
    assert inscribed_circle(walls_of(rectangle), rectangle)[2] == pytest.approx(0.6, abs=0.005)
    triangle = np.array([(0, 0), (4, 0), (0, 3)])  # legs 3 and 4: radius 1
    assert inscribed_circle(walls_of(triangle), triangle)[2] == pytest.approx(1.0, abs=0.005)
