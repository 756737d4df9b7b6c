"""Rotations of a traverse: angles, drops and speeds by hand; which the path obliges to."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import contact
from kaidan.contact import Feature, Placement
from kaidan.outline import Outline
from kaidan.robot import Posture, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Chain, Phase, Rotation, rotations, traverse
from kaidan.traversal.rotations import (
    AT_ONCE,
    ROCKING,
    _beyond_the_edge,
    rotations_of,
    slopes_of_flights,
    together,
)

G = 9.80665
KENAF = Outline.of(Robot.named("kenaf"))
C_L, C_N, L = 0.196, 0.071, 0.470
ROUNDING = 1e-9  # m, rad: contacts are solved to 1e-12 m


def robot(flat_length, com_from_front, com_height, radius=0.02):
    track = Track(flat_length=flat_length, front_radius=radius, rear_radius=radius)
    sheet = Robot(name="r", com_from_front=com_from_front, com_height=com_height, track=track)
    return Outline.of(sheet)


def driven(profile, outline, **how):
    if isinstance(profile, Stairs):
        profile = Profile.of_stairs(profile)
    elif not isinstance(profile, Profile):
        profile = Profile.of_points(profile)
    return traverse(profile, outline, step=0.02, **how)


def inclined(angle_deg, spacing, steps=8):
    return Stairs.inclined(angle=math.radians(angle_deg), nosing_spacing=spacing, steps=steps)


def test_onto_the_upper_landing_by_hand():
    """Theory, transitions: C_N (1/cos - 1) is what the centroid falls over the last nosing.

    The pivot lies C_N tan behind the centroid and the nose's tip C_L ahead of it; the distance of
    the centroid from the pivot, C_N/cos, does not change.
    """
    theta = math.radians(50)
    found = driven(inclined(50, 0.150), KENAF)
    assert [each.phase for each in found.rotations] == [Phase.LAND]
    (rotation,) = found.rotations
    drop = C_N * (1 / math.cos(theta) - 1)
    rate = math.sqrt(2 * G * drop / (KENAF.gyration**2 + (C_N / math.cos(theta)) ** 2))
    assert rotation.start == pytest.approx(theta, abs=ROUNDING)
    assert rotation.reached == pytest.approx(0.0, abs=ROUNDING)
    assert rotation.angle == pytest.approx(theta, abs=ROUNDING)
    assert rotation.leading_end_down
    assert rotation.drop == pytest.approx(drop, abs=ROUNDING)
    assert rotation.impact_speed == pytest.approx(rate * (C_L + C_N * math.tan(theta)), abs=1e-7)
    assert rotation.step == 8
    assert rotation.arrested
    assert rotation.obliged
    assert rotation.avoidable == 0.0
    assert Feature.of(rotation.pivot).point == Feature.of(rotation.arrested_by).point
    assert found.phases[-1].largest_rotation == pytest.approx(theta, abs=ROUNDING)


def test_over_the_top_edge_by_hand():
    """Theory, transitions: C_N (1 - cos) going down, with C_L >= p so that a nosing arrests it."""
    theta, p = math.radians(30), 0.150
    found = driven(inclined(30, p), KENAF, descending=True)
    rotation = found.rotations[0]
    drop = C_N * (1 - math.cos(theta))
    rate = math.sqrt(2 * G * drop / (KENAF.gyration**2 + C_N**2))
    assert rotation.phase is Phase.ENTER
    assert (rotation.start, rotation.reached) == pytest.approx((0.0, -theta), abs=ROUNDING)
    assert rotation.drop == pytest.approx(drop, abs=ROUNDING)
    assert rotation.impact_speed == pytest.approx(rate * p, abs=1e-7)  # the next nosing
    assert rotation.obliged
    # theory, contact: r_A = (0, C_N) and r_B = (-p, C_N) from the contacts to the centroid
    k2, ab = KENAF.gyration**2, C_N**2
    left = (k2 + ab) ** 2 / ((k2 + C_N**2) * (k2 + C_N**2 + p**2))
    assert rotation.left == pytest.approx(drop * left, abs=ROUNDING)
    assert rotation.moved == pytest.approx(C_N * math.sin(theta), abs=ROUNDING)
    record = found.path.rotations[0]
    assert (rotation.rise, rotation.ahead) == (record.barrier / G, record.barrier_across)


def test_a_nosing_a_hair_below_the_flat_counts_as_far_as_a_turn_brings_it_there():
    """Over the top edge onto three nosings 60 mm apart, the last of them lower by some depth.

    What a turn of 2 mrad would bring to touch counts as touching, what takes 4 mrad not at all.
    """
    theta, p = math.radians(30), 0.060
    flight = inclined(30, p)
    rate = math.sqrt(2 * G * C_N * (1 - math.cos(theta)) / (KENAF.gyration**2 + C_N**2))

    def speed(depth):
        rises = [flight.rise] * 8
        rises[4], rises[5] = rises[4] - depth, rises[5] + depth  # the third below the top
        goings = (flight.going,) * 7
        lower = Stairs(rises=tuple(rises), goings=goings)
        return driven(lower, KENAF, descending=True).rotations[0].impact_speed

    def by_hand(depth):
        turn = depth * math.cos(theta) / (3 * p)
        return rate * p * (2 + min(max(2 - turn / 2e-3, 0.0), 1.0))

    for depth in (0.0, 1e-6, 2e-4, 5e-4, 7e-4, 1e-3):
        assert speed(depth) == pytest.approx(by_hand(depth), rel=5e-3)  # of the depth
    assert by_hand(0.0) - by_hand(1e-3) > 0.13  # a micrometre changed it by that
    assert abs(speed(1e-6) - speed(0.0)) < 1e-5


def test_an_end_that_all_but_touches_hits_too():
    """Absolem over the top edge: its flippers' line rests on the second nosing, 3 mm under its
    track, and the end of the track lies 23 um above the third: twice as far, twice as fast.
    """
    stairs = Stairs(rise=0.17, going=0.25, steps=12)
    flat = Outline.of(Robot.named("absolem"), Posture(front="flat", rear="flat"))
    run = driven(stairs, flat, descending=True)
    found, rate = run.rotations[0], run.path.rotations[0].rate_before
    assert found.impact_speed == pytest.approx(rate * 2 * math.hypot(0.17, 0.25), rel=1e-3)


GAP = [(-2, 0), (0, 0), (0, -0.33), (0.72, -0.33), (0.72, 0), (2.72, 0)]
WIDE = [(-2, 0), (0, 0), (0, -0.33), (1.5, -0.33), (1.5, 0), (3.5, 0)]
KERB = [(-2, 0), (0, 0), (0, -0.1), (2, -0.1)]


def test_what_a_longer_robot_would_bridge_is_not_obliged():
    """A gap shorter than the flat: with its centroid elsewhere the robot stands on both edges."""
    one = robot(0.98, 0.40, 0.065)
    into, out = driven(GAP, one).rotations
    assert math.degrees(into.angle) > 50
    assert into.avoidable == pytest.approx(into.angle, abs=ROUNDING)  # the far edge is level
    assert not into.obliged
    assert math.degrees(out.angle) > 35
    assert out.obliged  # onto the level behind
    assert driven(WIDE, one).rotations[0].obliged
    short = [(x if x <= 0 else x - 0.27, z) for x, z in GAP]  # 0.45 m
    assert not driven(short, one).rotations[0].obliged
    assert driven(short, robot(0.98, 0.49, 0.065)).rotations == ()


def test_off_a_kerb_is_obliged():
    (rotation,) = driven(KERB, KENAF).rotations
    assert rotation.obliged
    assert rotation.drop > 0.005
    assert rotation.impact_speed > 0.3


def test_a_nose_that_drops_past_the_next_nosing_is_not_obliged():
    """Theory, margin: below atan((p - C_L)/C_N) the nose drops between the nosings."""
    found = driven(Stairs(rise=0.178, going=0.279, steps=6), KENAF, descending=True)
    first = found.rotations[0]
    slope = math.atan2(0.178, 0.279)
    assert not first.obliged
    assert first.avoidable == pytest.approx(-slope - first.reached, abs=ROUNDING)
    assert all(each.obliged == (each.step == 1) for each in found.rotations)  # no nosing below it


def test_rocking_of_micrometres_is_nothing():
    """Every other tread 1 um higher: what it rocks is no rotation that counts."""
    points = Profile.of_stairs(inclined(35, 0.150, 10)).points.copy()
    for tread in range(1, 9, 2):
        points[[2 + 2 * tread, 3 + 2 * tread], 1] += 1e-6
    found = driven(points, KENAF)
    small = [each for each in found.rotations if each.phase is not Phase.LAND]
    assert len(small) > 0
    assert all(each.angle < 1e-4 for each in small)  # rad
    assert all(each.obliged for each in found.rotations)


LONG_STEPS = Stairs(rise=0.136, going=0.105, steps=5)


def test_a_chain_is_told_as_a_whole():
    """It drops by 52 deg, drives less than 1 % of its length and goes on to 79: one motion."""
    one = robot(0.368, 0.197, 0.130, radius=0.138)
    found = driven(LONG_STEPS, one, descending=True)
    assert found.arrived
    chain = found.chains[0]
    first, second = chain.rotations
    assert (first, second) == found.rotations[:2]
    records = list(found.path.rotations)
    between = math.dist(records[0].end[:2], records[1].start[:2])
    assert 0 < between < AT_ONCE * 0.368
    assert chain.reached == second.reached < first.reached < chain.start
    assert math.degrees(chain.reached) < -79
    assert chain.angle == pytest.approx(first.angle + second.angle, abs=ROUNDING)
    assert chain.drop == pytest.approx(first.drop + second.drop, abs=ROUNDING)
    rises = first.rise - first.drop, second.rise - first.drop - second.drop
    assert chain.spare((0.0, 0.0)) == pytest.approx(min(rises), abs=ROUNDING)
    assert chain.arrested_by == second.arrested_by
    largest = max(each.angle for each in found.chains if each.phase is Phase.ENTER)
    assert found.phases[0].largest_rotation == pytest.approx(largest, abs=ROUNDING)


def rotation(**given):
    figures = {
        "phase": Phase.ENTER,
        "step": 2,
        "path": 1.0,
        "start": -0.2,
        "reached": -1.0,
        "angle": 0.8,
        "leading_end_down": True,
        "drop": 0.02,
        "moved": 0.05,
        "impact_speed": 0.7,
        "avoidable": 0.01,
        "theta_s": math.nan,
        "pivot": 64,
        "arrested_by": 130,
        "rise": 0.12,
        "ahead": 0.06,
        "left": 0.01,
    }
    return Rotation(**(figures | given))


def test_figures_of_a_chain():
    """By hand, of three rotations; the second one comes back."""
    one = rotation()
    two = rotation(
        phase=Phase.TRAVERSE, step=3, path=1.001, start=-1.0, reached=-0.4, angle=0.6, drop=0.03,
        impact_speed=0.9, avoidable=0.02, rise=0.23, left=0.02, arrested_by=194,
        leading_end_down=False,
    )  # fmt: skip
    three = rotation(start=-0.4, reached=-0.9, angle=0.5, drop=0.01, rise=0.16, avoidable=0.03)
    chain = Chain((one, two, three))
    assert (chain.phase, chain.step, chain.path, chain.start) == (Phase.ENTER, 2, 1.0, -0.2)
    assert chain.reached == -1.0
    back = Chain((rotation(start=0.3, reached=-0.2), rotation(start=-0.2, reached=0.7)))
    assert back.reached == -0.2  # by 0.5, the other by 0.4
    assert chain.angle == pytest.approx(1.9)
    assert chain.drop == pytest.approx(0.06)
    assert chain.impact_speed == 0.9
    assert chain.avoidable == pytest.approx(0.06)
    assert chain.spare((0.0, 0.0)) == pytest.approx(min(0.12 - 0.02, 0.23 - 0.05, 0.16 - 0.06))
    assert chain.spare_after_impact((0.0, 0.0)) == pytest.approx(0.12 - 0.01)
    rear, front = 0.6, 0.1  # tilts of gravity; the second comes back, over the trailing end
    assert chain.spare((rear, front)) == pytest.approx(
        min(
            math.cos(front) * 0.10 - math.sin(front) * (0.05 + 0.06),
            math.cos(rear) * 0.18 - math.sin(rear) * (-0.05 + 0.05 + 0.06),
            math.cos(front) * 0.10 - math.sin(front) * (0.05 - 0.05 + 0.05 + 0.06),
        )
    )
    assert Chain((one,)).spare_after_impact((rear, front)) == pytest.approx(
        math.cos(front) * 0.12 - math.sin(front) * 0.06
        - 0.01 / 0.02 * (math.cos(front) * 0.02 + math.sin(front) * 0.05)
    )  # fmt: skip
    assert Chain((two,)).spare_after_impact((rear, front)) == pytest.approx(
        math.cos(rear) * 0.23 - math.sin(rear) * 0.06
        - 0.02 / 0.03 * (math.cos(rear) * 0.03 + math.sin(rear) * 0.05)
    )  # fmt: skip
    assert chain.arrested
    assert chain.arrested_by == 130
    fallen = Chain((one, rotation(arrested_by=None, impact_speed=math.nan)))
    assert not fallen.arrested
    assert not fallen.obliged
    assert fallen.impact_speed == 0.7
    assert math.isnan(Chain((rotation(arrested_by=None, impact_speed=math.nan),)).impact_speed)


@pytest.mark.parametrize(
    ("avoidable", "obliged"), [(0.0, True), (ROCKING, True), (math.nextafter(ROCKING, 1), False)]
)
def test_what_is_obliged_may_rock_besides(avoidable, obliged):
    assert rotation(avoidable=avoidable).obliged is obliged
    assert Chain((rotation(avoidable=avoidable),)).obliged is obliged
    rocks = rotation(angle=avoidable, avoidable=avoidable)
    assert not rocks.obliged  # all of it could be avoided
    assert not Chain((rocks,)).obliged
    assert not rotation(avoidable=avoidable, arrested_by=None).obliged


def test_of_a_turn_on_a_flight_no_more_rocks_than_is_off_its_slope():
    """By hand: from 0.03 beyond the slope of 0.5 rad to 0.04 short of it."""
    turn = {"start": 0.53, "reached": 0.46, "angle": 0.07, "avoidable": 0.07}
    assert rotation(**turn).rocking == pytest.approx(0.07)  # on no flight
    on = rotation(**turn, theta_s=0.5)
    assert on.rocking == pytest.approx(0.04)
    assert not on.obliged  # all of it could be avoided
    assert rotation(**turn | {"avoidable": 0.01}, theta_s=0.5).rocking == pytest.approx(0.01)
    assert rotation(**turn | {"avoidable": 0.06}, theta_s=0.5).obliged
    assert not rotation(**turn | {"avoidable": 0.06}).obliged
    back = rotation(start=0.46, reached=0.48, angle=0.02, avoidable=0.02, theta_s=0.5)
    chain = Chain((on, back))
    assert (chain.inclinations, chain.theta_s) == ((0.46, 0.53), 0.5)
    assert chain.beyond_slope == pytest.approx(0.04)
    assert Chain((rotation(start=0.57, reached=0.48, theta_s=0.5),)).beyond_slope == pytest.approx(
        0.07
    )
    assert math.isnan(Chain((rotation(**turn),)).beyond_slope)
    assert chain.rocking == pytest.approx(0.04)
    off = rotation(**turn)
    for chain in (Chain((on, off)), Chain((off, on)), Chain((off, off))):
        assert math.isnan(chain.theta_s)
        assert chain.rocking == pytest.approx(0.14)


def test_what_does_not_drop_leaves_an_impact_nothing():
    """Whatever tilted gravity makes of the way that the centroid moved."""
    level = rotation(drop=0.0, moved=0.05, left=0.0, rise=0.12, ahead=0.06)
    by_hand = math.cos(0.1) * 0.12 - math.sin(0.1) * 0.06
    assert level.spare_after_impact(0.1) == pytest.approx(by_hand)


def test_the_flight_under_both_poses_of_a_rotation():
    """The contacts of the one before it and of the one after it, and of no other."""
    rear = np.array([[0.5, 0.0], [0.2, 0.0], [0.3, 0.0], [0.0, 0.0]])
    front = np.array([[0.9, 0.0], [0.8, 0.0], [0.7, 0.0], [2.0, 0.0]])
    poses = SimpleNamespace(rear_point=rear, front_point=front)
    for begin, end, on in ((0.2, 0.8, True), (0.25, 0.9, False), (0.1, 0.75, False)):
        found = rotations._slope_under(poses, 1, [(-9.0, 0.1, 0.7), (begin, end, 0.5)])
        assert (found == 0.5) is on
        assert math.isnan(found) is not on


def test_flights_with_a_mean_slope():
    """Three nosings, two, and three again; the way down alike."""
    stairs = [(0, 0), (0, 1), (3, 1), (3, 2), (6, 2), (6, 2.5), (9, 2.5)]
    second = [(15, 2.5), (15, 3.5), (18, 3.5), (18, 4.5), (24, 4.5)]
    third = [(24, 5.5), (27, 5.5), (27, 7.5), (30, 7.5), (30, 8.5), (40, 8.5)]
    points = 0.1 * np.array([(-9, 0), *stairs, *second, *third])
    profile = Profile.of_points(points)
    (first, one), (last, other) = ((each[:2], each[2]) for each in slopes_of_flights(profile, 0.5))
    assert first == pytest.approx((0.0, 0.6), abs=1.1e-6)
    assert last == pytest.approx((2.4, 3.0), abs=1.1e-6)
    assert one == pytest.approx(math.atan2(1.5, 6))
    assert other == pytest.approx(math.atan2(3, 6))
    down = slopes_of_flights(profile.reflected(), 0.5)
    assert [each[2] for each in down] == pytest.approx([-other, -one])


def test_what_is_together():
    """By hand: at most 1 % of the flat's length of 0.5 m, 5 mm, from one to the next."""

    def at(x, ends):
        return SimpleNamespace(start=Placement(x, 1.0, 0.2), end=Placement(ends, 0.9, -0.3))

    rotations = [at(0.1, 0.102), at(0.1065, 0.11), at(0.112, 0.19), at(0.2, 0.2), at(0.25, 0.25)]
    for each in rotations:
        each.start = each.start._replace(z=0.9)
    groups = [list(group) for group in together(rotations, 0.5)]
    assert groups == [[0, 1, 2], [3], [4]]
    assert together([], 0.5) == []
    rotations = [at(0.0, 0.1), at(0.1, 0.2)]  # 100 mm of height are a way too
    assert together(rotations, 0.5) == [range(1), range(1, 2)]


