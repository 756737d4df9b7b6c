"""The question: one robot, one terrain, one manner of going, and what the operator accepts.

Every verb takes one, every answer carries the one that it answers. `Question.of` makes it of what
people write, names, numbers and texts with units; the command line passes its texts on to it.
"""

from kaidan.question.fields import FACINGS, LARGEST_YAW
from kaidan.question.question import Question
from kaidan.question.yielding import ROCKING_SPEED

__all__ = ["FACINGS", "LARGEST_YAW", "ROCKING_SPEED", "Question"]
