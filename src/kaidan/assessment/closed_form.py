"""The closed form: the paper's criterion on a regular flight, both readings, every sample."""

import math
from typing import Any, NamedTuple

import numpy as np

from kaidan.assessment.answer import Verdict
from kaidan.assessment.case import Array, Case, Draws, draws
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.acceleration import acceleration_plan, tip_band
from kaidan.mechanics.drive import drive_acceleration, drive_slope
from kaidan.mechanics.margin import (
    centroid_margin_downhill,
    centroid_margin_uphill,
    semi_stable_limit,
)
from kaidan.mechanics.margins import Margins, Mode, margins
from kaidan.mechanics.slipping import slip_acceleration_down, slip_acceleration_up
from kaidan.robot import Stance

MODEL = "closed-form"
LARGEST_IRREGULARITY = 0.0095
"""Difference within a flight up to which it counts as regular [m]: IBC 1011.5.4 allows 9.5 mm."""

MODES = (*(mode.name.lower() for mode in Mode), "drive")


class Reading(NamedTuple):
    """Margins on one reading of what is only known as a range; axes: mode, sample, step."""

    modes: Array
    """Margin of slope of each of `MODES` [rad], (5, samples, steps); NaN: not known."""
    bare: Margins
    """What the formulas gave, without drive."""
    centroid: Array
    """How far the centroid may move [m], (samples, steps)."""

    @property
    def worst(self) -> Array:
        """Smallest margin of each sample [rad]; minus infinity where the model does not hold."""
        smallest = np.fmin.reduce(self.modes, axis=0).min(axis=-1)
        return np.where(np.isnan(smallest), -np.inf, smallest)


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
    sampled, nominal = draws(case, stance), draws(case, stance, certain=True)
    worst = _read(case, stance, sampled, kind=False)
    best = _read(case, stance, sampled, kind=True)
    outside = _outside(case, stance, sampled)
    margin, margin_at_best = at_risk(worst.worst, case.risk), at_risk(best.worst, case.risk)
    if not outside and margin_at_best == -np.inf:
        outside = "the nosing spacing may well be more than half the flat length of the track"
    per_mode = np.array([at_risk(mode.min(axis=-1), case.risk) for mode in worst.modes])
    governing = int(np.nanargmin(per_mode)) if np.isfinite(per_mode).any() else 0
    step = int(np.argmin(worst.modes[governing].mean(axis=0)))
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
        semi_stable = _semi_stable(case, stance, nominal, step)
        verdict = "caution" if semi_stable else "no-go"
    return Judgement(
        verdict,
        governs,
        step,
        margin,
        margin_at_best,
        stance,
        nominal,
        worst,
        best,
        outside,
        semi_stable,
    )


def at_risk(values: Array, risk: float) -> float:
    """Value that all but a share `risk` of the samples exceed.

    It is positive just where the share of samples that are zero or negative is at most `risk`.
    """
    if np.isnan(values).all():
        return math.nan
    return float(np.sort(np.where(np.isnan(values), -np.inf, values))[int(risk * len(values))])


def _read(case: Case, stance: Stance, at: Draws, *, kind: bool) -> Reading:
    theta_d = case.theta_d.low if kind else case.theta_d.high
    theta_M = case.theta_M.low if kind else case.theta_M.high
    bare = margins(
        L=at.L,
        C_L=at.C_L,
        C_N=at.C_N,
        theta_s=at.theta_s,
        p=at.p,
        mu_s=at.mu_high if kind else at.mu_low,
        a=case.acceleration,
        theta_d=theta_d,
        theta_M=theta_M,
    )
    shape = np.shape(bare.worst)
    modes = np.empty((len(MODES), *shape))
    modes[: len(Mode)] = bare.tip_downhill, bare.tip_uphill, bare.slip_up, bare.slip_down
    modes[-1] = _drive_margin(case, stance, at)
    tilted = at.theta_s + theta_d + theta_M
    downhill = centroid_margin_downhill(
        L=at.L, p=at.p, C_L=at.C_L, C_N=at.C_N, theta_s=tilted, a=case.acceleration
    )
    uphill = centroid_margin_uphill(
        p=at.p, C_L=at.C_L, C_N=at.C_N, theta_s=at.theta_s - theta_d, a=case.acceleration
    )
    return Reading(modes, bare, np.minimum(downhill, uphill))


