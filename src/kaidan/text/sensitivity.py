"""What the margin and the verdict hang on, as text."""

from typing import TYPE_CHECKING

from kaidan.assessment.sentences.measuring import name
from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.verbs.sensitivity import Sensitivity


def text(found: "Sensitivity") -> str:
    """Spread of the margin, probability of a GO, and the inputs, the weightiest first."""
    lines = [
        f"{found.robot} on {found.stairs}: margin {found.margin_deg:+.1f} deg, standard deviation "
        f"{found.deviation_deg:.1f} deg; GO with probability {found.go:.2f}",
        f"{found.judged} draws, {found.model} model, {found.facing.replace('-', ' ')}, "
        f"flippers {found.flippers}",
        "",
    ]
    first = found.inputs[0]
    if first.margin_total > 0:
        what = name(first.what)
        lines.insert(1, f"Measure first: {what}{'' if what == first.name else f' ({first.name})'}.")
    heads = {"name": "input", "first": "margin, alone", "total": "in all", "sure": "+-"}
    heads |= {"go_first": "GO, alone", "go_total": "in all"} if 0 < found.go < 1 else {}
    rows = [
        {
            "name": each.name,
            "first": f"{each.margin_first:.2f}",
            "total": f"{each.margin_total:.2f}",
            "sure": f"{each.margin_confidence:.2f}",
            "go_first": "" if each.go_first is None else f"{each.go_first:.2f}",
            "go_total": "" if each.go_total is None else f"{each.go_total:.2f}",
        }
        for each in found.inputs
    ]
    lines.append(table(rows, heads))
    lines.append("Sobol indices: share of the variance by an input alone, and in all.")
    if found.left_out:
        lines.append(f"Not drawn: {', '.join(found.left_out)}.")
    return "\n".join(lines)
