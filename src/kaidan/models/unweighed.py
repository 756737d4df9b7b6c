"""A robot that nobody weighed: its centroid is anywhere in a range, and each place is judged.

The worst case of a failure mode is the worst of all places, as of a range of friction. The best
case is that of ONE place, the best of them, because a robot has one centroid: of each mode by
itself the best place would be another, and a NO-GO would be missed where no place holds.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np

from kaidan.errors import InputError
from kaidan.models.findings import Finding, Findings, hardest, sliding_where
from kaidan.models.sentences import unweighed as text
from kaidan.modes import FAILURE_MODES, UNWEIGHED, FailureMode, Verdict
from kaidan.question import Question
from kaidan.robot import CentroidRange

PLACES = 5
"""Places along the track that are judged; between them the margins bend by little."""
HEIGHTS = 2
"""Heights that are judged: a higher centroid is worse, so both ends say all."""

Judge = Callable[[Question], Findings]


class Placed(NamedTuple):
    """A centroid of the range, and what a model finds of the robot that has it."""

    com_from_front: float
    com_height: float
    question: Question
    found: Findings


def judge_range(question: Question, judge: Judge) -> Findings:
    """Findings of a robot whose centroid is anywhere in its range.

    question: of a robot with `com_range`.

    Their `basis` is the list of `Placed`, by height and then along the track.
    """
    placed = list(_judged(question, judge))
    answered = [each for each in placed if not each.found.outside]
    if not answered:
        return replace(placed[0].found, basis=placed)
    best = max(answered, key=lambda each: _merit(each.found, question.risk))
    middle = min(answered, key=lambda each: _off_the_middle(each, question))
    needed = [each.found.required_friction for each in answered]
    most = answered[hardest(needed)].found.each
    merged = [
        sliding_where(most, one)
        for mode in FAILURE_MODES.values()
        if (one := _merged(mode, answered, best)) is not None
    ]
    merged.append(
        Finding(
            mode=UNWEIGHED,
            worst=np.array([-math.inf]),
            best=np.array([math.inf]),
            model=middle.found.model,
        )
    )
    return replace(
        middle.found,
        each=tuple(merged),
        required_friction=max(needed),
        notes=(
            text.OF_THE_MIDDLE,
            *((text.OUTSIDE_SOMEWHERE,) if len(answered) < len(placed) else ()),
            *middle.found.notes,
        ),
        basis=placed,
    )


def at(question: Question, com_from_front: float, com_height: float, judge: Judge) -> Placed:
    """One centroid, judged."""
    robot = question.robot.with_centroid(com_from_front, com_height)
    weighed = question.changed(robot=robot)
    return Placed(com_from_front, com_height, weighed, judge(weighed))


def places(low_high: tuple[float, float], count: int) -> list[float]:
    """Places evenly over a range; one where it has no width."""
    return sorted({float(each) for each in np.linspace(*low_high, count)})


def _judged(question: Question, judge: Judge) -> Iterable[Placed]:
    assert question.robot.com_range is not None
    span: CentroidRange = question.robot.com_range
    grid = product(places(span.height, HEIGHTS), places(span.from_front, PLACES))
    refused: InputError | None = None
    some = False
    for height, along in grid:
        try:
            yield at(question, along, height, judge)
            some = True
        except InputError as error:
            refused = error
    if not some and refused is not None:
        raise refused


def _merit(found: Findings, risk: float) -> tuple[bool, bool, float]:
    """How good a place is: whether it arrives, whether nothing fails, and by how much."""
    fails = [one for one in found.each if one.margin(risk, best=True) <= 0]
    slopes = [one.margin(risk, best=True) for one in found.each if one.mode.unit == "rad"]
    known = [each for each in slopes if not math.isnan(each)]
    arrives = not any(one.if_fails.best is Verdict.NO_GO for one in fails)
    return arrives, not fails, min(known, default=-math.inf)


def _off_the_middle(placed: Placed, question: Question) -> float:
    along, height = question.robot.com_from_front, question.robot.com_height
    return abs(placed.com_from_front - along) + 1e-3 * abs(placed.com_height - height)


def _merged(mode: FailureMode, answered: list[Placed], best: Placed) -> Finding | None:
    """Worst of all places with its place, and the best case of the best one."""
    each = [one for placed in answered if (one := placed.found.of(mode)) is not None]
    if not each:
        return None
    worst = min(each, key=lambda one: _lowest(one.worst))
    of_best = best.found.of(mode)
    samples = np.broadcast_arrays(*(one.worst for one in each))
    return replace(
        worst,
        worst=np.asarray(np.fmin.reduce(samples)),
        best=np.array([math.inf]) if of_best is None else of_best.best,
        instead=None if of_best is None else of_best.instead,
    )


def _lowest(samples: "np.typing.NDArray[np.float64]") -> float:
    return float(np.nanmin(samples)) if not np.isnan(samples).all() else math.inf
