"""The conduct of a campaign: plan lazily, keep the workers busy, store what comes."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from kaidan.errors import InputError
from kaidan.work.id_set import Known
from kaidan.work.job import Ended, Row, Task, Work
from kaidan.work.local import Workers

_LOOK = 0.25
"""Longest time between looks at the clock [s]."""
_SKIP = 500
"""Most trials that are looked up in the store before results are seen to again."""


class Rows(Protocol):
    """Where rows go: a `Store`, or `Kept`."""

    work: Work
    known: Known

    def add(self, rows: Sequence[Row]) -> None:
        """Take rows in."""


class Kept:
    """Rows in memory, for what nobody goes on with later."""

    def __init__(self, work: Work) -> None:
        self.work, self.known, self.rows = work, Known(), list[Row]()

    def add(self, rows: Sequence[Row]) -> None:
        """Take rows in."""
        self.rows += rows


class Listener(Protocol):
    """Who follows how a campaign goes, a progress bar for example."""

    def advance(self, done: int, skipped: int) -> None:
        """So many trials were done, or skipped as done before, since the last time."""


@dataclass(frozen=True)
class Tally:
    """What a campaign came to."""

    done: int
    """Trials done now."""
    found: int
    """Trials that were in the store already."""
    outcomes: dict[str, int] = field(default_factory=dict)
    """Of the trials done now."""


def conduct(
    specs: Iterable[Any], store: Rows, workers: Workers, *, listener: Listener | None = None
) -> Tally:
    """Do what is not in the store yet.

    Parameters
    ----------
    specs : iterable
        What is to be done; taken one by one as workers become free, so it may be endless work.
    store : Store or Kept
        Where rows go, open for writing.
    workers : Workers
        Who does it.
    listener : Listener, optional
        Who follows how it goes.

    Raises
    ------
    InputError
        No further trial makes sense: a package is missing where they run, or the physics there
        is of another version. What is done is in the store.
    """
    campaign = _Campaign(specs, store, workers)
    while campaign.goes_on():
        skipped = campaign.hand_out()
        rows = campaign.take_in(0.0 if skipped else _LOOK)
        if listener is not None:
            listener.advance(len(rows), skipped)
    return Tally(sum(campaign.outcomes.values()), campaign.found, dict(campaign.outcomes))


class _Campaign:
    def __init__(self, specs: Iterable[Any], store: Rows, workers: Workers) -> None:
        self.plan: Iterator[Any] | None = iter(specs)
        self.store, self.workers = store, workers
        self.version = store.work.version()
        self.in_flight: set[str] = set()
        self.found = 0
        self.outcomes: Counter[str] = Counter()

    def goes_on(self) -> bool:
        return self.plan is not None or bool(self.in_flight)

    def hand_out(self) -> int:
        """Give the workers what they have room for; the number found done before."""
        room, skipped = self.workers.room(), 0
        while room and self.plan is not None and skipped < _SKIP:
            try:
                spec = next(self.plan)
            except StopIteration:
                self.plan = None
                break
            identity = self.store.work.identity(spec)
            if identity in self.store.known or identity in self.in_flight:
                skipped += 1
                continue
            self.in_flight.add(identity)
            self.workers.submit(Task(identity, spec))
            room -= 1
        self.found += skipped
        return skipped

    def take_in(self, timeout: float) -> list[Row]:
        """Store what ended."""
        if not self.in_flight:
            return []
        ended = self.workers.wait(timeout)
        stops = [each.stop for each in ended if each.stop]
        rows = [self._row(each) for each in ended if not each.stop]
        self.store.add(rows)
        if stops:
            raise InputError(f"the campaign ends: {stops[0]}")
        self.in_flight.difference_update(each.task.id for each in ended)
        self.outcomes.update(row["outcome"] for row in rows)
        return rows

    def _row(self, ended: Ended) -> Row:
        return {
            **self.store.work.inputs(ended.task.spec),
            **ended.figures,
            "id": ended.task.id,
            "version": self.version,
        }
