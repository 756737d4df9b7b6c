"""Campaigns: trials a second on local processes and on Dask, and the paper's whole experiment.

The same trials are done by one process, by all local processes and by as many workers of a Dask
scheduler on this machine, in turn, each into a fresh store; starting processes is not counted
(each way first does some trials), storing is. Other work on the machine slows all of them, so the
ratios say more than the figures; trials that only wait show what each way adds of its own.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from kaidan.lab.campaign import TRIALS, Setting, VerificationTest
from kaidan.lab.verification.verification import usual_conditions
from kaidan.physics import SprungNoses
from kaidan.work import DaskWorkers, LocalWorkers, Store, Work, conduct
from kaidan.work.local import Workers, processors
from record import finish, options

PAPER = (0.150, 0.180, 0.200, 0.220)
WAIT = 0.05
"""Of a trial that computes nothing, as long as a real one [s]."""


def wait(spec: int) -> dict[str, Any]:
    time.sleep(WAIT)
    return {"outcome": "waited", "number": spec}


def number(spec: int) -> dict[str, Any]:
    return {"number": spec}


def version() -> str:
    return "waiting"


WAITING = Work(
    name="waiting", run=wait, inputs=number, text=str, version=version, columns={"number": "count"}
)


def kenaf_plan(trials: int, seed: int = 0) -> VerificationTest:
    """The paper's experiment: 4 spacings, 12 slopes each, belt with sprung noses of 30 kN/m."""
    setting = Setting.of("kenaf", track=SprungNoses(stiffness=3e4))
    conditions = usual_conditions(setting, PAPER, descent=False)
    assert len(conditions) == 48
    return VerificationTest(setting=setting, conditions=conditions, trials=trials, seed=seed)


def seconds(plan: VerificationTest | int, workers: Workers) -> float:
    """Time for a plan, or for so many trials that wait, with workers that have begun."""
    waiting = isinstance(plan, int)
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        with Store(Path(folder), WAITING if waiting else TRIALS) as store:
            tally = conduct(range(plan) if waiting else plan.specs(), store, workers)
        assert tally.done == (plan if waiting else len(plan))
        return time.perf_counter() - start


def dask(stack: ExitStack, count: int) -> str:
    """Address of a scheduler with workers of one thread, in processes of their own."""
    folder = stack.enter_context(tempfile.TemporaryDirectory())
    file = Path(folder) / "scheduler.json"
    common = ["--scheduler-file", str(file), "--no-dashboard"]
    words = [["dask_scheduler", "--port", "0", "--host", "127.0.0.1", *common]]
    words += [["dask_worker", *common, "--nthreads", "1", "--no-nanny"]] * count
    for command in words:
        process = subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{command[0]}", *command[1:]],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd=folder,
        )
        stack.callback(process.wait)
        stack.callback(process.terminate)
    while not file.exists():
        time.sleep(0.1)
    return str(json.loads(file.read_text())["address"])


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--workers", type=int, default=min(2, processors()))
    arguments.add_argument("--rounds", type=int, default=7)
    chosen = arguments.parse_args()
    figures: dict[str, float] = {}
    with ExitStack() as stack:
        count = chosen.workers
        address = dask(stack, count)
        ways: dict[str, Workers] = {
            "one process": stack.enter_context(LocalWorkers(TRIALS, 1)),
            "local processes": stack.enter_context(LocalWorkers(TRIALS, count)),
            "Dask": stack.enter_context(DaskWorkers(TRIALS, address)),
        }
        for workers in ways.values():
            seconds(kenaf_plan(1), workers)
        times: dict[str, list[float]] = {name: [] for name in ways}
        for turn in range(chosen.rounds):
            plan = kenaf_plan(1, seed=turn + 1)
            for name, workers in sorted(ways.items(), reverse=bool(turn % 2)):
                times[name].append(seconds(plan, workers))
        for name, taken in times.items():
            figures[f"{name}, trials a second"] = len(plan) / statistics.median(taken)
        ratio = f"Dask / {count} local processes, time"
        figures[ratio] = median_ratio(times["Dask"], times["local processes"])
        figures[f"one process / {count} local processes, time"] = median_ratio(
            times["one process"], times["local processes"]
        )
        whole = f"the paper's experiment, 240 trials, {count} processes [s]"
        figures[whole] = seconds(kenaf_plan(5), ways["local processes"])
    with ExitStack() as stack:
        here: Workers = stack.enter_context(LocalWorkers(WAITING, count))
        there: Workers = stack.enter_context(DaskWorkers(WAITING, dask(stack, count)))
        waits = [(seconds(100, there), seconds(100, here)) for _ in range(chosen.rounds + 1)][1:]
        waited = f"the same, trials that only wait {1e3 * WAIT:g} ms"
        figures[waited] = median_ratio(*zip(*waits, strict=True))
        alone = f"{count} local processes / waiting alone, time"
        figures[alone] = statistics.median(local for _, local in waits) * count / (100 * WAIT)
    finish(figures, chosen, targets={ratio: 1.15, waited: 1.15, whole: 180.0})


def median_ratio(upper: Sequence[float], lower: Sequence[float]) -> float:
    return statistics.median(a / b for a, b in zip(upper, lower, strict=True))


if __name__ == "__main__":
    main()
