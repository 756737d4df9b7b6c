"""``kaidan.traverse``: a robot driven over its terrain, judged, and all of it as data."""

from typing import Any

from kaidan.arguments import known_arguments
from kaidan.assessment import found_plan, judged, off_plan
from kaidan.assessment.plan_search import Found
from kaidan.models import beside, planned
from kaidan.models.planned import Planned
from kaidan.models.quasi_static import Basis, findings_of, traverse_of
from kaidan.question import Question
from kaidan.traversal import Traverse
from kaidan.verbs.one_posture_report import MOST_ROWS, governing_row, report_of
from kaidan.verbs.planned_report import planned_report
from kaidan.verbs.traverse_report import (
    TraverseReport,
)


@known_arguments
def traverse(robot: Any, stairs: Any = None, **manner: Any) -> TraverseReport:
    """Follow a robot over stairs from landing to landing: phases, events, poses, forces.

    Parameters
    ----------
    robot, stairs, **manner
        A question, or what one is made of, see `kaidan.Question.of`.

    Raises
    ------
    InputError
        An input without physical meaning; the text names it.

    Examples
    --------
    >>> from kaidan import Stairs
    >>> found = traverse("kenaf", Stairs(name="short", rise=0.178, going=0.279, steps=4))
    >>> found.assessment.verdict, found.event_log[-1].text
    ('no-go', 'falls over its tail, about the lower landing')
    """
    question, search = found_plan(Question.ask(robot, stairs, **manner))
    return traverse_report(question, driven(question), search=search)


def driven(question: Question) -> Traverse | Planned:
    """Traverse of a question with all margins, for a report and for a pose map."""
    if question.changes:
        return planned.drive(question, with_energy=True)
    return traverse_of(question, with_energy=True)


def traverse_report(
    question: Question,
    passage: Traverse | Planned,
    *,
    most: int = MOST_ROWS,
    search: Found | None = None,
) -> TraverseReport:
    """Report on a traverse, judged by the contact model.

    passage: as `driven` gives it.
    """
    if isinstance(passage, Planned):
        return planned_report(question, passage, most=most, search=search)
    found = beside(question, findings_of(question, Basis(question, passage)))
    found = off_plan(question, found, search)
    assessment = judged(question, found, advice=False, search=search)
    return report_of(
        question, passage, assessment, governing=governing_row(passage, assessment), most=most
    )
