"""A traverse of a plan: its parts as one, the changes between them in log, figure and film."""

import jsonschema
import numpy as np
import pytest

import kaidan
from kaidan.errors import InputError
from kaidan.figures import animation, traverse_figure
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.pose_map import pose_map
from kaidan.verbs.traverse import driven, traverse_report
from kaidan.verbs.traverse_report import TraverseReport

STAIRS = Stairs(name="short", rise=0.178, going=0.279, steps=7)
PLAN = "35deg,-41deg/traverse:flat/land:-68deg,-20deg"


def report(flippers=PLAN, **manner):
    return kaidan.traverse("absolem", STAIRS, flippers=flippers, friction=0.9, **manner)


@pytest.fixture(scope="module")
def found():
    return report()


def test_its_parts_are_one_path(found):
    poses = found.poses
    assert np.all(np.diff(poses.path_m) >= 0)
    assert np.all(np.diff(poses.leg) >= 0)
    assert found.arrived
    assert [each.what for each in found.events].count("arrived") == 1
    assert found.event_log[-1].kind == "arrives"
    paths = [each.path_m for each in found.event_log]
    assert paths == sorted(paths)
    # the robot stands where it stood, or behind: the centroid moves with the flippers besides
    for move in found.moves:
        before, after = move.row, move.row + 1
        assert abs(poses.x_m[after] - poses.x_m[before]) < 0.1
        assert move.poses[0].placement.x_m == pytest.approx(poses.x_m[before], abs=1e-9)
        ended = move.poses[-1].placement
        assert 0.01 - 1e-9 <= ended.x_m - poses.x_m[after] < 0.1
        assert ended.inclination_deg == pytest.approx(poses.inclination_deg[after], abs=2.0)


def test_a_change_is_an_event_with_time_and_torque(found):
    changes = [each for each in found.event_log if each.kind == "changes"]
    assert [each.phase for each in changes] == ["traverse", "land"]
    assert changes[1].text.startswith("stands, changes its posture to -68deg,-20deg (58 deg, 1.3 s")
    assert changes[1].text.endswith(" N m)")
    for move, step in zip(found.moves, found.assessment.plan.steps[1:], strict=True):
        assert (move.before, move.turn_deg, move.time_s) == (
            step.phase, step.turn_deg, step.time_s,
        )  # fmt: skip
        assert move.torque_Nm == step.torque_Nm == max(each.torque_Nm for each in move.poses)


def test_each_pose_has_the_outline_of_its_posture(found):
    first, second = (each.row for each in found.moves)
    assert found.outline_at(first) == found.outline
    assert found.outline_at(first + 1) == found.moves[0].poses[-1].outline
    assert found.outline_at(second) == found.outline_at(first + 1)
    assert found.outline_at(-1) == found.moves[1].poses[-1].outline


def test_its_assessment_is_that_of_assess(found):
    answer = kaidan.assess(found.question)
    assert answer.verdict == found.assessment.verdict
    assert answer.margin_deg == pytest.approx(found.assessment.margin_deg, abs=1e-9)


def test_it_is_json_both_ways(found):
    assert TraverseReport.from_json(found.to_json()) == found
    jsonschema.validate(found.to_dict(), TraverseReport.json_schema())


def test_the_best_plan_is_followed():
    best = report("best")
    assert best.assessment.plan.found
    assert len(best.moves) == len(best.assessment.plan.steps) - 1
    again = report(best.assessment.plan.flippers, facing=best.assessment.plan.facing)
    assert again.poses.path_m[-1] == best.poses.path_m[-1]
    assert [each.poses for each in again.moves] == [each.poses for each in best.moves]


def test_figure_and_film_show_the_changes(found):
    words = {
        text.get_text()
        for axes in traverse_figure.traverse_figure(found).axes
        for text in axes.texts
    }
    assert "changes posture" in words
    frames = animation.frames_of(found)
    shown = {tuple((part.x_2_m, part.z_2_m) for part in each.outline) for each in frames}
    ways = {
        tuple((part.x_2_m, part.z_2_m) for part in pose.outline)
        for move in found.moves
        for pose in move.poses
    }
    assert ways <= shown


def test_a_pose_map_is_of_one_posture():
    question = Question.of("absolem", STAIRS, flippers=PLAN)
    with pytest.raises(InputError) as refused:
        pose_map(question, driven(question))
    assert str(refused.value) == "pose map: it is of one posture; state angles, flat or stowed"


def test_a_fall_in_a_later_part_ends_the_report():
    high = Stairs(rise=0.3, going=0.28, steps=4)
    question = Question.of("absolem", high, flippers="flat/land:stowed", friction=2.0)
    found = traverse_report(question, driven(question))
    assert not found.arrived
    assert found.assessment.verdict == "no-go"
    assert found.event_log[-1].kind != "arrives"
