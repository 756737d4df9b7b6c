"""The closed form: the paper's criterion on a regular flight, both readings, every sample."""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.assessment.answer import Verdict
from kaidan.assessment.case import Array, Case, Draws, draws, nominal
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.acceleration import acceleration_plan, tip_band
from kaidan.mechanics.drive import drive_acceleration, drive_slope
from kaidan.mechanics.margin import (
    centroid_margin_downhill,
    centroid_margin_uphill,
    semi_stable_limit,
)
from kaidan.mechanics.margins import Mode, margins
from kaidan.mechanics.plane import contact_count, two_contacts_remain
from kaidan.mechanics.slipping import slip_acceleration_down, slip_acceleration_up
from kaidan.robot import Stance

MODEL = "closed-form"
LARGEST_IRREGULARITY = 0.0095
"""Difference within a flight up to which it counts as regular [m]: IBC 1011.5.4 allows 9.5 mm."""

CREEP = 0.05
"""Slowest speed of a plan over the drive's largest: at rest nothing follows a position."""

MODES = (*(mode.name.lower() for mode in Mode), "drive")


_TIPS = (Mode.TIP_DOWNHILL, Mode.TIP_UPHILL)
"""The first of `MODES`; past the limit of any other the robot slips or stalls: no area E."""


class Reading(NamedTuple):
    """Margins on one reading of what is only known as a range, over the whole flight."""

    modes: Array
    """Margin of slope of each of `MODES` [rad], (5, samples); NaN: not known."""
    worst: Array
    """Smallest of each sample [rad]; minus infinity where the model does not hold."""
    centroid: Array
    """How far the centroid may move [m], (samples,); minus infinity where no place holds."""


class Judgement(NamedTuple):
    """What the closed form finds, before it is put into words."""

    verdict: Verdict
    governs: str
    step: int
    """Index of the governing step among the flight's different regular steps."""
    margin: float
    """Smallest margin at the chosen risk, worst reading [rad]; NaN outside the model."""
    margin_at_best: float
    stance: Stance
    nominal: Draws
    """One row: the sheets' figures."""
    worst: Reading
    best: Reading
    outside: str
    """Why the model does not apply; empty if it does."""
    semi_stable: bool
    """Whether an acceleration that follows the position goes through area E."""


def judge(case: Case) -> Judgement:
    """Judge a case by the paper's criterion.

    Parameters
    ----------
    case : Case
        The question.

    Returns
    -------
    Judgement
    """
    stance = case.stance
    at = nominal(case, stance)
    worst, best, share_outside = _readings(case, stance, at)
    outside = _outside(case, stance, share_outside)
    margin, margin_at_best = at_risk(worst.worst, case.risk), at_risk(best.worst, case.risk)
    if not outside and margin_at_best == -np.inf:
        outside = "the nosing spacing may well be more than half the flat length of the track"
    per_mode = [at_risk(mode, case.risk) for mode in worst.modes]
    governing = min(range(len(MODES)), key=lambda mode: _nan_last(per_mode[mode]))
    step = 0
    if at.p.size > 1:
        step = int(np.argmin(_margins(case, stance, at).modes[governing, WORST, 0]))
    governs, semi_stable = MODES[governing], False
    verdict: Verdict
    if outside:
        verdict, governs, margin, margin_at_best = "outside-model", "validity", np.nan, np.nan
    elif margin > 0 and case.surface is not None:
        verdict = "go"
    elif margin_at_best > 0:
        verdict = "caution"
        if margin > 0:
            governs = "friction_unknown"
    else:
        holds = not any(margin <= 0 for margin in per_mode[len(_TIPS) :])
        semi_stable = holds and _semi_stable(case, stance, at, step)
        verdict = "caution" if semi_stable else "no-go"
    return Judgement(
        verdict,
        governs,
        step,
        margin,
        margin_at_best,
        stance,
        at,
        worst,
        best,
        outside,
        semi_stable,
    )


def _nan_last(value: float) -> float:
    return math.inf if math.isnan(value) else value


def at_risk(values: Array, risk: float) -> float:
    """Value that all but a share `risk` of the samples exceed.

    It is positive just where the share of samples that are zero or negative is at most `risk`.
    """
    if len(values) == 1:
        return float(values[0])
    if np.isnan(values).all():
        return math.nan
    return float(np.sort(np.where(np.isnan(values), -np.inf, values))[int(risk * len(values))])


class _Margins(NamedTuple):
    """Margins on both readings; axes: (mode,) reading, sample, step."""

    modes: Array
    centroid: Array


WORST, BEST = 0, 1
"""Readings of what is only known as a range, in the order in which they are counted."""


