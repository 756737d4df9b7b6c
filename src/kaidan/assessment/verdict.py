"""From findings to a verdict: one policy, whichever model found them and of whichever phase.

- OUTSIDE THE MODEL: the model says nothing.
- NO-GO: more samples than the accepted risk fail in the best case, by a mode that is a failure.
- CAUTION: more than that fail in the worst case by any mode; or friction, or the margin against
  tipping, or any margin of slope, is not known.
- GO: else.

An operator who accepts an arrested rotation waives tipping and rotation of a robot that arrives,
and takes the momentum that a plastic impact leaves as what decides.
"""

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from kaidan.models.findings import Array, Finding, Findings, at_risk, failing_beyond, smallest
from kaidan.modes import (
    FAILURE_MODES,
    GAP,
    MOMENTUM,
    ROTATION,
    SUPPLIES,
    TIPS,
    UNWEIGHED,
    Acceptance,
    Phase,
    Undecided,
    Verdict,
)
from kaidan.question import Question

WAIVED = (*TIPS, ROTATION)
"""Modes that an operator who accepts an arrested rotation waives, where the robot arrives."""
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
        Risk, acceptance, and whether friction is known.
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
    each = _accepted(question, found.each)
    slopes = [one for one in each if one.mode.unit == "rad"]
    samples = smallest(one.worst for one in slopes) if slopes else np.array([math.nan])
    best = smallest(one.best for one in slopes) if slopes else np.array([math.nan])
    margin, margin_best = (min(at_risk(values, question.risk), FALL) for values in (samples, best))
    failures = [one for one in each if one.failing is Verdict.NO_GO]
    doubts = _doubts(each, question)
    friction_known = question.surface is not None
    governing: Finding | None
    if _beyond(failures, question.risk, best=True):
        verdict = Verdict.NO_GO
        governing = _deciding(failures, question)
    elif _beyond(each, question.risk):
        verdict = Verdict.CAUTION
        governing = doubts[0]
    else:
        governing = None if _tipping_unknown(each) else _nearest(each, question)
        verdict = Verdict.GO if governing and friction_known else Verdict.CAUTION
    key = governing.mode.key if governing else Undecided.MARGIN_UNKNOWN.value
    if verdict is Verdict.CAUTION and not doubts and not friction_known:
        governing = next((one for one in each if one.mode in SUPPLIES), None)
        key = Undecided.FRICTION_UNKNOWN.value
    if verdict is Verdict.NO_GO and not margin_best <= 0:  # no slope of the stairs would do
        margin = margin_best = -FALL
    phase, step = (governing.phase, governing.step) if governing else (None, None)
    return Conclusion(verdict, key, phase, step, margin, margin_best, samples, tuple(doubts))


def _tipping_unknown(each: Iterable[Finding]) -> bool:
    """Whether the margin against tipping somewhere is what the model should know and does not."""
    return any(one.mode in TIPS and bool(np.isnan(one.worst).all()) for one in each)


def _accepted(question: Question, each: tuple[Finding, ...]) -> list[Finding]:
    """Findings that count, by what the operator accepts."""
    if question.accept is not Acceptance.ARRESTED:
        return list(each)
    kept = []
    for one in each:
        if one.mode in WAIVED and one.failing is Verdict.CAUTION:
            continue
        kept.append(replace(one, worst=one.best) if one.mode is MOMENTUM else one)
    return kept


def _beyond(each: list[Finding], risk: float, *, best: bool = False) -> bool:
    """Whether more samples than the accepted share fail by any of the findings."""
    rows = [one.best if best else one.worst for one in each]
    if all(len(row) == 1 for row in rows):  # of one sample no share is accepted
        return any(row.item() <= 0 for row in rows)
    return failing_beyond((one.fails(best=best) for one in each), risk)


def _doubts(each: list[Finding], question: Question) -> list[Finding]:
    """What fails beyond the risk alone; where nothing does, what fails beyond it together."""
    some = [one for one in each if _beyond([one], question.risk)]
    if not some and _beyond(each, question.risk):
        some = [one for one in each if one.fails().any()]
    return sorted(some, key=lambda one: _order(one, question))


def _order(one: Finding, question: Question, *, best: bool = False) -> tuple[int, float, int]:
    """Order of what fails: margins of slope first, the smallest first; then as they are listed."""
    listed = list(FAILURE_MODES).index(one.mode.key)
    if one.mode in (UNWEIGHED, GAP):  # before what follows from it
        return -1, 0.0, -listed
    if one.mode.unit != "rad":
        return 1, 0.0, listed
    return 0, one.margin(question.risk, best=best), listed


def _deciding(failures: list[Finding], question: Question) -> Finding:
    """Failure that decides a NO-GO: of those that fail alone, else of all, the smallest margin.

    In the best case, which a NO-GO fails in: 0.96 of friction where 0.6 to 1.0 is stated may hold,
    a fall of the same robot does not.
    """
    alone = [one for one in failures if _beyond([one], question.risk, best=True)]
    return min(alone or failures, key=lambda one: _order(one, question, best=True))


def _nearest(each: list[Finding], question: Question) -> Finding | None:
    """Mode with the smallest known margin of slope; None: none is known."""
    known = [
        one for one in each if one.mode.unit == "rad" and math.isfinite(one.margin(question.risk))
    ]
    return min(known, key=lambda one: one.margin(question.risk), default=None)
