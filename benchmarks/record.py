"""Figures of a benchmark: printed beside their targets, saved, compared with saved ones."""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


def options(parser: argparse.ArgumentParser) -> argparse.ArgumentParser:
    parser.add_argument("--save", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--compare", type=Path, metavar="FILE", help="print beside saved figures")
    return parser


@contextmanager
def scratch(name: str, gigabytes: float, folder: Path | None) -> Iterator[Path]:
    """A new folder with room for so much, removed at the end."""
    made = Path(tempfile.mkdtemp(prefix=f"kaidan-{name}-", dir=folder))
    try:
        free = shutil.disk_usage(made).free / 1e9
        if free < 1.05 * gigabytes:
            sys.exit(f"{gigabytes:.1f} GB are needed in {made}, {free:.1f} are free")
        yield made
    finally:
        shutil.rmtree(made)


def in_a_child(*command: str) -> dict[str, float]:
    """What a script prints as JSON, run in a process of its own."""
    done = subprocess.run([sys.executable, *command], stdout=subprocess.PIPE, text=True, check=True)
    return dict(json.loads(done.stdout))


def finish(
    figures: dict[str, float], chosen: argparse.Namespace, targets: dict[str, float]
) -> None:
    earlier = json.loads(chosen.compare.read_text()) if chosen.compare else {}
    for name, value in figures.items():
        line = f"{name:<58}{value:>10.3g}"
        if name in targets:
            line += f"   target <= {targets[name]:g}" + (
                "" if value <= targets[name] else "  MISSED"
            )
        if name in earlier:
            line += f"   {value / earlier[name]:.2f} x saved"
        print(line)
    if chosen.save:
        chosen.save.write_text(json.dumps(figures, indent=2) + "\n")
