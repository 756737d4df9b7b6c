"""The description of the service, OpenAPI 3.1, from the sheets and answers that there are."""

from inspect import signature
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from pydantic import BaseModel
from pydantic.json_schema import JsonSchemaMode, models_json_schema

from kaidan.question import Question
from kaidan.verbs.report.answer import Report
from kaidan.web.asking import VERBS
from kaidan.web.job_table import JobState
from kaidan.web.long_work import JOBS
from kaidan.web.request_schemas import PLACE, SHEETS, body_of, of


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
    about: str
    """Robots and stairs of its body, by their names."""
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


_ERRORS = {
    "422": "the question has no meaning, or takes too long",
    "429": "the address has its share: ask again",
    "503": "ask again",
    "507": "the disk of the server is full",
}


def asked(verb: str, answer: type[BaseModel]) -> dict[str, Any]:
    """What a route of a verb takes and gives."""
    return {
        "requestBody": {
            "required": True,
            "content": {"application/json": {"schema": body_of(verb)}},
        },
        "responses": _responses(answer),
    }


def written(formats: tuple[str, ...]) -> dict[str, Any]:
    """What the route of reports takes and gives."""
    properties: dict[str, Any] = {name: {} for name in signature(Question.of).parameters}
    properties |= {"robots": {}, "question": {}, "format": {"enum": [*formats, "json"]}}
    properties["language"] = {"enum": ["en", "ja"]}
    schema = {"type": "object", "properties": properties, "additionalProperties": False}
    return {
        "requestBody": {"required": True, "content": {"application/json": {"schema": schema}}},
        "responses": _responses(Report)
        | {
            "200": {
                "description": "the document",
                "content": {
                    "application/json": {"schema": of(Report)},
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
    responses = _responses(JobShown)
    return {
        "requestBody": {"required": True, "content": {"application/json": {"schema": schema}}},
        "responses": {"201": responses.pop("200"), **responses},
    }


def gives(answer: type[BaseModel]) -> dict[str, Any]:
    """What a route gives."""
    return {"responses": {"200": _responses(answer)["200"]}}


def _responses(answer: type[BaseModel]) -> dict[str, Any]:
    def given(model: type[BaseModel], description: str) -> dict[str, Any]:
        return {"description": description, "content": {"application/json": {"schema": of(model)}}}

    return {"200": given(answer, "the answer")} | {
        status: given(Refusal, why) for status, why in _ERRORS.items()
    }


def described(app: FastAPI) -> dict[str, Any]:
    """Description of an application, made once."""
    if app.openapi_schema is None:
        whole = get_openapi(
            title=app.title, version=app.version, description=app.description, routes=app.routes
        )
        given: list[type[BaseModel]] = [Said, Refusal, Report, JobList]
        given += [each.answers() for each in VERBS.values()]
        modes: list[tuple[type[BaseModel], JsonSchemaMode]] = [
            *((each, "serialization") for each in given),
            *((each, "validation") for each in SHEETS),
        ]
        schemas = models_json_schema(modes, ref_template=PLACE)[1]["$defs"]
        whole.setdefault("components", {}).setdefault("schemas", {}).update(schemas)
        app.openapi_schema = whole
    return app.openapi_schema
