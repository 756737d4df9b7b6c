"""`kaidan schema`: every sheet, the question and every answer has one, and it is a schema."""

import json
import sys
from pathlib import Path

import jsonschema
import pytest
from typer.testing import CliRunner

from kaidan.cli import app
from kaidan.cli.schema import DIALECT, KINDS, schema_of
from kaidan.errors import InputError
from kaidan.lab.cli import schema as laboratory

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "_ext"))
from models import models


def test_every_answer_is_listed():
    targets = [*KINDS.values(), *laboratory.KINDS.values()]
    listed = {target.partition(":")[2] for target in targets}
    assert {answer.__name__ for answer in models("Answer")} <= listed


@pytest.mark.parametrize(
    ("words", "place"),
    [
        *((["schema", kind], place) for kind, place in KINDS.items()),
        *((["lab", "schema", kind], place) for kind, place in laboratory.KINDS.items()),
    ],
)
def test_every_schema_is_one_and_exact(words, place, monkeypatch):
    made = schema_of(place)  # once: it takes the time
    monkeypatch.setattr("kaidan.cli.schema.schema_of", {place: made}.__getitem__)
    printed = json.loads(CliRunner().invoke(app, words).stdout)
    assert printed == {"$schema": DIALECT} | made
    jsonschema.Draft202012Validator.check_schema(printed)
    assert printed["additionalProperties"] is False


def test_an_unknown_kind_is_refused_with_those_there_are():
    result = CliRunner().invoke(app, ["schema", "tranverse"])
    assert isinstance(result.exception, InputError)
    assert str(result.exception).startswith(
        "no schema is called 'tranverse'; did you mean traverse? Known: robot, stairs, "
    )
