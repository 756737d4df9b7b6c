"""Whole-process time of short commands over `python -c "import numpy, pydantic"`.

The two run in turn, so that a machine that slows down slows both; the median of the ratios counts,
of the time on the clock and of the processor's. Compiled modules are kept, as an installation has
them. Beside them the least that a command of this kind can take: numpy, one option of typer's, one
class of pydantic's; like kaidan it looks for no garbage and takes nothing apart at its end.
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
LEAST = [sys.executable, "-c", """
import gc, os
gc.disable()
os.environ |= {"OPENBLAS_NUM_THREADS": "1", "PYDANTIC_DISABLE_PLUGINS": "__all__"}
import numpy, pydantic, typer
class Sheet(pydantic.BaseModel):
    length: float
def main(length: float = 1.0) -> None:
    print(Sheet(length=length), flush=True)
    os._exit(0)
typer.run(main)
"""]  # fmt: skip
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


def ratios(name: str, command: list[str], runs: int) -> dict[str, float]:
    """Medians of what a command takes over what the import takes, by the name of the time."""
    seconds(command)
    pairs = [(seconds(command), seconds(FLOOR)) for _ in range(runs)]
    return {
        f"{name}, {which}": statistics.median(
            getattr(run, which) / getattr(floor, which) for run, floor in pairs
        )
        for which in Seconds._fields
    }


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--runs", type=int, default=15)
    chosen = arguments.parse_args()
    figures = {}
    for name, command in COMMANDS.items():
        figures |= ratios(f"kaidan {name} / floor", RUN + command, chosen.runs)
    targets = dict.fromkeys(figures, 1.5)
    figures |= ratios("one class, one option / floor", LEAST, chosen.runs)
    for name, command in WHOLE.items():
        key = f"kaidan assess, contact model, {name} [s]"
        figures[key] = statistics.median(seconds(RUN + command).clock for _ in range(chosen.runs))
        targets[key] = SOON
    finish(figures, chosen, targets)


if __name__ == "__main__":
    main()
