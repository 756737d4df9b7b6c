"""10^8 pairs streamed from files, judged and streamed to files, in a child process of its own.

Seven columns of float64 come in (`numpy.fromfile` would copy; `readinto` fills arrays that stand)
and twelve go out, a chunk at a time: 5.6 GB in, 8.2 GB out. The time is of reading, judging and
writing; making the inputs is not counted. The memory is the child's peak resident set, files in
the page cache not included. The columns lie in a new folder that is removed at the end.
"""

import argparse
import json
import resource
import time
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import numpy as np

from kaidan import stream
from kaidan.mechanics.verdict import Judged
from kaidan.sweeps.compiled import available
from pairs import random_pairs
from record import finish, in_a_child, options, scratch

COLUMNS = tuple(random_pairs(1))
ALLOWANCE = dict.fromkeys(("theta_d", "theta_M", "theta_d_spare", "theta_M_spare"), 0.045)
PIECE = 1_000_000


def make(folder: Path, pairs: int, chunk: int) -> None:
    """Write the inputs, one file a column."""
    with ExitStack() as open_files:
        files = {
            name: open_files.enter_context((folder / f"{name}.in").open("wb")) for name in COLUMNS
        }
        for start in range(0, pairs, chunk):
            piece = random_pairs(min(chunk, pairs - start), seed=start)
            for name, file in files.items():
                file.write(piece[name].data)


def read(folder: Path, pairs: int, chunk: int) -> Iterator[dict[str, np.ndarray | float]]:
    """Chunks of the inputs, in arrays that are filled anew for each."""
    arrays = {name: np.empty(min(chunk, pairs)) for name in COLUMNS}
    with ExitStack() as open_files:
        files = {
            name: open_files.enter_context((folder / f"{name}.in").open("rb", buffering=0))
            for name in COLUMNS
        }
        for start in range(0, pairs, chunk):
            count = min(chunk, pairs - start)
            piece = {name: array[:count] for name, array in arrays.items()}
            for name, file in files.items():
                assert file.readinto(piece[name].data) == 8 * count
            yield {**piece, **ALLOWANCE}


def run(folder: Path, pairs: int, chunk: int, engine: str) -> dict[str, float]:
    """Judge everything; what the child does."""
    verdicts_seen = np.zeros(4, dtype=np.int64)
    next(stream([random_pairs(1)], engine=engine))  # compiling is not streaming
    start = time.perf_counter()
    with ExitStack() as open_files:
        files = [
            open_files.enter_context((folder / f"{name}.out").open("wb", buffering=0))
            for name in Judged._fields
        ]
        for answer in stream(read(folder, pairs, chunk), engine=engine):
            verdicts_seen += np.bincount(answer.verdict, minlength=4)
            for file, column in zip(files, answer, strict=True):
                file.write(column.data)
    seconds = time.perf_counter() - start
    assert verdicts_seen.sum() == pairs
    return {
        "seconds": seconds,
        "peak": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9,
        "go": verdicts_seen[0] / pairs,
    }


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--pairs", type=int, default=10**8)
    arguments.add_argument("--chunk", type=int, default=PIECE, help="pairs at a time")
    arguments.add_argument("--engine", default="compiled" if available() else "numpy")
    arguments.add_argument("--folder", type=Path, help="where the columns lie for the while")
    arguments.add_argument("--child", type=Path, help=argparse.SUPPRESS)
    chosen = arguments.parse_args()
    if chosen.child:
        print(json.dumps(run(chosen.child, chosen.pairs, chosen.chunk, chosen.engine)))
        return
    needed = chosen.pairs * (8 * len(COLUMNS) + 8 * 10 + 2)
    with scratch("stream", needed / 1e9, chosen.folder) as folder:
        make(folder, chosen.pairs, chosen.chunk)
        found = in_a_child(
            __file__, "--child", str(folder), "--pairs", str(chosen.pairs),
            "--chunk", str(chosen.chunk), "--engine", chosen.engine,
        )  # fmt: skip
        written = sum(path.stat().st_size for path in folder.glob("*.out"))
        assert written == chosen.pairs * (8 * 10 + 2), "a column is not whole"
    peak = "peak memory of the process [GB]"
    figures = {
        f"{chosen.pairs:.0e} pairs, {chosen.engine} [s]": found["seconds"],
        "million pairs a second, files included": chosen.pairs / found["seconds"] / 1e6,
        peak: found["peak"],
        "share of GO": found["go"],
    }
    finish(figures, chosen, targets={peak: 2.0})


if __name__ == "__main__":
    main()
