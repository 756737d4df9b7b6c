"""The answer of `kaidan posture` as a page, the plan first."""

from typing import TYPE_CHECKING

from kaidan.modes import Verdict
from kaidan.text import plan

if TYPE_CHECKING:
    from kaidan.models.contact_figures import PhaseFigures
    from kaidan.verbs.posture import PostureAnswer, PostureTried


def text(answer: "PostureAnswer") -> str:
    """Answer as a page for people."""
    question = answer.question
    head = "This plan is best" if answer.helps else "Nothing is better than the requested posture"
    lines = [
        f"{head}  {question.robot.name} on {question.terrain_name}, {question.direction}",
        "",
        f"  before    {_with(answer.before)}: {_outcome(answer.before)}",
        f"            {answer.before.reason}",
    ]
    if answer.helps:
        after = answer.after
        lines += [
            f"  after     {_with(after)}: {_outcome(after)}",
            f"            {after.reason}",
            f"            ask again with --facing {after.facing} --flippers={after.flippers}",
            *plan.section(answer.plan, answer.after.verdict),
        ]
    lines += ["", "  By phase", *(_phase(each) for each in answer.phases)]
    notes = _notes(answer)
    if notes:
        lines += ["", "  Notes", *(f"    {note}" for note in notes)]
    return "\n".join(lines)


def _with(each: "PostureTried") -> str:
    return f"{each.facing.replace('-', ' ')}, {each.flippers}"


def _outcome(each: "PostureTried") -> str:
    margin = "" if each.margin_deg is None else f" ({each.margin_deg:+.1f} deg)"
    return f"{Verdict(each.verdict).label}{margin}"


def _phase(each: "PhaseFigures") -> str:
    friction = (
        "no friction is enough"
        if each.required_friction is None
        else f"friction {each.required_friction:.2f} (step {each.required_friction_step})"
    )
    return f"    {each.phase:<10}{friction}, largest rotation {each.largest_rotation_deg:.1f} deg"


def _notes(answer: "PostureAnswer") -> list[str]:
    notes = []
    low, high = answer.limits_deg
    if not answer.helps:
        notes.append(
            f"No plan with angles within {low:.0f} to {high:.0f} deg is better than the requested "
            "posture."
        )
    if answer.searched_steps is not None:
        notes.append(
            f"Searched on {answer.searched_steps} risers; before and after are judged on all."
        )
    if any(step.time_s is None and step.before_step for step in answer.plan.steps):
        notes.append("The flippers' largest speed is not known, so changes are not timed.")
    if answer.question.surface is None:
        notes.append("No friction was stated, so no GO can be given.")
    return notes
