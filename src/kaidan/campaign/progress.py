"""How a campaign goes, on standard error where that is a terminal."""

from types import TracebackType
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from rich.progress import Progress as Bar
    from rich.progress import TaskID


class Progress:
    """Bar with the number of trials done and the time that is left; nothing in a pipe.

    Parameters
    ----------
    total : int
        Trials of the plan; those done before are subtracted, so that the time left is right.
    shown : bool
        Whether to show it at all.
    what : str
        What is counted.
    """

    def __init__(self, total: int, *, shown: bool, what: str = "trials") -> None:
        self._total = total
        self._bar: Bar | None = None
        self._task: TaskID | None = None
        if not shown:
            return
        from rich.console import Console

        console = Console(stderr=True)
        if not console.is_terminal:
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

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.stop()

    def advance(self, done: int, skipped: int) -> None:
        """So many trials were done, or skipped as done before, since the last time."""
        if self._bar is None or self._task is None or not (done or skipped):
            return
        self._total -= skipped
        self._bar.update(self._task, advance=done, total=self._total)
