"""Live: samples in by POST, states out by websocket, each climb on a channel of its own.

A channel has a name that nobody guesses; who does not know it neither sees nor feeds it.
"""

import asyncio
import math
import secrets
import time
from collections import deque
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from fastapi import FastAPI, Request, WebSocket, WebSocketDisconnect
from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from kaidan.errors import InputError, shown
from kaidan.text.monitor import summary
from kaidan.verbs.monitor import AlarmLimits, Sample
from kaidan.verbs.monitor.live import LiveMonitor, LiveState
from kaidan.verbs.monitor.samples import NEEDED, OPTIONAL
from kaidan.web.asking import live_question
from kaidan.web.bodies import json_of

MOST_CHANNELS = 100
"""Most climbs at once; the one that nobody fed for longest makes room."""
MOST_SAMPLES = 2_000
"""Most samples of one request."""
REMEMBERED = 1_200
"""States that who comes later is sent."""
MOST_WATCHERS = 50
"""Most pages that watch a channel."""
_AGAIN = 0.05
"""When to look again for a sample while others are judged [s]."""
UNKNOWN, TOO_MANY = 4404, 4429
"""Why a websocket is closed: no such channel; too many watch it."""


class Channel:
    """One climb: its monitor, what it said last, and who watches.

    Parameters
    ----------
    monitor : LiveMonitor
    """

    def __init__(self, monitor: LiveMonitor) -> None:
        self.name = secrets.token_urlsafe(16)
        self.monitor = monitor
        self.states: deque[dict[str, Any]] = deque(maxlen=REMEMBERED)
        self.watchers: set[asyncio.Queue[dict[str, Any]]] = set()
        self.fed = time.monotonic()
        self._turn = asyncio.Lock()
        self._due: asyncio.TimerHandle | None = None

    def head(self) -> dict[str, Any]:
        """What a page must know before the first state."""
        limits, question = self.monitor.limits, self.monitor.question
        return {
            "kind": "begin",
            "id": self.name,
            "robot": question.robot.name,
            "stairs": question.terrain_name,
            "direction": question.direction,
            "facing": question.facing,
            "slope_deg": math.degrees(self.monitor.slope),
            "margin_on_deg": math.degrees(limits.margin_on),
            "time_on_s": limits.time_on,
            "horizon_s": limits.horizon,
        }

    async def feed(
        self, samples: list[Sample], *, again: bool = False, recorded: bool = False
    ) -> list[dict[str, Any]]:
        """States after samples, which those who watch get too.

        Parameters
        ----------
        samples : list of Sample
        again : bool
            Whether the climb begins anew.
        recorded : bool
            Whether their stamps alone tell the time: they may come when they like.
        """
        arrived = None if recorded else time.monotonic()
        async with self._turn:
            if again:
                self.monitor = self.monitor.again()
                self.states.clear()
                self._tell(self.head())
            self.fed = time.monotonic()
            watch = self.monitor
            states = await run_in_threadpool(
                lambda: [_state(watch.feed(each, arrived)) for each in samples]
            )
            for each in states:
                self._say(each)
        if states:
            self._expect(states[-1]["due_s"])
        return states

    def _say(self, state: dict[str, Any]) -> None:
        self.states.append(state)
        self._tell(state)

    def _expect(self, due: float | None) -> None:
        """Look in time [s] whether the next sample has come; None: no more is expected."""
        if self._due is not None:
            self._due.cancel()
        loop = asyncio.get_running_loop()
        self._due = None if due is None else loop.call_later(due, self._look)

    def _look(self) -> None:
        if self._turn.locked():  # a sample is being judged
            self._expect(_AGAIN)
        elif missing := self.monitor.overdue(time.monotonic()):
            self._say(_state(missing))

    def end(self) -> dict[str, Any]:
        """Summary of the climb, which those who watch get too."""
        said = {"kind": "end", "text": summary(self.monitor.answer())}
        self._expect(None)
        self._tell(said)
        return said

    def _tell(self, said: dict[str, Any]) -> None:
        for each in tuple(self.watchers):
            try:
                each.put_nowait(said)
            except asyncio.QueueFull:  # a page that does not take what comes has to come again
                self.watchers.discard(each)


class Live:
    """All channels."""

    def __init__(self) -> None:
        self._channels: dict[str, Channel] = {}

    def begin(self, monitor: LiveMonitor) -> Channel:
        """New channel; the oldest one makes room where there are too many."""
        if len(self._channels) >= MOST_CHANNELS:
            oldest = min(self._channels.values(), key=lambda each: each.fed)
            del self._channels[oldest.name]
        made = Channel(monitor)
        self._channels[made.name] = made
        return made

    def of(self, name: str) -> Channel | None:
        """Channel of a name."""
        return self._channels.get(name)


def add(app: FastAPI) -> None:
    """Add the routes of live climbs."""
    live = Live()

    def known(name: str) -> Channel:
        found = live.of(name)
        if found is None:
            raise HTTPException(404, "no such climb is being watched")
        return found

    @app.post("/api/live")
    async def begin(request: Request) -> dict[str, Any]:
        """Begin to watch a climb: robot, stairs, direction, facing, flippers, payload, limits."""
        body = await json_of(request)
        given = body.pop("limits", None) or {}
        if not isinstance(given, Mapping):
            raise InputError(f"limits = {shown(given)} is not a table")
        limits = AlarmLimits.model_validate(given)
        monitor = await run_in_threadpool(lambda: LiveMonitor(live_question(body), limits=limits))
        return live.begin(monitor).head()

    @app.post("/api/live/{name}")
    async def feed(name: str, request: Request) -> dict[str, Any]:
        """Samples of a climb; "again": from its start; "recorded"; "end": with the summary."""
        channel, body = known(name), await json_of(request)
        for key in body.keys() - {"samples", "again", "end", "recorded"}:
            raise InputError(
                f"live: {shown(key)} is not known; known: again, end, recorded, samples"
            )
        samples = samples_of(body.get("samples") or [])
        again, recorded = bool(body.get("again")), bool(body.get("recorded"))
        states = await channel.feed(samples, again=again, recorded=recorded)
        said: dict[str, Any] = {"states": states}
        return said | ({"summary": channel.end()["text"]} if body.get("end") else {})

    @app.websocket("/api/live/{name}")
    async def watch(name: str, socket: WebSocket) -> None:
        await socket.accept()
        channel = live.of(name)
        if channel is None or len(channel.watchers) >= MOST_WATCHERS:
            await socket.close(UNKNOWN if channel is None else TOO_MANY)
            return
        news: asyncio.Queue[dict[str, Any]] = asyncio.Queue(maxsize=2 * REMEMBERED)
        channel.watchers.add(news)
        gone = asyncio.create_task(_until_gone(socket))
        try:
            for each in (channel.head(), *tuple(channel.states)):
                await socket.send_json(each)
            while news in channel.watchers and not gone.done():
                coming = asyncio.create_task(news.get())
                await asyncio.wait({coming, gone}, return_when=asyncio.FIRST_COMPLETED)
                if not coming.done():
                    coming.cancel()
                    break
                await socket.send_json(coming.result())
        except (WebSocketDisconnect, RuntimeError):
            pass
        finally:
            channel.watchers.discard(news)
            gone.cancel()
            with suppress(WebSocketDisconnect, RuntimeError):  # it has gone already
                await socket.close()


def _state(state: LiveState) -> dict[str, Any]:
    return {"kind": "state", **state.model_dump(mode="json")}


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
