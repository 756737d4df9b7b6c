"""Plans of postures, and what a change of posture and a drop have to gain."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics import Number
from kaidan.modes import Facing, Phase
from kaidan.question import Question
from kaidan.robot import Posture, PostureChange, Robot
from kaidan.traversal.moves import angles_of

A_CHANGE = 1.5
"""Margin that a change of posture has to gain [deg]."""
A_DROP = 0.1
"""Margin that a degree less of the largest drop outweighs [1]."""
A_TURN = 0.005
"""Margin that a degree less of the flippers' turns outweighs [1]."""
GENTLE = 5.0
"""Rotation that nothing has to spare the robot [deg]."""


class Plan(NamedTuple):
    """Which end leads, and the posture of each phase that has one of its own."""

    facing: Facing
    postures: tuple[tuple[Phase, Posture], ...]

    def question(self, question: Question) -> Question:
        """A question with this plan."""
        (_, first), *others = self.postures
        changes = tuple(
            PostureChange(before=phase.value, posture=posture)
            for (phase, posture), (_, last) in zip(others, self.postures, strict=False)
            if posture != last
        )
        return question.changed(facing=self.facing, posture=first, changes=changes, best_of=())


def cost_of_drop(drop: Number) -> Number:
    """Margin that the largest drop of a plan outweighs [deg]."""
    if isinstance(drop, float):
        return A_DROP * max(drop - GENTLE, 0.0)
    return A_DROP * np.maximum(drop - GENTLE, 0.0)


def cost_of(robot: Robot, postures: Sequence[Posture]) -> float:
    """Margin that the changes of a plan have to gain [deg]."""
    cost = 0.0
    for one, two in pairwise(postures):
        if one != two:
            was, new = (angles_of(robot, each).values() for each in (one, two))
            cost += _cost_of_a_change(sum(abs(a - b) for a, b in zip(was, new, strict=True)))
    return cost


def costs_of_changes(
    robot: Robot, before: Sequence[Posture], after: Sequence[Posture]
) -> NDArray[np.float64]:
    """Margin that a change from each posture to each other has to gain, (n, m) [deg].

    By itself, and by how far flippers turn; nothing where the posture stays.
    """
    one, two = (
        np.array([list(angles_of(robot, each).values()) for each in some])
        for some in (before, after)
    )
    turned = np.abs(one[:, None] - two).sum(axis=-1)
    number = {posture: k for k, posture in enumerate((*before, *after))}
    a, b = ([number[each] for each in some] for some in (before, after))
    return np.where(np.not_equal.outer(a, b), _cost_of_a_change(turned), 0.0)


def _cost_of_a_change(turned: Number) -> Any:
    """Margin that a change has to gain by which flippers turn so far [deg]."""
    return A_CHANGE + A_TURN * math.degrees(1.0) * turned


def words(robot: Robot) -> Iterator[Posture]:
    """Postures that have a name: stowed and flat, in every state."""
    pairs = list(robot.flippers())
    for state in (None, *robot.states):
        for laid in product((None, "flat"), repeat=len(pairs)):
            yield Posture(**dict(zip(pairs, laid, strict=True)), state=state)


def pressed(robot: Robot, posture: Posture, tolerance: float) -> Posture:
    """Flat flippers in whole degrees so far below the flat that off their angle they still are.

    Above it they hang in the air until the robot rotates onto them.
    """
    angles = {
        end: math.radians(math.floor(math.degrees(pair.flat_angle - tolerance)))
        for end, pair in robot.flippers().items()
        if getattr(posture, end) == "flat"
    }
    return posture.model_copy(update=angles)


def off(robot: Robot, posture: Posture, tolerance: float) -> list[Posture]:
    """Postures with every angle a tolerance off, both ways; stowed flippers lie at their stop."""
    angles = angles_of(robot, posture)
    return [
        posture.model_copy(
            update={
                end: angles[end] + sign * tolerance
                for end, sign in zip(angles, signs, strict=True)
                if getattr(posture, end) is not None
            }
        )
        for signs in product((1.0, -1.0), repeat=len(angles))
    ]


def off_angles(question: Question) -> Iterator[Question]:
    """The same with every angle its tolerance off, pairs both ways; nothing without a tolerance."""
    robot, tolerance = question.robot, question.tolerance
    postures = [question.posture, *(each.posture for each in question.changes)]
    for each in dict.fromkeys(zip(*(off(robot, one, tolerance) for one in postures), strict=True)):
        if each == tuple(postures):
            continue
        changes = tuple(
            one.model_copy(update={"posture": posture})
            for one, posture in zip(question.changes, each[1:], strict=True)
        )
        yield question.changed(posture=each[0], changes=changes, flipper_tolerance=None)
