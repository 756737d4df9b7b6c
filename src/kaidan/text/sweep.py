"""What a sweep came to, as text."""

from typing import TYPE_CHECKING

from kaidan.modes import FAILURE_MODES
from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.sweeps.summary import SweepSummary

_MOST = 6
"""What decides, so many at most."""


def text(found: "SweepSummary") -> str:
    """Counts by verdict and by what decides, and the cells where they are few."""
    shape = " x ".join(f"{count} {name}" for name, count in found.dimensions.items())
    judged = "" if found.judged == found.cells else f", {found.judged} different"
    lines = [f"{found.cells} cells{judged} ({shape or 'one question'}), {found.model} model"]
    for verdict, count in found.verdicts.items():
        lines.append(f"  {verdict:<18}{count:>10}  {100 * count / found.cells:5.1f} %")
    if not found.rows:
        lines.append("What decides:")
        for key, count in list(found.governs.items())[:_MOST]:
            mode = FAILURE_MODES.get(key)
            label = mode.label if mode else key.replace("_", " ")
            lines.append(f"  {count:>10}  {label}")
        return "\n".join(lines)
    heads = {name: name for name in found.dimensions}
    heads |= {"verdict": "verdict", "governs": "decides", "margin": "margin [deg]"}
    searched = len({(row.flippers, row.facing) for row in found.rows}) > 1
    if searched and not {"flippers", "facing"} & found.dimensions.keys():
        heads |= {"flippers": "flippers", "facing": "leads"}
    rows = [
        {
            **row.of,
            "verdict": row.verdict,
            "governs": row.governs.replace("_", " "),
            "margin": "-" if row.margin_deg is None else f"{row.margin_deg:+.1f}",
            "flippers": row.flippers,
            "facing": row.facing.partition("-")[0],
        }
        for row in found.rows
    ]
    return "\n".join([*lines, "", table(rows, heads)])
