"""Map of a design: where it is a GO, by how much, the design found, and what more change gains."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.errors import InputError
from kaidan.figures import style as look
from kaidan.modes import Verdict

if TYPE_CHECKING:
    from kaidan.verbs.design.answer import Design, DesignMap, FreeFigure

_SHOWN = {"m": ("mm", 1e3), "rad": ("°", 180 / math.pi)}
_LINES = 7
"""Contours of the margin at most."""


def design_figure(found: "Design") -> Figure:
    """Map of two free figures, or the front of cost and margin, or both.

    Raises
    ------
    InputError
        It has neither.
    """
    panels = [each for each in (found.map, found.front) if each]
    if not panels:
        raise InputError("nothing to draw: free two figures for a map, or give --front")
    with look.settings():
        figure = look.blank(4.2)
        grid = figure.add_gridspec(
            1, len(panels), width_ratios=[2.0, 1.3][: len(panels)], left=0.1, right=0.98,
            bottom=0.2, top=0.88, wspace=0.28,
        )  # fmt: skip
        at = 0
        if found.map is not None:
            _draw_map(figure.add_subplot(grid[0, at]), found, found.map)
            at += 1
        if found.front:
            _draw_front(figure.add_subplot(grid[0, at]), found)
        stairs = ", ".join(each for each in found.stairs if each)
        of = f", the worst of {len(found.stairs)}" if len(found.stairs) > 1 else ""
        title = look.named(f"{found.robot} on {stairs}{of}: {found.model} model", 100)
        figure.text(0.1, 0.94, title, weight="bold", fontsize=9.0)
    return figure


def _draw_map(axes: Axes, found: "Design", drawn: "DesignMap") -> None:
    by_name = {each.name: each for each in found.free}
    x, y = by_name[drawn.x], by_name[drawn.y]
    along, up = (
        _shown(each, np.array(v)) for each, v in ((x, drawn.x_values), (y, drawn.y_values))
    )
    verdicts = np.array(drawn.verdicts, dtype=float)
    for verdict, (colour, hatch) in look.VERDICT_FILLS.items():
        if not (verdicts == verdict.rank).any():
            continue
        filled: dict[str, Any] = {"colors": [colour], "hatches": [hatch]}
        # what is no worse lies over it, so no gap shows where three zones meet
        no_worse = (verdicts <= verdict.rank).astype(float)
        axes.contourf(along, up, no_worse, [0.5, 1.5], zorder=1.0 - 0.1 * verdict.rank, **filled)
        axes.fill_between([], [], facecolor=colour, hatch=hatch, edgecolor="#777777",
                          linewidth=0.3, label=verdict.label)  # fmt: skip
    margins = np.array(drawn.margins_deg, dtype=float)
    seen = margins[np.isfinite(margins) & (verdicts <= Verdict.UNSURE.rank)]
    if len(seen) and np.ptp(seen) > 0.1:
        step = _round_step(float(np.ptp(seen)))
        levels = np.arange(math.ceil(seen.min() / step), math.floor(seen.max() / step) + 1) * step
        if len(levels):
            lines = axes.contour(along, up, margins, levels, colors=look.BLACK, linewidths=0.7)
            labels = axes.clabel(lines, fmt=lambda value: f"{look.signed(value, 1)}°", fontsize=7.0)
            for label in labels:
                label.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.6})
    if x.now is not None and y.now is not None:
        axes.plot(
            _shown(x, x.now),
            _shown(y, y.now),
            "o",
            markerfacecolor="white",
            markeredgecolor=look.BLACK,
            markersize=6,
            label="as it is",
            clip_on=False,
        )
    axes.plot(_shown(x, x.best), _shown(y, y.best), "*", color=look.BLACK, markersize=11,
              label="found", clip_on=False)  # fmt: skip
    axes.set_xlim(along[0], along[-1])
    axes.set_ylim(up[0], up[-1])
    axes.set_xlabel(_label(x))
    axes.set_ylabel(_label(y))
    axes.legend(
        loc="upper center", bbox_to_anchor=(0.5, -0.13), ncols=6, frameon=False, fontsize=7.5,
        handlelength=1.5, columnspacing=1.0,
    )  # fmt: skip


def _draw_front(axes: Axes, found: "Design") -> None:
    cost = np.array([each.cost for each in found.front])
    margin = np.array([each.margin_deg for each in found.front], dtype=float)
    goes = np.array([each.verdict == "go" for each in found.front])
    axes.plot(cost, margin, color=look.GREY)
    for some, face, label in ((goes, look.BLACK, "GO"), (~goes, "white", "no GO")):
        if some.any():
            axes.plot(cost[some], margin[some], "o", markersize=5, markerfacecolor=face,
                      markeredgecolor=look.BLACK, label=label)  # fmt: skip
    axes.set_xlabel("change, as a share of its range")
    axes.set_ylabel("margin on the worst stairs [°]")
    axes.legend(loc="lower right", frameon=False)


def _shown(figure: "FreeFigure", value: Any) -> Any:
    return value * _SHOWN.get(figure.unit, ("", 1.0))[1]


def _label(figure: "FreeFigure") -> str:
    unit = _SHOWN.get(figure.unit, (figure.unit, 1.0))[0]
    return look.named(figure.name) + (f" [{unit}]" if unit not in ("", "1") else "")


def _round_step(span: float) -> float:
    """Distance of contours: 1, 2 or 5 times a power of ten."""
    least = span / _LINES
    power = 10.0 ** math.floor(math.log10(least))
    return next((each * power for each in (1, 2, 5) if each * power >= least), 10 * power)
