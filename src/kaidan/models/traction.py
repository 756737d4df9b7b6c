"""How friction and grousers hold a robot on its traverse, in the worst and in the best case."""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import Grousers
from kaidan.mechanics.grousers import standing_run
from kaidan.mechanics.grousers_in_turn import height_behind
from kaidan.models.belts import bears, grousers_of, holds_otherwise, strength_margin
from kaidan.models.findings import Finding
from kaidan.models.traction_figures import TractionFigures
from kaidan.modes import CONTACT, GROUSER_SPEED, Phase
from kaidan.question import Question
from kaidan.robot import Track
from kaidan.robot.track import USUAL_GROUSERS
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs
from kaidan.traversal import Traverse
from kaidan.traversal.grip import Grip
from kaidan.traversal.phases import step_at
from kaidan.traversal.samples import lasting

if TYPE_CHECKING:
    from kaidan.traversal.moves import Move
    from kaidan.traversal.rating import Gripping

SLIDING = 0.8
"""Sliding over static friction [1]: rubber on concrete, Serway & Beichner, Physics for Scientists
and Engineers, table 5.2 (0.8 and 1.0)."""
FASTEST = 0.2
"""Speed from which on grousers are no GO [m/s]: driven in MuJoCo some hooked a nosing and fell, or
spun at a riser (docs/lab/physics.md, docs/theory/grousers.md)."""
MOST_LOOKS = 20
"""Times that an angle of friction which is enough is improved."""
_LITTLE = 1e-6
"""What it may still lack [rad]."""

Cones = tuple[float, float, float]
"""Angles of friction of nosings, treads and riser faces [rad]."""


class Supply(NamedTuple):
    """How friction and grousers hold the robot on a traverse, in one case."""

    margin: float
    """Angle by which friction may be less, or minus what is missing [rad]; NaN: not known."""
    required: float
    """Least friction, the same everywhere [1]; infinite: none is enough."""
    phase: Phase | None
    step: int | None
    slip: float
    """How far the robot may slip down before grousers hold it [m]; zero: it does not rely on
    them."""
    heights: dict[Phase, float]
    """Kinetic-energy height of that slip in each phase with one [m]."""


class Standing(NamedTuple):
    """How friction and grousers hold the robot while it stands and its posture changes.

    With grousers it stands on those that hold it already, so it does not slip back first.
    """

    worst: float
    """Angle by which friction may be less [rad]; NaN: nobody stated friction."""
    best: float
    """The same with every range at its favourable end [rad]."""
    required: float
    """Least friction, the same everywhere [1]; infinite: none is enough."""


def standing(question: Question, move: "Move") -> Standing:
    """How friction and grousers hold the robot while its posture changes.

    move: in which it stands at least once.
    """
    surface = question.surface
    if not (question.robot.track.has_grousers or (surface is not None and surface.differs)):
        required = move.required_friction
        worst, best = (math.atan(mu) - math.atan(required) for mu in question.friction)
        return Standing(worst, best, required)
    grip = Grip(move.path, descending=question.direction == "down", acceleration=0.0)

    def spare(phi: float) -> tuple[float, int]:
        return _standing(question, grip, (phi,) * 3), 0

    phi = _cones(surface, best=False)
    needed = phi[0] - _standing(question, grip, phi)
    if surface is None or not surface.differs:
        needed, _ = _enough(spare, needed, 0)
    needed = max(needed, 0.0)
    if surface is None:
        return Standing(math.nan, math.nan, _friction_of(needed))
    best = _standing(question, grip, _cones(surface, best=True), best=True)
    return Standing(phi[0] - needed, best, _friction_of(needed))


def _standing(question: Question, grip: Grip, phi: Cones, *, best: bool = False) -> float:
    track = question.robot.track
    cases = grousers_of(question, track, best=best) if bears(question, track) else ()
    each = [
        grip.at_once(phi, one, alone)
        for one, alone in zip(cases, _by_friction(grip, phi, cases), strict=True)
    ]
    each = each or [grip.by_friction(phi)]
    return float(np.fmin.reduce(np.concatenate(each)))


class Supplies(NamedTuple):
    """How friction and grousers hold the robot, in the worst and in the best case."""

    worst: Supply
    best: Supply


