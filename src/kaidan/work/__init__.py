"""Long work: thousands of specs on many processes or machines, into a store that survives.

`conduct` brings a `Store` and `Workers` together, whatever the `Work` is.
"""

from typing import TYPE_CHECKING

from kaidan.lazy import when_used

if TYPE_CHECKING:
    from kaidan.work.cluster import DaskWorkers
    from kaidan.work.job import CRASHED, FAILED, Work
    from kaidan.work.local import LocalWorkers, Workers
    from kaidan.work.query import State, export, read_batches, read_table, state_of
    from kaidan.work.runner import Kept, Tally, conduct
    from kaidan.work.store import Store
    from kaidan.work.threads import ThreadWorkers

_HOME = {
    "DaskWorkers": "cluster",
    "CRASHED": "job",
    "FAILED": "job",
    "Work": "job",
    "LocalWorkers": "local",
    "Workers": "local",
    "State": "query",
    "export": "query",
    "read_batches": "query",
    "read_table": "query",
    "state_of": "query",
    "Kept": "runner",
    "Tally": "runner",
    "conduct": "runner",
    "Store": "store",
    "ThreadWorkers": "threads",
}
"""Public names and the module of each: a process that works imports what it does, no more."""

__all__ = [
    "CRASHED",
    "FAILED",
    "DaskWorkers",
    "Kept",
    "LocalWorkers",
    "State",
    "Store",
    "Tally",
    "ThreadWorkers",
    "Work",
    "Workers",
    "conduct",
    "export",
    "read_batches",
    "read_table",
    "state_of",
]

__getattr__ = when_used("kaidan.work", _HOME)
