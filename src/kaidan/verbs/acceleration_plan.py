"""A plan of the acceleration over the position through area E, or the reason why there is none."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Part
from kaidan.models.acceleration import (
    CREEP,
    flight_band,
    plan_acceleration,
    semi_stable_angle,
)
from kaidan.models.closed_form_figures import Basis
from kaidan.question import Question
from kaidan.robot import Drive
from kaidan.verbs.sentences import acceleration_plan as said

Array = NDArray[np.float64]
Column = tuple[float, ...]


class AccelerationPlan(Part):
    """Acceleration over the position; accelerations and speeds along the path, ahead positive."""

    found: bool
    """Whether there is a plan."""
    needless: bool
    """Whether a constant speed keeps to all limits, allowances subtracted."""
    repeats: bool
    """Whether the limits leave an acceleration that is zero on average over a nosing spacing."""
    reason: str
    """One sentence: what the plan keeps to, or why there is none."""
    reserve: float | None
    """Distance of the acceleration from its limits everywhere [m/s^2]; null without a plan."""
    needed_speed: float | None
    """Smallest speed limit with which there is a plan [m/s]; null where none would help."""
    semi_stable_angle_deg: float | None
    """Slope beyond which area E serves no flight, drive and friction unlimited [deg]."""
    nosing_spacings: int
    """Nosing spacings of the flight."""
    path_m: Column = ()
    """Edges of the cells along the path [m]; empty without a plan."""
    a_along_path: Column = ()
    """Acceleration in each cell [m/s^2]."""
    a_along_path_low: Column = ()
    """Lower end of its band: allowances and the drive's limits subtracted [m/s^2]."""
    a_along_path_high: Column = ()
    """Upper end of its band [m/s^2]."""
    speed: Column = ()
    """Speed at the edges [m/s]."""


def acceleration_plan(question: Question, basis: Basis, outside: str) -> AccelerationPlan:
    """Plan of the acceleration over a whole flight, or why there is none.

    Parameters
    ----------
    question : Question
        Its acceleration plays no part.
    basis : Basis
        On what the closed form's figures of the question stand.
    outside : str
        Why the closed form does not apply; empty if it does.
    """
    step = basis.step
    steepest = semi_stable_angle(basis.at, step)
    common: dict[str, Any] = {
        "semi_stable_angle_deg": math.degrees(steepest),
        "nosing_spacings": len(question.flight.regular_steps) if question.flight else 0,
    }
    if outside:
        return AccelerationPlan(
            found=False,
            needless=False,
            repeats=False,
            reason=said.outside(outside),
            reserve=None,
            needed_speed=None,
            **common,
        )
    lower, upper, width = flight_band(question, basis.at, step)
    drive = question.robot.drive
    slowest = CREEP * (drive.max_speed or 0.0)
    needed = least_speed_limit(lower=lower, upper=upper, width=width, v_min=slowest)
    needless = bool(np.all((lower <= 0) & (upper >= 0)))
    repeats = bool(np.sum(lower * width) <= 0 <= np.sum(upper * width))
    common |= {"needless": needless, "repeats": repeats, "needed_speed": needed}
    plan = None
    if drive.acceleration_control and drive.max_speed is not None:
        plan = plan_acceleration(question, basis.at, step, v_min=slowest)
    if plan is None or not plan.reserve >= 0:
        why = _why_not(question, basis, needless, needed, steepest)
        return AccelerationPlan(found=False, reason=why, reserve=None, **common)
    reason = said.follows(
        a=(plan.a.min(), plan.a.max()),
        v=(plan.v.min(), plan.v.max()),
        reserve=plan.reserve,
        needless=needless,
        repeats=repeats,
        ends=(plan.v[0], plan.v[-1]),
    )
    return AccelerationPlan(
        found=True,
        reason=reason,
        reserve=plan.reserve,
        path_m=np.concatenate([[0.0], np.cumsum(width)]).tolist(),
        a_along_path=plan.a.tolist(),
        a_along_path_low=lower.tolist(),
        a_along_path_high=upper.tolist(),
        speed=plan.v.tolist(),
        **common,
    )


def least_speed_limit(*, lower: Array, upper: Array, width: Array, v_min: float = 0.0) -> float:
    """Smallest speed limit with which an acceleration within its band takes the whole path.

    Carried back, ``E_i = max(v_min^2/2, E_(i+1) - upper w)`` is the least energy from which the
    rest can be driven; carried forward, ``E_(i+1) = max(that, E_i + lower w)`` is the slowest way
    of all, and its fastest place is the limit that is needed.

    lower, upper: band of the acceleration along the path in each cell [m/s^2].
    width: length of each cell [m].
    v_min: slowest speed allowed [m/s].

    Speed [m/s]; NaN where the band is empty in some cell.

    Examples
    --------
    Braking at 1 m/s^2 or more over 0.5 m takes 1 m/s to begin with.

    >>> one = np.ones(1)
    >>> print(least_speed_limit(lower=-9.0 * one, upper=-1.0 * one, width=0.5 * one))
    1.0
    """
    if bool(np.any(lower > upper)):
        return math.nan
    slowest = v_min**2 / 2
    least = [slowest]
    for most, w in zip(reversed(upper.tolist()), reversed(width.tolist()), strict=True):
        least.append(max(slowest, least[-1] - most * w))
    least.reverse()
    energy = fastest = least[0]
    for floor, low, w in zip(least[1:], lower.tolist(), width.tolist(), strict=True):
        energy = max(floor, energy + low * w)
        fastest = max(fastest, energy)
    return math.sqrt(2 * fastest)


def _why_not(
    question: Question, basis: Basis, needless: bool, needed: float, steepest: float
) -> str:
    """Why there is no plan, the first reason that holds."""
    robot, drive = question.robot, question.robot.drive
    if needless and question.speed is None:
        return said.not_needed()
    if not drive.acceleration_control:
        return said.no_control(robot.name, needed, drive.max_speed)
    if drive.max_speed is None:
        return said.no_largest_speed(robot.name, needed)
    if math.isnan(needed) or needed > drive.max_speed:
        slope = float(basis.at.theta_s[0, basis.step])
        slope += question.allowance_d.high + question.allowance_M.high
        if slope > steepest:
            return said.too_steep(slope, steepest)
        helps = _what_would_do(question, basis, CREEP * drive.max_speed)
        if math.isnan(needed):
            return said.nothing_allowed(helps)
        return said.too_slow(needed, drive.max_speed, helps)
    return said.not_from(question.speed or 0.0)


def _what_would_do(question: Question, basis: Basis, slowest: float) -> list[str]:
    """Single limits that, if lifted, leave a plan within the drive's speed."""
    drive, at = question.robot.drive, basis.at
    assert drive.max_speed is not None

    def with_drive(**changes: None) -> Question:
        free = Drive.model_validate(drive.model_dump() | changes)
        return question.changed(robot=question.robot.model_copy(update={"drive": free}))

    ideas = {
        said.FASTER_CHANGES: (
            with_drive(max_acceleration=None, max_deceleration=None),
            at,
        ),
        said.MORE_TRACTION: (with_drive(max_traction=None, max_power=None), at),
        said.MORE_FRICTION: (question, at._replace(mu_low=np.full_like(at.mu_low, np.nan))),
    }
    helpful = []
    for text, (changed, draws) in ideas.items():
        lower, upper, width = flight_band(changed, draws, basis.step)
        band: dict[str, Array] = {"lower": lower, "upper": upper, "width": width}
        if least_speed_limit(**band, v_min=slowest) <= drive.max_speed:
            helpful.append(text)
    return helpful
