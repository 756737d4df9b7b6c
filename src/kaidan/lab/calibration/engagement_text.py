"""How grousers engage, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import fixed, table

if TYPE_CHECKING:
    from kaidan.lab.calibration.engagement import Cell, Engagement


def text(found: "Engagement") -> str:
    """A row for each kind of grousers and slope, with a column for each friction."""
    frictions = list(dict.fromkeys(each.friction for each in found.cells))
    rows: dict[tuple[float, ...], dict[str, str]] = {}
    for each in found.cells:
        key = (each.height_m, each.spacing_m, each.nosing_radius_m, each.angle_deg)
        row = rows.setdefault(
            key,
            {name: f"{1e3 * value:g}" for name, value in zip("hsr", key, strict=False)}
            | {"slope": f"{each.angle_deg:g}", "rule": fixed(each.required_friction, 2)},
        )
        row[f"{each.friction:g}"] = _cell(each)
    columns = {"h": "h [mm]", "s": "s [mm]", "r": "r [mm]", "slope": "slope [deg]", "rule": "rule"}
    columns |= {f"{mu:g}": f"at {mu:g}" for mu in frictions}
    climbed = [each for each in found.cells if each.climbed]
    return "\n".join(
        [
            f"{found.robot}, nosings {1e3 * found.nosing_spacing_m:g} mm apart, "
            f"{found.trials} trials a cell, seed {found.seed}",
            "",
            table(list(rows.values()), columns),
            "",
            "  rule: friction below which rigid grousers slip for good. At a friction: slip from",
            "  one nosing to the next [mm], kinetic-energy height over energy margin, largest",
            "  force on one grouser over the weight (mean over 20 ms); x: how many did not climb.",
            f"  {len(climbed)} of {len(found.cells)} cells climb, "
            f"{sum(each.rule_holds for each in found.cells)} by the rule; of these "
            f"{len(found.wrong)} do not climb.",
        ]
    )  # fmt: skip


def _cell(each: "Cell") -> str:
    """Slip, energy and force of a cell whose trials climbed, or how many did not."""
    trials = sum(each.outcomes.values())
    missed = trials - each.outcomes.get("climbed", 0)
    if missed or each.slip_m is None or each.slip_height_m is None:
        return f"x {missed} of {trials}"
    used = each.slip_height_m / each.energy_margin_m
    return f"{1e3 * each.slip_m:.0f}, {used:.2f}, {fixed(each.grouser_force_over_weight)}"
