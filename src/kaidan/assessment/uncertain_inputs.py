"""What a question does not know exactly, each by its name, and the question without that doubt."""

from typing import NamedTuple

from kaidan.allowance import Allowance
from kaidan.question import Question
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs

SAMPLED = (
    "flat_length",
    "com_from_front",
    "com_height",
    "angle",
    "nosing_spacing",
    "friction_uncertainty",
)
"""Inputs that are drawn, in the order of `Question.spread` and of the unit draws."""
STEPS = "steps"
"""Single rises and goings, which are drawn after those."""


GROUPS = {
    "com_from_front": "centroid",
    "com_height": "centroid",
    "flat_length": "length",
    "angle": "stairs",
    "nosing_spacing": "stairs",
    STEPS: "stairs",
    "friction_uncertainty": "friction",
    "friction": "friction",
    "theta_d": "theta_d",
    "theta_M": "theta_M",
}
"""What is measured in one go."""


class Doubt(NamedTuple):
    """An input that is not known exactly."""

    name: str
    sigma: float
    """Standard uncertainty; of a range that of the even distribution."""
    ends: tuple[float, float] | None
    """Of a range, from the worst to the best case; None: it is normally distributed."""

    @property
    def group(self) -> str:
        """What is measured."""
        return GROUPS[self.name]


def doubts_of(question: Question) -> tuple[Doubt, ...]:
    """Inputs of a question that are not known exactly."""
    found = [
        Doubt(name, sigma, None)
        for name, sigma in zip(SAMPLED, question.spread, strict=True)
        if sigma > 0
    ]
    if question.steps_uncertain:
        found.append(Doubt(STEPS, float("nan"), None))
    low, high = question.friction
    ranges = {
        "friction": (low, high),
        "theta_d": (question.allowance_d.high, question.allowance_d.low),
        "theta_M": (question.allowance_M.high, question.allowance_M.low),
    }
    found += [
        Doubt(name, abs(ends[1] - ends[0]) / 12**0.5, ends)
        for name, ends in ranges.items()
        if abs(ends[1] - ends[0]) > 0
    ]
    return tuple(found)


def without(question: Question, group: str) -> Question | None:
    """Question with a group measured: as stated, a range at its best end; None: not of a sheet.

    group: one of the values of `GROUPS`.
    """
    if group in ("centroid", "length"):
        names = [name for name, of in GROUPS.items() if of == group]
        exact = question.robot.uncertainty.model_copy(update=dict.fromkeys(names, 0.0))
        return question.changed(robot=question.robot.model_copy(update={"uncertainty": exact}))
    if group == "stairs":
        if not isinstance(question.terrain, Stairs):
            return None
        exact_stairs = type(question.terrain.uncertainty)()
        return question.changed(
            terrain=question.terrain.model_copy(update={"uncertainty": exact_stairs})
        )
    if group == "friction":
        if question.surface is None:
            return None
        return question.changed(surface=Surface.of_friction(question.friction[1]))
    low = {"theta_d": question.allowance_d, "theta_M": question.allowance_M}[group].low
    return question.changed(**{group: Allowance(low=low, high=low)})
