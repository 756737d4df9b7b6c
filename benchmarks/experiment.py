"""The paper's experiment with the yielding track on two workers: its time, their busy share, parts.

The whole of it is done as `kaidan lab experiment kenaf --workers 2` does it, from a cold start,
into a fresh store. Each trial is noted with its process, begin and end. The busy share is that of
the time from when the last worker has begun its first trial (the start: processes begin and import)
to when the first one has ended its last (the end: nothing is left to hand out). What a worker does
between two trials counts as idle. Waiting for a processor, which other work has, counts as neither
where the system tells it (Linux); the times say little on such a machine: run it on a quiet one."""

import argparse
import os
import statistics
import tempfile
import time
from dataclasses import replace
from itertools import pairwise
from math import radians
from pathlib import Path
from typing import Any

from kaidan.lab.campaign import TRIALS
from kaidan.lab.campaign import trials as in_mujoco
from kaidan.lab.verification.experiment import plan_of
from kaidan.lab.verification.verification import verification
from kaidan.physics import TrialSpec, YieldingBelt, run
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs
from kaidan.work import LocalWorkers, Store, conduct, read_table
from kaidan.work.job import Kind
from record import finish, options


def timed(spec: TrialSpec) -> dict[str, Any]:
    began, queued_began, processor = time.monotonic(), queued(), time.process_time()
    found = in_mujoco.run(spec)
    spent = time.process_time() - processor
    return found | {
        "pid": os.getpid(),
        "began": began,
        "ended": time.monotonic(),
        "queued_began": queued_began,
        "queued_ended": queued(),
        "spent": spent,
    }


def queued() -> float:
    """How long this process waited for a processor until now [s]; 0 where nothing tells it."""
    file = Path("/proc/self/schedstat")
    return 1e-9 * int(file.read_text().split()[1]) if file.exists() else 0.0


NOTED: dict[str, Kind] = {
    "pid": "count",
    "began": "number",
    "ended": "number",
    "queued_began": "number",
    "queued_ended": "number",
    "spent": "number",
}
TIMED = replace(TRIALS, name="timed trials", run=timed, columns={**TRIALS.columns, **NOTED})


def idle_share(rows: list[dict[str, Any]], workers: int) -> float:
    """Share of the workers' time, apart from start and end, in which they run no trial."""
    trials: dict[int, list[dict[str, Any]]] = {}
    for row in sorted(rows, key=lambda row: row["began"]):
        trials.setdefault(row["pid"], []).append(row)
    assert len(trials) == workers, "a worker did nothing"
    low = max(each[0]["began"] for each in trials.values())
    high = min(each[-1]["ended"] for each in trials.values())
    busy = idle = 0.0
    for each in trials.values():
        for row in each:
            lasted = row["ended"] - row["began"]
            within = max(0.0, min(row["ended"], high) - max(row["began"], low)) / lasted
            busy += within * (lasted - row["queued_ended"] + row["queued_began"])
        for row, later in pairwise(each):
            if row["ended"] >= low and later["began"] <= high:
                idle += later["began"] - row["ended"]
                idle -= later["queued_began"] - row["queued_ended"]
    return idle / (busy + idle)


def milliseconds_a_second(runs: int) -> float:
    """Processor time that a second of the robot's on the yielding belt costs [ms]."""
    stairs = Stairs.inclined(angle=radians(55), nosing_spacing=0.15)
    question = Question.in_one_posture("kenaf", stairs)
    belt = YieldingBelt(stiffness=4.8e4, shear_ratio=1.1, damping_ratio=0.05)
    spec = TrialSpec(question=question, track=belt, start_offset=0.3)
    run(spec)  # compiles once
    costs = []
    for _ in range(runs):
        began = time.process_time()
        robots = run(spec).time_s
        costs.append(1e3 * (time.process_time() - began) / robots)
    return statistics.median(costs)


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--workers", type=int, default=2)
    arguments.add_argument("--runs", type=int, default=15)
    chosen = arguments.parse_args()
    workers, figures, targets = chosen.workers, {}, {}
    began, spent = time.perf_counter(), time.process_time()
    plan = plan_of("kenaf")
    planning = time.process_time() - spent
    with tempfile.TemporaryDirectory() as folder:
        spent = time.process_time()
        with Store(Path(folder), TIMED) as store, LocalWorkers(TIMED, workers) as hands:
            conduct(plan.specs(), store, hands)
        conducting = time.process_time() - spent
        rows = read_table(folder, ["id", "outcome", "largest_extra_deg", *NOTED]).to_pylist()
    spent = time.process_time()
    # identities are of the timed work; the verification looks for those of its own
    own = {TIMED.identity(spec): TRIALS.identity(spec) for spec in plan.specs()}
    verification(plan, ({**row, "id": own[row["id"]]} for row in rows))
    counting = time.process_time() - spent
    whole = time.perf_counter() - began
    each = [row["spent"] for row in rows]
    name = f"the paper's experiment, {len(rows)} trials, {workers} processes [s]"
    figures[name], targets[name] = whole, 180.0
    idle = f"idle share of {workers} workers apart from start and end [%]"
    figures[idle], targets[idle] = 100.0 * idle_share(rows, workers), 5.0
    figures["processor time of all trials [s]"] = sum(each)
    figures["processor time of a trial, mean [ms]"] = 1e3 * statistics.fmean(each)
    figures["processor time of a trial, longest but the first ones [ms]"] = (
        1e3 * sorted(each)[-1 - workers]
    )
    figures["processor time of planning [s]"] = planning
    figures["processor time of handing out and storing, a trial [ms]"] = (
        1e3 * conducting / len(rows)
    )
    figures["processor time of counting and margins [s]"] = counting
    rate = "yielding belt, processor time [ms a second]"
    figures[rate], targets[rate] = milliseconds_a_second(chosen.runs), 25.0
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
