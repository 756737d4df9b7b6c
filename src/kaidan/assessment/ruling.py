"""Verdict of the contact model on the whole way of any profile, in three grades.

Grade one, no rotation, is the paper's criterion and alone can give a GO. Grades two (a static pose
catches the robot) and three (it is caught with the momentum gained) are told beside it and give at
best a CAUTION, because no experiment confirms such a catch: the paper's rig fell at 55-57 degrees
where a smooth rigid tail would have caught it up to 62. The user may accept them by name.
"""

import math
from typing import Literal, NamedTuple

from kaidan.assessment.answer import Grades, PhaseShown, Verdict
from kaidan.assessment.case import Case
from kaidan.assessment.readings import (
    FALL,
    Reading,
    energy_margin,
    hardest_drop,
    largest_swing,
    no_rotation,
    reading_of,
)
from kaidan.assessment.spread import share_out_of_reach
from kaidan.assessment.yaw import SWING_SPEED
from kaidan.climb import Climb, Phase
from kaidan.contact import Status
from kaidan.mechanics.measures import kinetic_energy_height

Accept = Literal["no-rotation", "caught"]


_ALIKE = 1e-6
"""Difference of two turns that is rounding [deg]."""
_SOLVER = (Status.NOT_CONVERGED, Status.TOO_LONG, Status.NO_START)


NAMES = {
    "tip_downhill": "tipping over its downhill end",
    "tip_uphill": "tipping over its uphill end",
    "tip_sideways": "tipping over its side",
    "slip": "lack of friction",
    "drive": "too little traction of the drive",
    "stuck": "getting stuck",
}


class Ruling(NamedTuple):
    """Verdict of the contact model alone: what it says of any profile, stairs or not."""

    verdict: Verdict
    governs: str
    reason: str
    margin: float
    """Smallest margin of slope, allowances off [rad]; NaN: not known."""
    at_best: float
    """The same on the kindest reading [rad]."""
    phase: str | None
    step: int | None
    phases: tuple[PhaseShown, ...]
    grades: Grades
    doubts: tuple[str, ...]
    """What keeps it from being a GO."""


def ruling(case: Case, found: Climb, *, accept: Accept) -> Ruling:
    """Verdict on a traverse by the contact model alone.

    Parameters
    ----------
    case : Case
        The question.
    found : Climb
        Its traverse.
    accept : {"no-rotation", "caught"}
        What the operator accepts as holding.

    Returns
    -------
    Ruling
    """
    worst, best = reading_of(case, found, kind=False), reading_of(case, found, kind=True)
    threshold = float(kinetic_energy_height(v=case.speed or SWING_SPEED))
    energy = energy_margin(case, found)
    held, doubts = _held(case, found, threshold, energy, accept)
    verdict, governs = _verdict(case, found, worst, best, held, doubts, accept)
    phase, step = _where(case, found, governs)
    margin, at_best = worst.worst, best.worst
    if accept == "caught" and held:  # what tips is caught
        margin, at_best = min(worst.supply, FALL), min(best.supply, FALL)
    if verdict == "outside-model":
        margin = at_best = math.nan
    return Ruling(
        verdict=verdict,
        governs=governs,
        reason=_reason(case, found, verdict, governs, margin, doubts, phase, step),
        margin=margin,
        at_best=at_best,
        phase=phase,
        step=step,
        phases=_phases_shown(found),
        grades=Grades(
            no_rotation=no_rotation(case, found),
            caught=found.arrived,
            caught_with_momentum=found.arrived and found.held_with_momentum,
            largest_swing_deg=math.degrees(largest_swing(found)),
            energy_threshold_mm=1e3 * threshold,
            speed_stated=bool(case.speed),
            accepted=accept,
        ),
        doubts=doubts,
    )


def _phases_shown(found: Climb) -> tuple[PhaseShown, ...]:
    return tuple(
        PhaseShown(
            phase=each.phase.value,
            required_friction=_finite(each.required_friction),
            required_friction_step=each.required_friction_step,
            slides_below=None if each.slides_below is None else _finite(each.slides_below),
            energy_margin_mm=_finite(each.energy_margin_mm),
            energy_margin_step=each.energy_margin_step,
            static_margin_mm=each.static_margin_mm,
            traction_over_weight=each.traction_over_weight,
            largest_swing_deg=each.largest_swing_deg,
            belly_touches=each.belly_touches,
        )
        for each in found.phases
    )