def too_fast_on_grousers(question: Question) -> list[Finding]:
    """Finding of a speed at which grousers may hook a nosing, or spin at a riser."""
    spare = FASTEST - (question.speed or 0.0)
    if not question.robot.track.has_grousers or spare > 0:
        return []
    return [Finding.certain(GROUSER_SPEED, spare, model=CONTACT.name)]


def supplies(
    question: Question, driven: Question, found: Traverse, phase: Phase | None
) -> Supplies | None:
    """How friction and grousers hold the robot; None where one friction of smooth belts is all.

    Off the line of steepest ascent nobody knows what grousers hold: friction alone counts there.
    """
    if not holds_otherwise(question):
        return None
    track = question.robot.track
    worst, best = (supply(driven, found, track, best=each, phase=phase) for each in (False, True))
    return None if worst.phase is None else Supplies(worst, best)


def supply(
    question: Question,
    found: Traverse,
    track: Track,
    *,
    best: bool = False,
    phase: Phase | None = None,
) -> Supply:
    """How friction and the grousers of a track hold the robot, in the worst or in the best case."""
    surface, grip = question.surface, found.grip
    phi = _cones(surface, best=best)
    sliding = SLIDING * math.tan(min(phi))
    bearing = bears(question, track, found)
    cases = grousers_of(question, track, best=best) if bearing else ()
    held, alone = _held(grip, phi, cases)
    rows = lasting(found.path) & ~found.comes_off
    if phase is not None:
        rows &= found.phase_of_pose == phase.value
    if not rows.any():
        return Supply(math.nan, math.nan, None, None, 0.0, {})
    margin, at = _least(np.where(rows, held, np.inf))
    slipping = rows & (alone <= 0.0) & (held > 0.0)
    slip, heights = 0.0, {}
    if slipping.any():
        slip = max(each.spacing for each in cases)
        kinetic = grip.slip_heights(slip, mu_k=sliding)
        if found.descending:
            passes = slipping & (_held(grip, phi, cases, passing=False)[0] <= 0.0)
            if passes.any():
                slip *= 2.0
                farther = grip.slip_heights(slip, mu_k=sliding)
                kinetic = np.where(passes, farther, kinetic)
        for each in Phase:
            here = slipping & (found.phase_of_pose == each.value)
            if here.any():
                heights[each] = float(kinetic[here].max())
    missing = phi[0] - margin
    alike = surface is None or not surface.differs
    if alike and any(each.rigid for each in cases):

        def spare(phi: float) -> tuple[float, int]:
            return _least(np.where(rows, _held(grip, (phi,) * 3, cases)[0], np.inf))

        missing, at = _enough(spare, missing, at)
        margin = phi[0] - missing
    return Supply(
        margin=margin,
        required=_friction_of(missing),
        phase=Phase(str(found.phase_of_pose[at])),
        step=step_at(found.profile, float(found.path.poses.front_point[at, 0]), found.descending),
        slip=slip,
        heights=heights,
    )


def gripping(question: Question) -> "Gripping | None":
    """Belts of a question by cases; None where they have no grousers, or none that bear.

    question: with a surface, without a yaw.
    """
    track, surface = question.robot.track, question.surface
    if surface is None or not (holds_otherwise(question) and bears(question, track)):
        return None
    from kaidan.traversal.rating import Case

    cases = []
    for best in (False, True):
        phi = _cones(surface, best=best)
        cases += [Case(one, phi, best) for one in grousers_of(question, track, best=best)]
    return tuple(cases)


def _cones(surface: Surface | None, *, best: bool) -> Cones:
    """Angles of friction of a surface; none where nobody stated friction."""
    if surface is None:
        return 0.0, 0.0, 0.0
    nosings, treads, faces = surface.of_parts(best=best)
    return math.atan(nosings), math.atan(treads), math.atan(faces)


