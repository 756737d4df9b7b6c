"""The pace of a client: who asks faster, or asks again at once when it was sent away, waits."""

import asyncio
import time

from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from kaidan.web.shares import NOT_BEFORE, network_of

REQUEST, REFUSAL = 0.003, 0.02
"""Time that a request of a client is counted for, and a further one if it was sent away [s]."""
BURST = 0.4
"""Time by which it may be ahead [s]: a page and all its files at once."""
LONGEST = 5.0
"""Longest time that a request waits [s]; beyond, the client is sent away at once."""
_MOST_CLIENTS = 4096


class Paced:
    """Application whose clients are answered at a pace, each at its own."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app
        self._due: dict[str, float] = {}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on as soon as it is its turn."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        client = network_of(scope["client"][0] if scope["client"] else "")
        if not await self._turn(client, REQUEST):
            said = {"error": "too many requests of your address", "kind": "share"}
            await JSONResponse(said, 429, {"Retry-After": str(NOT_BEFORE)})(scope, receive, send)
            return

        async def later(message: Message) -> None:
            if message["type"] == "http.response.start" and message["status"] == 429:
                await self._turn(client, REFUSAL)
            await send(message)

        await self.app(scope, receive, later)

    async def _turn(self, client: str, cost: float) -> bool:
        """Wait for the turn of a client; False: it would wait for too long."""
        now = time.monotonic()
        if len(self._due) > _MOST_CLIENTS:
            self._due = {name: due for name, due in self._due.items() if due > now}
        due = max(self._due.get(client, now), now) + cost
        wait = due - now - BURST
        if wait > LONGEST:
            return False
        self._due[client] = due
        if wait > 0.0:
            await asyncio.sleep(wait)
        return True
