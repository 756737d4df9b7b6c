"""Documents over HTTP."""

from fastapi import FastAPI, Request
from fastapi.responses import Response

from kaidan.web import openapi
from kaidan.web.bodies import client_of, json_of, sent
from kaidan.web.long_work import DOCUMENTS, document_format
from kaidan.web.workers import Workers

OF_A_DOCUMENT = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'"
"""A document has its style and its pictures inside, and nothing that runs."""


def add(app: FastAPI, hands: Workers) -> None:
    """Add the route of reports."""

    @app.post("/api/report", openapi_extra=openapi.written(tuple(DOCUMENTS)))
    async def report(request: Request) -> Response:
        """As kaidan report -o FILE."""
        body = await json_of(request)
        form = document_format(body, (*DOCUMENTS, "json"))
        task = {"kind": "report", "format": form, "body": body}
        client, seconds = client_of(request), hands.limits.file_seconds
        reply = await hands.ask(task, client, seconds=seconds)
        if form == "json" or reply.status != 200:
            return sent(reply)
        headers = {
            "Content-Disposition": f'inline; filename="kaidan-report.{form}"',
            "Content-Security-Policy": OF_A_DOCUMENT,
        }
        return Response(reply.content, 200, headers, DOCUMENTS[form])