def _held(
    grip: Grip,
    phi: Cones,
    cases: tuple[Grousers, ...],
    *,
    passing: bool = True,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """What each pose has to spare with its grousers, in the worst case, and without [rad]."""
    if not cases:
        alone = grip.by_friction(phi)
        return alone, alone
    by_friction = _by_friction(grip, phi, cases)
    pairs = zip(cases, by_friction, strict=True)
    held = [grip.with_grousers(phi, one, own, passing=passing) for one, own in pairs]
    return np.minimum.reduce(held), np.minimum.reduce(by_friction)


def _least(held: NDArray[np.float64]) -> tuple[float, int]:
    at = int(np.argmin(held))
    return float(held[at]), at


def _enough(
    spare: Callable[[float], tuple[float, int]], angle: float, at: int
) -> tuple[float, int]:
    """Angle of friction that is just enough [rad], and at which pose.

    The first angle is what cones lack that all grow alike. At a riser's face the cone of rigid
    grousers grows less, so what is still lacking is added until nothing is.

    spare: what there is to spare with an angle of friction, the same everywhere [rad], and where.
    angle: the first angle [rad].
    """
    for _ in range(MOST_LOOKS):
        if not 0.0 < angle < math.pi / 2:
            break
        left, at = spare(angle)
        angle -= left
        if abs(left) < _LITTLE:
            break
    return angle, at


def _friction_of(angle: float) -> float:
    """Friction of an angle [1]; infinite where it is a right angle or more."""
    return math.tan(angle) if angle < math.pi / 2 else math.inf


def _by_friction(grip: Grip, phi: Cones, cases: tuple[Grousers, ...]) -> list[NDArray[np.float64]]:
    """What each case of grousers holds where none of them stands."""
    known: dict[float, NDArray[np.float64]] = {}
    heights = [each.height if each.rigid else 0.0 for each in cases]
    for height in heights:
        if height not in known:
            known[height] = grip.by_friction(phi, height)
    return [known[height] for height in heights]


def figures_of(
    question: Question,
    found: Traverse,
    smooth: float,
    held: Supplies | None,
    phase: Phase | None,
) -> TractionFigures:
    """Figures of a traverse.

    smooth: friction that smooth belts require [1].
    held: where not one friction of smooth belts is all.
    """
    track, worst = question.robot.track, None if held is None else held.worst
    usual = math.inf
    if not track.has_grousers and question.surface is None:
        belts = Track(flat_length=1.0, **USUAL_GROUSERS)
        usual = supply(question, found, belts, phase=phase).required
    return TractionFigures(
        belt=track.belt or ("grousers" if track.has_grousers else "not stated"),
        required_friction=smooth if worst is None else worst.required,
        smooth_required_friction=smooth,
        usual_required_friction=usual,
        phase=None if worst is None or worst.phase is None else worst.phase.value,
        step=None if worst is None else worst.step,
        slip_mm=1e3 * worst.slip if worst is not None and worst.slip else None,
        slip_heights_mm={
            each.value: 1e3 * height for each, height in (worst.heights if worst else {}).items()
        },
        standing_phases=_standing_phases(question, track),
        strength_margin_N=strength_margin(question, track, found),
    )


def _standing_phases(question: Question, track: Track) -> tuple[float, float] | None:
    """Share of the phases in which a grouser stands, in the worst and in the best case."""
    if not track.has_grousers or not isinstance(question.terrain, Stairs):
        return None
    theta = question.terrain.angle
    worst, best = (grousers_of(question, track, best=each)[0] for each in (False, True))
    return _share(theta, worst), _share(theta, best)


def _share(theta: float, one: Grousers) -> float:
    h, s, r, w = one.height, one.spacing, one.nosing_radius, one.tip_width
    if one.rigid:
        h = float(height_behind(theta=theta, h=h, s=s, r=r, w=w))
    return min(float(standing_run(theta=theta, h=h, r=r)) / s, 1.0)


def together(parts: Sequence[TractionFigures]) -> TractionFigures:
    """Figures of the parts of a plan as one."""
    worst = max(parts, key=lambda each: _number(each.required_friction))
    heights: dict[str, float] = {}
    for each in parts:
        for phase, height in each.slip_heights_mm.items():
            heights[phase] = max(heights.get(phase, 0.0), height)
    smooth = max(parts, key=lambda each: _number(each.smooth_required_friction))
    usual = [each.usual_required_friction for each in parts]
    return worst.model_copy(
        update={
            "smooth_required_friction": smooth.smooth_required_friction,
            "usual_required_friction": None if None in usual else max(map(_number, usual)),
            "slip_mm": max((each.slip_mm for each in parts if each.slip_mm), default=None),
            "slip_heights_mm": heights,
        }
    )


def _number(friction: float | None) -> float:
    return math.inf if friction is None else friction