def test_a_fall_is_not_arrested():
    found = driven(inclined(70, 0.150), KENAF)
    last = found.rotations[-1]
    assert not last.arrested
    assert last.arrested_by is None
    assert not last.leading_end_down
    assert last.avoidable == last.angle
    assert math.isnan(last.impact_speed)
    assert math.degrees(last.reached) == pytest.approx(90, abs=1e-6)
    assert found.end == (last.phase, last.step)
    assert found.phases[-1].largest_rotation == 0.0


@pytest.mark.parametrize("acceleration", [-0.8, 0.5])
def test_drops_are_along_effective_gravity(acceleration):
    """By hand: the energy that the rotation releases, over effective gravity; it starts from rest.

    On the level the path is level, so effective gravity leans by a/g; the pivot stands under the
    centroid along it.
    """
    found = driven(inclined(30, 0.150), KENAF, descending=True, acceleration=-acceleration)
    first, record = found.rotations[0], found.path.rotations[0]
    size = math.hypot(G, acceleration)
    start, end = np.array(record.start[:2]), np.array(record.end[:2])
    fall = float((start - end) @ (acceleration, G)) / size
    assert first.drop == pytest.approx(fall, abs=ROUNDING)
    r = math.dist(start, record.pivot_point)
    rate = math.sqrt(2 * size * fall / (KENAF.gyration**2 + r**2))
    assert record.rate_before == pytest.approx(rate, rel=1e-9)


