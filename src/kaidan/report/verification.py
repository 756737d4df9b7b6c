"""The virtual verification test: counts of a condition, margins of a spacing, Figs. 13 to 21."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from kaidan import contact
from kaidan.campaign import TRIALS, Condition, VerificationTest
from kaidan.errors import InputError
from kaidan.mechanics.margin import theta_s_sup
from kaidan.mechanics.plane import two_contacts_remain
from kaidan.physics.start import course_of

FELL = ("fell_backward", "fell_forward", "start_fall")
"""Outcomes that are a fall; `start_fall` before the track moved, told apart."""
NO_ANSWER = ("unstable", "crashed", "failed")
"""Outcomes that say nothing about the robot."""


class Trial(NamedTuple):
    """What counts of a trial."""

    outcome: str
    extra_deg: float | None
    """Largest turn beyond the line of the nosings [deg]."""

    @property
    def fell(self) -> bool | None:
        """Whether it fell; None if it neither fell nor climbed."""
        return True if self.outcome in FELL else False if self.outcome == "climbed" else None


class Range(NamedTuple):
    """Mean over some trials with the ends between which they lie [deg]."""

    low: float
    mean: float
    high: float

    @classmethod
    def of(cls, values: Iterable[float]) -> "Range | None":
        """Range of values; None without any."""
        found = list(values)
        return cls(min(found), math.fsum(found) / len(found), max(found)) if found else None


@dataclass(frozen=True)
class Count:
    """A condition with its trials, in the order of their numbers."""

    condition: Condition
    trials: tuple[Trial, ...]

    @property
    def angle_deg(self) -> float:
        """Slope [deg]."""
        return math.degrees(self.condition.angle)

    @property
    def fell(self) -> int:
        """Trials that fell."""
        return sum(trial.fell is True for trial in self.trials)

    @property
    def climbed(self) -> int:
        """Trials that came to the end of their way."""
        return sum(trial.fell is False for trial in self.trials)

    @property
    def others(self) -> dict[str, int]:
        """Trials that did neither, by outcome."""
        outcomes = [trial.outcome for trial in self.trials if trial.fell is None]
        return {outcome: outcomes.count(outcome) for outcome in sorted(set(outcomes))}

    @property
    def symbol(self) -> str:
        """Of the paper's Fig. 13: circle, cross, triangle; square where some did neither."""
        if self.others:
            return "square"
        if not self.fell:
            return "circle"
        return "triangle" if self.climbed else "cross"

    @property
    def extra(self) -> Range | None:
        """Largest turn beyond the line of the nosings, of the trials that climbed."""
        return Range.of(
            trial.extra_deg
            for trial in self.trials
            if trial.fell is False and trial.extra_deg is not None
        )


@dataclass(frozen=True)
class Spacing:
    """What the trials at one nosing spacing come to; angles in degrees."""

    nosing_spacing: float
    closed_form_deg: float | None
    """theta_s_sup; None outside the closed form."""
    contact_deg: float | None
    """Steepest slope that the contact model climbs (grade two); None if it climbs none."""
    up: tuple[Count, ...]
    """Conditions, by slope."""
    down: tuple[Count, ...]

    @property
    def climbed_up_to_deg(self) -> float | None:
        """Steepest slope tried at which all climbed, as they did at every gentler one."""
        held = _held(self.up)
        return held[-1].angle_deg if held else None

    @property
    def fell_from_deg(self) -> float | None:
        """Gentlest slope tried from which on all fell."""
        ending = list(_while_true(reversed(self.up), lambda count: count.symbol == "cross"))
        return ending[-1].angle_deg if ending else None

    @property
    def theta_d(self) -> Range | None:
        """Extra inclination at the steepest slope at which all climbed, as in Fig. 16."""
        held = _held(self.up)
        return held[-1].extra if held else None

    @property
    def margin(self) -> Range | None:
        """Slope at which it begins to fall going up; its ends are slopes that were tried."""
        return _margin(self.up)

    @property
    def descent_margin(self) -> Range | None:
        """The same going down."""
        return _margin(self.down)

    @property
    def theta_M(self) -> Range | None:
        """Descending margin less the ascending one, as in Fig. 19.

        The mean is that of the series, each with its margin half way between two slopes; the ends
        are as far as the slopes that were tried leave it open.
        """
        pairs = [
            (up, down)
            for up, down in zip(_brackets(self.up), _brackets(self.down), strict=False)
            if up is not None and down is not None
        ]
        if not pairs:
            return None
        mean = math.fsum(sum(down) - sum(up) for up, down in pairs) / (2 * len(pairs))
        return Range(
            min(down[0] - up[1] for up, down in pairs),
            mean,
            max(down[1] - up[0] for up, down in pairs),
        )

    @property
    def corrected(self) -> Range | None:
        """theta_s_sup less theta_d and theta_M, Eq. (24), as in Fig. 21."""
        d, M, sup = self.theta_d, self.theta_M, self.closed_form_deg
        if d is None or M is None or sup is None:
            return None
        return Range(sup - d.high - M.high, sup - d.mean - M.mean, sup - d.low - M.low)

    def as_dict(self) -> dict[str, Any]:
        """Everything, in metres and degrees."""
        ranges = ("margin", "descent_margin", "theta_d", "theta_M", "corrected")
        plain = {name: getattr(self, name) for name in ranges}
        return {
            "nosing_spacing_m": self.nosing_spacing,
            "closed_form_deg": self.closed_form_deg,
            "contact_deg": self.contact_deg,
            "climbed_up_to_deg": self.climbed_up_to_deg,
            "fell_from_deg": self.fell_from_deg,
            **{
                f"{name}_deg": None if value is None else value._asdict()
                for name, value in plain.items()
            },
        }


