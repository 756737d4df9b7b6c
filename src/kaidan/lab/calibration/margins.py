"""Margins from counts on a fixed grid of slopes: no bisection, losses need not grow with slope."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from kaidan.lab.calibration.bench import Bench, Count
from kaidan.lab.calibration.evidence import condition
from kaidan.lab.campaign import Setting


class Margin(NamedTuple):
    """Margin of a setting at a spacing, in one direction."""

    nosing_spacing: float
    """[m]"""
    direction: str
    angles: tuple[float, ...]
    """Slopes of the grid [deg]."""
    counts: tuple[Count, ...]
    value: float
    """Mean slope from which trials are lost [deg]; NaN where the grid does not span it."""
    deviation: float
    """Standard deviation of `value`: experiments of as many trials, step of the grid [deg]."""
    none_up_to: float
    """Steepest slope up to which no trial was lost [deg]; NaN: none."""
    all_from: float
    """Gentlest slope at which every trial was lost [deg]; NaN: none."""


def margin_of(
    angles: Sequence[float], counts: Sequence[Count]
) -> tuple[float, float, float, float]:
    """Mean slope from which trials are lost, from counts on a grid, after Spearman and Karber.

    Each trial is lost from some slope on; the mean of those slopes is the lower end of the grid
    plus the integral of the share that holds (trapezoids), up to the gentlest slope at which all
    are lost: what happens beyond is luck. It needs no monotone counts: a trial that is lost at one
    slope and climbs a steeper one counts for what it is at each. The deviation is that of the
    counts, and that of not knowing where between two slopes a trial is lost first (uniform: a step
    over the root of 12 where all are in one step).

    Parameters
    ----------
    angles : sequence of float
        Slopes, increasing [deg].
    counts : sequence of Count
        At each; lost is who falls, slides, or cannot be placed.

    Returns
    -------
    value, deviation, none_up_to, all_from [deg]
        NaN for value where a quarter or more are lost at the gentlest slope, or hold on the
        steepest.

    Examples
    --------
    >>> five = lambda falls: Count(trials=5, falls=falls, extras=())
    >>> margin_of([54.0, 56.0, 58.0, 60.0], [five(0), five(0), five(5), five(5)])
    (57.0, 0.577, 56.0, 58.0)

    References
    ----------
    Karber 1931, doi:10.1007/BF01863914.
    """
    slope = np.asarray(angles, dtype=np.float64)
    trials = np.array([count.trials + count.unplaced for count in counts], dtype=np.float64)
    share = np.array([count.lost for count in counts], dtype=np.float64)
    known = np.isfinite(share)
    slope, share, trials = slope[known], share[known], trials[known]
    some, every = np.flatnonzero(share > 0), np.flatnonzero(share == 1)
    none_up_to = math.nan
    if len(slope):
        first = some[0] if len(some) else len(slope)
        none_up_to = float(slope[first - 1]) if first else math.nan
    all_from = float(slope[every[0]]) if len(every) else math.nan
    if len(every):
        slope, share, trials = (each[: every[0] + 1] for each in (slope, share, trials))
    if len(slope) < 2 or share[0] >= 0.25 or share[-1] <= 0.75:
        return math.nan, math.nan, none_up_to, all_from
    holds = 1.0 - share
    value = slope[0] + float(np.sum(np.diff(slope) * (holds[1:] + holds[:-1]) / 2))
    weight = np.zeros_like(slope)
    weight[:-1] += np.diff(slope) / 2
    weight[1:] += np.diff(slope) / 2
    variance = float(np.sum(weight**2 * share * holds / np.maximum(trials - 1, 1)))
    variance += float(np.sum((np.diff(share) * np.diff(slope)) ** 2)) / 12
    return float(value), math.sqrt(variance), none_up_to, all_from


def margins_of(
    bench: Bench,
    jobs: Sequence[tuple[Setting, float, str, Sequence[float]]],
) -> list[Margin]:
    """Margins of settings at spacings, in directions, on grids of slopes; all in one go.

    jobs: whose margins to find.
    """
    counts = bench.counts(
        (setting, condition(p, angle, direction))
        for setting, p, direction, angles in jobs
        for angle in angles
    )
    found, at = [], 0
    for _, p, direction, angles in jobs:
        own = counts[at : at + len(angles)]
        at += len(angles)
        found.append(Margin(p, direction, tuple(angles), tuple(own), *margin_of(angles, own)))
    return found


def slopes(low: float, high: float, step: float) -> tuple[float, ...]:
    """Slopes from one to the other [deg]."""
    return tuple(float(each) for each in np.arange(low, high + step / 2, step))
