"""Picture of the slope limits over the nosing spacing (the paper's Fig. 11 for any robot)."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from kaidan.figures import style as look
from kaidan.words import heading

if TYPE_CHECKING:
    from kaidan.allowance import AllowanceShown
    from kaidan.verbs.margin_curve import MarginCurve

_HEIGHT = 4.7


def margin_figure(curve: "MarginCurve", note: str = "") -> Figure:
    """Slope limits over the nosing spacing.

    Parameters
    ----------
    curve : MarginCurve
        Limits on a grid of spacings, dense enough to be drawn as lines.
    note : str
        Line at the foot.
    """
    with look.settings():
        figure = look.blank(_HEIGHT)
        names = [
            look.extent(figure, _stairs_text(name, 45.0, 0.333))[0] for _, _, name in _shown(curve)
        ]
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


def draw_margin(axes: Axes, curve: "MarginCurve") -> None:
    """Draw the limits, the areas they bound and the marks into axes of final size."""
    p, half = 1e3 * np.array(curve.nosing_spacing_m), 1e3 * curve.largest_nosing_spacing_m
    sup, inf = _degrees(curve.margin_angle_deg), _degrees(curve.lower_angle_deg)
    steepest = max((each.angle_deg for each in curve.stairs), default=0.0)
    highest = max(float(np.max(np.nan_to_num(sup, nan=0.0))), steepest, 20.0)
    top = min(90.0, 10.0 * math.ceil((highest + 6.0) / 10.0))
    axes.set_xlim(float(p[0]), float(p[-1]))
    axes.set_ylim(0.0, top)
    axes.set_xlabel("nosing spacing $p$ [mm]")
    axes.set_ylabel("slope of the stairs $\\theta_s$ [°]")
    inside = np.isfinite(sup)
    above, below = np.clip(sup, 0.0, top), np.clip(inf, 0.0, top)
    axes.fill_between(p, above, top, where=inside, **look.fill("tips"))
    axes.fill_between(p, 0.0, np.minimum(below, above), where=np.isfinite(inf), **look.fill("nose"))
    if curve.corrected:
        for worst, best in (
            (curve.margin_angle_corrected_low_deg, curve.margin_angle_corrected_high_deg),
            (curve.lower_angle_corrected_high_deg, curve.lower_angle_corrected_low_deg),
        ):
            low, high = _degrees(worst), np.nan_to_num(_degrees(best))
            axes.fill_between(
                p,
                np.clip(low, 0.0, top),
                np.clip(high, 0.0, top),
                where=np.isfinite(low),
                **look.fill("band"),
            )
            axes.plot(p, np.where(low > 0, low, np.nan), color=look.BLACK, lw=0.9, ls="-.")
    axes.plot(p, np.where(sup > 0, sup, np.nan), color=look.VERMILION, linewidth=1.8, zorder=3)
    axes.plot(p, inf, color=look.BLUE, linestyle="--", zorder=3)
    if p[-1] > half:
        start = max(half, float(p[0]))
        axes.axvspan(start, float(p[-1]), **look.fill("outside"))
        axes.axvline(start, color=look.BLACK, linewidth=0.8)
    _contact_ticks(axes, 1e3 * curve.flat_length_m)
    _area_names(axes, curve, p, above, np.minimum(below, above), inside)
    if curve.stairs:
        _draw_stairs(axes, curve)


def _degrees(column: Sequence[float | None]) -> look.Array:
    """Angles of a column, NaN where there is none."""
    return np.array(column, dtype=np.float64)


def _area_names(
    axes: Axes,
    curve: "MarginCurve",
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
    half = 1e3 * curve.largest_nosing_spacing_m
    within = columns <= half
    sup_worst, inf_worst = sup, inf
    if curve.corrected:
        sup_worst, inf_worst = (
            np.interp(columns, p, np.nan_to_num(_degrees(limit)))
            for limit in (
                curve.margin_angle_corrected_low_deg,
                curve.lower_angle_corrected_high_deg,
            )
        )
    free = np.ones(np.broadcast_shapes(columns.shape, angle.shape), dtype=bool)
    inches = look.size_of(axes)
    for each in curve.stairs:
        aside = (columns - 1e3 * each.nosing_spacing_m) / (high - low) * inches[0]
        over = (angle - each.angle_deg) / top * inches[1]
        free &= np.hypot(aside, over) > 0.12
    downhill = curve.downhill_end
    uphill = "nose" if downhill == "tail" else "tail"
    areas = (
        (within & (angle > sup), (f"tips over its downhill end ({downhill})", "tips\ndownhill")),
        (within & (angle < sup_worst) & (angle > inf_worst), ("holds",)),
        (within & (angle < inf), (f"tips over its uphill end ({uphill})", "tips\nuphill")),
        (columns > half, ("outside the model: $p > L/2$",)),
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


def _draw_stairs(axes: Axes, curve: "MarginCurve") -> None:
    shown = _shown(curve)
    for p, angle, _ in shown:
        axes.plot(
            p, angle, marker="o", markersize=4.5, markerfacecolor="white",
            markeredgecolor=look.BLACK, zorder=5,
        )  # fmt: skip
    look.label_right(
        axes,
        [(p, angle, _stairs_text(name, angle, p / 1e3)) for p, angle, name in shown],
        start=1.0 + 0.3 / look.size_of(axes)[0],
        color=look.GREY,
    )


def _shown(curve: "MarginCurve") -> list[tuple[float, float, str]]:
    """Spacing [mm], slope [deg] and name of the stairs within the picture."""
    first, last = curve.nosing_spacing_m[0], curve.nosing_spacing_m[-1]
    return [
        (1e3 * each.nosing_spacing_m, each.angle_deg, each.name)
        for each in curve.stairs
        if first <= each.nosing_spacing_m <= last
    ]


def _stairs_text(name: str, degrees: float, p: float) -> str:
    return f"{look.named(name, 24)} ({degrees:.1f}°, {1e3 * p:.0f} mm)"


def _title(curve: "MarginCurve") -> tuple[str, str]:
    speed = (
        "at constant speed"
        if curve.acceleration == 0
        else f"with $a$ = {look.signed(curve.acceleration)} m/s² up the stairs"
    )
    return (
        f"{look.named(curve.robot)}: {heading(curve)} {speed}",
        f"$L$ = {1e3 * curve.flat_length_m:.0f} mm, centroid "
        f"{1e3 * curve.com_from_uphill_end_m:.0f} mm behind the uphill end "
        f"and {1e3 * curve.com_height_m:.0f} mm above the underside",
    )


def _handles(curve: "MarginCurve") -> list[tuple[Any, str]]:
    """Entries of the legend."""
    handles: list[tuple[Any, str]] = [
        (Line2D([], [], color=look.VERMILION, linewidth=1.8), "$\\theta_s^{sup}$: steepest slope")
    ]
    if any(angle is not None for angle in curve.lower_angle_deg):
        dashed = Line2D([], [], color=look.BLUE, linestyle="--")
        handles.append((dashed, "$\\theta_s^{inf}$: gentlest slope"))
    if curve.corrected:
        texts = [
            f"$\\{name}$ = {_range(value)}"
            + (" (not measured)" if value.source == "default" else "")
            for name, value in curve.allowances.items()
            if value.high_deg > 0
        ]
        band = (Patch(**look.fill("band")), Line2D([], [], color=look.BLACK, lw=0.9, ls="-."))
        handles.append((band, "allowances: " + ", ".join(texts)))
    return handles


def _range(value: "AllowanceShown") -> str:
    low, high = value.low_deg, value.high_deg
    return f"{high:.1f}°" if low == high else f"{low:.1f}–{high:.1f}°"
