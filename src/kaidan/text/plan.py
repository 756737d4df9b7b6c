"""A plan in words: which end leads, how the flippers lie and where they change, what was tried."""

from typing import TYPE_CHECKING

from kaidan.words import end_first

if TYPE_CHECKING:
    from kaidan.assessment.plan import PlanShown


def line(plan: "PlanShown") -> str:
    """Plan in one line: the tail if that leads, posture at the start, each change; or nothing.

    A robot without flippers and states, nose first, has nothing to do.
    """
    postures = "; ".join(
        step.flippers
        if step.before_step is None
        else f"before step {step.before_step} {step.flippers}"
        for step in plan.steps
    )
    tail = end_first(plan.facing) if plan.found and plan.facing == "tail-first" else ""
    return "; ".join(filter(None, (tail, "" if plan.bare else postures)))


def lines(plan: "PlanShown") -> list[str]:
    """Plan as a list of what to do."""
    start = "" if plan.bare else f", flippers {plan.steps[0].flippers}"
    each = [f"Go {end_first(plan.facing)}{start}"]
    for step in plan.steps[1:]:
        said = f"Stop with the centroid before step {step.before_step}: flippers {step.flippers}"
        if step.turn_deg is not None:
            time = "time not known" if step.time_s is None else f"{step.time_s:.1f} s"
            torque = "" if step.torque_Nm is None else f", {step.torque_Nm:.0f} N m"
            said += f" ({step.turn_deg:.0f} deg, {time}{torque})"
        each.append(said)
    if plan.holds_within_deg:
        each.append(f"The verdict holds within {plan.holds_within_deg:.3g} deg of these angles")
    return each


def section(plan: "PlanShown", verdict: str) -> list[str]:
    """Plan under its heading: what is NO-GO even so is nothing to do."""
    heading = "The best plan, NO-GO even so" if verdict == "no-go" else "What to do"
    return ["", f"  {heading}", *(f"    {line}" for line in lines(plan))]
