"""Live: samples in by POST, states out by websocket, each climb on a channel of its own.

A channel has a name that nobody guesses; who does not know it neither sees nor feeds it.
"""

import asyncio
import json
import math
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from fastapi import FastAPI, Request, WebSocket, WebSocketDisconnect
from fastapi.responses import JSONResponse, Response
from starlette.exceptions import HTTPException

from kaidan.errors import InputError, shown
from kaidan.verbs.monitor import Sample
from kaidan.verbs.monitor.samples import NEEDED, OPTIONAL
from kaidan.web.bodies import client_of, json_of, sent, while_there
from kaidan.web.channels import REMEMBERED, Channel, Live
from kaidan.web.urgency import Hands

MOST_SAMPLES = 2_000
"""Most samples of one request."""
MOST_WATCHERS = 50
"""Most pages that watch a channel."""
_SAID = {"again": "again", "end": "ends", "recorded": "recorded"}
"""What may be said of samples, and how `Channel.feed` calls it."""
UNKNOWN, TOO_MANY = 4404, 4429
"""Why a websocket is closed: no such channel; too many watch it."""


def add(app: FastAPI, hands: Hands) -> None:
    """Add the routes of live climbs."""
    live = Live()

    def known(name: str) -> Channel:
        found = live.of(name)
        if found is None:
            raise HTTPException(404, "no such climb is being watched")
        return found

    @app.post("/api/live")
    async def begin(request: Request) -> Response:
        """Begin to watch a climb: robot, stairs, direction, facing, flippers, payload, limits."""
        client, channel = client_of(request), None
        live.take_place(client)
        try:
            task = {"kind": "live", "body": await json_of(request)}
            answer = await while_there(request, hands.ask(task, client))
            if answer.status_code != 200:
                return answer
            channel = Channel(json.loads(bytes(answer.body)), hands, client)
            return JSONResponse(channel.head)
        finally:
            live.settle(client, channel)

    @app.post("/api/live/{name}")
    async def feed(name: str, request: Request) -> Response:
        """Samples of a climb; "again": from its start; "recorded"; "end": with the summary."""
        channel = known(name)
        with channel.feeds.held(client_of(request)):
            body = await json_of(request)
            for key in body.keys() - {"samples", *_SAID}:
                known_keys = ", ".join(sorted(("samples", *_SAID)))
                raise InputError(f"live: {shown(key)} is not known; known: {known_keys}")
            samples = samples_of(body.get("samples") or [])
            manner = {which: bool(body.get(key)) for key, which in _SAID.items()}
            return sent(await channel.feed(samples, **manner))

    @app.websocket("/api/live/{name}")
    async def watch(name: str, socket: WebSocket) -> None:
        await socket.accept()
        channel = live.of(name)
        if channel is None or len(channel.watchers) >= MOST_WATCHERS:
            await socket.close(UNKNOWN if channel is None else TOO_MANY)
            return
        news: asyncio.Queue[str] = asyncio.Queue(maxsize=2 * REMEMBERED)
        channel.watchers.add(news)
        gone = asyncio.create_task(_until_gone(socket))
        try:
            for each in (json.dumps(channel.head), *tuple(channel.states)):
                await socket.send_text(each)
            while news in channel.watchers and not gone.done():
                coming = asyncio.create_task(news.get())
                await asyncio.wait({coming, gone}, return_when=asyncio.FIRST_COMPLETED)
                if not coming.done():
                    coming.cancel()
                    break
                await socket.send_text(coming.result())
        except (WebSocketDisconnect, RuntimeError):
            pass
        finally:
            channel.watchers.discard(news)
            gone.cancel()
            with suppress(WebSocketDisconnect, RuntimeError):  # it has gone already
                await socket.close()


async def _until_gone(socket: WebSocket) -> None:
    """Wait until a page closes its websocket; it says nothing that counts."""
    with suppress(WebSocketDisconnect, RuntimeError):
        while (await socket.receive())["type"] != "websocket.disconnect":
            pass


def samples_of(given: Any) -> list[Sample]:
    """Samples of JSON; what is missing or null is a drop-out.

    given: each with the columns of a file of samples.

    Examples
    --------
    >>> samples_of([{"t": 0, "inclination": 0.5, "inclination_rate": 0}])[0].acceleration
    nan
    """
    if not isinstance(given, list):
        raise InputError(f"samples = {shown(given)} is not a list")
    if len(given) > MOST_SAMPLES:
        raise InputError(f"samples: {len(given)} are more than {MOST_SAMPLES} at once")
    return [_sample(each, row) for row, each in enumerate(given, start=1)]


def _sample(given: Any, row: int) -> Sample:
    if not isinstance(given, Mapping):
        raise InputError(f"samples[{row - 1}] = {shown(given)} is not a table")
    for key in given.keys() - {*NEEDED, *OPTIONAL, "row", "fault"}:
        raise InputError(
            f"samples[{row - 1}]: {shown(key)} is not known; known: {', '.join(NEEDED)}, position"
        )
    values = {name: _number(given, name, row) for name in (*NEEDED, *OPTIONAL)}
    fault = given.get("fault", "")
    return Sample(**values, row=row, fault=fault[:200] if isinstance(fault, str) else "")


def _number(given: Mapping[str, Any], name: str, row: int) -> float:
    value = given.get(name)
    if value is None:
        return math.nan
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError(f"samples[{row - 1}]: {name} = {shown(value)} is not a number")
    try:
        return float(value)
    except OverflowError:
        return math.inf
