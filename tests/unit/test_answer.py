"""The answer as one JSON object: its schema, and that every answer of any model keeps to it."""

import dataclasses
import json
import math
from functools import partial

import jsonschema
import pytest
from typer.testing import CliRunner

import kaidan
from kaidan import Assessment, Payload, Posture, Robot, Stairs, Surface
from kaidan.assessment import MODELS
from kaidan.cli import app

pytestmark = pytest.mark.usefixtures("compiled_kernel")

NAMED_BY_THE_ISSUE = [
    "verdict",
    "model",
    "governs",
    "angle_deg",
    "nosing_spacing_m",
    "contacts_n",
    "margin_angle_deg",
    "lower_angle_deg",
    "margin_backward_deg",
    "margin_deg",
    "margin_centroid_mm",
    "allowances",
    "a_slip_up",
    "a_slip_down",
    "a_tip_downhill",
    "a_tip_uphill",
    "falls_over",
    "a_max",
    "a_min",
    "paper",
    "required_friction",
    "probability",
]


def flight(angle, p, **more):
    return Stairs.inclined(angle=math.radians(angle), nosing_spacing=p, **more)


def doubtful(name="kenaf"):
    sheet = Robot.named(name).model_dump()
    return Robot.model_validate(sheet | {"uncertainty": {"com_from_front": 0.005}})


def controlled():
    drive = {"max_speed": 0.5, "acceleration_control": True}
    return Robot.model_validate(Robot.named("kenaf").model_dump() | {"drive": drive, "mass": 20})


def answers():
    """One of every kind: all verdicts, known and unknown, certain and uncertain, both models."""
    for model in MODELS:
        yield from answers_of(partial(kaidan.assess, model=model))


def answers_of(assess):
    yield assess("kenaf", flight(40, 0.15), friction=2.0, speed=0.1)
    yield assess("kenaf", flight(40, 0.15))
    yield assess("kenaf", flight(57, 0.15), friction=2.0)
    yield assess("kenaf", flight(62, 0.22), friction=0.5, acceleration=0.3)
    yield assess("kenaf", flight(10, 0.22), friction=0.2)
    yield assess("kenaf", flight(80, 0.15), friction=2.0, theta_d=0.3, theta_M=0.3)
    yield assess("kenaf", "ibc")
    yield assess(doubtful(), "ibc", surface="concrete-wet")
    yield assess(doubtful(), flight(59, 0.15), surface=Surface.of_friction(2.0, 0.1))
    yield assess(doubtful(), flight(30, 0.15))
    yield assess(controlled(), flight(52, 0.2), friction=3.0, theta_d=0.0, theta_M=0.0)
    load = Payload(mass=3, from_front=0.3, height=0.4)
    yield assess("absolem", "japan-dwelling", flippers="flat", payload=load, speed=0.2)
    yield assess("absolem", flight(30, 0.2), flippers=Posture(front=-0.5))
    yield assess("kenaf", flight(40, 0.1, steps=2), direction="down", facing="tail-first")


@pytest.fixture(scope="module")
def schema():
    return json.loads(CliRunner().invoke(app, ["schema", "answer"]).stdout)


def test_the_command_prints_the_schema_of_assessment(schema):
    assert schema.pop("$schema") == "https://json-schema.org/draft/2020-12/schema"
    assert schema == Assessment.json_schema()


def test_the_schema_is_one(schema):
    jsonschema.Draft202012Validator.check_schema(schema)


def test_the_schema_names_every_field_the_issue_asks_for(schema):
    assert set(NAMED_BY_THE_ISSUE) <= set(schema["properties"])
    assert schema["properties"]["verdict"]["enum"] == ["go", "caution", "no-go", "outside-model"]
    paper = schema["$defs"]["Paper"]
    assert set(paper["properties"]) == {"a_S", "min_a_r0", "max_a_rn", "a_max", "a_min"}


def test_the_schema_is_exact_and_explains_itself(schema):
    """Nothing is optional, nothing may be added, and every property says what it is."""
    said_by_their_names = {"robot", "stairs", "surface", "direction", "facing"}
    said_by_their_names |= {"tip_downhill", "tip_uphill", "slip_down"}
    for table in (schema, *schema["$defs"].values()):
        assert table["additionalProperties"] is False
        assert table["required"] == list(table["properties"])
        for name, property_ in table["properties"].items():
            assert name in said_by_their_names or property_["description"], name


def test_every_kind_of_answer_keeps_to_the_schema(schema):
    validator = jsonschema.Draft202012Validator(schema)
    seen = set()
    for answer in answers():
        document = json.loads(answer.to_json())
        validator.validate(document)
        assert list(document) == [field.name for field in dataclasses.fields(answer)]
        seen.add((document["verdict"], document["governs"], document["model"]))
    assert {model for _, _, model in seen} == set(MODELS)
    assert {verdict for verdict, _, _ in seen} == {"go", "caution", "no-go", "outside-model"}
    assert len(seen) >= 12


def test_the_schema_refuses_what_is_no_answer(schema):
    validator = jsonschema.Draft202012Validator(schema)
    good = json.loads(kaidan.assess("kenaf", flight(40, 0.15)).to_json())
    assert validator.is_valid(good)
    for spoilt in (
        good | {"verdict": "GO"},
        good | {"governs": "luck"},
        good | {"margin_deg": "5"},
        good | {"more": 1},
        {key: value for key, value in good.items() if key != "model"},
    ):
        assert not validator.is_valid(spoilt)


def test_json_is_plain():
    """Without NaN or infinity, in ASCII, the same each time, numbers as they are."""
    for answer in answers():
        text = answer.to_json()
        assert text.isascii()
        document = json.loads(text, parse_constant=pytest.fail)
        assert document == json.loads(json.dumps(dataclasses.asdict(answer)))
        assert text == answer.to_json()


def test_an_answer_cannot_be_changed():
    answer = kaidan.assess("kenaf", flight(40, 0.15))
    with pytest.raises(dataclasses.FrozenInstanceError):
        answer.verdict = "go"
