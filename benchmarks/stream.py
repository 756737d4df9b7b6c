"""Pairs streamed in from files and out to files, in the memory of one chunk.

Writes random float64 columns to a temporary folder, then a child process reads them chunk by
chunk, judges them with `kaidan.stream` and writes every column of the answer. The child's peak
resident memory counts. 10^8 pairs take about 6 GB in and 9 GB out on disk, deleted afterwards.
"""

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pairs import random_pairs
from record import finish, options

CHUNK = 1 << 20
LIMIT_GB = 2.0


def columns(folder: Path, count: int) -> Iterator[dict[str, np.ndarray]]:
    """Chunks of the columns in a folder."""
    files = {path.stem: path.open("rb") for path in sorted(folder.glob("*.f8"))}
    for start in range(0, count, CHUNK):
        size = min(CHUNK, count - start)
        yield {name: np.fromfile(file, np.float64, size) for name, file in files.items()}


def child(folder: Path, count: int) -> None:
    """Stream the folder's pairs through kaidan into its ``out``; print seconds and peak."""
    import kaidan

    start = time.perf_counter()
    out: dict[str, object] = {}
    judged = 0
    for answer in kaidan.stream(columns(folder, count)):
        for name, array in answer._asdict().items():
            if name not in out:
                out[name] = (folder / "out" / name).open("wb")
            array.tofile(out[name])
        judged += len(answer.verdict)
    for file in out.values():
        file.close()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    print(json.dumps({"judged": judged, "seconds": time.perf_counter() - start, "peak": peak}))


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--pairs", type=int, default=10**8)
    arguments.add_argument("--child", type=Path, help=argparse.SUPPRESS)
    chosen = arguments.parse_args()
    if chosen.child:
        child(chosen.child, chosen.pairs)
        return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "out").mkdir()
        files: dict[str, object] = {}
        for start in range(0, chosen.pairs, CHUNK):
            size = min(CHUNK, chosen.pairs - start)
            for column, values in random_pairs(size, seed=start).items():
                if column not in files:
                    files[column] = (folder / f"{column}.f8").open("wb")
                values.tofile(files[column])
        for file in files.values():
            file.close()
        command = [sys.executable, __file__, "--child", name, "--pairs", str(chosen.pairs)]
        found = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
        written = (folder / "out" / "verdict").stat().st_size
        assert found["judged"] == written == chosen.pairs
    figures = {
        "streamed pairs [million]": found["judged"] / 1e6,
        "peak memory [GB]": found["peak"] / 1e9,
        "million pairs a second, files in and out": found["judged"] / found["seconds"] / 1e6,
    }
    finish(figures, chosen, targets={"peak memory [GB]": LIMIT_GB})


if __name__ == "__main__":
    main()
