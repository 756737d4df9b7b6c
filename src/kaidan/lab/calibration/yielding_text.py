"""A yielding track fitted to the paper's text, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.lab.calibration.yielding import (
        ParameterShown,
        Predicted,
        YieldingCalibration,
    )

_SCALES = {"stiffness_N_m": (1e-3, "kN/m"), "end_radius_m": (1e3, "mm")}


def text(found: "YieldingCalibration") -> str:
    """What is fixed and what is not, then every figure of the text beside its interval."""
    least = min(each.coverage for each in found.emulators)
    most = max(each.coverage for each in found.emulators)
    return "\n".join(
        [
            f"{found.robot}, yielding track: {found.points} points, {found.trials} trials a "
            f"condition, seed {found.seed}",
            "",
            table([_parameter(each) for each in found.parameters],
                  {"name": "parameter", "tried": "tried", "found": "median (95 %)",
                   "fixed": "fixed by the evidence"}),
            "",
            f"  Correlation of log k with log kt/k: {found.correlation_k_ratio:+.2f}. Treads or "
            f"nosings alone: {100 * found.treads:.0f} to {100 - 100 * found.treads:.0f}.",
            "",
            table([_prediction(each) for each in found.predictions],
                  {"text": "figure", "used": "used for", "printed": "text [deg]",
                   "found": "median (95 %) [deg]", "share": "agree"}),
            "",
            f"  {100 * found.all_blind:.0f} % of the draws agree with all blind figures at once.",
            f"  Emulators: {100 * least:.0f} to {100 * most:.0f} % of the points within the 95 % "
            "intervals predicted from all others.",
            f"  Sampler: {100 * found.acceptance:.0f} % taken, autocorrelation "
            f"{found.autocorrelation_steps:.0f} steps.",
        ]
    )  # fmt: skip


def _value(name: str, value: float) -> str:
    scale, unit = _SCALES.get(name, (1.0, ""))
    return f"{scale * value:.3g} {unit}".rstrip()


def _parameter(each: "ParameterShown") -> dict[str, str]:
    name, one = each.name, each.interval
    return {
        "name": each.text,
        "tried": f"{_value(name, each.tried[0])} to {_value(name, each.tried[1])}",
        "found": f"{_value(name, one.median)} ({_value(name, one.low)} to "
                 f"{_value(name, one.high)})",
        "fixed": f"{'yes' if each.identified else 'no'}: {100 * each.share_of_range:.0f} % of the "
                 "range",
    }  # fmt: skip


def _prediction(each: "Predicted") -> dict[str, str]:
    low, high = each.printed
    if low is not None and high is not None:
        printed = f"{low:g} to {high:g}"
    else:
        printed = f"{low:g} or more" if low is not None else f"{high:g} or less"
    one = each.interval
    return {
        "text": each.text,
        "used": "fit" if each.fitted else "blind",
        "printed": printed,
        "found": f"{one.median:.1f} ({one.low:.1f} to {one.high:.1f})",
        "share": f"{100 * each.probability:.0f} %",
    }
