"""Pictures of a calibration: what was fitted, what was predicted blind; effects of grousers."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import ScalarFormatter

from kaidan.figures import style as look
from kaidan.lab.calibration.text import parameter

if TYPE_CHECKING:
    from kaidan.lab.calibration.answer import Calibration, CandidateShown, GrouserEffects

_COLOURS = (look.BLACK, look.BLUE, look.VERMILION, look.GREEN, look.PURPLE, look.ORANGE, look.SKY)
_MARKS = ("o", "s", "^", "v", "D", "P", "X")
_UNITS = {"m": (1e3, "mm"), "N_m": (1e-3, "kN/m")}


def calibration_figure(found: "Calibration") -> Figure:
    """Extra inclination over the fitted stiffness, profile likelihoods, blind predictions.

    found: what `kaidan.lab.calibration.report.calibrate` found.
    """
    with look.settings():
        figure = look.blank(3.5)
        extra = figure.add_axes((0.07, 0.20, 0.25, 0.60))
        profile = figure.add_axes((0.40, 0.20, 0.22, 0.60))
        blind = figure.add_axes((0.79, 0.20, 0.19, 0.60))
        _draw_extra(extra, found)
        _draw_profile(profile, found)
        _draw_blind(blind, found)
        look.title(
            figure,
            0.4,
            f"{look.named(found.robot)}, {found.kind}: fitted to theta_d and the fall zone at "
            "150 mm",
            f"{len(found.candidates)} candidates, {found.trials} trials a condition, seed "
            f"{found.seed}; right: the {len(found.blind)} likeliest against what the text prints",
        )
    return figure


def _names(found: "Calibration") -> tuple[str, str]:
    first, second, *_ = found.best
    return first, second


def _scaled(name: str, value: float) -> float:
    return value * _unit(name)[0]


def _unit(name: str) -> tuple[float, str]:
    return _UNITS["N_m" if name.endswith("_N_m") else "m"]


def _plain_log(axes: Axes, name: str) -> None:
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.xaxis.set_minor_formatter("")
    axes.set_xticks([10, 30, 100, 300] if name.endswith("_N_m") else [5, 10, 20])
    axes.set_xlabel(f"{parameter(name)} [{_unit(name)[1]}]")


def _draw_extra(axes: Axes, found: "Calibration") -> None:
    first, second = _names(found)
    lines: dict[object, list[CandidateShown]] = {}
    on = found.best.get("ground")
    for each in found.candidates:
        if each.values.get("ground") == on:
            lines.setdefault(each.values[second], []).append(each)
    for at, (value, line) in enumerate(lines.items()):
        assert isinstance(value, float)
        points = sorted((float(each.values[first]), _mean(each)) for each in line)
        axes.plot(
            [_scaled(first, x) for x, _ in points],
            [y for _, y in points],
            color=_COLOURS[at % len(_COLOURS)],
            marker=_MARKS[at % len(_MARKS)],
            markersize=3.5,
            linewidth=0.9,
            label=f"{_scaled(second, value):g} {_unit(second)[1]}",
        )
    measured = found.evidence.theta_d
    room = 2 * measured.uncertainty
    axes.axhspan(measured.extra - room, measured.extra + room, **look.fill("band"))
    axes.set_ylim(0.0, 8.0)
    _plain_log(axes, first)
    axes.set_ylabel("extra inclination [°]", labelpad=1.0)
    heading = f"at {measured.angle:.1f}°; band: the text's {measured.extra:.1f}°"
    axes.set_title(heading, fontsize=look.SMALL)
    axes.legend(fontsize=6.0, frameon=False, loc="upper right", handlelength=1.6)


def _mean(each: "CandidateShown") -> float:
    return math.nan if each.theta_d_deg is None else each.theta_d_deg


_PROFILES = {"theta_d": ("--", "theta_d alone"), "fall zone": (":", "fall zone alone"),
             "both": ("-", "both")}  # fmt: skip


def _draw_profile(axes: Axes, found: "Calibration") -> None:
    first, _ = _names(found)
    for profile in found.profiles:
        style, label = _PROFILES[profile.evidence]
        axes.plot(
            [_scaled(first, x) for x in profile.values],
            np.array(profile.log_likelihood, dtype=np.float64),
            color=look.BLACK if style == "-" else look.GREY,
            linestyle=style,
            marker="o",
            markersize=2.5,
            label=label,
        )
    axes.axhline(-found.within, color=look.VERMILION, linewidth=0.8)
    axes.set_ylim(-8.0, 0.5)
    _plain_log(axes, first)
    axes.set_ylabel("log profile likelihood", labelpad=1.0)
    axes.set_title("line: 95 % interval", fontsize=look.SMALL)
    axes.legend(
        fontsize=6.0, loc="lower left", borderaxespad=0.3, facecolor="white", edgecolor="none",
        framealpha=0.85,
    )  # fmt: skip


def _draw_blind(axes: Axes, found: "Calibration") -> None:
    if not found.blind:
        axes.set_axis_off()
        return
    shown = [k for k, each in enumerate(found.blind[0].predictions) if each.unit == "deg"]
    labels = []
    for row, k in enumerate(shown):
        y = len(shown) - 1.0 - row
        one = found.blind[0].predictions[k]
        low, high = max(one.low, -30.0), 30.0 if one.high is None else min(one.high, 30.0)
        axes.barh(y, high - low, 0.6, left=low, **look.fill("band"))
        for at, blind in enumerate(found.blind):
            each = blind.predictions[k]
            axes.plot(
                math.nan if each.value is None else each.value,
                y + 0.2 - 0.4 * at / max(1, len(found.blind) - 1), linestyle="none",
                marker="o" if each.reproduced else "X", markersize=4,
                color=look.BLACK if each.reproduced else look.VERMILION,
                markerfacecolor="none" if at else None,
            )  # fmt: skip
        labels.append(one.text.replace(" at ", "\nat "))
    axes.set_yticks([len(shown) - 1.0 - row for row in range(len(shown))], labels, fontsize=6.5)
    axes.set_xlim(-4.0, 26.0)
    axes.set_ylim(-0.6, len(shown) - 0.4)
    axes.set_xlabel("[°]")
    axes.set_title("blind; bands: the text", fontsize=look.SMALL)


def effects_figure(found: "GrouserEffects") -> Figure:
    """theta_M and both margins over height, spacing, stiffness and friction of the grousers.

    found: what `kaidan.lab.calibration.effects.effects` found.
    """
    panels = [
        ("height", 1e3, "height [mm]"),
        ("spacing", 1e3, "spacing [mm]"),
        ("stiffness", 1e-3, "stiffness [kN/m]"),
        ("friction", 1.0, "friction"),
    ]
    low, high = found.theta_M_printed_deg
    with look.settings():
        figure = look.blank(4.4)
        for column, (name, scale, label) in enumerate(panels):
            left = 0.08 + 0.235 * column
            margins = figure.add_axes((left, 0.52, 0.19, 0.33))
            gain = figure.add_axes((left, 0.11, 0.19, 0.33))
            x = _draw_panel(margins, gain, found, name, scale)
            for axes in (margins, gain):
                if name == "stiffness" and x:
                    axes.set_xlim(0.6 * min(x), 1.7 * max(x))
                    axes.set_xscale("log")
                    axes.xaxis.set_major_formatter(ScalarFormatter())
                axes.tick_params(labelsize=7.0)
            gain.set_xlabel(label)
            gain.set_ylim(bottom=0.0)
            if column == 0:
                margins.set_ylabel("margin [°]")
                gain.set_ylabel("$\\theta_M$ [°]")
                margins.legend(fontsize=6.5, frameon=False)
        look.title(
            figure,
            0.5,
            "Effects of grousers on rubber on the margins and on theta_M",
            "bars: two standard deviations (counts, grid); dotted: smooth belt; grey: the text's "
            f"{low:g} to {high:g}°",
        )
    return figure


def _draw_panel(
    margins: Axes, gain: Axes, found: "GrouserEffects", name: str, scale: float
) -> list[float]:
    """Both margins and theta_M over one figure of the grousers; its values."""
    own = sorted((each for each in found.effects if each.varied == name), key=lambda e: e.value)
    smooth = next((each for each in found.effects if each.varied == "none"), None)
    x = [scale * each.value for each in own]
    for part, marker, colour, label in (
        ("up", "^", look.VERMILION, "ascending"),
        ("down", "v", look.BLUE, "descending"),
    ):
        of = [getattr(each, part) for each in own]
        _bars(margins, x, [each.value_deg for each in of], [each.deviation_deg for each in of],
              marker=marker, color=colour, label=label)  # fmt: skip
        level = None if smooth is None else getattr(smooth, part).value_deg
        if level is not None:
            margins.axhline(level, color=colour, linewidth=0.8, linestyle=":")
    gain.axhspan(*found.theta_M_printed_deg, **look.fill("band"))
    _bars(gain, x, [each.theta_M_deg for each in own], [each.deviation_deg for each in own],
          marker="o", color=look.BLACK)  # fmt: skip
    if smooth is not None and smooth.theta_M_deg is not None:
        gain.axhline(smooth.theta_M_deg, color=look.GREY, linewidth=0.8, linestyle=":")
    return x


def _bars(
    axes: Axes,
    x: Sequence[float],
    values: Sequence[float | None],
    deviations: Sequence[float | None],
    **style: str,
) -> None:
    """Values with bars of two standard deviations; nothing where there is no value."""
    y, spread = (np.array(column, dtype=np.float64) for column in (values, deviations))
    axes.errorbar(x, y, 2 * spread, markersize=4, linewidth=1.0, capsize=2, **style)  # type: ignore[arg-type]
