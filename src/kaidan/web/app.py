"""The service: routes that hand questions to worker processes, and the page's files."""

import json
import shutil
import tempfile
from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any, Literal

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, Response
from fastapi.staticfiles import StaticFiles
from starlette.exceptions import HTTPException

import kaidan
from kaidan import catalog
from kaidan.errors import InputError, KaidanError, shown
from kaidan.robot import Robot
from kaidan.sheet import Sheet
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.text.page import page_texts
from kaidan.web import openapi
from kaidan.web.asking import VERBS
from kaidan.web.guard import Guard
from kaidan.web.workers import Limits, Reply, Workers

STATIC = Path(__file__).parent / "static"
LARGEST_BODY = 2 << 20
"""Largest body of a question [bytes]."""
LARGEST_UPLOAD = 256 << 20
"""Largest upload [bytes]."""
_UPLOAD_SECONDS = 120.0
"""Time to read a file [s]."""
_DOCUMENTS = {"html": "text/html; charset=utf-8", "pdf": "application/pdf"}
_OF_A_DOCUMENT = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'"
"""A document has its style and its pictures inside, and nothing that runs."""
_FOLDERS: Mapping[str, tuple[catalog.Folder, ...]] = {
    "robots": ("robots", "unweighed"),
    "stairs": ("stairs",),
    "surfaces": ("surfaces",),
}
_SHEETS: Mapping[str, type[Robot | Stairs | Surface]] = {
    "robots": Robot,
    "stairs": Stairs,
    "surfaces": Surface,
}


def app_of(
    *, workers: int, limits: Limits | None = None, token: str = "", hosts: tuple[str, ...] = ()
) -> FastAPI:
    """Application.

    Parameters
    ----------
    workers : int
        Processes that answer.
    limits : Limits, optional
        What one question may take.
    token, hosts
        As `kaidan.web.guard.Guard` has them.
    """
    hands = Workers(workers, limits or Limits())

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        async with hands:
            yield

    app = FastAPI(
        title="kaidan",
        version=kaidan.__version__,
        description="Can this tracked robot take these stairs?",
        lifespan=lifespan,
        docs_url=None,
        redoc_url=None,
        openapi_url="/api/openapi.json",
        telemetry={"tracing": False, "metrics": False, "logs": False},
        max_body_size=LARGEST_UPLOAD,
    )
    app.state.workers = hands
    app.add_middleware(Guard, token=token, hosts=hosts)
    _add_errors(app)
    _add_catalogue(app)
    _add_verbs(app, hands)
    _add_files(app, hands)
    _add_report(app, hands)
    app.openapi = lambda: openapi.described(app)  # type: ignore[method-assign]
    app.mount("/", StaticFiles(directory=STATIC, html=True), name="page")
    return app


def _add_errors(app: FastAPI) -> None:
    @app.exception_handler(KaidanError)
    async def refuse(request: Request, error: Exception) -> JSONResponse:
        return JSONResponse({"error": str(error), "kind": "input"}, 422)

    @app.exception_handler(HTTPException)
    async def say(request: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, HTTPException)
        kind = {404: "not-found", 405: "method", 413: "too-large"}.get(error.status_code, "input")
        said = {"error": str(error.detail), "kind": kind}
        return JSONResponse(said, error.status_code, headers=dict(error.headers or {}))

    @app.exception_handler(RequestValidationError)
    async def explain(request: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, RequestValidationError)
        first = error.errors()[0]
        where = ".".join(str(each) for each in first["loc"])
        return JSONResponse({"error": f"{where}: {first['msg']}", "kind": "input"}, 422)


def _add_catalogue(app: FastAPI) -> None:
    @app.get("/api/catalogue")
    async def catalogue() -> dict[str, list[dict[str, str]]]:
        """Names and titles of robots, stairs and surfaces."""
        return {
            kind: [
                {"name": name, "title": _SHEETS[kind].named(name).title}
                for folder in folders
                for name in catalog.names(folder)
            ]
            for kind, folders in _FOLDERS.items()
        }

    @app.get("/api/texts")
    async def texts() -> dict[str, Any]:
        """Texts of the page, in every language that it speaks."""
        return page_texts()

    @app.get("/api/catalogue/{kind}/{name}")
    async def sheet(kind: Literal["robots", "stairs", "surfaces"], name: str) -> Response:
        """A data sheet, whole."""
        stem = name.strip().lower()
        if not any(stem in catalog.names(folder) for folder in _FOLDERS[kind]):
            raise HTTPException(404, f"no such name in {kind}")
        found: Sheet = _SHEETS[kind].named(stem)
        return Response(found.to_json(), media_type="application/json")


