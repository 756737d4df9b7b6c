"""Picture of a virtual verification test in the form of the paper's Figs. 13, 16, 19 and 21."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from kaidan.figures import style as look

if TYPE_CHECKING:
    from kaidan.lab.verification.counts import Count, Range
    from kaidan.lab.verification.verification import Verification

_HEIGHT = 4.8
_UP, _DOWN = look.BLACK, look.BLUE
_MARKS: dict[str, dict[str, Any]] = {
    "circle": {"marker": "o", "markerfacecolor": "none"},
    "cross": {"marker": "x"},
    "triangle": {"marker": "^", "markerfacecolor": "none"},
    "plus": {"marker": "+"},
    "square": {"marker": "s", "markerfacecolor": "none"},
}


def verification_figure(found: "Verification") -> Figure:
    """Figure of an experiment.

    Parameters
    ----------
    found : Verification
        With descending trials there are panels of theta_M and of theta_d beside the main one, and
        the corrected points of Eq. (24) in it.
    """
    with look.settings():
        figure = look.blank(_HEIGHT)
        main = figure.add_axes((0.085, 0.26, 0.56, 0.62))
        upper = figure.add_axes((0.745, 0.63, 0.24, 0.25))
        lower = figure.add_axes((0.745, 0.26, 0.24, 0.25))
        handles = _draw_main(main, found)
        _draw_ranges(upper, found, "theta_d", "$\\theta_d$ [°], as Fig. 16")
        if any(each.down for each in found.spacings):
            _draw_ranges(lower, found, "theta_M", "$\\theta_M$ [°], as Fig. 19")
            lower.set_xlabel("nosing spacing $p$ [mm]")
        else:
            lower.remove()
            upper.set_xlabel("nosing spacing $p$ [mm]")
        look.title(
            figure,
            0.6,
            f"{look.named(found.robot)}: virtual verification test in the form of Fig. 13",
            f"{_track(found)}, {1e3 * found.speed_m_s:g} mm/s, friction {found.friction:g}, "
            f"{found.trials} {'trial' if found.trials == 1 else 'trials'} a condition, "
            f"seed {found.seed}",
        )
        figure.legend(
            handles=handles,
            loc="upper left",
            bbox_to_anchor=(0.075, 0.175),
            ncols=3,
            frameon=False,
            borderpad=0.0,
            borderaxespad=0.0,
            handlelength=2.2,
            columnspacing=1.4,
        )
    return figure


def _track(found: "Verification") -> str:
    stiffness = found.stiffness_N_m
    named = found.track.replace("-", " ") + (f" {stiffness / 1e3:.3g} kN/m" if stiffness else "")
    return named + (" as fitted to the paper's text" if found.track_from == "fit" else "")


def _draw_main(axes: Axes, found: "Verification") -> list[Line2D]:
    """Margins as lines, conditions as symbols; the entries of the legend."""
    spacings = [1e3 * each.nosing_spacing_m for each in found.spacings]
    width = max(spacings[-1] - spacings[0], 40.0)
    axes.set_xlim(spacings[0] - 0.18 * width, spacings[-1] + 0.18 * width)
    angles = [count.angle_deg for count in found.counts]
    margins = [
        angle
        for each in found.spacings
        for angle in (each.closed_form_deg, each.contact_deg)
        if angle is not None
    ]
    margins += [each.corrected_deg.low for each in found.spacings if each.corrected_deg is not None]
    axes.set_ylim(max(0.0, min(angles + margins) - 3.0), min(90.0, max(angles + margins) + 3.0))
    axes.set_xlabel("nosing spacing $p$ [mm]")
    axes.set_ylabel("slope of the stairs $\\theta_s$ [°]")
    handles = [_draw_closed_form(axes, found)]
    held = [(1e3 * e.nosing_spacing_m, e.contact_deg) for e in found.spacings if e.contact_deg]
    if held:
        x, y = zip(*held, strict=True)
        handles += axes.plot(
            x, y, color=look.GREEN, linestyle="none", marker="_", markersize=12,
            markeredgewidth=1.6, label="contact model, grade two",
        )  # fmt: skip
    shift = 0.025 * width if any(each.down for each in found.spacings) else 0.0
    seen: dict[str, Line2D] = {}
    for each in found.spacings:
        for counts, color, aside in ((each.up, _UP, -shift), (each.down, _DOWN, shift)):
            _draw_counts(axes, counts, 1e3 * each.nosing_spacing_m + aside, color, seen)
    handles += seen.values()
    if shift:
        handles.append(Line2D([], [], color=_DOWN, marker="o", linestyle="none",
                              markerfacecolor="none", label="blue: coming down"))  # fmt: skip
    handles += _draw_corrected(axes, found, 2.2 * shift)
    handles += _draw_printed(axes, found)
    return handles


def _draw_closed_form(axes: Axes, found: "Verification") -> Line2D:
    limit = found.closed_form
    low, high = axes.get_xlim()
    half = 1e3 * limit.ends_at_m
    line, = axes.plot(
        1e3 * np.array(limit.nosing_spacing_m), np.array(limit.angle_deg, dtype=np.float64),
        color=look.VERMILION, label="closed form $\\theta_s^{sup}$",
    )  # fmt: skip
    if high > half:
        axes.axvspan(max(low, half), high, **look.fill("outside"))
    return line


_TEXTS = {
    "circle": "did not fall at any time",
    "cross": "fell every time",
    "triangle": "fell sometimes (how often)",
    "plus": "could not be placed (how often)",
    "square": "some did neither (how many)",
}


def _draw_counts(
    axes: Axes, counts: "Sequence[Count]", x: float, color: str, seen: dict[str, Line2D]
) -> None:
    for count in counts:
        symbol = count.symbol
        style = {"linestyle": "none", "markersize": 5.0, "markeredgewidth": 0.9, **_MARKS[symbol]}
        axes.plot(x, count.angle_deg, color=color, zorder=4, **style)
        if symbol not in seen:
            seen[symbol] = Line2D([], [], color=_UP, label=_TEXTS[symbol], **style)
        number = {
            "triangle": count.fell,
            "plus": count.fell_at_start,
            "square": sum(count.others.values()),
        }.get(symbol)
        if number is not None:
            # what came down stands on the right of what went up
            aside, ha = (4.0, "left") if count.direction == "down" else (-4.0, "right")
            axes.annotate(
                str(number), (x, count.angle_deg), (aside, -3.0), textcoords="offset points",
                color=color, ha=ha,
            )  # fmt: skip


def _draw_corrected(axes: Axes, found: "Verification", aside: float) -> list[Line2D]:
    points = [
        (1e3 * each.nosing_spacing_m + aside, each.corrected_deg)
        for each in found.spacings
        if each.corrected_deg is not None
    ]
    for x, corrected in points:
        _bar(axes, x, corrected, look.GREY, hollow=True)
    if not points:
        return []
    return [Line2D([], [], color=look.GREY, marker="D", linestyle="none", markersize=4.0,
                   markerfacecolor="none",
                   label="Eq. (24) with these trials' own\nangles: no prediction")]  # fmt: skip


def _draw_printed(axes: Axes, found: "Verification") -> list[Line2D]:
    """The few numbers that the paper's text prints; nothing is taken from its pictures."""
    told = found.printed
    if told is None:
        return []
    drawn = False
    low, high = axes.get_xlim()
    if low <= told.fell_p_mm <= high:
        x = told.fell_p_mm - 0.05 * (high - low)
        axes.plot([x, x], told.fell_deg, color=look.PURPLE, linewidth=4.0)
        drawn = True
    p, angle = told.rotated_at
    bottom, top = axes.get_ylim()
    if low <= p <= high and bottom <= angle <= top:
        axes.plot(p - 0.05 * (high - low), angle, color=look.PURPLE, marker="o", markersize=4.0)
        drawn = True
    if not drawn:
        return []
    return [Line2D([], [], color=look.PURPLE, linewidth=4.0, marker="o", markersize=4.0,
                   label="printed in the paper: fell / rotated")]  # fmt: skip


