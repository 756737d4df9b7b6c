"""The search for a track that meets the whole text, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import fixed, table

if TYPE_CHECKING:
    from kaidan.lab.calibration.search import Candidate, GrouserSearch, Met, Row

_UNITS = {"_N_m": (1e-3, "kN/m"), "_m": (1e3, "mm")}


def text(found: "GrouserSearch") -> str:
    """What was left at each stage, the nearest tracks, and the table of the nearest."""
    lines = [
        f"{found.robot}: grousers on rubber, {found.trials} trials a condition, seed {found.seed}",
        f"  {found.drawn} tracks drawn; closed forms leave {found.by_closed_form}; {found.tried} "
        f"tried in dynamics; {found.screened} hold and fall about where the text has it at "
        "150, 200 and 220 mm",
        f"  {found.meeting} of these miss nothing that the text says by more than its interval "
        "(95 %)",
        "",
    ]
    if not found.nearest:
        return "\n".join(lines)
    rows = [
        {"what": name, "text": f"from {low:.1f}" if high is None else f"{low:.1f} to {high:.1f}",
         "miss": str(failing)}
        for (name, low, high), failing in zip(found.demands, found.failing, strict=True)
    ]  # fmt: skip
    for at, each in enumerate(found.nearest, 1):
        for row, one in zip(rows, each.figures, strict=True):
            row[str(at)] = _met(one)
    heads = {"what": "what", "text": "text [deg]", "miss": f"of {found.screened} miss it"}
    heads |= {str(at): f"nearest {at}" for at in range(1, len(found.nearest) + 1)}
    lines += [table(rows, heads), ""]
    lines += [f"  {at}: {_track(each)}" for at, each in enumerate(found.nearest, 1)]
    worst = found.nearest[0].worst
    lines += [
        "",
        f"  The nearest misses {worst.name} by {worst.miss_deg:+.1f} deg "
        f"({_within(worst)}); what it does at all spacings:",
        "",
        table([_row(each) for each in found.table], _HEADS),
    ]
    return "\n".join(lines)


_HEADS = {
    "p": "p [mm]",
    "formula": "(19)-(23)",
    "up": "up [deg]",
    "up_first": "none lost to",
    "down": "down [deg]",
    "down_first": "none lost to",
    "lean": "theta_d [deg]",
    "M": "theta_M [deg]",
}


def _row(each: "Row") -> dict[str, str]:
    gain = None
    if each.up_deg is not None and each.down_deg is not None:
        gain = each.down_deg - each.up_deg
    spread = ((each.up_deviation_deg or 0.0) ** 2 + (each.down_deviation_deg or 0.0) ** 2) ** 0.5
    return {
        "p": f"{1e3 * each.nosing_spacing_m:.0f}",
        "formula": fixed(each.formula_deg),
        "up": _interval(each.up_deg, each.up_deviation_deg),
        "up_first": fixed(each.up_first_deg),
        "down": _interval(each.down_deg, each.down_deviation_deg),
        "down_first": fixed(each.down_first_deg),
        "lean": fixed(each.theta_d_deg),
        "M": _interval(gain, spread),
    }


def _interval(value: float | None, deviation: float | None) -> str:
    """Value with its 95 % interval."""
    if value is None or deviation is None:
        return "-"
    return f"{value:.1f} ({value - 1.96 * deviation:.1f} to {value + 1.96 * deviation:.1f})"


def _met(one: "Met") -> str:
    missed = f", {one.miss_deg:+.1f}" if one.miss_deg else ""
    return f"{one.value_deg:.1f} +- {1.96 * one.deviation_deg:.1f}{missed}"


def _within(worst: "Met") -> str:
    half = 1.96 * worst.deviation_deg
    return f"95 %: {worst.miss_deg - half:+.1f} to {worst.miss_deg + half:+.1f}"


def _track(each: "Candidate") -> str:
    shown = []
    for name, value in each.values.items():
        if name == "treads":
            shown.append("steps" if value >= 0.5 else "bars")
            continue
        for ending, (factor, unit) in _UNITS.items():
            if name.endswith(ending):
                shown.append(f"{name.removesuffix(ending)} {factor * value:.3g} {unit}")
                break
        else:
            shown.append(f"{name} {value:.2g}")
    return ", ".join(shown).replace("_", " ")
