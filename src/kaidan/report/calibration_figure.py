"""Pictures of a calibration: what was fitted, what was predicted blind; effects of grousers."""

import math
from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import ScalarFormatter

from kaidan.calibration.effects import Effect
from kaidan.calibration.evidence import PAPER
from kaidan.calibration.fitting import WITHIN, Candidate
from kaidan.calibration.report import Calibration
from kaidan.report import look

_COLOURS = (look.BLACK, look.BLUE, look.VERMILION, look.GREEN, look.PURPLE, look.ORANGE, look.SKY)
_MARKS = ("o", "s", "^", "v", "D", "P", "X")
_UNITS = {"m": (1e3, "mm"), "N_m": (1e-3, "kN/m")}


def calibration_figure(found: Calibration) -> Figure:
    """Turn over the fitted stiffness, profile likelihoods, and blind predictions.

    Parameters
    ----------
    found : Calibration
        What `kaidan.calibration.report.calibrate` found.

    Returns
    -------
    Figure
    """
    with look.settings():
        figure = look.blank(3.5)
        turn = figure.add_axes((0.07, 0.20, 0.25, 0.60))
        profile = figure.add_axes((0.40, 0.20, 0.22, 0.60))
        blind = figure.add_axes((0.79, 0.20, 0.19, 0.60))
        _draw_turn(turn, found)
        _draw_profile(profile, found)
        _draw_blind(blind, found)
        look.title(
            figure,
            0.4,
            f"{look.named(found.robot)}, {found.fit.kind}: fitted to theta_d and the fall zone at "
            "150 mm",
            f"{len(found.fit.candidates)} candidates, {found.trials} trials a condition, seed "
            f"{found.seed}; right: the {len(found.blind)} likeliest against what the text prints",
        )
    return figure


def _names(found: Calibration) -> tuple[str, str]:
    first, second, *_ = found.fit.best.values
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
    told = name.removesuffix("_N_m").removesuffix("_m").replace("_", " ")
    axes.set_xlabel(f"{told} [{_unit(name)[1]}]")


def _draw_turn(axes: Axes, found: Calibration) -> None:
    first, second = _names(found)
    lines: dict[object, list[Candidate]] = {}
    on = found.fit.best.values.get("ground")
    for each in found.fit.candidates:
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
    turn = found.evidence.theta_d
    axes.axhspan(
        turn.extra - 2 * turn.uncertainty, turn.extra + 2 * turn.uncertainty, **look.fill("band")
    )
    axes.set_ylim(0.0, 8.0)
    _plain_log(axes, first)
    axes.set_ylabel("extra inclination [°]", labelpad=1.0)
    axes.set_title(f"at {turn.angle:.1f}°; band: the text's 2.6°", fontsize=look.SMALL)
    axes.legend(fontsize=6.0, frameon=False, loc="upper right", handlelength=1.6)


def _mean(each: Candidate) -> float:
    return float(np.mean(each.swings)) if each.swings else math.nan


def _draw_profile(axes: Axes, found: Calibration) -> None:
    first, _ = _names(found)
    judges: tuple[tuple[str, str, Callable[[Candidate], float]], ...] = (
        ("--", "theta_d alone", lambda each: each.log_turn),
        (":", "fall zone alone", lambda each: each.log_zone),
        ("-", "both", lambda each: each.log_likelihood),
    )
    for style, label, judge in judges:
        profile: dict[float, float] = {}
        for each in found.fit.candidates:
            x = float(each.values[first])
            profile[x] = max(profile.get(x, -math.inf), judge(each))
        places = sorted(profile)
        top = max(profile.values())
        axes.plot(
            [_scaled(first, x) for x in places],
            [profile[x] - top for x in places],
            color=look.BLACK if style == "-" else look.GREY,
            linestyle=style,
            marker="o",
            markersize=2.5,
            label=label,
        )
    axes.axhline(-WITHIN, color=look.VERMILION, linewidth=0.8)
    axes.set_ylim(-8.0, 0.5)
    _plain_log(axes, first)
    axes.set_ylabel("log profile likelihood", labelpad=1.0)
    axes.set_title("line: 95 % interval", fontsize=look.SMALL)
    axes.legend(fontsize=6.0, frameon=False, loc="lower left", borderaxespad=0.1)


