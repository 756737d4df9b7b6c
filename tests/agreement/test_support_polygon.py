"""The polygon of both tracks in closed form against contacts laid out in space, pose by pose."""

import math

import numpy as np
import pytest

from amounts import fast_and_slow
from kaidan.models.support_polygon import energy_of, margins_of
from kaidan.question import Question
from kaidan.robot import Robot, Track
from kaidan.terrain.stairs import Stairs

G = 9.80665


def corners(L, C_L, gauge, p, psi, shift):
    """Contacts in the underside, the centroid's foot at the origin: from nosing lines in space."""
    along = np.array([math.cos(psi), -math.sin(psi)])  # steepest ascent seen from the robot
    points = []
    for y in (-gauge / 2, gauge / 2):
        for k in range(-200, 200):
            s = (k * p + shift - along[1] * y) / along[0]
            if -(L - C_L) - 1e-12 <= s <= C_L + 1e-12:
                points.append((s, y))
    return np.array(points)


def inside(points, z):
    """Smallest distance of a point from the hull's edges, negative outside (by half planes)."""
    worst = math.inf
    for i, a in enumerate(points):
        for b in points[i + 1 :]:
            t = (b - a) / np.linalg.norm(b - a)
            side = t[0] * (points[:, 1] - a[1]) - t[1] * (points[:, 0] - a[0])
            at = t[0] * (z[1] - a[1]) - t[1] * (z[0] - a[0])
            if (side >= -1e-9).all():
                worst = min(worst, at)
            elif (side <= 1e-9).all():
                worst = min(worst, -at)
    return worst


@pytest.mark.parametrize("count", fast_and_slow(40, 150))
def test_the_sign_of_the_margin_is_the_polygons(count):
    """Random robots, slopes, yaws and accelerations, each at 61 progresses."""
    rng = np.random.default_rng(5)
    seen = {True: 0, False: 0}
    for _ in range(count):
        L = rng.uniform(0.4, 1.2)
        C_L, C_N = L * rng.uniform(0.3, 0.7), L * rng.uniform(0.08, 0.35)
        gauge, p = rng.uniform(0.3, 0.8) * L, L / rng.uniform(2.2, 5.0)
        theta, psi = rng.uniform(0.3, 0.9), rng.uniform(-0.9, 0.9)
        a = rng.choice([0.0, rng.uniform(-1.0, 1.0)])
        if p * math.sin(theta) < 0.021 or p / math.cos(psi) > L:
            continue
        robot = Robot(
            name="r",
            com_from_front=C_L,
            com_height=C_N,
            track=Track(flat_length=L, front_radius=0.05, rear_radius=0.05, gauge=gauge),
        )
        flight = Stairs.inclined(angle=theta, nosing_spacing=p)
        question = Question.in_one_posture(robot, flight, friction=1.0, acceleration=a)
        margin = float(margins_of(question, flight, np.array([psi])).min())
        load = C_N * math.tan(theta)
        z = np.array(
            [
                -load * math.cos(psi) - C_N * a / (G * math.cos(theta)),
                load * math.sin(psi),
            ]
        )
        # every event lies within the sixty-first part of a spacing of one of these, or on it
        events = [(k * p / 60) for k in range(60)]
        for y in (-gauge / 2, gauge / 2):
            for tip, past in ((-(L - C_L), -1e-9), (C_L, 1e-9)):
                events.append((tip + past) * math.cos(psi) - math.sin(psi) * y)
        found = min(inside(corners(L, C_L, gauge, p, psi, at), z) for at in events)
        if abs(margin) > 1e-6:  # rad: on the very edge rounding decides
            assert (margin > 0) == (found > 0), (L, C_L, C_N, gauge, p, theta, psi, a)
            seen[margin > 0] += 1
    assert min(seen.values()) > count / 8


