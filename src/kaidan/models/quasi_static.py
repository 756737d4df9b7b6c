"""The quasi-static contact model: entering, traversing and landing on any profile.

Friction, drive, balance (`kaidan.models.balance`), belly and landings are judged at every pose.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import compress
from typing import Any, NamedTuple

import numpy as np

from kaidan import contact
from kaidan.answer import Part
from kaidan.contact import Status
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.clearance import run_up_margin
from kaidan.mechanics.oblique import equivalent_slope_across
from kaidan.models import belts, gap, support_polygon, traction
from kaidan.models.balance import balance
from kaidan.models.contact_figures import figures_of
from kaidan.models.drive_limits import traction_limit
from kaidan.models.findings import Array, Finding, Findings, Later, hardest, without_rounding
from kaidan.models.sentences import contact_model as text
from kaidan.models.sentences import traction as grips
from kaidan.models.spread import Spread, spread
from kaidan.models.traction import Supplies
from kaidan.modes import (
    CONTACT,
    DRIVE,
    FALL_DOWNHILL,
    FALL_UPHILL,
    HIGH_CENTRING,
    LANDING_ROOM,
    SLIDES_DOWN,
    SLIDES_UP,
    STUCK,
    FailureMode,
    Phase,
)
from kaidan.question import Question
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import PhaseExtremes, Traverse, traverse

FALL = math.pi / 2
"""Rotation that a fall counts as [rad]."""
LONG_FLIGHT = 60
"""Risers of a uniform flight that stand for any more: twice the nosings under the longest robot,
so that every pose recurs and the arrival is like that of the whole flight."""
_ROUNDING = 1e-6
"""Tilt that is rounding [rad]."""
_SOLVER = (Status.NOT_CONVERGED, Status.TOO_LONG, Status.NO_START)
_NAME = CONTACT.name


class Basis(NamedTuple):
    """On what the contact model's findings stand."""

    question: Question
    """As driven: along the heading, straight up or down."""
    traverse: Any
    """A `Traverse`, or the `planned.Planned` of a plan."""


def traverse_of(
    question: Question, *, with_energy: bool = False, step: float = contact.STEP
) -> Traverse:
    """Traverse of a question's robot over its terrain, straight up or down."""
    _ = question.robot.weighed
    return driven_over(profile_of(question), question, with_energy=with_energy, step=step)


def driven_over(profile: Profile, question: Question, **how: Any) -> Traverse:
    """Traverse of a question's robot in its manner of going; `how` as for `traverse`."""
    return traverse(
        profile,
        question.outline,
        descending=question.direction == "down",
        facing=question.facing,
        acceleration=question.acceleration,
        **how,
    )


def profile_of(question: Question) -> Profile:
    """Terrain that is driven: of a long uniform flight as many risers as say all."""
    if isinstance(question.terrain, Stairs) and repeats(question):
        return Profile.of_stairs(question.terrain.model_copy(update={"steps": LONG_FLIGHT}))
    return question.profile


def repeats(question: Question) -> bool:
    """Whether the flight is uniform and so long that the traverse repeats itself."""
    stairs = question.terrain
    if not isinstance(stairs, Stairs) or stairs.rise is None or stairs.steps <= LONG_FLIGHT:
        return False
    if stairs.gaps:  # counted from the first nosing, so that each lies where it lies
        return False
    return sum(question.outline.reach) < LONG_FLIGHT / 2 * stairs.nosing_spacing


def drives_alike(question: Question, other: Question) -> bool:
    """Whether both have one traverse: friction, belts and allowances play no part."""
    return belts.without_belts(question.robot) == belts.without_belts(other.robot) and all(
        getattr(question, name) == getattr(other, name)
        for name in (
            "terrain",
            "posture",
            "changes",
            "payload",
            "direction",
            "facing",
            "acceleration",
        )
    )


