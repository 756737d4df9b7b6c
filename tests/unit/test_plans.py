"""Plans of postures: how they are written, what a change of posture takes, what they come to."""

import math

import numpy as np
import pytest

import kaidan
from kaidan import contact
from kaidan.contact import Placement, settle
from kaidan.errors import InputError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models import judge, planned
from kaidan.models.traction import standing
from kaidan.modes import FLIPPER_TORQUE, POSTURE_CHANGE, SLIDES_DOWN, Phase
from kaidan.outline import Outline
from kaidan.question import Question
from kaidan.robot import Posture, PostureChange, Robot, State
from kaidan.terrain.profile import Profile
from kaidan.text.assessment import text
from kaidan.traversal.moves import angles_of, move

ABSOLEM = Robot.named("absolem")
ARMED = Robot.model_validate(
    ABSOLEM.model_dump() | {"states": {"arm-out": {"mass": 5.0, "forward": 0.3, "up": 0.1}}}
)
FLOOR = np.array([(-9.0, 0.0), (9.0, 0.0)])


def question(flippers="flat", robot=ABSOLEM, stairs="ibc", **manner):
    return Question.of(robot, stairs, flippers=flippers, **({"friction": 0.9} | manner))


# how they are written


@pytest.mark.parametrize(
    "text",
    [
        "stowed",
        "flat",
        "20deg,-5deg",
        "stowed,-5.5deg",
        "stowed+arm-out",
        "flat/land:-60deg,-20deg",
        "30deg,0deg/traverse:flat+arm-out/land:-60deg,-20deg",
    ],
)
def test_a_plan_is_read_back_as_it_is_written(text):
    asked = question(text, ARMED)
    assert asked.flippers == text
    assert Question.from_json(asked.to_json()) == asked
    assert question((asked.posture, *asked.changes), ARMED) == asked
    assert Question.ask(asked, friction=0.9) == asked


def test_one_angle_does_for_one_pair():
    sheet = ABSOLEM.model_dump() | {"rear_flippers": None}
    asked = question("0deg/land:-30deg", Robot.model_validate(sheet))
    assert asked.posture == Posture(front=0.0)
    assert asked.flippers == "0deg/land:-30deg"


def test_best_is_to_be_found_before_it_is_judged():
    asked = question("best")
    assert asked.best_of == ("flippers", "facing")
    assert question("best", facing="tail-first").best_of == ("flippers",)
    with pytest.raises(InputError) as refused:
        _ = asked.stance
    assert str(refused.value) == (
        "flippers = best has to be found first; state stowed, flat, angles or a plan"
    )


def test_phases_keep_the_posture_until_it_changes():
    asked = question("flat/land:-60deg,-20deg")
    landing = Posture(front=math.radians(-60), rear=math.radians(-20))
    flat = Posture(front="flat", rear="flat")
    assert asked.postures == {Phase.ENTER: flat, Phase.TRAVERSE: flat, Phase.LAND: landing}
    assert asked.stance == question("flat").stance  # that on the flight


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "flat/up:stowed",
            "flippers 'up:stowed': write a change as traverse:POSTURE or land:POSTURE, for "
            "example flat/land:-60deg,-20deg",
        ),
        (
            "flat/land:stowed/traverse:stowed",
            "changes of posture before land, traverse: name each phase once, in order",
        ),
        ("flat+arm", "robot 'absolem' has no state 'arm'; known: arm-out"),
        ("flat/land:20deg", "flippers '20deg' is one angle for two pairs; write FRONT,REAR, for "
                            "example 20deg,-5deg"),
    ],
)  # fmt: skip
def test_what_is_no_plan_is_refused(text, said):
    with pytest.raises(InputError) as refused:
        question(text, ARMED)
    assert str(refused.value) == said


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ({"yaw": 0.1}, "a plan of postures is driven straight on: leave the yaw out"),
        ({"model": "physics"}, "a trial keeps one posture: state angles, flat or stowed"),
        (
            {"stairs": Profile.of_points([(-3, 0), (0, 0), (2, 0.5), (5, 0.5)])},
            "a plan of postures needs a nosing to change before",
        ),
    ],
)
def test_where_no_plan_can_be_carried_out(manner, said):
    with pytest.raises(InputError) as refused:
        question("flat/land:stowed", **manner)
    assert str(refused.value) == said


# states of arm and payload


def test_a_state_moves_the_centroid():
    """By hand: 5 of 38.7 kg moved by 0.3 m ahead and 0.1 m up."""
    share = 5.0 / 38.7
    before, after = ARMED.stance(), ARMED.stance(Posture(state="arm-out"))
    assert after.com_from_front == pytest.approx(before.com_from_front - share * 0.3)
    assert after.com_height == pytest.approx(before.com_height + share * 0.1)
    whole = Robot.model_validate(ARMED.model_dump() | {"states": {"out": {"forward": 0.02}}})
    moved = whole.stance(Posture(state="out"))
    assert moved.com_from_front == pytest.approx(before.com_from_front - 0.02)


