"""Stairs in clouds that were cast from known scenes: failures, errors, doubts, false stairs, time.

The scenes are those of ``tests/cloud_campaign.py``. Times are in passes over the cloud: one pass
is a copy of it with a rotation. Both are measured on one thread.
"""

import argparse
import os
import sys
import time
from pathlib import Path

# read when numpy is imported: processor time of many threads is no measure of a pass
os.environ["OPENBLAS_NUM_THREADS"] = "1"
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import cloud_campaign as campaign
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters import points as interpreter
from kaidan.readers.kinds import Points

TURN = np.array([[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]])


def stairs(count: int, first: int, noise: float) -> None:
    tally = campaign.Tally()
    for number in range(first, first + count):
        campaign.judge(number, tally, noise)
    print(f"{tally.count} scenes with stairs, {tally.partial} seen in part")
    print(f"  failures {len(tally.failures)}: {tally.failures[:20]}")
    print(f"  refusals {len(tally.refusals)}: {[each[:2] for each in tally.refusals[:20]]}")
    print(f"  {'':<12}{'n':>6}{'rms z':>8}{'95 %':>8}{'max z':>8}{'RMSE':>10}{'width/RMSE':>12}")
    for name in ("spacing", "angle_deg", "first rise", "last rise", "rise", "going"):
        if tally.ratios[name]:
            n, rms, within, most, rmse, width = tally.row(name)
            row = f"{n:>6}{rms:>8.2f}{within:>8.3f}{most:>8.1f}{rmse:>10.5f}{width:>12.1f}"
            print(f"  {name:<12}{row}")


def verdicts(count: int, first: int, noise: float) -> None:
    each = [row for k in range(first, first + count) for row in campaign.verdicts(k, noise)]
    pairs = sorted({row[:2] for row in each})
    print(f"{len(each)} answers about clouds beside those about the truth")
    for pair in pairs:
        print(f"  truth {pair[0]:<8} cloud {pair[1]:<8} {sum(row[:2] == pair for row in each):>5}")
    print("  P(fail) of the cloud beside the share that fails in truth")
    for low, high in ((0.0, 0.01), (0.01, 0.1), (0.1, 0.5), (0.5, 0.9), (0.9, 1.01)):
        some = [row for row in each if row[2] is not None and low <= row[2] < high]
        if some:
            mean = np.mean([row[2] for row in some])
            share = np.mean([row[0] == "no-go" for row in some])
            share_of = f"mean {mean:.3f}  truth {share:.3f}"
            print(f"  {low:4.2f} to {min(high, 1):4.2f} {len(some):>5} {share_of}")


def without(count: int, first: int) -> None:
    found = []
    for number in range(first, first + count):
        cloud, kind = campaign.lookalike(number)
        if interpreter.found(cloud, Hints()).staircases:
            found.append((number, kind))
    print(f"{count} scenes without stairs: {len(found)} false: {found}")


def speed() -> None:
    for number in (0, 3, 9, 15):
        organised = campaign.cloud(campaign.case(number, image=(500, 400)).seen)
        passes("camera, organised", organised)
    for sensor, number in (("camera", 9), ("phone", 2), ("lidar", 4)):
        made = campaign.case(number)
        xyz = np.tile(made.seen.xyz, (200_000 // len(made.seen.xyz) + 1, 1))[:200_000]
        xyz = xyz + np.random.default_rng(0).normal(0, 1e-4, xyz.shape)
        made.seen.xyz, made.seen.grid = xyz, None
        passes(sensor, campaign.cloud(made.seen))


def passes(name: str, cloud: Points) -> None:
    took, one = [], []
    for _ in range(9):
        start = time.process_time()
        interpreter.found(cloud, Hints())
        took.append(time.process_time() - start)
        start = time.process_time()
        _ = cloud.xyz @ TURN
        one.append(time.process_time() - start)
    print(
        f"{name}: {len(cloud.xyz)} points in {1e3 * min(took):.0f} ms; a copy with a rotation "
        f"takes {1e3 * min(one):.2f} ms: {min(took) / min(one):.0f} passes"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stairs", type=int, default=100)
    parser.add_argument("--without", type=int, default=100)
    parser.add_argument(
        "--verdicts", type=int, default=30, help="scenes of which robots are judged"
    )
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--noise", type=float, default=0.01, help="largest noise [m]")
    options = parser.parse_args()
    if options.stairs:
        stairs(options.stairs, options.first, options.noise)
    if options.verdicts:
        verdicts(options.verdicts, options.first, options.noise)
    if options.without:
        without(options.without, options.first)
    speed()


if __name__ == "__main__":
    main()
