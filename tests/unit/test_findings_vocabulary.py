"""A failure mode added in one line is judged, put into words, drawn and written; so is a model.

The wind that blows a robot off the stairs is made up, and so is the model that knows it.
"""

import json
import math
import sys
from types import ModuleType

import jsonschema
import numpy as np
import pytest
from typer.testing import CliRunner

import kaidan
from kaidan import Assessment, InputError, Question, Stairs, modes
from kaidan.cli import app
from kaidan.figures.findings_figure import findings_figure
from kaidan.models.findings import Finding, Findings

FLIGHT = Stairs(rise=0.1, going=0.15)


@pytest.fixture
def vocabulary():
    """Vocabularies that forget what a test adds to them."""
    modes_before, models_before = dict(modes.FAILURE_MODES), dict(modes.MODELS)
    yield
    for registry, before in ((modes.FAILURE_MODES, modes_before), (modes.MODELS, models_before)):
        registry.clear()
        registry.update(before)


@pytest.fixture
def wind(vocabulary):
    return modes.failure_mode("wind", "rad", "being blown off the stairs", modes.FAILS_IF_KNOWN)


@pytest.fixture
def ask(vocabulary, monkeypatch):
    """Ask a model that finds what it is given of Kenaf on a flight."""
    modes.model("wind-tunnel", "wind_tunnel", "wind tunnel")

    def asked(*each, **manner):
        module = ModuleType("wind_tunnel")
        module.judge = lambda question, known=None: Findings(model="wind-tunnel", each=each)
        monkeypatch.setitem(sys.modules, "wind_tunnel", module)
        return kaidan.assess("kenaf", FLIGHT, friction=1.0, model="wind-tunnel", **manner)

    return asked


def finding(mode, worst, best=None, **others):
    worst = np.atleast_1d(np.asarray(worst, dtype=float))
    best = worst if best is None else np.atleast_1d(np.asarray(best, dtype=float))
    return Finding(mode=mode, worst=worst, best=best, model="wind-tunnel", **others)


def labels(figure):
    (axes,) = figure.axes
    return [label.get_text() for label in axes.get_yticklabels()]


def test_a_new_failure_mode_decides_and_is_shown_everywhere(wind, ask):
    tips = finding(modes.TIP_DOWNHILL, 0.3)
    answer = ask(tips, finding(wind, -0.1, -0.05, phase=modes.Phase.LAND, step=7))
    assert (answer.verdict, answer.governs) == ("no-go", "wind")
    assert (answer.phase, answer.step) == ("land", 7)
    assert answer.margin_deg == pytest.approx(math.degrees(-0.1))
    assert answer.margin_best_deg == pytest.approx(math.degrees(-0.05))
    # in JSON
    document = json.loads(answer.to_json())
    jsonschema.validate(document, Assessment.json_schema())
    assert document["findings"]["wind"] == {
        "label": "being blown off the stairs",
        "unit": "deg",
        "margin": pytest.approx(math.degrees(-0.1)),
        "margin_best": pytest.approx(math.degrees(-0.05)),
        "holds": False,
        "holds_best": False,
        "probability": None,
        "phase": "land",
        "step": 7,
        "model": "wind-tunnel",
    }
    assert document["doubts"] == ["wind"]
    assert Assessment.from_json(answer.to_json()) == answer
    # in words
    assert answer.reason == "It fails by being blown off the stairs (land, step 7)."
    assert answer.reason in str(answer)
    (row,) = [line for line in answer.details().splitlines() if line.startswith("  wind ")]
    assert row.split(maxsplit=1)[1] == (
        "-5.7 deg, at best -2.9 (being blown off the stairs, land step 7)"
    )
    assert "being blown off the stairs" in answer._repr_html_()
    # drawn
    assert labels(findings_figure(answer)) == [
        "tipping over its downhill end",
        "being blown off the stairs",
    ]


def test_it_may_be_in_doubt_or_the_nearest(wind, ask):
    tips = finding(modes.TIP_DOWNHILL, 0.3)
    answer = ask(tips, finding(wind, -0.1, 0.05))
    assert (answer.verdict, answer.governs) == ("unsure", "wind")
    assert answer.reason == "It may fail by being blown off the stairs."
    answer = ask(tips, finding(wind, 0.1))
    assert (answer.verdict, answer.governs) == ("go", "wind")
    assert answer.reason == (
        "It holds with 5.7 deg to spare; nearest is being blown off the stairs."
    )


