"""What would help: the same question with something changed, asked again."""

import math
from collections.abc import Callable, Iterable
from typing import NamedTuple

import numpy as np

from kaidan.assessment.allowance import Allowance
from kaidan.assessment.answer import Change, Verdict
from kaidan.assessment.case import Case
from kaidan.assessment.closed_form import Judgement, at_risk, judge
from kaidan.errors import InputError
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.slipping import required_friction
from kaidan.robot import Posture
from kaidan.sheet import bounds
from kaidan.surface import Surface

RAISED = math.radians(45.0)
"""Angle of leading flippers that reach for a first riser: half-way between flat and upright."""
SLOWEST = 0.01
"""Slowest speed that is worth telling an operator [m/s]."""
LARGEST_FRICTION = bounds(Surface.model_fields["friction_low"])[2]
"""Beyond it no surface is known."""
_RANK = {"go": 0, "caution": 1, "no-go": 2, "outside-model": 3}
_MARGIN_WORTH_TELLING = math.radians(0.05)

Candidate = tuple[str, Case]


class Outcome(NamedTuple):
    """What a model says of a case."""

    verdict: Verdict
    margin: float
    """[rad]; NaN: not known."""


def improvements(
    candidates: Iterable[Candidate], now: Outcome, ask: Callable[[Case], Outcome]
) -> tuple[Change, ...]:
    """Candidates that raise the verdict or the margin, the best first.

    Parameters
    ----------
    candidates : iterable of (str, Case)
        What to do, and the question with it.
    now : Outcome
        As asked.
    ask : callable
        The model.

    Returns
    -------
    tuple of Change
    """
    better = []
    for text, changed in candidates:
        try:
            then = ask(changed)
        except InputError:  # a posture or place of the centroid that the robot cannot have
            continue
        if _better(then, now):
            margin = math.degrees(then.margin) if math.isfinite(then.margin) else None
            better.append(Change(change=text, verdict=then.verdict, margin_deg=margin))
    return tuple(
        sorted(better, key=lambda change: (_RANK[change.verdict], -(change.margin_deg or 0.0)))
    )


def _better(then: Outcome, now: Outcome) -> bool:
    if _RANK[then.verdict] != _RANK[now.verdict]:
        return _RANK[then.verdict] < _RANK[now.verdict]
    return then.margin > now.margin + _MARGIN_WORTH_TELLING


def by_closed_form(case: Case, found: Judgement) -> tuple[Change, ...]:
    """Changes that would help, by the closed form; nothing for a plain GO."""
    if found.verdict == "go":
        return ()
    candidates = [*_turned_round(case), *_flippers_flat(case), *_gentler(case)]
    if found.governs in ("slip_up", "slip_down", "friction_unknown"):
        needed = required_friction(theta_s=found.nominal.theta_s, a=case.acceleration)
        candidates += _more_friction(case, float(needed.max()))
    if found.governs in ("tip_downhill", "tip_uphill"):
        if found.margin_at_best > 0:
            candidates += _measured(case)
        candidates += _centroid_moved(case, found, found.governs)

    def ask(changed: Case) -> Outcome:
        then = judge(changed)
        return Outcome(then.verdict, then.margin)

    return improvements(candidates, Outcome(found.verdict, found.margin), ask)


class WholeWay(NamedTuple):
    """What the contact model's advice goes by."""

    governs: str
    entering_or_landing: bool
    """Whether it governs there, not on the flight."""
    friction: float
    """Required friction [1]."""
    energy: float
    """Energy margin [m]."""
    kind: bool
    """Whether the kindest reading holds."""


def by_contact_model(
    case: Case, found: WholeWay, flat: Judgement, now: Outcome, ask: Callable[[Case], Outcome]
) -> tuple[Change, ...]:
    """Changes that would help, by the contact model; nothing for a plain GO.

    Only what can change the governing failure is asked, because each way is driven anew.

    Parameters
    ----------
    case : Case
        The question.
    found : WholeWay
        What governs.
    flat : Judgement
        The closed form's, which knows where the centroid should be.
    now : Outcome
        As asked.
    ask : callable
        The contact model.

    Returns
    -------
    tuple of Change
    """
    if now.verdict == "go":
        return ()
    slips = found.governs in ("slip", "friction_unknown", "drive")
    candidates: list[Candidate] = []
    if case.yaw:
        candidates.append(("Head straight along the stairs", case.changed(yaw=0.0)))
    if found.governs != "friction_unknown":
        candidates += _gentler(case)
        if not slips:
            candidates += _flippers_flat(case)
        if not slips or found.entering_or_landing:
            candidates += [*_turned_round(case), *_flippers_raised(case)]
    if found.governs in ("slip", "friction_unknown"):
        candidates += _more_friction(case, found.friction)
    if found.governs == "energy":
        candidates += _slower(case, found.energy)
    tips = ("tip_downhill", "tip_uphill")
    if found.governs in tips and found.kind:
        candidates += _measured(case)
    over = flat.governs if found.governs in ("catch", "momentum") else found.governs
    if over in tips and case.profile is None and not case.yaw:
        candidates += _centroid_moved(case, flat, over)
    return improvements(candidates, now, ask)


