"""What to measure next: the answer's cheap ranking beside Sobol indices by SALib, and an oracle.

SALib judges each draw anew, all inputs exact; the cheap version reads the samples of one answer.
They rank alike; a share may differ by the interactions that first-order indices leave out, by the
estimators' error (0.1 at 128 samples), and by what is even between worst and best case only.
"""

import math

import numpy as np
import pytest

pytest.importorskip("SALib")

from kaidan import InputError, Question, Stairs, assess, sensitivity
from kaidan.assessment.measuring import Drawn, first_order, to_measure
from kaidan.assessment.uncertain_inputs import doubts_of, without
from kaidan.models import judge
from kaidan.verbs.sensitivity import Sensitivity

ERROR = 0.2
"""Difference of a share; see above."""
LOW = Stairs(rise=0.1, going=0.2)
CLEAR = 0.15
"""Difference of two shares from which their order is certain."""


def test_first_order_indices_of_the_ishigami_function():
    """Oracle: S1 = 0.3139, S2 = 0.4424, S3 = 0 for a = 7, b = 0.1 (Ishigami & Homma 1990)."""
    draw = np.random.default_rng(0)
    x = draw.uniform(-math.pi, math.pi, (3, 16384))
    y = np.sin(x[0]) + 7 * np.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * np.sin(x[0])
    found = [first_order(Drawn.of(each), y) for each in x]
    assert found == pytest.approx([0.3139, 0.4424, 0.0], abs=0.02)


def test_of_a_sum_each_input_has_its_variance():
    """By hand: Y = 3 X1 + 2 X2 + X3 has shares of 9, 4 and 1 of 14."""
    x = np.random.default_rng(1).normal(size=(3, 8192))
    y = 3 * x[0] + 2 * x[1] + x[2]
    assert [first_order(Drawn.of(each), y) for each in x] == pytest.approx(
        [9 / 14, 4 / 14, 1 / 14], abs=0.02
    )
    assert first_order(Drawn.of(x[0]), np.ones(8192)) == 0.0


ASKED = {
    "the centroid": {
        "friction": 1.4,
        "uncertainty": "com_from_front=20mm,com_height=15mm,angle=1deg",
    },
    "the stairs": {"friction": 1.6, "uncertainty": "com_height=3mm,angle=3deg,nosing_spacing=10mm"},
    "the friction": {"friction": (1.0, 1.5), "uncertainty": "com_height=5mm,angle=0.5deg"},
    "ranges alone": {"friction": 2.0, "theta_d": "0..4deg", "theta_M": "0..1deg"},
    "friction, drawn": {"friction": 1.05, "uncertainty": "friction=0.1,com_height=5mm"},
}


def in_every_run(name):
    """A question as a case: ranges and standard uncertainties, of robot, stairs and friction."""
    marks = () if name in ("the centroid", "friction, drawn") else pytest.mark.slow
    return pytest.param(name, marks=marks)


def shares(found):
    """First-order indices of SALib, by what is measured."""
    whole = {}
    for each in found.inputs:
        whole[each.what] = whole.get(each.what, 0.0) + each.margin_first
    return whole


def assert_ranked_alike(question, samples):
    cheap = {each.what: each.share for each in to_measure(question, judge(question))}
    exact = shares(sensitivity(question, samples=samples))
    assert cheap.keys() == exact.keys()
    assert next(iter(cheap)) == max(exact, key=exact.get)
    for one in exact:
        assert cheap[one] == pytest.approx(exact[one], abs=ERROR), one
        for other in exact:
            if exact[one] > exact[other] + CLEAR:
                assert cheap[one] > cheap[other]


@pytest.mark.parametrize("name", [in_every_run(name) for name in ASKED])
def test_the_cheap_ranking_is_that_of_salib(name):
    asked = ASKED[name]
    question = Question.in_one_posture(
        "absolem", "iso-14122-3", flippers="flat", model="closed-form", **asked
    )
    assert_ranked_alike(question, samples=128)


@pytest.mark.slow
@pytest.mark.parametrize("manner", ASKED.values(), ids=ASKED)
def test_the_cheap_ranking_of_the_contact_model_is_that_of_salib(manner):
    question = Question.in_one_posture("absolem", "iso-14122-3", flippers="flat", **manner)
    assert_ranked_alike(question, samples=128)