def test_a_state_needs_a_robot_that_heavy():
    with pytest.raises(InputError, match=r"states\.arm\.mass = 50 kg needs a robot of known"):
        Robot.model_validate(ABSOLEM.model_dump() | {"states": {"arm": State(mass=50.0)}})


# a change of posture


def level(one, two, robot=ABSOLEM, **others):
    outline = Outline.of(robot, one)
    start = settle(FLOOR, outline.parts, 0.0, 0.0, kinds=outline.kinds)
    place = Placement(0.0, start.z, start.inclination)
    return move(robot, one, two, before=Phase.LAND, start=place, ground=FLOOR, **others)


def test_a_flipper_pushed_down_raises_the_nose():
    """By hand: a line that touches the rear end disc and the tip of the front flipper."""
    pair, track = ABSOLEM.front_flippers, ABSOLEM.track
    down = math.radians(-40)
    found = level(Posture(), Posture(front=down))
    x = track.flat_length + pair.length * math.cos(down)  # from the rear axle to the tip's
    z = pair.length * math.sin(down)
    reach = math.hypot(x, z)
    slope = math.asin((pair.tip_radius - track.rear_radius) / reach) - math.atan2(z, x)
    assert found.stands
    assert found.rocks == 0.0
    assert found.end.inclination == pytest.approx(slope, abs=1e-9)
    assert found.turn == pytest.approx(math.radians(130))
    assert found.seconds == pytest.approx(math.radians(130) / pair.max_speed)


def test_the_torque_is_that_of_the_load_on_the_tip():
    """By hand: moments about the rear contact, upright forces on level ground."""
    pair = ABSOLEM.front_flippers
    down = math.radians(-40)
    found = level(Posture(), Posture(front=down))
    end = found.poses[-1]
    outline = Outline.of(ABSOLEM, Posture(front=down))
    c, s = math.cos(end.place.inclination), math.sin(end.place.inclination)
    (flipper,) = (part for part in outline.parts[1:] if part[0] > 0)
    pivot, tip, rear = (c * x - s * z for x, z in (flipper[:2], flipper[3:5], outline.parts[0, :2]))
    load = 38.7 * STANDARD_GRAVITY * -rear / (tip - rear)
    own = pair.mass * STANDARD_GRAVITY * pair.com_from_pivot * math.cos(down)
    assert end.torque["front"] == pytest.approx(load * (tip - pivot) + own)
    assert math.isnan(found.spare_torque)  # the sheet states no largest torque


def test_too_little_torque_is_no_go():
    weak = ABSOLEM.front_flippers.model_copy(update={"max_torque": 5.0})
    robot = ABSOLEM.model_copy(update={"front_flippers": weak, "rear_flippers": weak})
    found = judge(question("flat/land:-60deg,-20deg", robot, friction=2.0))
    assert found.of(FLIPPER_TORQUE).worst[0] < 0
    answer = kaidan.assess(question("30deg,0deg/land:-60deg,-20deg", robot, friction=2.0))
    assert (answer.verdict, answer.governs) == ("no-go", "flipper_torque")


def test_tail_first_is_the_mirror_image():
    """The same robot built the other way round moves alike."""
    mirrored = ABSOLEM.model_copy(
        update={"com_from_front": ABSOLEM.track.flat_length - ABSOLEM.com_from_front}
    )
    one, two = Posture(), Posture(front=math.radians(-40), rear=math.radians(10))
    swapped = Posture(front=two.rear, rear=two.front)
    start = Placement(0.0, ABSOLEM.com_height, 0.0)
    how = {"before": Phase.LAND, "start": start, "ground": FLOOR}
    nose = move(ABSOLEM, one, two, **how)
    tail = move(mirrored, one, swapped, **how, facing="tail-first")
    assert tail.end == pytest.approx(nose.end)
    for a, b in zip(nose.poses, tail.poses, strict=True):
        assert b.torque["rear"] == pytest.approx(a.torque["front"])


def test_a_state_moves_after_the_flippers():
    found = level(Posture(), Posture(front=0.0, state="arm-out"), ARMED)
    assert [each.front for each in found.poses[-2:]] == [0.0, 0.0]
    still = level(Posture(), Posture(state="arm-out"), ARMED)
    assert (still.turn, still.seconds, len(still.poses)) == (0.0, 0.0, 2)
    assert still.poses[1].place.x == pytest.approx(5.0 / 38.7 * 0.3)


def test_angles_of_words():
    angles = angles_of(ABSOLEM, Posture(front="flat"))
    pair = ABSOLEM.front_flippers
    assert angles == {"front": pair.flat_angle, "rear": pair.stowed_angle}


