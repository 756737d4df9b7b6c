"""What is compared, the answers, the differences with their bands and likely causes."""

import math
from collections.abc import Callable
from typing import Any, get_args

from kaidan.arguments import known_arguments
from kaidan.contact import Status
from kaidan.errors import InputError
from kaidan.lab.cross_check import bands, outcomes
from kaidan.lab.cross_check import sentences as said
from kaidan.lab.cross_check.answer import (
    Agreement,
    Compared,
    Difference,
    JudgeName,
    Value,
)
from kaidan.lab.cross_check.bands import Band
from kaidan.lab.cross_check.bisection import Found, friction_required, steepest_climbed
from kaidan.lab.cross_check.causes import Context, cause_of, why_not
from kaidan.lab.cross_check.common_question import (
    Begin,
    FlightTraverse,
    at_angle,
    common,
    flight_traverse,
    speed_of,
    stairs_of,
    static_criterion,
    steepest_arrested,
    trial_of,
)
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.margin import theta_s_sup
from kaidan.models.closed_form import judge
from kaidan.physics import Outcome, TrialResult, run
from kaidan.question import Question
from kaidan.spelling import word_of
from kaidan.units import value_of

FINEST, COARSEST = 0.01, 5.0
"""Resolutions that may be stated [deg]."""
RESOLUTION = 0.1
"""Width of the last bracket of searches by trials [deg]."""
_PROBE = math.radians(40.0)
"""Slope of a flight on which the criterion is worked out; its margin gives the limit [rad]."""


@known_arguments
def agree(
    robot: Any,
    stairs: Any = None,
    *,
    begin: Begin = "flight",
    resolution: float = RESOLUTION,
    **manner: Any,
) -> Agreement:
    """Put one question to all models and say how far apart they are.

    Parameters
    ----------
    robot, stairs, **manner
        A question, or what one is made of, see `kaidan.Question.of`; allowances and
        uncertainties play no part, since models are compared and nobody is judged.
    begin : {"flight", "landing"}
        Where the trial on the stairs begins: on the flight as in the paper, or on the landing
        before it.
    resolution : float
        Of what is found by bisection over trials [deg].

    Raises
    ------
    InputError
        A question that not all models can answer.
    MissingExtraError
        MuJoCo is not installed.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (19)-(23), for the closed form.
    """
    question = Question.in_one_posture(robot, stairs, **manner)
    word_of("begin", begin, get_args(Begin))
    resolution = value_of(resolution, "number", option="resolution")
    if not FINEST <= resolution <= COARSEST:
        raise InputError(
            f"resolution = {resolution:g} deg is not within {FINEST:g} to {COARSEST:g}"
        )
    put = common(question)
    result = run(trial_of(put, begin))
    traverse = flight_traverse(put)
    flight, climbed = _flight(put, resolution)
    limit = flight.answers["contact"]
    context = Context(put, traverse, result, limit if isinstance(limit, float) else None)
    on_stairs = _stairs(put, traverse, result)
    extra = _extra(traverse, result)
    friction, slid = _friction(put, traverse, resolution)
    differences = (
        *_of_flight(flight, context, resolution),
        *_of_stairs(on_stairs, context),
        _of_extra(extra, context),
        *_of_friction(friction, context),
    )
    return Agreement(
        question=question,
        slope_deg=math.degrees(stairs_of(put).angle),
        begin=begin,
        speed_m_s=speed_of(put),
        friction=put.friction[0],
        resolution_deg=resolution,
        agrees=all(each.within is not False for each in differences),
        comparisons=(flight, on_stairs, extra, friction),
        differences=differences,
        trials=1 + climbed.trials + slid.trials,
        versions=result.versions,
    )


def _flight(question: Question, resolution: float) -> tuple[Compared, Found]:
    probe = at_angle(question, _PROBE)
    formula: float | None = None
    if not judge(probe).outside:
        stance = question.stance
        uphill = stance.com_from_front if question.nose_up else (
            stance.flat_length - stance.com_from_front
        )  # fmt: skip
        formula = math.degrees(
            float(
                theta_s_sup(
                    L=stance.flat_length,
                    p=stairs_of(question).nosing_spacing,
                    C_L=uphill,
                    C_N=stance.com_height,
                    a=question.acceleration,
                )
            )
        )
    static = stairs_of(probe).angle + static_criterion(probe)[0]
    arrested = math.degrees(steepest_arrested(question))
    found = steepest_climbed(question, arrested, resolution)
    return Compared(
        name="steepest_flight",
        text=f"steepest flight at {1e3 * stairs_of(question).nosing_spacing:.0f} mm",
        unit="deg",
        answers={
            "closed_form": formula,
            "static_criterion": math.degrees(static),
            "contact": arrested,
            "physics": found.value,
        },
    ), found


def _stairs(question: Question, traverse: FlightTraverse, result: TrialResult) -> Compared:
    landing = result.spec.begin == "landing"
    return Compared(
        name="stairs",
        text=f"on {math.degrees(stairs_of(question).angle):.1f} deg",
        unit="",
        answers={
            "closed_form": outcomes.by_closed_form(question),
            "static_criterion": outcomes.by_static_criterion(question, _formula_friction(question)),
            "contact": outcomes.from_the_landing(question)
            if landing
            else outcomes.by_traverse(question, traverse),
            "physics": outcomes.by_trial(question, result),
        },
    )


