"""The plan beside the stated posture: what is found is confirmed by asking again."""

import json
import math

import jsonschema
import pytest
from typer.testing import CliRunner

import kaidan
from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.question import Question
from kaidan.robot import Drive, FlipperPair, Robot, Track
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.posture import PostureAnswer, posture

PAIR = FlipperPair(length=0.3, root_radius=0.08, tip_radius=0.03, pivot_height=0.08, max_speed=0.5)
ONE_PAIR = Robot(
    name="one pair",
    mass=20.0,
    com_from_front=0.2,
    com_height=0.08,
    track=Track(flat_length=0.45, front_radius=0.08, rear_radius=0.08),
    rear_flippers=PAIR,
    drive=Drive(max_speed=0.5),
)
SHAPE = {"rise": 0.12, "going": 0.2, "steps": 6}
STAIRS = Stairs(**SHAPE)


def question(robot=ONE_PAIR, stairs=STAIRS, **manner):
    return Question.in_one_posture(robot, stairs, **({"friction": 1.5} | manner))


@pytest.fixture(scope="module")
def answer():
    return posture(question())


def test_a_plan_helps(answer):
    """p = 233 mm is more than L/2 = 225 mm with the flipper stowed, so nothing holds it there."""
    assert answer.before.verdict != "go"
    assert answer.helps
    assert answer.before.governs == "tip_downhill"
    assert answer.plan.found
    assert answer.plan.flippers == answer.after.flippers
    assert [each.phase for each in answer.phases] == ["enter", "traverse", "land"]
    assert all(step.front_deg is None for step in answer.plan.steps)


def test_what_it_says_of_a_plan_is_what_assess_says_of_it(answer):
    for tried in (answer.before, answer.after):
        again = kaidan.assess(
            ONE_PAIR, STAIRS, friction=1.5, flippers=tried.flippers, facing=tried.facing
        )
        assert again.margin_deg == tried.margin_deg
        assert again.required_friction == tried.required_friction
        if tried.governs != "posture_tolerance":
            assert (again.verdict, again.governs) == (tried.verdict, tried.governs)
    assert answer.phases == again.contact.phases


def test_it_is_the_best_that_assess_finds(answer):
    found = kaidan.assess(ONE_PAIR, STAIRS, friction=1.5, flippers="best")
    assert found.plan == answer.plan
    assert (found.verdict, found.margin_deg) == (answer.after.verdict, answer.after.margin_deg)


def test_one_end_first():
    for facing in ("nose-first", "tail-first"):
        assert posture(question(), facing=facing).plan.facing == facing


def test_where_nothing_helps():
    wall = Stairs(rise=0.5, going=0.25, steps=5)
    found = posture(question(stairs=wall))
    assert not found.helps
    assert found.after == found.before
    assert found.exit_code == 1
    assert not found.plan.found
    assert str(found).startswith("Nothing is better than the requested posture")
    assert "No plan with angles within -75 to 90 deg is better than the requested posture." in str(
        found
    )


def test_nothing_is_gained_by_asking_with_the_best(answer):
    again = posture(question(flippers=answer.plan.flippers, facing=answer.plan.facing))
    assert again.after.margin_deg == pytest.approx(answer.after.margin_deg)


def test_a_robot_without_flippers_is_an_error():
    with pytest.raises(InputError, match="'kenaf' has no flippers, so it has no posture to choose"):
        posture(question(Robot.named("kenaf")))


def test_limits_without_meaning_are_an_error():
    with pytest.raises(InputError, match="limits"):
        posture(question(), limits=(1.0, -1.0))


def test_command(tmp_path):
    sheet = tmp_path / "robot.toml"
    sheet.write_text(ONE_PAIR.to_toml(), encoding="utf-8")
    how = ["posture", str(sheet), "--rise", "120mm", "--going", "200mm", "--steps", "6"]
    how += ["--friction", "1.5"]
    told = CliRunner().invoke(app, how)
    assert told.exit_code == 0, told.output
    assert told.output.startswith("This plan is best")
    assert told.output == f"{posture(question(stairs=Stairs(**SHAPE, name='120mm x 200mm')))}\n"
    data = json.loads(CliRunner().invoke(app, [*how, "--json"]).output)
    assert data["helps"] is True
    refused = CliRunner().invoke(app, [*how, "--limits", "20deg"])
    assert isinstance(refused.exception, InputError)


def test_times_take_the_flippers_speed(answer):
    """By hand: an angle over 0.5 rad/s; at an unknown speed an unknown time."""
    for step in answer.plan.steps[1:]:
        assert step.time_s == pytest.approx(math.radians(step.turn_deg) / 0.5)
    timeless = PAIR.model_copy(update={"max_speed": None})
    found = posture(question(ONE_PAIR.model_copy(update={"rear_flippers": timeless})))
    assert {step.time_s for step in found.plan.steps} == {None}
    assert ("are not timed" in str(found)) == (len(found.plan.steps) > 1)


def test_the_answer_is_an_answer(answer):
    jsonschema.Draft202012Validator.check_schema(PostureAnswer.json_schema())
    jsonschema.validate(answer.to_dict(), PostureAnswer.json_schema())
    assert PostureAnswer.from_json(answer.to_json()) == answer
    assert answer._repr_html_().count("<tr>") > 10
    assert kaidan.posture(answer.question) == answer
    with pytest.raises(InputError, match="posture: state the posture to compare with"):
        posture(question(flippers="best"))


@pytest.mark.parametrize(
    ("manner", "said"),
    [
        ({"yaw": 0.1}, "posture: leave the yaw out; the flippers are judged straight on"),
        (
            {"model": "closed-form"},
            "posture: the contact model judges the flippers; leave the model out",
        ),
    ],
)
def test_what_it_does_not_judge_is_refused(manner, said):
    track = ONE_PAIR.track.model_copy(update={"gauge": 0.3})
    with pytest.raises(InputError) as refused:
        posture(question(ONE_PAIR.model_copy(update={"track": track}), **manner))
    assert str(refused.value) == said
