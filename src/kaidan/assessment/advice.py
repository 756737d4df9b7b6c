"""What would help: the same question with something changed, judged by the same model again."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from kaidan.allowance import Allowance
from kaidan.assessment.answer import Change
from kaidan.assessment.measuring import Measurement
from kaidan.assessment.sentences import advice as text
from kaidan.assessment.sentences import measuring
from kaidan.assessment.traction_advice import (
    SLIPS,
    Candidate,
    grousers,
    more_friction,
    nosings,
    with_less_friction,
    with_other_plans,
)
from kaidan.assessment.uncertain_inputs import SAMPLED, STEPS, without
from kaidan.assessment.verdict import Conclusion, conclude
from kaidan.errors import InputError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.models import judge
from kaidan.models.centroid import shift_of_centroid
from kaidan.models.findings import Findings
from kaidan.models.sentences import terrain
from kaidan.models.sentences import unweighed as weighing
from kaidan.modes import (
    ACROSS,
    ENERGY,
    FAILURE_MODES,
    FALLS,
    GAP_JAM,
    GROUSER_SPEED,
    IMPACT,
    LANDING_ROOM,
    MOMENTUM,
    POSTURE_TOLERANCE,
    ROTATION,
    TIP_DOWNHILL,
    TIPS,
    UNWEIGHED,
    FailureMode,
    Phase,
    Undecided,
    Verdict,
)
from kaidan.question import Question
from kaidan.robot import Posture

if TYPE_CHECKING:
    from kaidan.assessment.plan_search import Found

RAISED = math.radians(45.0)
"""Angle of leading flippers that reach for a first riser: half-way between flat and upright."""
CLOSER = math.radians(1.0)
"""Error of a flipper angle that an operator with time is advised to keep [rad]."""
SLOWEST = 0.01
"""Slowest speed that an operator is advised [m/s]."""
WORTH_TELLING = math.radians(0.05)
"""Gain of margin that counts as help [rad]."""
_ROTATES = {mode.key for mode in (*TIPS, *FALLS, ROTATION, MOMENTUM, IMPACT)}


def what_would_help(
    question: Question,
    found: Findings,
    conclusion: Conclusion,
    measure: Sequence[Measurement] = (),
    *,
    search: "Found | None" = None,
) -> tuple[Change, ...]:
    """Changes that raise the verdict or the margin, the best first; nothing for a GO."""
    if conclusion.verdict is Verdict.GO or question.trials > 1:  # each change as many trials
        return ()
    better = []
    known = found if question.robot.com_range is None else None

    def judged(changed: Question, holds: bool = False) -> tuple[Conclusion, bool]:
        then = conclude(changed, judge(changed, known=known))
        return _planned(changed, then, search, anew=holds and known is not None)

    candidates = (
        *_candidates(question, found, conclusion, search),
        *nosings(question, conclusion, lambda changed: judged(changed)[0]),
        *_known_better(question, measure),
    )
    cheapest: Verdict | None = None  # what less friction comes to
    for each in candidates:
        if each.friction is not None and cheapest is Verdict.GO:
            continue
        then, anew = each.then, each.another
        try:
            if then is None:
                then, another = judged(each.question, each.holds)
                anew = anew or another
        except InputError:  # a posture or a place of the centroid that the robot cannot have
            continue
        if _is_better(then, conclusion) and (not each.certain or _settles(then, conclusion)):
            better.append((then, text.with_another_plan(each.change) if anew else each.change))
            if each.friction is not None:
                cheapest = then.verdict
    better.sort(key=lambda each: _rank(each[0]))
    return tuple(
        Change(
            change=change,
            verdict=then.verdict.value,
            margin_deg=math.degrees(then.margin),
        )
        for then, change in better
    )


def _planned(
    question: Question, then: Conclusion, search: "Found | None", *, anew: bool
) -> tuple[Conclusion, bool]:
    """Conclusion of a plan with its verdict when perturbed, or that of another plan.

    search: what found the plan; without it no other one is sought.
    anew: whether another plan is sought where this one is no GO at its angles, not only where its
        verdict is worse when perturbed.
    """
    may_lower = question.tolerance and then.verdict in (Verdict.GO, Verdict.ROUGH)
    seeks = anew and search is not None and then.verdict is not Verdict.GO
    if not (may_lower or seeks):
        return then, False
    from kaidan.assessment.plan_off_angles import holds_off_its_angles
    from kaidan.assessment.plan_search import better_than

    drives = None if search is None else search.drives
    lowered = may_lower and not holds_off_its_angles(question, drives)
    if lowered:
        then = then._replace(verdict=Verdict.UNSURE)
    elif not seeks:
        return then, False
    if search is not None and question.robot.com_range is None:
        asked = question.changed(best_of=search.best_of)
        own = better_than(then.verdict, asked, drives=drives, other_frictions=anew)
        if own is not None and own.robust:
            best = conclude(own.question, own.findings)
            return (best, True) if best.verdict.rank < then.verdict.rank else (then, False)
    return then, False


def _number(margin: float) -> float:
    return 0.0 if math.isnan(margin) else margin


def _is_better(then: Conclusion, now: Conclusion) -> bool:
    if then.verdict is not now.verdict:
        return then.verdict.rank < min(now.verdict.rank, Verdict.NO_GO.rank)
    decides = FAILURE_MODES.get(now.governs)
    if decides is not None and decides.unit != "rad" and then.governs == now.governs:
        return False  # a larger margin of slope leaves what decides as it is
    return then.margin > now.margin + WORTH_TELLING


def _settles(then: Conclusion, now: Conclusion) -> bool:
    """Whether another verdict comes of it, or a margin that holds."""
    return then.verdict is not now.verdict or now.margin <= 0 < then.margin


def _candidates(
    question: Question, found: Findings, conclusion: Conclusion, search: "Found | None"
) -> Iterator[Candidate]:
    """Only what can change what governs, because each may be driven anew."""
    governs, searched = conclusion.governs, search is not None
    if governs == UNWEIGHED.key:
        yield _weighed(found)
        return
    slips = governs in SLIPS
    if governs == ACROSS.key:
        yield Candidate(terrain.STATE, question.changed(uniform_across=True))
        return
    if question.yaw:
        yield Candidate(text.STRAIGHT, question.changed(yaw=0.0))
    if governs != Undecided.FRICTION_UNKNOWN:
        if question.acceleration:
            yield Candidate(text.STEADY, question.changed(acceleration=0.0))
        at_an_end = conclusion.phase in (Phase.ENTER, Phase.LAND)
        if not slips and not searched:
            yield from _flippers_flat(question)
        if not searched and (not slips or at_an_end):
            other = "tail-first" if question.facing == "nose-first" else "nose-first"
            yield Candidate(
                text.turned_round(question.direction, other), question.changed(facing=other)
            )
            yield from _flippers_raised(question)
    friction: list[Candidate] = []
    slip_governs = governs == ENERGY.key and question.robot.track.has_grousers
    if slips or slip_governs or governs == POSTURE_TOLERANCE.key:
        friction += more_friction(question, found, search)
    if search is not None:
        friction += with_other_plans(question, search)
    if search is not None and friction:
        least = min(each.friction or math.inf for each in friction)
        friction += with_less_friction(question, found, search, least)
    yield from sorted(friction, key=lambda one: one.friction or math.inf)
    if slips or governs == GAP_JAM.key:
        yield from grousers(question)
    if governs == POSTURE_TOLERANCE.key and question.tolerance > CLOSER:
        closer = question.changed(flipper_tolerance=CLOSER)
        yield Candidate(text.set_closer(CLOSER), closer, holds=True)
    if governs == LANDING_ROOM.key:
        yield from _stowed_on_landings(question, found)
    energy = found.of(ENERGY)
    if governs == ENERGY.key and energy is not None:
        yield from _slower(question, float(energy.worst[0]) + question.energy_threshold())
    fast = found.of(GROUSER_SPEED)
    if governs == GROUSER_SPEED.key and fast is not None and question.speed is not None:
        limit = round(question.speed + float(fast.worst[0]) - 0.01, 9)
        yield Candidate(text.slower(limit), question.changed(speed=limit))
    if governs in _ROTATES:
        if conclusion.margin_best > 0:
            yield from _measured(question)
        yield from _centroid_moved(question, found, conclusion)


def _known_better(question: Question, measure: Sequence[Measurement]) -> Iterator[Candidate]:
    """The stated doubt that the margin feels most, measured away."""
    for each in measure:
        if set(each.inputs) & {*SAMPLED, STEPS}:
            changed = without(question, each.what)
            if changed is not None:
                yield Candidate(measuring.measure(each.what), changed, certain=True)
            return


def _weighed(found: Findings) -> Candidate:
    """The robot weighed, and its centroid at the best place of its range."""
    best = min(
        (each for each in found.basis if not each.found.outside),
        key=lambda each: _rank(conclude(each.question, each.found)),
    )
    return Candidate(weighing.weigh(best.com_from_front, best.com_height), best.question)


def _rank(conclusion: Conclusion) -> tuple[int, float]:
    return conclusion.verdict.rank, -_number(conclusion.margin)


def _flippers_flat(question: Question) -> Iterator[Candidate]:
    robot = question.robot
    flat = Posture(
        front="flat" if robot.front_flippers else None,
        rear="flat" if robot.rear_flippers else None,
    )
    if flat not in (question.posture, Posture()):
        yield Candidate(text.FLAT, question.changed(posture=flat))


def _stowed_on_landings(question: Question, found: Findings) -> Iterator[Candidate]:
    """Flippers stowed on landings that are too short for the robot with them out, and then only."""
    if not question.robot.flippers() or any(each.end == "between" for each in question.landings):
        return
    from kaidan.assessment.plans import off_angles
    from kaidan.models.clearance import room_when_stowed

    room = room_when_stowed(question)
    if room <= 0:
        return

    def then(asked: Question, findings: Findings) -> Conclusion:
        each = [
            replace(one, worst=np.array([room]), best=np.array([room]))
            if one.mode is LANDING_ROOM
            else one
            for one in findings.each
        ]
        return conclude(asked, replace(findings, each=tuple(each)))

    at_them = then(question, found)
    arrives = at_them.verdict in (Verdict.GO, Verdict.ROUGH)
    if arrives and any(
        then(each, judge(each)).verdict.rank > at_them.verdict.rank for each in off_angles(question)
    ):
        at_them = at_them._replace(verdict=Verdict.UNSURE)
    yield Candidate(text.STOWED, question, certain=True, then=at_them)


def _flippers_raised(question: Question) -> Iterator[Candidate]:
    """Leading flippers raised to meet the first riser from above; going up only."""
    end = "front" if question.facing == "nose-first" else "rear"
    pair = getattr(question.robot, f"{end}_flippers")
    if pair is None or question.direction == "down" or getattr(question.posture, end) == RAISED:
        return
    posture = Posture(**dict(question.posture) | {end: RAISED})
    yield Candidate(text.raised(end, RAISED), question.changed(posture=posture))


def _slower(question: Question, energy: float) -> Iterator[Candidate]:
    """Speed of which a sudden stop takes less than the energy margin [m]."""
    if not energy > 0:
        return
    height = question.kinetic_height * energy / question.energy_threshold()
    speed = math.ceil(1e2 * math.sqrt(2 * STANDARD_GRAVITY * height)) / 1e2 - 0.01
    if speed >= SLOWEST:
        yield Candidate(text.slower(speed), question.changed(speed=speed))


def _measured(question: Question) -> Iterator[Candidate]:
    defaults = {"theta_d": question.allowance_d, "theta_M": question.allowance_M}
    names = [name for name, allowance in defaults.items() if allowance.source == "default"]
    if names:
        zero = Allowance(low=0.0, high=0.0)
        yield Candidate(text.measured(names), question.changed(**dict.fromkeys(names, zero)))


def _centroid_moved(
    question: Question, found: Findings, conclusion: Conclusion
) -> Iterator[Candidate]:
    """Shift of the centroid that gives a tip margin of zero, if the track is long enough."""
    over = _tips_over(question, found, conclusion)
    shift = None if over is None else shift_of_centroid(question, downhill=over is TIP_DOWNHILL)
    if over is None or shift is None:
        return
    shift = math.ceil(1e3 * shift + 1) / 1e3
    end = "front" if (over is TIP_DOWNHILL) == question.nose_up else "rear"
    robot, mass = question.robot, question.stance.mass
    share = 1.0 if robot.mass is None or mass is None else robot.mass / mass  # a payload stays
    moved = robot.com_from_front + (-shift if end == "front" else shift) / share
    load = sum(payload.mass for payload in question.payload)
    of_payload = shift * mass / load if load > 0 and mass is not None else None
    try:
        changed = type(robot)(**dict(robot) | {"com_from_front": moved})
    except InputError:  # outside the robot
        return
    yield Candidate(
        text.centroid(shift, end, of_payload=of_payload), question.changed(robot=changed)
    )


def _tips_over(question: Question, found: Findings, conclusion: Conclusion) -> FailureMode | None:
    """End over which the robot tips; None: neither is known to."""
    failing = [one for one in conclusion.doubts if one.mode in TIPS[:2]]
    known = failing or [one for mode in TIPS[:2] if (one := found.of(mode)) is not None]
    known = [one for one in known if not math.isnan(one.margin(question.risk))]
    return min(known, key=lambda one: one.margin(question.risk)).mode if known else None
