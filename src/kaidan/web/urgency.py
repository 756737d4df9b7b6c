"""Which questions go first: a person at a slider does not wait for the search of another one."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from kaidan.spelling import JOINT
from kaidan.web.shares import share_of
from kaidan.web.workers import Limits, Reply, Workers

QUICK, SAMPLES, THOROUGH = 5, 10, 15
"""By how much estimates go before what takes a traverse, before samples, which take 1 ms and so
wait for nobody unless they are a flood, and before a search, file or document."""
_AT_ONCE = ("estimate", "measure-robot", "measure-stairs")
_BY_POSTURE = ("assess", "traverse", "plane", "margin")
_QUICK_MODELS = ("contact", "closed-form", "support-polygon")
_FLIGHTS, _POINTS = 3, 100
"""Most flights of a quick question, of which each takes 0.1 s, and as many points as take that."""
_LARGEST = 40_000
"""Largest body of a quick question [bytes]: sheets of robot and three flights have a fifth."""


class Hands:
    """Four sets of workers: for estimates, samples, other quick questions, everything else.

    Estimates take milliseconds and somebody at a slider waits for each, so that they wait for
    nothing else; nor do the samples of a climb that is watched, and its beginning.

    count: processes of each; two answer more estimates than many people ask for.
    limits: what one question may take.
    folder: where each process has a folder for passing files.
    """

    def __init__(self, count: int, limits: Limits, folder: Path) -> None:
        few = min(count, 2)
        self.estimates = Workers(few, limits, folder, ready=few, first="estimate")
        self.samples = Workers(1, limits, folder, nice=SAMPLES, ready=1, first="live")
        self.quick = Workers(count, limits, folder, nice=QUICK, ready=count, first="assess")
        self.thorough = Workers(
            count, limits, folder, nice=THOROUGH, ready=1, first="assess", most=share_of(count)
        )
        self._every = (self.estimates, self.samples, self.quick, self.thorough)

    async def __aenter__(self) -> Self:
        for each in self._every:
            await each.__aenter__()
        return self

    async def __aexit__(self, *raised: object) -> None:
        for each in self._every:
            await each.__aexit__()

    async def ask(self, task: Mapping[str, Any], client: str) -> Reply:
        """Reply of whom a task is for, see `Workers.ask`."""
        return await self._whose(task).ask(task, client)

    def _whose(self, task: Mapping[str, Any]) -> Workers:
        if task["kind"] in ("feed", "overdue"):
            return self.samples
        if task["kind"] == "live":
            return self.samples if _is_small(task["body"]) else self.thorough
        if task["verb"] in _AT_ONCE and _is_small(task["body"]):
            return self.estimates
        return self.quick if is_quick(task) else self.thorough


def is_quick(task: Mapping[str, Any]) -> bool:
    """Whether a question is answered at once: small, no posture to be found, nothing simulated.

    task: see ``kaidan.web.tasks``.

    Examples
    --------
    >>> is_quick({"verb": "assess", "body": {"robot": "absolem", "flippers": "flat"}})
    True
    >>> is_quick({"verb": "assess", "body": {"robot": "absolem", "flippers": "best"}})
    False
    """
    verb, body = task["verb"], task["body"]
    if not _is_small(body):
        return False
    if verb in _AT_ONCE:
        return True
    whole = body.get("question")
    whole = whole if isinstance(whole, Mapping) else {}
    stated = body.get("flippers", "best") != "best" or whole.get("best_of") == []
    model = body.get("model") or whole.get("model") or "contact"
    return verb in _BY_POSTURE and (stated or verb == "margin") and model in _QUICK_MODELS


def _is_small(body: Mapping[str, Any]) -> bool:
    """Whether a question is of few flights and does not hold much."""
    whole = body.get("question")
    terrain = whole.get("terrain") if isinstance(whole, Mapping) else None
    flights = _flights(body.get("stairs")) + _flights(terrain)
    return flights <= _FLIGHTS and len(json.dumps(body)) <= _LARGEST


def _flights(stairs: Any) -> float:
    """How many flights stairs take as long as: joined names, a list of flights, or points."""
    if isinstance(stairs, str):
        return stairs.count(JOINT) + 1
    points = stairs.get("points") if isinstance(stairs, Mapping) else None
    several = points or stairs
    if isinstance(several, list):
        return sum(1.0 / _POINTS if isinstance(each, list) else 1.0 for each in several)
    return 0.0 if stairs is None else 1.0
