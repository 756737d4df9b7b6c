"""A fit to the paper's text and its judgement, as text."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.lab.calibration.answer import Calibration, IntervalShown, PredictionShown

_HEADS = {
    "name": "fitted",
    "best": "likeliest",
    "both": "95 % profile interval",
    "theta_d": "from theta_d alone",
    "zone": "from the fall zone alone",
}


def text(found: "Calibration") -> str:
    """Intervals, what the likeliest reproduces, and predictions over all that were judged."""
    lines = [
        f"{found.robot}, {found.kind}: {len(found.candidates)} candidates, "
        f"{found.trials} trials a condition, seed {found.seed}",
        "  Fitted to theta_d and the fall zone at 150 mm alone; all other figures are blind.",
        "",
        table(
            [
                {
                    "name": parameter(both.name),
                    "best": quantity(both.name, both.best),
                    "both": _interval(both),
                    "theta_d": _interval(theta_d),
                    "zone": _interval(zone),
                }
                for both, theta_d, zone in zip(
                    found.intervals, found.from_theta_d_alone, found.from_zone_alone, strict=True
                )
            ],
            _HEADS,
        ),
        "",
        "  The likeliest: " + ", ".join(quantity(*each) for each in found.best.items()),
    ]
    lines += [f"  {'yes' if line.reproduced else 'NO ':<4} {line.text}" for line in found.lines]
    if found.blind[1:]:
        lines += ["", f"  Blind, over the {len(found.blind)} likeliest:"]
        lines += [f"       {each}" for each in _ranges(found)]
    lost = "; ".join(each.partition(" (")[0] for each in found.not_reproduced)
    lines += ["", f"  Not reproduced: {lost}." if lost else "  All of it is reproduced."]
    return "\n".join(lines)


def _ranges(found: "Calibration") -> Iterator[str]:
    """Each prediction over all candidates that were judged."""
    for each in zip(*(blind.predictions for blind in found.blind), strict=True):
        values = [one.value for one in each if one.value is not None]
        good = sum(one.reproduced for one in each)
        unit = " deg" if each[0].unit == "deg" else ""
        span = f"{min(values):.1f} to {max(values):.1f}{unit}" if values else "not found"
        yield f"{each[0].text}: {span}; reproduced by {good} of {len(each)}"


def _interval(each: "IntervalShown") -> str:
    if isinstance(each.low, str):
        return " or ".join(map(str, each.kept))
    span = quantity(each.name, each.low)
    if each.low != each.high:
        span += f" to {quantity(each.name, each.high)}"
    return f"{span} (end of the grid)" if each.at_edge else span


def parameter(name: str) -> str:
    """Name of a parameter, its unit left off."""
    return name.removesuffix("_N_m").removesuffix("_m").replace("_", " ")


def quantity(name: str, value: float | str) -> str:
    """Value of a parameter with its unit."""
    if isinstance(value, str):
        return value
    if name.endswith("_m") and not name.endswith("_N_m"):
        return f"{1e3 * value:g} mm"
    return f"{value / 1e3:g} kN/m" if name.endswith("_N_m") else f"{value:g}"


def zone(
    p_mm: float, counts: Sequence[tuple[float, tuple[int, int]]], probability: float, best: float
) -> str:
    """Fall zone beside the simulated falls.

    p_mm: nosing spacing [mm].
    counts: at each slope [deg].
    """
    found = ", ".join(f"{falls} of {trials} at {angle:.1f}" for angle, (falls, trials) in counts)
    return (
        f"falls at {p_mm:.0f} mm {found} deg (text: none, some, all); probability "
        f"{probability:.2g}, at best {best:.2g}"
    )


def theta_d(extras: Sequence[float], measured: float, uncertainty: float) -> str:
    """Simulated theta_d beside the measured one [deg]."""
    found = f"{sum(extras) / len(extras):.1f}" if extras else "none"
    return f"theta_d {found} deg (text: {measured:.1f}, taken as +-{uncertainty:g})"


def prediction(each: "PredictionShown") -> str:
    """Prediction beside what the text prints: "theta_M at 150 mm 6.0 deg (text: 1.2 to 2.6)"."""
    unit = " deg" if each.unit == "deg" else ""
    form = ".1f" if each.unit == "deg" else ".0f"
    if each.high is None:
        printed = f"{each.low:{form}} or more"
    elif each.low == each.high:
        printed = f"{each.low:{form}}"
    else:
        printed = f"{each.low:{form}} to {each.high:{form}}"
    beside = f"taken as {each.assumption}" if each.assumption else f"text: {printed}"
    if each.value is None or each.off is None:
        return f"{each.text} not found on the grid of slopes ({beside})"
    away = ""
    if each.off:
        away = f", {abs(each.off):{form}} too {'large' if each.off > 0 else 'small'}"
    return f"{each.text} {each.value:{form}}{unit} ({beside}){away}"
