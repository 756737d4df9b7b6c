"""Mirror, scale and refinement of the whole climb."""

import math

import numpy as np
import pytest
from hypothesis import Phase as HypothesisPhase
from hypothesis import given, settings
from hypothesis import strategies as st

from kaidan import contact
from kaidan.climb import climb
from kaidan.outline import Outline
from kaidan.profile import Profile
from kaidan.robot import Robot, Track
from kaidan.stairs import Stairs

pytestmark = pytest.mark.usefixtures("compiled_kernel")

STEP = 0.03  # m between poses; events are located whatever it is
SETTINGS = settings(
    max_examples=12,
    deadline=None,
    derandomize=True,
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


def driven(profile, outline, **how):
    return climb(profile, outline, step=STEP, compiled=False, **how)


def same(one, two, tolerance):
    assert one.status == two.status
    assert len(one.run.releases) == len(two.run.releases)
    for name in ("back_margin_angle", "front_margin_angle"):
        mine, theirs = getattr(one.criterion, name), getattr(two.criterion, name)
        assert mine == pytest.approx(theirs, abs=1e-9, nan_ok=True)
    a, b = one.run.largest_inclination(), two.run.largest_inclination()
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
    larger = Profile.of_points(profile.points * k)
    big = outline._replace(
        parts=outline.parts * k,
        gyration=outline.gyration * k,
        stance=outline.stance._replace(
            flat_length=outline.stance.flat_length * k, com_height=outline.stance.com_height * k
        ),
    )
    # rad: contacts count within 1e-9 m and end radii start in other places of the grid of poses
    same(driven(profile, outline), driven(larger, big), 1e-5)


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
    same(driven(profile, outline), driven(refined, outline), 1e-7)  # rad: 1e-11 m on 0.1 m


@SETTINGS
@given(robots, flights)
def test_steps_of_the_drive_change_nothing_that_counts(robot, flight):
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    coarse, fine = (climb(profile, outline, step=s, compiled=False) for s in (0.03, 0.011))
    same(coarse, fine, 1e-3)  # rad: an inclination between poses may be passed over
    if coarse.status is contact.Status.OK:
        # of the whole way: a phase may begin between two poses
        one, two = (
            max(each.required_friction for each in found.phases) for found in (coarse, fine)
        )
        assert one == pytest.approx(two, rel=0.02)


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
