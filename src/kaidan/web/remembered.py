"""Answers that were given before: the same question is judged once."""

import asyncio
import hashlib
import json
from collections import OrderedDict
from collections.abc import Awaitable, Mapping
from typing import Any, NamedTuple, Protocol

from kaidan.web.workers import Reply

MOST = 64 << 20
"""Most that is remembered [bytes]."""


class Answering(Protocol):
    """Who answers, as `kaidan.web.urgency.Hands.ask`."""

    def __call__(self, task: Mapping[str, Any], client: str, /) -> Awaitable[Reply]:
        """Reply to a task of a client."""
        ...


class _Coming(NamedTuple):
    """An answer that is being worked out, and those who wait for it."""

    answer: asyncio.Task[Reply]
    waiting: set[object]


class Remembered:
    """Answers by their questions; the same question at the same time waits for the one answer.

    An answer follows from its question alone, so that it does not matter whose it was. A question
    that nobody waits for any more leaves the line.

    most: what is remembered at most [bytes]; the answer that nobody needed for longest goes first.
    """

    def __init__(self, answer: Answering, most: int = MOST) -> None:
        self._answer, self._most, self._size = answer, most, 0
        self._replies: OrderedDict[bytes, Reply] = OrderedDict()
        self._coming: dict[bytes, _Coming] = {}

    async def ask(self, task: Mapping[str, Any], client: str) -> Reply:
        """Reply to a task of a client."""
        key = hashlib.sha256(json.dumps(task, sort_keys=True).encode()).digest()
        if key in self._replies:
            self._replies.move_to_end(key)
            return self._replies[key]
        if key not in self._coming:
            answer = asyncio.create_task(self._answered(key, task, client))
            answer.add_done_callback(lambda done: self._forget(key, done))
            self._coming[key] = _Coming(answer, set())
        coming, me = self._coming[key], object()
        coming.waiting.add(me)
        try:
            return await asyncio.shield(coming.answer)
        finally:
            coming.waiting.remove(me)
            if not coming.waiting:
                coming.answer.cancel()
                self._forget(key, coming.answer)

    def _forget(self, key: bytes, answer: asyncio.Task[Reply]) -> None:
        """Let nobody else wait for an answer that is there, or that nobody wants."""
        if key in self._coming and self._coming[key].answer is answer:
            del self._coming[key]

    async def _answered(self, key: bytes, task: Mapping[str, Any], client: str) -> Reply:
        reply = await self._answer(task, client)
        if reply.status == 200:
            self._replies[key] = reply
            self._size += len(reply.content)
            while self._size > self._most:
                self._size -= len(self._replies.popitem(last=False)[1].content)
        return reply
