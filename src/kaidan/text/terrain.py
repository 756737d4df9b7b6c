"""What a profile is taken for, and what is assumed of it across the way."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.question import Question

NO_STAIRS = "the terrain is level, so there are no stairs"
UNKNOWN = (
    "The profile is no flight of steps, single step, ramp or threshold. One track may meet other "
    "ground than the other."
)
STATE = "If both tracks meet the same profile, state it (uniform_across)"


def assumed(question: "Question") -> str:
    """What is assumed of a profile across the way; empty of stairs, and where nothing is."""
    if question.flights or question.profile.is_level:
        return ""
    if question.profile.shape != "irregular":
        return f"both tracks meet the same profile: a {question.profile.shape}"
    return "both tracks meet the same profile, as stated" if question.uniform_across else ""


def note(question: "Question") -> list[str]:
    """The same as a sentence, if there is any."""
    said = assumed(question)
    return [f"Assumed: {said}."] if said else []
