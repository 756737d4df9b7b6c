"""Worker processes: each task in one of them, within a time, and a new one for each that dies."""

import asyncio
import json
import os
import signal
import sys
from collections.abc import Mapping
from contextlib import suppress
from typing import Any, NamedTuple, Self

from kaidan.web.worker import LENGTH


class Reply(NamedTuple):
    """What is sent to the client."""

    status: int
    content: bytes


class Limits(NamedTuple):
    """What one question may take."""

    seconds: float = 30.0
    """Time of an answer [s]."""
    memory: int = 4 << 30
    """Address space of a worker [bytes]."""
    waiting: int = 256
    """Questions that may wait for a worker."""
    tasks: int = 2_000
    """Questions after which a worker is replaced, so that nothing that it keeps can grow."""


class WorkerDiedError(Exception):
    """A worker ended in the middle of a task."""


class _Worker:
    """One process."""

    def __init__(self, process: asyncio.subprocess.Process) -> None:
        self.process, self.done = process, 0

    @classmethod
    async def begin(cls, limits: Limits) -> Self:
        return cls(
            await asyncio.create_subprocess_exec(
                sys.executable, "-m", "kaidan.web.worker", str(limits.memory),
                stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
                stderr=asyncio.subprocess.DEVNULL, start_new_session=True,
                env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
            )
        )  # fmt: skip

    async def ask(self, task: Mapping[str, Any]) -> Reply:
        stdin, stdout = self.process.stdin, self.process.stdout
        assert stdin is not None
        assert stdout is not None
        frame = json.dumps(task).encode()
        try:
            stdin.write(LENGTH.pack(len(frame)) + frame)
            await stdin.drain()
            frames = []
            for _ in range(2):
                size = LENGTH.unpack(await stdout.readexactly(LENGTH.size))[0]
                frames.append(await stdout.readexactly(size))
        except (asyncio.IncompleteReadError, ConnectionError):
            raise WorkerDiedError from None
        self.done += 1
        return Reply(json.loads(frames[0])["status"], frames[1])

    async def end(self) -> None:
        """Kill it and whatever it began."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self.process.pid, signal.SIGKILL)
        await self.process.wait()
        if self.process.stdin is not None:
            self.process.stdin.close()


class Workers:
    """Some worker processes and the questions that wait for them.

    Parameters
    ----------
    count : int
        Processes.
    limits : Limits
        What one question may take.
    """

    def __init__(self, count: int, limits: Limits) -> None:
        self.count, self.limits = count, limits
        self._idle: asyncio.LifoQueue[_Worker | None] = asyncio.LifoQueue()
        self._all: set[_Worker] = set()
        self._waiting = 0

    async def __aenter__(self) -> Self:
        for _ in range(self.count):
            self._idle.put_nowait(await self._begin())
        return self

    async def __aexit__(self, *ended: object) -> None:
        for worker in tuple(self._all):
            await self._drop(worker)

    async def ask(self, task: Mapping[str, Any], *, seconds: float | None = None) -> Reply:
        """Reply to a task, whatever becomes of its worker.

        Parameters
        ----------
        task : mapping
            See `kaidan.web.tasks`.
        seconds : float, optional
            Time that it may take [s]; that of the limits without it.
        """
        if self._waiting >= self.limits.waiting:
            return refused(503, "busy", "too many questions at once; ask again in a while")
        self._waiting += 1
        try:
            worker = await self._idle.get()
        finally:
            self._waiting -= 1
        whole = False
        try:
            worker = await self._living(worker)
            reply = await asyncio.wait_for(worker.ask(task), seconds or self.limits.seconds)
            whole = worker.done < self.limits.tasks
            return reply
        except TimeoutError:
            return refused(
                422,
                "time",
                f"no answer within {seconds or self.limits.seconds:g} s: ask for less, or make it "
                "a job",
            )
        except WorkerDiedError:
            return refused(503, "died", "the process that worked on this died; ask again")
        finally:
            if not whole and worker is not None:
                await self._drop(worker)
            self._idle.put_nowait(worker if whole else None)

    async def _living(self, worker: _Worker | None) -> _Worker:
        """Worker that runs: the one given, or a new one where it died between two tasks."""
        if worker is not None and worker.process.returncode is None:
            return worker
        if worker is not None:
            await self._drop(worker)
        return await self._begin()

    async def _begin(self) -> _Worker:
        worker = await _Worker.begin(self.limits)
        self._all.add(worker)
        return worker

    async def _drop(self, worker: _Worker) -> None:
        self._all.discard(worker)
        await worker.end()


def refused(status: int, kind: str, text: str) -> Reply:
    """Reply where there is no answer."""
    return Reply(status, json.dumps({"error": text, "kind": kind}).encode())
