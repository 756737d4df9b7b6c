"""The virtual verification test: trials of the paper's experiment, and what they come to."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from kaidan import contact
from kaidan.answer import Answer, Part
from kaidan.errors import InputError
from kaidan.lab.calibration.fitted import From, track_from
from kaidan.lab.campaign import TRIALS, Condition, Setting, VerificationTest
from kaidan.lab.reproduction.printed import MEASURED, Measured
from kaidan.lab.verification.counts import (
    Count,
    Range,
    Trial,
    all_climbed,
    all_fell,
    count_of,
    descent_gain,
    margin,
    onset,
)
from kaidan.mechanics.margin import theta_s_sup
from kaidan.mechanics.plane import two_contacts_remain
from kaidan.outline import Outline
from kaidan.physics.initial_pose import course_of

NO_ANSWER = ("unstable", "crashed", "failed")
"""Outcomes that say nothing about the robot."""
BELOW_SLIDING = 6.0
"""Least range of slopes that is tried [deg]."""


class Spacing(Part):
    """What the trials at one nosing spacing come to."""

    nosing_spacing_m: float
    """Nosing to nosing [m]."""
    closed_form_deg: float | None
    """theta_s_sup [deg]; null outside the closed form."""
    contact_deg: float | None
    """Steepest slope that the contact model climbs (grade two) [deg]; null if it climbs none."""
    climbed_up_to_deg: float | None
    """Steepest slope tried at which all climbed, as they did at every gentler one [deg]."""
    fell_from_deg: float | None
    """Gentlest slope tried from which on all fell [deg]."""
    margin_deg: Range | None
    """Slope at which it begins to fall or to stall going up; its ends are slopes that were
    tried."""
    descent_margin_deg: Range | None
    """The same going down."""
    onset_deg: Range | None
    """Slope at which the first trial is lost going up, in whichever phase; between two that were
    tried."""
    descent_onset_deg: Range | None
    """The same going down."""
    theta_d_deg: Range | None
    """Extra inclination at the steepest slope at which all climbed, as in Fig. 16."""
    theta_M_deg: Range | None
    """Descending margin less the ascending one, as in Fig. 19."""
    corrected_deg: Range | None
    """theta_s_sup less theta_d and theta_M of these same trials, Eq. (24): a decomposition of what
    was simulated, no prediction of it."""
    up: tuple[Count, ...]
    """Conditions going up, by slope."""
    down: tuple[Count, ...]
    """Conditions coming down, by slope."""


class SlopeLimit(Part):
    """theta_s_sup of the closed form over the nosing spacing, to be drawn."""

    nosing_spacing_m: tuple[float, ...]
    """Nosing to nosing [m]."""
    angle_deg: tuple[float | None, ...]
    """theta_s_sup [deg]."""
    ends_at_m: float
    """L/2, where the closed form ends [m]."""


class Verification(Answer):
    """The whole experiment."""

    text_module = "kaidan.lab.verification.text"

    robot: str
    track: str
    """Model of the track."""
    track_from: From
    """Where its figures are from: stated, the robot's sheet, or a fit to the paper's text."""
    stiffness_N_m: float | None
    """Of a nosing or a grouser [N/m]; null where nothing yields."""
    speed_m_s: float
    """Of the belt [m/s]."""
    friction: float
    """Of the track on the nosings [1]."""
    trials: int
    """Of each condition."""
    nosings: int
    """To be passed in a trial."""
    seed: int
    version: str
    """Of what computed the trials."""
    spacings: tuple[Spacing, ...]
    """What became of the trials, one a nosing spacing."""
    closed_form: SlopeLimit
    """The predicted margin."""
    printed: Measured | None
    """What the paper's text prints of this robot; null for any but Kenaf."""

    @property
    def counts(self) -> list[Count]:
        """All conditions."""
        return [count for each in self.spacings for count in (*each.up, *each.down)]

    @property
    def exit_code(self) -> int:
        """3 if no trial says anything about the robot, else 0."""
        said = any(
            count.fell or count.climbed or set(count.others) - set(NO_ANSWER)
            for count in self.counts
        )
        return 0 if said else 3

    def columns(self) -> dict[str, list[Any]]:
        """Table of the conditions."""
        counts = self.counts
        extras = [count.extra_deg for count in counts]
        return {
            "nosing_spacing_m": [count.nosing_spacing_m for count in counts],
            "angle_deg": [count.angle_deg for count in counts],
            "direction": [count.direction for count in counts],
            "trials": [len(count.lost_of_trial) for count in counts],
            "climbed": [count.climbed for count in counts],
            "fell": [count.fell for count in counts],
            "fell_at_start": [count.fell_at_start for count in counts],
            "others": [
                " ".join(f"{name}:{number}" for name, number in count.others.items())
                for count in counts
            ],
            **{
                f"extra_{end}_deg": [
                    None if each is None else getattr(each, end) for each in extras
                ]
                for end in ("low", "mean", "high")
            },
        }


