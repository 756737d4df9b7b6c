"""Picture of the predicted margin with what the text prints of the experiments (Figs. 13, 21)."""

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from kaidan.figures import style as look

if TYPE_CHECKING:
    from kaidan.lab.reproduction.reproduction import Reproduction
    from kaidan.verbs.margin_curve import MarginCurve

_HEIGHT = 4.4


def experiment_figure(found: "Reproduction", curve: "MarginCurve") -> Figure:
    """Predicted margin and the printed results, with the steps of Eq. (24) beside it."""
    with look.settings():
        figure = look.blank(_HEIGHT)
        left = figure.add_axes((0.085, 0.19, 0.43, 0.66))
        right = figure.add_axes((0.60, 0.19, 0.385, 0.66))
        _draw_plane(left, found, curve)
        _draw_steps(right, found)
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


def _draw_plane(axes: Axes, found: "Reproduction", curve: "MarginCurve") -> None:
    told, corrected = found.measured, found.equation_24.corrected_deg
    p = 1e3 * np.array(curve.nosing_spacing_m)
    sup = np.array(curve.margin_angle_deg, dtype=np.float64)
    half = 1e3 * curve.largest_nosing_spacing_m
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
    _bar(axes, told.fell_p_mm - 1.5, *told.fell_deg, "fell")
    _bar(axes, told.fell_p_mm + 1.5, *corrected, "corrected")
    axes.annotate(
        f"fell at\n{_span(told.fell_deg)}",
        (told.fell_p_mm - 3.0, 56.0),
        (106.0, 52.0),
        arrowprops={"arrowstyle": "-", "linewidth": 0.6},
    )
    axes.annotate(
        f"corrected margin, Eq. (24),\n{_span(corrected)} (computed)",
        (told.fell_p_mm + 1.5, corrected[0]),
        (112.0, 40.0),
        arrowprops={"arrowstyle": "-", "linewidth": 0.6},
    )
    axes.plot(
        *told.rotated_at, marker="o", markersize=6, markerfacecolor="white", markeredgecolor="black"
    )
    axes.annotate(
        "no fall, but\nthe body rotates",
        told.rotated_at,
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


def _draw_steps(axes: Axes, found: "Reproduction") -> None:
    """Eq. (24) at 150 mm step by step, beside the experiment."""
    steps, fell = found.equation_24, found.measured.fell_deg
    sup, after_d = steps.sup_deg, steps.less_theta_d_deg
    low, high = steps.corrected_deg
    theta_d, (least, most) = found.measured.theta_d_deg, found.measured.theta_M_deg
    axes.plot([-0.4, 0.4], [sup, sup], color=look.BLACK, linewidth=2.0)
    axes.plot([0.4, 1.0], [sup, sup], color=look.GREY, linewidth=0.6)
    _arrow(axes, 1.0, sup, after_d)
    axes.plot([1.0, 2.0], [after_d, after_d], color=look.GREY, linewidth=0.6)
    _arrow(axes, 1.75, after_d, high)
    _arrow(axes, 1.95, after_d, low)
    _bar(axes, 3.0, low, high, "corrected", 0.7)
    _bar(axes, 4.0, *fell, "fell", 0.7)
    for x, y, text, va in (
        (0.0, sup + 0.12, f"{sup:.1f}°", "bottom"),
        (1.08, (sup + after_d) / 2, f"{theta_d:.1f}°", "center"),
        (1.67, (after_d + high) / 2, f"{least:.1f}°", "center"),
        (2.03, (after_d + low) / 2, f"{most:.1f}°", "center"),
        (3.0, high + 0.12, _span((low, high), "\n"), "bottom"),
        (4.0, fell[1] + 0.12, _span(fell, "\n"), "bottom"),
    ):
        side = {1.08: "left", 1.67: "right", 2.03: "left"}.get(x, "center")
        axes.text(x, y, text, ha=side, va=va)
    axes.set_xlim(-0.55, 4.55)
    axes.set_ylim(54.0, 61.5)
    axes.set_xticks(
        range(5),
        [
            "predicted",
            f"− $\\theta_d$\nat {found.measured.theta_d_at[1]:.1f}°",
            "− $\\theta_M$",
            "corrected,\nEq. (24)",
            "fell,\ntext",
        ],
    )
    axes.tick_params(axis="x", length=0)
    axes.set_ylabel("$\\theta_s$ at $p$ = 150 mm [°]")
    axes.set_title("Eq. (24) at 150 mm", loc="left", fontsize=look.SMALL)


def _span(ends: tuple[float, float], between: str = "") -> str:
    return f"{ends[0]:.1f}–{between}{ends[1]:.1f}°"


def _arrow(axes: Axes, x: float, start: float, end: float) -> None:
    arrow = {"arrowstyle": "-|>", "linewidth": 1.0, "color": look.BLACK, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (x, end), (x, start), arrowprops=arrow)
