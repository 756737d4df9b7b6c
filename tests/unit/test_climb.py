"""The whole way of a robot: phases, steps, worst figures; plain kernel, coarse poses."""

import math

import numpy as np
import pytest

from kaidan import contact
from kaidan.assessment import case_of
from kaidan.assessment.contact_model import climb_of
from kaidan.climb import Phase, climb
from kaidan.errors import InputError
from kaidan.outline import Outline
from kaidan.profile import Profile
from kaidan.robot import Robot, Track
from kaidan.stairs import Stairs

pytestmark = pytest.mark.usefixtures("compiled_kernel")

STEP = 0.02  # m between poses; events are located whatever it is
KENAF = Outline.of(Robot.named("kenaf"))
FLIGHT = Stairs.inclined(angle=math.radians(50), nosing_spacing=0.150, steps=8)


def driven(stairs=FLIGHT, outline=KENAF, **how):
    return climb(Profile.of_stairs(stairs), outline, step=STEP, compiled=False, **how)


def test_kenaf_on_the_papers_flight():
    """Paper: theta_s_sup = 60.205 deg at 150 mm, so 10.205 deg to spare at 50 deg."""
    found = driven()
    assert found.arrived
    assert found.held_with_momentum
    assert math.degrees(found.downhill_margin) == pytest.approx(10.205, abs=5e-4)  # as printed
    assert [each.phase for each in found.phases] == list(Phase)
    traverse = found.phases[1]
    # by hand: two nosings of equal direction need tan(theta) wherever the load is
    assert traverse.required_friction == pytest.approx(math.tan(math.radians(50)), abs=1e-6)
    # by hand: power over speed is the height gained, sin of the slope
    assert traverse.traction_over_weight == pytest.approx(math.sin(math.radians(50)), abs=1e-6)
    assert traverse.largest_swing_deg == 0.0
    assert not traverse.belly_touches


def test_down_tail_first_has_the_ascents_margins():
    """Theory section 3: tail first down has the ascent's bound."""
    up, down = driven(), driven(descending=True, facing="tail-first")
    assert down.downhill_margin == pytest.approx(up.downhill_margin, abs=1e-9)
    assert down.uphill_margin == pytest.approx(up.uphill_margin, abs=1e-9)


def test_down_nose_first_has_the_mirrors_margin():
    """Theory section 3: atan((C_L - p)/C_N) = 32.9 deg for Kenaf at 150 mm."""
    found = driven(descending=True)
    by_hand = math.atan2(0.196 - 0.150, 0.071) - math.radians(50)
    assert found.downhill_margin == pytest.approx(by_hand, abs=1e-9)


def test_it_falls_over_where_it_must():
    """Grade two's limit is 62.48 deg (theory.md section 6, two prototypes): 70 is beyond it."""
    found = driven(Stairs.inclined(angle=math.radians(70), nosing_spacing=0.150, steps=8))
    assert found.status is contact.Status.FELL_BACKWARD
    assert found.happenings[-1].what == "fell-backward"


def test_steps_are_counted_from_the_bottom_both_ways():
    for how in ({}, {"descending": True, "facing": "tail-first"}):
        seen = [each.step for each in driven(**how).happenings]
        steps = [step for step in seen if step > 0]
        assert steps == sorted(steps, reverse="descending" in how)
        assert {steps[0], steps[-1]} == {1, 8}


def test_phases_of_a_measured_landing_that_is_not_level():
    """A landing with millimetres of noise is still a landing: phases go enter, traverse, land."""
    profile = Profile.of_stairs(FLIGHT)
    rng = np.random.default_rng(1)
    before = np.column_stack([np.linspace(-2, -0.01, 60), rng.uniform(-2e-3, 0, 60)])
    after = profile.points[-1] + np.column_stack(
        [np.linspace(-1.9, 0, 60), rng.uniform(-2e-3, 0, 60)]
    )
    points = np.vstack([before, profile.points[1:-1], after])
    found = climb(Profile.of_points(points), KENAF, step=STEP, compiled=False)
    assert found.arrived
    names = found.phase_of_pose
    changes = [names[0], *names[1:][names[1:] != names[:-1]]]
    assert changes == ["enter", "traverse", "land"]


