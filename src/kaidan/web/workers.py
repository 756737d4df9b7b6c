"""Worker processes: each task in one of them, within a time, and a new one for each that dies."""

import asyncio
import json
import os
import shutil
import signal
import sys
import tempfile
from collections import Counter, deque
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple, Self

from kaidan.progress import Follower
from kaidan.web.shares import share_of
from kaidan.web.worker import LENGTH

_LAST = 19
"""By how much other processes go before a job."""


class Reply(NamedTuple):
    """What is sent to the client."""

    status: int
    content: bytes


class Limits(NamedTuple):
    """What one question may take."""

    seconds: float = 30.0
    """Time of an answer [s]."""
    file_seconds: float = 120.0
    """Time of an answer about a file, and of a document [s]."""
    memory: int = 4 << 30
    """Address space of a worker [bytes]."""
    waiting: int = 256
    """Questions that may wait for a worker."""
    tasks: int = 2_000
    """Questions after which a worker is replaced, so that nothing that it keeps can grow."""


class WorkerDiedError(Exception):
    """A worker ended in the middle of a task."""


class _Worker:
    """One process, with a folder for its passing files."""

    def __init__(self, process: asyncio.subprocess.Process, folder: Path) -> None:
        self.process, self.folder, self.done = process, folder, 0
        self.spent = False
        """Whether it had no memory left, so that nobody knows what is whole in it."""

    @classmethod
    async def begin(cls, limits: Limits, folder: Path, nice: int, first: str) -> Self:
        process = await asyncio.create_subprocess_exec(
            sys.executable, "-m", "kaidan.web.worker", str(limits.memory), str(nice), first,
            stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.DEVNULL, cwd=folder,
            env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1",
                              "TMPDIR": str(folder)},
        )  # fmt: skip
        return cls(process, folder)

    async def ask(self, task: Mapping[str, Any], follower: Follower | None = None) -> Reply:
        assert self.process.stdin is not None
        frame = json.dumps(task).encode()
        try:
            self.process.stdin.write(LENGTH.pack(len(frame)) + frame)
            await self.process.stdin.drain()
            while "progress" in (head := json.loads(await self._frame())):
                if follower is not None:
                    follower(*head["progress"])
            content = await self._frame()
        except (asyncio.IncompleteReadError, ConnectionError):
            raise WorkerDiedError from None
        self.done += 1
        self.spent = head.get("spent", False)
        return Reply(head["status"], content)

    async def _frame(self) -> bytes:
        assert self.process.stdout is not None
        size = LENGTH.unpack(await self.process.stdout.readexactly(LENGTH.size))[0]
        return await self.process.stdout.readexactly(size)

    async def end(self) -> None:
        """Kill it and whatever it began, and empty its folder."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self.process.pid, signal.SIGKILL)
        with suppress(ProcessLookupError):  # one that had no time to become a group
            self.process.kill()
        await self.process.wait()
        if self.process.stdin is not None:
            self.process.stdin.close()
        shutil.rmtree(self.folder, ignore_errors=True)


class Workers:
    """Some worker processes and the questions that wait for them.

    limits: what one question may take.
    folder: where each has a folder for passing files.
    ready: how many of them begin before they are needed.
    first: verb that these answer once before the first question, whose reply would wait for their
        imports otherwise.
    most: how many of them one client may keep busy; all without it.
    """

    def __init__(
        self,
        count: int,
        limits: Limits,
        folder: Path,
        *,
        nice: int = 0,
        ready: int = 0,
        first: str = "",
        most: int | None = None,
    ) -> None:
        self.count, self.limits, self.folder = count, limits, folder
        self.nice, self.ready, self.first = nice, ready, first
        self.most = count if most is None else most
        self._working: Counter[str] = Counter()
        self._idle: list[_Worker | None] = [None] * count
        self._all: set[_Worker] = set()
        self._line: dict[str, deque[asyncio.Future[_Worker | None]]] = {}
        self._under_way: set[asyncio.Task[Reply]] = set()

    async def __aenter__(self) -> Self:
        for place in range(self.count - self.ready, self.count):  # the last is asked first
            self._idle[place] = await self._begin(self.nice, self.first)
        return self

    async def __aexit__(self, *ended: object) -> None:
        for line in self._line.values():
            for turn in line:
                turn.cancel()
        for worker in tuple(self._all):
            await self._drop(worker)

    async def ask(
        self, task: Mapping[str, Any], client: str, *, seconds: float | None = None
    ) -> Reply:
        """Reply to a task, whatever becomes of its worker.

        Clients take turns, however many tasks each has in the line. Who gives up while the task
        waits takes it out of the line; one that has begun is ended.

        task: see ``kaidan.web.tasks``.
        client: who asks; of all that may wait it may have its share.
        seconds: time that it may take [s]; that of the limits without it.
        """
        if sum(map(len, self._line.values())) >= self.limits.waiting:
            return refused(503, "busy", "too many questions at once; ask again in a while")
        if len(self._line.get(client, ())) >= share_of(self.limits.waiting):
            text = "too many questions of your address at once; ask again in a while"
            return refused(429, "share", text)
        worker = await self._free(client)
        answered = self._answered(worker, task, client, seconds or self.limits.seconds)
        work = asyncio.create_task(answered)
        self._under_way.add(work)
        work.add_done_callback(self._under_way.discard)
        return await asyncio.shield(work)

    async def _answered(
        self, worker: _Worker | None, task: Mapping[str, Any], client: str, seconds: float
    ) -> Reply:
        whole = False
        try:
            worker = await self._living(worker)
            reply = await self._within(worker, task, seconds)
            fresh = worker.done < self.limits.tasks and not worker.spent
            whole = fresh and worker.process.returncode is None
            return reply
        finally:
            if not whole and worker is not None:
                await self._drop(worker)
            self._release(worker if whole else None, client)

    async def _free(self, client: str) -> _Worker | None:
        """Worker that has nothing to do, as soon as it is this one's turn; None: one may begin."""
        if self._idle and self._working[client] < self.most:
            self._working[client] += 1
            return self._idle.pop()
        turn: asyncio.Future[_Worker | None] = asyncio.get_running_loop().create_future()
        self._line.setdefault(client, deque()).append(turn)
        try:
            return await turn
        except asyncio.CancelledError:
            line = self._line.get(client, deque())
            if turn in line:
                line.remove(turn)
                if not line:
                    del self._line[client]
            elif not turn.cancelled():  # its turn came in the same moment
                self._release(turn.result(), client)
            raise

    def _release(self, worker: _Worker | None, client: str) -> None:
        """Give the worker of a client to the one whose last turn is longest ago, and who may."""
        self._working[client] -= 1
        if not self._working[client]:
            del self._working[client]
        self._idle.append(worker)
        for each in tuple(self._line):
            if not self._idle:
                return
            if self._working[each] < self.most:
                self._next_of(each)

    def _next_of(self, client: str) -> None:
        """Give an idle worker to the next turn of a client, which then is behind the others."""
        line = self._line.pop(client)
        while line:
            turn = line.popleft()
            if not turn.cancelled():
                self._working[client] += 1
                turn.set_result(self._idle.pop())
                break
        if line:
            self._line[client] = line

    async def ask_apart(
        self, task: Mapping[str, Any], *, seconds: float, follower: Follower
    ) -> Reply:
        """Reply to a task by a process of its own, which lets the others go first."""
        worker = await self._begin(_LAST)
        try:
            return await self._within(worker, task, seconds, follower)
        finally:
            await self._drop(worker)

    async def _within(
        self,
        worker: _Worker,
        task: Mapping[str, Any],
        seconds: float,
        follower: Follower | None = None,
    ) -> Reply:
        """Reply of a worker, or why there is none; one that gives none is dead afterwards."""
        try:
            return await asyncio.wait_for(worker.ask(task, follower), seconds)
        except TimeoutError:
            await worker.end()
            text = f"no answer within {seconds:g} s: ask for less, or make it a job"
            return refused(422, "time", text)
        except WorkerDiedError:
            await worker.end()
            return refused(503, "died", "the process that worked on this died; ask again")

    async def _living(self, worker: _Worker | None) -> _Worker:
        """Worker that runs: the one given, or a new one where it died between two tasks."""
        if worker is not None and worker.process.returncode is None:
            return worker
        if worker is not None:
            await self._drop(worker)
        return await self._begin(self.nice)

    async def _begin(self, nice: int, first: str = "") -> _Worker:
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        worker = await _Worker.begin(self.limits, folder, nice, first)
        self._all.add(worker)
        return worker

    async def _drop(self, worker: _Worker) -> None:
        self._all.discard(worker)
        await worker.end()


def refused(status: int, kind: str, text: str) -> Reply:
    """Reply where there is no answer."""
    return Reply(status, json.dumps({"error": text, "kind": kind}).encode())
