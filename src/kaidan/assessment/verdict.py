"""From findings to a verdict: one policy, whichever model found them and of whichever phase.

Each finding has a verdict of its own: `kaidan.modes` says of its failure mode which, where it fails
in the best case, in the worst case only, or is not known. Of a sample the worst counts, and over
the samples the one that no more than the accepted share exceeds.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import reduce
from itertools import chain
from typing import NamedTuple

import numpy as np

from kaidan.models.findings import Array, Finding, Findings, at_risk, smallest
from kaidan.modes import (
    FAILURE_MODES,
    FALL_DOWNHILL,
    FALL_UPHILL,
    FALLS,
    GAP,
    OPEN,
    ROTATION,
    TIP_DOWNHILL,
    TIP_UPHILL,
    TIPS,
    UNWEIGHED,
    Phase,
    Undecided,
    Verdict,
)
from kaidan.question import Question

_FALL_OF = {TIP_DOWNHILL: FALL_DOWNHILL, TIP_UPHILL: FALL_UPHILL, ROTATION: FALL_DOWNHILL}
"""Modes of a robot that rocks, and which tilt to the fall tells whether it arrives."""
FALL = math.pi / 2
"""Margin of a robot of which no slope makes it fail [rad]."""


class Conclusion(NamedTuple):
    """What the findings come to."""

    verdict: Verdict
    governs: str
    """Key of a failure mode, or one of `Undecided`."""
    phase: Phase | None
    step: int | None
    margin: float
    """Smallest margin of slope in the worst case, at the risk [rad]; NaN: not known."""
    margin_best: float
    """The same in the best case [rad]."""
    samples: Array
    """Smallest margin of slope of each sample in the worst case [rad]."""
    doubts: tuple[Finding, ...]
    """What keeps it from being a GO, the most important first."""


def conclude(question: Question, found: Findings) -> Conclusion:
    """Conclude from findings.

    Parameters
    ----------
    question : Question
        Risk, and whether friction is known.
    found : Findings
        Of one model.
    """
    if found.outside:
        nan = math.nan
        return Conclusion(
            Verdict.OUTSIDE_MODEL,
            Undecided.OUTSIDE_MODEL,
            None,
            None,
            nan,
            nan,
            np.array([nan]),
            (),
        )
    each = _with_falls(found.each)
    slopes = [one for one in each if one.mode.unit == "rad"]
    samples = smallest(one.worst for one in slopes) if slopes else np.array([math.nan])
    best = smallest(one.best for one in slopes) if slopes else np.array([math.nan])
    margin, margin_best = (min(at_risk(values, question.risk), FALL) for values in (samples, best))
    doubts = _doubts(each, question)
    verdict = verdict_of(each, question.risk)
    known = any(math.isfinite(one.margin(question.risk)) for one in slopes)
    if verdict is Verdict.NO_GO:
        governing: Finding | None = _deciding(each, question)
    elif verdict is Verdict.GO:
        governing = _nearest(each, question)
    else:
        governing = _undecided(each, doubts, question.risk, verdict)
    if verdict.rank < Verdict.UNSURE.rank and not (known and question.surface is not None):
        verdict, governing = Verdict.UNSURE, None
    key = _key(governing, question, verdict)
    if verdict is Verdict.NO_GO and not margin_best <= 0:  # no slope of the stairs would do
        margin = margin_best = -FALL
    phase, step = (governing.phase, governing.step) if governing else (None, None)
    return Conclusion(verdict, key, phase, step, margin, margin_best, samples, tuple(doubts))


def verdict_of(each: Sequence[Finding], risk: float) -> Verdict:
    """Worst verdict that more samples than the accepted share have."""
    ranks = reduce(np.maximum, (one.verdicts() for one in each), np.zeros(1, dtype=np.int64))
    return tuple(Verdict)[int(np.sort(ranks)[len(ranks) - 1 - int(risk * len(ranks))])]


def _with_falls(each: Sequence[Finding]) -> list[Finding]:
    """Findings, those of rocking open where nothing tells whether the robot falls."""
    known = {one.mode for one in each if one.mode in FALLS}
    return [
        replace(one, instead=OPEN)
        if one.if_fails is one.mode.if_fails
        and _FALL_OF.get(one.mode, one.mode) not in (one.mode, *known)
        else one
        for one in each
    ]


def _key(governing: Finding | None, question: Question, verdict: Verdict) -> str:
    """What governs: a failure mode, or what is not known; without any, nothing is known."""
    if governing is not None and (verdict is not Verdict.UNSURE or governing.fails().any()):
        return governing.mode.key
    tips = governing is not None and governing.mode in TIPS
    unstated = question.surface is None and not tips
    return (Undecided.FRICTION_UNKNOWN if unstated else Undecided.MARGIN_UNKNOWN).value


def _undecided(
    each: Sequence[Finding], doubts: Sequence[Finding], risk: float, verdict: Verdict
) -> Finding:
    """What decides a verdict between GO and NO-GO: what comes to it alone, else with others."""
    some = (*doubts, *each)
    alone = (one for one in some if verdict_of([one], risk) is verdict)
    together = (one for one in some if one.verdicts().max() >= verdict.rank)
    return next(chain(alone, together))


def _doubts(each: Sequence[Finding], question: Question) -> list[Finding]:
    """What fails beyond the risk alone; where nothing does, what fails beyond it together."""
    risk = question.risk
    some = [one for one in each if _fails_alone(one, risk)]
    alone = max((verdict_of([one], risk).rank for one in each), default=Verdict.GO.rank)
    if verdict_of(each, risk).rank > alone:
        some = [one for one in each if one.fails().any()]
    return sorted(some, key=lambda one: (-verdict_of([one], risk).rank, *_order(one, question)))


def _fails_alone(one: Finding, risk: float) -> bool:
    """Whether more samples than the accepted share fail in the worst case."""
    return int(one.fails().sum()) > int(risk * len(one.worst))


def _order(one: Finding, question: Question, *, best: bool = False) -> tuple[int, float, int]:
    """Order of what fails: margins of slope first, the smallest first; then as they are listed."""
    listed = list(FAILURE_MODES).index(one.mode.key)
    if one.mode in (UNWEIGHED, GAP):  # before what follows from it
        return -1, 0.0, -listed
    if one.mode.unit != "rad":
        return 1, 0.0, listed
    return 0, one.margin(question.risk, best=best), listed


def _deciding(each: Sequence[Finding], question: Question) -> Finding:
    """Failure that decides a NO-GO: of those that fail alone, else of all, the smallest margin.

    In the best case, which a NO-GO fails in: 0.96 of friction where 0.6 to 1.0 is stated may hold,
    a fall of the same robot does not.
    """
    failures = [one for one in each if one.if_fails.best is Verdict.NO_GO]
    alone = [one for one in failures if verdict_of([one], question.risk) is Verdict.NO_GO]
    return min(alone or failures, key=lambda one: _order(one, question, best=True))


def _nearest(each: Sequence[Finding], question: Question) -> Finding | None:
    """Mode with the smallest known margin of slope; None: none is known."""
    known = [
        one for one in each if one.mode.unit == "rad" and math.isfinite(one.margin(question.risk))
    ]
    return min(known, key=lambda one: one.margin(question.risk), default=None)
