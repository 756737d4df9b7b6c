"""Tools beside each other on the bench, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.lab.outcomes.bench import Bench

_COLUMNS = {
    "truth": "truth",
    "tool": "tool",
    "cases": "cases",
    "right": "right",
    "wrong_go": "wrong GO",
    "wrong_rough": "wrong ROUGH",
    "wrong_no_go": "wrong NO-GO",
    "undecided": "undecided",
    "ms": "ms",
}


def text(found: "Bench") -> str:
    """One line for each source of truth and tool."""
    rows = [
        {name: str(getattr(score, name)) for name in _COLUMNS if name != "ms"}
        | {"ms": f"{score.ms:.2g}"}
        for score in found.scores
    ]
    return table(rows, _COLUMNS)
