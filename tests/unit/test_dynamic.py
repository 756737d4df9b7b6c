"""The physics as a model behind the one interface: `--model physics`."""

import json
import math

import jsonschema
import numpy as np
import pytest
from typer.testing import CliRunner

pytest.importorskip("mujoco", reason="skipped: mujoco not installed")

import kaidan
from kaidan import Assessment, Profile, Stairs
from kaidan.assessment.verdict import conclude
from kaidan.cli import app
from kaidan.models import dynamic, judge
from kaidan.modes import Phase, Verdict
from kaidan.physics import Outcome
from kaidan.question import Question
from physics_cases import robot

GENTLE = Stairs(rise=0.1, going=0.2, steps=3)
STEEP = Stairs.inclined(angle=math.radians(65.0), nosing_spacing=0.15, steps=8)


simulated = dynamic.run
RESULTS = {}


@pytest.fixture(autouse=True)
def each_trial_once(monkeypatch):
    """Several tests look at the same trials; that they come out the same again is test_trial's."""

    def run(spec):
        text = spec.model_dump_json()
        if text not in RESULTS:
            RESULTS[text] = simulated(spec)
        return RESULTS[text]

    monkeypatch.setattr(dynamic, "run", run)


def ask(stairs=GENTLE, *, sheet=None, speed=0.3, **manner):
    """At three times the paper's speed, which takes a third of the time."""
    return kaidan.assess(sheet or robot(), stairs, model="physics", speed=speed, **manner)


def outcomes(answer):
    return [trial.outcome for trial in answer.physics.trials]


@pytest.mark.parametrize("direction", ["up", "down"])
@pytest.mark.parametrize("facing", ["nose-first", "tail-first"])
def test_a_robot_that_arrives_is_unsure_because_no_margin_is_known(direction, facing):
    answer = ask(friction=1.0, direction=direction, facing=facing)
    assert (answer.verdict, answer.governs) == ("unsure", "margin_unknown")
    assert answer.reason == "Nothing fails, but the trial in MuJoCo knows no margin."
    assert answer.findings == {}
    assert (answer.margin_deg, answer.margin_best_deg, answer.required_friction) == (None,) * 3
    assert outcomes(answer) == ["climbed"]
    assert answer.model == "physics"
    lines = str(answer).splitlines()
    assert "  simulated       1 trial with a smooth rigid belt at 0.3 m/s" in lines
    assert "none of the changes" not in str(answer)  # nothing fails that they might mend


def test_without_a_friction_nothing_better_than_friction_unknown():
    answer = ask()
    assert (answer.verdict, answer.governs) == ("unsure", "friction_unknown")
    assert answer.reason == "Friction decides: none is stated."
    assert [trial.friction for trial in answer.physics.trials] == [3.0]


def test_a_fall_is_no_go_with_its_place():
    answer = ask(STEEP, friction=3.0, speed=None)
    assert (answer.verdict, answer.governs) == ("no-go", "tip_downhill")
    assert answer.reason == f"It falls over its downhill end ({answer.phase}, step {answer.step})."
    found = answer.findings["tip_downhill"]
    assert (found.holds, found.margin, found.model) == (False, None, "physics")
    assert answer.falls_over == "tail"
    assert answer.margin_force_N is None


def test_the_end_over_which_it_falls_is_the_downhill_one_whichever_leads():
    question = Question.in_one_posture(robot(), STEEP, friction=3.0, facing="tail-first")
    assert judge(question.changed(model="physics")).each[0].mode.key == "tip_downhill"


def test_too_little_friction_is_no_go_and_a_range_unsure():
    short = ask(friction=0.2)
    assert (short.verdict, short.governs) == ("no-go", "slides_down")
    assert short.reason.startswith("With a friction of 0.2 it slides (")
    ranged = ask(friction=(0.2, 1.0))
    assert (ranged.verdict, ranged.governs) == ("unsure", "slides_down")
    assert outcomes(ranged) == ["slid", "climbed"]
    assert ranged.reason.endswith("; with 1 it arrives.")


def test_where_both_ends_of_a_range_fail_by_another_mode_it_is_no_go():
    question = Question.in_one_posture(robot(), STEEP, friction=(0.5, 3.0))
    found = dynamic.judge(question)
    assert {one.mode.key for one in found.each} == {"slides_down", "tip_downhill"}
    concluded = conclude(question, found)
    assert concluded.verdict is Verdict.NO_GO
    assert concluded.governs == "tip_downhill"


