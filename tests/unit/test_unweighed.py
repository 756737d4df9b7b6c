"""Robots whose centroid nobody measured: sheets, verdicts, and where the verdict changes."""

import json
import math
from itertools import pairwise

import pytest

from kaidan import catalog, compare, sweep, traverse
from kaidan.assessment import Assessment
from kaidan.assessment.verdict import conclude
from kaidan.errors import InputError
from kaidan.models import judge
from kaidan.models.unweighed import HEIGHTS, PLACES
from kaidan.question import Question
from kaidan.robot import CentroidRange, Robot
from kaidan.terrain.stairs import Stairs
from one_posture import assess

TRACK = {"flat_length": 0.8, "front_radius": 0.1, "rear_radius": 0.1}
RANGE = {"from_front": (0.24, 0.48), "height": ("100mm", "240mm")}
FLIGHT = Stairs(name="flight", rise=0.18, going=0.28, steps=8)


def robot(**fields):
    return Robot.model_validate(
        {"name": "r", "track": TRACK, "com_range": RANGE, "mass": 50} | fields
    )


def weighed(along, height, **manner):
    return assess(robot().with_centroid(along, height), FLIGHT, friction=1.2, **manner)


@pytest.fixture(scope="module")
def answer():
    return assess(robot(), FLIGHT, friction=1.2)


def test_the_centroid_of_a_range_is_its_middle_where_it_is_left_out():
    assert (robot().com_from_front, robot().com_height) == pytest.approx((0.36, 0.17))
    assert robot(com_from_front=0.3).com_from_front == 0.3
    assert Robot.from_text(robot().to_toml(), origin="x") == robot()


@pytest.mark.parametrize(
    ("fields", "text"),
    [
        (
            {"com_range": {"from_front": (0.5, 0.3), "height": (0.1, 0.2)}},
            "robot: com_range: from_front: its low end 0.5 m is above its high end 0.3 m",
        ),
        (
            {"com_range": {"from_front": (0.3, 1.5), "height": (0.1, 0.2)}},
            "robot: com_range.from_front = 1.5 m puts the centroid outside the robot: allowed -0.1 "
            "to 0.9 m",
        ),
        ({"com_from_front": 0.6}, "robot: com_from_front and com_height are not within com_range"),
        (
            {"com_range": {"from_front": ("240", 0.48), "height": (0.1, 0.2)}},
            "robot: com_range: from_front[0] = '240' has no unit; write 240mm or 240cm or 240m",
        ),
    ],
)
def test_ranges_without_meaning_are_refused(fields, text):
    with pytest.raises(InputError) as caught:
        robot(**fields)
    assert str(caught.value).splitlines()[0].startswith(text)


def test_it_is_unsure_until_weighed(answer):
    assert (answer.verdict, answer.governs) == ("unsure", "unweighed")
    assert answer.reason == (
        "Until weighed: nobody measured its centroid, C_L 240 to 480 mm and C_N 100 to 240 mm "
        "assumed."
    )
    assert len(str(answer).splitlines()) <= 8
    assert answer.what_would_help[0].change.startswith("Weigh it (kaidan measure robot); at best")
    assert Assessment.from_json(answer.to_json()) == answer


def test_each_change_of_the_verdict_lies_where_the_weighed_robot_changes(answer):
    """A millimetre to either side of what is told, the robot is asked again as if weighed."""
    changes = 0
    stretches = answer.centroid.stretches
    assert {each.height_m for each in stretches} == {0.1, 0.24}
    for one, then in pairwise(stretches):
        if one.height_m != then.height_m:
            assert one.to_m == 0.48
            continue
        assert one.to_m == then.from_m
        assert weighed(one.to_m - 1e-3, one.height_m).verdict == one.verdict
        assert weighed(then.from_m + 1e-3, one.height_m).verdict == then.verdict
        changes += 1
    assert changes >= 2
    assert "go" in {each.verdict for each in stretches}
    assert "no-go" in {each.verdict for each in stretches}


