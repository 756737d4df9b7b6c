"""What to measure next: which doubt the margin feels most, from the samples that an answer has.

The margin of each sample is known, and so is the draw of each input: the first-order Sobol index of
an input is the variance of the margin's mean within slices of its draws, over the whole variance
(from given data, so that nothing is judged again). A range moves the margins of the failure modes
that it belongs to evenly between their worst and best cases; its draws are evenly distributed.
"""

import math
from collections.abc import Mapping
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.answer import Part
from kaidan.assessment.uncertain_inputs import GROUPS, SAMPLED, STEPS, Doubt, doubts_of
from kaidan.models.findings import ROUNDING, Array, Finding, Findings, smallest
from kaidan.models.samples import sample_count, unit_draws
from kaidan.modes import FALLS, SLIDES_DOWN, SLIDES_UP, TIP_DOWNHILL, TIP_UPHILL
from kaidan.question import Question

Rows = NDArray[np.int64]

SLICES = 32
"""Slices of the draws of an input: 64 samples in each."""
_DRIVEN_BY = {
    SLIDES_DOWN.key: ("friction",),
    SLIDES_UP.key: ("friction",),
    TIP_DOWNHILL.key: ("theta_d", "theta_M"),
    TIP_UPHILL.key: ("theta_d",),
    FALLS[0].key: ("theta_d", "theta_M"),
    FALLS[1].key: ("theta_d",),
}
"""Ranges that part the best case of a failure mode from its worst case."""


class Measurement(Part):
    """Something to measure, and what it would make certain."""

    what: str
    """centroid, length, stairs, friction, theta_d or theta_M."""
    inputs: tuple[str, ...]
    """Inputs that it makes certain."""
    share: float
    """Share of the margin's variance that these inputs bring by themselves: the sum of their
    first-order Sobol indices."""
    deviation_deg: float
    """Standard deviation of the margin by these inputs alone [deg]."""


def to_measure(question: Question, found: Findings) -> tuple[Measurement, ...]:
    """What to measure next, what the margin feels most first.

    Parameters
    ----------
    found : Findings
        Of the question, by `kaidan.models.judge`.

    Returns
    -------
    tuple of Measurement
        Empty where every input is exact, the model says nothing, or nobody weighed the robot.
    """
    doubts = doubts_of(question)
    if not doubts or found.outside or question.robot.com_range is not None:
        return ()
    draws = draws_of(question, doubts)
    margin = margins_of(question, found, draws)
    if margin is None:
        return ()
    variance = float(np.var(margin))
    if not variance > ROUNDING**2:
        return ()
    shares = {name: first_order(drawn, margin) for name, drawn in draws.items()}
    if any(each.name == STEPS for each in doubts):  # drawn one by one: what the others leave
        shares[STEPS] = max(0.0, 1.0 - sum(shares.values()))
    whole = max(1.0, sum(shares.values()))  # estimates of all may come to a little more
    shares = {name: share / whole for name, share in shares.items()}
    return tuple(sorted(_grouped(doubts, shares, variance), key=lambda each: -each.share))


def _grouped(
    doubts: tuple[Doubt, ...], shares: Mapping[str, float], variance: float
) -> list[Measurement]:
    found = []
    for group in dict.fromkeys(GROUPS.values()):
        names = [each.name for each in doubts if each.group == group]
        if names:
            share = sum(shares[name] for name in names)
            found.append(
                Measurement(
                    what=group,
                    inputs=tuple(names),
                    share=share,
                    deviation_deg=math.degrees(math.sqrt(share * variance)),
                )
            )
    return found


class Drawn(NamedTuple):
    """Draws of an input; not to be written to."""

    draws: Array
    order: Rows
    """What puts them in ascending order."""

    @classmethod
    def of(cls, draws: Array) -> "Drawn":
        """Draws in any order."""
        return cls(draws, np.argsort(draws))


def draws_of(question: Question, doubts: tuple[Doubt, ...]) -> dict[str, Drawn]:
    """Draws of each input: normal ones as the answer has them, of a range from 0, worst, to 1."""
    count = sample_count(question)
    sampled = [each.name for each in doubts if each.name in SAMPLED]
    found = {name: _normal_draws(count, SAMPLED.index(name)) for name in sampled}
    ranged = [each.name for each in doubts if each.ends is not None]
    return found | {name: _even_draws(count, row) for row, name in enumerate(ranged)}