def _while_true(counts: Iterable[Count], holds: Any) -> Iterable[Count]:
    for count in counts:
        if not holds(count):
            return
        yield count


def _held(counts: Sequence[Count]) -> list[Count]:
    return list(_while_true(counts, lambda count: count.symbol == "circle"))


def _margin(counts: Sequence[Count]) -> Range | None:
    found = [bracket for bracket in _brackets(counts) if bracket is not None]
    if not found:
        return None
    mean = math.fsum(low + high for low, high in found) / (2 * len(found))
    return Range(min(low for low, _ in found), mean, max(high for _, high in found))


def _brackets(counts: Sequence[Count]) -> list[tuple[float, float] | None]:
    """For each series (the k-th trials of all slopes): between which slopes it begins to fall.

    The last slope before the first fall and that of the fall [deg]; None where the gentlest slope
    made it fall, none did, or a trial on the way did neither.
    """
    series = min((len(count.trials) for count in counts), default=0)
    return [_bracket([(count.angle_deg, count.trials[k].fell) for count in counts])
            for k in range(series)]  # fmt: skip


def _bracket(trials: Sequence[tuple[float, bool | None]]) -> tuple[float, float] | None:
    last: float | None = None
    for angle, fell in trials:
        if fell is None or (fell and last is None):
            return None
        if fell and last is not None:
            return last, angle
        last = angle
    return None


@dataclass(frozen=True)
class Verification:
    """The whole experiment."""

    plan: VerificationTest
    spacings: tuple[Spacing, ...]
    version: str
    """Of what computed the trials."""

    @property
    def counts(self) -> list[Count]:
        """All conditions."""
        return [count for each in self.spacings for count in (*each.up, *each.down)]

    @property
    def exit_code(self) -> int:
        """3 if no trial says anything about the robot, else 0."""
        outcomes = [trial.outcome for count in self.counts for trial in count.trials]
        return 3 if all(outcome in NO_ANSWER for outcome in outcomes) else 0

    def as_dict(self) -> dict[str, Any]:
        """Everything, in metres and degrees, for JSON."""
        plan = self.plan
        columns = self.columns()
        names = list(columns)
        return {
            "robot": plan.robot.name,
            "track": plan.track.model_dump(mode="json"),
            "speed_m_s": plan.speed,
            "friction": plan.friction,
            "trials": plan.trials,
            "seed": plan.seed,
            "version": self.version,
            "spacings": [each.as_dict() for each in self.spacings],
            "conditions": [
                dict(zip(names, row, strict=True)) for row in zip(*columns.values(), strict=True)
            ],
        }

    def columns(self) -> dict[str, list[Any]]:
        """Table of the conditions."""
        counts = self.counts
        extras = [count.extra or Range(math.nan, math.nan, math.nan) for count in counts]
        return {
            "nosing_spacing_m": [count.condition.nosing_spacing for count in counts],
            "angle_deg": [count.angle_deg for count in counts],
            "direction": [count.condition.direction for count in counts],
            "trials": [len(count.trials) for count in counts],
            "climbed": [count.climbed for count in counts],
            "fell": [count.fell for count in counts],
            "fell_at_start": [
                sum(trial.outcome == "start_fall" for trial in count.trials) for count in counts
            ],
            "others": [
                " ".join(f"{name}:{number}" for name, number in count.others.items())
                for count in counts
            ],
            "extra_low_deg": [extra.low for extra in extras],
            "extra_mean_deg": [extra.mean for extra in extras],
            "extra_high_deg": [extra.high for extra in extras],
        }


