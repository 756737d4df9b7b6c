"""Verdicts with all margins of random pairs, over one memory-bound numpy pass over the same arrays.

The pass reads every input once and writes every output once (``np.add(x, 1.0, out=y)``): no
program that reads the inputs and writes the outputs can do less. Measured in turn, twice: into
arrays that stand already, and into fresh ones, as an expression makes them.
"""

import argparse
import statistics
import time

import numpy as np

from kaidan.mechanics.verdict import Judged
from kaidan.sweeps.pairs import CODES, verdicts
from record import finish, options


def random_pairs(count: int, seed: int = 2016) -> dict[str, np.ndarray]:
    draw = np.random.default_rng(seed)
    length = draw.uniform(0.4, 1.3, count)
    return {
        "flat_length": length,
        "com_from_uphill": length * draw.uniform(0.3, 0.6, count),
        "com_height": draw.uniform(0.05, 0.35, count),
        "angle": draw.uniform(0.3, 1.1, count),
        "nosing_spacing": draw.uniform(0.15, 0.4, count),
        "friction": draw.uniform(0.3, 1.5, count),
        "acceleration": draw.uniform(-1.0, 1.0, count),
    }


def blank(count: int) -> Judged:
    return Judged(
        *(np.empty(count, np.int8 if name in CODES else np.float64) for name in Judged._fields)
    )


def one_pass(inputs: dict[str, np.ndarray], out: Judged) -> None:
    sources = list(inputs.values())
    for index, target in enumerate(out):
        np.add(sources[index % len(sources)], 1.0, out=target, casting="unsafe")


def seconds(action: object, runs: int) -> float:
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--pairs", type=int, default=10**7)
    arguments.add_argument("--runs", type=int, default=5)
    chosen = arguments.parse_args()
    inputs, out = random_pairs(chosen.pairs), blank(chosen.pairs)
    names = ("theta_d", "theta_M", "theta_d_spare", "theta_M_spare")
    allowances = dict.fromkeys(names, 0.045)
    figures, targets = {}, {}
    floor = seconds(lambda: one_pass(inputs, out), chosen.runs)
    fresh = seconds(lambda: one_pass(inputs, blank(chosen.pairs)), chosen.runs)
    figures["one pass, arrays standing [ns a pair]"] = 1e9 * floor / chosen.pairs
    figures["one pass, fresh arrays [ns a pair]"] = 1e9 * fresh / chosen.pairs
    for engine, target in (("numpy", 10.0), ("compiled", 2.0)):
        question = inputs | allowances
        verdicts(question, out=out, engine=engine)
        standing = seconds(
            lambda q=question, e=engine: verdicts(q, out=out, engine=e, checked=False), chosen.runs
        )
        anew = seconds(lambda q=question, e=engine: verdicts(q, engine=e), chosen.runs)
        figures[f"{engine} / pass, arrays standing"] = standing / floor
        figures[f"{engine} / pass, fresh arrays, inputs checked"] = anew / fresh
        figures[f"{engine}: million verdicts a second"] = chosen.pairs / standing / 1e6
        targets[f"{engine} / pass, arrays standing"] = target
        targets[f"{engine} / pass, fresh arrays, inputs checked"] = target
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
