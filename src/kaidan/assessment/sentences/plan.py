"""How a plan was found."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from kaidan.modes import MODELS
from kaidan.words import end_first

if TYPE_CHECKING:
    from kaidan.question import Question


def notes(question: "Question", ends: Sequence[str]) -> tuple[str, ...]:
    """What was tried to find a plan, where that is less than people may take it for."""
    each = []
    if question.robot.flippers() and not question.plannable:
        where = "at a yaw" if question.yaw else f"by the {MODELS[question.model].label}"
        each.append(
            f"Flippers stowed and flat were tried; {where} no angles are, and none changes on the "
            "way."
        )
    others = [end for end in ends if end != question.facing]
    each += [f"{end_first(end).capitalize()} was tried too and is no better." for end in others]
    return tuple(each)