def _margins(case: Case, stance: Stance, at: Draws) -> _Margins:
    """Margins of every mode, and of the centroid, on the worst and the best reading."""
    theta_d, theta_M = case.theta_d, case.theta_M
    tilt_d = np.array([[[theta_d.high]], [[theta_d.low]]])
    tilt_M = np.array([[[theta_M.high]], [[theta_M.low]]])
    geometry: dict[str, Any] = {"p": at.p, "C_L": at.C_L, "C_N": at.C_N, "a": case.acceleration}
    bare = margins(
        L=at.L,
        theta_s=at.theta_s,
        mu_s=np.array((at.mu_low, at.mu_high)),
        theta_d=tilt_d,
        theta_M=tilt_M,
        **geometry,
    )
    modes = np.empty((len(MODES), *np.shape(bare.worst)))
    modes[: len(Mode)] = bare.tip_downhill, bare.tip_uphill, bare.slip_up, bare.slip_down
    modes[-1] = bare.inside * (steepest_for_drive(case, stance, case.acceleration) - at.theta_s)
    tilted = at.theta_s + (tilt_d + tilt_M)
    downhill = centroid_margin_downhill(L=at.L, theta_s=tilted, **geometry)
    uphill = centroid_margin_uphill(theta_s=at.theta_s - tilt_d, **geometry)
    upright = np.where(tilted < math.pi / 2, downhill, -np.inf)
    return _Margins(modes, np.minimum(upright, uphill))


def _readings(case: Case, stance: Stance, at: Draws) -> tuple[Reading, Reading, float]:
    """Both readings over the whole flight, and the share of samples outside the model."""
    found = [_over_steps(case, stance, block) for block in draws(case, at)]
    modes, centroid, outside = found[0]
    for others in found[1:]:
        modes, centroid = np.minimum(modes, others[0]), np.minimum(centroid, others[1])
        outside = outside | others[2]
    worst = np.fmin.reduce(modes, axis=0)
    worst[np.isnan(modes[: len(_TIPS)]).any(axis=0)] = -np.inf
    readings = [Reading(modes[:, i], worst[i], centroid[i]) for i in (WORST, BEST)]
    return readings[WORST], readings[BEST], np.count_nonzero(outside) / len(outside)