def verification(plan: VerificationTest, rows: Iterable[Mapping[str, Any]]) -> Verification:
    """Experiment from the rows of a store.

    Parameters
    ----------
    plan : VerificationTest
        Conditions, robot and track.
    rows : iterable of mappings
        With `id`, `outcome`, `largest_extra_deg`; rows of other plans are passed over.

    Raises
    ------
    InputError
        Trials of the plan are missing.
    """
    required = [TRIALS.identity(spec) for spec in plan.specs()]
    there = set(required)
    found = {
        row["id"]: Trial(row["outcome"], row["largest_extra_deg"])
        for row in rows
        if row["id"] in there
    }
    if len(found) < len(there):
        raise InputError(f"the store has {len(found)} of {len(there)} trials of the experiment")
    trials = [found[identity] for identity in required]
    counts = [
        count_of(condition, trials[at * plan.trials : (at + 1) * plan.trials])
        for at, condition in enumerate(plan.conditions)
    ]
    counts.sort(key=lambda count: count.angle_deg)
    spacings = dict.fromkeys(condition.nosing_spacing for condition in plan.conditions)
    setting = plan.setting
    track, robot = setting.track, setting.robot
    own = setting.trial(plan.conditions[0], 0).stiffness
    return Verification(
        robot=robot.name,
        track=track.kind,
        track_from=track_from(setting),
        stiffness_N_m=getattr(track, "stiffness", None) or own,
        speed_m_s=setting.speed,
        friction=setting.static_friction,
        trials=plan.trials,
        nosings=plan.nosings,
        seed=plan.seed,
        version=TRIALS.version(),
        spacings=[_spacing(setting, p, counts) for p in sorted(spacings)],
        closed_form=_slope_limit(setting, list(spacings)),
        printed=MEASURED if robot.name == "kenaf" else None,
    )


def _spacing(setting: Setting, p: float, counts: Sequence[Count]) -> Spacing:
    up, down = (
        [count for count in counts if (count.nosing_spacing_m, count.direction) == (p, direction)]
        for direction in ("up", "down")
    )
    held, lost = all_climbed(up), all_fell(up)
    sup = closed_form(setting, p)
    theta_d, theta_M = held[-1].extra_deg if held else None, descent_gain(up, down)
    return Spacing(
        nosing_spacing_m=p,
        closed_form_deg=sup,
        contact_deg=contact_margin(setting, p),
        climbed_up_to_deg=held[-1].angle_deg if held else None,
        fell_from_deg=lost[-1].angle_deg if lost else None,
        margin_deg=margin(up),
        descent_margin_deg=margin(down),
        onset_deg=onset(up),
        descent_onset_deg=onset(down),
        theta_d_deg=theta_d,
        theta_M_deg=theta_M,
        corrected_deg=_corrected(sup, theta_d, theta_M),
        up=tuple(up),
        down=tuple(down),
    )


def _corrected(sup: float | None, d: Range | None, M: Range | None) -> Range | None:
    """theta_s_sup less theta_d and theta_M, Eq. (24)."""
    if sup is None or d is None or M is None:
        return None
    return Range(low=sup - d.high - M.high, mean=sup - d.mean - M.mean, high=sup - d.low - M.low)


