"""The contact model's own figures: the three grades, each phase, rotations, forces."""

import math
from typing import TYPE_CHECKING, ClassVar

from kaidan.answer import Part
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.drive import drive_power
from kaidan.modes import PhaseName
from kaidan.question import Question

if TYPE_CHECKING:
    from kaidan.traversal import Chain, Fall, PhaseExtremes, Traverse


class PhaseFigures(Part):
    """Extreme figures of a phase of the traverse."""

    phase: PhaseName
    """Part of the traverse."""
    required_friction: float | None
    """Largest required friction of any pose [1]; null: no friction is enough."""
    required_friction_step: int
    """Nosing at which, counted from the bottom."""
    slides_below: float | None
    """Friction below which, landing at the foot, the trailing end slides down the last risers [1];
    no fall, so it does not count as slipping. Null: it rests on none, or always slides."""
    energy_margin_mm: float | None
    """Smallest rise of the centroid that a fall downhill needs [mm]; null: it falls nowhere."""
    energy_margin_step: int
    """Nosing at which."""
    static_margin_mm: float
    """Smallest static stability margin downhill [mm]."""
    traction_over_weight: float
    """Largest tractive force over the weight [1]."""
    largest_rotation_deg: float
    """Largest rotation that the next contact arrests [deg]."""
    belly_touches: bool
    """Whether the belly carries the robot somewhere."""


class RotationFigures(Part):
    """A rotation off a contact, or several in a row, until the robot rests on two again."""

    phase: PhaseName
    """Part of the traverse."""
    step: int
    """Nosing at which it begins, counted from the bottom."""
    angle_deg: float
    """How far it rotates in all, tail down positive [deg]."""
    rocking_deg: float
    """What of it counts as rocking: what the terrain does not oblige it to, on a flight no more
    than `beyond_slope_deg` [deg]."""
    beyond_slope_deg: float | None
    """How far its inclinations are off the mean slope of the flight, at most [deg]; null where it
    does not begin and end on one flight."""
    reached_deg: float
    """Inclination of the body farthest out, uphill end up positive [deg]."""
    drop_mm: float
    """How far the centroid drops [mm]."""
    impact_speed: float | None
    """Speed at which the rotating end hits [m/s]; null for a fall."""
    obliged: bool
    """Whether the terrain obliges every robot to it: onto a landing, off an edge, into a gap."""
    arrested: bool
    """Whether a contact arrests it; else the robot falls over."""


class Grades(Part):
    """The three grades of "it holds", side by side, never mixed."""

    no_rotation: bool | None
    """Grade one, the paper's criterion, without allowances; null where it says nothing."""
    arrested: bool
    """Grade two: whatever rotates comes to rest on two contacts, and the robot arrives."""
    arrested_with_momentum: bool
    """Grade three: also with the momentum gained (plastic impacts)."""
    largest_rotation_deg: float
    """Largest rotation of any phase that the terrain does not oblige to; 90 for a fall [deg]."""
    largest_drop_deg: float
    """Largest rotation that it obliges to [deg]."""


class TiltFigures(Part):
    """Two margins in one unit: how far gravity may tilt."""

    to_rock_deg: float | None
    """Towards the downhill end until the robot rotates by more than rocking, without allowances
    [deg]; negative: it does so without tilt. Null where no pose says."""
    to_fall_deg: float | None
    """Towards the end over which it rocks until it falls [deg]; negative: it falls without tilt.
    30: or beyond; -90: 30 off it are not enough. Null: it does not rock, and so was not tilted
    until it falls."""
    reserve_deg: float
    """Tilt to the fall that it must keep where it rocks [deg]."""


