"""Sub-tracks on the terrain scanned ahead: touching angle, scan, loop."""

import math
from dataclasses import replace

import numpy as np
import pytest

from kaidan.contact import Status
from kaidan.errors import InputError
from kaidan.literature import stepping
from kaidan.literature.stepping import Angles, Course
from kaidan.literature.subtracks import (
    Scan,
    desired_angles,
    follow_terrain,
    scanned,
    touching_angle,
)
from kaidan.outline import Outline
from kaidan.robot import FlipperPair, Posture, Robot
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import traverse

ABSOLEM = Robot.named("absolem")
PAIR = ABSOLEM.front_flippers
FLIGHT = Profile.of_stairs(Stairs(rise=0.178, going=0.279, steps=3))
FLAT = Posture(front="flat", rear="flat")


def gap_of(angle, point, pair):
    """Distance of a point from a flipper, brute force: a cone of 20,000 discs."""
    part = np.linspace(0, 1, 20_000)
    reach = part * pair.length
    radius = pair.root_radius + part * (pair.tip_radius - pair.root_radius)
    away = np.hypot(point[0] - reach * np.cos(angle), point[1] - reach * np.sin(angle))
    return float((away - radius).min())


def test_touching_angle_against_brute_force():
    """Oracle: just there the flipper touches, a little higher it does not, lower it overlaps."""
    rng = np.random.default_rng(5)
    tried = 0
    while tried < 60:
        point = rng.uniform((0.05, -0.3), (0.37, 0.3))
        angle = touching_angle([point], PAIR)
        if math.isnan(angle):
            continue
        tried += 1
        # 20,000 discs sit 17 um apart: their envelope is 0.4 nm short of the straight side
        assert gap_of(angle, point, PAIR) == pytest.approx(0.0, abs=1e-7)
        assert gap_of(angle + 0.01, point, PAIR) > 1e-5
        assert gap_of(angle - 0.01, point, PAIR) < -1e-5
    assert tried == 60


def test_level_ground_is_touched_lying_flat():
    """By hand: on the plane of the track the flipper lies flat, whatever point of it is seen."""
    ground = np.column_stack([np.linspace(0.1, 0.5, 400), np.full(400, -PAIR.pivot_height)])
    # between the points the tip sinks by at most (1 mm/2)^2/(2 x 29 mm) = 4 um, 13 urad
    assert touching_angle(ground, PAIR) == pytest.approx(PAIR.flat_angle, abs=2e-5)


def test_the_tip_touches_by_the_law_of_cosines():
    """By hand: a tip of 0.1 m at 1 m is about 2 asin(0.05) above a point just as far."""
    pair = FlipperPair(length=1.0, root_radius=0.1, tip_radius=0.1, pivot_height=0.1)
    point = (math.cos(0.3) * 1.01, math.sin(0.3) * 1.01)  # beyond hypot(1, 0.1), where the tip is
    by_hand = 0.3 + math.acos((1.01**2 + 1 - 0.1**2) / (2 * 1.01))
    assert touching_angle([point], pair) == pytest.approx(by_hand, abs=1e-12)
    assert by_hand == pytest.approx(0.3 + 2 * math.asin(0.05), abs=2e-3)


def test_the_highest_obstacle_counts_and_far_ones_do_not():
    both = [(0.2, -0.05), (0.2, 0.1)]
    assert touching_angle(both, PAIR) == touching_angle(both[1:], PAIR)
    assert math.isnan(touching_angle([(0.4, 0.0)], PAIR))
    assert math.isnan(touching_angle(np.zeros((0, 2)), PAIR))


@pytest.mark.parametrize("points", [[(0, 0, 0)], [(0, math.nan)], [1, 2]])
def test_points_without_meaning(points):
    with pytest.raises(InputError, match=r"write \(n, 2\) finite numbers"):
        touching_angle(points, PAIR)


def test_the_scan_is_the_terrain():
    """By hand: without noise every point lies on the profile, and its corners are seen."""
    seen = scanned(FLIGHT, 0.3, Scan(), np.random.default_rng(0))
    assert (np.diff(seen[:, 0]) >= 0).all()
    assert {tuple(each) for each in seen} >= {(0.0, 0.0), (0.0, 0.178), (0.279, 0.356)}
    assert seen[[0, -1], 0] == pytest.approx([-0.7, 1.3], abs=1e-12)
    assert set(np.round(np.unique(seen[:, 1]), 9)) == {0.0, 0.178, 0.356, 0.534}


