"""The contact model's verdict: entering, traversing and landing on any profile, in three grades.

Grade one, no rotation, is the paper's criterion and alone can give a GO. Grades two (a static pose
catches the robot) and three (it is caught with the momentum gained) are told beside it and give at
best a CAUTION, because no experiment confirms such a catch: the paper's rig fell at 55-57 degrees
where a smooth rigid tail would have caught it up to 62. The user may accept them by name.
"""

import math
from dataclasses import replace
from typing import Any, Literal, NamedTuple

import numpy as np

from kaidan.assessment.answer import Assessment, Grades, PhaseShown, Probability, Verdict
from kaidan.assessment.case import Array, Case
from kaidan.assessment.closed_form import at_risk
from kaidan.assessment.spread import share_out_of_reach, spread
from kaidan.assessment.yaw import (
    SWING_SPEED,
    along_heading,
    polygon_energy,
    polygon_margins,
    yaw_limit,
)
from kaidan.climb import Climb, Phase, climb
from kaidan.contact import Status
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.measures import kinetic_energy_height
from kaidan.mechanics.oblique import equivalent_slope_across
from kaidan.outline import Outline
from kaidan.profile import Profile

MODEL = "contact"

MODES = ("tip_downhill", "tip_uphill", "tip_sideways", "slip", "drive")

LONG_FLIGHT = 60
"""Risers of a uniform flight that stand for any more: twice the nosings under the longest robot,
so that every pose recurs and the arrival is like that of the whole flight."""

FALL = math.pi / 2
"""Turn that a fall counts as where no criterion gives a margin [rad]."""

Accept = Literal["no-rotation", "caught"]

_SOLVER = (Status.NOT_CONVERGED, Status.TOO_LONG, Status.NO_START)


class Reading(NamedTuple):
    """Margins of slope on one reading of what is only known as a range [rad]; NaN: not known."""

    samples: Array
    """Margins of `MODES`, shape (5, samples): one sample if every input is taken as exact."""
    risk: float
    """Share of samples that may fail."""

    def margin(self, mode: str) -> float:
        """Margin of a mode at the risk."""
        return at_risk(self.samples[MODES.index(mode)], self.risk)

    @property
    def smallest(self) -> Array:
        """Smallest margin that is known, of each sample."""
        return np.asarray(np.fmin.reduce(self.samples, axis=0))

    @property
    def worst(self) -> float:
        """Smallest margin that is known, at the risk."""
        return at_risk(self.smallest, self.risk)

    @property
    def tip(self) -> float:
        """Margin against tipping, at the risk; NaN where downhill is not known."""
        tips = np.where(np.isnan(self.samples[0]), np.nan, np.fmin.reduce(self.samples[:3]))
        return at_risk(tips, self.risk)

    @property
    def supply(self) -> float:
        """Margin of friction and drive, at the risk; infinite where neither is known."""
        margin = at_risk(np.fmin(self.samples[3], self.samples[4]), self.risk)
        return math.inf if math.isnan(margin) else margin

    @property
    def governs(self) -> str:
        """Name of the mode with the smallest margin."""
        known = {mode: self.margin(mode) for mode in MODES}
        known = {mode: value for mode, value in known.items() if not math.isnan(value)}
        return min(known, key=lambda mode: known[mode]) if known else "validity"


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


def climb_of(case: Case, *, compiled: bool | None = None) -> Climb:
    """Traverse of a case's robot over its stairs, or over its own profile."""
    return climb(
        profile_of(case),
        Outline.of(case.robot, case.posture, case.payload),
        descending=case.direction == "down",
        facing=case.facing,
        acceleration=case.acceleration,
        compiled=compiled,
    )


