"""The service: routes that hand questions to worker processes, and the page's files."""

from collections.abc import AsyncIterator, Mapping
from contextlib import asynccontextmanager
from pathlib import Path
from sqlite3 import OperationalError
from typing import Any, Literal

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, Response
from fastapi.staticfiles import StaticFiles
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect

import kaidan
from kaidan import catalog
from kaidan.errors import KaidanError, fault
from kaidan.robot import Robot
from kaidan.sheet import Sheet
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.text.japanese import patterns
from kaidan.text.page import page_texts
from kaidan.web import file_routes, job_routes, live_routes, openapi, report_routes
from kaidan.web.asking import VERBS
from kaidan.web.bodies import GONE, LARGEST_UPLOAD, client_of, json_of, while_there
from kaidan.web.job_table import JobTable
from kaidan.web.jobs import Jobs
from kaidan.web.remembered import Remembered
from kaidan.web.sessions import Sessions
from kaidan.web.space import FULL, is_full
from kaidan.web.state import State
from kaidan.web.urgency import Hands
from kaidan.web.workers import Limits

STATIC = Path(__file__).parent / "static"
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
_KINDS = {404: "not-found", 405: "method", 413: "too-large", 429: "share", 503: "busy"}


def app_of(state: State, *, workers: int, limits: Limits | None = None) -> FastAPI:
    """Application, to be put behind a ``kaidan.web.guard.Guard``.

    Parameters
    ----------
    state : State
        Folder that it keeps things in.
    workers : int
        Processes that answer quick questions, and as many for those that take longer.
    limits : Limits, optional
        What one question may take.
    """
    hands = Hands(workers, limits or Limits(), state.passing)
    jobs = Jobs(JobTable(state.jobs), hands.thorough)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        async with hands, jobs:
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
    _add_errors(app)
    _add_catalogue(app)
    _add_verbs(app, Remembered(hands.ask))
    report_routes.add(app, hands.thorough)
    files = file_routes.Files(state.passing)
    file_routes.add(app, hands.thorough, files)
    job_routes.add(app, jobs, Sessions(state.folder / "key"), files)
    live_routes.add(app, hands)
    app.openapi = lambda: openapi.described(app)  # type: ignore[method-assign]
    app.mount("/", StaticFiles(directory=STATIC, html=True), name="page")
    return app


def _add_errors(app: FastAPI) -> None:
    @app.exception_handler(KaidanError)
    async def refuse(request: Request, error: Exception) -> JSONResponse:
        return JSONResponse({"error": str(error), "kind": "input"}, 422)

    @app.exception_handler(ClientDisconnect)
    async def let_go(request: Request, error: Exception) -> Response:
        return Response(status_code=GONE)  # it left in the middle of its body; nobody reads this

    @app.exception_handler(OSError)
    @app.exception_handler(OperationalError)
    async def say_full(request: Request, error: Exception) -> JSONResponse:
        if not is_full(error):
            raise error
        return JSONResponse({"error": FULL, "kind": "full"}, 507)

    @app.exception_handler(HTTPException)
    async def say(request: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, HTTPException)
        said = {"error": str(error.detail), "kind": _KINDS.get(error.status_code, "input")}
        return JSONResponse(said, error.status_code, headers=dict(error.headers or {}))

    @app.exception_handler(RequestValidationError)
    async def explain(request: Request, error: Exception) -> JSONResponse:
        assert isinstance(error, RequestValidationError)
        first = error.errors()[0]
        where = ".".join(str(each) for each in first["loc"])
        return JSONResponse({"error": f"{where} {fault(first)}", "kind": "input"}, 422)


def _add_catalogue(app: FastAPI) -> None:
    @app.get("/api/catalogue")
    async def catalogue() -> dict[str, list[dict[str, str | bool]]]:
        """Names and titles of robots, stairs and surfaces, and which robots nobody weighed."""
        return {
            kind: [
                {"name": name, "title": _SHEETS[kind].named(name).title}
                | ({"unweighed": True} if folder == "unweighed" else {})
                for folder in folders
                for name in catalog.names(folder)
            ]
            for kind, folders in _FOLDERS.items()
        }

    @app.get("/api/texts")
    async def texts() -> dict[str, Any]:
        """Texts of the page, in every language that it speaks, and patterns of sentences."""
        return page_texts() | {"sentences": patterns()}

    @app.get("/api/catalogue/{kind}/{name}")
    async def sheet(kind: Literal["robots", "stairs", "surfaces"], name: str) -> Response:
        """A data sheet, whole."""
        stem = name.strip().lower()
        if not any(stem in catalog.names(folder) for folder in _FOLDERS[kind]):
            raise HTTPException(404, f"no such name in {kind}")
        found: Sheet = _SHEETS[kind].named(stem)
        return Response(found.to_json(), media_type="application/json")


def _add_verbs(app: FastAPI, hands: Remembered) -> None:
    def add(path: str, kind: str, verb: str, summary: str, schema: Any) -> None:
        async def answer(request: Request) -> Response:
            body = await json_of(request)
            task = {"kind": kind, "verb": verb, "body": body}
            return await while_there(request, hands.ask(task, client_of(request)))

        app.add_api_route(
            path, answer, methods=["POST"], name=path.removeprefix("/api/").replace("/", "_"),
            summary=summary, openapi_extra=openapi.asked(verb, schema),
        )  # fmt: skip

    for verb, each in VERBS.items():
        add(f"/api/{verb}", "ask", verb, f"As kaidan {verb} --json", each.answers())
        add(f"/api/text/{verb}", "text", verb, f"As kaidan {verb} says it", openapi.Said)