@pytest.mark.parametrize("steps", [2, 3])
def test_short_flights_have_an_answer(steps):
    found = driven(Stairs(rise=0.1, going=0.3, steps=steps))
    assert found.arrived
    assert found.criterion.holds is not True  # no nosing is left with the flat on the flight alone


def test_a_robot_longer_than_stairs_and_landings():
    """Landings count as long enough; the judge says where they are not."""
    giant = Robot(
        name="giant",
        com_from_front=2.5,
        com_height=0.5,
        track=Track(flat_length=5.0, front_radius=0.5, rear_radius=0.5),
    )
    found = driven(Stairs(rise=0.17, going=0.29, steps=4, upper_landing=0.5), Outline.of(giant))
    assert found.arrived


def test_no_stairs_at_all():
    found = climb(Profile.of_points([(0, 0), (2, 0)]), KENAF, step=STEP, compiled=False)
    assert found.arrived
    assert found.criterion.holds is None


def test_long_profiles_are_refused_and_never_hang(monkeypatch):
    level = np.column_stack([np.linspace(0, 1000, 10**6), np.tile([0.0, 0.001], 500_000)])
    with pytest.raises(InputError, match="more than one traverse takes: cut or thin it"):
        climb(Profile.of_points(level), KENAF)
    monkeypatch.setattr(contact, "numba_is_loaded", lambda: False)
    monkeypatch.setattr(contact, "numba_is_installed", lambda: False)
    with pytest.raises(InputError, match=r"pip install 'kaidan\[fast\]'"):
        climb(Profile.of_points(level[:30_000]), KENAF)


def test_going_down_the_tail_may_slide_down_the_last_risers():
    """A trailing end on a riser's face, the other on the landing: no friction is needed there."""
    case = case_of("absolem", "ibc", flippers="flat", friction=0.7, direction="down")
    found = climb_of(case)
    land = found.phases[-1]
    rear = found.run.poses[found.phase_of_pose == "land"]
    on_face = abs(rear[:, 10]) > rear[:, 11]
    frictions = found.run.margins[found.phase_of_pose == "land", 0]
    assert land.slides_below == frictions[on_face].max() > 0.7
    assert land.required_friction == frictions[~on_face].max() < 0.7
    assert climb_of(case.changed(direction="up")).phases[-1].slides_below is None


@pytest.mark.parametrize("descending", [False, True])
def test_every_nosing_comes_under_the_flat_at_one_tip_and_leaves_it_at_the_other(descending):
    """By hand: the tips of the flat lie C_L and L - C_L from the centroid."""
    facing = "tail-first" if descending else "nose-first"  # nose first it would drop
    found = driven(descending=descending, facing=facing)
    run, ahead, behind = found.run, 0.196, 0.470 - 0.196
    if descending:
        ahead, behind = behind, ahead
    numbers = {contact.Event.REACHED: [], contact.Event.LEFT: []}
    for event, told in zip(found.events, found.happenings, strict=True):
        code = contact.Event(int(event[0]))
        if code not in numbers or told.phase is not Phase.TRAVERSE:
            continue
        x, z, phi = event[2:5]
        place = run.ground[int(event[5]) >> 6, :2] - (x, z)
        along = place @ (math.cos(phi), math.sin(phi))
        tip = ahead if code is contact.Event.REACHED else -behind
        assert along == pytest.approx(tip, abs=1e-9)  # m: a straight line between two poses
        numbers[code].append(int(event[5]) >> 6)
        assert told.what == code.name.lower()
    assert min(len(each) for each in numbers.values()) >= 2
    assert list(found.events[:, 1]) == sorted(found.events[:, 1])
