"""Documents over HTTP."""

from fastapi import FastAPI, Request
from fastapi.responses import Response

from kaidan.errors import InputError, shown
from kaidan.web import openapi
from kaidan.web.bodies import LARGEST_BODY, json_of, sent
from kaidan.web.workers import Workers

_DOCUMENTS = {"html": "text/html; charset=utf-8", "pdf": "application/pdf"}
_OF_A_DOCUMENT = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'"
"""A document has its style and its pictures inside, and nothing that runs."""


def add(app: FastAPI, hands: Workers) -> None:
    """Add the route of reports."""

    @app.post(
        "/api/report", openapi_extra=openapi.written(tuple(_DOCUMENTS)), max_body_size=LARGEST_BODY
    )
    async def report(request: Request) -> Response:
        """As kaidan report -o FILE."""
        body = await json_of(request)
        form = body.pop("format", "html")
        if form not in (*_DOCUMENTS, "json"):
            known = ", ".join((*_DOCUMENTS, "json"))
            raise InputError(f"report: format {shown(form)} is not known; known: {known}")
        task = {"kind": "report", "format": form, "body": body}
        reply = await hands.ask(task, seconds=hands.limits.file_seconds)
        if form == "json" or reply.status != 200:
            return sent(reply)
        headers = {
            "Content-Disposition": f'inline; filename="kaidan-report.{form}"',
            "Content-Security-Policy": _OF_A_DOCUMENT,
        }
        return Response(reply.content, 200, headers, _DOCUMENTS[form])
