"""Margins from counts on a fixed grid of slopes: no bisection, falls need not grow with slope."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from kaidan.calibration.bench import Bench, Count, Setting
from kaidan.calibration.evidence import condition


class Margin(NamedTuple):
    """Margin of a setting at a spacing, in one direction."""

    nosing_spacing: float
    """[m]"""
    direction: str
    angles: tuple[float, ...]
    """Slopes of the grid [deg]."""
    counts: tuple[Count, ...]
    value: float
    """Mean slope of falling [deg]; NaN where the grid does not span it."""
    deviation: float
    """Standard deviation of `value`: experiments of as many trials, step of the grid [deg]."""
    none_up_to: float
    """Steepest slope below which, itself included, no trial fell [deg]; NaN: none."""
    all_from: float
    """Slope from which on every trial fell [deg]; NaN: none."""


def margin_of(
    angles: Sequence[float], counts: Sequence[Count]
) -> tuple[float, float, float, float]:
    """Mean slope of falling from counts on a grid, after Spearman and Karber.

    Each trial falls from some slope on; the mean of those slopes is the lower end of the grid plus
    the integral of the share that does not fall (trapezoids). It needs no monotone counts: a trial
    that falls at one slope and climbs a steeper one counts for what it is at each. The deviation is
    that of the counts, and that of not knowing where between two slopes a trial begins to fall
    (uniform: a step over the root of 12 where all do in one step).

    Parameters
    ----------
    angles : sequence of float
        Slopes, increasing [deg].
    counts : sequence of Count
        At each.

    Returns
    -------
    value, deviation, none_up_to, all_from [deg]
        NaN for value where a quarter or more fall at the gentlest slope, or climb the steepest.

    Examples
    --------
    >>> five = lambda falls: Count(trials=5, falls=falls, swings=(), slid=0)
    >>> margin_of([54.0, 56.0, 58.0, 60.0], [five(0), five(0), five(5), five(5)])
    (57.0, 0.577, 56.0, 58.0)

    References
    ----------
    Karber 1931, doi:10.1007/BF01863914.
    """
    slope = np.asarray(angles, dtype=np.float64)
    trials = np.array([count.trials for count in counts], dtype=np.float64)
    falls = np.array([count.falls for count in counts], dtype=np.float64)
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.where(trials > 0, falls / trials, np.nan)
    known = np.isfinite(share)
    slope, share, trials = slope[known], share[known], trials[known]
    if len(slope) < 2:
        return math.nan, math.nan, math.nan, math.nan
    clean = np.flatnonzero(share > 0)
    none_up_to = float(slope[-1] if not len(clean) else slope[clean[0] - 1] if clean[0] else np.nan)
    stands = np.flatnonzero(share < 1)
    last = stands[-1] if len(stands) else -1
    all_from = float(slope[last + 1]) if last + 1 < len(slope) else math.nan
    if share[0] >= 0.25 or share[-1] <= 0.75:
        return math.nan, math.nan, none_up_to, all_from
    climbs = 1.0 - share
    value = slope[0] + float(np.sum(np.diff(slope) * (climbs[1:] + climbs[:-1]) / 2))
    weight = np.zeros_like(slope)
    weight[:-1] += np.diff(slope) / 2
    weight[1:] += np.diff(slope) / 2
    variance = float(np.sum(weight**2 * share * climbs / np.maximum(trials - 1, 1)))
    variance += float(np.sum((np.diff(share) * np.diff(slope)) ** 2)) / 12
    return float(value), math.sqrt(variance), none_up_to, all_from


def margins_of(
    bench: Bench,
    asked: Sequence[tuple[Setting, float, str, Sequence[float]]],
) -> list[Margin]:
    """Margins of settings at spacings, in directions, on grids of slopes; all in one go.

    Parameters
    ----------
    bench : Bench
        What runs the trials.
    asked : sequence of (setting, nosing spacing [m], direction, slopes [deg])
        What is asked.
    """
    counts = bench.counts(
        (setting, condition(p, angle, direction))
        for setting, p, direction, angles in asked
        for angle in angles
    )
    found, at = [], 0
    for _, p, direction, angles in asked:
        own = counts[at : at + len(angles)]
        at += len(angles)
        found.append(Margin(p, direction, tuple(angles), tuple(own), *margin_of(angles, own)))
    return found


def slopes(low: float, high: float, step: float) -> tuple[float, ...]:
    """Slopes from one to the other [deg]."""
    return tuple(float(each) for each in np.arange(low, high + step / 2, step))
