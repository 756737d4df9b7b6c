"""Mirror, scale and refinement of a traverse."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import Phase as HypothesisPhase
from hypothesis import given, settings
from hypothesis import strategies as st

from kaidan import contact
from kaidan.outline import Outline
from kaidan.robot import Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import traverse

STEP = 0.03  # m between poses; events are located whatever it is
FINE = 0.0025
"""Between poses from which what is sampled is 1e-4 rad near what it is [m]."""
SETTINGS = settings(
    max_examples=12,
    deadline=None,
    phases=[HypothesisPhase.explicit, HypothesisPhase.generate],  # shrinking drives for minutes
)

robots = st.builds(
    lambda L, c, h, front, rear: Robot(
        name="r",
        com_from_front=c * L,
        com_height=h * L,
        track=Track(flat_length=L, front_radius=front, rear_radius=rear),
    ),
    L=st.floats(0.4, 1.0),
    c=st.floats(0.3, 0.7),
    h=st.floats(0.1, 0.3),
    front=st.floats(0.03, 0.12),
    rear=st.floats(0.03, 0.12),
)
flights = st.builds(
    lambda rise, going: Stairs(rise=rise, going=going, steps=4),
    rise=st.floats(0.06, 0.2),
    going=st.floats(0.15, 0.3),
)


def driven(profile, outline, step=STEP, **how):
    return traverse(profile, outline, step=step, **how)


def same(one, two, tolerance, sampled=None):
    """`sampled`: how far the tilts to the first rock may differ, which poses add to [rad]."""
    assert one.status == two.status
    assert len(one.path.rotations) == len(two.path.rotations)
    for downhill in (True, False):  # of the nosings alone: what poses add is sampled
        mine, theirs = (each.criterion.smallest(downhill=downhill) for each in (one, two))
        assert (mine is None) == (theirs is None)
        if mine is not None:
            assert mine.margin == pytest.approx(theirs.margin, abs=1e-9)
    for downhill in (True, False) if sampled else ():
        rocks = (each.first_rock(downhill=downhill) for each in (one, two))
        mine, theirs = (math.nan if each is None else each.margin for each in rocks)
        assert mine == pytest.approx(theirs, abs=sampled, nan_ok=True)
    a, b = one.path.largest_inclination(), two.path.largest_inclination()
    if one.arrived:
        assert a == pytest.approx(b, abs=tolerance)


@SETTINGS
@given(robots, flights, st.booleans())
def test_mirror(robot, flight, descending):
    """The profile seen from the other side, nose and tail swapped, driven the other way."""
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    one = driven(profile, outline, descending=descending)
    two = driven(
        profile.reflected(), outline.turned_round(), descending=not descending, facing="tail-first"
    )
    same(one, two, 1e-9)  # rad: the same numbers go in


@SETTINGS
@given(robots, flights, st.sampled_from([0.5, 2.0, 3.0]))
def test_scale(robot, flight, k):
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    # as it is: points of 15 mm and less would make no nosings, whatever the scale
    larger = replace(
        profile,
        points=profile.points * k,
        nosings=profile.nosings * k,
        edges=profile.edges * k,
    )
    big = replace(
        outline,
        parts=outline.parts * k,
        stance=outline.stance._replace(
            flat_length=outline.stance.flat_length * k, com_height=outline.stance.com_height * k
        ),
    )
    # rad: contacts count within 1e-9 m; from poses 30 mm apart sampled tilts differ by up to 1e-3
    one, two = driven(profile, outline, step=FINE), driven(larger, big, step=k * FINE)
    same(one, two, 1e-5, sampled=1e-4)


@SETTINGS
@given(robots, flights, st.integers(0, 2**31))
def test_points_on_existing_lines_change_nothing(robot, flight, seed):
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    rng = np.random.default_rng(seed)
    points = profile.points
    at = rng.integers(0, len(points) - 1, 15)
    shares = rng.random(15)[:, None]
    more = points[at] * (1 - shares) + points[at + 1] * shares
    order = np.argsort(np.concatenate([np.arange(len(points)), at + shares[:, 0]]), kind="stable")
    refined = Profile.of_points(np.vstack([points, more])[order])
    more = driven(refined, outline)
    same(driven(profile, outline), more, 1e-7, sampled=1e-4)  # rad: 1e-11 m on 0.1 m


@SETTINGS
@given(robots, flights, st.integers(0, 2**31), st.booleans())
def test_folds_and_tips_of_risers_are_no_walls(robot, flight, seed, descending):
    """A scan's noise folds risers within themselves and leaves tips of no width at their ends.

    Folds change nothing. A tip is an edge as high as that of a tread which begins there and slopes
    down, by 0.05 mm over 150 mm at most: less than 0.02 degrees.
    """
    rng = np.random.default_rng(seed)
    smooth = Profile.of_stairs(flight).points.tolist()
    folded, tipped, sloping = [], [], []
    for (x, z), (then, higher) in pairwise(smooth):
        folded.append((x, z))
        tipped.append((x, z))
        if not sloping or sloping[-1][0] != x:
            sloping.append((x, z))
        if x == then:
            within = [(x, z + share * (higher - z)) for share in rng.random(4)]
            tip = (x, higher + rng.uniform(1e-6, 5e-5))
            folded += within
            tipped += [*within, tip]
            sloping += [tip]
    outline = Outline.of(robot)
    one, other, rough, alike = (
        driven(Profile.of_points([*points, smooth[-1]]), outline, descending=descending)
        for points in (smooth[:-1], folded, tipped, sloping)
    )
    assert (one.path.poses.table == other.path.poses.table).all()
    assert rough.status == alike.status == one.status
    margins = rough.downhill_margin, alike.downhill_margin
    # a tip is left at once, a tread that slopes is not: 0.09 degrees in 1 of 1,200 cases
    assert margins[0] == pytest.approx(margins[1], abs=math.radians(0.2), nan_ok=True)


@SETTINGS
@given(robots, flights)
def test_steps_of_the_drive_change_nothing_that_counts(robot, flight):
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    coarse, fine = (traverse(profile, outline, step=s) for s in (0.03, 0.011))
    same(coarse, fine, 1e-3, sampled=1e-3)  # rad: an inclination between poses may be passed over
    if coarse.status is contact.Status.OK:
        # of the whole way: a phase may begin between two poses
        one, two = (
            max(each.required_friction for each in found.phases) for found in (coarse, fine)
        )
        assert one == pytest.approx(two, rel=0.02)


@pytest.mark.parametrize("step", [0.005, 0.0075, 0.012])
def test_driven_upright_it_falls_there_wherever_its_poses_lie(step):
    """A robot that is driven up the first riser until it stands upright has fallen. From some poses
    one step leads from short of that to where its centroid is over its tail, of which the tilt to
    the first rock is 0. By hand, upright: the centroid lies ahead of the centre of the tail's end
    by its radius less the centroid's height over the flat, and above it by the distance along it.
    """
    track = Track(flat_length=0.64609, front_radius=0.04482, rear_radius=0.10744)
    robot = Robot(name="r", com_from_front=0.449, com_height=0.105, track=track)
    flight = Profile.of_stairs(Stairs(rise=0.10234, going=0.15588, steps=4))
    found = driven(flight, Outline.of(robot), step=step)
    assert found.status is contact.Status.FELL_BACKWARD
    assert found.path.inclination[-1] == pytest.approx(math.pi / 2, abs=1e-4)  # as nearly it is cut
    upright = math.atan2(0.10744 - 0.105, 0.10744 + 0.64609 - 0.449)
    assert found.downhill_margin == pytest.approx(upright, abs=1e-4)


@SETTINGS
@given(robots, st.floats(0.2, 0.9))
def test_grade_one_up_nose_first_is_down_tail_first(robot, angle):
    p = robot.track.flat_length / 2.5
    flight = Stairs.inclined(angle=math.degrees(angle) * math.pi / 180, nosing_spacing=p, steps=6)
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    up = driven(profile, outline, with_margins=False)
    down = driven(profile, outline, with_margins=False, descending=True, facing="tail-first")
    assert down.downhill_margin == pytest.approx(up.downhill_margin, abs=1e-9)
    assert down.criterion.holds == up.criterion.holds
