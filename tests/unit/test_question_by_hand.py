"""What follows from a question: what it leaves open, its flights, its yielding track."""

import math

import numpy as np
import pytest

from kaidan import InputError, Posture, Profile, Question, Robot, Stairs, Surface
from kaidan.mechanics.yielding import yielding_loss
from kaidan.question.yielding import FASTEST_YIELDING, _radius_downhill
from kaidan.robot import Track

KERB = Profile.of_points([(-2, 0), (0, 0), (0, 0.1), (2, 0.1)])
FLIGHT = Stairs(name="flight", rise=0.1, going=0.15, steps=8)
BOTH = ("flippers", "facing")


def plain(**more):
    return Robot(
        name="plain", com_from_front=0.25, com_height=0.1,
        **{"mass": 20.0, "track": {"flat_length": 0.5, "gauge": 0.3}} | more,
    )  # fmt: skip


def of(robot="absolem", terrain=FLIGHT, **manner):
    return Question.of(robot, terrain, **manner)


def test_questions_that_differ_in_one_figure_are_not_equal():
    assert of() == of()
    assert of() != of(risk=0.02)


def test_what_a_question_leaves_open():
    assert of().best_of == BOTH
    assert of(facing="tail-first").best_of == ("flippers",)
    assert of(plain()).best_of == ("facing",)
    assert of(flippers="flat").best_of == ()


def test_asked_again_it_leaves_open_what_it_left_open():
    assert Question.ask(of(), friction=1.0).best_of == BOTH
    tail_first = Question.ask(of(facing="tail-first"), friction=1.0)
    assert (tail_first.best_of, tail_first.facing) == (("flippers",), "tail-first")
    stated = of(flippers="flat", facing="tail-first")
    again = Question.ask(stated, friction=1.0)
    assert (again.best_of, again.posture, again.facing) == ((), stated.posture, "tail-first")
    assert Question.ask(stated, flippers="best").best_of == BOTH


def test_what_knows_no_plan_is_asked_stowed_unless_a_posture_is_stated():
    assert Question.in_one_posture("absolem", FLIGHT).best_of == ()
    assert Question.in_one_posture("absolem", FLIGHT).posture == Posture()
    flat = of(flippers="flat").posture
    assert Question.in_one_posture("absolem", FLIGHT, flippers="flat").posture == flat != Posture()
    assert Question.in_one_posture(of()) == of()


@pytest.mark.parametrize(
    ("manner", "plannable", "degrees"),
    [
        ({}, True, 2.0), ({"yaw": 0.1}, False, 0.0), ({"model": "closed-form"}, False, 0.0),
        ({"flippers": "flat"}, True, 0.0), ({"flipper_tolerance": "3deg"}, True, 3.0),
    ],
)  # fmt: skip
def test_where_angles_are_found_they_may_be_off_by_2_degrees(manner, plannable, degrees):
    question = of(**manner)
    assert question.plannable is plannable
    assert math.degrees(question.tolerance) == pytest.approx(degrees)


def test_friction_is_that_of_the_nosings():
    surface = Surface.of_friction(0.5, 0.0).model_dump() | {"nosings": {"low": 0.7, "high": 0.9}}
    assert of(surface=Surface.model_validate(surface)).friction == (0.7, 0.9)


def test_what_is_uncertain():
    exact = of(plain())
    assert exact.spread == (0.0,) * 6
    assert not exact.uncertain
    assert not exact.steps_uncertain
    ramp = Profile.of_points([(-2, 0), (0, 0), (2, 0.5), (4, 0.5)])
    assert of(plain(), ramp).spread == (0.0,) * 6
    robot, steps = (of(plain(), uncertainty=each) for each in ("com_height=5mm", "rise=3mm"))
    assert robot.uncertain
    assert not robot.steps_uncertain
    assert steps.uncertain
    assert steps.steps_uncertain


def test_one_flight_is_a_flight():
    assert of().changed(terrain=(FLIGHT,)).terrain == FLIGHT


def test_a_profile_that_falls_is_driven_down_and_seen_from_the_other_side():
    falls = Profile.of_points([(-2, 0.2), (0, 0.2), (0, 0.1), (0.3, 0.1), (0.3, 0), (2, 0)])
    assert of(terrain=falls, direction="down").profile.points[-1, 1] == 0.2
    with pytest.raises(InputError):
        of(terrain=falls, direction="up")


@pytest.mark.parametrize(
    ("flights", "room"),
    [
        ([{}], None), ([{"width": 0.9}], (math.inf, 0.9)), ([{"headroom": 2.1}], (2.1, math.inf)),
        ([{"width": 1.0, "headroom": 2.0}, {"width": 0.9, "headroom": 2.1}], (2.0, 0.9)),
    ],
)  # fmt: skip
def test_room_is_the_least_of_its_flights(flights, room):
    """A height, and the width that is clear up to it; infinite: not stated."""
    sheets = [Stairs(rise=0.1, going=0.15, steps=8, **each) for each in flights]
    found = of(terrain=sheets).room
    assert (found and found.openings) == (room and (room,))


