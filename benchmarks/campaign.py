"""Campaigns: trials a second on local processes and on Dask, and the paper's whole experiment.

The same trials are done by one process, by all local processes and by as many workers of a Dask
scheduler on this machine, in turn, each into a fresh store; starting processes is not counted
(each way first does some trials), storing is. Other work on the machine slows all of them, so the
ratios say more than the figures.
"""

import argparse
import json
import math
import statistics
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path

from kaidan.campaign import (
    TRIALS,
    Condition,
    DaskWorkers,
    LocalWorkers,
    Store,
    VerificationTest,
    conduct,
)
from kaidan.campaign.local import Workers, processors
from kaidan.physics import SprungNoses
from kaidan.report.verification import usual_conditions
from kaidan.robot import Robot
from record import finish, options

PAPER = (0.150, 0.180, 0.200, 0.220)


def kenaf_plan(trials: int, seed: int = 0) -> VerificationTest:
    """The paper's experiment: 4 spacings, 12 slopes each, belt with sprung noses of 30 kN/m."""
    first = VerificationTest(
        robot=Robot.named("kenaf"),
        conditions=(Condition(nosing_spacing=0.15, angle=math.radians(50.0)),),
        track=SprungNoses(stiffness=3e4),
        trials=trials,
        seed=seed,
    )
    conditions = usual_conditions(first, PAPER, descent=False)
    assert len(conditions) == 48
    return first.model_copy(update={"conditions": conditions})


def seconds(plan: VerificationTest, workers: Workers) -> float:
    """Time for a plan with workers that have begun."""
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        with Store(Path(folder), TRIALS) as store:
            tally = conduct(plan.specs(), store, workers)
        assert tally.done == len(plan)
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
        pairs = zip(times["Dask"], times["local processes"], strict=True)
        ratio = f"Dask / {count} local processes, time"
        figures[ratio] = statistics.median(there / here for there, here in pairs)
        pairs = zip(times["one process"], times["local processes"], strict=True)
        figures[f"one process / {count} local processes, time"] = statistics.median(
            one / many for one, many in pairs
        )
        whole = f"the paper's experiment, 240 trials, {count} processes [s]"
        figures[whole] = seconds(kenaf_plan(5), ways["local processes"])
    finish(figures, chosen, targets={ratio: 1.15, whole: 180.0})


if __name__ == "__main__":
    main()
