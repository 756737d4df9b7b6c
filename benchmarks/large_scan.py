"""A LAS file of many gigabytes of a staircase, streamed to stairs in a child process of its own.

The file is a cast scene, sampled a million points at a time, each with its own noise; it is made in
a new folder that is removed at the end. The memory is the child's peak resident set, with that of
Python and the libraries; files in the page cache are not included.
"""

import argparse
import json
import resource
import struct
import sys
import time
from pathlib import Path

import numpy as np

from record import finish, in_a_child, options, scratch

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
import cloud_campaign as campaign

PIECE, SCALE = 1_000_000, 1e-4
"""Points that are written at a time, and metres of one unit of their coordinates."""
RECORD = np.dtype([("xyz", "<i4", 3), ("rest", "u1", 8)])
"""A point of format 0: 20 bytes."""


def make(path: Path, gigabytes: float) -> int:
    """Write the file; its number of points."""
    pieces = max(1, round(gigabytes * 1e9 / PIECE / RECORD.itemsize))
    seen = campaign.case(1).seen
    level = (seen.xyz @ seen.turn)[:, [0, 1, 2]]
    rng = np.random.default_rng(0)
    low, high = level.min(axis=0) - 0.1, level.max(axis=0) + 0.1
    head = bytearray(227)
    head[:4], head[24], head[25] = b"LASF", 1, 2
    struct.pack_into("<HII", head, 94, 227, 227, 0)
    struct.pack_into("<BHI", head, 104, 0, RECORD.itemsize, pieces * PIECE)
    struct.pack_into("<6d", head, 131, *[SCALE] * 3, 0.0, 0.0, 0.0)
    struct.pack_into("<6d", head, 179, *np.column_stack([high, low]).ravel())
    with path.open("wb") as file:
        file.write(head)
        points = np.zeros(PIECE, RECORD)
        for _ in range(pieces):
            rows = rng.integers(0, len(level), PIECE)
            off = rng.normal(0, 0.002, (PIECE, 3)).clip(-0.01, 0.01)
            points["xyz"] = np.round((level[rows] + off) / SCALE)
            file.write(points.data)
    return pieces * PIECE


def run(path: Path) -> dict[str, float]:
    """Read it; what the child does."""
    from kaidan.readers import found_in

    start = time.process_time()
    found = found_in(path)
    return {
        "seconds": time.process_time() - start,
        "peak": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9,
        "nosings": len(found.staircases[0].flights[0]) if found.staircases else 0,
    }


def main() -> None:
    arguments = options(argparse.ArgumentParser(description=__doc__))
    arguments.add_argument("--gigabytes", type=float, default=5.0)
    arguments.add_argument("--folder", type=Path, help="where the file lies for the while")
    arguments.add_argument("--child", type=Path, help=argparse.SUPPRESS)
    chosen = arguments.parse_args()
    if chosen.child:
        print(json.dumps(run(chosen.child)))
        return
    with scratch("scan", chosen.gigabytes, chosen.folder) as folder:
        count = make(folder / "large.las", chosen.gigabytes)
        found = in_a_child(__file__, "--child", str(folder / "large.las"))
    peak = "peak memory of the process [GB]"
    figures = {
        f"{count:.2e} points, {chosen.gigabytes:g} GB [s of processor]": found["seconds"],
        peak: found["peak"],
        "nosings found": found["nosings"],
    }
    finish(figures, chosen, targets={peak: 1.5})


if __name__ == "__main__":
    main()
