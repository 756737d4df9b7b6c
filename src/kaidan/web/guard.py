"""What every request passes: host, origin, token, and the headers of every response."""

import asyncio
import hmac
import ipaddress
from collections.abc import Collection
from urllib.parse import parse_qs, urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import cookie_parser
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; "
    "img-src 'self' data: blob:; font-src 'self'; media-src 'self' blob:; connect-src 'self'; "
    "worker-src 'self'; manifest-src 'self'; form-action 'self'; base-uri 'none'; "
    "frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=(), payment=()",
}
"""Headers of every response: the page loads nothing from elsewhere and runs no script but its
own."""
TOKEN_COOKIE = "kaidan_token"
SHORTEST_TOKEN = 16
"""Fewest characters of a token: nobody guesses so many, a second for each try."""
MISSED = 1.0
"""How long the answer to a wrong token takes [s]."""
_SAFE = ("GET", "HEAD", "OPTIONS")
_LOCAL = ("localhost", "127.0.0.1", "[::1]")


class Guard:
    """What stands around the application and lets nobody in who should not be.

    token: what a client must know; empty where the server listens to this machine alone.
    hosts: names by which the server may be called besides localhost and, with a token, any address
        in numbers. A page of elsewhere whose name was made to lead here is refused by its name.
    """

    def __init__(self, app: ASGIApp, *, token: str = "", hosts: Collection[str] = ()) -> None:
        self.app, self.token = app, token
        self.hosts = {*_LOCAL, *(each.lower() for each in hosts)}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse a request, or pass it on."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return

        large = False

        async def with_headers(message: Message) -> None:
            nonlocal large
            if large:  # what the framework says of it in words of its own
                return
            if message["type"] == "http.response.start":
                large = message["status"] == 413
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
                if scope["path"].startswith("/api/"):
                    headers.setdefault("Cache-Control", "no-store")
                if large:
                    said = b'{"error": "too large", "kind": "too-large"}'
                    headers["Content-Type"] = "application/json"
                    headers["Content-Length"] = str(len(said))
                    await send(message)
                    await send({"type": "http.response.body", "body": said})
                    return
            await send(message)

        answer = self._answer(scope)
        if answer is not None and answer.status_code == 401:
            await asyncio.sleep(MISSED)
        if answer is None:
            await self.app(scope, receive, with_headers)
        elif scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1008})
        else:
            await answer(scope, receive, with_headers)

    def _answer(self, scope: Scope) -> Response | None:
        """What is answered at once; None: the request may pass."""
        headers = Headers(scope=scope)
        host = headers.get("host", "")
        if not self._is_ours(host):
            return _refused(421, "host", "the server is not known by this name")
        origin = headers.get("origin")
        try:
            elsewhere = origin is not None and urlsplit(origin).netloc.lower() != host.lower()
        except ValueError:
            return _refused(400, "origin", "the Origin of the request is no address")
        if elsewhere and (scope["type"] == "websocket" or scope["method"] not in _SAFE):
            return _refused(403, "origin", "a page of elsewhere may not ask here")
        return self._without_token(scope, headers) if self.token else None

    def _is_ours(self, host: str) -> bool:
        name = (
            host.lower() if host.endswith("]") else host.lower().rpartition(":")[0] or host.lower()
        )
        if name in self.hosts:
            return True
        try:
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return False
        return bool(self.token)

    def _without_token(self, scope: Scope, headers: Headers) -> Response | None:
        """Refusal of who does not know the token; who brings it in the address gets a cookie."""
        scheme, _, bearer = headers.get("authorization", "").partition(" ")
        # another server of this name may have set cookies of any form
        cookie = cookie_parser(headers.get("cookie", "")).get(TOKEN_COOKIE, "")
        if self._known(bearer if scheme.lower() == "bearer" else "") or self._known(cookie):
            return None
        asked = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])[0]
        if self._known(asked) and scope["type"] == "http" and scope["method"] == "GET":
            # two slashes would lead to another server
            answer = RedirectResponse("/" + scope["path"].lstrip("/\\"), status_code=303)
            answer.set_cookie(TOKEN_COOKIE, self.token, httponly=True, samesite="strict")
            return answer
        refusal = _refused(401, "token", "this server asks for its token")
        refusal.headers["WWW-Authenticate"] = "Bearer"
        return refusal

    def _known(self, given: str) -> bool:
        return hmac.compare_digest(given.encode(), self.token.encode())


def _refused(status: int, kind: str, text: str) -> JSONResponse:
    return JSONResponse({"error": text, "kind": kind}, status)