def test_weighing_settles_it():
    """Of an exact robot the worst case is a GO, so one that is weighed is a GO."""
    asked = {"flippers": "flat", "friction": 2.0, "model": "closed-form"}
    exact = assess("absolem", "iso-14122-3", **asked)
    answer = assess("absolem", "iso-14122-3", uncertainty="com_height=25mm", **asked)
    assert (exact.verdict, answer.verdict) == ("go", "unsure")
    first = answer.to_measure[0]
    assert (first.what, first.inputs) == ("centroid", ("com_height",))
    weigh = next(each for each in answer.what_would_help if each.change.startswith("Weigh"))
    assert weigh.verdict == "go"
    assert weigh.margin_deg == pytest.approx(exact.margin_deg, abs=1e-9)
    assert "measure         weigh the robot: " in str(answer)


def test_an_exact_question_has_nothing_to_measure():
    answer = assess("absolem", "iso-14122-3", model="closed-form", flippers="flat", friction=1.2,
                    theta_d=0.01, theta_M=0.01)  # fmt: skip
    assert answer.to_measure == ()
    assert doubts_of(answer.question) == ()
    with pytest.raises(InputError, match="every input is exact"):
        sensitivity(answer.question)


def test_what_is_measured_is_no_longer_in_doubt():
    question = Question.in_one_posture(
        "absolem", "iso-14122-3", flippers="flat", friction=(0.9, 1.1),
        uncertainty="com_height=5mm,flat_length=5mm,angle=1deg,friction=0.05",
    )  # fmt: skip
    groups = {each.group for each in doubts_of(question)}
    assert groups == {"centroid", "length", "stairs", "friction", "theta_d", "theta_M"}
    for group in groups:
        left = {each.group for each in doubts_of(without(question, group))}
        assert left == groups - {group}


def test_a_robot_that_nobody_weighed_has_its_range_drawn():
    found = sensitivity("talon", LOW, friction=1.0, model="closed-form", samples=16)
    assert {"com_from_front", "com_height"} <= {each.name for each in found.inputs}
    assert 0 <= found.go <= 1


def test_single_steps_are_left_out_and_said_so():
    found = sensitivity("absolem", "iso-14122-3", flippers="flat", friction=1.2, samples=8,
                        model="closed-form", uncertainty="rise=3mm,going=3mm")  # fmt: skip
    assert found.left_out == ("steps",)
    assert "Not drawn: steps" in str(found)
    assert Sensitivity.from_json(found.to_json()) == found


def test_it_is_of_the_plan_of_the_answer():
    answer = assess("absolem", "ibc", friction=0.9)
    found = sensitivity("absolem", "ibc", friction=0.9, samples=8)
    assert (found.facing, found.flippers) == (answer.plan.facing, answer.plan.flippers)
    assert (found.go, answer.verdict) == (1.0, "go")
    assert found.margin_deg == pytest.approx(answer.margin_deg, abs=1e-6)


@pytest.mark.parametrize(
    ("samples", "said"),
    [(0, "not a whole number within 8"), (7, "not a whole number within 8"), (100, "power of two")],
)
def test_samples_are_a_power_of_two(samples, said):
    with pytest.raises(InputError, match=said):
        sensitivity("absolem", "ibc", samples=samples)


def test_the_command_and_its_figure(tmp_path):
    from typer.testing import CliRunner

    from kaidan.cli import app_for

    picture = tmp_path / "sensitivity.png"
    words = ["sensitivity", "absolem", "iso-14122-3", "--flippers", "flat", "--friction", "1.3",
             "--model", "closed-form", "--uncertainty", "com_height=25mm,angle=1deg", "--samples",
             "16", "--figure", str(picture), "--json"]  # fmt: skip
    done = CliRunner().invoke(app_for(["sensitivity"]), words)
    assert done.exit_code == 0, done.output
    found = Sensitivity.from_json(done.stdout)
    assert found.inputs[0].name == "com_height"
    assert found.judged == 16 * (len(found.inputs) + 2)
    assert picture.read_bytes()[:4] == b"\x89PNG"
