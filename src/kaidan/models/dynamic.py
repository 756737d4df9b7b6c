"""The dynamic model: trials in MuJoCo, or of a yielding belt in the plane, from landing to landing.

A trial says whether the robot arrives, not by how much, and its track is a model that no rig has
confirmed: its margins are not known, so it can refute but never give a GO. Many trials, with inputs
drawn of their doubt, say besides how often.
"""

import math
from collections import Counter
from collections.abc import Sequence

import numpy as np

from kaidan.errors import InputError
from kaidan.models.drawn_trials import drawn_specs
from kaidan.models.dynamic_figures import PhysicsFigures, TrialFigures
from kaidan.models.findings import Finding, Findings
from kaidan.models.proportion import interval
from kaidan.models.sentences import dynamic as text
from kaidan.modes import (
    FAILS_IF_KNOWN,
    PHYSICS,
    SLIDES_DOWN,
    SLIDES_UP,
    STUCK,
    TIP_DOWNHILL,
    TIP_UPHILL,
    FailureMode,
    Phase,
)
from kaidan.physics import Outcome, TrialResult, run
from kaidan.question import Question

FAILS = -math.inf
"""Margin of what a trial failed by: by how much is not known."""
HOLDS = math.inf
"""Margin of what a trial among many did not fail by, likewise."""

Draw = tuple[TrialResult, ...]
"""Trials that differ by their friction alone, the smallest first."""


def judge(question: Question, *, known: Findings | None = None) -> Findings:
    """Findings of a question's trials; of each draw one at either end of the friction.

    Parameters
    ----------
    question : Question
        On one flight, several, or a profile.
    known : Findings, optional
        Of a similar question; not used.

    Raises
    ------
    MissingExtraError
        MuJoCo is not installed.
    """
    try:
        draws = [tuple(run(spec) for spec in specs) for specs in drawn_specs(question)]
    except InputError as error:
        return Findings(model=PHYSICS.name, outside=str(error).removeprefix("trial: "))
    return findings_of(draws, risk=question.risk)


def findings_of(draws: Sequence[Draw], *, risk: float = 0.01) -> Findings:
    """Findings of draws.

    A draw fails in the worst case where one of its trials does, and in the best case where all do.
    Many draws fail for certain where the interval of their share lies above the risk.

    risk: probability of failure that is accepted [1].
    """
    figures = figures_of(draws)
    for trial in (trial for draw in draws for trial in draw):
        if trial.outcome in (Outcome.UNSTABLE, Outcome.START_FALL):
            return Findings(model=PHYSICS.name, outside=text.no_evidence(trial), figures=(figures,))
    alone = len(draws) == 1
    certain = alone or interval(figures.failed_best, len(draws))[0] > risk
    told = alone or figures.failed > int(risk * len(draws))
    return Findings(
        model=PHYSICS.name,
        each=tuple(_each(draws, certain=certain)) if told else (),
        figures=(figures,),
        notes=text.notes([trial for draw in draws for trial in draw], figures),
        basis=draws,
    )


def figures_of(draws: Sequence[Draw]) -> PhysicsFigures:
    """Figures of draws."""
    fails = [[failure_of(trial) is not None for trial in draw] for draw in draws]
    failed = sum(map(any, fails))
    first = draws[0][0]
    return PhysicsFigures(
        track=first.spec.track.kind,
        speed_m_s=first.speed_m_s,
        draws=len(draws),
        failed=failed,
        failed_best=sum(map(all, fails)),
        failure_interval=interval(failed, len(draws)),
        trials=tuple(_figures(k, trial) for k, draw in enumerate(draws) for trial in draw),
    )


def _each(draws: Sequence[Draw], *, certain: bool) -> list[Finding]:
    """Finding of each mode by which a trial failed, those that fail in the best case first."""
    holds = math.nan if len(draws) == 1 else HOLDS
    worst: dict[FailureMode, np.typing.NDArray[np.float64]] = {}
    best: dict[FailureMode, np.typing.NDArray[np.float64]] = {}
    where: dict[FailureMode, Counter[tuple[Phase | None, int | None]]] = {}
    for k, draw in enumerate(draws):
        failed = [(mode, trial) for trial in draw if (mode := failure_of(trial)) is not None]
        for at, (mode, trial) in enumerate(reversed(failed)):  # of the largest friction first
            if mode not in worst:
                worst[mode] = np.full(len(draws), holds)
                best[mode] = np.full(len(draws), holds)
                where[mode] = Counter()
            worst[mode][k] = FAILS
            where[mode][trial.phase, trial.step] += 1
            if at == 0:
                best[mode][k] = FAILS if certain and len(failed) == len(draw) else math.nan
    found = []
    for mode, margins in worst.items():
        (phase, step), _ = where[mode].most_common(1)[0]
        found.append(
            Finding(
                mode=mode,
                worst=margins,
                best=best[mode],
                instead=FAILS_IF_KNOWN,
                phase=phase,
                step=step,
                model=PHYSICS.name,
            )
        )
    return found


def failure_of(trial: TrialResult) -> FailureMode | None:
    """Failure mode of a trial that says something; None: it arrived."""
    question = trial.spec.question
    if trial.outcome is Outcome.CLIMBED:
        return None
    if trial.outcome is Outcome.SLID and question.surface is not None:
        behind_the_belt = trial.slip_m > 0
        return SLIDES_DOWN if behind_the_belt == (question.direction == "up") else SLIDES_UP
    if trial.outcome in (
        Outcome.SLID,
        Outcome.STALLED,
        Outcome.TIMED_OUT,
    ):  # with a friction beyond any real one
        return STUCK
    over_its_tail = trial.outcome is Outcome.FELL_BACKWARD
    return TIP_DOWNHILL if over_its_tail == question.nose_up else TIP_UPHILL


def _figures(draw: int, trial: TrialResult) -> TrialFigures:
    return TrialFigures(
        draw=draw,
        friction=trial.friction,
        outcome=trial.outcome.value,
        phase=trial.phase,
        step=trial.step,
        largest_extra_deg=trial.largest_extra_deg,
        slip_mm=1e3 * trial.slip_m,
        time_s=trial.time_s,
    )