def findings_of(
    question: Question, basis: Basis, *, phase: Phase | None = None, most: float = math.inf
) -> Findings:
    """Findings of a traverse, of the whole of it or of one phase alone.

    most: margin of slope beyond which a larger one is no better [rad]. That of a fall is then found
        no farther than it may be the smallest.
    """
    driven, found = basis
    if not _answered(driven, found):
        return Findings(model=_NAME, outside=found.status.message, basis=basis)
    phases = tuple(each for each in found.phases if phase in (None, each.phase))
    over = spread(driven, found)
    extremes = _Extremes.of(driven, found, phases)
    friction = extremes.friction
    held = traction.supplies(question, driven, found, phase)
    flight = question.terrain
    if question.yaw and isinstance(flight, Stairs):
        across = float(equivalent_slope_across(theta_s=flight.angle, psi=question.yaw))
        friction = math.hypot(friction, across)
    required = friction if held is None else held.worst.required
    slides = _supply(driven, found, over, extremes, friction, held)
    balanced = found if math.isinf(most) else _seen_no_farther(question, found, slides, most)
    each = [
        *slides,
        *_obstacles(driven, found, phase, phases),
        *traction.too_fast_on_grousers(question),
        *gap.jams(driven, found, required, extremes if held is None else held.worst, phase),
        *balance(question, driven, balanced, over, phase, held),
    ]
    gripping = Later(lambda: [traction.figures_of(driven, found, friction, held, phase)])
    modes = [one.mode for one in each]
    return Findings(
        model=_NAME,
        each=tuple(each),
        required_friction=required,
        figures=Later(lambda: (*_figures(question, driven, found, phase, modes), *gripping)),
        notes=()
        if phase
        else Later(lambda: _notes(question, driven, found) + grips.notes(question, gripping[0])),
        basis=basis,
    )


def _seen_no_farther(
    question: Question, found: Traverse, slides: Sequence[Finding], most: float
) -> Traverse:
    """Traverse of which no fall is looked for beyond the margin that others leave, or `most`."""
    if question.uncertain:
        return found
    left = float(np.fmin.reduce([most, *(one.worst[0] for one in slides)]))
    d, M = question.allowance_d, question.allowance_M
    off = max(d.high + M.high, question.reserve)
    return found.seeking(found.sought, enough=off + max(left, 0.0) + _ROUNDING)


def _figures(
    question: Question,
    driven: Question,
    found: Traverse,
    phase: Phase | None,
    modes: Sequence[FailureMode],
) -> Iterator[Part]:
    """Figures of a traverse, those of friction and belts apart."""
    looked_for = {FALL_DOWNHILL: "falls_downhill", FALL_UPHILL: "falls_uphill"}
    falls = tuple(getattr(found, name) for mode, name in looked_for.items() if mode in modes)
    phases = tuple(each for each in found.phases if phase in (None, each.phase))
    yield figures_of(question, driven, found, phases, falls=falls)
    flight = question.terrain
    if phase is None and question.robot.track.gauge is not None and isinstance(flight, Stairs):
        at = np.array([question.yaw])
        energy = float(support_polygon.energy_of(question, flight, at)[0])
        yield support_polygon.figures_of(question, flight, energy)


def _notes(question: Question, driven: Question, found: Traverse) -> tuple[str, ...]:
    return text.notes(question, found, driven_risers=LONG_FLIGHT if repeats(driven) else None)


def _answered(question: Question, found: Traverse) -> bool:
    """Whether the model has an answer.

    Under an acceleration effective gravity leans with the path, which turns at once where a contact
    is exchanged: a pose that then rocks between two contacts tells of the model, not of the robot.
    """
    rocks = found.status is Status.STUCK and question.acceleration != 0
    return found.status not in _SOLVER and not rocks


class _Extremes(NamedTuple):
    """Extremes over some phases."""

    friction: float
    """Required friction [1]; infinite: none is enough; NaN: not known."""
    traction: float
    """Tractive force over the weight [1]."""
    phase: Phase | None
    """Where the friction is required."""
    step: int | None

    @classmethod
    def of(
        cls, question: Question, found: Traverse, phases: tuple[PhaseExtremes, ...]
    ) -> "_Extremes":
        if not phases:
            return cls(math.nan, math.nan, None, None)
        highest = phases[hardest(each.required_friction for each in phases)]
        return cls(
            max(each.required_friction for each in phases),
            max(each.traction_over_weight for each in phases),
            highest.phase,
            highest.required_friction_step,
        )


