"""Strips below the side view of a traverse: inclination, energy margin, friction along the path."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from kaidan.figures import style as look

if TYPE_CHECKING:
    from kaidan.verbs.traverse_report import TraverseReport

_ROOM_FOR_NAME = 0.05
"""Share of the path that the name of a phase takes in the figure."""
_TINTS = {"enter": "#f3f3f3", "land": "#f3f3f3"}


def prepare(axes: Axes, found: "TraverseReport", *, named: bool) -> None:
    """Phases as tints, with their names above the first strip, and where the pose decides."""
    x, phase = np.array(found.poses.x_m), found.poses.phase
    for start, end in look.stretches(phase):
        name, low, high = phase[start], float(x[start:end].min()), float(x[start:end].max())
        if name in _TINTS:
            axes.axvspan(low, high, facecolor=_TINTS[name], edgecolor="none", zorder=0)
        if named and high - low > _ROOM_FOR_NAME * float(np.ptp(x)):
            axes.text(
                (low + high) / 2, 1.015, name, transform=axes.get_xaxis_transform(), ha="center",
                va="bottom", fontsize=look.SMALL, color=look.GREY,
            )  # fmt: skip
    decides = found.poses.x_m[found.poses.governing_row]
    axes.axvline(decides, color=look.BLACK, linewidth=0.7, linestyle=":", zorder=1.5)


def _along(
    axes: Axes, found: "TraverseReport", values: look.Array, color: str, style: str = "-"
) -> None:
    x = np.array(found.poses.x_m)
    legs = look.stretches(found.poses.leg)
    for start, end in legs:
        axes.plot(x[start:end], values[start:end], color=color, linestyle=style, zorder=3)
    for (_, end), (start, _) in pairwise(legs):
        axes.plot(
            [x[end - 1], x[start]], [values[end - 1], values[start]], color=color, linewidth=0.7,
            linestyle=":", zorder=2,
        )  # fmt: skip


def _column(values: Sequence[float | None], missing: float) -> look.Array:
    """Column as an array, with a number for what is missing."""
    return np.nan_to_num(np.array(values, dtype=np.float64), nan=missing)


def _level(axes: Axes, value: float, text: str, color: str = look.VERMILION) -> None:
    axes.axhline(value, color=color, linewidth=0.9, linestyle="--", zorder=2)
    axes.annotate(
        text,
        xy=(0.995, value),
        xycoords=("axes fraction", "data"),
        xytext=(0, 1.5),
        textcoords="offset points",
        ha="right",
        va="bottom",
        fontsize=look.SMALL,
        color=color,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.75},
        zorder=4,
    )


def _inclination(axes: Axes, found: "TraverseReport") -> None:
    values = np.array(found.poses.inclination_deg)
    low, high = float(values.min()), float(values.max())
    axes.set_ylim(low - 0.08 * (high - low) - 1, high + 0.22 * (high - low) + 1)
    _along(axes, found, values, look.BLUE)
    axes.set_ylabel(f"{found.leading} up [°]")
    if found.profile.inclination_deg is not None:
        angle = found.profile.inclination_deg
        _level(axes, angle, f"stairs {look.signed(angle, 1)}°", look.GREY)


def _energy(axes: Axes, found: "TraverseReport") -> None:
    threshold = found.energy_threshold_mm
    values = np.maximum(np.array(found.poses.energy_margin_mm, dtype=np.float64), 0.0)
    downhill = np.array(found.poses.energy_margin_downhill)
    axes.set_yscale("symlog", linthresh=1.0, linscale=0.5)
    axes.set_ylim(0.0, max(200.0, 1.4 * float(np.nanmax(values, initial=0.0))))
    axes.set_yticks([0, 1, 10, 100], ["0", "1", "10", "100"])
    axes.minorticks_off()
    _along(axes, found, values, look.GREY, ":")
    _along(axes, found, np.where(downhill, values, np.nan), look.BLUE)
    axes.set_ylabel("energy\nmargin [mm]")
    if not downhill.all():
        axes.text(
            0.006, 0.3, "dotted: over the uphill end", transform=axes.transAxes, color=look.GREY,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.8}, zorder=4,
        )  # fmt: skip
    _level(axes, threshold, f"sudden stop: {threshold:.2f} mm")
    _about_what_stays(axes, found, np.where(downhill, values, np.inf))


def _about_what_stays(axes: Axes, found: "TraverseReport", values: look.Array) -> None:
    """Energy margin that a phase is judged by, where it is less than that of all its poses.

    It is that of any rotation about the contact that stays as one is lost, arrested or not; at a
    pose what arrests a rotation counts.
    """
    figures = found.assessment.contact
    x, phase = np.array(found.poses.x_m), np.array(found.poses.phase)
    named = False
    for each in () if figures is None else figures.phases:
        rows, least = phase == each.phase, each.energy_margin_mm
        if least is None or not rows.any() or least > 0.99 * float(values[rows].min()):
            continue
        low, high = float(x[rows].min()), float(x[rows].max())
        axes.plot([low, high], [least, least], color=look.BLUE, linewidth=0.9, linestyle="-.")
        if not named:
            named = True
            text = f" {look.signed(round(least, 1) + 0.0, 1)} mm for any rotation, arrested or not"
            place, side = (low, "left") if low + high < x.min() + x.max() else (high, "right")
            axes.text(
                place, least, text, color=look.BLUE, va="top", ha=side, fontsize=look.SMALL,
                zorder=4,
            )  # fmt: skip


def _friction(axes: Axes, found: "TraverseReport") -> None:
    values = _column(found.poses.required_friction, np.inf)
    finite = values[np.isfinite(values)]
    highest = float(finite.max()) if len(finite) else 1.0
    friction = found.assessment.friction
    stated = 0.0 if friction is None else friction[1]
    top = min(max(1.25 * highest, 1.3 * min(stated, 2.0), 0.5), 3.0)
    axes.set_ylim(0.0, top)
    _along(axes, found, np.minimum(values, 2 * top), look.BLUE)
    axes.set_ylabel("required\nfriction")
    _stated(axes, friction, top)


def _stated(axes: Axes, friction: tuple[float, float] | None, top: float) -> None:
    """Friction of the surface: a line, a band, or in words where it lies above the picture."""
    if friction is None or friction[0] > 0.9 * top:
        text, color = "friction not stated", look.GREY
        if friction is not None:
            text, color = f"stated: more than this, {friction[0]:g}", look.VERMILION
        axes.text(
            0.995, 0.95, text, transform=axes.transAxes, ha="right", va="top",
            fontsize=look.SMALL, color=color,
        )  # fmt: skip
        return
    low, high = friction
    if low == high:
        _level(axes, low, f"stated {low:g}")
    else:
        axes.axhspan(low, high, **look.fill("band") | {"alpha": 0.25})
        _level(axes, low, f"stated {low:g}–{high:g}")


STRIPS: tuple[Callable[[Axes, "TraverseReport"], None], ...] = (_inclination, _energy, _friction)
"""What the strips show, from the uppermost down."""
