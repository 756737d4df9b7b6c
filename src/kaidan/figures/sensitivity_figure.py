"""Sobol indices of the margin and of GO: a bar for an input alone, a mark for all it does."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.figures import style as look

if TYPE_CHECKING:
    from kaidan.verbs.sensitivity import Sensitivity


def sensitivity_figure(found: "Sensitivity") -> Figure:
    """Bars of the indices, the weightiest input first."""
    both = 0 < found.go < 1
    rows = len(found.inputs)
    height = 1.25 + 0.3 * rows
    with look.settings():
        figure = look.blank(height)
        title = (
            f"{found.robot} on {found.stairs}: {look.signed(found.margin_deg, 1)} ± "
            f"{found.deviation_deg:.1f}°, GO with probability {found.go:.2f}"
        )
        figure.text(0.02, 1 - 0.22 / height, look.named(title, 110), weight="bold", fontsize=9.0)
        labels = [look.named(each.name) for each in found.inputs]
        left = (max(look.extent(figure, label)[0] for label in labels) + 0.15) / look.WIDTH
        wide = (0.97 - left) / (2 if both else 1) - (0.02 if both else 0.0)
        bottom, high = 0.72 / height, 0.3 * rows / height
        margin = figure.add_axes((left, bottom, wide, high))
        sure = [each.margin_confidence for each in found.inputs]
        alone = [each.margin_first for each in found.inputs]
        total = [each.margin_total for each in found.inputs]
        _draw(margin, alone, total, sure)
        margin.set_yticks(np.arange(rows), labels)
        margin.set_xlabel("share of the variance of the margin")
        if both:
            go = figure.add_axes((left + wide + 0.04, bottom, wide, high))
            _draw(go, [e.go_first or 0.0 for e in found.inputs],
                  [e.go_total or 0.0 for e in found.inputs], None)  # fmt: skip
            go.set_yticks([])
            go.set_xlabel("share of the variance of GO")
        margin.legend(loc="upper left", bbox_to_anchor=(-0.02, -0.4 / (0.3 * rows)), ncols=2,
                      frameon=False, fontsize=7.5)  # fmt: skip
    return figure


def _draw(axes: Axes, alone: list[float], total: list[float], sure: list[float] | None) -> None:
    y = np.arange(len(alone))
    axes.barh(y, alone, 0.6, facecolor=look.PALE, edgecolor=look.BLACK, linewidth=0.6,
              label="by itself")  # fmt: skip
    middle = np.array(total)
    spread = None
    if sure is not None:  # an index is within 0 to 1
        spread = [middle - np.clip(middle - sure, 0, 1), np.clip(middle + sure, 0, 1) - middle]
    axes.errorbar(middle, y, xerr=spread, fmt="D", color=look.BLACK, markersize=4, capsize=2,
                  linewidth=0.8, label="in all", clip_on=False)  # fmt: skip
    axes.set_xlim(0, 1)
    axes.set_ylim(len(y) - 0.5, -0.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
