"""Margins of the contact model on one reading of what is only known as a range."""

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from kaidan.assessment.case import Array, Case
from kaidan.assessment.closed_form import at_risk, traction_limit
from kaidan.assessment.spread import spread
from kaidan.assessment.yaw import SWING_SPEED, polygon_energy, polygon_margins
from kaidan.climb import Climb, Phase
from kaidan.climb.phases import step_at
from kaidan.contact import Status
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.measures import kinetic_energy_height
from kaidan.mechanics.oblique import equivalent_slope_across

MODES = ("tip_downhill", "tip_uphill", "tip_sideways", "slip", "drive")


FALL = math.pi / 2
"""Turn that a fall counts as where no criterion gives a margin [rad]."""


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


def no_rotation(case: Case, found: Climb) -> bool | None:
    """Grade one; None where it says nothing: fewer than two contacts stay, or a short flight.

    At a yaw: whether the polygon of both tracks' contacts keeps the zero moment point.
    """
    if case.yaw:
        return bool((polygon_margins(case, certain=True) > 0).all())
    return None if found.criterion.outside else found.criterion.holds


def largest_swing(found: Climb) -> float:
    """Largest turn in the traverse, a right angle if it falls [rad]."""
    if found.status in (Status.FELL_BACKWARD, Status.FELL_FORWARD):
        return FALL
    return math.radians(
        max((e.largest_swing_deg for e in found.phases if e.phase is Phase.TRAVERSE), default=0.0)
    )


def reading_of(case: Case, found: Climb, *, kind: bool) -> Reading:
    """Margins of a traverse with every range read kindest, or worst."""
    theta_d = case.theta_d.low if kind else case.theta_d.high
    theta_M = case.theta_M.low if kind else case.theta_M.high
    one = found.criterion
    bare = [
        _angle_or_side(one.back_margin_angle, one.back_margin),
        _angle_or_side(one.front_margin_angle, one.front_margin),
    ]
    downhill, uphill = reversed(bare) if found.descending else bare
    downhill, uphill = downhill - theta_d - theta_M, uphill - theta_d
    no_flight = len(found.profile.nosings) == 0 or all(
        each.phase is not Phase.TRAVERSE for each in found.phases
    )
    if found.phases and no_flight and one.holds is None:
        downhill = uphill = FALL  # it only enters and lands: the energy margin alone judges
    elif (case.yaw == 0 and one.outside) or math.isnan(downhill):
        swing = largest_swing(found)
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


def _angle_or_side(angle: float, metres: float) -> float:
    """Margin of slope; where no slope at all is the limit, a right angle to the side that holds."""
    return math.copysign(FALL, metres) if math.isnan(angle) and metres == metres else angle


def _drive(case: Case, found: Climb) -> float:

    force, mass = traction_limit(case), found.outline.stance.mass
    needed = max((each.traction_over_weight for each in found.phases), default=math.nan)
    if force is None or mass is None or math.isnan(needed):
        return math.nan
    spare = force / (mass * STANDARD_GRAVITY) - case.drive.rolling_resistance
    return math.asin(min(max(spare, -1.0), 1.0)) - math.asin(min(needed, 1.0))


def energy_margin(case: Case, found: Climb) -> float:
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


class Drop(NamedTuple):
    """Release after which a turn is caught."""

    turn: float
    """How far it turned [rad]."""
    spare: float
    """Rise still to climb before it topples, less the whole fall [m]: positive if it would hold
    even though the impact took nothing of the momentum."""
    phase: Phase
    step: int


def hardest_drop(case: Case, found: Climb) -> Drop | None:
    """Caught release with the least to spare if no impact took anything; None: none.

    The fall of the centroid bounds the energy of the turn whatever the impact does, so what holds
    by this measure holds without the plastic impact that grade three supposes.
    """
    along = -case.acceleration if found.descending else case.acceleration
    drops = []
    for release in found.run.releases:
        if release[15] != 0.0:
            continue
        row = found.run.row_before(float(release[1]))
        psi, front = (float(found.run.poses[row, column]) for column in (14, 8))
        ahead, up = along * math.cos(psi), STANDARD_GRAVITY + along * math.sin(psi)
        gravity = math.hypot(ahead, up)
        fall = (up * (release[4] - release[7]) + ahead * (release[3] - release[6])) / gravity
        drops.append(
            Drop(
                turn=float(release[9]),
                spare=float(release[13] / gravity - fall),
                phase=Phase(str(found.phase_of_pose[row])),
                step=step_at(found.profile, front, found.descending),
            )
        )
    return min(drops, key=lambda drop: drop.spare, default=None)


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
    reading = reading_of(case, alone, kind=False)
    threshold = float(kinetic_energy_height(v=case.speed or SWING_SPEED))
    steady = energy_margin(case, alone) > threshold and not any(
        each.belly_touches for each in alone.phases
    )
    worst = reading.supply
    if phase is Phase.TRAVERSE:
        tip = reading.tip
        steady = steady and tip > 0
        worst = min(worst, tip) if tip == tip else worst
    return PhaseMargins(min(worst, FALL), bool(steady))
