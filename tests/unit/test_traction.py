"""Friction and grousers in answers: sheets, figures, texts."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from kaidan import InputError, Robot, Stairs, Surface
from kaidan.models.belts import grousers_of
from kaidan.models.quasi_static import traverse_of
from kaidan.models.sentences.traction import notes
from kaidan.models.traction import supply
from kaidan.modes import Phase
from kaidan.question import Question
from kaidan.robot import Track
from kaidan.surface import Friction
from one_posture import assess

LONG = {"name": "long", "com_from_front": 0.5, "com_height": 0.12, "mass": 40.0}
TRACK = {"flat_length": 1.0, "front_radius": 0.15, "rear_radius": 0.1}
GROUSERS = {"belt": "grousers", "grouser_height": 0.015, "grouser_spacing": 0.05}
HARD = {"grouser_tip_width": 0.006, "grouser_hardness": 90.0, "width": 0.1}
FLIGHT = Stairs(rise=0.14, going=0.22, steps=6, nosing_radius_low=0.002, nosing_radius_high=0.004)


def robot(**track):
    return Robot(**LONG, track=TRACK | track)


def asked(friction=0.6, **track):
    return assess(robot(**track), FLIGHT, friction=friction)


@pytest.mark.parametrize(
    ("track", "text"),
    [
        (
            {"belt": "smooth", "grouser_height": 0.01},
            "robot: track: belt is smooth, but grouser_height = 0.01",
        ),
        (
            {"grouser_spacing": 0.02, "grouser_tip_width": 0.03},
            "robot: track: grouser_tip_width = 0.03 m is not less than grouser_spacing = 0.02 m",
        ),
    ],
)
def test_belts_refuse_to_the_letter(track, text):
    with pytest.raises(InputError) as told:
        Track(**TRACK | track)
    assert str(told.value) == text


def test_frictions_and_radii_refuse_to_the_letter():
    with pytest.raises(InputError, match=r"surface: friction: low = 0.9 is more than high = 0.5"):
        Friction(low=0.9, high=0.5)
    with pytest.raises(InputError, match=r"nosing_radius_low = 0.02 is more than nosing_radius_hi"):
        Stairs(rise=0.17, going=0.28, nosing_radius_low=0.02, nosing_radius_high=0.01)
    assert Stairs(rise=0.17, going=0.28, nosing_radius_low=0.04).nosing_radii == (0.04, 0.04)


def test_at_faces_rigid_grousers_hold_as_smooth_belts_on_less_friction():
    """Where no grouser stands, of ends alike: mu / (1 + h / R)^2 there, whatever the heights."""
    same = robot(front_radius=0.1, rear_radius=0.1)
    grip = traverse_of(Question.in_one_posture(same, FLIGHT)).grip
    phi, height = np.arctan([0.6, 0.7, 0.8]), 0.02
    faces = np.arctan(np.tan(phi[[0, 2]]) / (1.0 + height / 0.1) ** 2)
    smooth, found = (grip.by_friction((phi[0],) * 3, each) for each in (0.0, height))
    at_faces = found < smooth - 1e-3
    assert 0 < at_faces.sum() < len(found)
    less = grip.by_friction((phi[0], phi[0], faces[0]))
    assert found[at_faces] == pytest.approx(less[at_faces], abs=1e-12)
    assert (found <= smooth + 1e-6).all()
    unlike = grip.by_friction(tuple(phi), height)
    assert unlike == pytest.approx(grip.by_friction((phi[0], phi[1], faces[1])), abs=1e-12)


def test_a_smooth_belt_is_judged_by_friction_alone():
    stated, silent = asked(belt="smooth"), asked()
    assert stated.findings == silent.findings
    assert silent.traction.belt == "not stated"
    assert stated.required_friction == stated.traction.smooth_required_friction
    assert stated.traction.slip_mm is None
    assert "The sheet does not say whether the belts have grousers: smooth is assumed." in (
        silent.notes
    )


@pytest.mark.parametrize("direction", ["up", "down"])
def test_grousers_faster_than_they_were_tried_are_no_go(direction):
    """From 0.2 m/s on, whatever friction holds; the advice is to drive slower."""
    shoes = robot(**GROUSERS, **HARD)
    asks = {"friction": 2.0, "direction": direction}
    fast = assess(shoes, FLIGHT, speed=0.25, **asks)
    assert (fast.verdict, fast.governs) == ("unsure", "grouser_speed")
    assert "0.25 m/s on grousers; from 0.20 m/s on" in fast.reason
    assert ("Drive at 0.19 m/s or less", "go") in {
        (each.change, each.verdict) for each in fast.what_would_help
    }
    assert assess(shoes, FLIGHT, speed=0.2, **asks).governs == "grouser_speed"
    slow = assess(shoes, FLIGHT, speed=0.19, **asks)
    assert slow.verdict == "go"
    assert "grouser_speed" not in slow.findings
    assert "grouser_speed" not in assess(shoes, FLIGHT, **asks).findings
    smooth = assess(robot(), FLIGHT, speed=0.25, **asks)
    assert "grouser_speed" not in smooth.findings


def test_going_down_it_slips_on():
    answer = assess(robot(**GROUSERS, **HARD), FLIGHT, friction=0.6, direction="down")
    assert answer.verdict == "go"
    assert f"may slip on up to {answer.traction.slip_mm:.0f} mm" in str(answer)


def test_little_friction_to_spare_is_told_of_plans_that_turn_flippers_going_up():
    """Rigid teeth got stuck with up to 1.15 times the friction that the rule requires."""
    answer = asked(**GROUSERS, **HARD)
    needed = answer.traction.required_friction

    def told(times, direction="up", changes=("before the flight",)):
        question = SimpleNamespace(
            direction=direction, changes=changes, robot=answer.question.robot, yaw=0.0,
            surface=SimpleNamespace(of_parts=lambda: (times * needed,) * 3),
        )  # fmt: skip
        found = notes(question, answer.traction)
        return any(f"Little friction is to spare: below {1.2 * needed:.2f}" in one for one in found)

    assert [told(times) for times in (0.99, 1.01, 1.19, 1.21)] == [False, True, True, False]
    assert not told(1.01, direction="down")
    assert not told(1.01, changes=())


def test_grousers_hold_where_friction_does_not():
    smooth, answer = asked(), asked(**GROUSERS, **HARD)
    assert smooth.findings["slides_down"].holds is False
    assert answer.findings["slides_down"].holds is True
    assert answer.required_friction < 0.6 < smooth.required_friction
    assert answer.traction.slip_mm == pytest.approx(50.0)
    assert "holds on its grousers, may slip back up to 50 mm" in str(answer)
    height = max(answer.traction.slip_heights_mm.values())
    lost = smooth.findings["energy"].margin - answer.findings["energy"].margin
    assert 0 < lost <= height + 1e-9


def test_the_required_friction_is_where_it_begins_to_slip():
    answer = asked(**GROUSERS, **HARD)
    for more, holds in ((0.005, True), (-0.005, False)):
        then = asked(answer.required_friction + more, **GROUSERS, **HARD)
        assert then.findings["slides_down"].holds is holds


@pytest.mark.parametrize("height", [0.003, 0.005])
def test_the_friction_required_where_none_is_stated_is_just_enough(height):
    """At a face low rigid grousers round an end need more of it than a smooth belt does."""
    kenaf = Robot.named("kenaf")
    stairs = Stairs.inclined(angle=math.radians(40), nosing_spacing=0.150)
    figures = {"grouser_height": height, "grouser_spacing": 0.05, "grouser_tip_width": 0.01}
    belts = kenaf.model_copy(update={"track": kenaf.track.model_copy(update=figures)})
    required = assess(belts, stairs).traction.required_friction
    assert required > assess(kenaf, stairs).traction.required_friction + 0.02
    for more, holds in ((-1e-3, False), (1e-3, True)):
        margin = assess(belts, stairs, friction=required + more).findings["slides_down"].margin
        assert (margin > 0) is holds


def test_a_weak_grouser_counts_for_nothing():
    weak = asked(**GROUSERS, **HARD, grouser_strength=20.0)
    assert weak.traction.strength_margin_N < 0
    assert weak.findings["slides_down"] == asked().findings["slides_down"]
    assert any("does not bear half" in note for note in weak.notes)


def test_worst_and_best_case_bracket_what_is_stated():
    question = Question.in_one_posture(robot(belt="grousers"), FLIGHT, friction=0.55)
    found = traverse_of(question)
    loose = [supply(question, found, question.robot.track, best=best) for best in (False, True)]
    assert loose[0].margin <= loose[1].margin
    exact = Question.in_one_posture(robot(**GROUSERS, **HARD), FLIGHT, friction=0.55)
    one = supply(exact, found, exact.robot.track)
    assert loose[0].margin <= one.margin + 1e-9
    hard, soft = grousers_of(exact, exact.robot.track, best=False)
    assert hard.rigid
    assert not soft.rigid
    assert 0.0 < soft.height < hard.height == 0.015


def test_more_grouser_never_holds_less():
    margins = []
    question = Question.in_one_posture(robot(), FLIGHT, friction=0.5)
    found = traverse_of(question)
    for height in (0.0, 0.004, 0.008, 0.012, 0.016):
        track = Track(**TRACK | HARD, grouser_height=height, grouser_spacing=0.06)
        margins.append(supply(question, found, track).margin)
    assert np.all(np.diff(margins) >= -1e-6)


def test_going_down_the_same_flight_holds_too():
    answer = assess(
        robot(**GROUSERS, **HARD), FLIGHT, friction=0.55, direction="down"
    )  # fmt: skip
    assert answer.findings["slides_down"].holds is True
    assert answer.traction.smooth_required_friction > 0.6


def test_frictions_of_nosings_treads_and_faces_apart():
    general = {"friction_low": 0.9, "friction_high": 0.9}
    same = Surface(**general, risers=Friction(low=0.9, high=0.9))
    plain = assess(robot(), FLIGHT, friction=0.9)
    apart = assess(robot(), FLIGHT, surface=same)
    assert apart.findings["slides_down"].margin == pytest.approx(
        plain.findings["slides_down"].margin, abs=1e-4
    )
    slippery = Surface(**general, nosings=Friction(low=0.3, high=0.4))
    answer = assess(robot(), FLIGHT, surface=slippery)
    assert answer.friction == (0.3, 0.4)
    assert answer.findings["slides_down"].margin_best < 0


def test_without_a_friction_the_answer_says_what_grousers_would_make_of_it():
    answer = assess(robot(), FLIGHT)
    usual = answer.traction.usual_required_friction
    assert usual < answer.required_friction - 0.02
    assert f"({usual:.2f} with grousers of 10 mm every 40 mm)" in str(answer)
    assert "none is stated" in answer.reason


def test_at_a_yaw_grousers_do_not_count():
    given = {"gauge": 0.4, **GROUSERS, **HARD}
    answer = assess(robot(**given), FLIGHT, friction=0.55, yaw="5deg")
    assert answer.findings["slides_down"].holds is False
    assert "At a yaw grousers do not count: friction alone is judged." in answer.notes


@pytest.mark.parametrize(("first", "passes"), [(0.16, True), (0.25, False)])
def test_from_the_floor_grousers_pass_a_riser_up_to_about_r_h_and_half_a_spacing(first, passes):
    # R + h + s/2 = 0.19
    flight = FLIGHT.model_copy(update={"first_rise": first})
    question = Question.in_one_posture(robot(**GROUSERS, **HARD), flight, friction=0.55)
    found = traverse_of(question)
    smooth, held = (
        supply(question, found, track, phase=Phase.ENTER).required
        for track in (robot().track, question.robot.track)
    )
    assert smooth > 0.6
    assert (held < 0.6) is passes
