"""What ROUGH claims: the robot arrives in every case known of, and how far from a fall is known."""

import itertools

import pytest

from amounts import fast_and_slow
from kaidan.assessment import answer_to
from kaidan.catalog import names
from kaidan.question import Question
from kaidan.robot import Robot

ROUGHLY = {"tip_downhill", "tip_uphill", "rotation", "impact", "high_centring"}
"""All that may fail of it in any case."""
FALLS = {
    "tip_downhill": "fall_downhill", "tip_uphill": "fall_uphill", "rotation": "fall_downhill",
}  # fmt: skip


def asked(every):
    """Pairs of the catalogue, up and down, either end first, on ground that grips."""
    manners = itertools.product(
        names("robots"), names("stairs"), ("up", "down"), ("nose-first", "tail-first")
    )
    for robot, stairs, direction, facing in itertools.islice(manners, 0, None, every):
        if Robot.named(robot).com_range is None:
            yield Question.in_one_posture(
                robot, stairs, friction=2.0, direction=direction, facing=facing, flippers="stowed"
            )


@pytest.mark.parametrize("every", fast_and_slow(7, 1))
def test_a_rough_answer_is_far_from_a_fall_and_holds_its_momentum(every):
    rough = []
    for question in asked(every):
        answer = answer_to(question, advice=False)
        if answer.verdict != "rough":
            continue
        rough.append(answer)
        fails = {key for key, one in answer.findings.items() if one.holds is False}
        assert fails
        assert fails <= ROUGHLY, question.to_json()
        for key in fails & set(FALLS):
            assert answer.findings[FALLS[key]].holds, question.to_json()
        for key in {"momentum", "energy"} & set(answer.findings):
            assert answer.findings[key].holds, question.to_json()
        assert answer.friction is not None
        assert answer.contact.grades.arrested
        assert answer.notes[0].startswith("Secure payload, arm and antennas: it ")
    assert rough  # else nothing was tested


@pytest.mark.parametrize("stairs", ["ibc", "ada"])
@pytest.mark.parametrize("robot", ["ozbot-atr", "csiro-dtr"])
@pytest.mark.parametrize("friction", [0.8, 1.2, 2.0])
def test_down_nose_first_long_robots_are_not_rough(robot, stairs, friction):
    question = Question.in_one_posture(
        robot, stairs, friction=friction, direction="down", facing="nose-first", flippers="stowed"
    )
    answer = answer_to(question, advice=False)
    assert answer.verdict in ("unsure", "no-go"), (answer.reason, answer.doubts)
