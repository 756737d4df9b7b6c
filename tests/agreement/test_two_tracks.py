"""Both tracks on nosings that differ: three judges.

The support polygon of a regular flight, in closed form: it states how much steeper the flight may
be, this how far gravity may lean; both vanish on the same slope, and the roll is the same. A convex
hull in space by qhull, with dihedral angles: any points. Bands are 1e-6 rad and less: positions are
taken 1e-6 m beside the exchange of a contact.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq, linprog
from scipy.spatial import ConvexHull

from amounts import examples, slow
from kaidan import Question, Robot, Stairs
from kaidan.mechanics.two_tracks import track_points, two_track_margins
from kaidan.models import support_polygon
from kaidan.models.two_tracks import margins_on
from kaidan.robot import Posture

BAND = 1e-5
STANCE = Robot.named("absolem").stance(Posture(front="flat", rear="flat"))
ROBOT = {
    "gauge": 0.397, "L": STANCE.flat_length, "C_L": STANCE.com_from_front,
    "C_N": STANCE.com_height,
}  # fmt: skip


SPACING = math.hypot(0.178, 0.279)


def straight(psi, p=SPACING, count=40):
    zero = np.zeros(count)
    line = {"u": p * np.arange(count), "w": zero, "u_across": zero, "w_across": zero}
    half = ROBOT["gauge"] / 2
    return [track_points(**line, psi=psi, y=y) for y in (half, -half)]


def question(yaw=0.0, **more):
    manner = {"flippers": "flat", "friction": 2.0, "theta_d": 0.0, "theta_M": 0.0}
    flight = Stairs(rises=(0.178,) * 30, goings=(0.279,) * 29, **more)
    return Question.in_one_posture("absolem", flight, yaw=yaw, **manner)


@pytest.mark.parametrize("psi", [*map(slow, (0.05, 0.1)), 0.3, -0.2])
def test_straight_nosings_at_a_yaw_as_the_support_polygon(psi):
    left, right = straight(psi)
    asked = question()
    flight = Stairs(rise=0.178, going=0.279, steps=30)
    slope = flight.angle + support_polygon.margins_of(
        asked, flight, np.array([psi]), certain=True
    )[:, 0, 0]  # fmt: skip

    def margins(theta_s):
        return two_track_margins(
            left=left, right=right, **ROBOT, theta_s=theta_s, psi=psi
        )  # fmt: skip

    down = brentq(lambda theta: margins(theta).downhill, 0.1, 1.5)
    side = brentq(lambda theta: margins(theta).sideways, 0.1, 1.57)
    assert down == pytest.approx(slope[0], abs=BAND)
    assert side == pytest.approx(slope[2], abs=BAND)
    roll = math.atan(
        math.tan(flight.angle) * math.sin(abs(psi))
    )  # left axis over the normal's height
    assert margins(flight.angle).roll == pytest.approx(roll, abs=1e-9)


def test_without_a_yaw_as_the_support_polygon():
    found = margins_on(question(), question().terrain)
    flight = Stairs(rise=0.178, going=0.279, steps=30)
    expected = support_polygon.margins_of(question(), flight, np.zeros(1), certain=True)[:, 0, 0]
    assert found.downhill == pytest.approx(expected[0], abs=BAND)
    assert found.uphill == pytest.approx(expected[1], abs=BAND)
    assert found.roll == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("degrees", [2.0, -5.0])
def test_nosings_that_all_slope_alike(degrees):
    """By hand: over the plane z = x tan(theta) + y tan(c), tan(roll) = tan(c) cos(theta).

    Over its side it tips when gravity leans by atan(gauge / 2 C_N), less that roll.
    """
    c, asked = math.radians(degrees), question(cross_slopes=(math.radians(degrees),))
    found = margins_on(asked, asked.terrain)
    roll = math.atan(math.tan(abs(c)) * math.cos(asked.terrain.angle))
    assert found.roll == pytest.approx(roll, abs=1e-9)
    half = math.atan2(0.397 / 2, asked.stance.com_height)
    assert found.sideways == pytest.approx(half - roll, abs=1e-9)


def test_askew_nosings_roll_a_robot_that_goes_straight_on():
    """By hand: their plane is z = (x - y tan(k)) tan(theta), tan(roll) = tan(k) sin(theta)."""
    k, asked = math.radians(6.0), question(skews=(math.radians(6.0),))
    roll = math.atan(math.tan(k) * math.sin(asked.terrain.angle))
    assert margins_on(asked, asked.terrain).roll == pytest.approx(roll, abs=1e-9)


def test_points_under_the_tracks_as_turned_in_space():
    """Places of the nosings in space at y = +-gauge/2, turned into the plane by a matrix."""
    rng = np.random.default_rng(5)
    cross, skew = rng.uniform(-0.1, 0.1, 30), rng.uniform(-0.2, 0.2, 30)
    asked = question(cross_slopes=tuple(cross), skews=tuple(skew))
    theta = asked.terrain.angle
    s, z, half = 0.279 * np.arange(30), 0.178 * np.arange(1, 31), 0.397 / 2
    turn = np.array([[math.cos(theta), math.sin(theta)], [-math.sin(theta), math.cos(theta)]])
    left, right = (
        np.column_stack([s + y * np.tan(skew), z + y * np.tan(cross)]) @ turn.T
        for y in (half, -half)
    )
    expected = two_track_margins(left=left, right=right, **ROBOT, theta_s=theta)
    assert margins_on(asked, asked.terrain) == pytest.approx(expected, abs=1e-6)


def by_hull(left, right, theta_s, psi, front, L, C_L, C_N, gauge):
    """Margins over the edges downhill and uphill at one position, by qhull and dihedral angles."""
    sides = [
        np.insert(line[(line[:, 0] >= front - L) & (line[:, 0] <= front)], 1, y, axis=1)
        for line, y in ((left, gauge / 2), (right, -gauge / 2))
    ]
    if min(map(len, sides)) < 2:
        return None
    points = np.concatenate(sides)
    hull = ConvexHull(np.concatenate([points, points - [0, 0, 9.0]]))  # far below: upper facets
    up = np.array([math.sin(theta_s) * math.cos(psi), -math.sin(theta_s) * math.sin(psi),
                   math.cos(theta_s)])  # fmt: skip
    found = []
    count = len(sides[0])
    for one, two, inside in ((0, count, 1.0), (count - 1, len(points) - 1, -1.0)):
        for simplex, equation in zip(hull.simplices, hull.equations, strict=True):
            if equation[2] < 1e-3 or not {one, two} <= set(simplex):
                continue
            normal = equation[:3]
            ahead = np.array([1.0, 0.0, -normal[0] / normal[2]])
            ahead /= np.linalg.norm(ahead)
            height = -(normal[0] * front + equation[3]) / normal[2]
            centroid = np.array([front, 0.0, height]) - C_L * ahead + C_N * normal
            way = points[two] - points[one]
            way /= np.linalg.norm(way)
            arm = centroid - points[one]
            arm -= (arm @ way) * way
            lean = up - (up @ way) * way
            angle = math.atan2(np.cross(lean, arm) @ way, lean @ arm)
            found.append(-inside * angle)
    return found if len(found) == 2 else None


@settings(max_examples=examples(60))
@given(
    st.lists(st.floats(-0.02, 0.02), min_size=14, max_size=14),
    st.lists(st.floats(-0.02, 0.02), min_size=14, max_size=14),
    st.floats(-0.3, 0.3),
)
def test_twisted_nosings_as_a_convex_hull_in_space(low, high, psi):
    """The worst of all positions is compared, so both have to agree on every one that counts."""
    left, right = straight(psi, count=14)
    left[:, 1], right[:, 1] = low, high
    theta_s = 0.5
    found = two_track_margins(left=left, right=right, **ROBOT, theta_s=theta_s, psi=psi)
    r = np.concatenate([left[:, 0], right[:, 0]])
    L = ROBOT["L"]
    fronts = np.concatenate([r - 1e-6, r + L + 1e-6])
    first, last = max(left[0, 0], right[0, 0]) + L, min(left[-1, 0], right[-1, 0])
    judged = [
        by_hull(left, right, theta_s, psi, front, **ROBOT)
        for front in fronts[(fronts >= first) & (fronts <= last)]
    ]
    down, up = np.array([each for each in judged if each is not None]).min(axis=0)
    assert found.downhill == pytest.approx(down, abs=1e-6)
    assert found.uphill == pytest.approx(up, abs=1e-6)


@settings(max_examples=15)
@given(
    st.lists(st.floats(-0.03, 0.03), min_size=9, max_size=9),
    st.lists(st.floats(-0.03, 0.03), min_size=9, max_size=9),
    st.floats(-0.3, 0.3),
)
def test_the_underside_settles_where_a_linear_programme_puts_it(low, high, psi):
    """The plane on or above all points that is lowest under the centroid; then its roll."""
    left, right = straight(psi, count=9)
    left[:, 1], right[:, 1] = low, high
    theta_s, L, half = 0.5, ROBOT["L"], ROBOT["gauge"] / 2
    found = two_track_margins(left=left, right=right, **ROBOT, theta_s=theta_s, psi=psi)
    up = np.array([math.sin(theta_s) * math.cos(psi), -math.sin(theta_s) * math.sin(psi),
                   math.cos(theta_s)])  # fmt: skip
    foot = ROBOT["C_N"] * up / up[2]
    r = np.concatenate([left[:, 0], right[:, 0]])
    first, last = max(left[0, 0], right[0, 0]) + L, min(left[-1, 0], right[-1, 0])
    rolls = []
    for front in np.concatenate([r - 1e-6, r + L + 1e-6]):
        sides = [
            np.insert(line[(line[:, 0] >= front - L) & (line[:, 0] <= front)], 1, y, axis=1)
            for line, y in ((left, half), (right, -half))
        ]
        if not first <= front <= last or min(map(len, sides)) < 2:
            continue
        points = np.concatenate(sides)
        under = np.array([1.0, front - ROBOT["C_L"] - foot[0], -foot[1]])
        above = np.column_stack([np.ones(len(points)), points[:, :2]])
        solved = linprog(under, A_ub=-above, b_ub=-points[:, 2], bounds=[(None, None)] * 3)
        if not solved.success:  # the foot lies beyond the points: it tips, and has no roll
            return
        _, alpha, beta = solved.x
        normal = np.array([-alpha, -beta, 1.0]) / math.sqrt(alpha**2 + beta**2 + 1.0)
        aside = np.cross(normal, np.array([1.0, 0.0, alpha]) / math.hypot(1.0, alpha))
        rolls.append(abs(math.atan2(up @ aside, up @ normal)))
    if rolls:
        assert found.roll == pytest.approx(max(rolls), abs=1e-6)
        assert found.sideways == pytest.approx(
            math.atan2(half, ROBOT["C_N"]) - max(rolls), abs=1e-6
        )


def test_left_and_right_exchanged_give_the_same_margins():
    rng = np.random.default_rng(3)
    left, right = straight(0.1)
    left[:, 1] += rng.normal(0, 0.01, len(left))
    mirrored = {"theta_s": 0.5, "psi": -0.1}
    one = two_track_margins(left=left, right=right, **ROBOT, theta_s=0.5, psi=0.1)
    other = two_track_margins(left=right, right=left, **ROBOT, **mirrored)
    assert one == pytest.approx(other, abs=1e-12)