def _bar(axes: Axes, x: float, value: "Range", color: str, *, hollow: bool = False) -> None:
    axes.errorbar(
        x, value.mean, yerr=[[value.mean - value.low], [value.high - value.mean]], color=color,
        marker="D", markersize=4.0, capsize=2.5, linestyle="none", linewidth=1.0, zorder=5,
        markerfacecolor="none" if hollow else color,
    )  # fmt: skip


def _draw_ranges(axes: Axes, found: "Verification", name: str, label: str) -> None:
    """Mean and range of a figure over the spacings, with what the text prints of Kenaf's."""
    spacings = [1e3 * each.nosing_spacing_m for each in found.spacings]
    width = max(spacings[-1] - spacings[0], 40.0)
    axes.set_xlim(spacings[0] - 0.18 * width, spacings[-1] + 0.18 * width)
    axes.set_ylabel(label)
    axes.axhline(0.0, color=look.GREY, linewidth=0.6)
    values = [
        (1e3 * each.nosing_spacing_m, getattr(each, f"{name}_deg")) for each in found.spacings
    ]
    for x, value in values:
        if value is not None:
            _bar(axes, x, value, look.BLACK)
    if not any(value is not None for _, value in values):
        axes.text(0.97, 0.5, "no margin\nwithin the\nslopes tried", transform=axes.transAxes,
                  ha="right", va="center")  # fmt: skip
    if found.printed is not None:
        low, high = axes.get_xlim()
        p = found.printed.theta_M_p_mm - 0.06 * (high - low)
        if low <= p <= high:
            d = found.printed.theta_d_deg
            ends = (d, d) if name == "theta_d" else found.printed.theta_M_deg
            axes.plot([p, p], ends, color=look.PURPLE, linewidth=4.0, marker="o", markersize=4.0)
    top = axes.get_ylim()[1]
    axes.set_ylim(top=top if math.isfinite(top) else 1.0)
