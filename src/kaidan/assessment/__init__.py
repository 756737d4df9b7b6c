"""One question, one answer: findings of a model, one verdict policy, what would help."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from kaidan.arguments import known_arguments
from kaidan.assessment.answer import Assessment as Assessment
from kaidan.assessment.answer import Change, fill_in
from kaidan.assessment.verdict import conclude
from kaidan.models import judge
from kaidan.models.findings import Finding, Findings
from kaidan.modes import POSTURE_TOLERANCE, Verdict
from kaidan.question import Question

if TYPE_CHECKING:
    from kaidan.assessment.plan import PlanShown
    from kaidan.assessment.plan_search import Found
    from kaidan.assessment.unweighed import CentroidShown


@known_arguments
def assess(robot: Any, stairs: Any = None, **manner: Any) -> Assessment:
    """Whether a tracked robot can take a flight of stairs, and by how much.

    Parameters
    ----------
    robot : Question, Robot, str or path
        A whole question; or the robot, its name in the catalogue, or a TOML file.
    stairs : Stairs, Profile, str, path or a sequence of flights
        Stairs, their name in the catalogue, or a TOML file; several flights; or a profile.
    **manner
        Everything else of a question: surface, friction, direction, flippers, model and so
        on, see `kaidan.Question.of`.

    Returns
    -------
    Assessment
        A robot that cannot climb is an answer, not an error.

    Raises
    ------
    InputError
        An input without physical meaning; the text names it.

    Examples
    --------
    >>> from math import radians
    >>> from kaidan.terrain.stairs import Stairs
    >>> answer = assess("kenaf", Stairs.inclined(angle=radians(50), nosing_spacing=0.150),
    ...                 friction=2.0)
    >>> answer.verdict, round(answer.margin_deg, 2)
    ('go', 4.91)

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    return answer_to(Question.ask(robot, stairs, **manner))


def answer_to(question: Question, *, advice: bool = True) -> Assessment:
    """Answer to a question.

    Parameters
    ----------
    advice : bool
        Whether to look for what would help, which asks the model again for each change.
    """
    planned = with_plan(question)
    return judged(planned.question, planned.findings, advice=advice, search=planned.search)


class WithPlan(NamedTuple):
    """A question whose posture is stated or found, and what the model finds of it."""

    question: Question
    findings: Findings
    search: "Found | None"
    """What the search came upon; None where the posture was stated."""


def with_plan(question: Question, *, limits: tuple[float, float] | None = None) -> WithPlan:
    """Question with the best plan in it, where that is to be found, and its findings.

    limits: angles allowed [rad]; those of the search without them.
    """
    planned, search = found_plan(question, limits=limits)
    known = search is not None and search.question is planned
    found = search.findings if search is not None and known else judge(planned)
    return WithPlan(planned, off_plan(planned, found, search), search)


def found_plan(
    question: Question, *, limits: tuple[float, float] | None = None
) -> "tuple[Question, Found | None]":
    """Question with the best plan in it, where that is to be found, and what found it.

    limits: angles allowed [rad]; those of the search without them.
    """
    if not question.best_of:
        return question, None
    from kaidan.assessment.plan_search import LIMITS, found_of

    robot = question.robot
    if robot.com_range is None:
        search = found_of(question, limits or LIMITS)
        return search.question, search
    # the plan of the middle of its range, judged all over it
    search = found_of(question.changed(robot=robot.middle), limits or LIMITS)
    return search.question.changed(robot=robot), search


def off_plan(question: Question, found: Findings, search: "Found | None" = None) -> Findings:
    """Findings of a plan, with one more where its verdict is worse when it is perturbed.

    question: with the plan; its `tolerance` is how far off the angles may be.
    """
    if not question.tolerance:
        return found
    from kaidan.assessment.plan_off_angles import holds_off_its_angles

    if holds_off_its_angles(question) if search is None else search.robust:
        return found
    off = Finding.certain(POSTURE_TOLERANCE, -math.inf, model=question.model)
    return replace(found, each=(*found.each, off))


def judged(
    question: Question, found: Findings, *, advice: bool = True, search: "Found | None" = None
) -> Assessment:
    """Answer to a question from what a model found; see `answer_to`."""
    from kaidan.assessment.measuring import to_measure
    from kaidan.assessment.sentences import plan as plan_text
    from kaidan.assessment.sentences import verdicts

    conclusion = conclude(question, found)
    measure = to_measure(question, found) if advice else ()
    changes: tuple[Change, ...] = ()
    if advice and conclusion.verdict is not Verdict.GO:
        from kaidan.assessment.advice import what_would_help

        changes = what_would_help(question, found, conclusion, measure, search=search)
    plan: PlanShown | None = None
    if search is not None or question.changes or question.tolerance:
        from kaidan.assessment.plan import plan_of

        plan = plan_of(question, found, search)
    centroid: CentroidShown | None = None
    if question.robot.com_range is not None and advice:
        from kaidan.assessment.unweighed import stretches

        centroid = stretches(question, found)
    return fill_in(
        question,
        found,
        conclusion,
        plan=plan,
        reason=verdicts.reason(question, found, conclusion),
        notes=(
            *verdicts.notes(question, found, conclusion),
            *(() if search is None else plan_text.notes(question, search.ends)),
        ),
        what_would_help=changes,
        to_measure=measure,
        centroid=centroid,
    )
