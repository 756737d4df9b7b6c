"""Picture of a virtual verification test in the form of the paper's Figs. 13, 16, 19 and 21."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from kaidan.mechanics.margin import theta_s_sup
from kaidan.report import look
from kaidan.report.reproduction import MEASURED
from kaidan.report.verification import Count, Range, Verification

_HEIGHT = 4.8
_UP, _DOWN = look.BLACK, look.BLUE
_MARKS: dict[str, dict[str, Any]] = {
    "circle": {"marker": "o", "markerfacecolor": "none"},
    "cross": {"marker": "x"},
    "triangle": {"marker": "^", "markerfacecolor": "none"},
    "square": {"marker": "s", "markerfacecolor": "none"},
}


def verification_figure(found: Verification) -> Figure:
    """Figure of an experiment.

    Parameters
    ----------
    found : Verification
        With descending trials there are panels of theta_M and of theta_d beside the main one, and
        the corrected points of Eq. (24) in it.

    Returns
    -------
    Figure
    """
    plan = found.plan
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
            f"{look.named(plan.robot.name)}: virtual verification test in the form of Fig. 13",
            f"{_track(found)}, {1e3 * plan.speed:g} mm/s, friction {plan.friction:g}, "
            f"{plan.trials} trials a condition, seed {plan.seed}",
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


def _track(found: Verification) -> str:
    track = found.plan.track
    stiffness = getattr(track, "stiffness", None) or (
        found.plan.robot.track.stiffness if track.kind == "sprung-noses" else None
    )
    return track.kind.replace("-", " ") + (f" {stiffness / 1e3:g} kN/m" if stiffness else "")


def _draw_main(axes: Axes, found: Verification) -> list[Line2D]:
    """Margins as lines, conditions as symbols; the entries of the legend."""
    spacings = [1e3 * each.nosing_spacing for each in found.spacings]
    width = max(spacings[-1] - spacings[0], 40.0)
    axes.set_xlim(spacings[0] - 0.18 * width, spacings[-1] + 0.18 * width)
    angles = [count.angle_deg for count in found.counts]
    margins = [
        angle
        for each in found.spacings
        for angle in (each.closed_form_deg, each.contact_deg)
        if angle is not None
    ]
    margins += [each.corrected.low for each in found.spacings if each.corrected is not None]
    axes.set_ylim(max(0.0, min(angles + margins) - 3.0), min(90.0, max(angles + margins) + 3.0))
    axes.set_xlabel("nosing spacing $p$ [mm]")
    axes.set_ylabel("slope of the stairs $\\theta_s$ [°]")
    handles = [_draw_closed_form(axes, found)]
    held = [(1e3 * e.nosing_spacing, e.contact_deg) for e in found.spacings if e.contact_deg]
    if held:
        x, y = zip(*held, strict=True)
        handles += axes.plot(
            x, y, color=look.GREEN, linestyle="--", marker="_", markersize=9,
            label="contact model, grade two",
        )  # fmt: skip
    shift = 0.025 * width if any(each.down for each in found.spacings) else 0.0
    seen: dict[str, Line2D] = {}
    for each in found.spacings:
        for counts, color, aside in ((each.up, _UP, -shift), (each.down, _DOWN, shift)):
            _draw_counts(axes, counts, 1e3 * each.nosing_spacing + aside, color, seen)
    handles += seen.values()
    if shift:
        handles.append(Line2D([], [], color=_DOWN, marker="o", linestyle="none",
                              markerfacecolor="none", label="blue: coming down"))  # fmt: skip
    handles += _draw_corrected(axes, found, 2.2 * shift)
    handles += _draw_printed(axes, found)
    return handles


def _draw_closed_form(axes: Axes, found: Verification) -> Line2D:
    stance = found.plan.robot.stance(found.plan.posture, found.plan.payload)
    L = stance.flat_length
    low, high = axes.get_xlim()
    p = np.linspace(max(low, 1.0), min(high, 1e3 * L / 2), 300) / 1e3
    line, = axes.plot(
        1e3 * p,
        np.degrees(theta_s_sup(L=L, p=p, C_L=stance.com_from_front, C_N=stance.com_height, a=0.0)),
        color=look.VERMILION,
        label="closed form $\\theta_s^{sup}$",
    )  # fmt: skip
    if high > 1e3 * L / 2:
        axes.axvspan(max(low, 1e3 * L / 2), high, **look.fill("outside"))
    return line


_TEXTS = {
    "circle": "did not fall at any time",
    "cross": "fell every time",
    "triangle": "fell sometimes (how often)",
    "square": "some did neither (how many)",
}


def _draw_counts(
    axes: Axes, counts: Sequence[Count], x: float, color: str, seen: dict[str, Line2D]
) -> None:
    for count in counts:
        symbol = count.symbol
        style = {"linestyle": "none", "markersize": 5.0, "markeredgewidth": 0.9, **_MARKS[symbol]}
        axes.plot(x, count.angle_deg, color=color, zorder=4, **style)
        if symbol not in seen:
            seen[symbol] = Line2D([], [], color=_UP, label=_TEXTS[symbol], **style)
        number = {"triangle": count.fell, "square": sum(count.others.values())}.get(symbol)
        if number is not None:
            axes.annotate(
                str(number), (x, count.angle_deg), (4.0, -3.0), textcoords="offset points",
                color=color,
            )  # fmt: skip


def _draw_corrected(axes: Axes, found: Verification, aside: float) -> list[Line2D]:
    points = [
        (1e3 * each.nosing_spacing + aside, each.corrected)
        for each in found.spacings
        if each.corrected is not None
    ]
    for x, corrected in points:
        _bar(axes, x, corrected, look.VERMILION)
    if not points:
        return []
    return [Line2D([], [], color=look.VERMILION, marker="D", linestyle="none", markersize=4.0,
                   label="corrected, Eq. (24)")]  # fmt: skip


def _draw_printed(axes: Axes, found: Verification) -> list[Line2D]:
    """The few numbers that the paper's text prints; nothing is taken from its pictures."""
    if found.plan.robot.name != "kenaf":
        return []
    drawn = False
    low, high = axes.get_xlim()
    if low <= MEASURED.fell_p <= high:
        x = MEASURED.fell_p - 0.05 * (high - low)
        axes.plot([x, x], [MEASURED.fell_low, MEASURED.fell_high], color=look.PURPLE, linewidth=4.0)
        drawn = True
    p, angle = MEASURED.swung_at
    bottom, top = axes.get_ylim()
    if low <= p <= high and bottom <= angle <= top:
        axes.plot(p - 0.05 * (high - low), angle, color=look.PURPLE, marker="o", markersize=4.0)
        drawn = True
    if not drawn:
        return []
    return [Line2D([], [], color=look.PURPLE, linewidth=4.0, marker="o", markersize=4.0,
                   label="printed in the paper: fell / swung")]  # fmt: skip