def test_noise_has_its_size_and_its_seed():
    quiet = scanned(FLIGHT, 0.3, Scan(spacing=0.001), np.random.default_rng(3))
    loud = [
        scanned(FLIGHT, 0.3, Scan(spacing=0.001, noise=0.004), np.random.default_rng(3))
        for _ in range(2)
    ]
    assert (loud[0] == loud[1]).all()
    # 2,000 points: the standard deviation is good to 1/sqrt(4000) = 1.6 %, four times that
    assert (loud[0] - quiet)[:, 1].std() == pytest.approx(0.004, rel=0.064)
    assert (loud[0][:, 0] == quiet[:, 0]).all()


@pytest.mark.parametrize("posture", [Posture(), FLAT, Posture(front=0.5, rear=0.0)])
def test_flippers_without_speed_keep_the_posture(posture):
    """Agreement: then the way is the traverse's, pose by pose."""
    found = follow_terrain(ABSOLEM, FLIGHT, posture=posture, flipper_speed=0.0)
    run = traverse(FLIGHT, Outline.of(ABSOLEM, posture), step=0.01).path
    assert found.status is run.status
    rows = [
        np.abs(run.poses.placements - pose).sum(axis=1).argmin()
        for pose in np.column_stack([found.x, found.z, found.inclination])
    ]
    assert (np.diff(rows) > 0).all()
    for mine, theirs in (
        (found.x, run.x), (found.z, run.z), (found.inclination, run.inclination),
    ):  # fmt: skip
        # the ends of both cut their last step, in different places
        assert mine[:-1] == pytest.approx(theirs[rows][:-1], abs=1e-9)
    assert found.largest_rotation == pytest.approx(float(run.rotations.angle.max()), abs=1e-9)
    assert len(set(found.front)) == len(set(found.rear)) == 1


def test_it_goes_through_where_the_stowed_posture_falls():
    """Against the fixed postures: stowed it falls, flat it rotations by 32.5 deg at the landing.

    32.54 deg is the slope of 178/279, by hand: laid flat the whole robot turns by it at the top.
    """
    fixed = [
        follow_terrain(ABSOLEM, FLIGHT, posture=posture, flipper_speed=0.0)
        for posture in (Posture(), FLAT)
    ]
    assert fixed[0].status is Status.FELL_BACKWARD
    assert fixed[1].arrived
    assert fixed[1].largest_rotation == pytest.approx(math.atan(178 / 279), abs=1e-6)
    found = follow_terrain(ABSOLEM, FLIGHT, speed=0.1)
    assert found.arrived
    assert found.largest_rotation < 0.25 * fixed[1].largest_rotation
    assert not found.main_track_stands.all()


def test_it_goes_through_on_a_noisy_scan():
    one, two = (
        follow_terrain(ABSOLEM, FLIGHT, speed=0.1, scan=Scan(noise=0.003, seed=4)) for _ in range(2)
    )
    assert one.arrived
    assert (one.x == two.x).all()  # the seed makes it the same again
    assert (one.front == two.front).all()


def test_speed_and_joint_range_are_kept():
    limits = (math.radians(-30), math.radians(100))
    found = follow_terrain(ABSOLEM, FLIGHT, speed=0.1, limits=limits)
    most = 0.7854 * 0.02 / 0.1  # rad, its sheet's speed over one step
    for angles in (found.front, found.rear):
        assert np.abs(np.diff(angles)).max() <= most + 1e-12
        assert angles.min() >= limits[0] - 1e-12
        assert angles.max() <= limits[1] + 1e-12


def test_on_level_ground_the_flippers_come_to_lie_flat():
    """Limit: there is nothing else to touch."""
    found = follow_terrain(ABSOLEM, Profile.of_points([(0, 0), (1, 0)]), speed=0.1)
    assert found.arrived
    for angles, pair in ((found.front, PAIR), (found.rear, ABSOLEM.rear_flippers)):
        # points 1 cm apart: the tip sinks by (5 mm)^2/(2 x 29 mm) = 0.43 mm, 1.3 mrad
        assert angles[-1] == pytest.approx(pair.flat_angle, abs=1.4e-3)
    # so the body may be lifted by the tips, never by more than that
    assert np.abs(found.inclination).max() < 2e-3
    assert found.largest_rotation < 1e-12  # rounding


