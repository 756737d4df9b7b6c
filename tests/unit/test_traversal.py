"""The traverse of a robot: phases, steps, extremes; plain kernel, coarse poses."""

import math

import numpy as np
import pytest

from kaidan import contact
from kaidan.errors import InputError
from kaidan.outline import Outline
from kaidan.robot import Posture, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Phase, traverse
from kaidan.traversal.samples import samples_of, trailing_end_leaves

STEP = 0.02  # m between poses; events are located whatever it is
KENAF = Outline.of(Robot.named("kenaf"))
FLIGHT = Stairs.inclined(angle=math.radians(50), nosing_spacing=0.150, steps=8)


def driven(stairs=FLIGHT, outline=KENAF, **how):
    return traverse(Profile.of_stairs(stairs), outline, step=STEP, **how)


def test_kenaf_on_the_papers_flight():
    """Paper: theta_s_sup = 60.205 deg at 150 mm, so 10.205 deg to spare at 50 deg."""
    found = driven()
    assert found.arrived
    assert found.arrested_with_momentum
    assert math.degrees(found.downhill_margin) == pytest.approx(10.205, abs=5e-4)  # as printed
    assert [each.phase for each in found.phases] == list(Phase)
    on_flight = found.phases[1]
    # by hand: two nosings of equal direction need tan(theta) wherever the load is
    assert on_flight.required_friction == pytest.approx(math.tan(math.radians(50)), abs=1e-6)
    # by hand: power over speed is the height gained, sin of the slope
    assert on_flight.traction_over_weight == pytest.approx(math.sin(math.radians(50)), abs=1e-6)
    assert on_flight.largest_rotation == 0.0
    assert not on_flight.belly_touches


def test_down_tail_first_has_the_ascents_margins():
    """docs/theory/margin.md: tail first down has the ascent's bound."""
    up, down = driven(), driven(descending=True, facing="tail-first")
    assert down.downhill_margin == pytest.approx(up.downhill_margin, abs=1e-9)
    rocks = [each.first_rock(downhill=False) for each in (down, up)]
    assert rocks[0].margin == pytest.approx(rocks[1].margin, abs=1e-9)


def test_down_nose_first_has_the_mirrors_margin():
    """docs/theory/margin.md: atan((C_L - p)/C_N) = 32.9 deg for Kenaf at 150 mm."""
    found = driven(descending=True)
    by_hand = math.atan2(0.196 - 0.150, 0.071) - math.radians(50)
    assert found.downhill_margin == pytest.approx(by_hand, abs=1e-9)


def test_it_falls_over_where_it_must():
    """Grade two's limit is 62.48 deg (docs/theory/contact.md, two prototypes): 70 is beyond it."""
    found = driven(Stairs.inclined(angle=math.radians(70), nosing_spacing=0.150, steps=8))
    assert found.status is contact.Status.FELL_BACKWARD
    assert found.events[-1].name == "fell-backward"


def test_steps_are_counted_from_the_bottom_both_ways():
    for how in ({}, {"descending": True, "facing": "tail-first"}):
        seen = [each.step for each in driven(**how).events]
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
    found = traverse(Profile.of_points(points), KENAF, step=STEP)
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


@pytest.mark.parametrize("posture", [{"front": -1.05}, {"front": -1.3, "rear": "flat"}])
def test_on_leading_flippers_that_are_pushed_down_it_begins_before_the_first_riser(posture):
    """They raise the nose, and so reach further ahead: it stands on the floor all the same."""
    outline = Outline.of(Robot.named("absolem"), Posture(**posture))
    poses = driven(Stairs(rise=0.178, going=0.279, steps=4), outline).path.poses
    for point in (poses.rear_point[0], poses.front_point[0]):
        assert point[1] == 0.0
        assert point[0] < 0.0


def test_no_stairs_at_all():
    found = traverse(Profile.of_points([(0, 0), (2, 0)]), KENAF, step=STEP)
    assert found.arrived
    assert found.criterion.holds is None


def test_long_profiles_are_refused_and_never_hang():
    level = np.column_stack([np.linspace(0, 1000, 10**6), np.tile([0.0, 0.001], 500_000)])
    with pytest.raises(InputError, match="more than one traverse takes: cut or thin it"):
        traverse(Profile.of_points(level), KENAF)
    short = Profile.of_points(level[:30_000])
    with (
        contact.using_kernel("plain"),
        pytest.raises(InputError, match="without the native"),
    ):
        traverse(short, KENAF)


