"""Picture of an agreement: every model's steepest flight, and each difference on its band."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from kaidan.figures import style as look
from kaidan.lab.cross_check.text import MODELS
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.lab.cross_check.answer import Agreement, Difference, JudgeName
    from kaidan.lab.cross_check.bands import Band

_MARKS: "dict[JudgeName, tuple[str, str]]" = {
    "closed_form": ("s", look.BLACK),
    "static_criterion": ("x", look.VERMILION),
    "contact": ("o", look.BLUE),
    "physics": ("^", look.GREEN),
}
NAMES = {
    "steepest_flight": "steepest flight",
    "stairs": "on these stairs",
    "extra": "extra inclination",
    "friction": "required friction",
}
_WIDEST = 3.0
"""Half the width of the scale of differences, in bands."""


def agreement_figure(found: "Agreement") -> Figure:
    """Steepest flights on a scale of slope, and differences in units of their bands.

    Parameters
    ----------
    found : Agreement
        What `kaidan.lab.agree` found.
    """
    shown = [each for each in found.differences if each.value_deg is not None]
    with look.settings():
        figure = look.blank(2.75 + 0.26 * len(shown))
        height = figure.get_size_inches()[1]
        limits = figure.add_axes((0.20, 1 - 1.35 / height, 0.77, 0.55 / height))
        rows = figure.add_axes((0.38, 0.75 / height, 0.42, (0.26 * len(shown) + 0.1) / height))
        _draw_limits(limits, found)
        _draw_differences(rows, shown)
        look.title(
            figure,
            0.2,
            f"{look.named(subject(found.question), 90)}: {'agree' if found.agrees else 'differ'}",
            f"closed form, contact model and MuJoCo (smooth belt, {found.speed_m_s:g} m/s, "
            f"to {found.resolution_deg:g}°)",
        )
    return figure


def _draw_limits(axes: Axes, found: "Agreement") -> None:
    steepest = found.comparisons[0]
    handles = []
    values = [found.slope_deg]
    for model, (marker, colour) in _MARKS.items():
        value = steepest.answers[model]
        if not isinstance(value, float):
            continue
        values.append(value)
        hollow = "none" if marker != "x" else None
        axes.plot(
            value, 0.0, marker=marker, color=colour, markerfacecolor=hollow, linestyle="none",
            markersize=7, clip_on=False, zorder=4,
        )  # fmt: skip
        handles.append(
            Line2D([], [], marker=marker, color=colour, markerfacecolor=hollow or colour,
                   linestyle="none", label=f"{MODELS[model]} {value:.1f}°")
        )  # fmt: skip
    axes.axvline(values[0], color=look.GREY, linestyle="--", linewidth=1.0)
    handles.append(Line2D([], [], color=look.GREY, ls="--", label=f"these stairs {values[0]:.1f}°"))
    room = max(1.0, 0.1 * (max(values) - min(values)))
    axes.set_xlim(min(values) - room, max(values) + room)
    axes.set_ylim(-1.0, 1.0)
    axes.set_yticks([0.0], ["steepest flight\nof this spacing"])
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("slope $\\theta_s$ [°]", labelpad=1.0)
    axes.legend(
        handles=handles, loc="lower left", bbox_to_anchor=(-0.22, 1.0), ncols=3, frameon=False,
        fontsize=7.0, handletextpad=0.4, columnspacing=1.0, borderaxespad=0.1,
    )  # fmt: skip


def _draw_differences(axes: Axes, shown: "Sequence[Difference]") -> None:
    """Each difference between the ends of its band, which lie at -1 and 1."""
    labels = []
    for row, each in enumerate(shown):
        assert each.value_deg is not None
        y = len(shown) - 1.0 - row
        labels.append(f"{NAMES[each.comparison]}:\n{MODELS[each.of]} less {MODELS[each.less]}")
        low, high = _drawn_band(each.band)
        axes.barh(y, high - low, 0.62, left=low, **look.fill("band"))
        place = place_on_band(each)
        axes.plot(
            place, y, marker="o" if each.within else "X", markersize=6, zorder=4, clip_on=False,
            color=look.BLACK if each.within else look.VERMILION,
        )  # fmt: skip
        axes.text(
            1.03, y, f"{look.signed(round(each.value_deg, 2) + 0.0)}° {_band(each)}", va="center",
            transform=axes.get_yaxis_transform(), fontsize=7.0,
        )  # fmt: skip
    axes.set_yticks([len(shown) - 1.0 - row for row in range(len(shown))], labels, fontsize=6.5)
    axes.set_xlim(-_WIDEST, _WIDEST)
    axes.set_ylim(-0.5, max(len(shown) - 0.5, 0.5))
    axes.set_xticks([-1, 1], ["least\nexpected", "most\nexpected"])
    axes.axvline(0.0, color=look.PALE, linewidth=0.8, zorder=0)
    axes.tick_params(axis="y", length=0)
    axes.legend(
        handles=[
            Patch(**look.fill("band"), label="band"),
            Line2D([], [], marker="o", color=look.BLACK, ls="none", label="within"),
            Line2D([], [], marker="X", color=look.VERMILION, ls="none", label="outside, or none"),
        ],
        loc="upper center", bbox_to_anchor=(0.5, -0.38 / max(0.26 * len(shown), 0.3)), ncols=3,
        frameon=False, fontsize=7.0,
    )  # fmt: skip


def _drawn_band(band: "Band | None") -> tuple[float, float]:
    """Ends of a band on the scale; an open end is the end of the scale."""
    if band is None:
        return 0.0, 0.0
    return (-_WIDEST if band.low_deg is None else -1.0, _WIDEST if band.high_deg is None else 1.0)


def place_on_band(each: "Difference") -> float:
    """Where a difference lies, its band's ends at -1 and 1; open ends have no scale."""
    assert each.value_deg is not None
    band = each.band
    if band is None:
        return math.copysign(_WIDEST, each.value_deg)
    low, high = band.low_deg, band.high_deg
    if low is None:
        return 0.0
    if high is None:
        return 0.0 if each.within else -2.0
    place = 2.0 * (each.value_deg - low) / (high - low) - 1.0
    return min(max(place, -_WIDEST), _WIDEST)


def _band(each: "Difference") -> str:
    if each.band is None:
        return "(no band)"
    ends = (each.band.low_deg, each.band.high_deg)
    known = [abs(end) for end in ends if end is not None]
    if not known:
        return "(no bound)"
    if len(known) == 2 and max(known) < 1e-3:
        return "(1e-6 rad)" if max(known) < 6e-5 else "(rounding)"
    low, high = ("…" if end is None else look.signed(round(end, 1) + 0.0, 1) for end in ends)
    return f"({low} to {high})"
