"""Long work in the background: one worker process a job, progress, cancelling, going on."""

import asyncio
import json
import time
from collections import Counter
from collections.abc import AsyncIterator, Mapping
from contextlib import suppress
from pathlib import Path
from secrets import token_urlsafe
from sqlite3 import OperationalError
from typing import Any, NamedTuple, Self

from kaidan.web.job_table import Job, JobTable
from kaidan.web.shares import send_away, share_of
from kaidan.web.space import FULL, is_full
from kaidan.web.workers import Workers

AT_ONCE = 4
"""Jobs that run at the same time, each of another session: a long one holds up no other session.
Each may use all processors, after the quick answers."""
MOST_OF_ALL = 100
"""Jobs of all clients that may wait or run."""
MOST_WAITING = 8
"""Jobs of one session that may wait or run, and those of an address that came without one."""
SECONDS = 12 * 3600.0
"""Longest time of a job [s]."""
_QUIET = 15.0
"""Longest silence of a stream of events [s]."""


class Asker(NamedTuple):
    """Who begins a job; see `Job`."""

    owner: str
    line: str
    client: str


class Jobs:
    """Jobs that wait and run.

    workers: they begin the process of each job.
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

    def refuse_more(self, asker: Asker) -> None:
        """Refuse who has as many jobs as one may have."""
        lines = Counter(each.line for each in self._known.values())
        clients = Counter(each.client for each in self._known.values())
        if lines[asker.line] >= MOST_WAITING:
            send_away(f"{MOST_WAITING} jobs wait or run already: cancel one, or wait")
        if clients[asker.client] >= share_of(MOST_OF_ALL):
            share = share_of(MOST_OF_ALL)
            send_away(f"{share} jobs of your address wait or run already: cancel one, or wait")
        if clients.total() >= MOST_OF_ALL:
            text = f"{MOST_OF_ALL} jobs of all clients wait or run already: try later"
            send_away(text, whole=True)

    def add(
        self, asker: Asker, verb: str, body: Mapping[str, Any], file: Path | None = None
    ) -> Job:
        """New job, which begins as soon as others have ended.

        asker: see `refuse_more`.
        verb: one of `kaidan.web.long_work.JOBS`.
        """
        self.refuse_more(asker)
        job = Job(token_urlsafe(12), asker.owner, verb, dict(body), created=time.time())
        job.line, job.client = asker.line, asker.client
        self.table.add(job, file)
        self._known[job.id] = job
        self._begin()
        return job

    def of(self, owner: str) -> list[Job]:
        """Jobs of a session, the oldest first."""
        under_way = [each for each in self._known.values() if each.owner == owner]
        ended = [each for each in self.table.ended(owner) if each.id not in self._known]
        return sorted(ended + under_way, key=lambda each: each.created)

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
        """Let jobs begin where there is room: one of a line, and of a client its share."""
        running = [each for each in self._known.values() if each.id in self._running]
        waiting = [each for each in self._known.values() if each.state == "queued"]
        lines = {each.line for each in running}
        clients = Counter(each.client for each in running)
        for job in sorted(waiting, key=lambda each: each.created):
            if len(self._running) >= AT_ONCE:
                return
            if job.line not in lines and clients[job.client] < share_of(AT_ONCE):
                lines.add(job.line)
                clients[job.client] += 1
                self._running[job.id] = asyncio.create_task(self._run(job))

    async def _run(self, job: Job) -> None:
        job.state = "running"
        self._changed(job)
        try:
            await self._work(job)
            self._end(job)
        finally:
            del self._running[job.id]
            self._changed(job)
            self._begin()

    async def _work(self, job: Job) -> None:
        def follow(what: str, done: int, of: int) -> None:
            job.what, job.done, job.of = what, done, of
            self._changed(job)

        files = self.table.files(job)
        task = {"kind": "job", "verb": job.verb, "body": job.body, "folder": str(files)}
        try:
            reply = await self._workers.ask_apart(task, seconds=SECONDS, follower=follow)
        except OSError as error:  # no process could begin
            kind, why = ("full", FULL) if is_full(error) else ("died", str(error))
            return job.fail(kind, why)
        said = json.loads(reply.content)
        if reply.status != 200:
            return job.fail(said["kind"], said["error"])
        job.state, job.media, job.done = "done", said["media"], job.of

    def _end(self, job: Job) -> None:
        """Write that a job is over; where the disk is full it has failed and leaves nothing."""
        job.ended = time.time()
        try:
            self.table.end(job)
        except OperationalError as error:
            if not is_full(error):
                raise
            job.fail("full", FULL)
            with suppress(OperationalError):  # else this server knows, and the next does it again
                self.table.end(job)
                del self._known[job.id]
        else:
            del self._known[job.id]

    def _changed(self, job: Job) -> None:
        """Wake those who follow a job."""
        event = self._changes.pop(job.id, None)
        if event is not None:
            event.set()