ABSOLEM = Outline.of(Robot.named("absolem"), Posture(front="flat", rear="flat"))


def test_going_down_the_tail_may_slide_down_the_last_risers():
    """A trailing end that comes off an edge, the other on the landing: no friction is needed."""
    found = driven(Stairs.named("ibc"), ABSOLEM, descending=True)
    land = found.phases[-1]
    at_landing = found.phase_of_pose == "land"
    off = trailing_end_leaves(found.path)[at_landing]
    frictions = found.path.margins.required_friction[at_landing]
    assert land.slides_below == pytest.approx(frictions[off].max(), abs=1e-9)
    assert land.required_friction == pytest.approx(frictions[~off].max(), abs=1e-9)
    assert land.required_friction < 0.7 < land.slides_below
    assert driven(Stairs.named("ibc"), ABSOLEM).phases[-1].slides_below is None


def test_what_comes_off_lies_beyond_the_flat():
    """By hand: under the flat the contact leans as the flat does, beyond it farther ahead."""
    found = driven(Stairs.named("ibc"), KENAF, descending=True, facing="tail-first")
    path, off = found.path, trailing_end_leaves(found.path)
    lies_flat = np.array([path.is_on_flat(int(code), k) for k, code in enumerate(path.poses.rear)])
    leans = path.poses.rear_lean
    assert not (off & lies_flat).any()
    assert leans[lies_flat] == pytest.approx(-path.inclination[lies_flat], abs=1e-9)
    going_down = np.sin(path.poses.path_direction) < 0
    beyond = ~lies_flat & (leans > np.maximum(-path.inclination, 0) + 1e-9)
    assert (off == (beyond & going_down)).all()
    assert off.sum() > 10


def sharp(flat_length=0.6, com_from_front=0.28, com_height=0.1, radius=0.03):
    track = Track(flat_length=flat_length, front_radius=radius, rear_radius=radius)
    sheet = Robot(name="r", com_from_front=com_from_front, com_height=com_height, track=track)
    return Outline.of(sheet)


def test_the_trailing_end_slides_down_the_last_face_below_the_friction_of_a_ladder():
    """By hand, a ladder at a wall, level: its end on the face at R, the other on the landing.

    The forces lean by a from their normals and meet on the gravity line, R + d_r t = d_f / t with
    t = tan a: d_r the centroid's distance from the face, d_f that from the other contact.
    """
    C_L, L, R = 0.28, 0.6, 0.03
    found = driven(Stairs(rise=0.12, going=0.3, steps=3), sharp(), descending=True)
    d_r, d_f = L - C_L + R, C_L
    by_hand = (-R + math.sqrt(R**2 + 4 * d_r * d_f)) / (2 * d_r)
    assert found.phases[-1].slides_below == pytest.approx(by_hand, abs=1e-6)


def test_what_the_landing_requires_has_no_angle_drawn():
    """By hand, small ends on a gentle flight: the flat needs its slope, and nothing beyond counts.

    The trailing end on the edge, its normal leaning by l, the other end on the landing: forces that
    lean by a from their normals meet on the gravity line. At l = 45 deg that is 0.351, no more
    special than any other angle; at 90 deg, down the face, it is the most.
    """
    stairs = Stairs.inclined(angle=math.radians(11.1237), nosing_spacing=0.300479, steps=4)
    track = Track(flat_length=0.8484, front_radius=0.005, rear_radius=0.01)
    small = Outline.of(Robot(name="r", com_from_front=0.39125, com_height=0.2958, track=track))
    for step in (STEP, 2 * STEP):
        found = traverse(Profile.of_stairs(stairs), small, descending=True, step=step)
        flight, land = found.phases[-2:]
        assert flight.required_friction == pytest.approx(math.tan(stairs.angle), abs=1e-9)
        assert land.required_friction < flight.required_friction
        off = np.flatnonzero(trailing_end_leaves(found.path) & (found.phase_of_pose == "land"))
        poses, x = found.path.poses, found.path.x[off]
        lean, rear, front = poses.rear_lean[off], poses.rear_point[off], poses.front_point[off]
        a = np.arctan(found.path.margins.required_friction[off])
        meet_rear = rear[:, 1] + (x - rear[:, 0]) / np.tan(lean - a)
        meet_front = front[:, 1] + (front[:, 0] - x) / np.tan(a)
        # beside an exchange of contacts a pose is off it by 1 um, and the lines cross at a slant
        assert meet_rear == pytest.approx(meet_front, rel=1e-5)
        assert lean.min() < math.pi / 4
        assert lean.max() == pytest.approx(math.pi / 2)
        assert land.slides_below == pytest.approx(np.tan(a).max())


