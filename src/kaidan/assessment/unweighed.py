"""At which centroid of a range the verdict changes: judged, concluded, and sought by bisection."""

from collections.abc import Iterator
from itertools import groupby, pairwise
from typing import Literal

from kaidan.answer import Part
from kaidan.assessment.verdict import Conclusion, conclude
from kaidan.errors import InputError
from kaidan.models import judge
from kaidan.models.findings import Findings
from kaidan.models.unweighed import Placed, at
from kaidan.question import Question

FINE = 1e-3
"""How exactly a change of the verdict is sought along the track [m]: as exactly as a tape is."""


class Stretch(Part):
    """Centroids of one height with one verdict, were the robot weighed."""

    height_m: float
    """C_N [m]."""
    from_m: float
    """C_L where it begins [m]."""
    to_m: float
    """C_L where it ends [m]."""
    verdict: Literal["go", "rough", "unsure", "no-go", "outside-model"]
    """Verdict of all of it."""
    governs: str
    """What decides at its middle, or at the judged place next to it."""


class CentroidShown(Part):
    """A centroid that nobody measured: where it may be, and what each place would come to."""

    from_front_m: tuple[float, float]
    """C_L, lowest and highest [m]."""
    height_m: tuple[float, float]
    """C_N, lowest and highest [m]."""
    stretches: tuple[Stretch, ...]
    """Verdicts along the track, for the lowest and for the highest C_N."""


def stretches(question: Question, found: Findings) -> CentroidShown:
    """Verdicts over the range of a centroid.

    question: of a robot with `com_range`.
    found: of the question, by `kaidan.models.judge`.
    """
    span = question.robot.com_range
    assert span is not None
    each: list[Stretch] = []
    for _, row in groupby(found.basis, key=lambda placed: placed.com_height):
        each += _along(question, list(row))
    return CentroidShown(from_front_m=span.from_front, height_m=span.height, stretches=tuple(each))


def _along(question: Question, row: list[Placed]) -> Iterator[Stretch]:
    """Stretches of one height."""
    known = [(placed.com_from_front, conclude(placed.question, placed.found)) for placed in row]
    height = row[0].com_height
    begins, (_, now) = known[0][0], known[0]
    for (low, _), (high, then) in pairwise(known):
        while now.verdict is not then.verdict:  # others may lie in between
            change, low, beyond = _change(question, height, (low, high), now, then)
            yield _stretch(height, begins, change, now)
            begins, now = change, then if beyond.verdict is then.verdict else beyond
    yield _stretch(height, begins, known[-1][0], now)


def _stretch(height: float, low: float, high: float, conclusion: Conclusion) -> Stretch:
    return Stretch(
        height_m=height,
        from_m=low,
        to_m=high,
        verdict=conclusion.verdict.value,
        governs=str(conclusion.governs),
    )


def _change(
    question: Question,
    height: float,
    between: tuple[float, float],
    now: Conclusion,
    then: Conclusion,
) -> tuple[float, float, Conclusion]:
    """Place between two at which the verdict is no longer the first one's, and a place beyond [m].

    The last is the conclusion there.
    """
    low, high = between
    while high - low > FINE:
        middle = (low + high) / 2
        try:
            placed = at(question, middle, height, judge)
        except InputError:  # where the robot cannot have it
            return middle, high, then
        found = conclude(placed.question, placed.found)
        if found.verdict is now.verdict:
            low = middle
        else:
            high, then = middle, found
    return (low + high) / 2, high, then
