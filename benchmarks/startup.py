"""Whole-process time of short commands over `python -c "import numpy, pydantic"`.

The two run in turn, so that a machine that slows down slows both; the median of the ratios counts,
of the time on the clock and of the processor's. Compiled modules are kept, as an installation has
them.
"""

import argparse
import os
import statistics
import subprocess
import sys
import time
from typing import NamedTuple

from record import finish, options

FLOOR = [sys.executable, "-c", "import numpy, pydantic"]
RUN = [sys.executable, "-c", "from kaidan.__main__ import main; main()"]
KEPT = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
COMMANDS = {
    "--help": ["--help"],
    "assess --model closed-form": [
        "assess",
        "absolem",
        "ibc",
        "--flippers",
        "flat",
        "--surface",
        "concrete-dry",
        "--model",
        "closed-form",
    ],
}
STATED = ["assess", "absolem-flat", "ibc", "--flippers", "stowed", "--friction", "2"]
COMMANDS["assess, contact model, posture stated"] = STATED
COMMANDS["assess, contact model, best posture"] = ["assess", "absolem", "ibc", "--friction", "1.2"]
WHOLE = {
    "go": STATED,
    "with advice": ["assess", "absolem", "ibc", "--flippers", "flat", "--surface", "concrete-dry"],
}
SOON = 0.6
"""Target of a whole process that asks the contact model [s]."""


class Seconds(NamedTuple):
    """What a process took [s]."""

    clock: float
    processor: float


def seconds(command: list[str]) -> Seconds:
    start, before = time.perf_counter(), os.times()
    subprocess.run(command, stdout=subprocess.DEVNULL, check=False, env=KEPT)
    after = os.times()
    spent = sum(after[2:4]) - sum(before[2:4])  # of children: user and system
    return Seconds(time.perf_counter() - start, spent)


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--runs", type=int, default=15)
    chosen = arguments.parse_args()
    figures = {}
    for name, command in COMMANDS.items():
        seconds(RUN + command)
        pairs = [(seconds(RUN + command), seconds(FLOOR)) for _ in range(chosen.runs)]
        for which in Seconds._fields:
            ratios = [getattr(run, which) / getattr(floor, which) for run, floor in pairs]
            figures[f"kaidan {name} / floor, {which}"] = statistics.median(ratios)
    targets = dict.fromkeys(figures, 1.5)
    for name, command in WHOLE.items():
        key = f"kaidan assess, contact model, {name} [s]"
        figures[key] = statistics.median(seconds(RUN + command).clock for _ in range(chosen.runs))
        targets[key] = SOON
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
