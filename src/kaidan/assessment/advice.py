"""What would help: the same question with something changed, asked again."""

import math

import numpy as np

from kaidan.assessment.allowance import Allowance
from kaidan.assessment.answer import Change
from kaidan.assessment.case import Case
from kaidan.assessment.closed_form import Judgement, at_risk, judge
from kaidan.errors import InputError
from kaidan.mechanics.slipping import required_friction
from kaidan.robot import Posture
from kaidan.sheet import bounds
from kaidan.surface import Surface

_RANK = {"go": 0, "caution": 1, "no-go": 2, "outside-model": 3}
LARGEST_FRICTION = bounds(Surface.model_fields["friction_low"])[2]
"""Beyond it no surface is known."""
_MARGIN_WORTH_TELLING = math.radians(0.05)


def what_would_help(case: Case, found: Judgement) -> tuple[Change, ...]:
    """Changes that raise the margin, the best verdict first; nothing for a plain GO.

    Each is the same question asked anew: turned round, flippers laid flat, no acceleration, a
    surface with enough friction, measured allowances, the centroid moved.
    """
    if found.verdict == "go":
        return ()
    candidates = [
        *_turned_round(case),
        *_flippers_flat(case),
        *_gentler(case),
        *_more_friction(case, found),
        *_measured(case, found),
        *_centroid_moved(case, found),
    ]
    better = []
    for text, changed in candidates:
        try:
            then = judge(changed)
        except InputError:  # a posture or place of the centroid that the robot cannot have
            continue
        if _better(then, found):
            margin = math.degrees(then.margin) if math.isfinite(then.margin) else None
            better.append(Change(change=text, verdict=then.verdict, margin_deg=margin))
    return tuple(
        sorted(better, key=lambda change: (_RANK[change.verdict], -(change.margin_deg or 0.0)))
    )


def _better(then: Judgement, now: Judgement) -> bool:
    if _RANK[then.verdict] != _RANK[now.verdict]:
        return _RANK[then.verdict] < _RANK[now.verdict]
    return then.margin > now.margin + _MARGIN_WORTH_TELLING


Candidate = tuple[str, Case]


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


def _gentler(case: Case) -> list[Candidate]:
    if case.acceleration == 0:
        return []
    return [("Keep the speed constant", case.changed(acceleration=0.0))]


def _more_friction(case: Case, found: Judgement) -> list[Candidate]:
    if found.governs not in ("slip_up", "slip_down", "friction_unknown"):
        return []
    required = required_friction(theta_s=found.nominal.theta_s, a=case.acceleration)
    needed = math.ceil(100 * float(required.max()) + 1)
    if needed / 100 > LARGEST_FRICTION:
        return []
    surface = Surface.of_friction(needed / 100)
    if case.surface is None:
        text = f"Make sure of a friction of {needed / 100:.2f} or more"
    else:
        text = f"A surface with a friction of {needed / 100:.2f} or more"
    return [(text, case.changed(surface=surface))]


def _measured(case: Case, found: Judgement) -> list[Candidate]:
    unmeasured = [
        name for name in ("theta_d", "theta_M") if getattr(case, name).source == "default"
    ]
    if not unmeasured or found.governs not in ("tip_downhill", "tip_uphill"):
        return []
    zero = Allowance(low=0.0, high=0.0)
    if found.margin_at_best <= 0:
        return []
    text = f"Measure {' and '.join(unmeasured)}: at best, if they are zero"
    return [(text, case.changed(**dict.fromkeys(unmeasured, zero)))]


def _centroid_moved(case: Case, found: Judgement) -> list[Candidate]:
    """Shift of the centroid that would give a tip margin of zero, if the track is long enough."""
    if found.governs not in ("tip_downhill", "tip_uphill"):
        return []
    short = -at_risk(found.worst.centroid, case.risk)
    at, step, tilt = found.nominal, found.step, case.theta_d.high + case.theta_M.high
    L, p, C_N = float(at.L[0, 0]), float(at.p[0, step]), float(at.C_N[0, 0])
    theta = float(at.theta_s[0, step])
    room = L - 2 * p - C_N * (math.tan(theta + tilt) - math.tan(theta - case.theta_d.high))
    if not np.isfinite(short) or short <= 0 or room < 0:
        return []
    shift = math.ceil(1e3 * short + 1) / 1e3
    uphill = found.governs == "tip_downhill"
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