@cache
def _normal_draws(count: int, row: int) -> Drawn:
    return Drawn.of(unit_draws(count)[row])


@cache
def _even_draws(count: int, row: int) -> Drawn:
    """Evenly distributed draws from 0 to 1, the rows in orders of their own."""
    place = np.argsort(_scrambled(np.arange(count, dtype=np.uint64) + np.uint64(row * count)))
    return Drawn.of((place + 0.5) / count)


def _scrambled(numbers: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """SplitMix64 of numbers: to others as if at random, without `numpy.random`, which loads slowly.

    References
    ----------
    Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195, figure 17.
    """
    z = numbers * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return z ^ (z >> np.uint64(31))


def margins_of(question: Question, found: Findings, draws: Mapping[str, Drawn]) -> Array | None:
    """Smallest margin of slope of each sample, ranges drawn; None: none is known [rad]."""
    slopes = [
        one
        for one in found.each
        if one.mode.unit == "rad" and np.isfinite(one.worst).any() and not _certain(one)
    ]
    if not slopes:
        return None
    count = sample_count(question)
    if any(len(one.worst) not in (1, count) for one in slopes):
        return None  # a model with samples of its own
    margin = smallest(_moved(question, one, draws) for one in slopes)
    return np.broadcast_to(margin, (count,)) if np.isfinite(margin).all() else None


def _certain(one: Finding) -> bool:
    """Whether a margin depends on nothing drawn: it holds or does not."""
    return len(one.worst) == 1 and one.mode.key not in _DRIVEN_BY


def _moved(question: Question, one: Finding, draws: Mapping[str, Drawn]) -> Array:
    """Margin of each sample, or of all, between its worst and its best case as ranges are drawn."""
    worst, best = one.worst, one.best
    widths = {
        "theta_d": question.allowance_d.high - question.allowance_d.low,
        "theta_M": question.allowance_M.high - question.allowance_M.low,
        "friction": 1.0,
    }
    by = [name for name in _DRIVEN_BY.get(one.mode.key, ()) if name in draws]
    whole = sum(widths[name] for name in by)
    if not by or not (np.isfinite(one.worst).all() and np.isfinite(one.best).all()):
        return worst
    part = sum(widths[name] / whole * draws[name].draws for name in by)
    return np.asarray(worst + part * (best - worst))


def first_order(drawn: Drawn, values: Array) -> float:
    """First-order Sobol index of an input, from draws and the values that they led to.

    The variance of the means within slices of equally many draws, less what chance alone would
    make of it, over the variance of all.

    Parameters
    ----------
    drawn : Drawn
        The input, one draw a sample.
    values : array, shape (samples,)
        What came of them.

    Returns
    -------
    float
        From 0 to 1.

    Examples
    --------
    >>> x, y = np.random.default_rng(0).normal(size=(2, 4096))
    >>> round(first_order(Drawn.of(x), 3 * x + y), 1), round(first_order(Drawn.of(y), x), 1)
    (0.9, 0.0)

    References
    ----------
    Plischke, Borgonovo & Smith 2013, doi:10.1016/j.ejor.2012.11.047, given data.
    """
    variance = float(np.var(values))
    if not variance > 0:
        return 0.0
    ordered = values[drawn.order]
    size, longer = divmod(len(values), SLICES)
    ends = longer * (size + 1)
    slices = [ordered[ends:].reshape(-1, size)]
    if longer:
        slices.insert(0, ordered[:ends].reshape(longer, size + 1))
    sizes = np.repeat([size + 1, size], [longer, SLICES - longer])
    of_slices = [each.mean(axis=1) for each in slices]
    squares = [(each - mean[:, None]) ** 2 for each, mean in zip(slices, of_slices, strict=True)]
    variances = np.concatenate([each.mean(axis=1) for each in squares])
    means = np.concatenate(of_slices)
    within = float((sizes * variances).sum() / len(values))
    between = float((sizes * (means - values.mean()) ** 2).sum() / len(values))
    chance = within * SLICES / len(values)
    return min(max((between - chance) / variance, 0.0), 1.0)
