"""Which questions go first: a person at a slider does not wait for the search of another one."""

from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from kaidan.web.workers import Limits, Reply, Workers

QUICK, THOROUGH = 5, 10
"""By how much estimates go before what takes a traverse, and before a search, file or document."""
_AT_ONCE = ("estimate", "measure-robot", "measure-stairs")
_BY_POSTURE = ("assess", "traverse", "plane", "margin")
_QUICK_MODELS = ("contact", "closed-form", "support-polygon")


class Hands:
    """Three sets of workers: for estimates, for other quick questions, for everything else.

    Estimates take milliseconds and somebody at a slider waits for each, so that they wait for
    nothing else.

    Parameters
    ----------
    count : int
        Processes of each; two answer more estimates than many people ask for.
    limits : Limits
        What one question may take.
    folder : Path
        Where each process has a folder for passing files.
    """

    def __init__(self, count: int, limits: Limits, folder: Path) -> None:
        few = min(count, 2)
        self.estimates = Workers(few, limits, folder, ready=few, first="estimate")
        self.quick = Workers(count, limits, folder, nice=QUICK, ready=count, first="assess")
        self.thorough = Workers(count, limits, folder, nice=THOROUGH, ready=1, first="assess")
        self._every = (self.estimates, self.quick, self.thorough)

    async def __aenter__(self) -> Self:
        for each in self._every:
            await each.__aenter__()
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for each in self._every:
            await each.__aexit__()

    async def ask(self, task: Mapping[str, Any]) -> Reply:
        """Reply of whom a task is for, see `Workers.ask`."""
        if task["verb"] in _AT_ONCE:
            return await self.estimates.ask(task)
        return await (self.quick if is_quick(task) else self.thorough).ask(task)


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
