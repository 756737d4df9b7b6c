"""What a plan comes to, and the flight on which plans are compared, by hand."""

import math
from types import SimpleNamespace

import pytest

from kaidan.assessment import plan_judged
from kaidan.models.quasi_static import Basis
from kaidan.question import Question
from kaidan.robot import FlipperPair, Robot, Track
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs

PAIR = FlipperPair(length=0.3, root_radius=0.06, tip_radius=0.03, pivot_height=0.06)
INSET = PAIR.model_copy(update={"pivot_inset": 0.2})


def robot(L, R, **given):
    track = Track(flat_length=L, front_radius=R, rear_radius=R)
    return Robot(name="r", com_from_front=L / 2, com_height=0.1, track=track, **given)


@pytest.mark.parametrize(
    ("one", "going", "steps", "expected"),
    [
        # from end to end 0.62 m, nosings 0.2 m apart: 3.1, so 4 and two more
        (robot(0.5, 0.06), 0.16, 20, 6),
        (robot(0.5, 0.06), 0.16, 6, 6),
        (robot(0.5, 0.06), 0.16, 5, 5),
        # a flipper, stowed inside, reaches 0.33 m beyond the axle, the track 0.06 m: 0.89 m
        (robot(0.5, 0.06, rear_flippers=PAIR, mass=20.0), 0.16, 20, 7),
        # an axle 0.2 m inside: 0.69 m
        (robot(0.5, 0.06, rear_flippers=INSET, mass=20.0), 0.16, 20, 6),
        (robot(0.5, 0.06, front_flippers=PAIR, rear_flippers=PAIR, mass=20.0), 0.16, 20, 8),
        # 0.26 m: less than one nosing; five are driven at least
        (robot(0.2, 0.03), 0.5, 20, 5),
    ],
)
def test_a_flight_just_long_enough(one, going, steps, expected):
    stairs = Stairs(rise=0.12, going=going, steps=steps)
    question = Question.in_one_posture(one, stairs, friction=1.0)
    short = plan_judged.shortened(question).terrain
    assert short.steps == expected
    assert (short.rise, short.going) == (0.12, going)


def test_the_tip_of_a_flipper_reaches_on_by_its_radius():
    """0.25 m to the axle, 0.3 and 0.03 m beyond it; behind, 0.25 m and an end of 0.06 m."""
    one = robot(0.5, 0.06, front_flippers=PAIR, mass=20.0)
    assert plan_judged.stretched(one) == pytest.approx(0.25 + 0.3 + 0.03 + 0.25 + 0.06)


@pytest.mark.parametrize(
    "terrain",
    [
        Profile.of_stairs(Stairs(rise=0.12, going=0.16, steps=20)),
        Stairs(rises=[0.12, 0.13] * 10, goings=[0.16] * 19),
    ],
)
def test_what_does_not_repeat_itself_stays_as_it_is(terrain):
    question = Question.in_one_posture(robot(0.5, 0.06), terrain, friction=1.0)
    assert plan_judged.shortened(question) is question


def driven(*angles, arrived=True):
    return SimpleNamespace(
        chains=[SimpleNamespace(angle=math.radians(each)) for each in angles], arrived=arrived
    )


@pytest.mark.parametrize(
    ("parts", "drop", "arrives"),
    [
        ([], 0.0, True),
        ([driven()], 0.0, True),
        ([driven(0.2, 0.4)], 0.4, True),
        ([driven(5.0, -20.0), driven(9.0)], 20.0, True),
        ([driven(5.0), driven(9.0, arrived=False)], 9.0, False),
        ([driven(5.0, arrived=False), driven(9.0, arrived=False)], 9.0, False),
    ],
)
def test_its_largest_rotation_and_whether_it_arrives(parts, drop, arrives, monkeypatch):
    monkeypatch.setattr(plan_judged, "conclude", lambda *_: None)
    found = SimpleNamespace(basis=Basis(None, SimpleNamespace(parts=[
        SimpleNamespace(traverse=each) for each in parts
    ])))  # fmt: skip
    judged = plan_judged.judged_of(None, found)
    assert judged.drop == pytest.approx(drop)
    assert judged.arrives is arrives