def _add_verbs(app: FastAPI, hands: Workers) -> None:
    def add(path: str, kind: str, verb: str, summary: str, schema: Any) -> None:
        async def answer(request: Request) -> Response:
            body = await _json_of(request)
            return _sent(await hands.ask({"kind": kind, "verb": verb, "body": body}))

        app.add_api_route(
            path, answer, methods=["POST"], name=path.removeprefix("/api/").replace("/", "_"),
            summary=summary, openapi_extra=openapi.asked(verb, schema), max_body_size=LARGEST_BODY,
        )  # fmt: skip

    for verb, each in VERBS.items():
        add(f"/api/{verb}", "ask", verb, f"As kaidan {verb} --json", each.answers())
        add(f"/api/text/{verb}", "text", verb, f"As kaidan {verb} says it", openapi.Said)


def _add_files(app: FastAPI, hands: Workers) -> None:
    def add(verb: str, summary: str) -> None:
        async def answer(request: Request) -> Response:
            return await _uploaded(request, verb, hands)

        app.add_api_route(
            f"/api/{verb}", answer, methods=["POST"], name=verb, summary=summary,
            openapi_extra=openapi.uploaded(verb),
        )  # fmt: skip

    add("read", "As kaidan read FILE --json")
    add("building", "As kaidan building FILE --json")
    add("sheets", "Robots and stairs of a file, as sheets")


def _add_report(app: FastAPI, hands: Workers) -> None:
    @app.post(
        "/api/report", openapi_extra=openapi.written(tuple(_DOCUMENTS)), max_body_size=LARGEST_BODY
    )
    async def report(request: Request) -> Response:
        """As kaidan report -o FILE."""
        body = await _json_of(request)
        form = body.pop("format", "html")
        if form not in (*_DOCUMENTS, "json"):
            known = ", ".join((*_DOCUMENTS, "json"))
            raise InputError(f"report: format {shown(form)} is not known; known: {known}")
        task = {"kind": "report", "format": form, "body": body}
        reply = await hands.ask(task, seconds=_UPLOAD_SECONDS)
        if form == "json" or reply.status != 200:
            return _sent(reply)
        headers = {
            "Content-Disposition": f'inline; filename="kaidan-report.{form}"',
            "Content-Security-Policy": _OF_A_DOCUMENT,
        }
        return Response(reply.content, 200, headers, _DOCUMENTS[form])


async def _uploaded(request: Request, verb: str, hands: Workers) -> Response:
    """Answer about a file, which lies in a folder of its own for as long as that takes."""
    async with request.form(max_files=1, max_fields=32, max_part_size=LARGEST_BODY) as form:
        file = form.get("file")
        if file is None or isinstance(file, str):
            raise InputError(f"{verb}: no file: send multipart/form-data with a part called file")
        fields = [(name, value) for name, value in form.multi_items() if isinstance(value, str)]
        folder = Path(tempfile.mkdtemp(prefix="kaidan-"))
        try:
            with (folder / "upload").open("wb") as kept:
                while chunk := await file.read(1 << 20):
                    kept.write(chunk)
            task: dict[str, Any] = {"kind": verb, "folder": str(folder), "file": "upload"}
            task["body"] = _values(fields)
            task["part"] = task["body"].pop("part", None)
            return _sent(await hands.ask(task, seconds=_UPLOAD_SECONDS))
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def _values(fields: list[tuple[str, str]]) -> dict[str, Any]:
    """Texts by name; those that came several times, and robots, as lists."""
    found: dict[str, Any] = {}
    for name, value in fields:
        if name in found:
            found[name] = (
                [*found[name], value] if isinstance(found[name], list) else [found[name], value]
            )
        else:
            found[name] = value
    return found


async def _json_of(request: Request) -> dict[str, Any]:
    """Object of a request's body.

    Raises
    ------
    HTTPException
        Another type of content.
    InputError
        No JSON object.
    """
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if kind != "application/json":
        raise HTTPException(415, "send application/json")
    try:
        body = json.loads(await request.body(), parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise InputError(f"the body is no JSON: {error}") from None
    if not isinstance(body, dict):
        raise InputError("the body is no JSON object")
    return body


def _refuse_constant(word: str) -> None:
    raise ValueError(f"{word} is no number of JSON")


def _sent(reply: Reply) -> Response:
    headers = {"Retry-After": "1"} if reply.status == 503 else None
    return Response(reply.content, reply.status, headers, "application/json")