def _over_steps(case: Case, stance: Stance, at: Draws) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Smallest margins over the steps, of the modes and of the centroid; what is outside."""
    found = _margins(case, stance, at)
    beyond: NDArray[np.bool_] = np.any(~two_contacts_remain(L=at.L, p=at.p), axis=-1)
    return found.modes.min(axis=-1), found.centroid.min(axis=-1), beyond


def traction_limit(case: Case, speed: float | None = None) -> float | None:
    """Largest sum of tractive forces [N] at a speed, the asked one without; None: not known.

    The power counts only on the way up: what the drive can brake on the way down is another
    figure, which no sheet gives.
    """
    drive = case.drive
    limits = [drive.max_traction] if drive.max_traction is not None else []
    speed = case.speed if speed is None else speed
    if drive.max_power is not None and speed and case.direction == "up":
        limits.append(drive.max_power * drive.efficiency / speed)
    return min(limits) if limits else None


def steepest_for_drive(case: Case, stance: Stance, a: Any) -> Any:
    """Steepest slope on which the drive brings the traction for an acceleration.

    Parameters
    ----------
    case : Case
        The question; `a` stands for its acceleration.
    stance : Stance
        Of the case's robot.
    a : float or array
        Acceleration up the stairs [m/s^2].

    Returns
    -------
    float or array
        Slope [rad], at most pi/2; NaN where traction or mass is not known.
    """
    force = traction_limit(case)
    if force is None or stance.mass is None:
        return math.nan
    known: dict[str, Any] = {"F": force, "M": stance.mass, "c_rr": case.rolling_resistance}
    with np.errstate(invalid="ignore"):
        limit = drive_slope(a=a, **known)
    any_or_none = np.where(force > stance.mass * a, math.pi / 2, -math.pi / 2)
    return np.minimum(np.where(np.isnan(limit), any_or_none, limit), math.pi / 2)


def gap_below(case: Case, stance: Stance) -> str:
    """Why nosings are not carried all along the underside; empty if they are."""
    if case.robot.track.gap > 0:
        return (
            f"{case.robot.track.gap * 1e3:.0f} mm in the middle of the underside have no track "
            "to carry a nosing"
        )
    return "a flipper reaches below the underside of the track" if stance.tips_below else ""


def _outside(case: Case, stance: Stance, share_outside: float) -> str:
    if not case.steps_known:
        return "the terrain is no flight of stairs"
    if share_outside > case.risk:
        p = max(math.hypot(rise, going) for rise, going in case.stairs.regular_steps)
        spacing, half = f"the nosing spacing of {p * 1e3:.0f} mm", "more than half the flat length"
        if not two_contacts_remain(L=stance.flat_length, p=p):
            return (
                f"{spacing} is {half} of {stance.flat_length * 1e3:.0f} mm (p > L/2), so one "
                "nosing alone carries the robot at times"
            )
        return (
            f"{spacing} is {half} of {stance.flat_length * 1e3:.0f} mm (p > L/2) with a "
            f"probability of {share_outside:.2g}, more than the accepted {case.risk:g}"
        )
    gap = gap_below(case, stance)
    if gap:
        return gap
    if case.stairs.irregularity > LARGEST_IRREGULARITY + 1e-12:
        return (
            f"the steps differ by {case.stairs.irregularity * 1e3:.1f} mm, more than the "
            f"{LARGEST_IRREGULARITY * 1e3:.1f} mm up to which a flight counts as regular"
        )
    nosings = len(case.stairs.step_rises)
    if nosings < contact_count(L=stance.flat_length, p=case.stairs.nosing_spacing) + 1:
        return f"the flight's {nosings} nosings are fewer than the track holds at once"
    return ""


def _semi_stable(case: Case, stance: Stance, at: Draws, step: int) -> bool:
    """Whether the robot can follow an a(d) through areas D and E (worst reading of the ranges).

    Not where an input is uncertain, because a plan holds for one set of figures; and not where the
    limits make it lose or gain speed from nosing to nosing, because the flight would decide.
    """
    drive = case.drive
    if not drive.acceleration_control or drive.max_speed is None or case.uncertain:
        return False
    lower, upper, width = flight_band(case, stance, at, step)
    if not lower @ width <= 0 <= upper @ width:
        return False
    plan = plan_acceleration(case, stance, at, step, v_min=CREEP * drive.max_speed)
    return bool(plan.reserve >= 0)


def plan_acceleration(case: Case, stance: Stance, at: Draws, step: int, v_min: float = 0.0) -> Any:
    """Acceleration over one flight of the governing step, within the drive's limits.

    Parameters
    ----------
    case : Case
        The question; its acceleration plays no part.
    stance : Stance
        Of the case's robot.
    at : Draws
        Nominal inputs (the first row counts).
    step : int
        Which of the flight's different steps.
    v_min : float
        Slowest speed of the plan [m/s].

    Returns
    -------
    Plan
        Along the path in the direction of travel, over all nosing spacings; see
        `kaidan.mechanics.acceleration.acceleration_plan`.
    """
    lower, upper, width = flight_band(case, stance, at, step)
    return acceleration_plan(
        lower=lower,
        upper=upper,
        width=width,
        v_max=case.drive.max_speed if case.drive.max_speed is not None else math.inf,
        v_min=v_min,
        v_start=case.speed,
    )


def flight_band(case: Case, stance: Stance, at: Draws, step: int) -> tuple[Array, Array, Array]:
    """Lower and upper limit of the acceleration along the path, and length, of each cell."""
    theta_s, p = float(at.theta_s[0, step]), float(at.p[0, step])
    L, C_L, C_N = float(at.L[0, 0]), float(at.C_L[0, 0]), float(at.C_N[0, 0])
    mu = float(at.mu_low[0, 0])
    drive, force = case.drive, traction_limit(case, case.drive.max_speed)
    tilt_down = case.theta_d.high + case.theta_M.high
    downhill = tip_band(L=L, p=p, C_L=C_L, C_N=C_N, theta_s=theta_s + tilt_down)
    uphill = tip_band(L=L, p=p, C_L=C_L, C_N=C_N, theta_s=theta_s - case.theta_d.high)
    upper = np.fmin(downhill.upper, slip_acceleration_up(mu_s=mu, theta_s=theta_s))
    lower = np.fmax(uphill.lower, slip_acceleration_down(mu_s=mu, theta_s=theta_s))
    if force is not None and stance.mass is not None:
        known: dict[str, Any] = {"M": stance.mass, "c_rr": case.rolling_resistance}
        upper = np.minimum(upper, drive_acceleration(F=force, theta_s=theta_s, **known))
        lower = np.maximum(lower, drive_acceleration(F=-force, theta_s=theta_s, **known))
    width = np.diff(downhill.edges)
    if case.direction == "down":
        lower, upper, width = -upper[::-1], -lower[::-1], width[::-1]
    upper = np.minimum(upper, drive.max_acceleration or STANDARD_GRAVITY)
    lower = np.maximum(lower, -(drive.max_deceleration or STANDARD_GRAVITY))
    spans = len(case.stairs.regular_steps)
    return np.tile(lower, spans), np.tile(upper, spans), np.tile(width, spans)


def semi_stable_angle(at: Draws, step: int) -> float:
    """Slope up to which area E could ever serve, drive and friction unlimited [rad]."""
    return float(
        semi_stable_limit(L=at.L[0, 0], p=at.p[0, step], C_L=at.C_L[0, 0], C_N=at.C_N[0, 0])
    )
