"""The virtual verification test, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import fixed, table

if TYPE_CHECKING:
    from kaidan.lab.verification.counts import Count, Range
    from kaidan.lab.verification.verification import Spacing, Verification

_SAID = {
    "stated": (),
    "sheet": ("  The track yields as the robot's sheet says.",),
    "fit": (
        "  The track is the one fitted to the paper's text (kaidan lab calibrate yielding), for "
        "want of figures of its own (kaidan lab calibrate RIG.toml); --track names another.",
    ),
}
_HEADS = {
    "p": "p [mm]",
    "closed": "closed form [deg]",
    "contact": "contact [deg]",
    "climbed": "all climbed up to",
    "fell": "all fell from",
    "onset": "first lost up, down",
    "mean": "mean up, down",
    "d": "theta_d",
    "M": "theta_M",
    "corrected": "Eq. (24)",
}


def text(found: "Verification") -> str:
    """Margins of each spacing, and every condition by its symbol."""
    number = sum(len(count.lost_of_trial) for count in found.counts)
    lines = [
        f"{found.robot}: {number} trials; {found.track}, {found.speed_m_s:g} m/s, friction "
        f"{found.friction:g}, {found.nosings} nosings a trial, seed {found.seed}",
        *_SAID[found.track_from],
        f"  {found.version}",
        "",
        table([_row(each) for each in found.spacings], _HEADS),
        "",
    ]
    for each in found.spacings:
        for name, counts in (("up", each.up), ("down", each.down)):
            if counts:
                shown = "  ".join(f"{count.angle_deg:g}:{_symbol(count)}" for count in counts)
                lines.append(f"  {1e3 * each.nosing_spacing_m:g} mm {name:<5} {shown}")
    lines += [
        "",
        "  o climbed every time, x fell every time, a number: fell so often; + fell before the "
        "track moved; ? did neither",
    ]
    others = {outcome for count in found.counts for outcome in count.others}
    if others:
        lines.append(f"  ? stands for: {', '.join(sorted(others))}")
    return "\n".join(lines)


def _row(each: "Spacing") -> dict[str, str]:
    return {
        "p": f"{1e3 * each.nosing_spacing_m:g}",
        "closed": fixed(each.closed_form_deg),
        "contact": fixed(each.contact_deg),
        "climbed": fixed(each.climbed_up_to_deg),
        "fell": fixed(each.fell_from_deg),
        "onset": f"{_middle(each.onset_deg)}, {_middle(each.descent_onset_deg)}",
        "mean": f"{_middle(each.margin_deg)}, {_middle(each.descent_margin_deg)}",
        "d": _range(each.theta_d_deg),
        "M": _range(each.theta_M_deg),
        "corrected": _range(each.corrected_deg),
    }


def _symbol(count: "Count") -> str:
    if count.symbol == "plus":
        return f"{count.fell_at_start}+"
    if count.symbol == "square":
        return f"{sum(count.others.values())}?"
    return {"circle": "o", "cross": "x"}.get(count.symbol, str(count.fell))


def _middle(value: "Range | None") -> str:
    return "-" if value is None else f"{value.mean:.1f}"


def _range(value: "Range | None") -> str:
    return "-" if value is None else f"{value.mean:.1f} ({value.low:.1f} to {value.high:.1f})"