def _turned_round(case: Case) -> list[Candidate]:
    if case.facing == "nose-first":
        return [(f"Go {case.direction} tail first", case.changed(facing="tail-first"))]
    return [(f"Go {case.direction} nose first", case.changed(facing="nose-first"))]


def _flippers_flat(case: Case) -> list[Candidate]:
    flat = Posture(
        front="flat" if case.robot.front_flippers else None,
        rear="flat" if case.robot.rear_flippers else None,
    )
    if flat in (case.posture, Posture()):
        return []
    return [("Lay the flippers flat, in line with the track", case.changed(posture=flat))]


def _flippers_raised(case: Case) -> list[Candidate]:
    """Leading flippers raised to meet the first riser from above; going up only."""
    end = "front" if case.facing == "nose-first" else "rear"
    pair = getattr(case.robot, f"{end}_flippers")
    if pair is None or case.direction == "down" or getattr(case.posture, end) == RAISED:
        return []
    posture = case.posture.model_copy(update={end: RAISED})
    text = f"Raise the {end} flippers to {math.degrees(RAISED):.0f} deg"
    return [(text, case.changed(posture=posture))]


def _gentler(case: Case) -> list[Candidate]:
    if case.acceleration == 0:
        return []
    return [("Keep the speed constant", case.changed(acceleration=0.0))]


def _slower(case: Case, energy: float) -> list[Candidate]:
    """Speed whose kinetic energy the energy margin outdoes."""
    if not energy > 0:
        return []
    speed = math.ceil(1e2 * math.sqrt(2 * STANDARD_GRAVITY * energy)) / 1e2 - 0.01
    if speed < SLOWEST:
        return []
    return [(f"Drive at {speed:.2f} m/s or less", case.changed(speed=speed))]


def _more_friction(case: Case, required: float) -> list[Candidate]:
    if not math.isfinite(required):
        return []
    needed = math.ceil(100 * required + 1)
    if needed / 100 > LARGEST_FRICTION:
        return []
    surface = Surface.of_friction(needed / 100)
    if case.surface is None:
        text = f"Make sure of a friction of {needed / 100:.2f} or more"
    else:
        text = f"A surface with a friction of {needed / 100:.2f} or more"
    return [(text, case.changed(surface=surface))]


def _measured(case: Case) -> list[Candidate]:
    unmeasured = [
        name for name in ("theta_d", "theta_M") if getattr(case, name).source == "default"
    ]
    if not unmeasured:
        return []
    zero = Allowance(low=0.0, high=0.0)
    text = f"Measure {' and '.join(unmeasured)}: at best, if they are zero"
    return [(text, case.changed(**dict.fromkeys(unmeasured, zero)))]


def _centroid_moved(case: Case, found: Judgement, governs: str) -> list[Candidate]:
    """Shift of the centroid that would give a tip margin of zero, if the track is long enough."""
    short = -at_risk(found.worst.centroid, case.risk)
    at, step, tilt = found.nominal, found.step, case.theta_d.high + case.theta_M.high
    L, p, C_N = float(at.L[0, 0]), float(at.p[0, step]), float(at.C_N[0, 0])
    theta = float(at.theta_s[0, step])
    room = L - 2 * p - C_N * (math.tan(theta + tilt) - math.tan(theta - case.theta_d.high))
    if not np.isfinite(short) or short <= 0 or room < 0:
        return []
    shift = math.ceil(1e3 * short + 1) / 1e3
    uphill = governs == "tip_downhill"
    end = "front" if uphill == case.nose_up else "rear"
    sign = -1.0 if end == "front" else 1.0
    robot = case.robot
    share = 1.0
    if robot.mass is not None and found.stance.mass is not None:
        share = robot.mass / found.stance.mass  # a payload stays where it is
    moved = robot.com_from_front + sign * shift / share
    changed = robot.model_copy(update={"com_from_front": moved})
    text = f"Move the centroid {1e3 * shift:.0f} mm towards the {end}"
    load = sum(payload.mass for payload in case.payload)
    if load > 0 and found.stance.mass is not None:
        text += f" (the payload by {1e3 * shift * found.stance.mass / load:.0f} mm)"
    return [(text, case.changed(robot=changed))]
