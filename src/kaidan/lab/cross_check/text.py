"""Three models on the same questions, as text: answers, differences, their bands and causes."""

from typing import TYPE_CHECKING

from kaidan.tables import fixed, table
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.lab.cross_check.answer import Agreement, Difference, Value
    from kaidan.lab.cross_check.bands import Band

MODELS = {
    "closed_form": "closed form",
    "static_criterion": "contact, static criterion",
    "contact": "contact, arrested",
    "physics": "physics",
}
"""The models by what people call them."""
_SHORT = {"steepest_flight": "flight", "extra": "inclination"}
_UNITS = {"deg": " [deg]", "1": "", "": ""}
_WITHIN = {None: "-", True: "yes", False: "NO"}


def text(found: "Agreement") -> str:
    """Verdict, answers of all models, differences on their bands, and the reasons."""
    lines = [
        f"{'AGREE' if found.agrees else 'DIFFER'}  {subject(found.question)}",
        f"  Trials: smooth belt, {found.speed_m_s:g} m/s, friction {found.friction:g}, from the "
        f"{found.begin}; {found.trials} of them, to {found.resolution_deg:g} deg; MuJoCo "
        f"{found.versions['mujoco']}.",
        "",
        table(
            [
                {
                    "compared": f"{each.text}{_UNITS[each.unit]}",
                    **{str(model): _answer(value) for model, value in each.answers.items()},
                }
                for each in found.comparisons
            ],
            {"compared": "compared", **MODELS},
        ),
        "",
        table(
            [_row(each, str(number)) for number, each in enumerate(found.differences, start=1)],
            {
                "number": "",
                "what": "difference",
                "value": "[deg]",
                "band": "expected",
                "within": "within",
            },
        ),
        "",
    ]
    reasons: dict[str, list[int]] = {}
    for number, each in enumerate(found.differences, start=1):
        why = each.cause or (each.band.reason if each.band is not None else "")
        if why:
            reasons.setdefault(why, []).append(number)
    lines += [f"  {', '.join(map(str, numbers))}: {why}." for why, numbers in reasons.items()]
    return "\n".join(lines)


def _answer(value: "Value") -> str:
    return value if isinstance(value, str) else fixed(value, 2)


def _row(each: "Difference", number: str) -> dict[str, str]:
    name = _SHORT.get(each.comparison, each.comparison)
    return {
        "number": number,
        "what": f"{name}: {MODELS[each.of]} less {MODELS[each.less]}",
        "value": fixed(each.value_deg, 2, "+"),
        "band": "the same" if each.comparison == "stairs" else _band(each.band),
        "within": _WITHIN[each.within],
    }


def _band(band: "Band | None") -> str:
    if band is None:
        return "-"
    low, high = band.low_deg, band.high_deg
    if low is None:
        return "anything"
    if high is None:
        return f"{low:+.2f} or more"
    return f"+-{high:.0e}" if max(abs(low), abs(high)) < 1e-3 else f"{low:+.2f} to {high:+.2f}"
