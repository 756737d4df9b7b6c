"""Margins of an answer as bars: every failure mode from its worst to its best case."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.figures import style
from kaidan.modes import Verdict
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.assessment.answer import Assessment, FindingShown

_ROW, _HEAD, _FOOT = 0.3, 0.72, 0.45
"""Height of a row, of the head and of the foot [in]."""
_LEFT, _RIGHT = 0.42, 0.72
"""Sides of the bars over the width of the figure [1]."""
_LARGEST = {"deg": 30.0, "mm": 100.0, "m/s": 2.0}
"""Margin at which a bar ends, by its unit: beyond it nobody asks how much."""


def findings_figure(answer: "Assessment") -> Figure:
    """Bars of the margins of all failure modes that the answer has, those that fail marked.

    Bars to the right hold; each unit has a scale of its own, written beside the bar.
    """
    rows = [one for one in answer.findings.values() if one.holds is not None]
    with style.settings():
        figure = style.blank(_HEAD + _ROW * max(len(rows), 1) + _FOOT)
        height = figure.get_figheight()
        style.title(
            figure,
            0.12,
            f"{style.named(subject(answer.question), 90)}: {Verdict(answer.verdict).label}",
            style.named(answer.reason, 110),
        )
        axes = figure.add_axes(
            (_LEFT, _FOOT / height, _RIGHT - _LEFT, 1 - (_HEAD + _FOOT) / height)
        )
        _draw(axes, rows, answer.governs)
    return figure


def _draw(axes: Axes, rows: "Iterable[FindingShown]", governs: str) -> None:
    labels = []
    count = 0
    for count, one in enumerate(rows, start=1):
        y = -count
        worst, best = _place(one, one.margin), _place(one, one.margin_best)
        color = style.GREEN if one.holds else style.VERMILION
        hatch = None if one.holds else "////"
        axes.barh(y, worst, height=0.6, color=color, alpha=0.75, hatch=hatch, linewidth=0)
        axes.plot([worst, best], [y, y], color=style.BLACK, linewidth=1.2, marker="|")
        axes.text(1.06, y, _value(one), va="center", ha="left", clip_on=False)
        labels.append(one.label)
    axes.axvline(0.0, color=style.BLACK, linewidth=1.0)
    axes.set_xlim(-1.0, 1.0)
    axes.set_ylim(-count - 0.6, -0.4)
    axes.set_yticks([-k for k in range(1, count + 1)], labels)
    axes.set_xticks([-0.5, 0.5], ["fails", "holds"])
    axes.tick_params(length=0)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)


def _place(one: "FindingShown", margin: float | None) -> float:
    """Place of a margin on the bar, from -1 to 1."""
    if margin is None:
        return 1.0 if one.holds else -1.0
    return min(max(margin / _LARGEST.get(one.unit, 1.0), -1.0), 1.0)


def _value(one: "FindingShown") -> str:
    """Margin in the worst case, and in the best one where that is another."""
    if one.margin is None:
        return "holds" if one.holds else "fails"
    text = f"{style.signed(one.margin, 1)} {one.unit}"
    if one.margin_best is not None and abs(one.margin_best - one.margin) >= 0.05:
        text += f" to {style.signed(one.margin_best, 1)} {one.unit}"
    return text
