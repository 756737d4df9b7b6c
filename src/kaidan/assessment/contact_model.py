"""The contact model's answer: one call for entering, traversing and landing on any profile."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from kaidan.assessment.advice import Outcome, WholeWay, by_contact_model
from kaidan.assessment.answer import Assessment, Change, Probability
from kaidan.assessment.case import Array, Case
from kaidan.assessment.closed_form import Judgement, at_risk
from kaidan.assessment.readings import Reading, energy_margin, reading_of
from kaidan.assessment.ruling import Accept, Ruling, ruling
from kaidan.assessment.spread import share_out_of_reach
from kaidan.assessment.wording import notes_of_any_model, notes_of_robot
from kaidan.assessment.yaw import along_heading, yaw_limit
from kaidan.climb import Climb, climb
from kaidan.contact import Status
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.outline import Outline
from kaidan.profile import Profile

MODEL = "contact"


LONG_FLIGHT = 60
"""Risers of a uniform flight that stand for any more: twice the nosings under the longest robot,
so that every pose recurs and the arrival is like that of the whole flight."""


def profile_of(case: Case) -> Profile:
    """Terrain along the heading: a profile of its own, or that of the stairs, seen obliquely."""
    if case.profile is not None:
        return case.profile
    stairs = case.stairs
    if repeats(case):
        stairs = stairs.model_copy(update={"steps": LONG_FLIGHT})
    return Profile.of_stairs(along_heading(stairs, case.yaw) if case.yaw else stairs)


def repeats(case: Case) -> bool:
    """Whether the flight is uniform and so long that the robot's way along it repeats itself."""
    stairs = case.stairs
    if case.profile is not None or stairs.rise is None or stairs.steps <= LONG_FLIGHT:
        return False
    reach = sum(Outline.of(case.robot, case.posture, case.payload).reach)
    return reach < LONG_FLIGHT / 2 * stairs.nosing_spacing


def climb_of(case: Case, *, with_energy: bool = False, compiled: bool | None = None) -> Climb:
    """Traverse of a case's robot over its stairs, or over its own profile; see `climb`."""
    return climb(
        profile_of(case),
        Outline.of(case.robot, case.posture, case.payload),
        descending=case.direction == "down",
        facing=case.facing,
        acceleration=case.acceleration,
        with_energy=with_energy,
        compiled=compiled,
    )


def answer(case: Case, judged: Judgement, flat: Assessment, *, accept: Accept) -> Assessment:
    """Answer by the contact model.

    Parameters
    ----------
    case : Case
        The question.
    judged, flat : Judgement, Assessment
        The closed form's answer to the same question: its figures stay where it is valid.
    accept : {"no-rotation", "caught"}
        What the operator accepts as holding.

    Returns
    -------
    Assessment
        With phases, grades and what governs where.
    """
    found = climb_of(case)
    worst, best = reading_of(case, found, kind=False), reading_of(case, found, kind=True)
    told = ruling(case, found, accept=accept)
    verdict, margin = told.verdict, told.margin
    limit = yaw_limit(case)
    if case.yaw:
        flat = replace(
            flat,
            angle_deg=math.degrees(case.stairs.angle),
            nosing_spacing_m=case.stairs.nosing_spacing,
            margin_centroid_mm=None,
            margin_angle_deg=None,
            lower_angle_deg=None,
            margin_backward_deg=None,
        )
    angle = 0.0 if flat.angle_deg is None else math.radians(flat.angle_deg)
    needed = [each.required_friction for each in found.phases]
    if case.steps_known and flat.required_friction is not None:
        needed.append(flat.required_friction)
    mass = flat.mass_kg
    return replace(
        flat,
        verdict=verdict,
        model=MODEL,
        governs=told.governs,  # type: ignore[arg-type]
        reason=told.reason,
        margin_deg=_degrees(margin),
        margin_at_best_deg=_degrees(told.at_best),
        margins_deg={
            "tip_downhill": _degrees(worst.margin("tip_downhill")),
            "tip_uphill": _degrees(worst.margin("tip_uphill")),
            **({"tip_sideways": _degrees(worst.margin("tip_sideways"))} if case.yaw else {}),
            "slip_up": _degrees(worst.margin("slip")),
            "slip_down": flat.margins_deg["slip_down"],
            "drive": _degrees(worst.margin("drive")),
        },
        margin_interval_deg=_interval(worst),
        probability=_probability(case, found, worst),
        margin_force_N=_force(mass, angle, margin),
        margin_centroid_mm=flat.margin_centroid_mm
        if flat.margin_centroid_mm is not None
        else None
        if case.yaw
        else _millimetres(found.centroid_margin),
        required_friction=_finite(
            math.hypot(max(needed), math.tan(angle) * math.sin(case.yaw)) if needed else math.nan
        ),
        falls_over=_falls_over(case, found, flat),
        phase=told.phase,  # type: ignore[arg-type]
        step=told.step,
        phases=told.phases,
        grades=told.grades,
        what_would_help=_advice(case, found, judged, told, best.worst > 0, accept),
        yaw_deg=math.degrees(case.yaw),
        yaw_limit_deg=None if limit is None else math.degrees(limit),
        notes=_notes(case, found, told.doubts),
    )