def _extra(traverse: FlightTraverse, result: TrialResult) -> Compared:
    none = result.fell or result.outcome in (Outcome.UNSTABLE, Outcome.START_FALL)
    return Compared(
        name="extra",
        text="largest extra inclination",
        unit="deg",
        answers={
            "closed_form": None,
            "static_criterion": None,
            "contact": math.degrees(traverse.extra) if traverse.status is Status.OK else None,
            "physics": None if none else result.largest_extra_deg,
        },
    )


def _friction(
    question: Question, traverse: FlightTraverse, resolution: float
) -> tuple[Compared, Found]:
    formula = _formula_friction(question)
    found = friction_required(question, formula, resolution)
    return Compared(
        name="friction",
        text="required friction",
        unit="1",
        answers={
            "closed_form": formula,
            "static_criterion": None,
            "contact": traverse.required_friction if traverse.status is Status.OK else None,
            "physics": found.value,
        },
    ), found


def _formula_friction(question: Question) -> float:
    """Friction that the flight as a plane requires [1], Eq. (4) solved for it."""
    angle = stairs_of(question).angle
    return math.tan(angle) + question.acceleration / (STANDARD_GRAVITY * math.cos(angle))


def _of_flight(flight: Compared, context: Context, resolution: float) -> list[Difference]:
    radius = context.question.robot.track.rear_radius
    steepest = bands.steepest(speed_of(context.question), resolution)
    return [
        _numbers(flight, "static_criterion", "closed_form", bands.static_criterion(), context),
        _numbers(flight, "contact", "closed_form", bands.arrested(radius), context),
        _numbers(flight, "physics", "contact", steepest, context),
    ]


def _of_stairs(stairs: Compared, context: Context) -> list[Difference]:
    pairs: tuple[tuple[JudgeName, JudgeName], ...] = (
        ("static_criterion", "closed_form"),
        ("physics", "contact"),
    )
    found = []
    for of, less in pairs:
        one, other = stairs.answers[of], stairs.answers[less]
        cause = why_not(of, one, context, name="stairs") or why_not(
            less, other, context, name="stairs"
        )
        within: bool | None = None
        if not cause:
            within = one == other or (of == "physics" and _late(one, other, context))
            cause = "" if within else cause_of("stairs", of, less, context)
        found.append(
            Difference(
                comparison="stairs",
                of=of,
                less=less,
                value_deg=None,
                band=None,
                within=within,
                cause=cause,
            )
        )
    return found


def _late(one: Value, other: Value, context: Context) -> bool:
    """Whether a trial climbs what the contact model falls on, but only as falling takes time."""
    excess = bands.falling(speed_of(context.question))
    if (one, other) != ("holds", "tips") or excess is None or context.limit is None:
        return False
    return math.degrees(stairs_of(context.question).angle) <= context.limit + excess + 0.1


def _of_extra(extra: Compared, context: Context) -> Difference:
    if context.result.spec.begin == "landing":
        return Difference(
            comparison=extra.name,
            of="physics",
            less="contact",
            value_deg=None,
            band=None,
            within=None,
            cause=said.OF_THE_FLIGHT,
        )
    contact = extra.answers["contact"]
    band = bands.extra(contact) if isinstance(contact, float) else None
    return _numbers(extra, "physics", "contact", band, context)


def _of_friction(friction: Compared, context: Context) -> list[Difference]:
    """Differences of angles of friction."""
    extra = context.traverse.extra
    inclined = math.degrees(extra) if context.traverse.status is Status.OK else 0.0
    on_flight = context.result.spec.begin == "flight"
    most = max(inclined, context.result.largest_extra_deg if on_flight else 0.0)
    poses, trial = bands.friction_of_poses(inclined), bands.friction(most)
    return [
        _numbers(friction, "contact", "closed_form", poses, context, of_friction),
        _numbers(friction, "physics", "closed_form", trial, context, of_friction),
    ]


def of_friction(friction: float) -> float:
    """Angle of friction [deg]."""
    return math.degrees(math.atan(friction))


def _as_it_is(angle: float) -> float:
    return angle


def _numbers(
    compared: Compared,
    of: JudgeName,
    less: JudgeName,
    band: Band | None,
    context: Context,
    angle: Callable[[float], float] = _as_it_is,
) -> Difference:
    """Difference of two numbers, each as an angle [deg]."""
    one, other = compared.answers[of], compared.answers[less]
    value: float | None = None
    within: bool | None = None
    if isinstance(one, float) and isinstance(other, float):
        value = angle(one) - angle(other)
        within = band is not None and band.holds(value)
        cause = "" if within else cause_of(compared.name, of, less, context)
    else:
        missing = less if isinstance(one, float) else of
        cause = why_not(missing, None, context, name=compared.name)
    return Difference(
        comparison=compared.name,
        of=of,
        less=less,
        value_deg=value,
        band=None if value is None else band,
        within=within,
        cause=cause,
    )
