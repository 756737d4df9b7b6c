"""Workers on this machine: processes, each replaced when it dies."""

import math
import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import connection
from typing import Protocol, Self

from kaidan.arguments import whole
from kaidan.errors import InputError
from kaidan.work.job import CRASHED, FAILED, Ended, Reply, Task, Work, perform

MOST_WORKERS = 1024
"""Most workers."""
TRIES = 3
"""Times that a trial may kill its worker before it is given up."""
AT_HAND = 0.5
"""Work that a worker has before it, so that it does not wait while results are stored [s]."""
FEWEST, MOST = 2, 64
"""Tasks that a worker has at least, the one it runs and the next, and at most."""


class Workers(Protocol):
    """What runs tasks; `LocalWorkers` and `kaidan.work.cluster.DaskWorkers` are such."""

    def room(self) -> int:
        """How many more tasks it wants now."""

    def submit(self, task: Task) -> None:
        """Take a task."""

    def wait(self, timeout: float) -> Sequence[Ended]:
        """Tasks that came to an end, after `timeout` [s] at the latest."""

    def __enter__(self) -> Self:
        """Begin."""

    def __exit__(self, *raised: object) -> None:
        """Stop; what is in flight is given up."""


class _Slot:
    """A place for one process."""

    def __init__(self) -> None:
        self.pool: ProcessPoolExecutor | None = None
        self.futures: dict[Future[Reply], Task] = {}
        self.alone = False
        """Whether its task killed a worker before and runs by itself."""
        self.ready: Future[None] = Future()
        """Done when its process has begun."""

    def take(self, work: Work, task: Task, version: str) -> None:
        if self.pool is None:
            self._open()
        assert self.pool is not None
        try:
            future = self.pool.submit(perform, work, task.spec, version)
        except BrokenProcessPool:  # it died between two tasks
            pool = self._open()
            future = pool.submit(perform, work, task.spec, version)
        self.futures[future] = task

    def _open(self) -> ProcessPoolExecutor:
        self.pool = ProcessPoolExecutor(
            1, multiprocessing.get_context("spawn"), initializer=become_worker
        )
        self.ready = self.pool.submit(_nothing)
        return self.pool

    @property
    def began(self) -> bool:
        """Whether its process ever did anything."""
        return self.ready.done() and self.ready.exception() is None


class LocalWorkers:
    """Processes on this machine.

    A process that dies is replaced. What it had is done again; as long as it had two trials
    nobody knows which one killed it, so each of them then runs by itself. A trial that kills
    `tries` workers by itself gets the outcome `crashed`.

    Parameters
    ----------
    work : Work
        What is done.
    count : int, optional
        Number of processes; without one each processor gets one.
    tries : int
        Times that a trial may kill its worker.

    Raises
    ------
    InputError
        Later: its processes die before they do anything.
    """

    def __init__(self, work: Work, count: int | None = None, *, tries: int = TRIES) -> None:
        self.work, self.tries, self.version = work, tries, work.version()
        self._slots = [_Slot() for _ in range(hands(count))]
        self._suspects: deque[Task] = deque()
        self._deaths: dict[str, int] = {}
        self._stillborn = 0
        self._lasts = AT_HAND  # a task, of late [s]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        for slot in self._slots:
            if slot.pool is not None:
                slot.pool.shutdown(wait=False, cancel_futures=True)
        for slot in self._slots:
            if slot.pool is not None:
                slot.pool.shutdown(wait=True)

    def room(self) -> int:
        """How many more tasks it wants now."""
        self._place_suspects()
        ahead = min(max(FEWEST, math.ceil(AT_HAND / self._lasts)), MOST)
        free = sum(0 if slot.alone else ahead - len(slot.futures) for slot in self._slots)
        return max(0, free - ahead * len(self._suspects))

    def submit(self, task: Task) -> None:
        """Take a task."""
        slot = min((slot for slot in self._slots if not slot.alone), key=lambda s: len(s.futures))
        slot.take(self.work, task, self.version)

    def wait(self, timeout: float) -> list[Ended]:
        """Tasks that came to an end, after `timeout` [s] at the latest."""
        self._place_suspects()
        futures = [future for slot in self._slots for future in slot.futures]
        wait(futures, timeout, FIRST_COMPLETED)
        ended = [ended for slot in self._slots for ended in self._ended(slot)]
        self._share()
        return ended

    def _share(self) -> None:
        """Give workers that have fewer tasks those that others have not begun."""
        slots = [slot for slot in self._slots if not slot.alone]
        while slots and not self._suspects:
            least, most = (pick(slots, key=lambda s: len(s.futures)) for pick in (min, max))
            if len(most.futures) - len(least.futures) < 2:
                return
            waiting = next((each for each in reversed(most.futures) if each.cancel()), None)
            if waiting is None:
                return
            least.take(self.work, most.futures.pop(waiting), self.version)

    def _place_suspects(self) -> None:
        for slot in self._slots:
            if self._suspects and not slot.futures:
                slot.alone = True
                slot.take(self.work, self._suspects.popleft(), self.version)

    def _ended(self, slot: _Slot) -> list[Ended]:
        """What ended in a slot; the tasks of a dead process come back as suspects."""
        ended: list[Ended] = []
        dead: list[Task] = []
        for future in [future for future in slot.futures if future.done()]:
            task = slot.futures.pop(future)
            error = future.exception()
            if isinstance(error, BrokenProcessPool):
                dead.append(task)
            elif error is not None:
                text = f"{type(error).__name__}: {error}"
                ended.append(self._end(task, Reply({"outcome": FAILED, "error": text})))
            else:
                reply = future.result()
                self._lasts += 0.2 * (max(reply.lasted, 1e-6) - self._lasts)
                ended.append(self._end(task, reply))
        if dead:
            dead += slot.futures.values()
            slot.futures.clear()
            slot.pool = None
            self._count_stillborn(slot)
            certain = slot.began and (slot.alone or len(dead) == 1)
            for task in dead:
                ended += self._suspect(task, certain=certain)
        if not slot.futures:
            slot.alone = False
        return ended

    def _count_stillborn(self, slot: _Slot) -> None:
        """Give up where processes die before they do anything: no trial is to blame for that."""
        self._stillborn = 0 if slot.began else self._stillborn + 1
        if self._stillborn > 3 * len(self._slots):
            raise InputError(
                "the campaign's processes die as soon as they begin: is there too little memory, "
                "or does a script start a campaign without `if __name__ == '__main__':`?"
            )

    def _suspect(self, task: Task, *, certain: bool) -> list[Ended]:
        """Do a task again that was on a worker that died, or give it up."""
        deaths = self._deaths[task.id] = self._deaths.get(task.id, 0) + certain
        if deaths < self.tries:
            self._suspects.append(task)
            return []
        text = f"its worker died {deaths} times"
        return [self._end(task, Reply({"outcome": CRASHED, "error": text}))]

    def _end(self, task: Task, reply: Reply) -> Ended:
        figures = {**reply.figures, "deaths": self._deaths.pop(task.id, 0)}
        return Ended(task, figures, reply.stop)


def _nothing() -> None:
    """Do nothing: a process that comes back from it has begun."""


def hands(stated: int | None) -> int:
    """Number of workers: as stated, else one for each processor that this process may use."""
    return processors() if stated is None else whole("workers", stated, 1, MOST_WORKERS)


def processors() -> int:
    """Processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def become_worker() -> None:
    """Leave Ctrl-C to who started the process, use one processor, and end when that one does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: int) -> None:
    connection.wait([sentinel])
    os._exit(1)
