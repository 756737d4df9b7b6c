"""Why two models are likely to differ, and why one of them gives no answer."""

import math
from typing import NamedTuple

from kaidan.contact import Status
from kaidan.lab.cross_check import sentences as said
from kaidan.lab.cross_check.answer import ComparisonName, JudgeName, Value
from kaidan.lab.cross_check.bands import FALLING
from kaidan.lab.cross_check.common_question import (
    FlightTraverse,
    at_angle,
    speed_of,
    stairs_of,
)
from kaidan.models.closed_form import judge
from kaidan.models.sentences.dynamic import no_evidence
from kaidan.physics import Outcome, TrialResult
from kaidan.question import Question


class Context(NamedTuple):
    """What causes are read from."""

    question: Question
    traverse: FlightTraverse
    result: TrialResult
    limit: float | None
    """Steepest flight of the contact model [deg]; None: it has none."""


def why_not(judge_name: JudgeName, answer: Value, context: Context, *, name: ComparisonName) -> str:
    """Why a model gives no answer that could be compared; empty where it does.

    answer: its number or word, None where it has none.
    """
    if answer not in (None, "outside"):
        return ""
    outcome = context.result.outcome
    if judge_name in ("closed_form", "static_criterion"):
        question = context.question
        if name != "stairs":
            question = at_angle(question, math.radians(40.0))
        return said.outside(judge(question).outside)
    if judge_name == "contact":
        if name == "steepest_flight":
            return said.never_arrives()
        return said.contact_model(context.traverse.status.message)
    if outcome in (Outcome.UNSTABLE, Outcome.START_FALL):
        return no_evidence(context.result)
    return said.NO_TRIAL.get(name, said.NO_TRIAL["flight"])


def cause_of(name: ComparisonName, of: JudgeName, less: JudgeName, context: Context) -> str:
    """Likely cause of a difference that is not within its band.

    The first that applies; these are hypotheses from what is known to part the models, not
    findings.
    """
    question, result, track = context.question, context.result, context.question.robot.track
    speed, physics = speed_of(question), "physics" in (of, less)
    rotation = math.degrees(context.traverse.rotation)
    slides = result.outcome in (Outcome.SLID, Outcome.TIMED_OUT)
    arrives = context.traverse.status is Status.OK
    flippers = question.robot.front_flippers, question.robot.rear_flippers
    causes = (
        (
            physics and slides and name in ("stairs", "extra"),
            said.too_slippery(result.friction),
        ),
        (physics and speed > FALLING[-1][0], said.too_fast(speed)),
        (physics and question.acceleration != 0.0, said.CAUSES["acceleration"]),
        (name == "stairs" and result.spec.begin == "landing", said.CAUSES["landing"]),
        (
            name in ("stairs", "extra") and result.fell and arrives and rotation > 1.0,
            said.momentum(rotation),
        ),
        (flippers != (None, None), said.CAUSES["flippers"]),
        (name == "stairs" and stairs_of(question).irregularity > 1e-4, said.CAUSES["uneven"]),
        (_close_to_limit(context), said.CAUSES["limit"]),
        (track.rear_radius != track.front_radius, said.CAUSES["radii"]),
    )
    return next((text for applies, text in causes if applies), said.CAUSES["unknown"])


def _close_to_limit(context: Context) -> bool:
    angle = math.degrees(stairs_of(context.question).angle)
    return context.limit is not None and abs(context.limit - angle) < 2.0