class Ruling(NamedTuple):
    """Verdict of the contact model alone: what it says of any profile, stairs or not."""

    verdict: Verdict
    governs: str
    reason: str
    margin: float
    """Smallest margin of slope, allowances off [rad]; NaN: not known."""
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
    worst, best = _reading(case, found, kind=False), _reading(case, found, kind=True)
    threshold = float(kinetic_energy_height(v=case.speed or SWING_SPEED))
    energy = _energy(case, found)
    held, doubts = _held(case, found, threshold, energy)
    verdict, governs = _verdict(case, found, worst, best, held, doubts, accept)
    phase, step = _where(found, governs)
    margin = worst.worst if verdict != "outside-model" else math.nan
    if accept == "caught" and held:
        margin = min(worst.supply, FALL)
    return Ruling(
        verdict=verdict,
        governs=governs,
        reason=_reason(case, found, verdict, governs, margin, doubts, phase, step),
        margin=margin,
        phase=phase,
        step=step,
        phases=_phases_shown(found),
        grades=Grades(
            no_rotation=_no_rotation(case, found),
            caught=found.arrived,
            caught_with_momentum=found.arrived and found.held_with_momentum,
            largest_swing_deg=math.degrees(_swing(found)),
            energy_threshold_mm=1e3 * threshold,
            accepted=accept,
        ),
        doubts=doubts,
    )


def _phases_shown(found: Climb) -> tuple[PhaseShown, ...]:
    return tuple(
        PhaseShown(
            phase=each.phase.value,
            required_friction=each.required_friction,
            required_friction_step=each.required_friction_step,
            energy_margin_mm=_finite(each.energy_margin_mm),
            energy_margin_step=each.energy_margin_step,
            static_margin_mm=each.static_margin_mm,
            traction_over_weight=each.traction_over_weight,
            largest_swing_deg=each.largest_swing_deg,
            belly_touches=each.belly_touches,
        )
        for each in found.phases
    )


def judge(case: Case, found: Climb, flat: Assessment, *, accept: Accept) -> Assessment:
    """Answer by the contact model.

    Parameters
    ----------
    case : Case
        The question.
    found : Climb
        Its traverse.
    flat : Assessment
        The closed form's answer to the same question: its figures stay where it is valid.
    accept : {"no-rotation", "caught"}
        What the operator accepts as holding.

    Returns
    -------
    Assessment
        With phases, grades and what governs where.
    """
    worst, best = _reading(case, found, kind=False), _reading(case, found, kind=True)
    verdict, governs, reason, margin, phase, step, phases, grades, doubts = ruling(
        case, found, accept=accept
    )
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
    angle = math.radians(flat.angle_deg)
    mass = flat.mass_kg
    return replace(
        flat,
        verdict=verdict,
        model=MODEL,
        governs=governs,  # type: ignore[arg-type]
        reason=reason,
        margin_deg=_degrees(margin),
        margin_at_best_deg=_degrees(best.worst) if verdict != "outside-model" else None,
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
        required_friction=math.hypot(
            max([flat.required_friction, *(each.required_friction for each in found.phases)]),
            math.tan(angle) * math.sin(case.yaw),
        ),
        falls_over=_falls_over(case, found, flat),
        phase=phase,  # type: ignore[arg-type]
        step=step,
        phases=phases,
        grades=grades,
        what_would_help=flat.what_would_help if flat.verdict == verdict and not case.yaw else (),
        yaw_deg=math.degrees(case.yaw),
        yaw_limit_deg=None if limit is None else math.degrees(limit),
        notes=_notes(case, found, flat, doubts),
    )


def _no_rotation(case: Case, found: Climb) -> bool | None:
    """Grade one; None where it says nothing: fewer than two contacts stay, or a short flight.

    At a yaw: whether the polygon of both tracks' contacts keeps the zero moment point.
    """
    if case.yaw:
        return bool((polygon_margins(case, certain=True) > 0).all())
    return None if found.criterion.outside else found.criterion.holds


def _swing(found: Climb) -> float:
    """Largest turn in the traverse, a right angle if it falls [rad]."""
    if found.status in (Status.FELL_BACKWARD, Status.FELL_FORWARD):
        return FALL
    return math.radians(
        max((e.largest_swing_deg for e in found.phases if e.phase is Phase.TRAVERSE), default=0.0)
    )


