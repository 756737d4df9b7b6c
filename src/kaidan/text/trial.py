"""A trial in MuJoCo, as text."""

from typing import TYPE_CHECKING

from kaidan.text.words import subject
from kaidan.words import place

if TYPE_CHECKING:
    from kaidan.physics import TrialResult


def text(result: "TrialResult") -> str:
    """How it ended and where, then what was simulated and what was largest."""
    spec, question = result.spec, result.spec.question
    assumed = ", assumed: the sheet gives none" if result.mass_assumed else ""
    estimated = ", inertia estimated" if result.inertia_estimated else ""
    torque = "" if result.largest_torque_Nm is None else f", {result.largest_torque_Nm:.1f} N m"
    step = f"steps of {1e3 * result.timestep_s:g} ms"
    rows = (
        ("model", f"{spec.track.kind}, {spec.dimensions}-D, {step}"),
        ("friction", f"{result.friction:g}"),
        ("speed", f"{result.speed_m_s:g} m/s, {question.acceleration:g} m/s2 up the stairs"),
        ("mass", f"{result.mass_kg:g} kg{assumed}{estimated}"),
        ("extra inclination", f"{result.largest_extra_deg:.2f} deg at most"),
        ("nosings passed", f"{result.nosings_passed}, begun at {result.start_offset:.3f} of a "
                           "spacing"),
        ("largest forces", f"{result.largest_normal_N:.0f} N normal to the stairs, traction "
                           f"{result.largest_traction_N:.0f} N{torque}, means over 20 ms"),
        ("slip", f"{1e3 * result.slip_m:.1f} mm"),
        ("time", f"{result.time_s:.2f} s"),
        ("made with", f"{_engine(result)}, seed {spec.seed}"),
    )  # fmt: skip
    head = f"{ended(result).upper()}{place(result.phase, result.step)}  {subject(question)}"
    return "\n".join([head, *(f"  {name:<18} {value}" for name, value in rows)])


def _engine(result: "TrialResult") -> str:
    found = result.versions.get("mujoco")
    return "kaidan's planar solver" if found is None else f"MuJoCo {found}"


def ended(result: "TrialResult") -> str:
    """How a trial ended: "fell backward"."""
    return result.outcome.value.replace("_", " ")
