"""Workers in this process: threads, which start at once and share what is loaded."""

from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from typing import Self

from kaidan.work.job import Ended, Reply, Task, Work, perform
from kaidan.work.local import hands


class ThreadWorkers:
    """Threads of this process, for work that crashes no process and lets others run.

    work: what is done; one that is `alone` in its process gains nothing here.
    count: number of threads; without one each processor gets one.
    """

    def __init__(self, work: Work, count: int | None = None) -> None:
        self.work, self.count, self.version = work, hands(count), work.version()
        self._pool = ThreadPoolExecutor(self.count, thread_name_prefix="kaidan")
        self._futures: dict[Future[Reply], Task] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *raised: object) -> None:
        self._pool.shutdown(wait=True, cancel_futures=True)

    def room(self) -> int:
        """How many more tasks it wants now."""
        return self.count + 1 - len(self._futures)

    def submit(self, task: Task) -> None:
        """Take a task."""
        future = self._pool.submit(perform, self.work, task.spec, self.version)
        self._futures[future] = task

    def wait(self, timeout: float) -> Sequence[Ended]:
        """Tasks that came to an end, after `timeout` [s] at the latest."""
        done, _ = wait(self._futures, timeout, FIRST_COMPLETED)
        replies = [(self._futures.pop(future), future.result()) for future in done]
        return [Ended(task, reply.figures | {"deaths": 0}, reply.stop) for task, reply in replies]
