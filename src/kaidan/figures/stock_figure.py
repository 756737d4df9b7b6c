"""A fleet on a stock of stairs: bars of verdicts and of what decides; of many robots a curve."""

from collections import Counter
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.figures import style as look
from kaidan.text.stock import label as short

if TYPE_CHECKING:
    from kaidan.verbs.stock.answer import StockStudy

_VERDICTS: dict[str, tuple[str, str, str | None]] = {
    each.name.lower(): (each.label, *fill) for each, fill in look.VERDICT_FILLS.items()
} | {"not_go": ("no GO", "#f7dfc0", "\\\\\\\\")}
"""Word, tint and hatch of each share; a screen leaves open which verdict is not a GO."""
_MODES = (
    ("#4c4c4c", None), ("#bdbdbd", None), ("#ffffff", "////"), ("#e0e0e0", "xxxx"),
    ("#ffffff", "...."), ("#8c8c8c", "\\\\\\\\"),
)  # fmt: skip
"""Fillings of the most frequent failure modes, legible without colour."""
_MOST = 24
"""Robots that get a bar each; of more there is a curve."""


def stock_figure(found: "StockStudy") -> Figure:
    """Shares of verdicts and of what decides, robot by robot."""
    many = len(found.robots) > _MOST
    rows = 0 if many else len(found.robots)
    height = 4.2 if many else 1.4 + 0.27 * rows
    with look.settings():
        figure = look.blank(height)
        title = f"{found.stock}: {found.flights:g} flights, {found.model} model"
        figure.text(0.02, 1 - 0.22 / height, look.named(title, 100), weight="bold", fontsize=9.0)
        if many:
            _draw_curve(figure.add_axes((0.1, 0.14, 0.86, 0.72)), found)
            return figure
        names = [look.named(each.robot, 22) for each in found.robots]
        left = (max(look.extent(figure, name)[0] for name in names) + 0.15) / look.WIDTH
        wide = (0.98 - left) / 2 - 0.02
        bottom, high = 1.0 / height, 0.27 * rows / height
        verdicts = figure.add_axes((left, bottom, wide, high))
        _draw_verdicts(verdicts, found, names)
        _draw_modes(figure.add_axes((left + wide + 0.04, bottom, wide, high)), found)
    return figure


def _draw_verdicts(axes: Axes, found: "StockStudy", names: list[str]) -> None:
    y = np.arange(len(found.robots))
    start = np.zeros(len(y))
    for field, (label, colour, hatch) in _VERDICTS.items():
        share = 100 * np.array([getattr(each, field) for each in found.robots])
        if share.any():
            axes.barh(y, share, 0.75, start, facecolor=colour, hatch=hatch, label=label,
                      edgecolor="#777777", linewidth=0.4)  # fmt: skip
        start += share
    for row, each in enumerate(found.robots):
        axes.text(
            1.0,
            row,
            f"{100 * each.go:.0f} %",
            va="center",
            fontsize=7.0,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
        )
    _finish(axes, len(y))
    axes.set_yticks(y, names)
    axes.set_xlabel("share of flights [%]")


def _draw_modes(axes: Axes, found: "StockStudy") -> None:
    total: Counter[str] = Counter()
    for each in found.robots:
        total.update(each.governs)
    shown = [key for key, _ in total.most_common(len(_MODES) - 1)]
    rest = [key for key in total if key not in shown]
    y = np.arange(len(found.robots))
    start = np.zeros(len(y))
    for keys, (colour, hatch) in zip([*([key] for key in shown), rest], _MODES, strict=False):
        share = 100 * np.array([
            sum(each.governs.get(key, 0.0) for key in keys) for each in found.robots
        ])  # fmt: skip
        if share.any():
            label = short(keys[0]) if keys != rest else "other"
            axes.barh(y, share, 0.75, start, facecolor=colour, hatch=hatch, label=label,
                      edgecolor="#777777", linewidth=0.4)  # fmt: skip
        start += share
    _finish(axes, len(y))
    axes.set_yticks([])
    axes.set_xlabel("what decides where it is no GO [%]")


def _finish(axes: Axes, rows: int) -> None:
    axes.set_xlim(0, 100)
    axes.set_ylim(rows - 0.5, -0.5)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    if axes.get_legend_handles_labels()[1]:
        down = -0.42 / (0.27 * rows)
        axes.legend(loc="upper left", bbox_to_anchor=(-0.02, down), ncols=3, frameon=False,
                    fontsize=6.5, handlelength=1.4, columnspacing=0.8)  # fmt: skip


def _draw_curve(axes: Axes, found: "StockStudy") -> None:
    shares = 100 * np.sort([each.go for each in found.robots])
    of_fleet = 100 * (np.arange(len(shares)) + 1) / len(shares)
    axes.step(shares, of_fleet, where="post", color=look.BLACK)
    axes.set_xlabel("share of flights that is a GO [%]")
    axes.set_ylabel(f"share of {len(shares)} robots that take no more [%]")
    axes.set_xlim(0, 100)
    axes.set_ylim(0, 100)
