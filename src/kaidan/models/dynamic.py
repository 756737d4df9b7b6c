"""The dynamic model: trials in MuJoCo with a smooth rigid belt, from landing to landing.

A trial says whether the robot arrives, not by how much: its margins are not known, so it can refute
but never give a GO.
"""

import math

import numpy as np

from kaidan.errors import InputError
from kaidan.models.dynamic_figures import PhysicsFigures, TrialFigures
from kaidan.models.findings import Finding, Findings
from kaidan.modes import (
    PHYSICS,
    SLIDES_DOWN,
    SLIDES_UP,
    STUCK,
    TIP_DOWNHILL,
    TIP_UPHILL,
    FailureMode,
)
from kaidan.physics import Outcome, TrialResult, TrialSpec, run
from kaidan.question import Question
from kaidan.surface import Surface
from kaidan.text import dynamic as text

FAILS = -math.inf
"""Margin of what a trial failed by: by how much is not known."""


def judge(question: Question, *, known: Findings | None = None) -> Findings:
    """Findings of a trial with the smallest friction, and of one with the largest if it differs.

    Parameters
    ----------
    question : Question
        On one flight, several, or a profile.
    known : Findings, optional
        Of a similar question; not used.

    Returns
    -------
    Findings

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed.
    """
    try:
        return findings_of([run(spec) for spec in specs_of(question)])
    except InputError as error:
        return Findings(model=PHYSICS.name, outside=str(error).removeprefix("trial: "))


def specs_of(question: Question) -> list[TrialSpec]:
    """Trials of a question from the landing, that with the smallest friction first.

    Raises
    ------
    InputError
        A question that trials cannot be made of.
    """
    surfaces: list[Surface | None] = [None]
    if question.surface is not None:
        surfaces = [Surface.of_friction(mu) for mu in sorted(set(question.friction))]
    dimensions = 3 if question.yaw else 2
    return [
        TrialSpec(
            question=question.changed(surface=surface), begin="landing", dimensions=dimensions
        )
        for surface in surfaces
    ]


def findings_of(trials: list[TrialResult]) -> Findings:
    """Findings of trials that differ by their friction, the smallest first.

    A range of friction is a failure for certain where the trials at both of its ends fail.
    """
    figures = PhysicsFigures(
        speed_m_s=trials[0].speed_m_s, trials=tuple(_figures(trial) for trial in trials)
    )
    for trial in trials:
        if trial.outcome in (Outcome.UNSTABLE, Outcome.START_FALL):
            return Findings(model=PHYSICS.name, outside=text.no_evidence(trial), figures=(figures,))
    failed = [(mode, trial) for trial in trials if (mode := failure_of(trial)) is not None]
    certain = len(failed) == len(trials)
    each: dict[FailureMode, Finding] = {}
    for mode, trial in reversed(failed):  # of the largest friction first: the best case
        best = FAILS if certain and not each else math.nan
        each.setdefault(
            mode,
            Finding(
                mode=mode,
                worst=np.array([FAILS]),
                best=np.array([best]),
                phase=trial.phase,
                step=trial.step,
                model=PHYSICS.name,
            ),
        )
    return Findings(
        model=PHYSICS.name,
        each=tuple(each.values()),
        figures=(figures,),
        notes=text.notes(trials),
        basis=trials,
    )


def failure_of(trial: TrialResult) -> FailureMode | None:
    """Failure mode of a trial that says something; None: it arrived."""
    question = trial.spec.question
    if trial.outcome is Outcome.CLIMBED:
        return None
    if trial.outcome is Outcome.SLID and question.surface is not None:
        behind_the_belt = trial.slip_m > 0
        return SLIDES_DOWN if behind_the_belt == (question.direction == "up") else SLIDES_UP
    if trial.outcome in (Outcome.SLID, Outcome.TIMED_OUT):  # with a friction beyond any real one
        return STUCK
    over_its_tail = trial.outcome is Outcome.FELL_BACKWARD
    return TIP_DOWNHILL if over_its_tail == question.nose_up else TIP_UPHILL


def _figures(trial: TrialResult) -> TrialFigures:
    return TrialFigures(
        friction=trial.friction,
        outcome=trial.outcome.value,
        phase=trial.phase,
        step=trial.step,
        largest_extra_deg=trial.largest_extra_deg,
        slip_mm=1e3 * trial.slip_m,
        time_s=trial.time_s,
    )
