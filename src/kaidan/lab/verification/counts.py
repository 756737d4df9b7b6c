"""From the trials of a condition to counts, and from counts to margins: Figs. 13, 16, 19 and 21."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Literal, NamedTuple

from kaidan.answer import Part
from kaidan.lab.campaign import Condition

START_FALL = "start_fall"
FELL = ("fell_backward", "fell_forward")
"""Outcomes that are a fall. Where it fell before the track moved (`start_fall`), it was placed
where it cannot stand: that is counted apart and drawn apart."""

STALLED = "stalled"
"""Outcome of a robot that gets no farther where friction would hold it: no fall, but no climb."""

Symbol = Literal["circle", "cross", "triangle", "plus", "square"]
Bracket = tuple[float, float]
"""The last slope before the first fall, and that of the fall [deg]."""


class Trial(NamedTuple):
    """What counts of a trial."""

    outcome: str
    extra_deg: float | None
    """Largest inclination beyond the line of the nosings [deg]."""

    @property
    def lost(self) -> bool | None:
        """Whether it fell or stalled; None if it did neither nor climbed."""
        if self.outcome == "climbed":
            return False
        return True if self.outcome in (*FELL, STALLED) else None


class Range(Part):
    """Mean over some trials with the ends between which they lie."""

    low: float
    """[deg]"""
    mean: float
    """[deg]"""
    high: float
    """[deg]"""


def range_of(values: Iterable[float]) -> Range | None:
    """Range of values; None without any."""
    found = list(values)
    if not found:
        return None
    return Range(low=min(found), mean=math.fsum(found) / len(found), high=max(found))


class Count(Part):
    """A condition with what its trials came to."""

    nosing_spacing_m: float
    """Nosing to nosing [m]."""
    angle_deg: float
    """Slope [deg]."""
    direction: Literal["up", "down"]
    lost_of_trial: tuple[bool | None, ...]
    """Whether each trial fell while driving or stalled, in the order of their numbers; null: it did
    neither, nor climbed."""
    climbed: int
    """Trials that came to the end of their path."""
    fell: int
    """Trials that fell while driving."""
    fell_at_start: int
    """Trials that fell before the track moved."""
    others: dict[str, int]
    """Trials that neither fell, before or after the track moved, nor climbed, by outcome."""
    symbol: Symbol
    """Of the paper's Fig. 13: circle, cross, triangle; plus where some fell before the track moved,
    square where some neither fell nor climbed."""
    extra_deg: Range | None
    """Largest inclination beyond the line of the nosings, of the trials that climbed."""


def count_of(condition: Condition, trials: Sequence[Trial]) -> Count:
    """Count of a condition's trials, in the order of their numbers."""
    at_start = sum(trial.outcome == START_FALL for trial in trials)
    climbed = sum(trial.lost is False for trial in trials)
    fell = sum(trial.outcome in FELL for trial in trials)
    known = ("climbed", START_FALL, *FELL)
    others = [trial.outcome for trial in trials if trial.outcome not in known]
    return Count(
        nosing_spacing_m=condition.nosing_spacing,
        angle_deg=round(math.degrees(condition.angle), 9),
        direction=condition.direction,
        lost_of_trial=tuple(trial.lost for trial in trials),
        climbed=climbed,
        fell=fell,
        fell_at_start=at_start,
        others={outcome: others.count(outcome) for outcome in sorted(set(others))},
        symbol=_symbol(climbed, fell, at_start, len(others)),
        extra_deg=range_of(
            trial.extra_deg
            for trial in trials
            if trial.lost is False and trial.extra_deg is not None
        ),
    )


def _symbol(climbed: int, fell: int, at_start: int, others: int) -> Symbol:
    if others:
        return "square"
    if at_start:
        return "plus"
    if not fell:
        return "circle"
    return "triangle" if climbed else "cross"


def while_true(counts: Iterable[Count], holds: Callable[[Count], bool]) -> Iterator[Count]:
    """Counts up to the first for which something does not hold."""
    for count in counts:
        if not holds(count):
            return
        yield count


def all_climbed(counts: Sequence[Count]) -> list[Count]:
    """Conditions, from the gentlest on, at which every trial climbed."""
    return list(while_true(counts, lambda count: count.symbol == "circle"))


def all_fell(counts: Sequence[Count]) -> list[Count]:
    """Conditions, from the steepest at which any could be placed on, at which every trial fell."""
    placed = (count for count in reversed(counts) if count.fell or count.climbed or count.others)
    return list(while_true(placed, lambda count: count.symbol == "cross"))


def margin(counts: Sequence[Count]) -> Range | None:
    """Slope at which it begins to fall or to stall; its ends are slopes that were tried."""
    found = [bracket for bracket in brackets(counts) if bracket is not None]
    if not found:
        return None
    mean = math.fsum(low + high for low, high in found) / (2 * len(found))
    return Range(low=min(low for low, _ in found), mean=mean, high=max(high for _, high in found))


def onset(counts: Sequence[Count]) -> Range | None:
    """Slope at which the first of all phases is lost; its ends are slopes that were tried."""
    held = list(while_true(counts, lambda count: not any(count.lost_of_trial)))
    if not held or len(held) == len(counts):
        return None
    low, high = held[-1].angle_deg, counts[len(held)].angle_deg
    return Range(low=low, mean=(low + high) / 2, high=high)


def descent_gain(up: Sequence[Count], down: Sequence[Count]) -> Range | None:
    """theta_M: descending margin less the ascending one, as in Fig. 19.

    The mean is that of the series, each with its margin half way between two slopes; the ends are
    as far as the slopes that were tried leave it open.
    """
    pairs = [
        (rising, falling)
        for rising, falling in zip(brackets(up), brackets(down), strict=False)
        if rising is not None and falling is not None
    ]
    if not pairs:
        return None
    return Range(
        low=min(falling[0] - rising[1] for rising, falling in pairs),
        mean=math.fsum(sum(falling) - sum(rising) for rising, falling in pairs) / (2 * len(pairs)),
        high=max(falling[1] - rising[0] for rising, falling in pairs),
    )


def brackets(counts: Sequence[Count]) -> list[Bracket | None]:
    """For each series (the k-th trials of all slopes): between which slopes it is lost first.

    None where it was lost on the gentlest slope or on none, or a trial before neither was lost nor
    climbed.
    """
    series = min((len(count.lost_of_trial) for count in counts), default=0)
    return [
        _bracket([(count.angle_deg, count.lost_of_trial[k]) for count in counts])
        for k in range(series)
    ]


def _bracket(trials: Sequence[tuple[float, bool | None]]) -> Bracket | None:
    last: float | None = None
    for angle, lost in trials:
        if lost is None or (lost and last is None):
            return None
        if lost and last is not None:
            return last, angle
        last = angle
    return None
