"""Whole-process time of short commands over `python -c "import numpy, pydantic"`.

The two run in turn, so that a machine that slows down slows both; the median of the ratios counts.
"""

import argparse
import statistics
import subprocess
import sys
import time

from record import finish, options

FLOOR = [sys.executable, "-c", "import numpy, pydantic"]
RUN = [sys.executable, "-c", "from kaidan.cli import main; main()"]
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


def seconds(command: list[str]) -> float:
    start = time.perf_counter()
    subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
    return time.perf_counter() - start


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--runs", type=int, default=15)
    chosen = arguments.parse_args()
    figures = {}
    for name, command in COMMANDS.items():
        seconds(RUN + command)
        ratios = [seconds(RUN + command) / seconds(FLOOR) for _ in range(chosen.runs)]
        figures[f"kaidan {name} / floor"] = statistics.median(ratios)
    targets = dict.fromkeys(figures, 1.5)
    for name, command in WHOLE.items():
        key = f"kaidan assess, contact model, {name} [s]"
        figures[key] = statistics.median(seconds(RUN + command) for _ in range(chosen.runs))
        targets[key] = SOON
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