def _bar(axes: Axes, x: float, value: Range, color: str) -> None:
    axes.errorbar(
        x, value.mean, yerr=[[value.mean - value.low], [value.high - value.mean]], color=color,
        marker="D", markersize=4.0, capsize=2.5, linestyle="none", linewidth=1.0, zorder=5,
    )  # fmt: skip


def _draw_ranges(axes: Axes, found: Verification, name: str, label: str) -> None:
    """Mean and range of a figure over the spacings, with what the text prints of Kenaf's."""
    spacings = [1e3 * each.nosing_spacing for each in found.spacings]
    width = max(spacings[-1] - spacings[0], 40.0)
    axes.set_xlim(spacings[0] - 0.18 * width, spacings[-1] + 0.18 * width)
    axes.set_ylabel(label)
    axes.axhline(0.0, color=look.GREY, linewidth=0.6)
    values = [(1e3 * each.nosing_spacing, getattr(each, name)) for each in found.spacings]
    for x, value in values:
        if value is not None:
            _bar(axes, x, value, look.BLACK)
    if not any(value is not None for _, value in values):
        axes.text(0.5, 0.5, "no margin within\nthe slopes tried", transform=axes.transAxes,
                  ha="center", va="center")  # fmt: skip
    if found.plan.robot.name == "kenaf":
        low, high = axes.get_xlim()
        p = MEASURED.theta_M_p - 0.06 * (high - low)
        if low <= p <= high:
            ends = {"theta_d": (MEASURED.theta_d, MEASURED.theta_d)}.get(
                name, (MEASURED.theta_M_low, MEASURED.theta_M_high)
            )
            axes.plot([p, p], ends, color=look.PURPLE, linewidth=4.0, marker="o", markersize=4.0)
    top = axes.get_ylim()[1]
    axes.set_ylim(top=top if math.isfinite(top) else 1.0)
