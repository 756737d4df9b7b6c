"""Picture of the predicted margin with what the text prints of the experiments (Figs. 13, 21)."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.report import look
from kaidan.report.margin_curve import MarginCurve
from kaidan.report.reproduction import Measured

_HEIGHT = 4.4


def experiment_figure(curve: MarginCurve, told: Measured, corrected: tuple[float, float]) -> Figure:
    """Predicted margin and the printed results, with the steps of Eq. (24) beside it.

    Parameters
    ----------
    curve : MarginCurve
        Predicted margin.
    told : Measured
        What the text prints.
    corrected : (low, high)
        Corrected margin at `told.fell_p` [deg].

    Returns
    -------
    Figure
    """
    with look.settings():
        figure = look.blank(_HEIGHT)
        left = figure.add_axes((0.085, 0.19, 0.43, 0.66))
        right = figure.add_axes((0.60, 0.19, 0.385, 0.66))
        _draw_plane(left, curve, told, corrected)
        _draw_steps(right, curve, told, corrected)
        look.title(
            figure,
            0.6,
            "Kenaf: predicted margin and the experimental numbers that the text prints",
            "up, nose first, constant speed of 100 mm/s; five trials a condition",
        )
        figure.text(
            0.085,
            0.03,
            "The other points of the paper's Figs. 13, 16, 19 and 21 stand in its pictures only: "
            "not shown.",
        )
    return figure


def _draw_plane(
    axes: Axes, curve: MarginCurve, told: Measured, corrected: tuple[float, float]
) -> None:
    p, sup = 1e3 * curve.p, np.degrees(curve.theta_s_sup)
    half = 1e3 * curve.L / 2
    axes.plot(p, sup, color=look.BLACK)
    axes.set_xlim(float(p[0]), float(p[-1]))
    axes.set_ylim(20.0, 75.0)
    axes.axvspan(half, float(p[-1]), **look.fill("outside"))
    axes.axvline(half, color=look.BLACK, linewidth=0.8)
    axes.text(
        (half + p[-1]) / 2,
        47.5,
        "outside the model",
        rotation=90.0,
        ha="center",
        va="center",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5, "alpha": 0.9},
    )
    axes.set_xlabel("nosing spacing $p$ [mm]")
    axes.set_ylabel("slope of the stairs $\\theta_s$ [°]")
    axes.annotate(
        "predicted margin $\\theta_s^{sup}$,\nEqs. (19)–(23)",
        (188.0, float(np.interp(188.0, p, sup))),
        (160.0, 67.0),
        arrowprops={"arrowstyle": "-", "linewidth": 0.6},
    )
    _bar(axes, told.fell_p - 1.5, told.fell_low, told.fell_high, "fell")
    _bar(axes, told.fell_p + 1.5, *corrected, "corrected")
    axes.annotate(
        "fell at\n55.0–57.0°",
        (told.fell_p - 3.0, 56.0),
        (106.0, 52.0),
        arrowprops={"arrowstyle": "-", "linewidth": 0.6},
    )
    axes.annotate(
        "corrected margin, Eq. (24),\n55.0–56.4° (computed)",
        (told.fell_p + 1.5, corrected[0]),
        (112.0, 40.0),
        arrowprops={"arrowstyle": "-", "linewidth": 0.6},
    )
    axes.plot(
        *told.swung_at, marker="o", markersize=6, markerfacecolor="white", markeredgecolor="black"
    )
    axes.annotate(
        "no fall, but\nthe body swings",
        told.swung_at,
        (163.0, 27.0),
        arrowprops={"arrowstyle": "-", "linewidth": 0.6, "shrinkB": 4},
    )


_BARS: dict[str, dict[str, Any]] = {
    "fell": {"facecolor": look.VERMILION, "edgecolor": look.BLACK, "hatch": "xxxxx"},
    "corrected": {"facecolor": look.SKY, "edgecolor": look.BLACK, "hatch": None},
    "range": {"facecolor": "#bdbdbd", "edgecolor": look.BLACK, "hatch": "/////"},
}


def _bar(axes: Axes, x: float, low: float, high: float, kind: str, width: float = 3.0) -> None:
    axes.bar(x, high - low, width, bottom=low, linewidth=0.7, zorder=4, **_BARS[kind])


def _draw_steps(
    axes: Axes, curve: MarginCurve, told: Measured, corrected: tuple[float, float]
) -> None:
    """Eq. (24) at 150 mm step by step, beside the experiment."""
    sup = math.degrees(float(np.interp(told.fell_p, 1e3 * curve.p, curve.theta_s_sup)))
    after_d = sup - told.theta_d
    low, high = corrected
    axes.plot([-0.4, 0.4], [sup, sup], color=look.BLACK, linewidth=2.0)
    axes.plot([0.4, 1.0], [sup, sup], color=look.GREY, linewidth=0.6)
    _arrow(axes, 1.0, sup, after_d)
    axes.plot([1.0, 2.0], [after_d, after_d], color=look.GREY, linewidth=0.6)
    _arrow(axes, 1.75, after_d, high)
    _arrow(axes, 1.95, after_d, low)
    _bar(axes, 3.0, low, high, "corrected", 0.7)
    _bar(axes, 4.0, told.fell_low, told.fell_high, "fell", 0.7)
    for x, y, text, va in (
        (0.0, sup + 0.12, f"{sup:.1f}°", "bottom"),
        (1.08, (sup + after_d) / 2, "2.6°", "center"),
        (1.67, (after_d + high) / 2, "1.2°", "center"),
        (2.03, (after_d + low) / 2, "2.6°", "center"),
        (3.0, high + 0.12, f"{low:.1f}–\n{high:.1f}°", "bottom"),
        (4.0, told.fell_high + 0.12, "55.0–\n57.0°", "bottom"),
    ):
        side = {1.08: "left", 1.67: "right", 2.03: "left"}.get(x, "center")
        axes.text(x, y, text, ha=side, va=va)
    axes.set_xlim(-0.55, 4.55)
    axes.set_ylim(54.0, 61.5)
    axes.set_xticks(
        range(5),
        [
            "predicted",
            "− $\\theta_d$\nat 56.8°",
            "− $\\theta_M$",
            "corrected,\nEq. (24)",
            "fell,\ntext",
        ],
    )
    axes.tick_params(axis="x", length=0)
    axes.set_ylabel("$\\theta_s$ at $p$ = 150 mm [°]")
    axes.set_title("Eq. (24) at 150 mm", loc="left", fontsize=look.SMALL)


def _arrow(axes: Axes, x: float, start: float, end: float) -> None:
    arrow = {"arrowstyle": "-|>", "linewidth": 1.0, "color": look.BLACK, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (x, end), (x, start), arrowprops=arrow)