def _held(
    case: Case, found: Climb, threshold: float, energy: float, accept: Accept
) -> tuple[bool, tuple[str, ...]]:
    """Whether the robot arrives with momentum counted, and what keeps that from being a GO."""
    doubts = []
    drop = hardest_drop(case, found)
    if accept != "caught" and drop is not None and drop.spare <= 0:
        doubts.append(
            f"it drops by {math.degrees(drop.turn):.0f} deg over an edge, and holds only because "
            "the impact takes momentum"
        )
    if energy <= threshold:
        doubts.append(
            f"the energy margin of {1e3 * energy:.2f} mm is less than the "
            f"{1e3 * threshold:.2f} mm that its speed is worth: expect it to swing"
        )
    if any(each.belly_touches for each in found.phases):
        doubts.append("the belly carries the robot in places (high-centring)")
    doubtful = share_out_of_reach(case, found)
    if case.risk < doubtful < 1:
        doubts.append(
            f"with a probability of {doubtful:.2g} fewer than two nosings stay on the track "
            "(p > L/2)"
        )
    stairs_reach = found.outline.reach[0] + found.outline.reach[1]
    if min(found.profile.landings) < stairs_reach:
        doubts.append(f"a landing is shorter than the robot's {stairs_reach:.2f} m")
    return found.arrived and found.held_with_momentum, tuple(doubts)


def _answered(case: Case, found: Climb) -> bool:
    """Whether the model has an answer.

    Under an acceleration effective gravity leans with the path, which turns at once where a contact
    is exchanged: a pose that then rocks between two contacts tells of the model, not of the robot.
    """
    rocks = found.status is Status.STUCK and case.acceleration != 0
    return found.status not in _SOLVER and not rocks


def _verdict(
    case: Case,
    found: Climb,
    worst: Reading,
    best: Reading,
    held: bool,
    doubts: tuple[str, ...],
    accept: Accept,
) -> tuple[Verdict, str]:
    if not _answered(case, found):
        return "outside-model", "validity"
    friction_known = case.surface is not None
    supply, supply_best = worst.supply, best.supply
    no_rotation, at_best = worst.tip, best.tip
    holds = held and (no_rotation > 0 or accept == "caught")
    if holds and supply > 0 and not doubts:
        return ("go", worst.governs) if friction_known else ("caution", "friction_unknown")
    if found.arrived and supply_best > 0:
        if no_rotation > 0 and supply > 0 and friction_known:
            return "caution", "energy" if held else "momentum"
        if at_best > 0 or no_rotation > 0:
            return "caution", worst.governs if worst.worst <= 0 else "friction_unknown"
        return "caution", "catch"
    return "no-go", "stuck" if found.status is Status.STUCK else worst.governs


def _where(case: Case, found: Climb, governs: str) -> tuple[str | None, int | None]:
    """Phase and step number at which the governing failure shows."""
    if governs in ("slip", "friction_unknown") and found.phases:
        hardest = max(found.phases, key=lambda each: each.required_friction)
        return hardest.phase.value, hardest.required_friction_step
    drop = hardest_drop(case, found) if governs == "energy" else None
    if drop is not None and drop.spare <= 0:
        return drop.phase.value, drop.step
    fell = [h for h in found.happenings if h.what.startswith(("fell", "stuck"))]
    if fell:
        return fell[-1].phase.value, fell[-1].step
    swings = [h for h in found.happenings if h.swing_deg and h.phase is Phase.TRAVERSE]
    if swings:  # the first of those that are alike: the way repeats itself
        largest = max(each.swing_deg or 0.0 for each in swings)
        worst = next(each for each in swings if (each.swing_deg or 0.0) > largest - _ALIKE)
        return worst.phase.value, worst.step
    traverse = [each for each in found.phases if each.phase is Phase.TRAVERSE]
    return ("traverse", traverse[0].energy_margin_step) if traverse else (None, None)


def _reason(
    case: Case,
    found: Climb,
    verdict: Verdict,
    governs: str,
    margin: float,
    doubts: tuple[str, ...],
    phase: str | None,
    step: int | None,
) -> str:
    place = "" if phase is None else f" ({phase}, step {step})"
    if verdict == "outside-model":
        return f"The contact model has no answer: {found.status.message}."
    if verdict == "no-go":
        if not found.arrived:
            return f"It does not get there: {found.status.message}{place}."
        return f"It fails by {NAMES.get(governs, governs)}{place}."
    if verdict == "go":
        return (
            f"It enters, traverses and lands with {math.degrees(margin):.1f} deg to spare; "
            f"nearest is {NAMES.get(governs, governs)}{place}."
        )
    if governs == "catch" and largest_swing(found) == 0.0:
        if no_rotation(case, found):
            return (
                "On the sheets' figures it does not turn, but at the risk asked for it does, "
                f"{-math.degrees(margin):.1f} deg beyond the limit{place}."
            )
        return (
            "It gets there without turning, but where it leaves a nosing no experiment says "
            f"that what is left holds{place}."
        )
    if governs == "catch":
        topples = "" if found.held_with_momentum else ", and with the momentum gained it topples"
        return (
            f"Held only by a catch that no experiment confirms: it swings by "
            f"{math.degrees(largest_swing(found)):.1f} deg{place}{topples}."
        )
    if governs == "momentum":
        return f"It may topple with the momentum it gains{place}."
    if governs == "energy" and doubts:
        return f"It gets there, but {doubts[0]}."
    if governs == "friction_unknown":
        return f"It does not tip, but the friction is not known: it may slip{place}."
    return f"In doubt is {NAMES.get(governs, governs)}{place}: kind or unkind, by the ranges given."


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
