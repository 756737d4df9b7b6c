"""Workers beyond this machine: a Dask scheduler that is running already."""

import asyncio
import concurrent.futures
import itertools
import re
import time
from collections import deque
from contextlib import suppress
from importlib import import_module
from queue import Empty, SimpleQueue
from typing import Any, Self

from kaidan.errors import InputError, MissingExtraError, shown
from kaidan.work.job import CRASHED, FAILED, Ended, Reply, Task, Work, perform
from kaidan.work.local import TRIES

PATIENCE = 60.0
"""Time without any worker, or without the scheduler, after which a campaign ends [s]."""
CONNECT = 10.0
"""Time within which the scheduler has to answer [s]."""
_ADDRESS = re.compile(r"(?:(?:tcp|tls|wss?|ucx)://)?[^\s/]+:\d{1,5}")
_AHEAD = 3
"""Tasks in flight for each thread of the workers; the scheduler hands them out."""
_LOOK = 2.0
"""Time between looks at how many workers there are [s]."""
_ANY = (Exception, asyncio.CancelledError, concurrent.futures.CancelledError)
"""What an exchange with a scheduler that goes away may raise."""


def distributed() -> Any:
    """The module, imported when it is needed."""
    try:
        return import_module("distributed")
    except ImportError:
        raise MissingExtraError("a campaign beyond this machine", "cluster") from None


class DaskWorkers:
    """Workers of a Dask scheduler; each needs kaidan with the same physics.

    The scheduler gives the trials of a worker that dies to others. One that it gives up, because
    workers died with it again and again (its setting `distributed.scheduler.allowed-failures`),
    may only have been the neighbour of the culprit: it is handed in again while nothing else is
    in flight. One that is given up `tries` times by itself gets the outcome `crashed`.

    Parameters
    ----------
    work : Work
        What is done.
    address : str
        Of the scheduler, for example tcp://10.0.0.1:8786.
    tries : int
        Times that a trial may be given up by itself.
    patience : float
        Time without any worker after which the campaign ends [s].

    Raises
    ------
    MissingExtraError
        distributed is not installed.
    InputError
        No scheduler answers there.
    """

    def __init__(
        self, work: Work, address: str, *, tries: int = TRIES, patience: float = PATIENCE
    ) -> None:
        self.work, self.tries, self.version = work, tries, work.version()
        self.address, self.patience = address, patience
        client = distributed().Client
        if not isinstance(address, str) or not _ADDRESS.fullmatch(address):
            raise InputError(
                f"{shown(address)} is no address of a Dask scheduler; write for example "
                "tcp://10.0.0.1:8786"
            )
        try:
            self.client = client(address, timeout=CONNECT, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            why = str(error).partition("\n")[0] or type(error).__name__
            raise InputError(f"no Dask scheduler answers at {shown(address)}: {why}") from None
        self._tasks: dict[str, tuple[Any, Task]] = {}
        self._done: SimpleQueue[str] = SimpleQueue()
        self._deaths: dict[str, int] = {}
        self._suspects: deque[Task] = deque()
        self._alone = False
        self._keys = itertools.count()
        self._threads, self._looked, self._last_seen = 0, -_LOOK, time.monotonic()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        futures = [future for future, _ in self._tasks.values()]
        self._tasks.clear()
        with suppress(*_ANY):
            if futures and self.client.status == "running":
                self.client.cancel(futures)
        with suppress(*_ANY):
            self.client.close(timeout=5.0)

    def room(self) -> int:
        """How many more tasks it wants now."""
        now = time.monotonic()
        if now - self._looked >= _LOOK:
            self._looked = now
            self._threads = self._look(now)
        if self._suspects and not self._tasks:
            self._alone = True
            self.submit(self._suspects.popleft())
        if self._alone or self._suspects:
            return 0
        return max(0, _AHEAD * max(1, self._threads) - len(self._tasks))

    def _look(self, now: float) -> int:
        """Threads of all workers now."""
        try:
            threads = int(sum(self.client.nthreads().values()))
        except _ANY:
            threads = 0
        if self.client.status in ("closing", "closed"):
            raise self._gone()
        if threads:
            self._last_seen = now
        if now - self._last_seen <= self.patience:
            return threads
        if self.client.status != "running":
            raise self._gone()
        raise InputError(
            f"the Dask scheduler at {self.address!r} had no worker for {self.patience:g} s; "
            "what is done is in the store"
        )

    def submit(self, task: Task) -> None:
        """Take a task."""
        key = f"trial-{task.id}-{next(self._keys)}"
        try:
            future = self.client.submit(
                perform, self.work, task.spec, self.version, key=key, pure=False
            )
            self._tasks[key] = (future, task)
            future.add_done_callback(lambda done: self._done.put(done.key))
        except _ANY:
            raise self._gone() from None

    def wait(self, timeout: float) -> list[Ended]:
        """Tasks that came to an end, after `timeout` [s] at the latest."""
        try:
            keys = [self._done.get(timeout=timeout)]
        except Empty:
            return []
        while not self._done.empty():
            keys.append(self._done.get())
        finished = [key for key in keys if self._tasks[key][0].status == "finished"]
        replies = self._gathered(finished)
        ended: list[Ended] = []
        for key in keys:
            future, task = self._tasks.pop(key)
            if key in replies:
                ended.append(self._end(task, replies[key]))
            else:
                ended += self._without_reply(future, task)
        self._alone = self._alone and bool(self._tasks)
        return ended

    def _gathered(self, keys: list[str]) -> dict[str, Reply]:
        """Replies of finished tasks in one exchange; none if one was lost on the way."""
        if not keys:
            return {}
        try:
            found = self.client.gather([self._tasks[key][0] for key in keys], errors="skip")
        except _ANY:  # each is fetched by itself then
            return {}
        return dict(zip(keys, found, strict=True)) if len(found) == len(keys) else {}

    def _without_reply(self, future: Any, task: Task) -> list[Ended]:
        """What becomes of a task that ended otherwise, or whose reply was lost."""
        try:
            return [self._end(task, future.result(timeout=self.patience))]
        except _ANY as error:
            if future.status != "error":
                raise self._gone() from None
            if not isinstance(error, distributed().KilledWorker):
                text = f"{type(error).__name__}: {error}"
                return [self._end(task, Reply({"outcome": FAILED, "error": text}))]
        deaths = self._deaths[task.id] = self._deaths.get(task.id, 0) + self._alone
        if deaths < self.tries:
            self._suspects.append(task)
            return []
        text = f"given up {deaths} times by the scheduler, as workers died with it"
        return [self._end(task, Reply({"outcome": CRASHED, "error": text}))]

    def _gone(self) -> InputError:
        return InputError(
            f"the Dask scheduler at {self.address!r} is gone; what is done is in the store"
        )

    def _end(self, task: Task, reply: Reply) -> Ended:
        figures = {**reply.figures, "deaths": self._deaths.pop(task.id, 0)}
        return Ended(task, figures, reply.stop)
