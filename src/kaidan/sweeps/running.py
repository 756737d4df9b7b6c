"""A sweep of cells from its plan: in threads, in processes or on Dask, kept or in memory."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from kaidan.errors import InputError, KaidanError, shown
from kaidan.sweeps.cells import CELLS, LISTS, REFUSED
from kaidan.sweeps.plan import Plan
from kaidan.sweeps.swept import Swept
from kaidan.work.cluster import DaskWorkers
from kaidan.work.local import LocalWorkers, Workers
from kaidan.work.progress import Progress
from kaidan.work.query import read_batches
from kaidan.work.runner import Kept, conduct
from kaidan.work.store import Store
from kaidan.work.threads import ThreadWorkers

THREADS, PROCESSES = "threads", "processes"
_TYPES: dict[str, Any] = {"texts": object, "numbers": np.float64, "counts": np.int64}


def carried_out(
    plan: Plan,
    *,
    scheduler: str = THREADS,
    workers: int | None = None,
    store: str | Path | None = None,
    progress: bool = False,
) -> Swept:
    """Judge the cells of a plan.

    Parameters
    ----------
    scheduler : str
        "threads" of this process, "processes" of this machine, or the address of a running Dask
        scheduler, tcp://HOST:8786.
    workers : int, optional
        Threads or processes; without one each processor gets one.
    store : str or Path, optional
        Folder in which what is done is kept: the same plan goes on with it.
    progress : bool
        Whether to show on standard error how it goes, if that is a terminal.

    Raises
    ------
    InputError
        Every cell is refused, the store is none, or no scheduler answers.
    MissingExtraError
        pyarrow (for a store) or distributed is not installed.
    """
    if not isinstance(store, str | Path | None):
        raise InputError(f"store = {shown(store)} is not a path")
    with (
        _workers(scheduler, workers) as hands,
        Progress(len(plan.chunks), shown=progress, what="chunks") as bar,
    ):
        if store is None:
            kept = Kept(CELLS)
            conduct(plan.specs(), kept, hands, listener=bar)
            return _put_together(plan, kept.rows)
        with Store(store, CELLS) as opened:
            opened.note_plan({"kind": "sweep", "digest": plan.digest, "cells": plan.different})
            conduct(plan.specs(), opened, hands, listener=bar)
    own = {CELLS.identity(chunk) for chunk in plan.specs()}
    batches = read_batches(store)
    rows = (row for batch in batches for row in batch.to_pylist() if row["id"] in own)
    return _put_together(plan, rows)


def _workers(scheduler: str, count: int | None) -> Workers:
    if scheduler == THREADS:
        return ThreadWorkers(CELLS, count)
    if scheduler == PROCESSES:
        return LocalWorkers(CELLS, count)
    if count is not None:
        raise InputError("a Dask scheduler has workers of its own: leave their number out")
    return DaskWorkers(CELLS, scheduler)


def _put_together(plan: Plan, rows: Iterable[Any]) -> Swept:
    """Arrays over the plan's dimensions from the rows of its chunks."""
    flat = {name: np.empty(plan.different, _TYPES[kind]) for name, kind in LISTS.items()}
    for row in rows:
        if row["verdict"] is None:
            last = row["first"] + row["cells"] - 1
            raise KaidanError(f"cells {row['first']} to {last}: {row['outcome']}: {row['error']}")
        cells = slice(row["first"], row["first"] + row["cells"])
        for name, array in flat.items():
            array[cells] = row[name]
    if (flat["governs"] == REFUSED).all():
        raise InputError(str(flat["refusal"][0]))
    return Swept(plan, {name: plan.spread(array) for name, array in flat.items()})
