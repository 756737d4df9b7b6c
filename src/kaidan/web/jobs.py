"""Long work in the background: one worker process a job, progress, cancelling, going on."""

import asyncio
import json
import time
from collections.abc import AsyncIterator, Mapping
from contextlib import suppress
from typing import Any, Self

from kaidan.web.job_table import Job, JobTable
from kaidan.web.workers import Workers

AT_ONCE = 4
"""Jobs that run at the same time, each of another session: a long one holds up no other session.
Each may use all processors, after the quick answers."""
SECONDS = 12 * 3600.0
"""Longest time of a job [s]."""
_QUIET = 15.0
"""Longest silence of a stream of events [s]."""


class Jobs:
    """Jobs that wait and run.

    Parameters
    ----------
    table : JobTable
        Where they are kept.
    workers : Workers
        They begin the process of each job.
    """

    def __init__(self, table: JobTable, workers: Workers) -> None:
        self.table = table
        self._workers = workers
        self._known: dict[str, Job] = {}
        self._running: dict[str, asyncio.Task[None]] = {}
        self._changes: dict[str, asyncio.Event] = {}

    async def __aenter__(self) -> Self:
        self._known = {each.id: each for each in self.table.queued()}
        self._begin()
        return self

    async def __aexit__(self, *ended: object) -> None:
        self._known.clear()  # the table has those that wait: none begins any more
        for task in tuple(self._running.values()):
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task
        self.table.close()

    def add(self, owner: str, verb: str, body: Mapping[str, Any]) -> Job:
        """New job; it begins when `start` says that its files are there."""
        return self.table.add(owner, verb, body)

    def start(self, job: Job) -> None:
        """Let a job begin as soon as others have ended."""
        self._known[job.id] = job
        self._begin()

    def of(self, owner: str) -> list[Job]:
        """Jobs of a session, the oldest first."""
        return [self._known.get(each.id, each) for each in self.table.of_owner(owner)]

    def one(self, owner: str, identity: str) -> Job | None:
        """Job of a session; None: it has none such."""
        return next((each for each in self.of(owner) if each.id == identity), None)

    async def remove(self, job: Job) -> None:
        """Cancel a job and forget it."""
        task = self._running.get(job.id)
        if task is not None:
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task
        self._known.pop(job.id, None)
        if not job.over:
            job.state, job.ended = "cancelled", time.time()
        self._changed(job)
        self.table.remove(job)

    async def events(self, job: Job) -> AsyncIterator[str]:
        """Server-sent events of a job, until it is over."""
        while True:
            change = self._changes.setdefault(job.id, asyncio.Event())
            yield f"event: {job.state}\ndata: {json.dumps(job.shown())}\n\n"
            if job.over:
                return
            while not change.is_set():
                try:
                    await asyncio.wait_for(change.wait(), _QUIET)
                except TimeoutError:
                    yield ": still there\n\n"

    def _begin(self) -> None:
        """Let jobs begin where there is room."""
        busy = {each.owner for each in self._known.values() if each.id in self._running}
        waiting = [each for each in self._known.values() if each.state == "queued"]
        for job in sorted(waiting, key=lambda each: each.created):
            if len(self._running) >= AT_ONCE:
                return
            if job.owner not in busy:
                busy.add(job.owner)
                self._running[job.id] = asyncio.create_task(self._run(job))

    async def _run(self, job: Job) -> None:
        def follow(what: str, done: int, of: int) -> None:
            job.what, job.done, job.of = what, done, of
            self._changed(job)

        job.state = "running"
        self._changed(job)
        self.table.keep(job)
        files = self.table.files(job)
        task = {"kind": "job", "verb": job.verb, "body": job.body, "folder": str(files)}
        try:
            reply = await self._workers.ask_apart(task, seconds=SECONDS, follower=follow)
            if reply.status == 200:
                job.state, job.media = "done", json.loads(reply.content)["media"]
                job.done = job.of
            else:
                job.state = "failed"
                said = json.loads(reply.content)
                job.error, job.kind = said["error"], said["kind"]
            job.ended = time.time()
            self.table.keep(job)
        finally:
            del self._running[job.id]
            if job.over:
                self._known.pop(job.id, None)
            self._changed(job)
            self._begin()

    def _changed(self, job: Job) -> None:
        """Wake those who follow a job."""
        event = self._changes.pop(job.id, None)
        if event is not None:
            event.set()