def test_the_worst_and_the_best_case_are_those_of_places(answer):
    places = [0.24 + k * 0.06 for k in range(PLACES)]
    each = [
        weighed(along, height, model="contact")
        for along in places
        for height in (0.1, 0.24)
    ]  # fmt: skip
    assert len(each) == PLACES * HEIGHTS
    assert answer.margin_deg == pytest.approx(min(one.margin_deg for one in each))
    assert answer.margin_best_deg <= max(one.margin_best_deg for one in each) + 1e-9
    best = answer.what_would_help[0]
    assert best.verdict == "go"
    # no weighed robot is told better than the range as a whole allows
    assert answer.findings["tip_downhill"].margin == pytest.approx(
        min(one.findings["tip_downhill"].margin for one in each)
    )


def test_where_no_place_holds_it_is_no_go():
    steep = Stairs(name="steep", rise=0.3, going=0.15, steps=8)
    span = {"from_front": (0.44, 0.48), "height": (0.22, 0.24)}
    found = assess(robot(com_range=span), steep, friction=3.0)
    assert found.verdict == "no-go"
    assert {each.verdict for each in found.centroid.stretches} == {"no-go"}


def test_where_every_place_holds_it_is_unsure_all_the_same():
    gentle = Stairs(name="gentle", rise=0.1, going=0.3, steps=6)
    span = {"from_front": (0.38, 0.42), "height": (0.05, 0.06)}
    found = assess(robot(com_range=span), gentle, friction=1.2)
    assert (found.verdict, found.governs) == ("unsure", "unweighed")
    assert {each.verdict for each in found.centroid.stretches} == {"go"}
    assert "GO all over it" in str(found)


def test_without_friction_nothing_is_go():
    found = assess(robot(), FLIGHT)
    assert "no GO in this range" in str(found)


@pytest.mark.parametrize("model", ["closed-form", "contact"])
def test_an_override_takes_the_place_of_the_range(model):
    question = Question.in_one_posture(
        robot(), FLIGHT, friction=1.2, model=model, override="com_height=100mm"
    )
    assert question.robot.com_range == CentroidRange(from_front=(0.24, 0.48), height=(0.1, 0.1))
    assert conclude(question, judge(question)).verdict == "unsure"
    both = "com_height=100mm,com_from_front=350mm"
    question = Question.in_one_posture(robot(), FLIGHT, friction=1.2, model=model, override=both)
    assert question.robot.com_range is None
    assert conclude(question, judge(question)).verdict == "go"


def test_what_needs_one_centroid_says_so():
    said = r"its centroid is not measured \(com_range\)"
    for verb in (
        lambda: traverse(robot(), FLIGHT),
        lambda: sweep(robot(), FLIGHT, friction=1.0),
    ):
        with pytest.raises(InputError, match=said):
            verb()
    known = sweep(robot(), FLIGHT, friction=1.0, com_from_front=0.35, com_height=0.1)
    assert math.isfinite(float(known.margin_deg))


def test_they_can_be_compared():
    cells = compare([robot(), robot().with_centroid(0.35, 0.1)], [FLIGHT], friction=1.2).cells
    assert [cell.verdict for cell in cells] == ["unsure", "go"]


@pytest.mark.parametrize("name", catalog.names("unweighed"))
def test_catalogue_robots_that_nobody_weighed_get_an_answer(name):
    sheet = Robot.named(name)
    assert sheet.name == name
    assert json.loads(sheet.to_json())["com_range"] is not None
    flippers = "flat" if sheet.flippers() else "stowed"
    found = assess(name, "ada", friction=1.2, flippers=flippers)
    assert (found.verdict, found.governs) == ("unsure", "unweighed")


def test_the_assumed_ranges_hold_the_robots_whose_centroid_is_known():
    """As the sources of the sheets say: shares of L, and of the height of the track."""
    for name in catalog.names("unweighed"):
        sheet = Robot.named(name)
        radius = max(sheet.track.front_radius, sheet.track.rear_radius)
        low, high = (each / sheet.track.flat_length for each in sheet.com_range.from_front)
        assert (low, high) == pytest.approx((0.30, 0.60), abs=0.002)  # rounded to millimetres
        assert sheet.com_range.height == pytest.approx((radius, 2.4 * radius), abs=0.001)
    for name in catalog.names("robots"):
        sheet = Robot.named(name)
        share = sheet.com_from_front / sheet.track.flat_length
        radius = max(sheet.track.front_radius, sheet.track.rear_radius)
        assert 0.299 <= share <= 0.60, name
        if name != "absolem-flat":  # its ends are the tips of its flippers
            assert 0.50 <= sheet.com_height / (2 * radius) <= 1.20, name
