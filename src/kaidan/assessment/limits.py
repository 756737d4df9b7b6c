"""What limits a robot on stairs, as numbers of its own: for who must change it, or choose another.

Formulas of the regular flight and of a single step, for a robot without help of flippers: they
explain a verdict and do not make it. That a riser is too high and that the rear length is too short
for it is the same: the height of a single step is that at which the rear length has no margin.
"""

import math
from collections.abc import Callable, Iterator
from typing import Literal

import numpy as np

from kaidan.answer import Part
from kaidan.mechanics.transitions import largest_step_height
from kaidan.question import Question

Figure = Literal["nosing_spacing", "rise"]


class Limit(Part):
    """A figure of the stairs that is more than the robot takes, and what the robot would need."""

    figure: Figure
    """nosing_spacing: two nosings must carry the flat at all times, L >= 2 p. rise: the robot
    pivots over the edge of the highest riser before it is driven upright on its tail."""
    has_m: float
    """Figure of the stairs [m]."""
    takes_m: float
    """Most that the robot takes [m]."""
    needs: Literal["flat_length", "com_from_uphill_end"]
    """Figure of the robot that would have to be another."""
    needs_m: float | None
    """What it would have to be [m]: at least, for flat_length; at most, for com_from_uphill_end;
    null: no value is enough."""


def limits(question: Question) -> tuple[Limit, ...]:
    """Limits that these stairs are beyond, for a robot that goes up them."""
    if question.robot.com_range is not None or question.direction == "down":
        return ()
    return tuple(_limits(question))


def _limits(question: Question) -> Iterator[Limit]:
    stance, profile = question.stance, question.profile
    flights = question.flights or ((question.flight,) if question.flight else ())
    L = stance.flat_length
    p = max((math.hypot(*step) for each in flights for step in each.regular_steps), default=0.0)
    if p > L / 2:
        yield Limit(
            figure="nosing_spacing", has_m=p, takes_m=L / 2, needs="flat_length", needs_m=2 * p
        )
    if stance.tips_below or len(profile.nosings) == 0:  # a flipper lifts an end: no plain track
        return
    track = question.robot.track
    nose = question.facing == "nose-first"
    R = track.rear_radius if nose else track.front_radius
    C_L = stance.com_from_front if nose else L - stance.com_from_front
    rises = np.diff(profile.nosings[:, 1], prepend=profile.points[0, 1])
    rise, C_N = float(rises.max()), stance.com_height

    def highest(along: float) -> float:
        return float(largest_step_height(l_c=L - along, C_N=C_N, R=R))

    takes = highest(C_L)
    if takes < rise:  # NaN is no answer
        yield Limit(
            figure="rise",
            has_m=rise,
            takes_m=takes,
            needs="com_from_uphill_end",
            needs_m=_most(highest, rise, C_L),
        )


def _most(highest: Callable[[float], float], rise: float, C_L: float) -> float | None:
    """Largest C_L that takes a riser: the height grows as the centroid moves to the leading end."""
    if not highest(0.0) >= rise:
        return None
    low, high = 0.0, C_L
    while high - low > 1e-4:
        middle = (low + high) / 2
        low, high = (middle, high) if highest(middle) >= rise else (low, middle)
    return float(np.floor(low * 1e3) / 1e3)
