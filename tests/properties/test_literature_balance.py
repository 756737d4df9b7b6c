"""Mirror, scaling and monotony of balance, rollover rule and sub-track angles."""

import math

import numpy as np
import pytest
from hypothesis import Phase as HypothesisPhase
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from kaidan.literature.balance import balance_along, quality
from kaidan.literature.equilibria import stable_poses
from kaidan.literature.rollover import Action, avoid_rollover, stability_margin
from kaidan.literature.stepping import Angles
from kaidan.literature.subtracks import touching_angle
from kaidan.outline import Outline
from kaidan.robot import FlipperPair, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs

SETTINGS = settings(
    max_examples=10,
    deadline=None,
    phases=[HypothesisPhase.explicit, HypothesisPhase.generate],  # shrinking drives for minutes
)
QUICK = settings(max_examples=60, deadline=None)

scales = st.sampled_from([0.5, 2.0, 3.0])
robots = st.builds(
    lambda L, c, h, front, rear: {"L": L, "C_L": c * L, "C_N": h * L, "front": front, "rear": rear},
    L=st.floats(0.4, 0.8),
    c=st.floats(0.35, 0.65),
    h=st.floats(0.1, 0.25),
    front=st.floats(0.04, 0.1),
    rear=st.floats(0.04, 0.1),
)
flights = st.tuples(st.floats(0.06, 0.15), st.floats(0.2, 0.3))
points = st.lists(
    st.tuples(st.integers(-200, 200).map(lambda x: x / 100), st.floats(-0.5, 0.5)),
    min_size=2,
    max_size=6,
    unique_by=lambda p: p[0],
)
coms = st.tuples(st.floats(-2, 2), st.floats(0.6, 2))


def outline(robot, k=1.0):
    return Outline.of(
        Robot(
            name="r",
            com_from_front=k * robot["C_L"],
            com_height=k * robot["C_N"],
            track=Track(
                flat_length=k * robot["L"],
                front_radius=k * robot["front"],
                rear_radius=k * robot["rear"],
            ),
        )
    )


def flight(rise, going, k=1.0):
    profile = Profile.of_stairs(Stairs(rise=rise, going=going, steps=3))
    return Profile.of_points(k * profile.points)


def mirrored(contacts, com):
    return [(-x, z) for x, z in contacts], (-com[0], com[1])


@SETTINGS
@given(robots, flights, scales)
def test_a_way_scales(robot, stairs, k):
    """Lengths x k: falls x k, rates / sqrt(k), angles, classes and qualities the same."""
    one = balance_along(flight(*stairs), outline(robot), step=0.03)
    two = balance_along(
        flight(*stairs, k), outline(robot, k), step=0.03 * k, speed=0.1 * math.sqrt(k),
        )  # fmt: skip
    assert [each.change for each in one.losses] == [each.change for each in two.losses]
    for a, b in zip(one.losses, two.losses, strict=True):
        assert b.rotation == pytest.approx(a.rotation, abs=1e-6)  # the kernel's location of events
        assert b.fall == pytest.approx(k * a.fall, abs=1e-6)
        assert b.rate == pytest.approx(a.rate / math.sqrt(k), abs=1e-4)
        assert b.quality == pytest.approx(a.quality, abs=1e-4)
        assert (b.end is None) == (a.end is None)


@SETTINGS
@given(robots, flights)
def test_the_mirrored_robot_on_the_mirrored_way(robot, stairs):
    """Reflect the profile, swap front and rear, reverse the drive: nothing changes."""
    profile, body = flight(*stairs), outline(robot)
    one = balance_along(profile, body, descending=True, step=0.03)
    two = balance_along(profile.reflected(), body.turned_round(), facing="tail-first", step=0.03)
    assert [each.change for each in one.transitions] == [each.change for each in two.transitions]
    for a, b in zip(one.losses, two.losses, strict=True):
        assert a.rotation == pytest.approx(b.rotation, abs=1e-9)
        assert a.quality == pytest.approx(b.quality, abs=1e-9)


