"""What limits a robot on stairs, where nothing helps: by the contact model too."""

import math

import pytest

from kaidan import Robot, Stairs
from kaidan.assessment.limits import limits
from kaidan.question import Question
from one_posture import assess

FLIGHT = Stairs(name="flight", rise=0.174, going=0.27, steps=8)
TRACK = {"flat_length": 0.52, "front_radius": 0.085, "rear_radius": 0.085}
SHORT = Robot(name="short", mass=24.5, com_from_front=0.255, com_height=0.146, track=TRACK)
LONG = Robot(
    name="long", mass=60.0, com_from_front=0.40, com_height=0.12,
    track={"flat_length": 0.9, "front_radius": 0.1, "rear_radius": 0.1},
)  # fmt: skip


def of(robot, **manner):
    return limits(Question.in_one_posture(robot, FLIGHT, friction=1.5, **manner))


def test_a_short_robot_is_told_its_length_and_its_centroid():
    spacing, riser = of(SHORT)
    p = math.hypot(0.174, 0.27)
    assert (spacing.figure, spacing.has_m, spacing.takes_m) == (
        "nosing_spacing", pytest.approx(p), 0.26,
    )  # fmt: skip
    assert spacing.needs_m == pytest.approx(2 * p)
    assert (riser.figure, riser.has_m, riser.needs) == (
        "rise",
        pytest.approx(0.174),
        "com_from_uphill_end",
    )
    answer = assess(SHORT, FLIGHT, friction=1.5)
    assert answer.limits == (spacing, riser)
    assert answer.verdict == "no-go"
    assert "  limit           L carries a nosing spacing up to 260 mm, not 321 mm" in str(answer)
    assert "nothing" not in str(answer)


def test_the_contact_model_enters_with_the_centroid_that_the_limit_asks_for():
    """5 mm on either side: the edge bears on the flat there, on the round end before."""
    (needs,) = (each.needs_m for each in of(SHORT) if each.figure == "rise")
    for off, falls in ((-0.005, False), (0.005, True)):
        robot = SHORT.with_centroid(needs + off, SHORT.com_height)
        found = assess(robot, FLIGHT, friction=1.5)
        assert found.phase == "enter"
        assert ("It falls over its downhill end" in found.reason) is falls


def test_who_is_long_enough_has_none_and_tail_first_is_the_other_end():
    assert of(LONG) == ()
    assert assess(LONG, FLIGHT, friction=1.5).limits == ()
    tail = of(SHORT.with_centroid(0.52 - 0.14, 0.146), facing="tail-first")
    assert [each.figure for each in tail] == ["nosing_spacing"]
    assert of(SHORT, direction="down") == ()


def test_no_centroid_is_far_enough_forward_for_a_riser_that_is_too_high():
    tall = Stairs(name="tall", rise=0.5, going=0.6, steps=4)
    (riser,) = (
        each for each in limits(Question.in_one_posture(SHORT, tall)) if each.figure == "rise"
    )
    assert riser.needs_m is None
    assert "would)" not in str(assess(SHORT, tall, friction=2.0)).split("riser")[1]


def test_a_riser_too_high_and_a_rear_length_too_short_are_one():
    """Two formulas of the same pose: the height of the single step, and A of the rear length."""
    for rise in (0.10, 0.14, 0.18, 0.24):
        flight = Stairs(rises=(0.10, rise, 0.10, 0.10), goings=(0.30, 0.30, 0.30))
        answer = assess(SHORT, flight, friction=3.0)
        short = answer.contact.rear_length_mm < 0
        assert [each.has_m for each in answer.limits if each.figure == "rise"] == (
            [pytest.approx(rise)] if short else []
        )
        assert str(answer).count("a riser up to") == short
        assert "rear length" not in str(answer)