def test_it_has_a_probability_where_inputs_are_uncertain(wind, ask):
    worst = np.where(np.arange(1000) < 30, -0.1, 0.2)
    answer = ask(finding(wind, worst), risk=0.02)
    assert (answer.verdict, answer.governs) == ("no-go", "wind")
    assert answer.findings["wind"].probability == answer.failure_probability == 0.03
    assert ask(finding(wind, worst), risk=0.03).verdict == "go"


@pytest.mark.parametrize(
    ("unit", "shown", "margin", "value"),
    [
        ("rad of rotation", "deg", -0.1, "-5.7 deg"),
        ("m", "mm", -0.012, "-12.00 mm"),
        ("m/s", "m/s", -1.5, "-1.5 m/s"),
        ("", "", -math.inf, "fails"),
    ],
)
def test_it_may_have_any_unit(vocabulary, ask, unit, shown, margin, value):
    mode = modes.failure_mode("wind", unit, "being blown off the stairs", modes.OPEN)
    tips = finding(modes.TIP_DOWNHILL, 0.3)
    answer = ask(tips, finding(mode, margin))
    assert (answer.verdict, answer.governs) == ("unsure", "wind")
    assert answer.margin_deg == pytest.approx(math.degrees(0.3))
    assert answer.findings["wind"].unit == shown
    (row,) = [line for line in answer.details().splitlines() if line.startswith("  wind ")]
    assert row.split(maxsplit=1)[1] == f"{value} (being blown off the stairs)"
    assert len(labels(findings_figure(answer))) == 2


def test_what_is_not_known_of_it_is_null_and_not_drawn(wind, ask):
    answer = ask(finding(modes.TIP_DOWNHILL, 0.3), finding(wind, math.nan))
    assert answer.verdict == "go"
    assert answer.findings["wind"].holds is answer.findings["wind"].margin is None
    assert labels(findings_figure(answer)) == ["tipping over its downhill end"]


def test_a_new_model_is_asked_by_its_name(ask):
    answer = ask(finding(modes.TIP_DOWNHILL, 0.3))
    assert (answer.verdict, answer.model) == ("go", "wind-tunnel")
    assert answer.findings["tip_downhill"].model == "wind-tunnel"
    # the other models' figures are not there
    assert [getattr(answer, name) for name in ("contact", "closed_form", "support_polygon")] == [
        None
    ] * 3
    question = Question.of("kenaf", FLIGHT, friction=1.0, model="wind-tunnel")
    assert kaidan.assess(question) == answer
    assert Question.from_json(question.to_json()) == question


def test_a_new_model_is_asked_on_the_command_line(ask):
    answer = ask(finding(modes.TIP_DOWNHILL, 0.3))
    words = ["assess", "kenaf", "--rise", "100mm", "--going", "150mm", "--friction", "1.0"]
    done = CliRunner().invoke(app, [*words, "--model", "wind-tunnel"])
    assert done.exit_code == 0
    assert answer.reason in done.stdout


def test_a_new_model_may_say_why_it_has_no_answer(vocabulary, monkeypatch):
    modes.model("wind-tunnel", "wind_tunnel", "wind tunnel")
    module = ModuleType("wind_tunnel")
    module.judge = lambda question, known=None: Findings(model="wind-tunnel", outside="calm")
    monkeypatch.setitem(sys.modules, "wind_tunnel", module)
    answer = kaidan.assess("kenaf", FLIGHT, model="wind-tunnel")
    assert (answer.verdict, answer.exit_code) == ("outside-model", 3)
    assert answer.reason == "The wind tunnel has no answer: calm."


def test_what_a_test_added_is_forgotten():
    assert "wind" not in modes.FAILURE_MODES
    assert "wind-tunnel" not in modes.MODELS
    with pytest.raises(InputError, match="model = 'wind-tunnel' is not known; known: contact, "):
        Question.of("kenaf", FLIGHT, model="wind-tunnel")