def _slope_limit(setting: Setting, spacings: Sequence[float]) -> SlopeLimit:
    """theta_s_sup around the spacings of the plan, as far as the closed form goes."""
    half = setting.robot.stance(setting.posture, setting.payload).flat_length / 2
    room = 0.2 * max(max(spacings) - min(spacings), 0.04)
    last = min(max(spacings) + room, half)
    p = np.linspace(min(max(min(spacings) - room, 0.001), last), last, 300)
    return SlopeLimit(
        nosing_spacing_m=p.tolist(), angle_deg=[closed_form(setting, each) for each in p.tolist()],
        ends_at_m=half,
    )  # fmt: skip


def closed_form(setting: Setting, p: float) -> float | None:
    """theta_s_sup of the robot [deg]; None where the closed form says nothing.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (19)-(23).
    """
    stance = setting.robot.stance(setting.posture, setting.payload)
    L = stance.flat_length
    if not bool(two_contacts_remain(L=L, p=p)):
        return None
    sup = theta_s_sup(L=L, p=p, C_L=stance.com_from_front, C_N=stance.com_height, a=0.0)
    return math.degrees(float(sup))


def contact_margin(setting: Setting, p: float) -> float | None:
    """Steepest slope that the contact model climbs on the flight (grade two) [deg].

    p: nosing spacing [m].

    To 0.01 deg; it has no time, so it is the limit of a low speed. None if it does not climb the
    gentlest stairs of that spacing.
    """

    def flight(angle: float) -> tuple[Any, float, float]:
        condition = Condition(nosing_spacing=p, angle=angle)
        course = course_of(setting.trial(condition, 0, start_offset=0.3))
        return course.profile.points, course.x, course.x + 2.2 * p * math.cos(angle)

    parts = Outline.of(setting.robot, setting.posture, setting.payload).parts
    low, high = _slopes(p)
    found = contact.steepest_flight(flight, parts, low=low, high=high, tolerance=2e-4)
    return None if math.isnan(found) else math.degrees(found)


def _slopes(p: float) -> tuple[float, float]:
    # gentlest and steepest flight of a spacing [rad] that a sheet of stairs allows
    least, most = 0.0205, 0.595  # rise and going [m]
    low = max(math.radians(2.0), math.asin(least / p), math.acos(min(1.0, 2.4 / p)))
    return low, min(math.radians(85.0), math.acos(least / p), math.asin(min(1.0, most / p)))


def usual_conditions(
    setting: Setting, spacings: Sequence[float], *, descent: bool
) -> tuple[Condition, ...]:
    """Twelve slopes a spacing around the margins of closed form and contact model.

    Ascending from 6 degrees below the lower of the two to 5 above the higher one; descending from
    the higher one to 22 above it, since the downward margin lies higher. Without grousers no slope
    is steeper than the angle of friction, where it slides and a fall says nothing: where that ends
    all of it, the last `BELOW_SLIDING` below it are tried.
    """
    conditions: list[Condition] = []
    for p in spacings:
        known = [angle for angle in (closed_form(setting, p), contact_margin(setting, p)) if angle]
        if not known:
            raise InputError(
                f"no margin is known at {1e3 * p:g} mm around which to test; give --angles"
            )
        ranges = [("up", min(known) - 6.0, max(known) + 5.0)]
        if descent:
            ranges.append(("down", max(known), max(known) + 22.0))
        least, most = (math.degrees(each) for each in _slopes(p))
        least, most = max(5.0, math.ceil(2.0 * least) / 2.0), math.floor(2.0 * most) / 2.0
        for direction, low, high in ranges:
            top = max(least, min(high, setting.steepest, most))
            for angle in np.linspace(max(least, min(low, top - BELOW_SLIDING)), top, 12):
                rounded = math.radians(round(2.0 * float(angle)) / 2.0)
                conditions.append(Condition(nosing_spacing=p, angle=rounded, direction=direction))
    return tuple(dict.fromkeys(conditions))
