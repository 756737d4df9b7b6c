"""Files of clients: each lies in a private folder for as long as it takes to answer about it."""

import shutil
import tempfile
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from fastapi import FastAPI, Request
from fastapi.responses import Response
from starlette.concurrency import run_in_threadpool

from kaidan.errors import InputError
from kaidan.web import openapi
from kaidan.web.bodies import FORM, client_of, fields_of, file_of, type_of, while_there
from kaidan.web.long_work import UPLOAD
from kaidan.web.shares import Places
from kaidan.web.workers import Workers

_PIECE = 1 << 20
_ROUTES = {
    "read": "As kaidan read FILE --json",
    "building": "As kaidan building FILE --json",
    "samples": "Samples of a recorded climb: CSV, or a recording of ROS",
    "sheets": "Robots and stairs of a file, as sheets",
}


MOST_UPLOADS = 16
"""Files that may be on their way at once, of all clients."""


class Files:
    """What takes files of clients in, so many at once."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._places = folder, Places(MOST_UPLOADS, "files on their way")

    @asynccontextmanager
    async def taken(self, request: Request) -> AsyncIterator[tuple[Path | None, dict[str, Any]]]:
        """File of a form, in a folder of its own until this ends, and the other fields."""
        if type_of(request) != "multipart/form-data":  # another form would be held in memory
            yield None, {}
            return
        with self._places.held(client_of(request)):
            folder = Path(tempfile.mkdtemp(dir=self._folder))
            try:
                async with request.form(**FORM) as form:
                    sent, fields = file_of(form), fields_of(form)
                    if sent is not None:
                        with (folder / UPLOAD).open("wb") as kept:
                            await run_in_threadpool(shutil.copyfileobj, sent.file, kept, _PIECE)
                yield None if sent is None else folder / UPLOAD, fields
            finally:
                shutil.rmtree(folder, ignore_errors=True)


def add(app: FastAPI, hands: Workers, files: Files) -> None:
    """Add the routes that take a file."""
    for verb, summary in _ROUTES.items():
        app.add_api_route(
            f"/api/{verb}", _answer(verb, hands, files), methods=["POST"], name=verb,
            summary=summary, openapi_extra=openapi.uploaded(verb),
        )  # fmt: skip


def _answer(verb: str, hands: Workers, files: Files) -> Callable[[Request], Awaitable[Response]]:
    async def answer(request: Request) -> Response:
        async with files.taken(request) as (file, fields):
            if file is None:
                raise InputError(f"{verb}: no file: send multipart/form-data with a part file")
            task = {"kind": verb, "folder": str(file.parent), "body": fields}
            seconds = hands.limits.file_seconds
            reply = hands.ask(task, client_of(request), seconds=seconds)
            return await while_there(request, reply)

    return answer