# what a plan comes to


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_a_traverse_in_parts_is_the_traverse(direction, facing):
    """A plan that changes nothing but the spelling is driven in three parts, and is as in one."""
    flat = math.radians(round(math.degrees(ABSOLEM.front_flippers.flat_angle), 9))
    numbers = PostureChange(before="traverse", posture=Posture(front=flat, rear=flat))
    words = PostureChange(before="land", posture=Posture(front="flat", rear="flat"))
    manner = {"direction": direction, "facing": facing, "friction": 1.1}
    whole = question("flat", **manner)
    parts = question((whole.posture, numbers, words), **manner)
    assert len(planned.drive(parts).parts) == 3
    one, other = judge(whole), judge(parts)
    # between poses 5 mm apart friction is followed to a share of 1e-4
    assert other.required_friction == pytest.approx(one.required_friction, rel=1e-4)
    for each in one.each:
        again = other.of(each.mode)
        if each.mode.key == "energy":  # standing 50 mm before the top one stands on less
            assert again.worst[0] <= each.worst[0] + 1e-9
            continue
        tolerance = 2e-4 if each.mode is SLIDES_DOWN else 1e-6  # rad, as friction above
        assert again.worst == pytest.approx(each.worst, abs=tolerance, nan_ok=True), each.mode.key
        assert again.best == pytest.approx(each.best, abs=tolerance, nan_ok=True), each.mode.key
        assert again.if_fails is each.if_fails
    assert other.of(POSTURE_CHANGE).worst[0] == math.inf


def test_the_same_posture_throughout_is_no_change():
    plan = question("flat/traverse:flat/land:flat")
    driven = planned.drive(plan)
    assert (len(driven.parts), driven.moves) == (1, ())
    same = kaidan.assess(question("flat"))
    answer = kaidan.assess(plan)
    assert answer.findings["slides_down"] == same.findings["slides_down"]
    assert answer.contact.phases == same.contact.phases


def test_another_posture_lands_gently():
    """Flat it comes down onto the landing by the slope; pushed down the front flippers meet it."""
    flat = kaidan.assess(question("30deg,0deg/traverse:flat"))
    gentle = kaidan.assess(question("30deg,0deg/traverse:flat/land:-60deg,-20deg"))
    assert flat.contact.grades.largest_drop_deg == pytest.approx(flat.angle_deg, abs=0.5)
    assert gentle.contact.grades.largest_drop_deg < 5
    assert (flat.governs, flat.verdict, gentle.verdict) == ("impact", "rough", "go")


def test_a_fall_ends_the_plan():
    wall = kaidan.Stairs(rise=0.5, going=0.3, steps=3)
    plan = question("stowed/land:flat", stairs=wall)
    driven = planned.drive(plan)
    assert len(driven.parts) == 1
    assert not driven.arrived
    answer = kaidan.assess(plan)
    assert answer.verdict == "no-go"
    assert not answer.contact.grades.arrested


def test_the_poses_of_a_change_are_those_of_each_posture_alone():
    # oracle: each posture driven a tenth of a millimetre on from where it stands
    asked = question("35deg,-13deg/land:-75deg,-13deg", friction="0.6..1.0")
    change = planned.drive(asked).moves[0]
    assert len(change.poses) > 10
    ground = change.path.ground.points
    for each in change.poses:
        x, _, phi = each.place
        alone = contact.traverse(
            ground, each.outline.parts, x, x + 1e-4, kinds=each.outline.kinds, inclination=phi
        )
        assert each.place == pytest.approx(alone.poses.placement(0), abs=1e-9)
        assert each.required_friction == pytest.approx(alone.margins.required_friction[0], rel=1e-6)
        assert each.energy == pytest.approx(alone.margins.energy[0], abs=1e-9)
    needed = max(math.atan(each.required_friction) for each in change.poses)
    expected = [math.atan(mu) - needed for mu in (0.6, 1.0)]
    required = math.tan(needed)
    assert standing(asked, change) == pytest.approx((*expected, required), abs=1e-12)


@pytest.mark.parametrize("friction", [None, 0.3])
@pytest.mark.parametrize(
    ("robot", "flippers", "direction"),
    [
        ("absolem", "flat", "down"),
        ("absolem", "stowed,-13deg/traverse:-48deg,-32deg", "up"),
        ("marv", "stowed,-13deg/traverse:-48deg,-32deg", "up"),
    ],
)
def test_the_friction_required_has_one_place(robot, flippers, direction, friction):
    """In the reason, in the row of the friction, and of the phase that requires as much."""
    answer = kaidan.assess(
        robot, "ibc", flippers=flippers, friction=friction, direction=direction, surface=None
    )
    slides = answer.findings["slides_down"]
    place = f"({slides.phase}, step {slides.step})"
    number = f"{answer.required_friction:.2f}"
    assert f"Friction decides {place}: {number} is required" in answer.reason
    row = next(line for line in text(answer).splitlines() if line.startswith("  friction"))
    assert f"{number} required" in row
    assert place in row
    assert answer.contact is not None
    of_phase = next(each for each in answer.contact.phases if each.phase == slides.phase)
    assert of_phase.required_friction == pytest.approx(answer.required_friction, rel=1e-3)
    assert of_phase.required_friction_step == slides.step
