"""Words that several texts share."""

from typing import TYPE_CHECKING

from kaidan.words import heading

if TYPE_CHECKING:
    from kaidan.question import Question


def subject(question: "Question") -> str:
    """Robot, terrain and heading of a question: "kenaf on ibc, up nose first"."""
    names = " ".join(f"{question.robot.name} on {question.terrain_name}".split())
    return f"{names}, {heading(question)}"
