"""The answer of assess: its schema, its JSON both ways, its text and table, for every model."""

import json
import math

import jsonschema
import pytest
from pydantic import ValidationError
from typer.testing import CliRunner

import kaidan
from kaidan import Assessment, Payload, Posture, Profile, Robot, Stairs, Surface
from kaidan.cli import app
from kaidan.modes import (
    CLOSED_FORM,
    FAILURE_MODES,
    MODELS,
    PHYSICS,
    SUPPORT_POLYGON,
    Undecided,
    Verdict,
)
from one_posture import assess

NAMED_BY_THE_ISSUE = {
    "verdict",
    "model",
    "governs",
    "reason",
    "phase",
    "step",
    "margin_deg",
    "margin_best_deg",
    "margin_interval_deg",
    "failure_probability",
    "findings",
    "required_friction",
    "allowances",
    "angle_deg",
    "nosing_spacing_m",
    "question",
    "notes",
    "what_would_help",
    *(name.replace("-", "_") for name in MODELS),
}
OF_A_SHEET = {"Question", "Robot", "Track", "FlipperPair", "Drive", "Uncertainty", "Stairs"}
OF_A_SHEET |= {"StairsUncertainty", "Surface", "Payload", "Posture", "PostureChange", "State"}
OF_A_SHEET |= {"Allowance", "Friction", "Gap", "Opening"}
"""Parts of the schema that are inputs: what has a default may be left out."""


def flight(angle, p, **more):
    return Stairs.inclined(angle=math.radians(angle), nosing_spacing=p, **more)


def like(name, **changes):
    return Robot.model_validate(Robot.named(name).model_dump() | changes)


DOUBTFUL = like("kenaf", uncertainty={"com_from_front": 0.005})
CONTROLLED = like("kenaf", mass=20, drive={"max_speed": 0.5, "acceleration_control": True})
GAUGED = like("kenaf", track=Robot.named("kenaf").track.model_dump() | {"gauge": 0.3})
LOAD = Payload(mass=3, from_front=0.3, height=0.4)
POINTS = [(0.0, 0.0), (2.0, 0.0), (2.0, 0.09), (2.12, 0.09), (2.12, 0.18), (2.24, 0.18)]
POINTS += [(2.24, 0.27), (2.36, 0.27), (2.36, 0.36), (2.48, 0.36), (2.48, 0.45), (5.0, 0.45)]
ASKED = [
    ("kenaf", flight(40, 0.15), {"friction": 2.0, "speed": 0.1}),
    ("kenaf", flight(40, 0.15), {}),
    ("kenaf", flight(57, 0.15), {"friction": 2.0}),
    ("kenaf", flight(62, 0.22), {"friction": 0.5, "acceleration": 0.3}),
    ("kenaf", flight(10, 0.22), {"friction": 0.2}),
    ("kenaf", flight(80, 0.15), {"friction": 2.0, "theta_d": 0.3, "theta_M": 0.3}),
    ("kenaf", "ibc", {}),
    (DOUBTFUL, "ibc", {"surface": "concrete-wet"}),
    (DOUBTFUL, flight(59, 0.15), {"surface": Surface.of_friction(2.0, 0.1)}),
    (DOUBTFUL, flight(30, 0.15), {}),
    (CONTROLLED, flight(52, 0.2), {"friction": 3.0, "theta_d": 0.0, "theta_M": 0.0}),
    ("absolem", "japan-dwelling", {"flippers": "flat", "payload": LOAD, "speed": 0.2}),
    ("absolem", flight(30, 0.2), {"flippers": Posture(front=-0.5)}),
    ("kenaf", flight(40, 0.1, steps=2), {"direction": "down", "facing": "tail-first"}),
    (GAUGED, flight(35, 0.15), {"friction": 1.0, "yaw": 0.2}),
    (GAUGED, flight(50, 0.15), {"friction": (0.6, 2.0)}),
    ("kenaf", flight(61.5, 0.15), {"friction": 3.0, "fall_reserve": 0.0}),
    (GAUGED, [flight(40, 0.15), flight(30, 0.15)], {"friction": 2.0}),
    (GAUGED, Profile.of_points(POINTS, name="measured"), {"friction": 2.0}),
    (GAUGED, Profile.of_points([(0.0, 0.0), (4.0, 0.0)], name="floor"), {"friction": 2.0}),
]


@pytest.fixture(scope="module")
def answers():
    """One of every kind: all verdicts, known and unknown, certain and uncertain, all models."""
    trial = kaidan.assess(GAUGED, flight(35, 0.15, steps=6), friction=1.0, model=PHYSICS.name)
    return [
        trial,
        *(assess(robot, stairs, **manner) for robot, stairs, manner in ASKED),
        *(
            assess(robot, stairs, **manner, model=CLOSED_FORM.name)
            for robot, stairs, manner in ASKED
            if "yaw" not in manner
        ),
        *(
            assess(robot, stairs, **manner, model=SUPPORT_POLYGON.name)
            for robot, stairs, manner in ASKED
            if robot in (GAUGED, "absolem")
        ),
    ]


@pytest.fixture(scope="module")
def schema():
    return json.loads(CliRunner().invoke(app, ["schema", "answer"]).stdout)


def test_the_command_prints_the_schema_of_assessment(schema):
    assert schema.pop("$schema") == "https://json-schema.org/draft/2020-12/schema"
    assert schema == Assessment.json_schema()


def test_the_schema_is_one(schema):
    jsonschema.Draft202012Validator.check_schema(schema)