def test_running_away_downhill_is_sliding_down():
    answer = ask(friction=0.1, direction="down")
    assert (answer.verdict, answer.governs) == ("no-go", "slides_down")


def test_where_no_friction_gets_it_up_it_is_stuck():
    answer = ask(Stairs(rise=0.3, going=0.3, steps=3))
    assert answer.verdict == "no-go"
    assert answer.governs in ("stuck", "tip_downhill")
    assert answer.phase == Phase.ENTER


def test_several_flights_and_a_profile():
    landing = Stairs(rise=0.1, going=0.2, steps=2, upper_landing=1.0)
    assert outcomes(ask((landing, GENTLE), friction=1.0)) == ["climbed"]
    measured = Profile.of_points(Profile.of_stairs(GENTLE).points)
    assert outcomes(ask(measured, friction=1.0)) == ["climbed"]


def test_a_speed_is_that_of_the_belt():
    assert ask(friction=1.0, speed=None).physics.speed_m_s == 0.1
    fast = ask(friction=1.0, speed=0.3)
    assert fast.physics.speed_m_s == 0.3
    assert fast.physics.trials[0].time_s < 5.0


def test_a_yaw_is_simulated_in_space():
    sheet = robot(gauge=0.3, width=0.08)
    assert outcomes(ask(sheet=sheet, friction=1.5, yaw=0.1)) == ["climbed"]


@pytest.mark.parametrize(
    ("terrain", "manner", "why"),
    [
        (GENTLE, {"speed": 0.0}, "speed = 0 m/s is not within 0.001 to 5 m/s"),
        (
            GENTLE,
            {"yaw": 0.1, "sheet": robot(gauge=0.3)},
            "dimensions = 3 needs gauge and width of the tracks; 'kenaf-like' does not state both",
        ),
        (
            Profile.of_points([(0.0, 0.0), (2.0, 0.0)]),
            {},
            "the terrain has fewer than two nosings",
        ),
        (
            Stairs(rise=0.1, going=0.2, steps=300),
            {"speed": 0.001},
            "it takes 18.8 h at 0.001 m/s; at most 1 h is simulated",
        ),
    ],
    ids=["speed", "width", "floor", "long"],
)
def test_what_trials_cannot_say_is_outside_the_model(terrain, manner, why):
    answer = ask(terrain, **manner)
    assert (answer.verdict, answer.exit_code) == ("outside-model", 3)
    assert answer.reason == f"The trial in MuJoCo has no answer: {why}."


@pytest.mark.parametrize("outcome", [Outcome.UNSTABLE, Outcome.START_FALL])
def test_a_trial_that_says_nothing_gives_no_verdict(monkeypatch, outcome):
    true = dynamic.run

    def run(spec):
        return true(spec).model_copy(update={"outcome": outcome})

    monkeypatch.setattr(dynamic, "run", run)
    answer = ask(friction=1.0)
    assert answer.verdict == "outside-model"
    assert outcomes(answer) == [outcome]


def test_the_answer_is_the_same_after_json_and_fits_its_schema():
    for answer in (ask(friction=(0.2, 1.0)), ask(STEEP, friction=3.0), ask(speed=0.0)):
        assert Assessment.from_json(answer.to_json()) == answer
        jsonschema.validate(answer.to_dict(), Assessment.json_schema())


def test_the_command():
    words = ["assess", "kenaf", "--rise", "100mm", "--going", "200mm", "--steps", "3", "--model",
             "physics", "--friction", "1"]  # fmt: skip
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 5
    assert done.stdout.startswith("UNSURE  kenaf on 100mm x 200mm, up nose first\n")
    lines = CliRunner().invoke(app, [*words, "--details"]).stdout.splitlines()
    assert "  trial           friction 1.00: climbed" in lines
    assert "    A mass of 20 kg is assumed: the sheet states none." in lines
    told = json.loads(CliRunner().invoke(app, [*words, "--json"]).stdout)
    assert told["physics"]["trials"][0]["outcome"] == "climbed"
    assert told["contact"] is told["closed_form"] is None


def test_its_findings_are_samples_like_those_of_the_others():
    found = dynamic.judge(Question.in_one_posture(robot(), STEEP, friction=3.0))
    (one,) = found.each
    assert one.fails().all()
    assert one.fails(best=True).all()
    assert np.isneginf(one.worst).all()
    assert math.isnan(found.required_friction)
