"""The questions, the answers, the differences with their bands and likely causes."""

import math

from kaidan.agreement import bands
from kaidan.agreement.answer import MODELS, Agreement, Answer, Difference, Question
from kaidan.agreement.asked import (
    PLENTY,
    SPEED,
    Begin,
    Way,
    flight_at,
    no_rotation,
    refuse_odd_cases,
    steepest_caught,
    trial_of,
    way_of,
)
from kaidan.agreement.bands import Band
from kaidan.agreement.causes import Known, cause_of, why_not
from kaidan.agreement.searching import Found, friction_needed, steepest_climbed
from kaidan.assessment.allowance import Allowance
from kaidan.assessment.case import Case
from kaidan.assessment.closed_form import judge
from kaidan.assessment.contact_model import climb_of
from kaidan.contact import Status
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.margin import theta_s_sup
from kaidan.physics import TrialResult, run

RESOLUTION = 0.1
"""Width of the last bracket of searches by trials [deg]."""


def agree(case: Case, *, begin: Begin = "flight", resolution: float = RESOLUTION) -> Agreement:
    """Ask all models the same questions and tell how far apart they are.

    Parameters
    ----------
    case : Case
        Robot and stairs, direction, facing, posture, payload, acceleration, surface; its allowances
        play no part, since models are compared and nobody is judged.
    begin : {"flight", "landing"}
        Where the trial on the stairs asked begins: on the flight as in the paper, or on the landing
        before it.
    resolution : float
        Of what is found by bisection over trials [deg].

    Returns
    -------
    Agreement

    Raises
    ------
    InputError
        A question that not all models can be asked.
    MissingExtraError
        MuJoCo is not installed.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (19)-(23), for the closed form.
    """
    refuse_odd_cases(case)
    case = case.changed(
        theta_d=Allowance.of(0.0, name="theta_d"), theta_M=Allowance.of(0.0, name="theta_M")
    )
    mu = PLENTY if case.surface is None else case.surface.friction_low
    result = run(trial_of(case, case.stairs, friction=mu, begin=begin))
    way = way_of(case, case.stairs)
    arrived = climb_of(case).arrived if begin == "landing" else way.status is Status.OK
    flight, climbed = _flight(case, resolution)
    known = Known(case=case, way=way, result=result, limits=flight.answers)
    stairs = _stairs(case, way, result, arrived, mu)
    turn = _turn(way, result)
    grip, slid = _grip(case, way, result, resolution)
    return Agreement(
        case=case,
        begin=begin,
        speed=case.speed or SPEED,
        friction=mu,
        resolution=resolution,
        questions=(flight, stairs, turn, grip),
        differences=(
            *_of_flight(flight, known, resolution),
            *_of_stairs(stairs, flight, known),
            _of_turn(turn, known),
            *_of_grip(grip, known),
        ),
        trials=1 + climbed.trials + slid.trials,
        versions=result.versions,
    )


def _flight(case: Case, resolution: float) -> tuple[Question, Found]:
    probe = flight_at(case, math.radians(40.0))
    formula: float | None = None
    if not judge(case.changed(stairs=probe)).outside:
        stance = case.stance
        C_L = stance.com_from_front if case.nose_up else stance.flat_length - stance.com_from_front
        formula = math.degrees(
            float(
                theta_s_sup(
                    L=stance.flat_length,
                    p=case.stairs.nosing_spacing,
                    C_L=C_L,
                    C_N=stance.com_height,
                    a=case.acceleration,
                )
            )
        )
    downhill = no_rotation(case, probe)[0]
    caught = math.degrees(steepest_caught(case))
    found = steepest_climbed(case, caught, resolution)
    return Question(
        "steepest_flight",
        f"steepest flight at {1e3 * case.stairs.nosing_spacing:.0f} mm",
        "deg",
        {
            "closed_form": _known(formula),
            "no_rotation": _known(math.degrees(probe.angle + downhill)),
            "contact": _known(caught),
            "physics": _known(found.value),
        },
    ), found


def _stairs(case: Case, way: Way, result: TrialResult, arrived: bool, mu: float) -> Question:
    needed = _formula_friction(case)
    slides = case.surface is not None and mu < needed
    judged = judge(case)
    one: Answer
    if judged.outside:
        one = "outside"
    else:
        turns = not (judged.worst.modes[:2] > 0).all()
        one = "turns" if turns else "slides" if slides else "holds"
    two = "holds" if not math.isnan(margin := min(no_rotation(case, case.stairs))) else "outside"
    if two == "holds":
        two = "turns" if not margin > 0 else "slides" if slides else "holds"
    three = "holds" if arrived else "falls"
    if way.status not in (Status.OK, Status.FELL_BACKWARD, Status.FELL_FORWARD):
        three = "unknown"
    elif arrived and case.surface is not None and mu < way.required_friction:
        three = "slides"
    words = {
        "climbed": "holds",
        "fell_backward": "falls",
        "fell_forward": "falls",
        "slid": "slides",
        "timed_out": "slides",
    }
    return Question(
        "stairs",
        f"on {math.degrees(case.stairs.angle):.1f} deg",
        "",
        {
            "closed_form": one,
            "no_rotation": two,
            "contact": three,
            "physics": words.get(result.outcome.value, "unknown"),
        },
    )


