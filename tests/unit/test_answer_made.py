"""An answer is made without being validated: what it holds is what validation would leave."""

import pytest

from kaidan import Assessment, Question
from kaidan.answer import Part
from kaidan.assessment import answer_to

QUESTIONS = {
    "go": ("absolem-flat", "ibc", {"friction": 2.0, "flippers": "stowed"}),
    "closed form, advice": ("absolem", "ibc", {"model": "closed-form", "flippers": "flat"}),
    "outside": ("kenaf", "ibc", {"model": "closed-form", "friction": 1.0}),
    "no-go, limits": ("kenaf", "ibc", {"friction": (0.5, 0.8)}),
    "support polygon": ("absolem", "ibc", {"model": "support-polygon", "friction": 1.0}),
    "plan": ("absolem", "ibc", {"friction": 1.2}),
    "uncertain": (
        "absolem-flat",
        "osha",
        {"friction": 0.9, "uncertainty": {"com_height": 0.004, "angle": 0.01}},
    ),
    "down": ("marv", "ada", {"surface": "concrete-dry", "flippers": "flat", "direction": "down"}),
}


def typed(value):
    """Value with the types of all that it holds."""
    if isinstance(value, Part):
        return type(value), {name: typed(each) for name, each in dict(value).items()}
    if isinstance(value, tuple):
        return tuple(typed(each) for each in value)
    if isinstance(value, dict):
        return {key: typed(each) for key, each in value.items()}
    return type(value), value


@pytest.mark.parametrize("name", QUESTIONS)
def test_validation_would_change_nothing(name):
    robot, stairs, manner = QUESTIONS[name]
    answer = answer_to(Question.ask(robot, stairs, **manner))
    validated = Assessment.model_validate(dict(answer))
    assert typed(answer) == typed(validated)
    assert Assessment.from_json(answer.to_json()) == answer


def test_a_part_is_made_of_all_its_fields():
    class Pair(Part):
        one: float | None
        two: tuple[float, ...]

    made = Pair.made(one=float("inf"), two=(1.0,))
    assert (made.one, made.two) == (None, (1.0,))
    with pytest.raises(AssertionError):
        Pair.made(one=1.0)
