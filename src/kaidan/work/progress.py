"""How a campaign goes, on standard error: a bar on a terminal, a line now and then elsewhere."""

import sys
import time
from typing import TYPE_CHECKING, Self

from kaidan.progress import tell

if TYPE_CHECKING:
    from rich.progress import Progress as Bar
    from rich.progress import TaskID

FIRST_LINE, NEXT_LINES = 10.0, 60.0
"""Time to the first line and between the next [s]."""


class Progress:
    """Number of trials done and the time that is left: a bar, or lines where nobody sees a bar.

    total: trials of the plan; those done before are subtracted, so that the time left is right.
    """

    def __init__(self, total: int, *, shown: bool, what: str = "trials") -> None:
        self._total, self._what = total, what
        self._bar: Bar | None = None
        self._task: TaskID | None = None
        self._lines = False
        self._done, self._began, self._said = 0, time.monotonic(), time.monotonic()
        self._wait = FIRST_LINE
        if not shown:
            return
        from rich.console import Console

        console = Console(stderr=True)
        if not console.is_terminal:
            self._lines = True
            return
        from rich import progress

        self._bar = progress.Progress(
            progress.TextColumn(what),
            progress.BarColumn(),
            progress.MofNCompleteColumn(),
            progress.TimeElapsedColumn(),
            progress.TextColumn("left"),
            progress.TimeRemainingColumn(),
            console=console,
            transient=True,
        )
        self._task = self._bar.add_task("", total=total)

    def __enter__(self) -> Self:
        if self._bar is not None:
            self._bar.start()
        return self

    def __exit__(self, *raised: object) -> None:
        if self._bar is not None:
            self._bar.stop()

    def advance(self, done: int, skipped: int) -> None:
        """So many trials were done, or skipped as done before, since the last time."""
        self._total -= skipped
        self._done += done
        if done or skipped:
            tell(self._what, self._done, self._total)
        if self._lines:
            self._say()
        if self._bar is None or self._task is None or not (done or skipped):
            return
        self._bar.update(self._task, advance=done, total=self._total)

    def _say(self) -> None:
        """Write a line, if it is time to."""
        now = time.monotonic()
        if now - self._said < self._wait or not 0 < self._done < self._total:
            return
        left = (now - self._began) / self._done * (self._total - self._done)
        about = f"{left:.0f} s" if left < 100 else f"{left / 60:.0f} min"
        line = f"kaidan: {self._done} of {self._total} {self._what}, about {about} left"
        print(line, file=sys.stderr, flush=True)  # noqa: T201
        self._said, self._wait = now, NEXT_LINES
