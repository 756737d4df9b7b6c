"""Extremes of phases depend on no step, no scale and no side from which they are seen."""

import math
from dataclasses import replace

import pytest
from hypothesis import Phase as HypothesisPhase
from hypothesis import given, settings
from hypothesis import strategies as st

from kaidan.contact import STEP
from kaidan.modes import Phase
from kaidan.outline import Outline
from kaidan.robot import Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import traverse

FINE = 2.5e-4  # m between poses, a twentieth of what is usual
SETTINGS = settings(
    max_examples=80,
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
    L=st.floats(0.35, 1.2),
    c=st.floats(0.3, 0.7),
    h=st.floats(0.08, 0.35),
    front=st.floats(0.005, 0.15),
    rear=st.floats(0.005, 0.15),
)
flights = st.builds(
    lambda rise, going, steps: Stairs(rise=rise, going=going, steps=steps),
    rise=st.floats(0.05, 0.22),
    going=st.floats(0.15, 0.4),
    steps=st.integers(2, 5),
)
facings = st.sampled_from(["nose-first", "tail-first"])


def figures(found):
    """Required friction, and that below which the trailing end slides, of each phase."""
    return {each.phase: (each.required_friction, each.slides_below or 0.0) for each in found.phases}


def alike(one, other, rel):
    # between entering and landing a phase may be shorter than the step, and then have no pose
    assert one.keys() ^ other.keys() <= {Phase.TRAVERSE}
    for phase in one.keys() & other.keys():
        for mine, theirs in zip(one[phase], other[phase], strict=True):
            if math.isfinite(mine) or math.isfinite(theirs):
                assert mine == pytest.approx(theirs, rel=rel, abs=1e-6)


def first_rocks_alike(one, other):
    """Of robots that fall as well."""
    for downhill in (True, False):
        # 0.01 deg: ten times what places that are halved out between two poses leave
        rocks = (each.first_rock(downhill=downhill) for each in (one, other))
        mine, theirs = (math.nan if each is None else each.margin for each in rocks)
        assert mine == pytest.approx(theirs, abs=math.radians(0.01), nan_ok=True)


@SETTINGS
@given(robots, flights, st.booleans(), facings)
def test_the_step_does_not_matter(robot, flight, descending, facing):
    """Peaks between poses are looked for, and poses stand on both sides of every exchange."""
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    usual, fine = (
        traverse(profile, outline, descending=descending, facing=facing, step=step)
        for step in (STEP, FINE)
    )
    assert usual.status is fine.status
    # 0.1 %: ten times what is left to a peak that is looked for
    alike(figures(usual), figures(fine), 1e-3)
    first_rocks_alike(usual, fine)


@SETTINGS
@given(robots, flights, st.booleans(), facings, st.sampled_from([0.5, 2.0, 3.0]))
def test_the_scale_does_not_matter(robot, flight, descending, facing, k):
    """All lengths times k, the step as it is: no angle and no ratio changes."""
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    stance = outline.stance
    big = replace(
        outline,
        parts=outline.parts * k,
        stance=stance._replace(
            flat_length=stance.flat_length * k,
            com_from_front=stance.com_from_front * k,
            com_height=stance.com_height * k,
        ),
    )
    lines = (profile.points, profile.nosings, profile.edges)
    larger = replace(
        profile,
        **dict(zip(("points", "nosings", "edges"), (k * each for each in lines), strict=True)),
    )
    one = traverse(profile, outline, descending=descending, facing=facing)
    two = traverse(larger, big, descending=descending, facing=facing)
    assert one.status is two.status
    alike(figures(one), figures(two), 1e-3)
    first_rocks_alike(one, two)
    for mine, theirs in zip(one.rotations, two.rotations, strict=True):
        assert theirs.angle == pytest.approx(mine.angle, abs=1e-6)
        assert theirs.rocking == pytest.approx(mine.rocking, abs=1e-6)
        assert theirs.drop == pytest.approx(k * mine.drop, abs=1e-6 * k)
        # free rotation: speeds grow as the root of the lengths
        expected = math.sqrt(k) * mine.impact_speed
        assert theirs.impact_speed == pytest.approx(expected, rel=1e-6, abs=1e-6, nan_ok=True)


@SETTINGS
@given(robots, flights, st.booleans())
def test_the_mirror_does_not_matter(robot, flight, descending):
    """The profile seen from the other side, nose and tail swapped, driven the other way."""
    profile, outline = Profile.of_stairs(flight), Outline.of(robot)
    one = traverse(profile, outline, descending=descending)
    two = traverse(
        profile.reflected(), outline.turned_round(), descending=not descending, facing="tail-first"
    )
    assert [each.start for each in one.rotations] == [each.start for each in two.rotations]
    assert [each.obliged for each in one.rotations] == [each.obliged for each in two.rotations]
    # on short landings the direction decides what is landing, and so what slides where it goes
    mine, theirs = (max(map(max, figures(each).values()), default=0.0) for each in (one, two))
    assert mine == pytest.approx(theirs, abs=1e-9)
