"""Acceleration on a regular flight: what is safe throughout, and what a plan could do in area E."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from kaidan.mechanics import STANDARD_GRAVITY, band, tipping
from kaidan.mechanics.acceleration import acceleration_plan, tip_band
from kaidan.mechanics.drive import drive_acceleration
from kaidan.mechanics.margin import semi_stable_limit
from kaidan.mechanics.margins import AccelerationBounds, acceleration_bounds
from kaidan.mechanics.plane import two_contacts_remain
from kaidan.mechanics.slipping import slip_acceleration_down, slip_acceleration_up
from kaidan.mechanics.validity import validity
from kaidan.models.drive_limits import traction_limit
from kaidan.models.findings import Array, at_risk
from kaidan.models.samples import Draws, draws
from kaidan.question import Question

CREEP = 0.05
"""Slowest speed of a plan over the drive's largest: at rest nothing follows a position."""


def bounds(question: Question, at: Draws) -> tuple[AccelerationBounds, AccelerationBounds]:
    """Bounds of the acceleration over the whole flight.

    First the sheets' figures without allowances; then, for what is called safe, less the
    allowances and at the chosen risk.
    """
    bare = acceleration_bounds(
        L=at.L, C_L=at.C_L, C_N=at.C_N, p=at.p, theta_s=at.theta_s, mu_s=at.mu_low
    )
    safe = (_safe_bounds(question, block) for block in draws(question, at))
    return _tightest([bare], question.risk), _tightest(safe, question.risk)


def _safe_bounds(question: Question, at: Draws) -> AccelerationBounds:
    """Bounds of the acceleration less the allowances in the worst case.

    Far beyond what any robot does a steeper slope widens a tip limit: the allowances never do.
    """
    inside = validity(holds=two_contacts_remain(L=at.L, p=at.p))
    centroid: dict[str, Any] = {"C_L": at.C_L, "C_N": at.C_N, "p": at.p}

    def tips(down: Array, up: Array) -> tuple[Array, Array]:
        return (
            inside * tipping.min_a_r0(L=at.L, theta_s=down, **centroid),
            inside * tipping.max_a_rn(theta_s=up, **centroid),
        )

    tilt_d = question.allowance_d.high
    tilt = tilt_d + question.allowance_M.high
    down, up = tips(at.theta_s, at.theta_s)
    tilted_down, sunk_up = tips(at.theta_s + tilt, at.theta_s - tilt_d)
    down, up = np.minimum(down, tilted_down), np.maximum(up, sunk_up)
    slides_down = inside * slip_acceleration_up(mu_s=at.mu_low, theta_s=at.theta_s)
    slides_up = inside * slip_acceleration_down(mu_s=at.mu_low, theta_s=at.theta_s)
    return AccelerationBounds(
        slides_down,
        slides_up,
        down,
        up,
        band.a_max(a_S=slides_down, min_a_r0=down),
        band.a_min_with_slip(a_slides_up=slides_up, max_a_rn=up),
    )


_SIGN = AccelerationBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0)
"""1 for an upper bound, -1 for a lower one."""


def _tightest(blocks: Iterable[AccelerationBounds], risk: float) -> AccelerationBounds:
    """Bounds that hold on every step and in all but a share `risk` of the samples."""
    least: list[Array] = []
    for block in blocks:
        here = [(s * b).min(axis=-1) for s, b in zip(_SIGN, block, strict=True)]
        least = [np.minimum(a, b) for a, b in zip(least, here, strict=True)] if least else here
    return AccelerationBounds(
        *(s * at_risk(values, risk) for s, values in zip(_SIGN, least, strict=True))
    )


def semi_stable(question: Question, at: Draws, step: int) -> bool:
    """Whether the robot can follow an a(d) through areas D and E (ranges at their worst).

    Not where an input is uncertain, because a plan holds for one set of figures; and not where the
    limits make it lose or gain speed from nosing to nosing, because the flight would decide.
    """
    drive = question.robot.drive
    if not drive.acceleration_control or drive.max_speed is None or question.uncertain:
        return False
    lower, upper, width = flight_band(question, at, step)
    if not lower @ width <= 0 <= upper @ width:
        return False
    plan = plan_acceleration(question, at, step, v_min=CREEP * drive.max_speed)
    return bool(plan.reserve >= 0)


def plan_acceleration(question: Question, at: Draws, step: int, v_min: float = 0.0) -> Any:
    """Acceleration over one flight of the governing step, within the drive's limits.

    at: nominal inputs (the first row counts).
    v_min: slowest speed of the plan [m/s].

    Along the path in the direction of travel, over all nosing spacings; see
    `kaidan.mechanics.acceleration.acceleration_plan`.
    """
    lower, upper, width = flight_band(question, at, step)
    fastest = question.robot.drive.max_speed
    return acceleration_plan(
        lower=lower,
        upper=upper,
        width=width,
        v_max=fastest if fastest is not None else math.inf,
        v_min=v_min,
        v_start=question.speed,
    )


def flight_band(question: Question, at: Draws, step: int) -> tuple[Array, Array, Array]:
    """Lower and upper limit of the acceleration along the path, and length, of each cell."""
    theta_s, p = float(at.theta_s[0, step]), float(at.p[0, step])
    L, C_L, C_N = float(at.L[0, 0]), float(at.C_L[0, 0]), float(at.C_N[0, 0])
    mu = float(at.mu_low[0, 0])
    drive = question.robot.drive
    force, mass = traction_limit(question, drive.max_speed), question.stance.mass
    tilt_d = question.allowance_d.high
    tilt_down = tilt_d + question.allowance_M.high
    downhill = tip_band(L=L, p=p, C_L=C_L, C_N=C_N, theta_s=theta_s + tilt_down)
    uphill = tip_band(L=L, p=p, C_L=C_L, C_N=C_N, theta_s=theta_s - tilt_d)
    upper = np.fmin(downhill.upper, slip_acceleration_up(mu_s=mu, theta_s=theta_s))
    lower = np.fmax(uphill.lower, slip_acceleration_down(mu_s=mu, theta_s=theta_s))
    if force is not None and mass is not None:
        of_drive: dict[str, Any] = {
            "M": mass,
            "c_rr": question.rolling_resistance,
            "theta_s": theta_s,
        }
        upper = np.minimum(upper, drive_acceleration(F=force, **of_drive))
        lower = np.maximum(lower, drive_acceleration(F=-force, **of_drive))
    width = np.diff(downhill.edges)
    if question.direction == "down":
        lower, upper, width = -upper[::-1], -lower[::-1], width[::-1]
    upper = np.minimum(upper, drive.max_acceleration or STANDARD_GRAVITY)
    lower = np.maximum(lower, -(drive.max_deceleration or STANDARD_GRAVITY))
    assert question.flight is not None
    spans = len(question.flight.regular_steps)
    return np.tile(lower, spans), np.tile(upper, spans), np.tile(width, spans)


def semi_stable_angle(at: Draws, step: int) -> float:
    """Slope up to which area E could ever serve, drive and friction unlimited [rad]."""
    return float(
        semi_stable_limit(L=at.L[0, 0], p=at.p[0, step], C_L=at.C_L[0, 0], C_N=at.C_N[0, 0])
    )
