"""``kaidan.report``: what an operator, and who signs for the mission, must have on paper.

A report is made of the answers of `assess` and `traverse`, and of nothing else: what is on paper is
what the commands say. `kaidan.documents` makes a file of it.
"""

from typing import Any

from kaidan import contact
from kaidan.arguments import known_arguments
from kaidan.assessment import answer_to, found_plan
from kaidan.assessment.answer import Assessment
from kaidan.errors import InputError
from kaidan.modes import CONTACT, Phase
from kaidan.question import Question
from kaidan.robot import Posture, PostureChange
from kaidan.verbs.report.answer import Mission as Mission
from kaidan.verbs.report.answer import Report as Report
from kaidan.verbs.report.code import code_of
from kaidan.verbs.report.field_card import field_card
from kaidan.verbs.report.inputs import inputs_of
from kaidan.verbs.traverse import driven, traverse_report
from kaidan.verbs.traverse_report import TraverseReport

MOST_MISSIONS = 100
"""Most missions of one document."""


@known_arguments
def report(robots: Any, stairs: Any = None, **manner: Any) -> Report:
    """Report on one robot on one terrain, or on each of several robots on each of several.

    Parameters
    ----------
    robots : Question, Robot, str, path, or a list of them
        Robots as `kaidan.assess` has them; or whole questions, without stairs.
    stairs : Stairs, Profile, str, path, or a list of them
        Terrains as `kaidan.assess` has them; a list is of several terrains, each a mission of its
        own (several flights in a row are one text, joined by "+").
    **manner
        Everything else of a question, see `kaidan.Question.of`; of all missions.

    Raises
    ------
    InputError
        An input without physical meaning; no robot, no stairs, or too many of them.

    Examples
    --------
    >>> found = report("kenaf", "ibc", friction=0.8)
    >>> found.missions[0].assessment.verdict
    'no-go'
    """
    from kaidan import __version__

    all_robots = list(robots) if isinstance(robots, list) else [robots]
    all_stairs = list(stairs) if isinstance(stairs, list) else [stairs]
    count = len(all_robots) * len(all_stairs)
    if not 0 < count <= MOST_MISSIONS:
        raise InputError(
            f"report: {len(all_robots)} robots on {len(all_stairs)} stairs are {count} missions; "
            f"give 1 to {MOST_MISSIONS}"
        )
    questions = [Question.ask(each, on, **manner) for each in all_robots for on in all_stairs]
    return Report(
        kaidan=__version__,
        kernel=contact.kernel_in_use(),
        missions=tuple(mission(each) for each in questions),
    )


def mission(question: Question) -> Mission:
    """One robot on one terrain."""
    assessment = answer_to(question)
    followed = _traverse(question, assessment)
    return Mission(
        code=code_of(question),
        assessment=assessment,
        traverse=followed,
        way_back=_way_back(question, assessment),
        card=field_card(assessment, followed),
        inputs=tuple(inputs_of(question, assessment)),
    )


def _traverse(question: Question, assessment: Assessment) -> TraverseReport | None:
    """Traverse that the assessment stands on; None where it stands on none."""
    weighed = question.robot.com_range is None  # else there is no one traverse
    if not weighed or question.model != CONTACT.name or question.yaw or assessment.contact is None:
        return None
    planned, search = found_plan(question)
    return traverse_report(planned, driven(planned), search=search)


def _way_back(question: Question, assessment: Assessment) -> Assessment | None:
    """Answer on the way back, the same end of the robot uphill."""
    if assessment.verdict == "outside-model":
        return None
    try:
        return answer_to(back(question))
    except InputError:  # a terrain that the model does not take from the other side
        return None


def back(question: Question) -> Question:
    """Same question on the way back: the robot backs, each phase in the posture it had there."""
    at = question.postures
    there: tuple[Posture, ...] = (at[Phase.LAND], at[Phase.TRAVERSE], at[Phase.ENTER])
    changes = tuple(
        PostureChange(before=phase.value, posture=after)
        for phase, before, after in (
            (Phase.TRAVERSE, there[0], there[1]),
            (Phase.LAND, there[1], there[2]),
        )
        if before != after
    )
    return question.changed(
        direction="down" if question.direction == "up" else "up",
        facing="tail-first" if question.facing == "nose-first" else "nose-first",
        posture=there[0],
        changes=changes,
    )