class ContactFigures(Part):
    """What the contact model knows beside the margins."""

    shown_as: ClassVar[str] = "contact"

    grades: Grades
    """Three grades of "it holds"."""
    tilt: TiltFigures
    """How far it is from rocking and from a fall."""
    phases: tuple[PhaseFigures, ...]
    """Extreme figures of each phase."""
    rotations: tuple[RotationFigures, ...]
    """Every rotation of the traverse, in order."""
    energy_threshold_mm: float
    """Energy margin on the flat below which a sudden stop or start may rock the robot [mm]: of the
    stated speed, else of the paper's 0.1 m/s."""
    speed_stated: bool
    """Whether that is the requested speed."""
    rear_length_mm: float | None
    """How much further back the centroid could lie before the robot is driven upright on its tail
    at the worst riser [mm]; negative: it is. Null going down or without risers."""
    margin_centroid_mm: float | None
    """How far the centroid may move along the track before the robot rotates, without allowances
    [mm]; null where the criterion of no rotation says nothing."""
    traction_N: float | None
    """Largest sum of tractive forces, rolling resistance included [N]; null without a mass."""
    power_W: float | None
    """Power at the motors for it at the requested speed [W]."""


def figures_of(
    question: Question,
    driven: Question,
    found: "Traverse",
    phases: "tuple[PhaseExtremes, ...]",
    *,
    falls: "tuple[Fall, ...]",
) -> ContactFigures:
    """Figures of a traverse."""
    says_something = found.holds is not None and not question.yaw
    from kaidan.traversal.tilting import LARGEST

    traction, power = _traction_and_power(driven, phases)
    return ContactFigures(
        grades=_grades(found, says_something),
        tilt=TiltFigures(
            to_rock_deg=math.degrees(found.downhill_margin),
            to_fall_deg=math.degrees(min(LARGEST, *(each.tilt for each in falls)))
            if falls
            else None,
            reserve_deg=math.degrees(question.reserve),
        ),
        phases=tuple(_phase(each) for each in phases),
        rotations=tuple(_rotation(each) for each in found.chains),
        energy_threshold_mm=1e3 * question.energy_threshold(),
        speed_stated=bool(question.speed),
        rear_length_mm=None if found.rear_length is None else 1e3 * found.rear_length[0],
        margin_centroid_mm=1e3 * found.centroid_margin
        if found.whole and not question.yaw
        else None,
        traction_N=traction,
        power_W=power,
    )


def _grades(found: "Traverse", says_something: bool) -> Grades:
    free = [abs(each.angle) for each in found.chains if not each.obliged and each.arrested]
    drops = [abs(each.angle) for each in found.chains if each.obliged and each.arrested]
    fell = any(not each.arrested for each in found.chains)
    return Grades(
        no_rotation=found.holds if says_something else None,
        arrested=found.arrived,
        arrested_with_momentum=found.arrived and found.arrested_with_momentum,
        largest_rotation_deg=90.0 if fell else math.degrees(max(free, default=0.0)),
        largest_drop_deg=math.degrees(max(drops, default=0.0)),
    )


def _phase(each: "PhaseExtremes") -> PhaseFigures:
    return PhaseFigures(
        phase=each.phase.value,
        required_friction=each.required_friction,
        required_friction_step=each.required_friction_step,
        slides_below=each.slides_below,
        energy_margin_mm=1e3 * each.energy_margin,
        energy_margin_step=each.energy_margin_step,
        static_margin_mm=1e3 * each.static_margin,
        traction_over_weight=each.traction_over_weight,
        largest_rotation_deg=math.degrees(each.largest_rotation),
        belly_touches=each.belly_touches,
    )


def _rotation(each: "Chain") -> RotationFigures:
    return RotationFigures(
        phase=each.phase.value,
        step=each.step,
        angle_deg=math.degrees(each.angle),
        rocking_deg=math.degrees(each.rocking),
        beyond_slope_deg=math.degrees(each.beyond_slope),
        reached_deg=math.degrees(each.reached),
        drop_mm=1e3 * each.drop,
        impact_speed=each.impact_speed,
        obliged=each.obliged,
        arrested=each.arrested,
    )


def _traction_and_power(
    question: Question, phases: "tuple[PhaseExtremes, ...]"
) -> tuple[float | None, float | None]:
    mass = question.stance.mass
    if mass is None or not phases:
        return None, None
    drive = question.robot.drive
    over_weight = max(each.traction_over_weight for each in phases)
    force = mass * STANDARD_GRAVITY * (over_weight + drive.rolling_resistance)
    if question.speed is None or question.direction == "down":
        return force, None
    return force, float(drive_power(F=force, v=question.speed, eta=drive.efficiency))
