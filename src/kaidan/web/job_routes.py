"""Jobs over HTTP: each session sees its own."""

from collections.abc import Mapping
from typing import Any

from fastapi import FastAPI, Request
from fastapi.responses import FileResponse, JSONResponse, Response, StreamingResponse
from starlette.exceptions import HTTPException

from kaidan.errors import InputError, did_you_mean, shown
from kaidan.web import openapi
from kaidan.web.bodies import client_of, json_of, object_of, type_of
from kaidan.web.file_routes import Files
from kaidan.web.job_table import Job
from kaidan.web.jobs import Asker, Jobs
from kaidan.web.long_work import DOCUMENTS, FILES, JOBS, RESULT, TEXT
from kaidan.web.report_routes import OF_A_DOCUMENT
from kaidan.web.sessions import COOKIE, HEADER, KEPT, Sessions


def add(app: FastAPI, jobs: Jobs, sessions: Sessions, files: Files) -> None:
    """Add the routes of jobs."""

    def owner_of(request: Request) -> str | None:
        stated = request.headers.get(HEADER) or request.cookies.get(COOKIE, "")
        return sessions.owner(stated)

    def job_of(request: Request, identity: str) -> Job:
        owner = owner_of(request)
        job = None if owner is None else jobs.one(owner, identity)
        if job is None:
            raise HTTPException(404, "no such job")
        return job

    def done_of(request: Request, identity: str) -> Job:
        job = job_of(request, identity)
        if job.state != "done":
            raise HTTPException(409, f"the job is {job.state}")
        return job

    @app.post("/api/jobs", status_code=201, openapi_extra=openapi.job_request())
    async def new_job(request: Request) -> JSONResponse:
        """Begin long work in the background."""
        session = request.headers.get(HEADER) or request.cookies.get(COOKIE, "")
        owner, client = sessions.owner(session), client_of(request)
        line = owner or client
        if owner is None:
            session = sessions.new()
            owner = sessions.owner(session)
        assert owner is not None
        job = await _begun(request, jobs, files, Asker(owner, line, client))
        answer = JSONResponse(job.shown(), 201, {HEADER: session})
        answer.set_cookie(
            COOKIE, session, max_age=KEPT, httponly=True, samesite="strict", path="/api"
        )
        return answer

    @app.get("/api/jobs", openapi_extra=openapi.gives(openapi.JobList))
    async def all_jobs(request: Request) -> JSONResponse:
        """All jobs of the session, the oldest first."""
        owner = owner_of(request)
        mine = [] if owner is None else jobs.of(owner)
        return JSONResponse({"jobs": [each.shown() for each in mine]})

    @app.get("/api/jobs/{identity}", openapi_extra=openapi.gives(openapi.JobShown))
    async def one_job(request: Request, identity: str) -> JSONResponse:
        """How a job is."""
        return JSONResponse(job_of(request, identity).shown())

    @app.delete("/api/jobs/{identity}", status_code=204)
    async def remove_job(request: Request, identity: str) -> Response:
        """Cancel a job, and forget it."""
        await jobs.remove(job_of(request, identity))
        return Response(status_code=204)

    @app.get("/api/jobs/{identity}/result")
    async def result(request: Request, identity: str) -> FileResponse:
        """What a job came to: the answer, a film or a report."""
        job = done_of(request, identity)
        page = {"Content-Security-Policy": OF_A_DOCUMENT} if job.media == DOCUMENTS["html"] else {}
        return FileResponse(jobs.table.files(job) / RESULT, media_type=job.media, headers=page)

    @app.get("/api/jobs/{identity}/text")
    async def text(request: Request, identity: str) -> FileResponse:
        """An answer in the words of the command; of a film or a report nothing."""
        job = done_of(request, identity)
        return FileResponse(jobs.table.files(job) / TEXT, media_type="text/plain; charset=utf-8")

    @app.get("/api/jobs/{identity}/events")
    async def events(request: Request, identity: str) -> StreamingResponse:
        """How a job goes, as server-sent events, until it is over."""
        stream = jobs.events(job_of(request, identity))
        return StreamingResponse(stream, media_type="text/event-stream")


async def _begun(request: Request, jobs: Jobs, files: Files, asker: Asker) -> Job:
    """Job of a request, either JSON or a form with a file."""
    jobs.refuse_more(asker)  # before it is read
    if type_of(request) != "multipart/form-data":
        asked = await json_of(request)
        verb, body = _checked(asked.get("verb"), asked.get("body"))
        if verb in FILES:
            raise InputError(f"{verb}: no file: send multipart/form-data with a part file")
        return jobs.add(asker, verb, body)
    async with files.taken(request) as (file, fields):
        verb, body = _checked(fields.get("verb"), object_of(str(fields.get("body", "{}"))))
        if verb not in FILES or file is None:
            raise InputError(f"{verb}: a form with a part file begins a job of {', '.join(FILES)}")
        return jobs.add(asker, verb, body, file)


def _checked(verb: Any, body: Any) -> tuple[str, Mapping[str, Any]]:
    if not isinstance(verb, str) or verb not in JOBS:
        hint = did_you_mean(str(verb), JOBS) or f"; known: {', '.join(JOBS)}"
        raise InputError(f"verb = {shown(verb)} is not known{hint}")
    if not isinstance(body, Mapping):
        raise InputError(f"body = {shown(body)} is not a table")
    return verb, body
