"""Climbs that are watched, each on a channel of its own: workers judge, here it is passed on."""

import asyncio
import json
import secrets
import time
from collections import deque
from collections.abc import Mapping
from typing import Any

from kaidan.verbs.monitor import Sample
from kaidan.web.shares import Places
from kaidan.web.urgency import Hands
from kaidan.web.workers import Reply

MOST_CHANNELS = 100
"""Most climbs at once."""
MOST_FEEDS = 16
"""Most requests that feed a channel at once; the next one waits for the one before."""
LEFT, LEFT_AT_END = 900.0, 60.0
"""After how long a climb is over that nobody feeds or watches, and one that has ended [s]."""
REMEMBERED = 1_200
"""States that who comes later is sent."""
_AT_ONCE = 50
"""Samples of one task: 10 ms, so that one climb holds up no other."""
_AGAIN = 0.05
"""When to look again for a sample where no worker could [s]."""


class Channel:
    """One climb: its monitor, what it said last, and who watches.

    begun: as `kaidan.web.watching.begun` gives it.
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
        self._due: asyncio.TimerHandle | None = None
        self._looking: asyncio.Task[None] | None = None

    @property
    def left(self) -> float:
        """For how long nobody has fed or watched it [s]."""
        return 0.0 if self.watchers else time.monotonic() - self._used

    async def feed(
        self,
        samples: list[Sample],
        *,
        again: bool = False,
        recorded: bool = False,
        ends: bool = False,
    ) -> Reply:
        """States after samples, which those who watch get too; all samples count, or none does.

        recorded: whether their stamps alone tell the time: they may come when they like.
        """
        arrived = None if recorded else time.monotonic()
        async with self._turn:
            self._used = time.monotonic()
            said = {"monitor": self._fresh if again else self._monitor, "summary": None}
            states: list[str] = []
            pieces = [samples[k : k + _AT_ONCE] for k in range(0, len(samples), _AT_ONCE)]
            for piece in pieces or ([[]] if ends else []):
                last = ends and len(states) + len(piece) == len(samples)
                task = {"kind": "feed", "monitor": said["monitor"], "samples": piece}
                task |= {"arrived": arrived, "ends": last}
                reply = await self._hands.ask(task, self.client)
                if reply.status != 200:
                    return reply
                said, more = _lines_of(reply)
                states += more
            self._monitor, self.ended = said["monitor"], ends
            self._spread(states, again=again, summary=said["summary"])
        if states or ends:
            self._expect(None if ends else said["due_s"])
        end = f', "summary": {json.dumps(said["summary"])}' if ends else ""
        return Reply(200, f'{{"states": [{", ".join(states)}]{end}}}'.encode())

    def _expect(self, due: float | None) -> None:
        """Look in time [s] whether the next sample has come; None: no more is expected."""
        if self._due is not None:
            self._due.cancel()
        loop = asyncio.get_running_loop()
        self._due = None if due is None else loop.call_later(due, self._look)

    def _look(self) -> None:
        if self._turn.locked():  # a sample is being judged
            self._expect(_AGAIN)
        else:
            self._looking = asyncio.create_task(self._miss())

    async def _miss(self) -> None:
        """Have it said that the next sample has not come in time, if so."""
        async with self._turn:
            task = {"kind": "overdue", "monitor": self._monitor, "now": time.monotonic()}
            reply = await self._hands.ask(task, self.client)
            if reply.status != 200:
                return self._expect(_AGAIN)
            said, states = _lines_of(reply)
            self._monitor = said["monitor"]
            self._spread(states)

    def _spread(
        self, states: list[str], *, again: bool = False, summary: str | None = None
    ) -> None:
        """Send to those who watch, and keep what is sent to who comes later."""
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


def _lines_of(reply: Reply) -> tuple[dict[str, Any], list[str]]:
    """What a worker says of a monitor, and states in JSON; see `kaidan.web.watching`."""
    first, *states = reply.content.decode().split("\n")
    said: dict[str, Any] = json.loads(first)
    return said, states


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
