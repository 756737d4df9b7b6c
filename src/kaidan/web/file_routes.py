"""Files of clients: each lies in a private folder for as long as it takes to answer about it."""

import shutil
import tempfile
from collections.abc import Awaitable, Callable
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.responses import Response
from starlette.datastructures import UploadFile

from kaidan.errors import InputError
from kaidan.web import openapi
from kaidan.web.bodies import FORM, fields_of, file_of, sent
from kaidan.web.long_work import UPLOAD
from kaidan.web.workers import Workers

_PIECE = 1 << 20
_ROUTES = {
    "read": "As kaidan read FILE --json",
    "building": "As kaidan building FILE --json",
    "samples": "Samples of a recorded climb: CSV, or a recording of ROS",
    "sheets": "Robots and stairs of a file, as sheets",
}


def add(app: FastAPI, hands: Workers) -> None:
    """Add the routes that take a file."""
    for verb, summary in _ROUTES.items():
        app.add_api_route(
            f"/api/{verb}", _answer(verb, hands), methods=["POST"], name=verb,
            summary=summary, openapi_extra=openapi.uploaded(verb),
        )  # fmt: skip


def _answer(verb: str, hands: Workers) -> Callable[[Request], Awaitable[Response]]:
    async def answer(request: Request) -> Response:
        async with request.form(**FORM) as form:
            file = file_of(form)
            if file is None:
                raise InputError(f"{verb}: no file: send multipart/form-data with a part file")
            folder = Path(tempfile.mkdtemp(dir=hands.folder))
            try:
                await keep(file, folder)
                task = {"kind": verb, "folder": str(folder), "body": fields_of(form)}
                return sent(await hands.ask(task, seconds=hands.limits.file_seconds))
            finally:
                shutil.rmtree(folder, ignore_errors=True)

    return answer


async def keep(file: UploadFile, folder: Path) -> None:
    """Write a file of a client into a folder, under a name that is not the client's."""
    with (folder / UPLOAD).open("wb") as kept:
        while piece := await file.read(_PIECE):
            kept.write(piece)