def test_on_a_ramp_the_flippers_lie_flat_too():
    """By hand: what counts is the ground seen from the body, whatever its inclination."""
    slope = math.radians(20)
    ramp = Profile.of_points([(-3, -3 * math.tan(slope)), (3, 3 * math.tan(slope))])
    course = Course.of(ABSOLEM, ramp, FLAT)
    stand = stepping.ahead(course, stepping.begin(course), 1.5)
    assert stand.inclination == pytest.approx(slope, abs=1e-9)
    seen = scanned(ramp, stand.x, Scan(spacing=0.001), np.random.default_rng(0))
    requested, stands = desired_angles(course, stand, seen, 0.02, 1e-4)
    assert stands
    # points 1 mm apart: a disc of 29 mm sinks by (0.5 mm)^2/(2 x 29 mm) = 4 um, 13 urad
    assert requested == pytest.approx((PAIR.flat_angle, PAIR.flat_angle), abs=1e-4)


def test_a_rotation_leaves_no_margin():
    course = Course.of(ABSOLEM, FLIGHT, FLAT)
    stand = stepping.begin(course)
    assert stand.least_margin() > 0.05
    assert replace(stand, rotation=0.2).least_margin() == 0.0
    assert replace(stand, status=Status.FELL_BACKWARD).least_margin() == -math.inf


@pytest.mark.parametrize(
    "how",
    [
        {"speed": 0.0},
        {"step": math.nan},
        {"flipper_speed": -1.0},
        {"limits": (0.5, 0.5)},
        {"scan": Scan(horizon=0.0)},
        {"scan": Scan(spacing=-0.01)},
        {"scan": Scan(noise=-0.01)},
    ],
)
def test_a_loop_without_meaning(how):
    with pytest.raises(InputError):
        follow_terrain(ABSOLEM, FLIGHT, **how)


def test_a_robot_without_flippers():
    with pytest.raises(InputError, match="no flippers that could follow"):
        follow_terrain(Robot.named("kenaf"), FLIGHT)


def test_turning_the_flippers_leaves_the_robot_where_it_is():
    """By hand: a flipper of 1.5 kg moves a centroid of 38.7 kg by 3.1 mm m at most, not the tip."""
    course = Course.of(ABSOLEM, FLIGHT, FLAT)
    stand = stepping.begin(course)
    up = stepping.turned(course, stand, Angles(math.pi / 2, math.pi / 2))
    back = stepping.turned(course, up, stand.angles)
    assert up.x - stand.x == pytest.approx(0.0, abs=1e-12)  # front and rear move alike
    assert (back.x, back.z) == pytest.approx((stand.x, stand.z), abs=1e-12)
    front_only = stepping.turned(course, stand, Angles(math.pi / 2, stand.angles.rear))
    flat = math.cos(PAIR.flat_angle)
    assert stand.x - front_only.x == pytest.approx(1.5 * 0.08 * flat / 38.7, abs=1e-12)


def test_flippers_are_held_while_an_end_climbs_a_face():
    wall = Profile.of_points([(-2, 0), (0, 0), (0, 0.2), (2, 0.2)])
    course = Course.of(ABSOLEM, wall, FLAT)
    stand = stepping.begin(course)
    for _ in range(40):
        stand = stepping.ahead(course, stand, 0.01)
        if stand.on_a_face:
            break
    assert stand.on_a_face
    assert stepping.turned(course, stand, Angles(0.5, 0.5)) is stand


def test_a_way_that_turns_flippers_does_not_end_early():
    """Windows of the traverse are lengthened as the robot goes: one long step, many short ones."""
    course = Course.of(ABSOLEM, FLIGHT, FLAT)
    far = stepping.ahead(course, stepping.begin(course), 0.8)
    near = stepping.begin(course)
    for _ in range(40):
        near = stepping.ahead(course, near, 0.02)
    assert near.run.s[near.row] == pytest.approx(0.8, abs=0.03 + 40 * 0.01)  # each a pose late
    assert far.run.s[far.row] == pytest.approx(0.8, abs=0.011)


@pytest.mark.parametrize("posture", [Posture(front=0.1), Posture(rear="flat")])
def test_a_posture_for_flippers_that_are_not_there(posture):
    with pytest.raises(InputError, match="has no"):
        Course.of(Robot.named("kenaf"), FLIGHT, posture)
