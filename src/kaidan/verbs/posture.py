"""The plan that makes the most of a robot on given stairs, beside the posture that was stated."""

import math
from typing import Any, ClassVar

from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments
from kaidan.assessment import with_plan
from kaidan.assessment.answer import VerdictName
from kaidan.assessment.plan import PlanShown, plan_of
from kaidan.assessment.plan_judged import Judged, judged_of
from kaidan.assessment.plan_search import LIMITS, Found
from kaidan.assessment.sentences import verdicts
from kaidan.errors import InputError
from kaidan.models import judge
from kaidan.models.contact_figures import ContactFigures, PhaseFigures
from kaidan.models.findings import Findings
from kaidan.modes import CONTACT, Facing, Verdict
from kaidan.question import Question
from kaidan.units import range_of


class PostureTried(Part):
    """A posture or plan and what the contact model says of it."""

    facing: Facing
    """Which end leads."""
    flippers: str
    """As the option is written, to ask with it again."""
    verdict: VerdictName
    margin_deg: float | None
    """Smallest margin of slope, allowances subtracted [deg]."""
    governs: str
    """What decides."""
    required_friction: float | None
    """Static friction below which the robot slips somewhere [1]; null: none is enough, or nothing
    is known."""
    largest_rotation_deg: float
    """Largest rotation, drops that the path obliges to included [deg]."""
    reason: str
    """The verdict in one sentence."""


class PostureAnswer(Answer):
    """What facing, flippers, arm and payload can do for a robot on stairs."""

    text_module: ClassVar[str] = "kaidan.text.posture"

    question: Question
    """The question; its posture is the one to compare with."""
    before: PostureTried
    """Posture of the question."""
    after: PostureTried
    """Best plan; as before where nothing is better."""
    helps: bool
    """Whether it is better than before."""
    plan: PlanShown
    """What to do."""
    phases: tuple[PhaseFigures, ...]
    """Extreme figures of each phase of the best plan."""
    limits_deg: tuple[float, float]
    """Angles allowed [deg]; stowed and flat always are."""
    searched_steps: int | None
    """Risers on which it was searched, where they are fewer than the flight has."""

    @property
    def exit_code(self) -> int:
        """Of the best plan, by `kaidan.modes.EXIT_CODES`."""
        return Verdict(self.after.verdict).exit_code


@known_arguments
def posture(
    robot: Any,
    stairs: Any = None,
    *,
    limits: tuple[float, float] = LIMITS,
    facing: str | None = None,
    **manner: Any,
) -> PostureAnswer:
    """Plan of facing and postures with the best verdict, by the contact model.

    Parameters
    ----------
    robot, stairs, **manner
        A question, or what one is made of, see `kaidan.question.Question.of`; its posture is the
        one to compare with.
    limits : (float, float)
        Angles allowed [rad]; the stowed angle and lying flat always are.
    facing : {"nose-first", "tail-first"}, optional
        Which end leads; both are tried without it.

    Returns
    -------
    PostureAnswer
        Also where nothing helps; then `helps` is False.

    Raises
    ------
    InputError
        A robot without flippers and states, or limits without meaning.
    """
    if facing is not None:
        manner["facing"] = facing
    question = Question.in_one_posture(robot, stairs, **manner)
    if "flippers" in question.best_of:
        raise InputError("posture: state the posture to compare with: stowed, flat or angles")
    if question.yaw:
        raise InputError("posture: leave the yaw out; the flippers are judged straight on")
    if question.model != CONTACT.name:
        raise InputError("posture: the contact model judges the flippers; leave the model out")
    sheet = question.robot
    if not sheet.flippers() and not sheet.states:
        raise InputError(f"robot {sheet.name!r} has no flippers, so it has no posture to choose")
    low, high = range_of(limits, "angle", option="limits")
    if not -math.pi <= low < high <= math.pi:
        raise InputError(
            f"limits = {math.degrees(low):g} to {math.degrees(high):g} deg: write a "
            "smaller and a larger angle within -180 to 180 deg"
        )
    free = ("flippers",) if facing is not None else ("flippers", "facing")
    planned, findings, search = with_plan(question.changed(best_of=free), limits=limits)
    assert search is not None
    before, after = judged_of(question, judge(question)), judged_of(planned, findings)
    helps = after.merit > before.merit
    best = after if helps else before
    flight, short = question.flight, search.short.flight
    return PostureAnswer(
        question=question,
        before=_tried(before),
        after=_tried(best),
        helps=helps,
        plan=_plan(best, search, helps=helps),
        phases=_phases(best.findings),
        limits_deg=(math.degrees(limits[0]), math.degrees(limits[1])),
        searched_steps=short.steps if flight and short and short.steps < flight.steps else None,
    )


def _plan(best: Judged, search: Found, *, helps: bool) -> PlanShown:
    shown = plan_of(best.question, best.findings, search)
    return shown if helps else shown.model_copy(update={"found": False, "holds_within_deg": None})


def _phases(found: Findings) -> tuple[PhaseFigures, ...]:
    figures = [each for each in found.figures if isinstance(each, ContactFigures)]
    return figures[0].phases if figures else ()


def _tried(each: Judged) -> PostureTried:
    conclusion = each.conclusion
    return PostureTried(
        facing=each.question.facing,
        flippers=each.question.flippers,
        verdict=conclusion.verdict.value,
        margin_deg=math.degrees(conclusion.margin),
        governs=str(conclusion.governs),
        required_friction=each.findings.required_friction,
        largest_rotation_deg=each.drop,
        reason=verdicts.reason(each.question, each.findings, conclusion),
    )
