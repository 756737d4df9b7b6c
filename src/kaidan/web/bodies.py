"""Bodies of requests, as what they hold, and replies as responses."""

import asyncio
import json
from collections.abc import Coroutine
from typing import Any

from fastapi import Request
from fastapi.responses import Response
from starlette.datastructures import FormData, UploadFile
from starlette.exceptions import HTTPException
from starlette.requests import HTTPConnection

from kaidan.errors import InputError
from kaidan.web.shares import network_of
from kaidan.web.workers import Reply

LARGEST_BODY = 2 << 20
"""Largest body of a question [bytes]."""
LARGEST_UPLOAD = 256 << 20
"""Largest upload [bytes]."""
FORM = {"max_files": 1, "max_fields": 32, "max_part_size": LARGEST_BODY // 8}
"""What a form may have; its fields are held in memory."""
GONE = 499
"""Status of what nobody reads any more."""


def client_of(request: HTTPConnection) -> str:
    """Who asks, as fair shares count clients."""
    return network_of(request.client.host if request.client else "")


def type_of(request: Request) -> str:
    """Type of a request's content."""
    return request.headers.get("content-type", "").partition(";")[0].strip().lower()


async def json_of(request: Request) -> dict[str, Any]:
    """Object of a request's body."""
    if type_of(request) != "application/json":  # a form of elsewhere could not be told apart
        raise HTTPException(415, "send application/json")
    body = bytearray()
    async for piece in request.stream():
        body += piece
        if len(body) > LARGEST_BODY:
            raise HTTPException(413, "too large")
    return object_of(bytes(body))


def object_of(text: str | bytes) -> dict[str, Any]:
    """Object of a text."""
    try:
        found = json.loads(text, parse_constant=_refuse_constant)
        json.dumps(found, ensure_ascii=False).encode()  # half a surrogate pair is no text
    except (ValueError, RecursionError) as error:
        raise InputError(f"the body is no JSON: {error}") from None
    if not isinstance(found, dict):
        raise InputError("the body is no JSON object")
    return found


def file_of(form: FormData) -> UploadFile | None:
    """File of a form; None: it has none."""
    file = form.get("file")
    return file if isinstance(file, UploadFile) else None


def fields_of(form: FormData) -> dict[str, Any]:
    """Texts of a form by name; those that came several times as lists."""
    found: dict[str, Any] = {}
    for name in form:
        texts = [each for each in form.getlist(name) if isinstance(each, str)]
        if texts:
            found[name] = texts if len(texts) > 1 else texts[0]
    return found


def sent(reply: Reply) -> Response:
    """Response of a reply."""
    headers = {"Retry-After": "1"} if reply.status in (429, 503) else None
    return Response(reply.content, reply.status, headers, "application/json")


async def while_there(request: Request, reply: Coroutine[Any, Any, Reply]) -> Response:
    """Response of a reply that is given up when the client is gone."""
    work, gone = asyncio.ensure_future(reply), asyncio.ensure_future(_gone(request))
    try:
        await asyncio.wait({work, gone}, return_when=asyncio.FIRST_COMPLETED)
        return sent(await work) if work.done() else Response(status_code=GONE)
    finally:
        gone.cancel()
        work.cancel()


async def _gone(request: Request) -> None:
    """Wait until the client has gone."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


def _refuse_constant(word: str) -> None:
    raise ValueError(f"{word} is no number of JSON")