def _reading(case: Case, found: Climb, *, kind: bool) -> Reading:
    theta_d = case.theta_d.low if kind else case.theta_d.high
    theta_M = case.theta_M.low if kind else case.theta_M.high
    one = found.criterion
    bare = [
        _angle_or_side(one.back_margin_angle, one.back_margin),
        _angle_or_side(one.front_margin_angle, one.front_margin),
    ]
    downhill, uphill = reversed(bare) if found.descending else bare
    downhill, uphill = downhill - theta_d - theta_M, uphill - theta_d
    if (case.yaw == 0 and one.outside) or math.isnan(downhill):
        swing = _swing(found)
        downhill, uphill = (-swing if swing > 0 else math.nan), math.nan
    if not found.arrived and not (min(downhill, uphill) <= 0):
        downhill = -FALL
    friction = max((each.required_friction for each in found.phases), default=math.nan)
    mu = math.nan
    if case.surface is not None:
        mu = case.surface.friction_high if kind else case.surface.friction_low
    if case.yaw:  # the load across the track asks for friction too
        across = equivalent_slope_across(theta_s=case.stairs.angle, psi=case.yaw)
        friction = math.hypot(friction, float(across))
    slip, drive = math.atan(mu) - math.atan(friction), _drive(case, found)
    apart = spread(case, found)
    if apart is None:
        samples = np.array([[downhill], [uphill], [math.nan], [slip], [drive]])
    else:
        holding = np.arctan(np.maximum(mu + apart.friction, 0.0))
        samples = np.stack(
            [
                downhill + apart.tip_downhill,
                uphill + apart.tip_uphill,
                np.full(len(apart.angle), math.nan),
                slip + holding - math.atan(mu) - apart.angle,
                drive - apart.angle,
            ]
        )
    if case.yaw:
        off = np.array([[theta_d + theta_M], [theta_d], [theta_d]])
        samples[:3] = polygon_margins(case) - off
        if not found.arrived:
            samples[0] = np.minimum(samples[0], -FALL)
    return Reading(samples, case.risk)


class PhaseMargins(NamedTuple):
    """Margins of one phase alone, allowances off."""

    worst: float
    """Smallest margin of slope [rad]: friction and drive, on the flight tipping as well."""
    steady: bool
    """Whether nothing swings that need not, with more energy margin than the speed is worth."""


def phase_margins(case: Case, found: Climb, phase: Phase) -> PhaseMargins:
    """Margins of a phase that the robot gets through.

    Parameters
    ----------
    case : Case
        The question.
    found : Climb
        Its traverse.
    phase : Phase
        One that it has.

    Returns
    -------
    PhaseMargins
    """
    alone = replace(found, phases=tuple(each for each in found.phases if each.phase is phase))
    reading = _reading(case, alone, kind=False)
    threshold = float(kinetic_energy_height(v=case.speed or SWING_SPEED))
    steady = _energy(case, alone) > threshold and not any(
        each.belly_touches for each in alone.phases
    )
    worst = reading.supply
    if phase is Phase.TRAVERSE:
        tip = reading.tip
        steady = steady and tip > 0
        worst = min(worst, tip) if tip == tip else worst
    return PhaseMargins(min(worst, FALL), bool(steady))


def _angle_or_side(angle: float, metres: float) -> float:
    """Margin of slope; where no slope at all is the limit, a right angle to the side that holds."""
    return math.copysign(FALL, metres) if math.isnan(angle) and metres == metres else angle


def _drive(case: Case, found: Climb) -> float:
    from kaidan.assessment.closed_form import traction_limit

    force, mass = traction_limit(case), found.outline.stance.mass
    needed = max((each.traction_over_weight for each in found.phases), default=math.nan)
    if force is None or mass is None or math.isnan(needed):
        return math.nan
    spare = force / (mass * STANDARD_GRAVITY) - case.drive.rolling_resistance
    return math.asin(min(max(spare, -1.0), 1.0)) - math.asin(min(needed, 1.0))