def _advice(
    case: Case, found: Climb, judged: Judgement, told: Ruling, kind: bool, accept: Accept
) -> tuple[Change, ...]:
    """What would help, by the contact model."""

    def ask(changed: Case) -> Outcome:
        again = found if _drives_alike(case, changed) else climb_of(changed)
        then = ruling(changed, again, accept=accept)
        return Outcome(then.verdict, then.margin)

    whole = WholeWay(
        governs=told.governs,
        entering_or_landing=told.phase in ("enter", "land"),
        friction=max((each.required_friction for each in found.phases), default=math.nan),
        energy=energy_margin(case, found),
        kind=kind,
    )
    return by_contact_model(case, whole, judged, Outcome(told.verdict, told.margin), ask)


def _drives_alike(case: Case, other: Case) -> bool:
    """Whether two cases ask about one and the same way: friction and allowances play no part."""
    return all(
        getattr(case, name) == getattr(other, name)
        for name in ("robot", "posture", "payload", "direction", "facing", "acceleration", "yaw")
    )


def _falls_over(case: Case, found: Climb, flat: Assessment) -> Any:
    if found.status is Status.FELL_BACKWARD:
        return "tail" if case.facing == "nose-first" else "nose"
    if found.status is Status.FELL_FORWARD:
        return "nose" if case.facing == "nose-first" else "tail"
    return flat.falls_over


def _force(mass: float | None, angle: float, margin: float) -> float | None:
    """Force along the slope through the centroid that uses the margin up [N]."""
    if mass is None or math.isnan(margin):
        return None
    limit = min(max(angle + margin, -1.5), 1.5)
    return mass * STANDARD_GRAVITY * math.cos(angle) * (math.tan(limit) - math.tan(angle))


def _notes(case: Case, found: Climb, doubts: tuple[str, ...]) -> tuple[str, ...]:
    notes = [f"{doubt[0].upper()}{doubt[1:]}." for doubt in doubts]
    notes += notes_of_any_model(case)
    if repeats(case):
        notes.append(
            f"The {case.stairs.steps} risers are alike, so the way repeats itself: it is driven on "
            f"{LONG_FLIGHT} of them, and steps are counted on those."
        )
    if case.yaw:
        notes.append(
            "At a yaw: tipping by the polygon of both tracks' contacts on the flight; entering, "
            "landing and energy as of one track on the flight along the heading, a little too hard."
        )
    elif case.robot.track.gauge is None and case.profile is None:
        notes.append("The tracks' distance (track.gauge) is not known, so no yaw can be judged.")
    if found.criterion.outside and not case.yaw:
        notes.append(
            "Somewhere fewer than two nosings carry the track (p > L/2): the paper's criterion "
            "says nothing there, so there is no GO."
        )
    slides = max((each.slides_below or 0.0 for each in found.phases), default=0.0)
    if slides > (0.0 if case.surface is None else case.surface.friction_low):
        notes.append(
            f"Landing, with a friction below {slides:.2f} its trailing end slides down the last "
            "risers: a bump of a riser at most, no fall."
        )
    if found.outline.gyration_estimated:
        notes.append("The moment of inertia is estimated as that of an even box.")
    if found.profile.open_risers:
        notes.append("Open risers: the model gives them faces that are not there.")
    if found.profile.overhangs:
        notes.append("Nosings overhang: the model stands on their upper envelope.")
    return (*notes, *notes_of_robot(case))


def _interval(worst: Reading) -> tuple[float, float] | None:
    """95 % interval of the smallest margin [deg]; None if all is certain or nothing known."""
    if len(worst.smallest) == 1 or np.isnan(worst.smallest).any():
        return None
    low, high = np.degrees([at_risk(worst.smallest, share) for share in (0.025, 0.975)])
    return (float(low), float(high)) if math.isfinite(low) else None


def _probability(case: Case, found: Climb, worst: Reading) -> Probability | None:
    """Share of samples that fail; None if all is certain."""
    if len(worst.smallest) == 1:
        return None

    def share(values: Array) -> float | None:
        return None if np.isnan(values).all() else float(np.mean(~(values > 0)))

    down, up, side, slip, drive = (share(mode) for mode in worst.samples)
    outside = share_out_of_reach(case, found)
    return Probability(
        tip_downhill=1.0 if down is None else down,
        tip_sideways=side,
        tip_uphill=0.0 if up is None and down is not None else 1.0 if up is None else up,
        slip_up=slip,
        slip_down=None,
        drive=drive,
        outside_model=outside,
        any=max(outside, float(np.mean(~(worst.smallest > 0)))),
    )


def _degrees(value: float) -> float | None:
    return math.degrees(value) if math.isfinite(value) else None


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _millimetres(value: float) -> float | None:
    return 1e3 * value if math.isfinite(value) else None
