"""Postures of the designs: the plan on each of the stairs, found for one of them."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from kaidan.assessment import found_plan
from kaidan.errors import InputError
from kaidan.sweeps.parameters import question_of
from kaidan.verbs.design.problem import Problem


def planned(problem: Problem, values: Sequence[float]) -> Problem:
    """Same problem in the plans of one of its designs, with nothing tried."""
    own = {each.name: value for each, value in zip(problem.free, values, strict=True)}
    bare = replace(problem, plans=(), tried={})
    plans = [_plan({**problem.values, **own, **way}) for way in bare.ways]
    return replace(bare, plans=plans)


def _plan(values: dict[str, Any]) -> dict[str, Any]:
    """Facing, postures and tolerance of the best plan; stowed where the question has no meaning."""
    try:
        question = question_of(values)
        found, _ = found_plan(question)
    except InputError:
        return {"facing": None, "flippers": "stowed", "flipper_tolerance": None}
    return {
        "facing": found.facing,
        "flippers": (found.posture, *found.changes),
        "flipper_tolerance": question.tolerance,
    }