def traction_limit(case: Case) -> float | None:
    """Largest sum of tractive forces at the asked speed [N]; None where it is not known."""
    drive = case.drive
    limits = [drive.max_traction] if drive.max_traction is not None else []
    if drive.max_power is not None and case.speed:
        limits.append(drive.max_power * drive.efficiency / case.speed)
    return min(limits) if limits else None


def _drive_margin(case: Case, stance: Stance, at: Draws) -> Any:
    force = traction_limit(case)
    if force is None or stance.mass is None:
        return math.nan
    known: dict[str, Any] = {"F": force, "M": stance.mass, "c_rr": case.drive.rolling_resistance}
    spare = drive_acceleration(theta_s=math.pi / 2, **known) - case.acceleration
    with np.errstate(invalid="ignore"):
        limit = drive_slope(a=case.acceleration, **known)
    return np.where(spare >= 0, math.pi / 2, limit) - at.theta_s


def _outside(case: Case, stance: Stance, at: Draws) -> str:
    n = stance.flat_length / case.stairs.nosing_spacing
    share_outside = float(np.mean((2 * at.p > at.L).any(axis=-1)))
    if share_outside > case.risk:
        return (
            f"the nosing spacing of {case.stairs.nosing_spacing * 1e3:.0f} mm is more than half "
            f"the flat length of {stance.flat_length * 1e3:.0f} mm (p > L/2), so one nosing alone "
            "carries the robot at times"
        )
    if case.robot.track.gap > 0:
        return (
            f"{case.robot.track.gap * 1e3:.0f} mm in the middle of the underside have no track "
            "to carry a nosing"
        )
    if stance.tips_below:
        return "a flipper reaches below the underside of the track"
    if case.stairs.irregularity > LARGEST_IRREGULARITY + 1e-12:
        return (
            f"the steps differ by {case.stairs.irregularity * 1e3:.1f} mm, more than the "
            f"{LARGEST_IRREGULARITY * 1e3:.1f} mm up to which a flight counts as regular"
        )
    nosings = len(case.stairs.step_rises)
    if nosings < math.floor(n) + 1:
        return f"the flight's {nosings} nosings are fewer than the track holds at once"
    return ""


def _semi_stable(case: Case, stance: Stance, at: Draws, step: int) -> bool:
    """Whether the robot can follow an a(d) through areas D and E (worst reading of the ranges)."""
    drive = case.drive
    if not drive.acceleration_control or drive.max_speed is None:
        return False
    plan = plan_acceleration(case, stance, at, step)
    return bool(plan.reserve >= 0)


def plan_acceleration(case: Case, stance: Stance, at: Draws, step: int) -> Any:
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
        v_start=case.speed,
    )


def flight_band(case: Case, stance: Stance, at: Draws, step: int) -> tuple[Array, Array, Array]:
    """Lower and upper limit of the acceleration along the path, and length, of each cell."""
    theta_s, p = float(at.theta_s[0, step]), float(at.p[0, step])
    L, C_L, C_N = float(at.L[0, 0]), float(at.C_L[0, 0]), float(at.C_N[0, 0])
    mu = float(at.mu_low[0, 0])
    drive, force = case.drive, traction_limit(case)
    tilt_down = case.theta_d.high + case.theta_M.high
    downhill = tip_band(L=L, p=p, C_L=C_L, C_N=C_N, theta_s=theta_s + tilt_down)
    uphill = tip_band(L=L, p=p, C_L=C_L, C_N=C_N, theta_s=theta_s - case.theta_d.high)
    upper = np.fmin(downhill.upper, slip_acceleration_up(mu_s=mu, theta_s=theta_s))
    lower = np.fmax(uphill.lower, slip_acceleration_down(mu_s=mu, theta_s=theta_s))
    if force is not None and stance.mass is not None:
        most = drive_acceleration(
            F=force, M=stance.mass, theta_s=theta_s, c_rr=drive.rolling_resistance
        )
        upper = np.minimum(upper, most)
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