def verification(plan: VerificationTest, rows: Iterable[Mapping[str, Any]]) -> Verification:
    """Experiment from the rows of a store.

    Parameters
    ----------
    plan : VerificationTest
        What was asked for.
    rows : iterable of mappings
        With `id`, `outcome`, `largest_extra_deg`; rows of other plans are passed over.

    Raises
    ------
    InputError
        Trials of the plan are missing.
    """
    wanted = [TRIALS.identity(spec) for spec in plan.specs()]
    there = set(wanted)
    found = {
        row["id"]: Trial(row["outcome"], row["largest_extra_deg"])
        for row in rows
        if row["id"] in there
    }
    if len(found) < len(there):
        raise InputError(f"the store has {len(found)} of {len(there)} trials of the experiment")
    trials = [found[identity] for identity in wanted]
    counts = [
        Count(condition, tuple(trials[at * plan.trials : (at + 1) * plan.trials]))
        for at, condition in enumerate(plan.conditions)
    ]
    counts.sort(key=lambda count: count.condition.angle)
    spacings = dict.fromkeys(condition.nosing_spacing for condition in plan.conditions)
    return Verification(
        plan=plan,
        spacings=tuple(_spacing(plan, p, counts) for p in sorted(spacings)),
        version=TRIALS.version(),
    )


def _spacing(plan: VerificationTest, p: float, counts: Sequence[Count]) -> Spacing:
    of_p = [count for count in counts if count.condition.nosing_spacing == p]
    return Spacing(
        nosing_spacing=p,
        closed_form_deg=closed_form(plan, p),
        contact_deg=contact_margin(plan, p),
        up=tuple(count for count in of_p if count.condition.direction == "up"),
        down=tuple(count for count in of_p if count.condition.direction == "down"),
    )


def closed_form(plan: VerificationTest, p: float) -> float | None:
    """theta_s_sup of the plan's robot [deg]; None where the closed form says nothing.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y, Eqs. (19)-(23).
    """
    stance = plan.robot.stance(plan.posture, plan.payload)
    L = stance.flat_length
    if not bool(two_contacts_remain(L=L, p=p)):
        return None
    sup = theta_s_sup(L=L, p=p, C_L=stance.com_from_front, C_N=stance.com_height, a=0.0)
    return math.degrees(float(sup))


def contact_margin(plan: VerificationTest, p: float) -> float | None:
    """Steepest slope that the contact model climbs on the flight (grade two) [deg].

    Parameters
    ----------
    plan : VerificationTest
        Robot, posture and payload.
    p : float
        Nosing spacing [m].

    Returns
    -------
    float or None
        To 0.01 deg; it has no time, so it is the limit of a low speed. None if it does not climb
        the gentlest stairs of that spacing.
    """

    def flight(angle: float) -> tuple[Any, float, float]:
        condition = Condition(nosing_spacing=p, angle=angle)
        course = course_of(plan.spec(condition, 0).model_copy(update={"start_offset": 0.3}))
        return course.profile.points, course.x, course.x + 2.2 * p * math.cos(angle)

    parts = course_of(plan.spec(Condition(nosing_spacing=p, angle=0.5), 0)).outline.parts
    least, most = 0.0205, 0.595  # rise and going that a sheet of stairs allows [m]
    low = max(math.radians(2.0), math.asin(least / p), math.acos(min(1.0, 2.4 / p)))
    high = min(math.radians(85.0), math.acos(least / p), math.asin(min(1.0, most / p)))
    found = contact.steepest_flight(flight, parts, low=low, high=high, tolerance=2e-4)
    return None if math.isnan(found) else math.degrees(found)


def usual_conditions(
    plan: VerificationTest, spacings: Sequence[float], *, descent: bool
) -> tuple[Condition, ...]:
    """Twelve slopes a spacing around the margins of closed form and contact model.

    Ascending from 6 degrees below the lower of the two to 5 above the higher one; descending from
    the higher one to 22 above it, since the downward margin lies higher.

    Raises
    ------
    InputError
        Neither model has a margin at a spacing.
    """
    conditions: list[Condition] = []
    for p in spacings:
        known = [angle for angle in (closed_form(plan, p), contact_margin(plan, p)) if angle]
        if not known:
            raise InputError(
                f"no margin is known at {1e3 * p:g} mm around which to test; give --angles"
            )
        ranges = [("up", min(known) - 6.0, max(known) + 5.0)]
        if descent:
            ranges.append(("down", max(known), max(known) + 22.0))
        for direction, low, high in ranges:
            for angle in np.linspace(max(low, 5.0), min(high, 80.0), 12):
                rounded = math.radians(round(2.0 * float(angle)) / 2.0)
                conditions.append(Condition(nosing_spacing=p, angle=rounded, direction=direction))
    return tuple(dict.fromkeys(conditions))
