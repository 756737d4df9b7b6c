"""From a judgement to an answer: numbers with their units, what governs in words, notes."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from kaidan.assessment.answer import AllowanceShown, Assessment, Paper, Probability
from kaidan.assessment.case import Array, Case, Draws, draws
from kaidan.assessment.closed_form import MODEL, MODES, Judgement, at_risk, traction_limit
from kaidan.assessment.pose import Pose, contacts_at, governing_pose, measures_at
from kaidan.mechanics import drive, tipping
from kaidan.mechanics.margin import theta_s_inf, theta_s_sup
from kaidan.mechanics.margins import AccelerationBounds, acceleration_bounds
from kaidan.mechanics.plane import Area, area, two_contacts_remain
from kaidan.mechanics.slipping import (
    required_friction,
    slip_acceleration_down,
    slip_acceleration_up,
)
from kaidan.mechanics.validity import validity

NAMES = {
    "tip_downhill": "tipping over its downhill end",
    "tip_uphill": "tipping over its uphill end",
    "slip_up": "sliding down for lack of friction",
    "slip_down": "sliding on uphill for lack of friction",
    "drive": "too little traction of the drive",
}
"""Failure modes as people say them."""


def put_into_words(case: Case, found: Judgement) -> Assessment:
    """Answer of a case from what the closed form found, advice not yet in it."""
    stance, pose = found.stance, governing_pose(case, found)
    inside = found.verdict != "outside-model"
    angle, p, a, mass = pose.theta_s, pose.p, case.acceleration, stance.mass
    bare, safe = _bounds(case, found)
    band_low, band_high = _band(bare.a_min, bare.a_max) if inside else (None, None)
    safe_low, safe_high = _band(safe.a_min, safe.a_max) if inside else (None, None)
    brake = None if safe_low is None else -safe_low
    start, stop = (safe_high, brake) if case.direction == "up" else (brake, safe_high)
    sup = float(theta_s_sup(L=pose.L, p=p, C_L=pose.C_L, C_N=pose.C_N, a=a))
    inf = float(theta_s_inf(p=p, C_L=pose.C_L, C_N=pose.C_N, a=a))
    modes = [at_risk(mode, case.risk) for mode in found.worst.modes]
    uncertain = len(found.worst.worst) > 1
    traction, power = _traction_and_power(case, pose, mass)
    return Assessment(
        verdict=found.verdict,
        model=MODEL,
        governs=found.governs,  # type: ignore[arg-type]
        reason=_reason(case, found),
        robot=case.robot.name,
        stairs=case.stairs.name,
        surface=case.surface.name if case.surface else None,
        direction=case.direction,
        facing=case.facing,
        area=_area(case, found, safe) if inside else None,
        angle_deg=math.degrees(angle) if case.steps_known else None,
        nosing_spacing_m=p if case.steps_known else None,
        contacts_n=pose.n,
        flat_length_m=stance.flat_length,
        com_from_front_m=stance.com_from_front,
        com_height_m=stance.com_height,
        mass_kg=mass,
        margin_angle_deg=math.degrees(sup) if inside else None,
        lower_angle_deg=math.degrees(inf) if inside and inf > 0 else None,
        margin_backward_deg=math.degrees(sup - angle) if inside else None,
        margin_deg=_degrees(found.margin),
        margin_at_best_deg=_degrees(found.margin_at_best),
        margins_deg={
            name: _degrees(value) if inside else None
            for name, value in zip(MODES, modes, strict=True)
        },
        margin_interval_deg=_interval(found.worst.worst) if uncertain and inside else None,
        margin_centroid_mm=(
            _number(1e3 * at_risk(found.worst.centroid, case.risk)) if inside else None
        ),
        allowances={
            name: AllowanceShown(
                low_deg=math.degrees(value.low),
                high_deg=math.degrees(value.high),
                source=value.source,
            )
            for name, value in (("theta_d", case.theta_d), ("theta_M", case.theta_M))
        },
        acceleration=a,
        a_slip_up=_number(bare.slip_up) if inside else None,
        a_slip_down=_number(bare.slip_down) if inside else None,
        a_tip_downhill=_number(bare.tip_downhill) if inside else None,
        a_tip_uphill=_number(bare.tip_uphill) if inside else None,
        falls_over=_falls_over(case, found, bare) if inside else None,
        a_max=band_high,
        a_min=band_low,
        a_max_safe=safe_high,
        a_min_safe=safe_low,
        hardest_start=start if start is not None and start > 0 else None,
        hardest_stop=stop if stop is not None and stop > 0 else None,
        paper=Paper(
            a_S=_number(bare.slip_up),
            min_a_r0=bare.tip_downhill,
            max_a_rn=bare.tip_uphill,
            a_max=bare.a_max,
            a_min=tipping.a_min(max_a_rn=bare.tip_uphill),
        )
        if inside
        else None,
        required_friction=float(required_friction(theta_s=found.nominal.theta_s, a=a).max()),
        friction=(case.surface.friction_low, case.surface.friction_high) if case.surface else None,
        contacts=contacts_at(pose, a, mass) if inside else (),
        traction_N=traction,
        power_W=power,
        measures=measures_at(pose, a, mass, case.speed) if inside else None,
        probability=_probability(found) if uncertain else None,
        risk=case.risk,
        margin_force_N=None,
        phase=None,
        step=None,
        phases=(),
        grades=None,
        yaw_deg=math.degrees(case.yaw),
        yaw_limit_deg=None,
        what_would_help=(),
        notes=_notes(case, found, pose),
    )


def _bounds(case: Case, found: Judgement) -> tuple[AccelerationBounds, AccelerationBounds]:
    """Bounds of the acceleration over the whole flight.

    First the sheets' figures without allowances; then, for what is called safe, with the
    allowances taken off and at the chosen risk.
    """
    at = found.nominal
    bare = acceleration_bounds(
        L=at.L, C_L=at.C_L, C_N=at.C_N, p=at.p, theta_s=at.theta_s, mu_s=at.mu_low
    )
    safe = (_safe_bounds(case, block) for block in draws(case, at))
    return _tightest([bare], case.risk), _tightest(safe, case.risk)


def _safe_bounds(case: Case, at: Draws) -> AccelerationBounds:
    """Bounds of the acceleration with the worst reading of the allowances taken off.

    Far beyond what any robot does a steeper slope widens a tip limit: the allowances never do.
    """
    inside = validity(holds=two_contacts_remain(L=at.L, p=at.p))
    centroid: dict[str, Any] = {"C_L": at.C_L, "C_N": at.C_N, "p": at.p}

    def tips(down: Array, up: Array) -> tuple[Array, Array]:
        return (
            inside * tipping.min_a_r0(L=at.L, theta_s=down, **centroid),
            inside * tipping.max_a_rn(theta_s=up, **centroid),
        )

    tilt = case.theta_d.high + case.theta_M.high
    down, up = tips(at.theta_s, at.theta_s)
    tilted_down, sunk_up = tips(at.theta_s + tilt, at.theta_s - case.theta_d.high)
    down, up = np.minimum(down, tilted_down), np.maximum(up, sunk_up)
    slip_up = inside * slip_acceleration_up(mu_s=at.mu_low, theta_s=at.theta_s)
    slip_down = inside * slip_acceleration_down(mu_s=at.mu_low, theta_s=at.theta_s)
    return AccelerationBounds(
        slip_up,
        slip_down,
        down,
        up,
        tipping.a_max(a_S=slip_up, min_a_r0=down),
        tipping.a_min_with_slip(a_slip_down=slip_down, max_a_rn=up),
    )


_SIGN = AccelerationBounds(1.0, -1.0, 1.0, -1.0, 1.0, -1.0)
"""1 for an upper bound, -1 for a lower one."""


def _tightest(blocks: Iterable[AccelerationBounds], risk: float) -> AccelerationBounds:
    """Bounds that hold on every step and in all but a share `risk` of the samples."""
    least: list[Array] = []
    for bounds in blocks:
        here = [(s * b).min(axis=-1) for s, b in zip(_SIGN, bounds, strict=True)]
        least = [np.minimum(a, b) for a, b in zip(least, here, strict=True)] if least else here
    return AccelerationBounds(
        *(s * at_risk(values, risk) for s, values in zip(_SIGN, least, strict=True))
    )


def _band(low: Any, high: Any) -> tuple[float | None, float | None]:
    return (float(low), float(high)) if low < high else (None, None)


def _number(value: Any) -> float | None:
    return float(value) if math.isfinite(value) else None


def _degrees(value: float) -> float | None:
    return math.degrees(value) if math.isfinite(value) else None


def _interval(values: Array) -> tuple[float, float] | None:
    ordered = np.degrees(np.sort(values))
    low, high = ordered[int(0.025 * len(ordered))], ordered[int(0.975 * len(ordered))]
    return (float(low), float(high)) if np.isfinite(low) else None


def _traction_and_power(
    case: Case, pose: Pose, mass: float | None
) -> tuple[float | None, float | None]:
    if mass is None:
        return None, None
    force = drive.drive_force(
        M=mass, a=case.acceleration, theta_s=pose.theta_s, c_rr=case.rolling_resistance
    )
    if case.speed is None:
        return float(force), None
    v = case.speed if case.direction == "up" else -case.speed
    return float(force), float(drive.drive_power(F=force, v=v, eta=case.drive.efficiency))


def _area(case: Case, found: Judgement, safe: AccelerationBounds) -> Any:
    """Worst area that the asked acceleration reaches over the progress, allowances off."""
    if found.semi_stable:
        return Area.E.name
    limits = {
        "a_S": safe.slip_up if case.surface else np.inf,
        "a_slip_down": safe.slip_down if case.surface else -np.inf,
        "a_r0": safe.tip_downhill,
        "a_rn": safe.tip_uphill,
        "min_a_r0": safe.tip_downhill,
        "max_a_rn": safe.tip_uphill,
    }
    return Area(int(area(a=case.acceleration, **limits))).name


def _falls_over(case: Case, found: Judgement, bare: AccelerationBounds) -> Any:
    fails = found.verdict == "no-go"
    over_downhill = case.acceleration > bare.tip_downhill or (
        fails and found.governs == "tip_downhill"
    )
    over_uphill = case.acceleration < bare.tip_uphill or (fails and found.governs == "tip_uphill")
    if not (over_downhill or over_uphill):
        return None
    return "tail" if over_downhill == case.nose_up else "nose"


def _probability(found: Judgement) -> Probability:
    def share(values: Array) -> float | None:
        if np.isnan(values).all():
            return None
        return float(np.mean(~(values > 0)))

    each = [share(mode) for mode in found.worst.modes]
    return Probability(
        tip_downhill=each[0] if each[0] is not None else 1.0,
        tip_uphill=each[1] if each[1] is not None else 1.0,
        slip_up=each[2],
        slip_down=each[3],
        drive=each[4],
        tip_sideways=None,
        outside_model=float(np.mean(np.isneginf(found.worst.worst))),
        any=float(np.mean(~(found.worst.worst > 0))),
    )


def _reason(case: Case, found: Judgement) -> str:
    if found.outside:
        return f"Outside the closed form: {found.outside}."
    margin = math.degrees(found.margin)
    held = NAMES.get(found.governs, found.governs)
    if found.verdict == "go":
        return f"Stable with {margin:.1f} deg to spare; nearest is {held}."
    if found.governs == "friction_unknown":
        return "It does not tip, but the friction is not known: it may slip."
    if found.semi_stable:
        return (
            f"Only by controlling the acceleration over the position (area E): at "
            f"{case.acceleration:g} m/s^2 throughout it fails by {held}."
        )
    if found.verdict == "caution":
        best = math.degrees(found.margin_at_best)
        return (
            f"Between {margin:.1f} and {best:+.1f} deg, depending on what is only known as a "
            f"range; in doubt is {held}."
        )
    return f"It fails by {held}, {-margin:.1f} deg beyond the limit."


def _notes(case: Case, found: Judgement, pose: Pose) -> tuple[str, ...]:
    notes = ["This model judges the traverse of the regular flight, not entering or landing."]
    if case.stairs.irregularity > 0:
        notes.append(
            f"The steps differ by {1e3 * case.stairs.irregularity:.1f} mm; the worst of them is "
            "judged as if the whole flight were like it."
        )
    if case.speed and found.verdict != "outside-model":
        shown = measures_at(pose, case.acceleration, None, case.speed)
        if 0 < shown.energy_margin_mm < (shown.speed_height_mm or 0.0):
            notes.append(
                f"At {case.speed:g} m/s the kinetic energy could lift the centroid "
                f"{shown.speed_height_mm:.2f} mm, more than the energy margin of "
                f"{shown.energy_margin_mm:.2f} mm: expect it to swing."
            )
    return (*notes, *notes_of_any_model(case), *notes_of_robot(case))


def notes_of_any_model(case: Case) -> tuple[str, ...]:
    """What was assumed or not stated, whichever model judges."""
    notes = []
    for name, value in (("theta_d", case.theta_d), ("theta_M", case.theta_M)):
        if value.source == "default":
            notes.append(
                f"{name} is not measured: 0 to {math.degrees(value.high):.1f} deg assumed; "
                "measure it to settle the doubt."
            )
    if case.surface is None:
        notes.append("No friction was stated, so no GO can be given.")
    if traction_limit(case) is None or case.stance.mass is None:
        text = "The drive's traction is not known and not judged."
        if case.drive.max_traction is not None or case.drive.max_power is not None:
            missing = "mass" if case.stance.mass is None else "speed"
            text = f"The drive is not judged: that takes the {missing}, which is not stated."
        notes.append(text)
    return tuple(notes)


def notes_of_robot(case: Case) -> tuple[str, ...]:
    """What its data sheet says of the robot."""
    return (" ".join(case.robot.notes.split()),) if case.robot.notes else ()