@pytest.mark.parametrize("psi", [0.3, -0.5, 0.8])
@pytest.mark.parametrize("a", [0.0, 0.7])
def test_at_the_slope_that_the_margin_leaves_the_load_passes_an_edge(psi, a):
    """A milliradian less steep it is within the polygon at every progress, one more it is not."""
    L, C_L, C_N, gauge, p, theta = 0.7, 0.3, 0.12, 0.45, 0.16, 0.4
    robot = Robot(
        name="r",
        com_from_front=C_L,
        com_height=C_N,
        track=Track(flat_length=L, front_radius=0.05, rear_radius=0.05, gauge=gauge),
    )
    flight = Stairs.inclined(angle=theta, nosing_spacing=p)
    question = Question.in_one_posture(robot, flight, friction=1.0, acceleration=a)
    downhill, uphill, sideways = margins_of(question, flight, np.array([psi]))[:, 0, 0]
    events = [(k * p / 60) for k in range(60)]
    for y in (-gauge / 2, gauge / 2):
        for tip, past in ((-(L - C_L), -1e-9), (C_L, 1e-9)):
            events.append((tip + past) * math.cos(psi) - math.sin(psi) * y)
    polygons = [corners(L, C_L, gauge, p, psi, at) for at in events]

    def holds(slope):
        load = C_N * math.tan(slope)
        ahead = -load * math.cos(psi) - C_N * a / (G * math.cos(slope))
        z = np.array([ahead, load * math.sin(psi)])
        return min(inside(each, z) for each in polygons) > 0

    limit = theta + min(downhill, sideways)
    assert 0.1 < limit < 1.4
    assert holds(limit - 1e-3)
    assert not holds(limit + 1e-3)
    limit = theta - uphill
    assert holds(limit + 1e-3)
    assert not holds(limit - 1e-3)


def test_energy_of_a_narrow_robot_is_that_of_a_turn_about_its_lower_track():
    robot = Robot(
        name="r",
        com_from_front=0.3,
        com_height=0.1,
        track=Track(flat_length=0.7, front_radius=0.05, rear_radius=0.05, gauge=0.12),
    )
    theta, psi = 0.6, 0.4
    flight = Stairs.inclined(angle=theta, nosing_spacing=0.2)
    question = Question.in_one_posture(robot, flight, friction=1.0)
    # by hand, across the heading: up leans to one side by sin(theta) sin(psi)
    across, up = math.sin(theta) * math.sin(psi), math.cos(theta)
    for sign in (1, -1):
        rises = math.hypot(0.06, 0.1) * math.hypot(across, up) - 0.1 * up - 0.06 * across
        found = energy_of(question, flight, np.array([sign * psi]))
        assert float(found[0]) == pytest.approx(rises, abs=1e-12)


def test_energy_is_that_of_a_turn_about_the_edge():
    """Height of the centroid turned about the edge in small steps, against the formula."""
    robot = Robot(
        name="r",
        com_from_front=0.3,
        com_height=0.1,
        track=Track(flat_length=0.7, front_radius=0.05, rear_radius=0.05, gauge=0.4),
    )
    theta, psi, p = 0.6, 0.4, 0.2
    flight = Stairs.inclined(angle=theta, nosing_spacing=p)
    question = Question.in_one_posture(robot, flight, friction=1.0)
    up = np.array(
        [math.sin(theta) * math.cos(psi), -math.sin(theta) * math.sin(psi), math.cos(theta)]
    )
    rises = []
    q, lag = p / math.cos(psi), 0.4 * math.tan(psi)
    for right, left in ((q, q - (-lag) % q), (q - lag % q, q)):
        a, b = np.array([right - 0.4, -0.2, -0.1]), np.array([left - 0.4, 0.2, -0.1])
        t = (b - a) / np.linalg.norm(b - a)
        turn = np.linspace(-1.5, 1.5, 30_001)[:, None]
        v = -a * np.cos(turn) + np.cross(t, -a) * np.sin(turn) + t * (t @ -a) * (1 - np.cos(turn))
        rises.append(float(((a + v) @ up).max()))
    # m: the turn is found to 1e-4 rad, the height to its square
    found = energy_of(question, flight, np.array([psi]))
    assert float(found[0]) == pytest.approx(min(rises), abs=1e-8)