@SETTINGS
@given(robots, flights, st.floats(-0.3, 0.6))
def test_all_poses_of_the_mirror(robot, stairs, x):
    profile, body = flight(*stairs), outline(robot)
    assume(np.abs(profile.points[:, 0] - x).min() > 1e-3)  # on an edge either side is right
    here = stable_poses(profile, body, x)
    there = stable_poses(profile.reflected(), body.turned_round(), -x)
    assert any(each.balance == "stable" for each in here)
    # the kernel's own letting go is not symmetric where two stable poses lie close together
    mine = [each.inclination for each in here if each.balance == "stable"]
    theirs = [-each.inclination for each in there if each.balance == "stable"]
    if len(mine) == len(theirs):
        assert sorted(mine) == pytest.approx(sorted(theirs), abs=math.radians(0.5))


@QUICK
@given(points, coms, scales)
def test_margin_mirrors_and_scales(contacts, com, k):
    back, front = stability_margin(contacts, com)
    assert stability_margin(*mirrored(contacts, com)) == pytest.approx((front, back), abs=1e-9)
    larger = stability_margin(k * np.array(contacts), k * np.array(com))
    assert larger == pytest.approx((k * back, k * front), abs=1e-9)
    there = np.array([3.0, -2.0])
    moved = stability_margin(np.array(contacts) + there, np.array(com) + there)
    assert moved == pytest.approx((back, front), abs=1e-9)


@QUICK
@given(points, coms)
def test_margin_is_the_rise_to_the_upright(contacts, com):
    """Oracle: turn the centroid about the contact by small angles and take the highest."""
    rear = min(contacts)
    back, _ = stability_margin(contacts, com)
    turns = np.linspace(-math.pi, math.pi, 100_001)
    d_x, d_z = com[0] - rear[0], com[1] - rear[1]
    highest = (np.sin(turns) * d_x + np.cos(turns) * d_z).max()
    # 63 urad steps miss the top by (31 urad)^2/2 of 4 m at most: 2 nm
    assert abs(back) == pytest.approx(highest - d_z, abs=1e-8)
    assert (back >= 0) == (d_x >= 0) or abs(back) < 1e-9


@QUICK
@given(st.floats(0, 0.5), st.floats(0.01, 0.5), st.floats(0, 2), st.floats(0.01, 2), scales)
def test_quality_is_a_share(fall, height, kinetic, barrier, k):
    value = quality(fall=fall, com_height=height, kinetic=kinetic, barrier=barrier)
    assert 0.0 <= value <= 1.0
    # lengths and energies of a scaled robot grow alike
    assert quality(
        fall=k * fall, com_height=k * height, kinetic=k * kinetic, barrier=k * barrier
    ) == pytest.approx(value, abs=1e-12)
    worse = quality(fall=fall + 0.01, com_height=height, kinetic=kinetic, barrier=barrier)
    assert worse <= value


@QUICK
@given(st.floats(-0.05, 0.05), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2), st.floats(-1, 1))
def test_the_rule_mirrors(base, by_front, by_rear, at):
    """Swapping front and rear in question and answer changes nothing but ties."""

    def predict(angles):
        return (1.0, base + by_front * (angles.front - at) + by_rear * (angles.rear - at))

    def swapped(angles):
        return predict(Angles(angles.rear, angles.front))

    how = {"threshold": 0.01, "reach": (0.1, 0.1)}
    one = avoid_rollover(Angles(at, at), predict, **how)
    two = avoid_rollover(Angles(at, at), swapped, **how)
    assert one.action == two.action
    assert one.turn == two.turn
    assert one.margin_then == pytest.approx(two.margin_then, abs=1e-12)
    if one.action in (Action.MOVE, Action.WAIT):
        assert one.margin_then >= 0.01 > one.margin


@QUICK
@given(
    st.lists(st.tuples(st.floats(0.02, 0.4), st.floats(-0.3, 0.3)), min_size=1, max_size=5),
    scales,
)
def test_touching_angle_scales_and_only_rises_with_more_points(seen, k):
    pair = {"length": 0.33, "root_radius": 0.089, "tip_radius": 0.029, "pivot_height": 0.089}
    angle = touching_angle(seen, FlipperPair(**pair))
    larger = FlipperPair(**{name: k * value for name, value in pair.items()})
    scaled = touching_angle(k * np.array(seen), larger)
    assert scaled == pytest.approx(angle, abs=1e-9, nan_ok=True)
    more = touching_angle([*seen, (0.2, 0.0)], FlipperPair(**pair))
    assert math.isnan(angle) or more >= angle
