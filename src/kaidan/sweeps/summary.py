"""What a sweep came to, in a few lines."""

from collections import Counter
from typing import Any

from kaidan.answer import Answer, Part
from kaidan.sweeps.cells import VERDICTS
from kaidan.sweeps.swept import Swept

MOST_ROWS = 40
"""Cells up to which each is shown."""


class SweptCell(Part):
    """One cell of a sweep."""

    of: dict[str, str]
    """What varies, as people write it."""
    verdict: str
    """As in an answer; not-go: the closed form alone excludes a GO, no model judged it."""
    governs: str
    """What decides; refused: the cell has no physical meaning."""
    margin_deg: float | None
    """Smallest margin of slope in the worst case, at the accepted risk [deg]."""
    flippers: str
    """Posture as the option is written, found where it was to be."""
    facing: str
    """Which end leads."""


class SweepSummary(Answer):
    """Counts of a sweep, and its cells where they are few."""

    text_module = "kaidan.text.sweep"

    model: str
    """Which model judged."""
    dimensions: dict[str, int]
    """What varies, and how many values it has."""
    cells: int
    """Number of cells."""
    judged: int
    """Cells that differ: what says the same is judged once."""
    verdicts: dict[str, int]
    """Cells by verdict."""
    governs: dict[str, int]
    """Cells by what decides, the most frequent first."""
    rows: tuple[SweptCell, ...]
    """Every cell, where they are few; else none."""


def summary_of(swept: Swept) -> SweepSummary:
    """Summary of a sweep."""
    plan = swept.plan
    governs = Counter(swept.variables["governs"].ravel().tolist())
    return SweepSummary(
        model=str(plan.base.get("model", "contact")),
        dimensions={dim: len(labels) for dim, labels in plan.labels.items()},
        cells=len(swept),
        judged=plan.different,
        verdicts={word: count for word in VERDICTS if (count := swept.count(word))},
        governs=dict(governs.most_common()),
        rows=_rows(swept) if len(swept) <= MOST_ROWS else (),
    )


def _rows(swept: Swept) -> tuple[SweptCell, ...]:
    columns = swept.columns()
    varied = [*swept.plan.labels, *(n for n in swept.plan.parameters if n not in swept.plan.labels)]
    flat = {name: array.ravel() for name, array in swept.variables.items()}
    return tuple(
        SweptCell(
            of={name: _shown(columns[name][k]) for name in varied},
            verdict=VERDICTS[int(flat["verdict"][k])],
            governs=flat["governs"][k],
            margin_deg=float(flat["margin_deg"][k]),
            flippers=flat["flippers"][k],
            facing=flat["facing"][k],
        )
        for k in range(len(swept))
    )


def _shown(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float | int) else str(value)
