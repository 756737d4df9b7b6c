"""What limits a robot on stairs, where nothing helps: by the contact model too."""

import math

import pytest

from kaidan import Profile, Robot, Stairs
from kaidan.assessment.limits import limits
from kaidan.mechanics.transitions import largest_step_height
from kaidan.question import Question
from one_posture import assess

FLIGHT = Stairs(name="flight", rise=0.174, going=0.27, steps=8)
TRACK = {"flat_length": 0.52, "front_radius": 0.085, "rear_radius": 0.085}
SHORT = Robot(name="short", mass=24.5, com_from_front=0.255, com_height=0.146, track=TRACK)
LONG = Robot(
    name="long", mass=60.0, com_from_front=0.40, com_height=0.12,
    track={"flat_length": 0.9, "front_radius": 0.1, "rear_radius": 0.1},
)  # fmt: skip


def of(robot, terrain=FLIGHT, **manner):
    return limits(Question.in_one_posture(robot, terrain, friction=1.5, **manner))


def names(found):
    return [each.figure for each in found]


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


def test_of_several_flights_the_longest_step_and_the_highest_riser_count():
    steep = Stairs(name="steep", rise=0.2, going=0.2, steps=4)
    long = Stairs(name="long", rises=(0.1, 0.1, 0.1), goings=(0.35, 0.3))
    for flights in ([steep, long], [long, steep]):
        spacing, riser = of(SHORT, flights)
        assert spacing.has_m == pytest.approx(math.hypot(0.1, 0.35))
        assert riser.has_m == pytest.approx(0.2)


def test_a_profile_is_limited_as_the_flight_that_it_is():
    figures = [
        [(each.figure, each.has_m, each.takes_m, each.needs_m) for each in found]
        for found in (of(SHORT), of(SHORT, Profile.of_flights([FLIGHT])))
    ]
    assert figures[1] == [(name, *map(pytest.approx, rest)) for name, *rest in figures[0]]


def test_without_steps_no_spacing_limits_and_without_an_edge_no_riser():
    kerb = Profile.of_points([(-3, 0), (0, 0), (0, 0.3), (3, 0.3)])
    assert names(of(SHORT, kerb)) == ["rise"]
    assert of(SHORT, Profile.of_points([(-3, 0), (3, 0)])) == ()


def test_tail_first_the_centroid_counts_from_the_tail():
    mirrored = SHORT.with_centroid(0.52 - SHORT.com_from_front, SHORT.com_height)
    tail, nose = of(SHORT, facing="tail-first"), of(mirrored)
    assert names(tail) == names(nose) == ["nosing_spacing", "rise"]
    assert tail[1].takes_m == pytest.approx(nose[1].takes_m)
    assert tail[1].needs_m == nose[1].needs_m


def test_the_centroid_asked_for_is_told_in_whole_millimetres_and_is_enough():
    (needs,) = (each.needs_m for each in of(SHORT) if each.figure == "rise")
    assert needs * 1e3 == pytest.approx(round(needs * 1e3), abs=1e-9)
    for along, enough in ((needs, True), (needs + 1.1e-3, False)):
        height = largest_step_height(l_c=0.52 - along, C_N=SHORT.com_height, R=0.085)
        assert (height >= 0.174) == enough


def test_who_lifts_an_end_with_flippers_pivots_over_no_edge_as_a_plain_track():
    pair = {"length": 0.3, "root_radius": 0.085, "tip_radius": 0.04, "pivot_height": 0.085}
    robot = Robot(
        name="with flippers", mass=24.5, com_from_front=0.255, com_height=0.146, track=TRACK,
        front_flippers=pair,
    )  # fmt: skip
    assert names(of(robot, flippers="stowed")) == ["nosing_spacing", "rise"]
    assert names(of(robot, flippers="-20deg")) == ["nosing_spacing"]
