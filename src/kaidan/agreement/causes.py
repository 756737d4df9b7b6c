"""Why two models are likely to differ, and why one of them gives no answer."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from kaidan.agreement.asked import SPEED, Way, flight_at
from kaidan.agreement.bands import FALLING
from kaidan.assessment.case import Case
from kaidan.assessment.closed_form import judge
from kaidan.contact import Status
from kaidan.physics import Outcome, TrialResult


class Known(NamedTuple):
    """What causes are read from."""

    case: Case
    way: Way
    result: TrialResult
    limits: Mapping[str, Any]
    """Steepest flight by model [deg]."""


def why_not(model: str, answer: object, known: Known, *, question: str = "stairs") -> str:
    """Why a model gives no answer that could be compared; empty where it does.

    Parameters
    ----------
    model : str
        Of `kaidan.agreement.answer.MODELS`.
    answer : object
        Its answer: a word, or None where it has no number.
    known : Known
        What is known.
    question : str
        Name of the question.
    """
    case, outcome = known.case, known.result.outcome
    if answer not in (None, "outside", "unknown"):
        return ""
    if model in ("closed_form", "no_rotation"):
        stairs = case.stairs if question == "stairs" else flight_at(case, math.radians(40.0))
        outside = judge(case.changed(stairs=stairs)).outside
        return f"outside the closed form: {outside}" if outside else "no nosing is lost on the way"
    if model == "contact":
        if question == "steepest_flight":
            return "the contact model does not arrive on the gentlest flight of this spacing"
        return f"contact model: {known.way.status.message}"
    if outcome is Outcome.UNSTABLE:
        return "the simulation diverged, which says nothing about the robot"
    if outcome is Outcome.START_FALL:
        return "the trial falls before the track moves: it cannot stand where it is placed"
    if question == "extra":
        return "the trial falls, so its turn has no largest value"
    if question == "friction":
        return "the trial falls before it slides, or slides with any friction"
    return "trials climb every flight of this spacing that stairs can have, or none"


def cause_of(question: str, of: str, less: str, known: Known) -> str:
    """Likely cause of a difference that is not within its band.

    The first that applies; these are hypotheses from what is known to part the models, not
    findings.
    """
    case, result = known.case, known.result
    speed = case.speed or SPEED
    causes = (
        (
            "physics" in (of, less)
            and result.outcome in (Outcome.SLID, Outcome.TIMED_OUT)
            and question in ("stairs", "extra"),
            f"friction of {result.spec.static_friction:g} is too low: the trial slides",
        ),
        (
            "physics" in (of, less) and speed > FALLING[-1][0],
            f"at {speed:g} m/s the robot drives on faster than it can fall, further than the "
            "excess over the contact model was ever measured",
        ),
        (
            case.acceleration != 0.0 and "physics" in (of, less),
            "with an acceleration the trial's speed changes on the way; the contact model has no "
            "speed",
        ),
        (
            question == "stairs" and result.spec.begin == "landing",
            "entering or landing: there a rigid belt hits rigid risers, which the quasi-static "
            "model leaves out",
        ),
        (
            question in ("stairs", "extra")
            and result.fell
            and known.way.status is Status.OK
            and math.degrees(known.way.swing) > 1.0,
            f"momentum: a swing of {math.degrees(known.way.swing):.1f} deg is caught only if it is "
            "slow",
        ),
        (
            case.robot.front_flippers is not None or case.robot.rear_flippers is not None,
            "the flippers: their discs touch elsewhere than the flat, and stand still in the trial "
            "as in the contact model",
        ),
        (
            question == "stairs" and case.stairs.irregularity > 1e-4,
            "the steps differ from each other; a trial passes two of them only",
        ),
        (
            _close_to_limit(known),
            "the slope is within 2 deg of the limit, where turns grow without bound",
        ),
        (
            case.robot.track.rear_radius != case.robot.track.front_radius,
            "the ends have two radii, so that another arc than the formula's flat decides",
        ),
    )
    for applies, text in causes:
        if applies:
            return text
    return "no known cause; please report it"


def _close_to_limit(known: Known) -> bool:
    limit = known.limits.get("contact")
    angle = math.degrees(known.case.stairs.angle)
    return isinstance(limit, float) and abs(limit - angle) < 2.0
