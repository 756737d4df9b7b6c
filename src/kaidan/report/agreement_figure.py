"""Picture of an agreement: every model's steepest flight, and each difference on its band."""

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from kaidan.agreement import Agreement, Difference
from kaidan.agreement.answer import MODELS
from kaidan.report import look

_MARKS = {
    "closed_form": ("s", look.BLACK),
    "no_rotation": ("x", look.VERMILION),
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


def agreement_figure(found: Agreement) -> Figure:
    """Steepest flights on a scale of slope, and differences in units of their bands.

    Parameters
    ----------
    found : Agreement
        What `kaidan.agreement.agree` found.

    Returns
    -------
    Figure
    """
    shown = [each for each in found.differences if each.value is not None]
    with look.settings():
        figure = look.blank(2.75 + 0.26 * len(shown))
        height = figure.get_size_inches()[1]
        limits = figure.add_axes((0.20, 1 - 1.35 / height, 0.77, 0.55 / height))
        rows = figure.add_axes((0.38, 0.75 / height, 0.42, (0.26 * len(shown) + 0.1) / height))
        _draw_limits(limits, found)
        _draw_differences(rows, shown)
        case = found.case
        look.title(
            figure,
            0.2,
            f"{look.named(case.robot.name)} on {look.named(case.stairs.name)}, {case.direction} "
            f"{case.facing.replace('-', ' ')}: {'agree' if found.agrees else 'differ'}",
            f"closed form, contact model and MuJoCo (smooth belt, {found.speed:g} m/s, "
            f"to {found.resolution:g}°)",
        )
    return figure


def _draw_limits(axes: Axes, found: Agreement) -> None:
    question = found.questions[0]
    handles = []
    values = [math.degrees(found.case.stairs.angle)]
    for model, (marker, colour) in _MARKS.items():
        value = question.answers[model]
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


def _draw_differences(axes: Axes, shown: Sequence[Difference]) -> None:
    """Each difference between the ends of its band, which lie at -1 and 1."""
    labels = []
    for row, each in enumerate(shown):
        assert each.value is not None
        y = len(shown) - 1.0 - row
        labels.append(f"{NAMES[each.question]}:\n{MODELS[each.of]} less {MODELS[each.less]}")
        low, high = (-1.0, 1.0) if each.band else (0.0, 0.0)
        if each.band and math.isinf(each.band.low):
            low = -_WIDEST
        if each.band and math.isinf(each.band.high):
            high = _WIDEST
        axes.barh(y, high - low, 0.62, left=low, **look.fill("band"))
        place = place_on_band(each)
        axes.plot(
            place, y, marker="o" if each.within else "X", markersize=6, zorder=4, clip_on=False,
            color=look.BLACK if each.within else look.VERMILION,
        )  # fmt: skip
        axes.text(
            1.03, y, f"{look.signed(round(each.value, 2) + 0.0)}° {_band(each)}", va="center",
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


def place_on_band(each: Difference) -> float:
    """Where a difference lies, its band's ends at -1 and 1; open ends have no scale."""
    assert each.value is not None
    band = each.band
    if band is None:
        return math.copysign(_WIDEST, each.value)
    low, high = band.low, band.high
    if math.isinf(low) and math.isinf(high):
        return 0.0
    if math.isinf(high):
        return 0.0 if each.within else -2.0
    place = 2.0 * (each.value - low) / (high - low) - 1.0
    return min(max(place, -_WIDEST), _WIDEST)


def _band(each: Difference) -> str:
    if each.band is None:
        return "(no band)"
    ends = (each.band.low, each.band.high)
    if all(map(math.isinf, ends)):
        return "(no bound)"
    if max(map(abs, ends)) < 1e-3:
        return "(1e-6 rad)" if max(map(abs, ends)) < 6e-5 else "(rounding)"
    low, high = ("…" if math.isinf(end) else look.signed(round(end, 1) + 0.0, 1) for end in ends)
    return f"({low} to {high})"
