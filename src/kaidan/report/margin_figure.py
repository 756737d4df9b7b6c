"""Picture of the slope limits over the nosing spacing (the paper's Fig. 11 for any robot)."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from kaidan.assessment.allowance import Allowance
from kaidan.report import look
from kaidan.report.margin_curve import MarginCurve

_HEIGHT = 4.7


def margin_figure(curve: MarginCurve, note: str = "") -> Figure:
    """Slope limits over the nosing spacing.

    Parameters
    ----------
    curve : MarginCurve
        Limits on a grid of spacings, dense enough to be drawn as lines.
    note : str
        Line at the foot.

    Returns
    -------
    Figure
    """
    with look.settings():
        figure = look.blank(_HEIGHT)
        names = [look.extent(figure, _mark_text(mark.name, 45.0, 0.333))[0] for mark in curve.marks]
        left, right = 0.6, 0.4 + max(names, default=-0.2)
        bottom, top = 0.95, 0.68
        axes = figure.add_axes(
            (
                left / look.WIDTH,
                bottom / _HEIGHT,
                1 - (left + right) / look.WIDTH,
                1 - (bottom + top) / _HEIGHT,
            )
        )
        draw_margin(axes, curve)
        look.title(figure, left, *_title(curve))
        figure.text(left / look.WIDTH, 0.07 / _HEIGHT, note)
        handles, texts = zip(*_handles(curve), strict=True)
        figure.legend(
            handles,
            texts,
            loc="upper left",
            bbox_to_anchor=(left / look.WIDTH, (bottom - 0.5) / _HEIGHT),
            ncols=2,
            frameon=False,
            borderpad=0.0,
            borderaxespad=0.0,
            handlelength=2.6,
            columnspacing=1.6,
        )
    return figure


def draw_margin(axes: Axes, curve: MarginCurve) -> None:
    """Draw the limits, the areas they bound and the marks into axes of final size."""
    p, half = 1e3 * curve.p, 1e3 * curve.L / 2
    sup, inf = np.degrees(curve.theta_s_sup), np.degrees(curve.theta_s_inf)
    steepest = max((math.degrees(mark.theta_s) for mark in curve.marks), default=0.0)
    highest = max(float(np.max(np.nan_to_num(sup, nan=0.0))), steepest, 20.0)
    top = min(90.0, 10.0 * math.ceil((highest + 6.0) / 10.0))
    axes.set_xlim(float(p[0]), float(p[-1]))
    axes.set_ylim(0.0, top)
    axes.set_xlabel("nosing spacing $p$ [mm]")
    axes.set_ylabel("slope of the stairs $\\theta_s$ [°]")
    inside = np.isfinite(sup)
    above, below = np.clip(sup, 0.0, top), np.clip(inf, 0.0, top)
    axes.fill_between(p, above, top, where=inside, **look.fill("tips"))
    axes.fill_between(
        p, 0.0, np.minimum(below, above), where=inside & (inf > 0), **look.fill("nose")
    )
    if curve.corrected:
        for worst, best in (curve.sup_corrected, curve.inf_corrected):
            axes.fill_between(
                p,
                np.clip(np.degrees(worst), 0.0, top),
                np.clip(np.degrees(best), 0.0, top),
                where=inside,
                **look.fill("band"),
            )
        worst = np.degrees(curve.sup_corrected[0])
        axes.plot(p, np.where(worst > 0, worst, np.nan), color=look.BLACK, lw=0.9, ls="-.")
        worst = np.degrees(curve.inf_corrected[0])
        axes.plot(p, np.where(worst > 0, worst, np.nan), color=look.BLACK, lw=0.9, ls="-.")
    axes.plot(p, np.where(sup > 0, sup, np.nan), color=look.VERMILION, linewidth=1.8, zorder=3)
    axes.plot(p, np.where(inf > 0, inf, np.nan), color=look.BLUE, linestyle="--", zorder=3)
    if p[-1] > half:
        start = max(half, float(p[0]))
        axes.axvspan(start, float(p[-1]), **look.fill("outside"))
        axes.axvline(start, color=look.BLACK, linewidth=0.8)
    _contact_ticks(axes, 1e3 * curve.L)
    _area_names(axes, curve, p, above, np.minimum(below, above), inside)
    if curve.marks:
        _draw_marks(axes, curve)


def _area_names(
    axes: Axes,
    curve: MarginCurve,
    p: look.Array,
    above: look.Array,
    below: look.Array,
    inside: look.Array,
) -> None:
    """Write into each area what happens there, where there is room."""
    low, high = axes.get_xlim()
    top = axes.get_ylim()[1]
    columns = np.linspace(low, high, 200)
    angle = np.linspace(0.0, top, 200)[:, None]
    sup = np.interp(columns, p, np.where(inside, above, 0.0))
    inf = np.interp(columns, p, np.where(inside, below, 0.0))
    within = columns <= 1e3 * curve.L / 2
    sup_worst, inf_worst = sup, inf
    if curve.corrected:
        limits = (curve.sup_corrected[0], curve.inf_corrected[0])
        sup_worst, inf_worst = (
            np.interp(columns, p, np.where(inside, np.degrees(limit), 0.0)) for limit in limits
        )
    free = np.ones(np.broadcast_shapes(columns.shape, angle.shape), dtype=bool)
    inches = look.size_of(axes)
    for mark in curve.marks:
        aside = (columns - 1e3 * mark.p) / (high - low) * inches[0]
        over = (angle - math.degrees(mark.theta_s)) / top * inches[1]
        free &= np.hypot(aside, over) > 0.12
    tail, nose = ("tail", "nose") if curve.nose_up else ("nose", "tail")
    areas = (
        (within & (angle > sup), (f"tips over its downhill end ({tail})", "tips\ndownhill")),
        (within & (angle < sup_worst) & (angle > inf_worst), ("holds",)),
        (within & (angle < inf), (f"tips over its uphill end ({nose})", "tips\nuphill")),
        (columns > 1e3 * curve.L / 2, ("outside the model: $p > L/2$",)),
    )
    for area, texts in areas:
        any(look.name_area(axes, area & free, text) for text in texts)


def _contact_ticks(axes: Axes, L: float) -> None:
    """Mark above the axes where the number of contacts changes."""
    low, high = axes.get_xlim()
    width = look.size_of(axes)[0]
    last = math.inf
    for n in range(2, 40):
        place = (L / n - low) / (high - low)
        if (last - place) * width < 0.3:
            break
        if not 0 <= place <= 1:
            continue
        last = place
        axes.plot(
            [L / n] * 2,
            [1.0, 1.015],
            transform=axes.get_xaxis_transform(),
            color=look.BLACK,
            linewidth=0.7,
            clip_on=False,
        )
        axes.text(
            place,
            1.02,
            f"$L/{n}$",
            transform=axes.transAxes,
            ha="center",
            va="bottom",
            fontsize=look.SMALL,
        )


def _draw_marks(axes: Axes, curve: MarginCurve) -> None:
    low, high = axes.get_xlim()
    shown = [mark for mark in curve.marks if low <= 1e3 * mark.p <= high]
    for mark in shown:
        axes.plot(
            1e3 * mark.p,
            math.degrees(mark.theta_s),
            marker="o",
            markersize=4.5,
            markerfacecolor="white",
            markeredgecolor=look.BLACK,
            zorder=5,
        )
    look.label_right(
        axes,
        [
            (
                1e3 * mark.p,
                math.degrees(mark.theta_s),
                _mark_text(mark.name, math.degrees(mark.theta_s), mark.p),
            )
            for mark in shown
        ],
        start=1.0 + 0.3 / look.size_of(axes)[0],
        color=look.GREY,
    )


def _mark_text(name: str, degrees: float, p: float) -> str:
    return f"{look.named(name, 24)} ({degrees:.1f}°, {1e3 * p:.0f} mm)"


def _title(curve: MarginCurve) -> tuple[str, str]:
    way = f"{curve.direction} the stairs {curve.facing.replace('-', ' ')}"
    speed = (
        "at constant speed"
        if curve.acceleration == 0
        else f"with $a$ = {look.signed(curve.acceleration)} m/s² up the stairs"
    )
    return (
        f"{look.named(curve.robot)}: {way} {speed}",
        f"$L$ = {1e3 * curve.L:.0f} mm, centroid {1e3 * curve.C_L:.0f} mm behind the uphill end "
        f"and {1e3 * curve.C_N:.0f} mm above the underside",
    )


def _handles(curve: MarginCurve) -> list[tuple[Any, str]]:
    """Entries of the legend."""
    handles: list[tuple[Any, str]] = [
        (Line2D([], [], color=look.VERMILION, linewidth=1.8), "$\\theta_s^{sup}$: steepest slope")
    ]
    if bool(np.any(curve.theta_s_inf > 0)):
        dashed = Line2D([], [], color=look.BLUE, linestyle="--")
        handles.append((dashed, "$\\theta_s^{inf}$: gentlest slope"))
    if curve.corrected:
        texts = [
            f"$\\{name}$ = {_range(value)}"
            + (" (not measured)" if value.source == "default" else "")
            for name, value in (("theta_d", curve.theta_d), ("theta_M", curve.theta_M))
            if value.high > 0
        ]
        band = (Patch(**look.fill("band")), Line2D([], [], color=look.BLACK, lw=0.9, ls="-."))
        handles.append((band, "lost to " + ", ".join(texts)))
    return handles


def _range(value: Allowance) -> str:
    low, high = math.degrees(value.low), math.degrees(value.high)
    return f"{high:.1f}°" if value.low == value.high else f"{low:.1f}–{high:.1f}°"
