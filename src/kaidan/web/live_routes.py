"""Live: samples in by POST, states out by websocket, each climb on a channel of its own.

A channel has a name that nobody guesses; who does not know it neither sees nor feeds it. Workers
judge: here is only what is passed on.
"""

import asyncio
import json
import math
import secrets
import time
from collections import deque
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
from kaidan.web.shares import Places
from kaidan.web.urgency import Hands
from kaidan.web.workers import Reply

MOST_CHANNELS = 100
"""Most climbs at once."""
LEFT, LEFT_AT_END = 900.0, 60.0
"""After how long a climb is over that nobody feeds or watches, and one that has ended [s]."""
MOST_SAMPLES = 2_000
"""Most samples of one request."""
_AT_ONCE = 100
"""Samples of one task: 10 ms, so that one climb holds up no other."""
REMEMBERED = 1_200
"""States that who comes later is sent."""
MOST_FEEDS = 16
"""Most requests that feed a channel at once; the next one waits for the one before."""
MOST_WATCHERS = 50
"""Most pages that watch a channel."""
UNKNOWN, TOO_MANY = 4404, 4429
"""Why a websocket is closed: no such channel; too many watch it."""


class Channel:
    """One climb: its monitor, what it said last, and who watches.

    Parameters
    ----------
    begun : mapping
        As `kaidan.web.watching.begun` gives it.
    hands : Hands
        Who judge.
    client : str
        Who began it.
    """

    def __init__(self, begun: Mapping[str, Any], hands: Hands, client: str) -> None:
        self.name = secrets.token_urlsafe(16)
        self.head = {"kind": "begin", "id": self.name, **begun["head"]}
        self.client = client
        self._hands, self._fresh, self._monitor = hands, begun["monitor"], begun["monitor"]
        self.states: deque[str] = deque(maxlen=REMEMBERED)
        self.watchers: set[asyncio.Queue[str]] = set()
        self._used, self.ended = time.monotonic(), False
        self.feeds = Places(MOST_FEEDS, "requests that feed this climb")
        self._turn = asyncio.Lock()

    @property
    def left(self) -> float:
        """For how long nobody has fed or watched it [s]."""
        return 0.0 if self.watchers else time.monotonic() - self._used

    async def feed(
        self, samples: list[Sample], client: str, *, again: bool = False, ends: bool = False
    ) -> Reply:
        """States after samples, which those who watch get too; all samples count, or none does.

        Parameters
        ----------
        samples : list of Sample
        client : str
            Who feeds.
        again : bool
            Whether the climb begins anew.
        ends : bool
            Whether it ends with these, so that there is a summary.
        """
        async with self._turn:
            self._used = time.monotonic()
            said = {"monitor": self._fresh if again else self._monitor, "summary": None}
            states: list[str] = []
            pieces = [samples[k : k + _AT_ONCE] for k in range(0, len(samples), _AT_ONCE)]
            for piece in pieces or ([[]] if ends else []):
                last = ends and len(states) + len(piece) == len(samples)
                task = {"kind": "feed", "monitor": said["monitor"], "samples": piece, "ends": last}
                reply = await self._hands.ask(task, client)
                if reply.status != 200:
                    return reply
                first, *more = reply.content.decode().split("\n")
                said = json.loads(first)
                states += more
            self._monitor, self.ended = said["monitor"], ends
            self._spread(states, again=again, summary=said["summary"])
        end = f', "summary": {json.dumps(said["summary"])}' if ends else ""
        return Reply(200, f'{{"states": [{", ".join(states)}]{end}}}'.encode())

    def _spread(self, states: list[str], *, again: bool, summary: str | None) -> None:
        """Tell those who watch, and keep what is told to who comes later."""
        if again:
            self.states.clear()
            self._tell(json.dumps(self.head))
        self.states.extend(states)
        for each in states:
            self._tell(each)
        if summary is not None:
            self._tell(json.dumps({"kind": "end", "text": summary}))

    def _tell(self, said: str) -> None:
        for each in tuple(self.watchers):
            try:
                each.put_nowait(said)
            except asyncio.QueueFull:  # a page that does not take what comes has to come again
                self.watchers.discard(each)


class Live:
    """All channels; one that is in use makes room for no other."""

    def __init__(self) -> None:
        self._channels: dict[str, Channel] = {}
        self._places = Places(MOST_CHANNELS, "climbs that are watched")

    def take_place(self, client: str) -> None:
        """Take the place of a channel that is to begin; see `Places.take`."""
        for each in tuple(self._channels.values()):
            if each.left > (LEFT_AT_END if each.ended else LEFT):
                del self._channels[each.name]
                self._places.give_back(each.client)
        self._places.take(client)

    def settle(self, client: str, channel: Channel | None) -> None:
        """Put a channel into its place, or give the place back where none has begun."""
        if channel is None:
            self._places.give_back(client)
        else:
            self._channels[channel.name] = channel

    def of(self, name: str) -> Channel | None:
        """Channel of a name."""
        return self._channels.get(name)


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
            task = {"kind": "live", "verb": "live", "body": await json_of(request)}
            answer = await while_there(request, hands.ask(task, client))
            if answer.status_code != 200:
                return answer
            channel = Channel(json.loads(bytes(answer.body)), hands, client)
            return JSONResponse(channel.head)
        finally:
            live.settle(client, channel)

    @app.post("/api/live/{name}")
    async def feed(name: str, request: Request) -> Response:
        """Samples of a climb; "again": from its start; "end": with the summary."""
        channel, client = known(name), client_of(request)
        with channel.feeds.held(client):
            body = await json_of(request)
            for key in body.keys() - {"samples", "again", "end"}:
                raise InputError(f"live: {shown(key)} is not known; known: again, end, samples")
            samples = samples_of(body.get("samples") or [])
            again, ends = bool(body.get("again")), bool(body.get("end"))
            return sent(await channel.feed(samples, client, again=again, ends=ends))

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

    Parameters
    ----------
    given : list of mappings
        Each with the columns of a file of samples.

    Raises
    ------
    InputError
        Something else.

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