def _energy(case: Case, found: Climb) -> float:
    """Smallest energy margin of any pose that nothing obliges to turn [m]; infinite: none.

    Obliged to turn are: going down, the robot over the edge of the upper landing; going up, the
    same edge; and on the first nosing, where the nose comes down onto the flight. At a yaw the
    polygon's energy counts on the flight.
    """
    margins = [math.inf]
    for each in found.phases:
        if each.phase is not Phase.ENTER or not found.descending:
            margins.append(each.energy_margin_mm)
        if each.phase is Phase.TRAVERSE:
            margins.append(each.uphill_energy_margin_mm)
    if case.yaw and any(each.phase is Phase.TRAVERSE for each in found.phases):
        margins = [
            each.energy_margin_mm
            for each in found.phases
            if each.phase is (Phase.LAND if found.descending else Phase.ENTER)
        ]
        margins.append(1e3 * polygon_energy(case))
    return 1e-3 * min(margins)


def _held(
    case: Case, found: Climb, threshold: float, energy: float
) -> tuple[bool, tuple[str, ...]]:
    """Whether the robot arrives with momentum counted, and what keeps that from being a GO."""
    doubts = []
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


def _verdict(
    case: Case,
    found: Climb,
    worst: Reading,
    best: Reading,
    held: bool,
    doubts: tuple[str, ...],
    accept: Accept,
) -> tuple[Verdict, str]:
    if found.status in _SOLVER:
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


def _where(found: Climb, governs: str) -> tuple[str | None, int | None]:
    """Phase and step number at which the governing failure shows."""
    if governs in ("slip", "friction_unknown") and found.phases:
        hardest = max(found.phases, key=lambda each: each.required_friction)
        return hardest.phase.value, hardest.required_friction_step
    fell = [h for h in found.happenings if h.what.startswith(("fell", "stuck"))]
    if fell:
        return fell[-1].phase.value, fell[-1].step
    swings = [h for h in found.happenings if h.swing_deg and h.phase is Phase.TRAVERSE]
    if swings:
        worst = max(swings, key=lambda h: h.swing_deg or 0.0)
        return worst.phase.value, worst.step
    traverse = [each for each in found.phases if each.phase is Phase.TRAVERSE]
    return ("traverse", traverse[0].energy_margin_step) if traverse else (None, None)


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
        return f"It fails by {_NAMES.get(governs, governs)}{place}."
    if verdict == "go":
        return (
            f"It enters, traverses and lands with {math.degrees(margin):.1f} deg to spare; "
            f"nearest is {_NAMES.get(governs, governs)}{place}."
        )
    if governs == "catch" and _swing(found) == 0.0:
        if _no_rotation(case, found):
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
            f"{math.degrees(_swing(found)):.1f} deg{place}{topples}."
        )
    if governs == "momentum":
        return f"It may topple with the momentum it gains{place}."
    if doubts:
        return f"It gets there, but {doubts[0]}."
    if governs == "friction_unknown":
        return f"It does not tip, but the friction is not known: it may slip{place}."
    return (
        f"In doubt is {_NAMES.get(governs, governs)}{place}: kind or unkind, by the ranges given."
    )


_NAMES = {
    "tip_downhill": "tipping over its downhill end",
    "tip_uphill": "tipping over its uphill end",
    "tip_sideways": "tipping over its side",
    "slip": "lack of friction",
    "drive": "too little traction of the drive",
    "stuck": "getting stuck",
}


def _notes(case: Case, found: Climb, flat: Assessment, doubts: tuple[str, ...]) -> tuple[str, ...]:
    notes = [note for note in flat.notes if not note.startswith("This model judges")]
    notes[:0] = [f"{doubt[0].upper()}{doubt[1:]}." for doubt in doubts]
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
    if found.outline.gyration_estimated:
        notes.append("The moment of inertia is estimated as that of an even box.")
    if found.profile.open_risers:
        notes.append("Open risers: the model gives them faces that are not there.")
    if found.profile.overhangs:
        notes.append("Nosings overhang: the model stands on their upper envelope.")
    return tuple(notes)


def _interval(worst: Reading) -> tuple[float, float] | None:
    """95 % interval of the smallest margin [deg]; None if all is certain or nothing known."""
    if len(worst.smallest) == 1 or np.isnan(worst.smallest).any():
        return None
    low, high = np.degrees([at_risk(worst.smallest, share) for share in (0.025, 0.975)])
    return float(low), float(high)


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


def _millimetres(value: float) -> float | None:
    return 1e3 * value if math.isfinite(value) else None


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
