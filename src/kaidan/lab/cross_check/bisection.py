"""What trials show only by trying: the steepest flight, the friction that one requires."""

import math
from typing import NamedTuple

from kaidan.lab.cross_check.common_question import (
    PLENTY,
    at_angle,
    slopes,
    trial_of,
    with_friction,
)
from kaidan.physics import Outcome, run
from kaidan.question import Question

AROUND = 2.0
"""First step of the search for a bracket [deg]; doubled as long as it is too short."""


class Found(NamedTuple):
    """What a search found."""

    value: float
    """Slope [deg] or friction [1]; NaN: no bracket."""
    resolution: float
    """Width of the last bracket [deg]; of friction, as an angle of friction."""
    ended: str
    """Outcome of the last trial that did not climb; empty: every one climbed."""
    trials: int


def steepest_climbed(question: Question, near: float, resolution: float) -> Found:
    """Steepest flight that the smooth belt climbs, by bisection: its outcome is monotone in slope.

    near: where to begin [deg]; NaN: in the middle.
    resolution: width of the last bracket [deg].

    The middle of the last bracket [deg].
    """
    plenty = with_friction(question, PLENTY)
    least, most = (math.degrees(each) for each in slopes(question))
    ended, trials = "", 0

    def climbs(angle: float) -> bool:
        nonlocal ended, trials
        trials += 1
        outcome = run(trial_of(at_angle(plenty, math.radians(angle)))).outcome
        if outcome is not Outcome.CLIMBED:
            ended = outcome.value
        return outcome is Outcome.CLIMBED

    middle = 0.5 * (least + most)
    low = high = min(max(near if math.isfinite(near) else middle, least), most)
    first, step = climbs(low), AROUND
    if first:
        while climbs(high := min(low + step, most)):
            if high == most:
                return Found(math.nan, math.nan, "", trials)
            low, step = high, 2 * step
    else:
        while not climbs(low := max(high - step, least)):
            if low == least:
                return Found(math.nan, math.nan, ended, trials)
            high, step = low, 2 * step
    while high - low > resolution:
        angle = 0.5 * (low + high)
        low, high = (angle, high) if climbs(angle) else (low, angle)
    return Found(0.5 * (low + high), high - low, ended, trials)


def friction_required(question: Question, formula: float, resolution: float) -> Found:
    """Least friction with which the smooth belt does not slide on the stairs, by bisection.

    formula: what it should be about [1].
    resolution: width of the last bracket, as an angle of friction [deg].

    The middle of the last bracket [1]; NaN where it falls, or slides with plenty.
    """
    trials, ended = 0, ""

    def slides(angle: float) -> bool | None:
        nonlocal trials, ended
        trials += 1
        mu = min(PLENTY, math.tan(math.radians(angle)))
        outcome = run(trial_of(with_friction(question, mu))).outcome
        if outcome is Outcome.CLIMBED:
            return False
        ended = outcome.value
        return outcome in (Outcome.SLID, Outcome.STALLED, Outcome.TIMED_OUT) or None

    centre = math.degrees(math.atan(formula))
    low, high = max(0.5, centre - 1.0), min(centre + 8.0, math.degrees(math.atan(PLENTY)))
    if slides(high) is not False or slides(low) is not True:
        return Found(math.nan, math.nan, ended, trials)
    while high - low > resolution:
        angle = 0.5 * (low + high)
        slid = slides(angle)
        if slid is None:  # it fell while sliding, which takes more friction too
            slid = True
        low, high = (angle, high) if slid else (low, angle)
    return Found(math.tan(math.radians(0.5 * (low + high))), high - low, ended, trials)
