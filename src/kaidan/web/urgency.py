"""Which questions go first: a person at a slider does not wait for the search of another one."""

from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from kaidan.web.workers import Limits, Reply, Workers

NICE = 5
"""By how much quick questions go before those that take a search, a file or a document."""
_AT_ONCE = ("estimate", "measure-robot", "measure-stairs")
_BY_POSTURE = ("assess", "traverse", "plane", "margin")
_QUICK_MODELS = ("contact", "closed-form", "support-polygon")


class Hands:
    """Two sets of workers: one for what is answered at once, one for everything else.

    Of the first, one is left for estimates where there are several: they take milliseconds, and
    somebody waits for each.

    Parameters
    ----------
    count : int
        Processes of each; of several, the first set has one more.
    limits : Limits
        What one question may take.
    folder : Path
        Where each process has a folder for passing files.
    """

    def __init__(self, count: int, limits: Limits, folder: Path) -> None:
        kept = int(count > 1)
        self.quick = Workers(count + kept, limits, folder, kept=kept)
        self.thorough = Workers(count, limits, folder, nice=NICE)

    async def __aenter__(self) -> Self:
        await self.quick.__aenter__()
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        await self.quick.__aexit__()
        await self.thorough.__aexit__()

    async def ask(self, task: Mapping[str, Any]) -> Reply:
        """Reply of whom a task is for, see `Workers.ask`."""
        if not is_quick(task):
            return await self.thorough.ask(task)
        return await self.quick.ask(task, rank=int(task["verb"] not in _AT_ONCE))


def is_quick(task: Mapping[str, Any]) -> bool:
    """Whether a question is answered at once: no posture is to be found, nothing simulated.

    Parameters
    ----------
    task : mapping
        See ``kaidan.web.tasks``.

    Examples
    --------
    >>> is_quick({"verb": "assess", "body": {"robot": "absolem", "flippers": "flat"}})
    True
    >>> is_quick({"verb": "assess", "body": {"robot": "absolem", "flippers": "best"}})
    False
    """
    verb, body = task["verb"], task["body"]
    if verb in _AT_ONCE:
        return True
    whole = body.get("question")
    whole = whole if isinstance(whole, Mapping) else {}
    stated = body.get("flippers", "best") != "best" or whole.get("best_of") == []
    model = body.get("model") or whole.get("model") or "contact"
    return verb in _BY_POSTURE and (stated or verb == "margin") and model in _QUICK_MODELS
