"""Closed form first: cells of which it alone says that they are no GO.

On a uniform flight the criterion of the contact model while the flat lies on the flight is the
closed form: the margins against tipping are the same, required friction and traction are no less,
and every other finding can only lower a verdict. So a margin of the closed form that is not
positive excludes a GO, whatever entering and landing come to. The contrary does not hold: a GO, and
whether it is ROUGH, UNSURE or NO-GO, is for the contact model.

Where the end that leads is to be found, both have to be excluded. Where the flippers' posture is,
nothing is: pressed down or raised they touch what the closed form knows nothing of.
"""

import math
from collections.abc import Sequence

import numpy as np

from kaidan.errors import InputError
from kaidan.mechanics.plane import contact_count
from kaidan.models.drive_limits import steepest_for_drive
from kaidan.models.regular_flight import gap_below
from kaidan.modes import CONTACT, DRIVE, SLIDES_DOWN, SLIDES_UP, TIPS
from kaidan.question import FACINGS, Question
from kaidan.sweeps.pairs import verdicts
from kaidan.terrain.stairs import Stairs

CLEAR = math.radians(0.01)
"""How far beyond a limit a cell must be to be excluded [rad]: far more than both models differ."""
_BEYOND_THE_FLAT = 2
"""Nosings that a flight needs beyond those that the flat holds at once, so that it lies on them
alone at every phase of the spacing."""


def applies(question: Question) -> bool:
    """Whether the closed form may exclude a cell."""
    flight = question.terrain
    if not isinstance(flight, Stairs) or flight.rise is None or question.model != CONTACT.name:
        return False
    if question.best_of or question.changes or question.yaw or question.uncertain:
        return False
    if question.robot.com_range is not None:
        return False
    if gap_below(question):
        return False
    held = int(contact_count(L=question.stance.flat_length, p=flight.nosing_spacing))
    return len(flight.step_rises) >= held + 1 + _BEYOND_THE_FLAT


def excluded(questions: Sequence[Question | InputError]) -> list[str | None]:
    """Failure mode by which the closed form excludes a GO, of each question; None: it does not.

    Parameters
    ----------
    questions : sequence of Question or InputError
        One that was refused is not excluded.
    """
    ways = [_ways(one) if isinstance(one, Question) else () for one in questions]
    judged = iter(_excluded([way for each in ways for way in each]))
    found: list[str | None] = []
    for each in ways:
        keys = [next(judged) for _ in each]
        found.append(keys[0] if keys and None not in keys else None)
    return found


def _ways(question: Question) -> tuple[Question, ...]:
    """Question as it may be driven: the one that is stated, or with either end first."""
    if question.best_of != ("facing",):
        return (question,)
    return tuple(question.changed(best_of=(), facing=facing) for facing in FACINGS)


def _excluded(questions: Sequence[Question]) -> list[str | None]:
    """Failure mode that excludes a GO, of each question; None: it does not."""
    found: list[str | None] = [None] * len(questions)
    each = [(k, one) for k, one in enumerate(questions) if applies(one)]
    if not each:
        return found
    inputs = np.array([_inputs(one) for _, one in each]).T
    names = ("flat_length", "com_from_uphill", "com_height", "angle", "nosing_spacing", "friction",
             "acceleration", "theta_d", "theta_M")  # fmt: skip
    answer = verdicts(dict(zip(names, inputs, strict=True)), engine="numpy", checked=False)
    drive = np.array([steepest_for_drive(one, one.acceleration) for _, one in each]) - inputs[3]
    margins = {
        TIPS[0].key: answer.tip_downhill,
        TIPS[1].key: answer.tip_uphill,
        SLIDES_DOWN.key: answer.slides_down,
        SLIDES_UP.key: answer.slides_up,
        DRIVE.key: drive,
    }
    grousers = np.array([one.robot.track.has_grousers for _, one in each])
    for key in (SLIDES_DOWN.key, SLIDES_UP.key):  # a tip on a tread holds with less
        margins[key] = np.where(grousers, np.nan, margins[key])
    table = np.array(list(margins.values()))
    least = np.fmin.reduce(table, axis=0)
    for (k, _), margin, column in zip(each, least, table.T, strict=True):
        if margin < -CLEAR:
            found[k] = list(margins)[int(np.nanargmin(column))]
    return found


def _inputs(question: Question) -> tuple[float, ...]:
    stance, flight = question.stance, question.terrain
    assert isinstance(flight, Stairs)
    L, C_L = stance.flat_length, stance.com_from_front
    return (
        L,
        C_L if question.nose_up else L - C_L,
        stance.com_height,
        flight.angle,
        flight.nosing_spacing,
        question.friction[0],
        question.acceleration,
        question.allowance_d.high,
        question.allowance_M.high,
    )