def _turn(way: Way, result: TrialResult) -> Question:
    fell = result.fell or result.outcome.value in ("unstable", "start_fall")
    return Question(
        "extra",
        "largest extra inclination",
        "deg",
        {
            "closed_form": None,
            "no_rotation": None,
            "contact": math.degrees(way.extra) if way.status is Status.OK else None,
            "physics": None if fell else result.largest_extra_deg,
        },
    )


def _grip(case: Case, way: Way, result: TrialResult, resolution: float) -> tuple[Question, Found]:
    formula = _formula_friction(case)
    found = friction_needed(case, formula, resolution)
    return Question(
        "friction",
        "required friction",
        "1",
        {
            "closed_form": formula,
            "no_rotation": None,
            "contact": _known(way.required_friction) if way.status is Status.OK else None,
            "physics": _known(found.value),
        },
    ), found


def _formula_friction(case: Case) -> float:
    """Friction that the flight as a plane needs [1], Eq. (4) solved for it."""
    angle = case.stairs.angle
    return math.tan(angle) + case.acceleration / (STANDARD_GRAVITY * math.cos(angle))


def _of_flight(flight: Question, known: Known, resolution: float) -> list[Difference]:
    radius = known.case.robot.track.rear_radius
    return [
        _numbers(flight, "no_rotation", "closed_form", bands.grade_one(), known),
        _numbers(flight, "contact", "closed_form", bands.caught(radius), known),
        _numbers(
            flight,
            "physics",
            "contact",
            bands.steepest(known.case.speed or SPEED, resolution),
            known,
        ),
    ]


def _of_stairs(stairs: Question, flight: Question, known: Known) -> list[Difference]:
    found = []
    for of, less in (("no_rotation", "closed_form"), ("physics", "contact")):
        one, other = stairs.answers[of], stairs.answers[less]
        reason = why_not(of, one, known) or why_not(less, other, known)
        within: bool | None = None
        cause = reason
        if not reason:
            within = one == other or (of == "physics" and _late(one, other, flight, known))
            cause = "" if within else cause_of("stairs", of, less, known)
        found.append(Difference("stairs", of, less, None, None, within, cause))
    return found


def _late(one: Answer, other: Answer, flight: Question, known: Known) -> bool:
    """Whether a trial climbs what the contact model falls on, but only as falling takes time."""
    excess, limit = bands.falling(known.case.speed or SPEED), flight.answers["contact"]
    if (one, other) != ("holds", "falls") or excess is None or not isinstance(limit, float):
        return False
    return math.degrees(known.case.stairs.angle) <= limit + excess + 0.1


def _of_turn(turn: Question, known: Known) -> Difference:
    if known.result.spec.begin == "landing":
        cause = "the trial enters and lands, the contact model's figure is of the flight"
        return Difference(turn.name, "physics", "contact", None, None, None, cause)
    contact = turn.answers["contact"]
    band = bands.turn(contact) if isinstance(contact, float) else None
    return _numbers(turn, "physics", "contact", band, known)


def _of_grip(grip: Question, known: Known) -> list[Difference]:
    """Differences of angles of friction."""

    def angle(model: str) -> float | None:
        value = grip.answers[model]
        return math.degrees(math.atan(value)) if isinstance(value, float) else None

    angles = grip._replace(unit="deg", answers={model: angle(model) for model in MODELS})
    turned = math.degrees(known.way.extra) if known.way.status is Status.OK else 0.0
    on_flight = known.result.spec.begin == "flight"
    most = max(turned, known.result.largest_extra_deg if on_flight else 0.0)
    return [
        _numbers(angles, "contact", "closed_form", bands.friction_of_poses(turned), known),
        _numbers(angles, "physics", "closed_form", bands.friction(most), known),
    ]


def _numbers(asked: Question, of: str, less: str, band: Band | None, known: Known) -> Difference:
    one, other = asked.answers[of], asked.answers[less]
    if not isinstance(one, float) or not isinstance(other, float):
        missing = of if not isinstance(one, float) else less
        cause = why_not(missing, None, known, question=asked.name)
        return Difference(asked.name, of, less, None, None, None, cause)
    value = one - other
    if band is None:
        cause = cause_of(asked.name, of, less, known)
        return Difference(asked.name, of, less, value, None, False, cause)
    within = band.holds(value)
    cause = "" if within else cause_of(asked.name, of, less, known)
    return Difference(asked.name, of, less, value, band, within, cause)


def _known(value: float | None) -> float | None:
    return None if value is None or math.isnan(value) else float(value)
