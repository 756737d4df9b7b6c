"""Answers that were given before: the same question is judged once."""

import asyncio
import hashlib
import json
from collections import OrderedDict
from collections.abc import Mapping
from typing import Any

from kaidan.web.workers import Reply, Workers

MOST = 64 << 20
"""Most that is remembered [bytes]."""


class Remembered:
    """Answers by their questions; the same question at the same time waits for the one answer.

    An answer follows from its question alone, so that it does not matter whose it was.

    Parameters
    ----------
    hands : Workers
        Who answers.
    most : int
        Most that is remembered [bytes]; the answer that nobody needed for longest goes first.
    """

    def __init__(self, hands: Workers, most: int = MOST) -> None:
        self._hands, self._most, self._size = hands, most, 0
        self._replies: OrderedDict[bytes, Reply] = OrderedDict()
        self._coming: dict[bytes, asyncio.Task[Reply]] = {}

    async def ask(self, task: Mapping[str, Any]) -> Reply:
        """Reply to a task, see `Workers.ask`."""
        key = hashlib.sha256(json.dumps(task, sort_keys=True).encode()).digest()
        if key in self._replies:
            self._replies.move_to_end(key)
            return self._replies[key]
        if key not in self._coming:
            self._coming[key] = asyncio.create_task(self._asked(key, task))
        return await asyncio.shield(self._coming[key])

    async def _asked(self, key: bytes, task: Mapping[str, Any]) -> Reply:
        try:
            reply = await self._hands.ask(task)
            if reply.status == 200:
                self._replies[key] = reply
                self._size += len(reply.content)
                while self._size > self._most:
                    self._size -= len(self._replies.popitem(last=False)[1].content)
            return reply
        finally:
            del self._coming[key]
