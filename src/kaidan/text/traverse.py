"""A traverse, as text: verdict, grades, phases, event log, stages of a fall."""

from typing import TYPE_CHECKING

from kaidan.modes import Verdict
from kaidan.tables import fixed, table
from kaidan.text import plan
from kaidan.text.event_log import lines_of
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.models.contact_figures import Grades, PhaseFigures
    from kaidan.verbs.traverse_report import TraverseReport

_PHASES = {
    "phase": "phase",
    "friction": "required friction",
    "energy": "energy margin [mm]",
    "static": "static margin [mm]",
    "traction": "traction / weight",
    "rotation": "rotation [deg]",
    "belly": "belly",
}


def text(found: "TraverseReport") -> str:
    """Verdict, grades, worst numbers of each phase, and what happens in order."""
    answer = found.assessment
    lines = [
        f"{Verdict(answer.verdict).label}  {subject(found.question)}",
        f"  {answer.reason}",
    ]
    if answer.plan is not None and plan.line(answer.plan):
        lines += plan.section(answer.plan, answer.verdict)
    if answer.contact is not None:
        lines += ["", *(f"  {line}" for line in grade_lines(answer.contact.grades))]
        lines += ["", table([_phase(each) for each in answer.contact.phases], _PHASES)]
    lines += ["", *(f"  {line}" for line in lines_of(found.event_log))]
    if found.fall_stages:
        lines += [
            "",
            "  How it rotates over its downhill end (stages of the paper's Fig. 20, no grousers)",
        ]
    lines += [
        f"    {each.name:<18}{each.path_m:6.2f} m {each.inclination_deg:6.1f} deg  {each.text}"
        for each in found.fall_stages
    ]
    return "\n".join(lines)


def grade_lines(grades: "Grades") -> list[str]:
    """Three grades of holding side by side, and the largest rotation."""
    one = {None: "says nothing", True: "yes", False: "no"}[grades.no_rotation]
    arrested, momentum = (
        "yes" if each else "no" for each in (grades.arrested, grades.arrested_with_momentum)
    )
    return [
        f"holds            without rotation: {one}   arrested: {arrested}   "
        f"arrested with momentum: {momentum}",
        f"largest rotation {grades.largest_rotation_deg:.1f} deg, and "
        f"{grades.largest_drop_deg:.1f} deg that the terrain obliges to",
    ]


def _phase(each: "PhaseFigures") -> dict[str, str]:
    friction = "none is enough"
    if each.required_friction is not None:
        friction = f"{each.required_friction:.2f}"
    energy = "-"
    if each.energy_margin_mm is not None:
        energy = f"{each.energy_margin_mm:.1f} at step {each.energy_margin_step}"
    return {
        "phase": each.phase,
        "friction": f"{friction} at step {each.required_friction_step}",
        "energy": energy,
        "static": fixed(each.static_margin_mm, 0),
        "traction": f"{each.traction_over_weight:.2f}",
        "rotation": f"{each.largest_rotation_deg:.1f}",
        "belly": "touches" if each.belly_touches else "free",
    }
