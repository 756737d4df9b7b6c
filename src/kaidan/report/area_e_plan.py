"""A plan of the acceleration over the position through area E, or the reason why there is none."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.assessment.case import Case
from kaidan.assessment.closed_form import (
    CREEP,
    Judgement,
    flight_band,
    plan_acceleration,
    semi_stable_angle,
)
from kaidan.robot import Drive

Array = NDArray[np.float64]


class Planned(NamedTuple):
    """What `--accelerate` found; accelerations and speeds along the path [m/s^2, m/s]."""

    reason: str
    """One sentence: what the plan keeps to, or why there is none."""
    found: bool
    needless: bool
    """Whether a constant speed keeps to all limits, allowances taken off."""
    repeats: bool
    """Whether the limits leave an acceleration that is zero on average over a nosing spacing."""
    path: Array
    """Edges of the cells along the path [m]; empty without a plan."""
    a: Array
    """Acceleration in each cell, in the direction of travel."""
    lower: Array
    """Band it keeps to, allowances and the drive's limits taken off."""
    upper: Array
    v: Array
    """Speed at the edges."""
    reserve: float
    """Distance of the acceleration from its band everywhere; NaN without a plan."""
    needed_speed: float
    """Smallest speed limit with which there is a plan; NaN where none would help."""
    steepest: float
    """Slope beyond which area E serves no flight, drive and friction unlimited [rad]."""
    spans: int
    """Nosing spacings of the flight."""

    def as_dict(self) -> dict[str, Any]:
        """Everything, for JSON."""
        return {
            "found": self.found,
            "needless": self.needless,
            "repeats": self.repeats,
            "reason": self.reason,
            "reserve": self.reserve,
            "needed_speed": self.needed_speed,
            "semi_stable_angle_deg": math.degrees(self.steepest),
            "nosing_spacings": self.spans,
            "path_m": self.path,
            "a_along_path": self.a,
            "a_along_path_low": self.lower,
            "a_along_path_high": self.upper,
            "speed": self.v,
        }


def planned(case: Case, found: Judgement) -> Planned:
    """Plan of the acceleration over a whole flight, or why there is none.

    Parameters
    ----------
    case : Case
        The question; its acceleration plays no part.
    found : Judgement
        What the closed form found for it.

    Returns
    -------
    Planned
    """
    step = found.step
    none = np.empty(0)
    missing = Planned(
        reason=f"No plan: outside the closed form, {found.outside}.",
        found=False,
        needless=False,
        repeats=False,
        path=none,
        a=none,
        lower=none,
        upper=none,
        v=none,
        reserve=math.nan,
        needed_speed=math.nan,
        steepest=semi_stable_angle(found.nominal, step),
        spans=len(case.stairs.regular_steps),
    )
    if found.outside:
        return missing
    lower, upper, width = flight_band(case, found.stance, found.nominal, step)
    drive = case.drive
    slowest = CREEP * (drive.max_speed or 0.0)
    missing = missing._replace(
        needless=bool(np.all((lower <= 0) & (upper >= 0))),
        repeats=bool(np.sum(lower * width) <= 0 <= np.sum(upper * width)),
        needed_speed=least_speed_limit(lower=lower, upper=upper, width=width, v_min=slowest),
    )
    if not drive.acceleration_control or drive.max_speed is None:
        return missing._replace(reason=_why_not(case, found, missing))
    plan = plan_acceleration(case, found.stance, found.nominal, step, v_min=slowest)
    if not plan.reserve >= 0:
        return missing._replace(reason=_why_not(case, found, missing))
    more = ""
    if missing.needless:
        more = " A constant speed would do as well."
    elif not missing.repeats:
        change = "lose" if plan.v[-1] < plan.v[0] else "gain"
        more = f" It must {change} speed over the whole flight and enter it at {plan.v[0]:.2f} m/s."
    return missing._replace(
        reason=(
            f"An acceleration that follows the position holds it: {plan.a.min():+.2f} to "
            f"{plan.a.max():+.2f} m/s2 along the path, {plan.v.min():.2f} to {plan.v.max():.2f} "
            f"m/s, {plan.reserve:.2f} m/s2 from its limits everywhere.{more}"
        ),
        found=True,
        path=np.concatenate([[0.0], np.cumsum(width)]),
        a=plan.a,
        lower=lower,
        upper=upper,
        v=plan.v,
        reserve=plan.reserve,
    )


