"""Effects of grousers on both margins and on theta_M, as text."""

from typing import TYPE_CHECKING

from kaidan.lab.calibration.text import quantity
from kaidan.tables import table

if TYPE_CHECKING:
    from kaidan.lab.calibration.answer import Effect, GrouserEffects, MarginShown

_HEADS = {
    "varied": "varied",
    "value": "value",
    "up": "up [deg]",
    "falls_up": "none, all lost",
    "down": "down [deg]",
    "falls_down": "none, all lost",
    "loss": "less than smooth, up",
    "M": "theta_M [deg]",
}


def text(found: "GrouserEffects") -> str:
    """A row for each kind of grousers, the smooth belt first."""
    smooth = found.effects[0]
    low, high = found.theta_M_printed_deg
    return "\n".join(
        [
            f"{found.robot}: theta_M at {1e3 * found.nosing_spacing_m:g} mm over the grousers; "
            f"{found.trials} trials a condition, seed {found.seed}",
            "",
            table([_row(each, smooth) for each in found.effects], _HEADS),
            "",
            "  Lost: fell, slid, or could not be placed. The text prints a theta_M of "
            f"{low:g} to {high:g} deg.",
            "  One robot of guessed mass and ends: what this model says, no measurement.",
        ]
    )


def _row(each: "Effect", smooth: "Effect") -> dict[str, str]:
    name = {"stiffness": "stiffness_N_m", "friction": "friction"}.get(each.varied, "length_m")
    both = (smooth.up.deviation_deg, each.up.deviation_deg)
    spread = None if None in both else sum(x**2 for x in both if x is not None) ** 0.5
    return {
        "varied": each.varied,
        "value": "-" if each.varied == "none" else quantity(name, each.value),
        "up": _plus_minus(each.up.value_deg, each.up.deviation_deg),
        "falls_up": _lost(each.up),
        "down": _plus_minus(each.down.value_deg, each.down.deviation_deg),
        "falls_down": _lost(each.down),
        "loss": "-" if each.varied == "none" else _plus_minus(each.loss_deg, spread),
        "M": _plus_minus(each.theta_M_deg, each.deviation_deg),
    }


def _plus_minus(value: float | None, deviation: float | None) -> str:
    return "-" if value is None or deviation is None else f"{value:.1f} +- {deviation:.1f}"


def _lost(margin: "MarginShown") -> str:
    ends = (margin.none_up_to_deg, margin.all_from_deg)
    return " ".join("-" if each is None else f"{each:g}" for each in ends)
