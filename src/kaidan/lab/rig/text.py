"""What a filled rig sheet says of a robot, as text."""

from typing import TYPE_CHECKING

from kaidan.tables import fixed, table

if TYPE_CHECKING:
    from kaidan.lab.rig.calibration import AtSpacing, Figure, RigCalibration


def text(found: "RigCalibration") -> str:
    """Figures with their intervals, what each spacing says, and whether bench and stairs agree."""
    rows = [
        {"name": "k, one nosing pressed in", "found": _one(found.stiffness_N_m, 1e-3, "kN/m")},
        {"name": "kt, sheared over it", "found": _one(found.shear_stiffness_N_m, 1e-3, "kN/m")},
        {"name": "theta_d", "found": _one(found.theta_d_deg, 1.0, "deg")},
        {"name": "theta_M", "found": _one(found.theta_M_deg, 1.0, "deg")},
    ]
    lines = [
        f"{found.robot}: {found.mass_kg:g} kg, {found.trials} trials counted",
        "",
        table(rows, {"name": "figure", "found": f"value ({100 * found.together:.0f} % together)"}),
    ]
    if found.spacings:
        columns = {
            "p": "p [mm]",
            "margin": "margin up [deg]",
            "theta_d": "theta_d [deg]",
            "w_n": "indentation that it needs [mm]",
            "24": "by Eq. (24)",
            "phase": "by grouser phase",
            "film": "as filmed",
        }
        lines += ["", table([_spacing(each) for each in found.spacings], columns)]
    if found.cause is not None and found.cause_mm is not None:
        lines += [
            "",
            f"  {_CAUSES[found.cause]} The belt's phase makes {_cell(found.cause_mm)} mm of "
            f"theta_d times p; grousers are {1e3 * (found.grouser_height_m or 0.0):.1f} mm high.",
        ]
    if found.agrees is not None:
        lines += ["", _AGREES if found.agrees else _DISAGREES]
    return "\n".join(lines)


_CAUSES = {
    "grousers": "theta_d comes of the phase of the grousers.",
    "rubber": "theta_d comes of a track that yields: the belt's phase does not matter.",
    "both": "theta_d comes of the phase of the grousers in part: something yields as well.",
    "undecided": "These trials do not part grousers from rubber: make more.",
}
_AGREES = "  theta_d and the bench require the same k, by the closed form."
_DISAGREES = (
    "  theta_d requires another k than the bench, by the closed form: something else yields too "
    "(grousers, wheels, the frame), or the robot was still moving when it was read."
)


def _one(one: "Figure | None", scale: float, unit: str) -> str:
    if one is None:
        return "not measured"
    return f"{scale * one.value:.3g} ({_ends(one, scale)}) {unit}"


def _ends(one: "Figure", scale: float = 1.0) -> str:
    if one.high is None:
        return f"{scale * one.low:.3g} or more"
    return f"{scale * one.low:.3g} to {scale * one.high:.3g}"


def _spacing(each: "AtSpacing") -> dict[str, str]:
    return {
        "p": f"{1e3 * each.nosing_spacing_m:.0f}",
        "margin": _cell(each.margin_up_deg),
        "theta_d": _cell(each.theta_d_deg),
        "w_n": _cell(each.w_n_mm),
        "24": fixed(each.equation_24_deg, 1),
        "phase": fixed(each.phase_deg, 1),
        "film": fixed(each.film_deg, 1),
    }


def _cell(one: "Figure | None") -> str:
    return "-" if one is None else f"{one.value:.1f} ({_ends(one)})"