ON_IT = math.atan2(0.1, 0.3)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(
    ("begin", "end", "slope"),
    [(0.0, 0.6, ON_IT), (-1e-3, 0.6, math.nan), (0.0, 0.601, math.nan), (0.0, 2.0, math.nan)],
)
def test_a_rotation_on_a_slope_by_hand(sense, begin, end, slope, monkeypatch):
    """From (0, 0.5) to (0.1, 0.3) on a path that rises by 0.5 rad, at 2 m/s^2 along it.

    Effective gravity has a cos(0.5) ahead and G + a sin(0.5) up; it is arrested by what carries at
    the pose after it, in front where the leading end comes down.
    """
    record = SimpleNamespace(
        s=1.5, sense=sense, arrested=True, angle=0.4, pivot=7, barrier=3.0,
        barrier_across=0.2, kinetic=1.0,
        pivot_point=(0.0, 0.0), start=Placement(0.0, 0.5, 0.2), end=Placement(0.1, 0.3, -0.2),
    )  # fmt: skip
    poses = SimpleNamespace(
        path_direction=np.array([0.0, 0.5, 0.0]),
        front_point=np.array([(-1, 0), (0.35, 0), (end, 0)]),
        rear_point=np.array([(-2, 0), (begin, 0), (0.1, 0)]),
        front=np.array([64, 65, 66]), rear=np.array([128, 129, 130]),
    )  # fmt: skip
    path = SimpleNamespace(rotations=[record], poses=poses, row_before=lambda s: 1)
    monkeypatch.setattr(contact, "impact_speeds", lambda path: np.array([0.7]))
    phase = np.array(["enter", "traverse", "land"])
    stairs = Profile.of_stairs(Stairs(rise=0.1, going=0.3, steps=3))
    (found,) = rotations_of(path, stairs, phase, False, 0.5, 2.0)
    ahead, up = 2 * math.cos(0.5), G + 2 * math.sin(0.5)
    gravity = math.hypot(ahead, up)
    drop = (up * 0.2 - ahead * 0.1) / gravity
    assert found.drop == pytest.approx(drop, abs=1e-12)
    towards = -sense  # x towards the end that comes down
    assert found.moved == pytest.approx(towards * (up * 0.1 + ahead * 0.2) / gravity)
    assert (found.rise, found.left) == pytest.approx((3.0 / gravity, 1.0 / gravity))
    assert found.ahead == pytest.approx(towards * 0.2)
    assert (found.phase, found.step, found.path) == (Phase.TRAVERSE, 2, 1.5)
    assert found.theta_s == pytest.approx(slope, nan_ok=True)  # nosings at 0, 0.3 and 0.6 m
    assert found.leading_end_down is (sense < 0)
    assert found.arrested_by == (66 if sense < 0 else 130)


@pytest.mark.parametrize(
    ("edges", "start", "avoidable"),
    [
        ([(0.3, -0.1), (0.3, -0.2)], 0.2, math.atan2(-0.1, 0.3) + 0.6),  # the highest line
        ([(0.3, -0.4)], 0.2, 0.0),  # as far as the flat is long, steeper than where it ends
        ([(0.3, -0.4), (0.1, 0.2)], -0.5, 0.1),  # no higher than where it begins
        ([(0.3, -0.41), (-0.1, 0.2), (1e-6, 0.2)], 0.2, 0.0),  # too far, behind, above
        ([(0.3, -0.1), (0.5, 0.0)], 0.2, 0.6),
    ],
)
def test_what_a_longer_robot_would_be_spared_by_hand(edges, start, avoidable):
    """Edges from the pivot, under a flat of 0.5 m; it ends at -0.6 rad."""
    record = SimpleNamespace(
        pivot_point=(2.0, 1.0), start=Placement(0, 0, start), end=Placement(0, 0, -0.6)
    )
    profile = SimpleNamespace(edges=np.array([(2.0, 1.0)]) + edges)
    assert _beyond_the_edge(record, profile, 0.5) == pytest.approx(avoidable, abs=1e-12)
