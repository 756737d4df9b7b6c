"""What a campaign does: a function of a picklable spec, the columns of its rows, its identity."""

import hashlib
import os
import socket
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from dataclasses import dataclass
from typing import Any, Literal

Row = dict[str, Any]
"""One trial: value by column."""
Kind = Literal["text", "number", "count", "flag", "texts", "numbers", "counts"]
"""What a column holds: str, float, int or bool, or a list of str, float or int; any may be missing
(None)."""

OWN_COLUMNS: dict[str, Kind] = {
    "id": "text",
    "outcome": "text",
    "error": "text",
    "deaths": "count",
    "host": "text",
    "version": "text",
}
"""Columns of every store, before those of the work."""
CRASHED = "crashed"
"""Outcome of a trial that killed its worker again and again."""
FAILED = "failed"
"""Outcome of a trial that raised an exception; its text stands in the column `error`."""


@dataclass(frozen=True, kw_only=True)
class Work:
    """What is done with each spec of a campaign.

    The functions belong to modules, not to closures, so that every process finds them by name.
    """

    name: str
    """Of the work, the same for all trials of a store."""
    run: Callable[[Any], Mapping[str, Any]]
    """Spec to the row's `outcome` and figures; what cannot be computed is an outcome too."""
    inputs: Callable[[Any], Mapping[str, Any]]
    """Spec to the row's inputs; cheap, and done where the campaign is planned."""
    text: Callable[[Any], str]
    """Spec as canonical text, from which with the version its identity comes."""
    version: Callable[[], str]
    """Version of what computes: results of two versions are two results."""
    columns: Mapping[str, Kind]
    """Columns of `run` and `inputs`, but for `outcome`."""
    alone: bool = True
    """Whether a process may run only one at a time, whatever threads it has."""

    def all_columns(self) -> dict[str, Kind]:
        """Columns of a row in the order of the store."""
        return {**OWN_COLUMNS, **self.columns}

    def identity(self, spec: Any) -> str:
        """Identity of a trial: 32 hex digits of spec and version."""
        whole = f"{self.name}\n{self.version()}\n{self.text(spec)}"
        return hashlib.sha256(whole.encode("utf-8", "surrogatepass")).hexdigest()[:32]


@dataclass(frozen=True)
class Task:
    """One trial to be done."""

    id: str
    spec: Any


@dataclass(frozen=True)
class Reply:
    """What a worker sends back."""

    figures: Row
    stop: str = ""
    """Why no further trial makes sense on this worker; empty where it does."""
    lasted: float = 0.0
    """Time that it took [s]."""


@dataclass(frozen=True)
class Ended:
    """A task that came to an end."""

    task: Task
    figures: Row
    """With `outcome`, `error`, `deaths` and `host`."""
    stop: str = ""


_ONE_AT_A_TIME = threading.Lock()
"""Held while a process runs what must be alone in it."""


def perform(work: Work, spec: Any, version: str) -> Reply:
    """Run one trial in a worker; what goes wrong is in its reply, not raised.

    version: version at the place where the campaign is planned.

    An exception is the outcome `failed`; a missing package or another version stops the campaign,
    since it would befall every trial.
    """
    began, host = time.monotonic(), socket.gethostname()
    here = work.version()
    if here != version:
        return Reply({}, f"the worker on {host} has {here}, the campaign {version}")
    row: Row = {"outcome": FAILED, "error": None, "host": f"{host}:{os.getpid()}"}
    try:
        with _ONE_AT_A_TIME if work.alone else nullcontext():
            row |= work.run(spec)
    except ImportError as error:
        return Reply({}, f"the worker on {host}: {error}")
    except Exception as error:  # bad news is data
        text = f"{type(error).__name__}: {error}"
        row["error"] = text.encode("utf-8", "replace").decode("utf-8")
    return Reply(row, lasted=time.monotonic() - began)
