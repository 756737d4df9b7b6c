"""The description of the service, OpenAPI 3.1, from the sheets and answers that there are."""

from collections.abc import Mapping
from functools import cache
from inspect import signature
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from pydantic import BaseModel

from kaidan.question import Question
from kaidan.verbs.report.answer import Report
from kaidan.web.asking import VERBS
from kaidan.web.job_table import JobState
from kaidan.web.long_work import JOBS

_PLACE = "#/components/schemas/{model}"


class Said(BaseModel):
    """An answer in words."""

    text: str
    """As the command prints it."""
    short: str
    """In one line."""


class Refusal(BaseModel):
    """Why there is no answer."""

    error: str
    """As the command says it."""
    kind: str
    """In one word."""


class ProgressShown(BaseModel):
    """How far a job is."""

    what: str
    """What is counted."""
    done: int
    of: int
    """How many there are; 0: nobody knows."""


class JobShown(BaseModel):
    """A job as its owner sees it."""

    id: str
    verb: str
    state: JobState
    progress: ProgressShown
    created: float
    """Seconds since 1970."""
    ended: float | None
    error: Refusal | None
    """Why it failed."""
    result: str | None
    """Address of what it came to, once it is done."""


class JobList(BaseModel):
    """Jobs of a session."""

    jobs: list[JobShown]


_ERRORS = {"422": "the question has no meaning, or takes too long", "503": "ask again"}


def asked(verb: str, answer: type[BaseModel]) -> dict[str, Any]:
    """What a route of a verb takes and gives."""
    return {
        "requestBody": {
            "required": True,
            "content": {"application/json": {"schema": _body(verb)}},
        },
        "responses": _responses(answer),
    }


def written(formats: tuple[str, ...]) -> dict[str, Any]:
    """What the route of reports takes and gives."""
    properties: dict[str, Any] = {name: {} for name in signature(Question.of).parameters}
    properties |= {"robots": {}, "question": {}, "format": {"enum": [*formats, "json"]}}
    schema = {"type": "object", "properties": properties, "additionalProperties": False}
    return {
        "requestBody": {"required": True, "content": {"application/json": {"schema": schema}}},
        "responses": _responses(Report)
        | {
            "200": {
                "description": "the document",
                "content": {
                    "application/json": {"schema": {"$ref": _PLACE.format(model="Report")}},
                    "application/pdf": {},
                    "text/html": {},
                },
            }
        },
    }


def uploaded(verb: str) -> dict[str, Any]:
    """What a route takes that reads a file."""
    properties = {"file": {"type": "string", "contentMediaType": "application/octet-stream"}}
    schema = {"type": "object", "required": ["file"], "properties": properties}
    return {
        "requestBody": {"required": True, "content": {"multipart/form-data": {"schema": schema}}},
        "responses": {"200": {"description": "the answer"}},
    }


def job_request() -> dict[str, Any]:
    """What begins a job."""
    schema = {
        "type": "object",
        "required": ["verb", "body"],
        "properties": {"verb": {"enum": list(JOBS)}, "body": {"type": "object"}},
    }
    return {
        "requestBody": {"required": True, "content": {"application/json": {"schema": schema}}},
        "responses": {"201": _responses(JobShown)["200"], "422": _responses(JobShown)["422"]},
    }


def gives(answer: type[BaseModel]) -> dict[str, Any]:
    """What a route gives."""
    return {"responses": {"200": _responses(answer)["200"]}}


def _responses(answer: type[BaseModel]) -> dict[str, Any]:
    def of(model: type[BaseModel], description: str) -> dict[str, Any]:
        place = {"$ref": _PLACE.format(model=model.__name__)}
        return {"description": description, "content": {"application/json": {"schema": place}}}

    return {"200": of(answer, "the answer")} | {
        status: of(Refusal, why) for status, why in _ERRORS.items()
    }


@cache
def _body(verb: str) -> dict[str, Any]:
    each = VERBS[verb]
    return {
        "type": "object",
        "required": [],
        "properties": {name: {} for name in each.parameters()},
        "additionalProperties": each.open,
    }


def described(app: FastAPI) -> dict[str, Any]:
    """Description of an application, made once."""
    if app.openapi_schema is None:
        whole = get_openapi(
            title=app.title, version=app.version, description=app.description, routes=app.routes
        )
        schemas = whole.setdefault("components", {}).setdefault("schemas", {})
        models: list[type[BaseModel]] = [Said, Refusal, Report, JobList]
        models += [each.answers() for each in VERBS.values()]
        for model in models:
            schemas |= _schemas(model)
        app.openapi_schema = whole
    return app.openapi_schema


def _schemas(model: type[BaseModel]) -> Mapping[str, Any]:
    made = model.model_json_schema(ref_template=_PLACE, mode="serialization")
    return {**made.pop("$defs", {}), model.__name__: made}