def test_the_schema_names_every_field_that_readers_stand_on(schema):
    missing = NAMED_BY_THE_ISSUE - {PHYSICS.name} - set(schema["properties"])
    assert not missing
    assert schema["properties"]["verdict"]["enum"] == list(Verdict)
    paper = schema["$defs"]["Paper"]
    assert set(paper["properties"]) == {"a_S", "min_a_r0", "max_a_rn", "a_max", "a_min"}


def test_the_schema_is_exact_and_explains_itself(schema):
    """In an answer nothing is optional, nothing may be added, and everything says what it is."""
    tables = {"": schema} | schema["$defs"]
    for title, table in tables.items():
        if table["type"] != "object":
            continue
        assert table["additionalProperties"] is False, title
        if title not in OF_A_SHEET:
            assert table["required"] == list(table["properties"]), title
        for name, property_ in table["properties"].items():
            assert property_.get("description"), (title, name)


def test_every_kind_of_answer_keeps_to_the_schema(schema, answers):
    validator = jsonschema.Draft202012Validator(schema)
    for answer in answers:
        document = json.loads(answer.to_json())
        validator.validate(document)
        assert list(document) == list(Assessment.model_fields)
    assert {answer.model for answer in answers} == set(MODELS)
    assert {answer.verdict for answer in answers} == set(Verdict)
    assert len({(answer.verdict, answer.governs, answer.model) for answer in answers}) >= 16


def test_what_governs_is_a_finding_or_declared_to_be_none(answers):
    for answer in answers:
        if answer.governs in set(Undecided):
            assert answer.verdict in ("unsure", "outside-model")
        else:
            assert answer.governs in answer.findings
        assert set(answer.findings) <= set(FAILURE_MODES)
        assert set(answer.doubts) <= set(answer.findings)
        if answer.verdict == "no-go":
            assert answer.findings[answer.governs].holds is False or answer.failure_probability


def test_every_number_says_which_model_it_is_from(answers):
    own = {name: name.replace("-", "_") for name in MODELS}
    for answer in answers:
        others = set(own.values()) - {own[answer.model], "support_polygon"}
        assert all(getattr(answer, name) is None for name in others)
        if answer.support_polygon is not None:  # the contact model asks it too
            assert answer.model in ("contact", "support-polygon")
        models = {one.model for one in answer.findings.values()}
        assert models <= {answer.model, "support-polygon"}
        if answer.verdict != "outside-model":
            assert getattr(answer, own[answer.model]) is not None


def test_the_schema_refuses_what_is_no_answer(schema, answers):
    validator = jsonschema.Draft202012Validator(schema)
    good = json.loads(answers[1].to_json())
    assert validator.is_valid(good)
    for spoilt in (
        good | {"verdict": "GO"},
        good | {"margin_deg": "5"},
        good | {"more": 1},
        good | {"question": good["question"] | {"risk": 0.9}},
        {key: value for key, value in good.items() if key != "model"},
    ):
        assert not validator.is_valid(spoilt)


def test_json_is_plain(answers):
    """Without NaN or infinity, in ASCII, the same each time, numbers as they are."""
    for answer in answers:
        text = answer.to_json()
        assert text.isascii()
        assert json.loads(text, parse_constant=pytest.fail) == answer.to_dict()
        assert text == answer.to_json()


def test_read_back_from_its_json_it_is_equal(answers):
    for answer in answers:
        again = Assessment.from_json(answer.to_json())
        assert again == answer
        assert again.to_json() == answer.to_json()
        assert str(again) == str(answer)


def test_asked_again_with_its_own_question_it_is_the_same(answers):
    for answer in answers[1::4]:
        again = Assessment.from_json(answer.to_json()).question
        assert kaidan.assess(again) == answer


def test_it_is_shown_as_text_and_as_a_table(answers):
    for answer in answers:
        lines = str(answer).splitlines()
        assert lines[0].startswith(Verdict(answer.verdict).label)
        assert answer.reason in str(answer)
        assert repr(answer) == f"<Assessment: {lines[0]}>"
        table = answer._repr_html_()
        assert f"<td>verdict</td><td>{answer.verdict}</td>" in table
        assert table.count("<tr>") == table.count("</tr>") > len(Assessment.model_fields)
        assert answer.reason in answer.details()


def test_its_text_is_that_of_the_command():
    words = ["assess", "kenaf", "ibc", "--friction", "1.0", "--flippers", "stowed"]
    said = CliRunner().invoke(app, words).stdout
    answer = assess("kenaf", "ibc", friction=1.0)
    assert said == f"{answer}\n"
    said = CliRunner().invoke(app, [*words, "--json"]).stdout
    assert said == f"{answer.to_json()}\n"


def test_an_answer_cannot_be_changed(answers):
    with pytest.raises(ValidationError):
        answers[0].verdict = "go"


def test_a_fall_is_no_rotation_that_ends():
    answer = kaidan.assess("kenaf", "ibc")
    rows = answer.details().splitlines()
    assert "  falls           over (enter, step 1)" in rows
    assert not any(row.startswith("  rotates ") for row in rows)
    assert answer.findings["rotation"].holds is answer.findings["impact"].holds is None


def test_a_change_that_leaves_the_verdict_as_it_is_says_so():
    answer = assess("absolem", "ada", friction=0.6)
    assert "  not enough      Lay the flippers flat, in line with the track: still NO-GO (" in str(
        answer
    )
    assert "\n  limit           " in str(answer)


def test_where_nothing_helps_it_says_so():
    answer = kaidan.assess("kenaf", "ibc", friction=0.6)
    assert answer.what_would_help == ()
    assert "  limit           L carries a nosing spacing up to 235 mm, not 331 mm" in str(answer)
    unlimited = answer.model_copy(update={"limits": ()})
    assert "  help            none of the changes that were tried" in str(unlimited).splitlines()