def least_speed_limit(*, lower: Array, upper: Array, width: Array, v_min: float = 0.0) -> float:
    """Smallest speed limit with which an acceleration within its band takes the whole path.

    Carried back, ``E_i = max(v_min^2/2, E_(i+1) - upper w)`` is the least energy from which the
    rest can be driven; carried forward, ``E_(i+1) = max(that, E_i + lower w)`` is the slowest way
    of all, and its fastest place is the limit that is needed.

    Parameters
    ----------
    lower, upper : array
        Band of the acceleration along the path in each cell [m/s^2].
    width : array
        Length of each cell [m].
    v_min : float
        Slowest speed allowed [m/s].

    Returns
    -------
    float
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


def _why_not(case: Case, found: Judgement, missing: Planned) -> str:
    """Why there is no plan, the first reason that holds."""
    robot, drive, needed = case.robot, case.drive, missing.needed_speed
    if missing.needless and case.speed is None:
        return "No plan is needed: a constant speed keeps to all limits, allowances taken off."
    if not drive.acceleration_control:
        text = (
            f"No plan: no acceleration control is stated for {robot.name} "
            "(drive.acceleration_control in its sheet), so area E counts as unstable."
        )
        return text + _with_control(needed, drive.max_speed)
    if drive.max_speed is None:
        text = f"No plan: no largest speed is stated for {robot.name} (drive.max_speed)."
        return text + _with_control(needed, drive.max_speed)
    if math.isnan(needed) or needed > drive.max_speed:
        slope = float(found.nominal.theta_s[0, found.step])
        slope += case.theta_d.high + case.theta_M.high
        if slope > missing.steepest:
            return (
                f"No plan: {math.degrees(slope):.1f} deg (theta_d and theta_M included) is beyond "
                f"{math.degrees(missing.steepest):.1f} deg, where the mean of a_r0 over a nosing "
                "spacing is negative: no acceleration that repeats from nosing to nosing holds it."
            )
        helps = _what_would_do(case, found, CREEP * drive.max_speed)
        if math.isnan(needed):
            return f"No plan: at some place no acceleration is allowed at all.{helps}"
        return (
            f"No plan: it takes up to {needed:.2f} m/s, and the drive's largest speed is "
            f"{drive.max_speed:g} m/s.{helps}"
        )
    return f"No plan from a speed of {case.speed:g} m/s at the start."


def _with_control(needed: float, most: float | None) -> str:
    if math.isnan(needed):
        return " With it there would be none either: at some place no acceleration is allowed."
    limit = "" if most is None or most > needed else f" (the drive's largest is {most:g} m/s)"
    return f" With it, and speeds up to {needed:.2f} m/s{limit}, there would be one."


def _what_would_do(case: Case, found: Judgement, slowest: float) -> str:
    """Say which single limit, if lifted, would leave a plan within the drive's speed."""
    drive, at = case.drive, found.nominal
    assert drive.max_speed is not None

    def with_drive(**changes: None) -> Case:
        free = Drive.model_validate(drive.model_dump() | changes)
        return case.changed(robot=case.robot.model_copy(update={"drive": free}))

    ideas = {
        "a drive that changes its speed faster": (
            with_drive(max_acceleration=None, max_deceleration=None),
            at,
        ),
        "a drive that pulls harder": (with_drive(max_traction=None, max_power=None), at),
        "more friction": (case, at._replace(mu_low=np.full_like(at.mu_low, np.nan))),
    }
    helpful = []
    for text, (changed, draws) in ideas.items():
        lower, upper, width = flight_band(changed, found.stance, draws, found.step)
        band: dict[str, Array] = {"lower": lower, "upper": upper, "width": width}
        if least_speed_limit(**band, v_min=slowest) <= drive.max_speed:
            helpful.append(text)
    return f" It would do with {' or '.join(helpful)}." if helpful else ""
