"""What was measured of stairs, with its doubt."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.verbs.measure_stairs import StairsMeasurement


def text(found: "StairsMeasurement") -> str:
    """Figures with their doubt."""
    mm = 1e3
    lines = [
        f"{found.name}, measured",
        _row("steps", f"{found.risers} risers, rise {mm * found.rise_m:.1f} mm, going "
             f"{mm * found.going_m:.1f} mm{_odd(found)}"),
        _row("slope", f"{found.angle_deg:.2f} deg, {mm * found.nosing_spacing_m:.1f} mm from "
             "nosing to nosing"),
        _row("totals", f"+- {found.angle_of_totals_deg:.2f} deg, "
             f"+- {mm * found.nosing_spacing_of_totals_m:.1f} mm from nosing to nosing"),
        _row("one step", f"rise +- {mm * found.rise_spread_m:.1f} mm ({found.rise_spread_from}), "
             f"going +- {mm * found.going_spread_m:.1f} mm ({found.going_spread_from}): "
             f"+- {found.angle_of_a_step_deg:.2f} deg"),
    ]  # fmt: skip
    if found.landings:
        stated = (
            f"{key} {value if isinstance(value, str) else f'{mm * value:.0f} mm'}"
            for key, value in found.landings.items()
        )
        lines.append(_row("landings", ", ".join(stated)))
    return "\n".join([*lines, *(f"  {note}" for note in found.notes)])


def sources(found: "StairsMeasurement") -> dict[str, str]:
    """Where each figure of the sheet comes from, with its status letter."""
    tool = "(kaidan measure stairs)"
    total = f"V: measured, total over {found.risers} risers {tool}"
    doubt = f"V: measured, of the totals {tool}"
    odd = {"first_rise": found.first_rise_m, "last_rise": found.last_rise_m}
    return {
        "rise": total,
        "going": total,
        "steps": f"V: counted {tool}",
        **{key: f"V: measured by tape {tool}" for key, value in odd.items() if value is not None},
        **{
            key: f"V: {'seen' if isinstance(value, str) else 'measured by tape'} {tool}"
            for key, value in found.landings.items()
        },
        "uncertainty.angle": doubt,
        "uncertainty.nosing_spacing": doubt,
        "uncertainty.rise": f"V: single rises, {found.rise_spread_from} {tool}",
        "uncertainty.going": f"V: single goings, {found.going_spread_from} {tool}",
    }


def _odd(found: "StairsMeasurement") -> str:
    odd = (("first", found.first_rise_m), ("last", found.last_rise_m))
    return "".join(f", {name} {1e3 * rise:.0f} mm" for name, rise in odd if rise is not None)


def _row(name: str, value: str) -> str:
    return f"  {name:<12}{value}"