def test_margins_just_after_a_nosing_has_left():
    """Theory, margin: then the lowest contact stands L - p behind the uphill tip."""
    theta, p = math.radians(50), 0.150
    found = driven()
    x = 0.470 - p - 0.196
    by_hand = x * math.cos(theta) - 0.071 * math.sin(theta)
    assert found.phases[1].static_margin == pytest.approx(by_hand, abs=1e-9)


def test_the_path_stands_upright_as_the_nose_climbs_a_riser():
    """By hand: power over speed is the height gained, all of it where the centroid goes up."""
    enter = driven(Stairs(rise=0.12, going=0.3, steps=3), sharp()).phases[0]
    assert enter.traction_over_weight == pytest.approx(1.0, abs=1e-12)
    assert enter.required_friction_step == 1


def test_samples_hold_the_path_and_what_lies_between():
    found = driven(Stairs(rise=0.12, going=0.3, steps=5), sharp())
    samples = samples_of(found.path, found.phase_of_pose, 0.0)
    count = len(found.path.poses)
    assert (samples.row[:count] == np.arange(count)).all()
    assert len(samples.row) == len(samples.friction) == len(samples.traction) > count
    between, rows = samples.path.s[count:], samples.row[count:]
    # each between the pose whose phase it has and one beside it
    low, high = found.path.s[np.maximum(rows - 1, 0)], found.path.s[np.minimum(rows + 1, count - 1)]
    assert ((between >= low - 1e-12) & (between <= high + 1e-12)).all()
    exchanges = {each.path for each in found.events if each.name == "made"}
    for s in exchanges:  # a pose before it and one after it, and none in between counts
        at = np.flatnonzero(np.abs(found.path.s - s) < 1e-8)
        assert samples.lasts[at].sum() == 2


def test_the_step_at_the_last_nosing_up_and_down():
    """Figures of a phase name the step at which they are."""
    up, down = driven(), driven(descending=True, facing="tail-first")
    assert up.phases[-1].required_friction_step == 8
    assert up.end == (Phase.LAND, 8)
    assert down.end == (Phase.LAND, 1)


@pytest.mark.parametrize("descending", [False, True])
def test_every_nosing_comes_under_the_flat_at_one_tip_and_leaves_it_at_the_other(descending):
    """By hand: the tips of the flat lie C_L and L - C_L from the centroid."""
    facing = "tail-first" if descending else "nose-first"  # nose first it would drop
    found = driven(descending=descending, facing=facing)
    run, ahead, behind = found.path, 0.196, 0.470 - 0.196
    if descending:
        ahead, behind = behind, ahead
    numbers = {contact.Event.REACHED: [], contact.Event.LEFT: []}
    for event in found.events:
        if event.kind not in numbers or event.phase is not Phase.TRAVERSE:
            continue
        phi = event.inclination
        place = run.ground.points[contact.Feature.of(event.feature).point] - (event.x, event.z)
        along = place @ (math.cos(phi), math.sin(phi))
        tip = ahead if event.kind is contact.Event.REACHED else -behind
        assert along == pytest.approx(tip, abs=1e-9)  # m: a straight line between two poses
        numbers[event.kind].append(contact.Feature.of(event.feature).point)
    assert min(len(each) for each in numbers.values()) >= 2
    assert [event.path for event in found.events] == sorted(event.path for event in found.events)


def test_flippers_a_little_off_the_flat_carry_all_but_what_it_rocks():
    robot, flight = Robot.named("absolem"), Profile.of_stairs(Stairs.named("ada"))
    flat = {end: pair.flat_angle for end, pair in robot.flippers().items()}
    margins = []
    for off in (0.02, 0.1, 0.5, 1.0, 2.0):
        raised = Posture(**flat | {"rear": flat["rear"] + math.radians(off)})
        found = traverse(flight, Outline.of(robot, raised), step=STEP)
        assert not found.whole
        assert math.radians(-60) > found.criterion.smallest(downhill=True).margin  # track alone
        assert found.downhill_margin < found.falls_downhill.tilt
        margins.append(math.degrees(found.downhill_margin))
    # what it rocks as the tip leaves a nosing counts in full (by hand in test_tilted_gravity)
    assert np.all(np.diff(margins) < 0)
    beyond = Posture(**flat | {"rear": flat["rear"] + math.radians(4.0)})
    assert traverse(flight, Outline.of(robot, beyond), step=STEP).downhill_margin < 0
