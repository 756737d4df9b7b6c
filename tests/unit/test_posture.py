"""Flipper angles: what is found is confirmed by asking again; plain kernel on short flights."""

import json
import math

import pytest
from typer.testing import CliRunner

from kaidan import posture
from kaidan.assessment import assess, case_of
from kaidan.cli import app
from kaidan.errors import InputError
from kaidan.posture import best_posture, shortened
from kaidan.robot import Drive, FlipperPair, Posture, Robot, Track
from kaidan.stairs import Stairs

pytestmark = pytest.mark.usefixtures("compiled_kernel")

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
STAIRS = Stairs(rise=0.12, going=0.2, steps=6)


def asked(robot=ONE_PAIR, stairs=STAIRS, **how):
    return case_of(robot, stairs, **({"friction": 1.5} | how))


@pytest.fixture(scope="module")
def answer():
    return best_posture(asked())


def test_the_rear_flipper_laid_out_helps(answer):
    """p = 233 mm is more than L/2 = 225 mm with the flipper stowed: no GO; laid flat it is less."""
    assert answer.before.verdict != "go"
    assert answer.helps
    assert answer.after.verdict == "go"
    assert answer.after.front_deg is None
    assert answer.after.rear_deg == pytest.approx(math.degrees(PAIR.flat_angle))
    assert answer.exit_code == 0


def test_what_is_found_is_so(answer):
    found = Posture(rear=math.radians(answer.after.rear_deg))
    again = assess(ONE_PAIR, STAIRS, friction=1.5, flippers=found)
    assert again.verdict == answer.after.verdict
    # deg: the search looks at poses 20 mm apart instead of 4; events are located in both
    assert again.margin_deg == pytest.approx(answer.after.margin_deg, abs=0.01)


def test_phases_and_changes(answer):
    assert [each.phase for each in answer.phases] == ["enter", "traverse", "land"]
    for change in answer.changes:
        by_hand = math.radians(change.turn_deg) / 0.5  # rad over rad/s
        assert change.needs_s == pytest.approx(by_hand)
        assert change.has_s == pytest.approx(math.hypot(0.12, 0.2) / 0.1)  # the paper's speed
        assert change.too_slow == (change.needs_s > change.has_s)


def test_slow_flippers_are_called_so():
    slow = PAIR.model_copy(update={"max_speed": 0.01})
    robot = ONE_PAIR.model_copy(update={"rear_flippers": slow})
    found = best_posture(asked(robot, speed=0.5))
    assert found.speed == 0.5
    assert all(change.too_slow for change in found.changes)
    assert not found.changes or any("too slow" in note for note in found.notes)


def test_where_no_posture_helps():
    wall = Stairs(rise=0.5, going=0.25, steps=5)
    found = best_posture(asked(stairs=wall))
    assert not found.helps
    assert found.after == found.before
    assert found.exit_code == 1
    assert any("No posture" in note for note in found.notes)


def test_nothing_is_gained_by_asking_with_the_best(answer):
    best = Posture(rear=math.radians(answer.after.rear_deg))
    again = best_posture(asked(flippers=best))
    assert again.after.verdict == answer.after.verdict
    assert again.after.margin_deg >= answer.after.margin_deg - 0.06  # deg: WORTH


def test_a_robot_without_flippers_is_an_error():
    with pytest.raises(InputError, match="'kenaf' has no flippers, so it has no posture to choose"):
        best_posture(asked(Robot.named("kenaf")))


def test_limits_without_meaning_are_an_error():
    with pytest.raises(InputError, match="limits"):
        best_posture(asked(), limits=(1.0, -1.0))


def test_shortened_flights_keep_what_is_odd():
    stairs = Stairs(rise=0.12, going=0.2, steps=40, first_rise=0.1, last_rise=0.13)
    short = shortened(asked(stairs=stairs)).stairs
    assert 5 <= short.steps < 12
    assert (short.step_rises[0], short.step_rises[-1]) == (0.1, 0.13)
    measured = Stairs(rises=(0.12,) * 5, goings=(0.2,) * 4)
    assert shortened(asked(stairs=measured)).stairs is measured


def test_command(tmp_path):
    sheet = tmp_path / "robot.toml"
    sheet.write_text(ONE_PAIR.to_toml(), encoding="utf-8")
    how = ["posture", str(sheet), "--rise", "120mm", "--going", "200mm", "--steps", "6"]
    how += ["--friction", "1.5"]
    told = CliRunner().invoke(app, how)
    assert told.exit_code == 0, told.output
    assert "is best for all the way" in told.output
    data = json.loads(CliRunner().invoke(app, [*how, "--json"]).output)
    assert data["after"]["verdict"] == "go"
    refused = CliRunner().invoke(app, [*how, "--limits", "20deg"])
    assert isinstance(refused.exception, InputError)


def test_the_search_is_bounded():
    """Two pairs: (5 + 2)^2 coarse postures, then a handful in full."""
    assert (posture.TRIED[2] + 2) ** 2 <= 49
    assert posture.JUDGED + 4 * len(posture.REFINED) + 3 <= 20
