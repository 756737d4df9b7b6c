"""Cells of the contact model by the thousand: one after the other, in threads, processes, on Dask.

Each cell is judged as `kaidan.assess` judges: question made, traverse driven, findings, verdict.
What 10^6 and 10^9 take is worked out from the processor time of a cell, so that it says the same on
a machine that does other things too; the ratios are of the clock and mean little there. The least
of some runs counts. Processes are begun before the clock.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from kaidan.sweeps.cells import CELLS
from kaidan.sweeps.parameters import question_of
from kaidan.sweeps.plan import Along, Plan
from kaidan.sweeps.screen import excluded
from kaidan.work import DaskWorkers, Kept, LocalWorkers, Store, ThreadWorkers, conduct
from kaidan.work.local import processors
from record import finish, options

CELL = "a cell, one after the other, processor time [ms]"
SHARED = "a cell of three that share a traverse, likewise [ms]"
THREADS = "one after the other over threads, all processors [1]"
PROCESSES = "one after the other over processes, all processors [1]"
DASK = "Dask, as many workers, over processes [1]"
MILLION = "10^6 cells on two free processors [min]"
BILLION = "10^9 cells [core-days]"
SCREEN = "closed form first: to look whether it excludes a cell [ms]"
STORE = "kept in a store over in memory, processes [1]"
TARGETS = {DASK: 1.1}


def plan(count, seed, frictions=(0.9,)):
    """Random centroids and flights of one robot."""
    draw = np.random.default_rng(seed)
    rows = {
        "com_from_front": draw.uniform(0.2, 0.35, count),
        "com_height": draw.uniform(0.08, 0.25, count),
        "rise": draw.uniform(0.15, 0.2, count),
        "going": draw.uniform(0.23, 0.32, count),
    }
    along = {name: Along("row", values.tolist()) for name, values in rows.items()}
    return Plan.of({"robot": "absolem", "flippers": "flat", "model": "contact",
                    "friction": list(frictions), **along})  # fmt: skip


def seconds(cells, workers, store=None):
    """Time in which workers that have begun judge the cells of a plan."""
    with workers as hands:
        conduct(plan(4 * processors(), 1).specs(), Kept(CELLS), hands)  # begin, load, look around
        start = time.perf_counter()
        conduct(cells.specs(), Kept(CELLS) if store is None else store, hands)
        return time.perf_counter() - start


@contextmanager
def dask():
    """Address of a scheduler with a worker of one thread for each processor."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scheduler.json"
        quiet = ["--scheduler-file", str(file), "--no-dashboard"]
        one = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        begun = [
            subprocess.Popen(
                [sys.executable, "-m", f"distributed.cli.{name}", *words, *quiet],
                env=os.environ | one,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            for name, words in (
                ("dask_scheduler", ["--port", "0", "--host", "127.0.0.1"]),
                *([("dask_worker", ["--nthreads", "1", "--no-nanny", "--local-directory", folder])]
                  * processors()),
            )
        ]  # fmt: skip
        try:
            end = time.monotonic() + 60
            while not file.exists() or not file.read_text():
                assert time.monotonic() < end, "no scheduler"
                time.sleep(0.1)
            time.sleep(5.0)  # until the workers are there
            yield json.loads(file.read_text())["address"]
        finally:
            for process in reversed(begun):
                process.terminate()
            for process in begun:
                process.wait()


def main():
    parser = options(argparse.ArgumentParser(description=__doc__))
    parser.add_argument("--cells", type=int, default=1000, help="of each run [1000]")
    parser.add_argument("--runs", type=int, default=2, help="of which the quickest counts [2]")
    chosen = parser.parse_args()
    cells, count = plan(chosen.cells, 0), chosen.cells

    def least(run):
        return min(run() for _ in range(chosen.runs))

    def processor(of):
        begin = time.process_time()
        for chunk in of.specs():
            CELLS.run(chunk)
        return (time.process_time() - begin) / len(of)

    CELLS.run(cells.chunk(0, 1))
    cell = least(lambda: processor(cells))
    together = least(lambda: processor(plan(max(1, count // 3), 0, frictions=(0.7, 0.9, 1.1))))
    alone = least(lambda: seconds(cells, ThreadWorkers(CELLS, 1)))
    threads = least(lambda: seconds(cells, ThreadWorkers(CELLS)))
    processes = least(lambda: seconds(cells, LocalWorkers(CELLS)))
    values = cells.chunk(0, min(200, count)).values()
    steep = [question_of(each | {"com_height": 0.4}) for each in values]
    start = time.process_time()
    excluded(steep)
    figures = {
        CELL: 1e3 * cell,
        SHARED: 1e3 * together,
        THREADS: alone / threads,
        PROCESSES: alone / processes,
        SCREEN: 1e3 * (time.process_time() - start) / len(steep),
        MILLION: 1e6 * cell / 2 / 60,
        BILLION: 1e9 * cell / 86_400,
    }
    with tempfile.TemporaryDirectory() as folder:
        kept = []
        for run in range(chosen.runs):
            with Store(Path(folder) / str(run), CELLS) as store:
                kept.append(seconds(cells, LocalWorkers(CELLS), store))
    figures[STORE] = min(kept) / processes
    with dask() as address:
        on_dask = least(lambda: seconds(cells, DaskWorkers(CELLS, address)))
        beside = least(lambda: seconds(cells, LocalWorkers(CELLS)))
    figures[DASK] = on_dask / beside
    print(f"{processors()} processors, {count} cells")
    finish(figures, chosen, TARGETS)


if __name__ == "__main__":
    main()
