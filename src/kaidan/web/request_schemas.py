"""JSON schemas of what a client may write: from the sheets, the signatures and their docstrings."""

import re
from collections.abc import Callable, Mapping
from inspect import Parameter, cleandoc
from typing import Any

from pydantic import BaseModel

from kaidan.question import Question
from kaidan.robot import Payload, Posture, PostureChange, Robot
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.web.asking import VERBS

PLACE = "#/components/schemas/{model}"
SHEETS: tuple[type[BaseModel], ...] = (
    Robot, Stairs, Surface, Question, Payload, Posture, PostureChange,
)  # fmt: skip
"""Sheets that a body may hold."""
_ENTRY = re.compile(r"^(\*{0,2}\w[\w, *]*) : .*\n((?:[ ]{4}.*\n?|\n)+)", re.MULTILINE)


def of(model: type[BaseModel]) -> dict[str, Any]:
    """Reference to the schema of a model."""
    return {"$ref": PLACE.format(model=model.__name__)}


_TEXT = {"type": "string"}
_NUMBER = {"type": "number"}
_QUANTITY = {"anyOf": [_NUMBER, _TEXT]}
_RANGE = {
    "anyOf": [
        *_QUANTITY["anyOf"],
        {"type": "array", "items": _NUMBER, "minItems": 2, "maxItems": 2},
    ]
}
_FIGURES = {
    "anyOf": [
        _TEXT,
        {"type": "array", "items": _TEXT},
        {"type": "object", "additionalProperties": _QUANTITY},
    ]
}
_POINTS = {
    "type": "array",
    "items": {"type": "array", "items": _NUMBER, "minItems": 2, "maxItems": 2},
}
_INCLINED = {
    "type": "object",
    "required": ["angle", "nosing_spacing"],
    "properties": {"angle": _QUANTITY, "nosing_spacing": _QUANTITY, "steps": {"type": "integer"}},
    "additionalProperties": False,
}
_PROFILE = {"type": "object", "required": ["points"], "properties": {"points": _POINTS}}
_FLIGHT = [_TEXT, of(Stairs), _INCLINED]
_WRITTEN: Mapping[str, Mapping[str, Any]] = {
    "robot": {"anyOf": [_TEXT, of(Robot)]},
    "robots": {"type": "array", "items": {"anyOf": [_TEXT, of(Robot)]}},
    "stairs": {
        "anyOf": [*_FLIGHT, {"type": "array", "items": {"anyOf": _FLIGHT}}, _POINTS, _PROFILE]
    },
    "surface": {"anyOf": [_TEXT, of(Surface)]},
    "flippers": {
        "anyOf": [
            _TEXT,
            of(Posture),
            {"type": "array", "prefixItems": [of(Posture)], "items": of(PostureChange)},
        ]
    },
    "payload": {
        "anyOf": [_TEXT, of(Payload), {"type": "array", "items": {"anyOf": [_TEXT, of(Payload)]}}]
    },
    "friction": _RANGE,
    "theta_d": _RANGE,
    "theta_M": _RANGE,
    "limits": _RANGE,
    "override": _FIGURES,
    "uncertainty": _FIGURES,
}
"""How what is more than a number or a word is written."""
_BY_DEFAULT: Mapping[type, Mapping[str, Any]] = {
    bool: {"type": "boolean"},
    int: {"type": "integer"},
    float: _QUANTITY,
    str: _TEXT,
}
_BY_ANNOTATION: Mapping[Any, Mapping[str, Any]] = {
    int | None: {"type": "integer"},
    float | str | None: _QUANTITY,
    str | None: _TEXT,
}


def body_of(verb: str) -> dict[str, Any]:
    """Schema of the body of a verb."""
    each = VERBS[verb]
    meant = meanings(Question.of) | meanings(each.load())
    properties = {
        name: {**_schema(name, parameter), "description": meant.get(name, "")}
        for name, parameter in each.parameters().items()
    }
    if each.takes_question:
        said = "as an answer has it, instead of robot and stairs; other keywords change it"
        properties["question"] = {**of(Question), "description": said}
    if each.open:
        properties = {name: {"description": one["description"]}
                      for name, one in properties.items()}  # fmt: skip
    required = [] if each.takes_question else list(each.required)
    return {
        "type": "object",
        "required": required,
        "properties": properties,
        "additionalProperties": each.open,
    }


def _schema(name: str, parameter: Parameter) -> Mapping[str, Any]:
    """Schema of a keyword: as it is written, else after its annotation, else after its default."""
    if name in _WRITTEN:
        return _WRITTEN[name]
    if parameter.annotation in _BY_ANNOTATION:
        return _BY_ANNOTATION[parameter.annotation]
    return _BY_DEFAULT.get(type(parameter.default), _QUANTITY)


def meanings(function: Callable[..., Any]) -> dict[str, str]:
    """Meaning of each parameter, from the docstring of its function.

    Examples
    --------
    >>> meanings(Question.of)["speed"]
    '[m/s]; or a text such as "0.2m/s".'
    """
    text = cleandoc(function.__doc__ or "").partition("Parameters\n----------\n")[2]
    found = {}
    for names, meaning in _ENTRY.findall(re.split(r"\n\w+\n---", text)[0] + "\n"):
        for name in names.split(","):
            found[name.strip(" *")] = " ".join(meaning.split())
    return found
