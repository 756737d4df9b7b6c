"""Pages of ``kaidan calibrate``: what was fitted and predicted, effects of grousers."""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from kaidan.cli.tables import echo, echo_table

if TYPE_CHECKING:
    from kaidan.calibration.effects import Effect
    from kaidan.calibration.fitting import Interval
    from kaidan.calibration.report import Calibration


def _value(name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    if name.endswith("_m") and not name.endswith("_N_m"):
        return f"{1e3 * value:g} mm"
    return f"{value / 1e3:g} kN/m"


def show_calibration(found: "Calibration") -> None:
    """Print a fit and its judgement."""
    best = found.fit.best
    echo(
        f"{found.robot}, {found.fit.kind}: {len(found.fit.candidates)} candidates, "
        f"{found.trials} trials a condition, seed {found.seed}"
    )
    echo("  Fitted to theta_d and the fall zone at 150 mm alone; all other figures are blind.")
    echo("")
    echo_table(
        [
            {
                "name": _name(each.name),
                "best": _value(each.name, each.best),
                "both": _interval(each),
                "turn": _interval(turn),
                "zone": _interval(zone),
            }
            for each, turn, zone in zip(
                found.fit.intervals, found.from_turn, found.from_zone, strict=True
            )
        ],
        {
            "name": "fitted",
            "best": "likeliest",
            "both": "95 % profile interval",
            "turn": "from theta_d alone",
            "zone": "from the fall zone alone",
        },
    )
    echo("")
    echo("  The likeliest: " + ", ".join(_value(*each) for each in best.values.items()))
    for text, good in found.lines:
        echo(f"  {'yes' if good else 'NO ':<4} {text}")
    if found.blind[1:]:
        echo("")
        echo(f"  Blind, over the {len(found.blind)} likeliest:")
        for text in _ranges(found):
            echo(f"       {text}")
    echo("")
    lost = found.not_reproduced
    told = "; ".join(text.partition(" (")[0] for text in lost)
    echo(f"  Not reproduced: {told}." if lost else "  All of it is reproduced.")


def _ranges(found: "Calibration") -> Iterator[str]:
    """Each prediction over all candidates that were judged."""
    for each in zip(*(blind.predictions for blind in found.blind), strict=True):
        values = [one.value for one in each if math.isfinite(one.value)]
        good = sum(one.reproduced for one in each)
        unit = " deg" if each[0].unit == "deg" else ""
        span = f"{min(values):.1f} to {max(values):.1f}{unit}" if values else "not found"
        yield f"{each[0].text}: {span}; reproduced by {good} of {len(each)}"


def _name(name: str) -> str:
    return name.removesuffix("_N_m").removesuffix("_m").replace("_", " ")


def _interval(each: "Interval") -> str:
    if isinstance(each.low, str):
        return " or ".join(map(str, each.kept))
    if each.low == each.high:
        told = _value(each.name, each.low)
    else:
        told = f"{_value(each.name, each.low)} to {_value(each.name, each.high)}"
    return f"{told} (end of the grid)" if each.at_edge else told


def show_effects(robot: str, found: "Sequence[Effect]", seed: int, trials: int) -> None:
    """Print theta_M over the grousers."""
    spacing = 1e3 * found[0].up.nosing_spacing
    echo(
        f"{robot}: theta_M at {spacing:g} mm over the grousers; {trials} trials a condition, "
        f"seed {seed}"
    )
    echo("")
    echo_table(
        [
            {
                "varied": each.varied,
                "value": "-" if each.varied == "none" else _value(
                    "stiffness_N_m" if each.varied == "stiffness" else "length_m", each.value
                ),
                "up": _plus_minus(each.up.value, each.up.deviation),
                "falls_up": _zone(each.up.none_up_to, each.up.all_from),
                "down": _plus_minus(each.down.value, each.down.deviation),
                "falls_down": _zone(each.down.none_up_to, each.down.all_from),
                "loss": _plus_minus(found[0].up.value - each.up.value, float(
                    (found[0].up.deviation**2 + each.up.deviation**2) ** 0.5
                )) if each.varied != "none" else "-",
                "M": _plus_minus(each.theta_M, each.deviation),
            }
            for each in found
        ],
        {
            "varied": "varied",
            "value": "value",
            "up": "up [deg]",
            "falls_up": "none, all lost",
            "down": "down [deg]",
            "falls_down": "none, all lost",
            "loss": "less than smooth, up",
            "M": "theta_M [deg]",
        },
    )  # fmt: skip
    echo("")
    echo("  Lost: fell, slid, or could not be placed. The text prints a theta_M of 1.2 to 2.6 deg.")
    echo("  One robot of guessed mass and ends: what this model says, no measurement.")


def _plus_minus(value: float, deviation: float) -> str:
    return "-" if math.isnan(value) else f"{value:.1f} +- {deviation:.1f}"


def _zone(low: float, high: float) -> str:
    return " ".join("-" if math.isnan(each) else f"{each:g}" for each in (low, high))
