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

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "_ext"))
from models import models


def test_every_answer_is_listed():
    listed = {target.partition(":")[2] for target in KINDS.values()}
    assert {answer.__name__ for answer in models("Answer")} <= listed


@pytest.mark.parametrize("kind", KINDS)
def test_every_schema_is_one_and_exact(kind, monkeypatch):
    made = schema_of(kind)  # once: it takes the time
    monkeypatch.setattr("kaidan.cli.schema.schema_of", {kind: made}.__getitem__)
    printed = json.loads(CliRunner().invoke(app, ["schema", kind]).stdout)
    assert printed == {"$schema": DIALECT} | made
    jsonschema.Draft202012Validator.check_schema(printed)
    assert printed["additionalProperties"] is False


def test_an_unknown_kind_is_refused_with_those_there_are():
    result = CliRunner().invoke(app, ["schema", "tranverse"])
    assert isinstance(result.exception, InputError)
    assert str(result.exception).startswith(
        "no schema is called 'tranverse'; did you mean traverse? Known: robot, stairs, "
    )
