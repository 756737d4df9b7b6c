"""How far back a robot may stand after its flippers moved: which contact slid, by hand."""

import cmath
import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import Robot
from kaidan.contact import Feature, FeatureKind, Placement, Poses, belt_slides, body_table, layout
from kaidan.modes import Phase
from kaidan.robot import Posture
from kaidan.traversal.drift import drift
from kaidan.traversal.moves import BEHIND, move
from kernel_memory import nothing

ABSOLEM = Robot.named("absolem")
FLOOR = [[-5.0, 0.0], [5.0, 0.0]]
TURN = math.radians(40.0)
R, L, SMALL = 0.1, 0.4, 1e-3


def path_of(poses, outlines):
    """Path of poses that are given by name."""
    table = nothing(layout.Pose, len(poses.x))
    for name in ("x", "z", "inclination"):
        table[name] = getattr(poses, name)
    for end in ("rear", "front"):
        touch = table[end]
        touch["feature"] = getattr(poses, end)
        touch["x"], touch["z"] = getattr(poses, f"{end}_point").T
        touch["n_x"], touch["n_z"] = getattr(poses, f"{end}_normal").T
    bodies = np.stack([body_table(each.parts) for each in outlines])
    return SimpleNamespace(poses=Poses(table), bodies=bodies)


def slides(poses, outlines):
    """At the rear and at the front contact."""
    return belt_slides(path_of(poses, outlines)).T


def moved(one, two):
    return move(ABSOLEM, one, two, before=Phase.LAND, start=Placement(0.0, 0.0, 0.0), ground=FLOOR)


def two_poses(places, normal=(0.0, 1.0), point=(2.0, 0.0)):
    """Of which both contacts are one, of the first part."""
    x, z, inclination = np.array(places).T
    each = {}
    for end in ("rear", "front"):
        each |= {end: np.zeros(2, dtype=np.int64), f"{end}_point": np.array([point] * 2)}
        each[f"{end}_normal"] = np.array([normal] * 2)
    return SimpleNamespace(x=x, z=z, inclination=inclination, **each)


def slid(ahead, up, turn, normal=(0.0, 1.0), second=True):
    """Of a part whose first disc stands on the floor, moved and turned about that disc's axle."""
    before = SimpleNamespace(parts=np.array([[0.0, 0.0, R, L * second, 0.0, R]]))
    poses = two_poses([(2.0, R, 0.0), (2.0 + ahead, R + up, turn)], normal)
    rear, front = slides(poses, [before, before])
    assert rear == front
    return float(rear[0])


@pytest.mark.parametrize("second", [True, False])
def test_what_is_pushed_slides_and_what_rolls_does_not(second):
    # hand: a wheel that turns nose up rolls back
    assert slid(0.03, 0.0, 0.0, second=second) == pytest.approx(0.03)
    assert slid(-0.03, 0.01, 0.0, second=second) == pytest.approx(-0.03)
    assert slid(0.0, 0.0, SMALL, second=second) == pytest.approx(R * SMALL, abs=1e-9)
    assert slid(-R * SMALL, 0.0, SMALL, second=second) == pytest.approx(0.0, abs=1e-9)


def test_on_a_slope_what_is_pushed_slides_along_it():
    """All of it turned by 30 degrees, the axle of the disc 0.2 m before the robot's centroid."""
    lean = math.radians(30.0)
    u, axle, arm = cmath.exp(1j * lean), 2 + 1j, 0.2 - 0.05j
    before = SimpleNamespace(parts=np.array([[0.2, -0.05, R, 0.6, -0.05, R]]))
    contact, normal = axle - 1j * R * u, (-math.sin(lean), math.cos(lean))

    def placed(ahead, turn):
        place = axle + ahead * u - arm * u * cmath.exp(1j * turn)
        return place.real, place.imag, lean + turn

    for ahead, turn in ((0.03, 0.0), (0.0, SMALL), (-R * SMALL, SMALL)):
        poses = two_poses(
            [placed(0.0, 0.0), placed(ahead, turn)], normal, (contact.real, contact.imag)
        )
        found = slides(poses, [before, before])[:, 0]
        assert found == pytest.approx(ahead + R * turn, abs=1e-9)