def test_a_profile_has_no_doors():
    assert of(terrain=KERB).leaves == (0.0, 0.0)


LISTED = {"rises": (0.1, 0.12, 0.1), "goings": (0.15, 0.15)}


@pytest.mark.parametrize(
    ("sheet", "yaw", "uneven"),
    [
        (LISTED, 0.0, False), (LISTED, 0.1, True),
        ({"rise": 0.1, "going": 0.15, "steps": 3}, 0.1, False),
        (LISTED | {"cross_slopes": (0.02,)}, 0.0, True),
    ],
)  # fmt: skip
def test_the_tracks_meet_other_steps(sheet, yaw, uneven):
    assert of(plain(), Stairs(**sheet), yaw=yaw).uneven_across is uneven


def test_of_several_flights_one_twisted_is_enough():
    assert of(plain(), [FLIGHT, Stairs(**LISTED, cross_slopes=(0.02,))]).uneven_across


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ({"trials": 3}, "trials goes with the physics alone"),
        ({"track": "yielding-belt"}, "track goes with the physics alone"),
        ({"model": "physics", "flippers": "best"}, "a trial keeps one posture"),
        ({"model": "physics", "flippers": "flat/land:stowed"}, "a trial keeps one posture"),
        ({"flippers": "flat/land:stowed", "terrain": KERB}, None),
        ({"model": "physics", "trials": 3}, None),
    ],
)
def test_what_goes_with_the_physics_and_with_a_plan(manner, said):
    if said is None:
        assert of(**manner)
        return
    with pytest.raises(InputError, match=said):
        of(**manner)


# a yielding track

SOFT = {"indentation": 0.002, "sag": 0.003}


def soft(mass=20.0, **track):
    sheet = {"flat_length": 0.75, "front_radius": 0.05, "rear_radius": 0.06} | SOFT | track
    return Robot(name="soft", mass=mass, com_from_front=0.33, com_height=0.12, track=Track(**sheet))


def allowance(robot, terrain=FLIGHT, **manner):
    return Question.in_one_posture(robot, terrain, **{"friction": 1.0} | manner).allowance_d


def lost(**more):
    given = {
        "L": 0.75, "p": FLIGHT.nosing_spacing, "C_L": 0.33, "C_N": 0.12, "w_n": 0.002,
        "w_t": 0.003, "R": 0.06, "mu": 1.0, "speed": 0.1, "gyration": 0.75 / math.sqrt(12.0),
    }  # fmt: skip
    return pytest.approx(float(yielding_loss(**given | more)), abs=1e-12)


def test_tail_first_the_other_end_is_uphill():
    assert allowance(soft(), facing="tail-first").high == lost(C_L=0.42, R=0.05)


@pytest.mark.parametrize("speed", [0.05, 0.3, 5.0])
def test_a_tail_that_grips_counts_the_speed_as_far_as_it_was_tried(speed):
    high = allowance(soft(), friction=None, speed=speed).high
    assert high == lost(mu=math.inf, speed=min(speed, FASTEST_YIELDING))


def test_a_robot_of_no_known_mass_yields_as_its_sheet_says():
    assert allowance(soft(mass=None)).high == lost()


def test_a_landing_that_is_too_long_to_stand_on_costs_nothing():
    line = [(-2, 0), (0, 0), (0, 0.1), (0.2, 0.1), (0.2, 0.2), (1.2, 0.2), (1.2, 0.3), (3, 0.3)]
    assert allowance(soft(), Profile.of_points(line)).high == lost(p=math.hypot(0.2, 0.1))


def test_with_grousers_the_default_is_the_least_at_any_length():
    question = Question.in_one_posture(soft(belt="grousers"), FLIGHT, friction=1.0)
    found = question.theta_d_at(L=0.75, p=np.array([0.18]), C_L=0.33, C_N=0.12)
    assert found == pytest.approx([math.radians(2.6)])


@pytest.mark.parametrize(
    ("flippers", "facing", "radius"),
    [
        ("stowed", "nose-first", 0.06), ("stowed", "tail-first", 0.05),
        ("flat", "nose-first", 0.03), ("flat", "tail-first", 0.04),
        ("flat,90deg", "nose-first", 0.06),
    ],
)  # fmt: skip
def test_the_flat_ends_downhill_on_the_track_or_on_a_flipper(flippers, facing, radius):
    pairs = {
        f"{end}_flippers": {
            "length": 0.3, "root_radius": base, "tip_radius": tip, "pivot_height": base,
        }
        for end, base, tip in (("front", 0.05, 0.04), ("rear", 0.06, 0.03))
    }  # fmt: skip
    robot = Robot.model_validate(soft().model_dump() | pairs)
    assert _radius_downhill(of(robot, flippers=flippers, facing=facing)) == radius
