"""Figures of a benchmark: printed beside their targets, saved, compared with saved ones."""

import argparse
import json
from pathlib import Path


def options(parser: argparse.ArgumentParser) -> argparse.ArgumentParser:
    parser.add_argument("--save", type=Path, metavar="FILE", help="write the figures as JSON")
    parser.add_argument("--compare", type=Path, metavar="FILE", help="print beside saved figures")
    return parser


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
