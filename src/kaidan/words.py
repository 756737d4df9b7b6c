"""Words that several sentences share."""

from typing import Protocol


class _Goes(Protocol):
    @property
    def direction(self) -> str: ...
    @property
    def facing(self) -> str: ...


def heading(answer: _Goes) -> str:
    """How the robot goes: "up nose first"."""
    return heading_of(answer.direction, answer.facing)


def heading_of(direction: str, facing: str) -> str:
    """The same of a direction and a facing."""
    return f"{direction} {end_first(facing)}"


def end_first(facing: str) -> str:
    """Which end leads: "nose first"."""
    return facing.replace("-", " ")


def place(phase: str | None, step: int | None) -> str:
    """Where on the way, in brackets after a blank: " (enter, step 2)"; empty where nobody knows."""
    if phase is None:
        return ""
    return f" ({phase})" if step is None else f" ({phase}, step {step})"
