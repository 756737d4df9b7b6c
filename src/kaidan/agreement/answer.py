"""What `kaidan.agreement.agree` finds: questions, answers, differences."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from kaidan.agreement.asked import Begin
from kaidan.agreement.bands import Band
from kaidan.assessment.case import Case

MODELS = {
    "closed_form": "closed form",
    "no_rotation": "contact, no rotation",
    "contact": "contact, caught",
    "physics": "physics",
}

Answer = float | str | None


class Question(NamedTuple):
    """A question and what each of `MODELS` answers."""

    name: str
    text: str
    unit: str
    answers: Mapping[str, Answer]
    """None: not asked, or no answer."""


class Difference(NamedTuple):
    """One model's answer less another's."""

    question: str
    of: str
    less: str
    value: float | None
    """None: not comparable, or two words that can only be the same or not."""
    band: Band | None
    within: bool | None
    """None: not comparable."""
    cause: str
    """Likely cause where it is not within, or why it cannot be compared; else empty."""


@dataclass(frozen=True, kw_only=True)
class Agreement:
    """What `agree` finds."""

    case: Case
    begin: Begin
    speed: float
    """Of the trials [m/s]."""
    friction: float
    """Of the trials, but where it is what is asked [1]."""
    resolution: float
    """Of what is found by bisection over trials [deg]."""
    questions: tuple[Question, ...]
    differences: tuple[Difference, ...]
    trials: int
    """Trials run."""
    versions: Mapping[str, str]

    @property
    def agrees(self) -> bool:
        """Whether every difference that can be told is within its band."""
        return all(each.within is not False for each in self.differences)

    def as_dict(self) -> dict[str, Any]:
        """Everything, ready for JSON."""
        case = self.case
        return {
            "robot": case.robot.name,
            "stairs": case.stairs.name,
            "angle_deg": math.degrees(case.stairs.angle),
            "nosing_spacing_m": case.stairs.nosing_spacing,
            "direction": case.direction,
            "facing": case.facing,
            "acceleration": case.acceleration,
            "begin": self.begin,
            "speed": self.speed,
            "friction": self.friction,
            "resolution_deg": self.resolution,
            "trials": self.trials,
            "versions": dict(self.versions),
            "agrees": self.agrees,
            "questions": [
                {**each._asdict(), "answers": dict(each.answers)} for each in self.questions
            ],
            "differences": [
                {**each._asdict(), "band": None if each.band is None else each.band._asdict()}
                for each in self.differences
            ],
        }
