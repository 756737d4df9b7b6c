"""What each model says of the stairs in one word, by the one policy of verdicts."""

import math
from dataclasses import replace

from kaidan.assessment.verdict import conclude
from kaidan.contact import Status
from kaidan.lab.cross_check.common_question import FlightTraverse, static_criterion
from kaidan.models import closed_form, contact_model, dynamic
from kaidan.models.findings import Finding, Findings
from kaidan.modes import (
    CONTACT,
    FAILURE_MODES,
    FALLS,
    SLIDES_DOWN,
    SLIDES_UP,
    STUCK,
    TIP_DOWNHILL,
    TIP_UPHILL,
    TIPS,
    FailureMode,
    Verdict,
)
from kaidan.physics import TrialResult
from kaidan.question import Question

HOLDS, OUTSIDE = "holds", "outside"
WORDS: dict[FailureMode, str] = {
    **dict.fromkeys((*TIPS, *FALLS), "tips"),
    SLIDES_DOWN: "slides",
    SLIDES_UP: "slides",
    STUCK: "gets stuck",
}
"""Modes that all models can be compared by; the others are what one of them alone knows."""
_FELL = (Status.FELL_BACKWARD, Status.FELL_FORWARD)


def outcome(question: Question, found: Findings) -> str:
    """What findings come to, as one of `WORDS`, "holds" or "outside"."""
    shared = tuple(one for one in found.each if one.mode in WORDS)
    conclusion = conclude(question, replace(found, each=shared))
    if conclusion.verdict is Verdict.OUTSIDE_MODEL:
        return OUTSIDE
    mode = FAILURE_MODES.get(conclusion.governs)
    holds = conclusion.verdict in (Verdict.GO, Verdict.ROUGH)
    return HOLDS if holds or mode is None else WORDS[mode]


def by_closed_form(question: Question) -> str:
    """Of the paper's criterion."""
    return outcome(question, closed_form.judge(question))


def by_static_criterion(question: Question, required_friction: float) -> str:
    """Of the same criterion on poses, with the closed form's required friction [1]."""
    downhill, uphill = static_criterion(question)
    if math.isnan(downhill) or math.isnan(uphill):
        return outcome(question, Findings(model=CONTACT.name, outside="no nosing is lost"))
    found = _found(
        Finding.certain(TIP_DOWNHILL, downhill, model=CONTACT.name),
        Finding.certain(TIP_UPHILL, uphill, model=CONTACT.name),
        _supply(question, required_friction),
    )
    return outcome(question, found)


def by_traverse(question: Question, traverse: FlightTraverse) -> str:
    """Of the contact model on the flight alone; a rotation that is arrested holds."""
    status = traverse.status
    if status is Status.OK:
        found = _found(_supply(question, traverse.required_friction))
    elif status in _FELL:
        over_trailing_end = status is Status.FELL_BACKWARD
        downhill = over_trailing_end == (question.direction == "up")
        mode = TIP_DOWNHILL if downhill else TIP_UPHILL
        found = _found(Finding.certain(mode, -math.inf, model=CONTACT.name))
    elif status is Status.STUCK and not question.acceleration:  # else it tells of the model
        found = _found(Finding.certain(STUCK, -math.inf, model=CONTACT.name))
    else:
        found = Findings(model=CONTACT.name, outside=status.message)
    return outcome(question, found)


def from_the_landing(question: Question) -> str:
    """Of the contact model from landing to landing; a rotation that is arrested holds."""
    without = question.changed(fall_reserve=0.0)
    return outcome(without, contact_model.judge(without))


def by_trial(question: Question, result: TrialResult) -> str:
    """Of a trial."""
    return outcome(question, dynamic.findings_of([(result,)]))


def _found(*each: Finding) -> Findings:
    return Findings(model=CONTACT.name, each=each)


def _supply(question: Question, required: float) -> Finding:
    """Finding of sliding, from the required friction [1]."""
    margin = math.atan(question.friction[0]) - math.atan(required)
    return Finding.certain(SLIDES_DOWN, margin, model=CONTACT.name)