def _draw_blind(axes: Axes, found: Calibration) -> None:
    if not found.blind:
        axes.set_axis_off()
        return
    shown = [k for k, each in enumerate(found.blind[0].predictions) if each.unit == "deg"]
    labels = []
    for row, k in enumerate(shown):
        y = len(shown) - 1.0 - row
        one = found.blind[0].predictions[k]
        low, high = max(one.low, -30.0), min(one.high, 30.0)
        axes.barh(y, high - low, 0.6, left=low, **look.fill("band"))
        for at, blind in enumerate(found.blind):
            each = blind.predictions[k]
            axes.plot(
                each.value, y + 0.2 - 0.4 * at / max(1, len(found.blind) - 1), linestyle="none",
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


def effects_figure(found: Sequence[Effect]) -> Figure:
    """theta_M and both margins over height, spacing and stiffness of the grousers.

    Parameters
    ----------
    found : sequence of Effect
        What `kaidan.calibration.effects.effects` found.

    Returns
    -------
    Figure
    """
    panels = [
        ("height", 1e3, "height [mm]"),
        ("spacing", 1e3, "spacing [mm]"),
        ("stiffness", 1e-3, "stiffness [kN/m]"),
    ]
    smooth = next((each for each in found if each.varied == "none"), None)
    with look.settings():
        figure = look.blank(4.4)
        for column, (name, scale, label) in enumerate(panels):
            own = sorted((each for each in found if each.varied == name), key=lambda e: e.value)
            x = [scale * each.value for each in own]
            left = 0.08 + 0.315 * column
            margins = figure.add_axes((left, 0.52, 0.26, 0.33))
            lost = figure.add_axes((left, 0.11, 0.26, 0.33))
            for part, marker, colour in (("up", "^", look.VERMILION), ("down", "v", look.BLUE)):
                of = [getattr(each, part) for each in own]
                margins.errorbar(
                    x, [each.value for each in of], [2 * each.deviation for each in of],
                    marker=marker, color=colour, markersize=4, linewidth=1.0, capsize=2,
                    label={"up": "ascending", "down": "descending"}[part],
                )  # fmt: skip
                if smooth is not None:
                    margins.axhline(
                        getattr(smooth, part).value, color=colour, linewidth=0.8, linestyle=":"
                    )
            lost.axhspan(*PAPER.theta_M, **look.fill("band"))
            lost.errorbar(
                x, [each.theta_M for each in own], [2 * each.deviation for each in own],
                marker="o", color=look.BLACK, markersize=4, linewidth=1.0, capsize=2,
            )  # fmt: skip
            if smooth is not None:
                lost.axhline(smooth.theta_M, color=look.GREY, linewidth=0.8, linestyle=":")
            for axes in (margins, lost):
                if name == "stiffness" and x:
                    axes.set_xlim(0.6 * min(x), 1.7 * max(x))
                    axes.set_xscale("log")
                    axes.xaxis.set_major_formatter(ScalarFormatter())
                axes.tick_params(labelsize=7.0)
            lost.set_xlabel(label)
            lost.set_ylim(bottom=0.0)
            if column == 0:
                margins.set_ylabel("margin [°]")
                lost.set_ylabel("$\\theta_M$ [°]")
                margins.legend(fontsize=6.5, frameon=False)
        look.title(
            figure,
            0.5,
            "Effects of the grousers on the margins and on theta_M, as MuJoCo has them",
            "bars: two standard deviations (counts, grid); dotted: smooth belt; grey: the text's "
            "1.2 to 2.6°",
        )
    return figure