def sliding_margin(question: Question, basis: Basis) -> Array:
    """Margin against sliding of each sample in the worst case, known before the other margins.

    question: to be judged by `findings_of`.

    [rad]; infinite where it takes the other margins to know.
    """
    driven, found = basis
    if not _answered(driven, found) or not belts.holds_otherwise(question):
        return np.full(1, math.inf)
    held = traction.supply(driven, found, question.robot.track)
    if held.phase is None:
        return np.full(1, math.inf)
    over = spread(driven, found)
    return _sliding(over, held.phase, driven.friction[0], held.required)


def _sliding(over: Spread, phase: Phase | None, mu: float, required: float) -> Array:
    """Margin of slope against sliding of each sample [rad]."""
    margin = (
        np.arctan(np.maximum(mu + over.friction, 0.0)) - math.atan(required) - over.steeper(phase)
    )
    return without_rounding(margin)


def _supply(
    question: Question,
    found: Traverse,
    over: Spread,
    extremes: _Extremes,
    friction: float,
    held: Supplies | None,
) -> list[Finding]:
    """Friction, grousers and drive against what the terrain requires."""
    place = extremes if held is None else held.worst
    required = (friction, friction) if held is None else (each.required for each in held)
    worst, best = (
        _sliding(over, place.phase, mu, needed)
        for mu, needed in zip(question.friction, required, strict=True)
    )
    uphill = question.acceleration >= -STANDARD_GRAVITY * math.sin(max(_slope(question), 0.0))
    slides = Finding(
        mode=SLIDES_DOWN if uphill else SLIDES_UP,
        worst=worst,
        best=best,
        phase=place.phase,
        step=place.step,
        model=_NAME,
    )
    drive = drive_margin(question, extremes.traction) - over.inclination
    stalls = Finding(mode=DRIVE, worst=drive, best=drive, model=_NAME)
    return [slides, stalls]


def _slope(question: Question) -> float:
    angle = question.profile.angle
    return 0.0 if math.isnan(angle) else angle


def drive_margin(question: Question, required: float) -> float:
    """Margin of slope of the drive [rad]; NaN: not known."""
    force, mass = traction_limit(question), question.stance.mass
    if force is None or mass is None or math.isnan(required):
        return math.nan
    spare = force / (mass * STANDARD_GRAVITY) - question.robot.drive.rolling_resistance
    return min(_slope_of_traction(max(spare, -1.0)) - _slope_of_traction(required), FALL)


def _slope_of_traction(over_weight: float) -> float:
    """Slope that takes a traction over the weight [rad]; one radian a weight beyond the upright."""
    return math.asin(min(over_weight, 1.0)) + max(over_weight - 1.0, 0.0)


def _obstacles(
    question: Question,
    found: Traverse,
    phase: Phase | None,
    phases: tuple[PhaseExtremes, ...],
) -> list[Finding]:
    """What only holds or does not: getting stuck, the belly; and the room on the landings."""
    each = []
    where, step = found.end
    if found.status is Status.STUCK and phase in (None, where):
        each.append(Finding.certain(STUCK, -FALL, phase=where, step=step, model=_NAME))
    belly = [extremes.phase for extremes in phases if extremes.belly_touches]
    if question.robot.track.belly_clearance is not None:
        place = belly[0] if belly else None
        each.append(_yes_or_no(HIGH_CENTRING, not belly, place, None))
    if phase in (None, Phase.LAND):
        leaves, length = question.leaves, sum(found.outline.reach)
        ends = zip(found.profile.landings, leaves[:: -1 if found.descending else 1], strict=True)
        # a part of a plan stands on the landing from which it sets out, or on which it ends
        stands = (found.start is None, found.until is None)
        inner = (each for each in question.landings
                 if each.end == "between" and each.turn != "unknown")  # fmt: skip
        deep = [*compress(ends, stands), *((min(each.lengths), 0.0) for each in inner)]
        room = min(
            (float(run_up_margin(depth=d, length=length, leaf=leaf)) for d, leaf in deep),
            default=math.inf,
        )
        each.append(Finding.certain(LANDING_ROOM, room, model=_NAME))
    return each


def _yes_or_no(mode: FailureMode, holds: bool, phase: Phase | None, step: int | None) -> Finding:
    margin = math.inf if holds else -math.inf
    return Finding.certain(mode, margin, phase=phase, step=step, model=_NAME)