def test_the_belts_of_a_flipper_and_of_a_wheel_from_pose_to_pose():
    """Both move with the robot, the flipper turns about its own axle besides; the last face is
    too steep to hold."""
    place = np.array([1 + 1j, 1.02 + 1.01j, 1.05 + 1.03j, 1.1 + 1.1j])
    lean = np.array([0.3, 0.35, 0.5, 0.7])
    angle, axles = np.array([0.2, 0.5, 0.4, 0.1]), (0.2 - 0.05j, -0.3 - 0.1j)
    outlines = [
        SimpleNamespace(parts=np.array([
            [axles[0].real, axles[0].imag, R, (axles[0] + L * cmath.exp(1j * each)).real,
             (axles[0] + L * cmath.exp(1j * each)).imag, R],
            [axles[1].real, axles[1].imag, R, axles[1].real, axles[1].imag, R],
        ]))
        for each in angle
    ]  # fmt: skip
    points, normals = (
        np.array([1.5 + 0.8j, 1.45 + 0.7j, 1.4 + 0.6j, 9j]),
        np.exp(1j * np.array([1.4, 1.9, 2.6, 0])),
    )
    flat = {
        name: np.stack([values.real, values.imag], axis=1)
        for end in ("rear", "front")
        for name, values in ((f"{end}_point", points), (f"{end}_normal", normals))
    }
    parts = {"rear": np.array([0, 1, 0, 0]), "front": np.array([1, 0, 1, 1])}
    codes = {end: 4 * each for end, each in parts.items()}
    poses = SimpleNamespace(x=place.real, z=place.imag, inclination=lean, **codes, **flat)
    for found, part in zip(slides(poses, outlines), parts.values(), strict=True):
        for i in range(2):
            axle_at = place + axles[part[i]] * np.exp(1j * lean)
            turned = (lean + angle, lean)[part[i]]
            turn = cmath.exp(1j * (turned[i + 1] - turned[i]))
            moved = axle_at[i + 1] + (points[i] - axle_at[i]) * turn - points[i]
            ahead = -1j * normals[i]
            assert found[i] == pytest.approx((moved * ahead.conjugate()).real, abs=1e-12)
        assert found[2] == 0.0


def test_what_leans_by_more_than_45_degrees_holds_no_robot():
    lean = math.radians(44.0)
    assert slid(0.03, 0.0, 0.0, (-math.sin(lean), math.cos(lean))) == pytest.approx(
        0.03 * math.cos(lean)
    )
    lean = math.radians(46.0)
    assert slid(0.03, 0.0, 0.0, (-math.sin(lean), math.cos(lean))) == 0.0


def test_a_part_that_turns_within_the_robot_takes_its_contact_along():
    """A flipper of which the axle stays: its tip, L below it, runs by L for each radian."""
    parts = [np.array([[0.0, 0.0, R, -L * math.sin(a), -L * math.cos(a), R]]) for a in (0, SMALL)]
    one, two = (SimpleNamespace(parts=each) for each in parts)
    poses = two_poses([(2.0, L, 0.0)] * 2)
    assert slides(poses, [one, two])[0] == pytest.approx(-L * SMALL, abs=1e-9)
    assert slides(poses, [two, one])[0] == pytest.approx(L * SMALL, abs=1e-6)


def test_the_contact_that_slid_ahead_by_more_may_have_stayed():
    found = moved(Posture(front=-0.3 - TURN, rear=0.5), Posture(front=-0.3, rear=0.5))
    each = belt_slides(found.path).sum(axis=0)
    assert each[1] > 0.05 > each[0]  # the tip slides ahead as the flipper turns up
    assert found.drift == drift(found.path) == pytest.approx(each[1])
    drawn = found.path.poses.placement(-1)
    assert found.end == drawn._replace(x=drawn.x - found.drift - BEHIND)


def test_now_the_one_contact_and_now_the_other_may_stay():
    """Two discs on the floor are moved within the robot: the one ahead, then back, the other so."""
    ways = np.array([(0.0, 0.0), (0.03, -0.02), (0.01, 0.02)])
    at = np.array([0.0, 1.0])
    bodies = []
    poses = two_poses([(2.0, R, 0.0)] * 3)
    poses.rear = np.zeros(3, dtype=np.int64)
    poses.front = np.full(3, Feature(0, 1, FeatureKind.VERTEX).code)
    for x in ways + at:
        bodies.append(SimpleNamespace(parts=np.array([[each, 0, R, each, 0, R] for each in x])))
    for k, end in enumerate(("rear", "front")):
        setattr(poses, f"{end}_point", np.stack([2.0 + at[k] + ways[:, k], np.zeros(3)], axis=1))
        setattr(poses, f"{end}_normal", np.array([[0.0, 1.0]] * 3))
    expected = np.array([[0.03, -0.02], [-0.02, 0.04]])
    assert slides(poses, bodies) == pytest.approx(expected, abs=1e-9)
    # hand: the rear one stays first, then the front one
    assert drift(path_of(poses, bodies)) == pytest.approx(0.03 + 0.04)


def test_flippers_that_touch_nothing_leave_the_robot_where_it_is():
    # limit
    found = moved(Posture(front=0.2, rear=0.2), Posture(front=0.9, rear=0.9))
    assert found.drift == pytest.approx(0.0, abs=1e-9)
