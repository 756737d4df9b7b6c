"""The uncertain inputs of the formulas: the sheets' figures, and samples about them."""

import math
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np

from kaidan.mechanics.weighing import local_angle_deviation
from kaidan.models.findings import Array
from kaidan.question import Question
from kaidan.terrain.stairs import Stairs

SAMPLES = 2048
"""Latin hypercube samples of the uncertain inputs: 20 lie beyond a risk of 1 %."""
BEYOND = 10
"""Least number of samples beyond the accepted risk: a small risk takes more samples."""
BLOCK = 1 << 18
"""Samples times steps that are judged at once."""


class Draws(NamedTuple):
    """Inputs of the formulas; axes: sample, step of the flight."""

    L: Array
    C_L: Array
    """Centroid behind the UPHILL end of the flat [m]."""
    C_N: Array
    theta_s: Array
    p: Array
    mu_low: Array
    """NaN where friction is unknown."""
    mu_high: Array


def nominal(question: Question, flight: Stairs) -> Draws:
    """Inputs of the formulas on a flight, one row: the sheets' figures.

    Of the steps only those count that may be the worst in some way.
    """
    theta_s, p = _decisive(list(dict.fromkeys(flight.regular_steps)))
    L, C_L = question.stance.flat_length, question.stance.com_from_front
    mu_low, mu_high = question.friction
    return Draws(
        L=np.full((1, 1), L),
        C_L=np.full((1, 1), C_L if question.nose_up else L - C_L),
        C_N=np.full((1, 1), question.stance.com_height),
        theta_s=theta_s[None],
        p=p[None],
        mu_low=np.full((1, 1), mu_low),
        mu_high=np.full((1, 1), mu_high),
    )


def draws(question: Question, at: Draws) -> Iterator[Draws]:
    """Inputs of the formulas with their uncertainty, about the sheets' figures `at`.

    Each uncertain quantity is normal about its value, stratified (Latin hypercube) with a fixed
    seed, so that the same question always has the same answer. The same samples for all steps,
    which come in blocks that fit into memory; one block of one row if all is certain.
    """
    spread = _of_the_whole(question)
    if not any(spread):
        yield at
        return
    count = sample_count(question)
    L, C_L, C_N, d_theta, d_p, d_mu = (
        unit_draws(count)[:, :, None] * np.array(spread)[:, None, None]
    )
    together = max(1, BLOCK // count)
    for first in range(0, at.p.shape[1], together):
        steps = slice(first, first + together)
        yield Draws(
            L=at.L + L,
            C_L=at.C_L + (C_L if question.nose_up else L - C_L),
            C_N=np.maximum(at.C_N + C_N, 1e-4),
            theta_s=np.clip(at.theta_s[:, steps] + d_theta, 0.0, 1.57),
            p=np.maximum(at.p[:, steps] + d_p, 1e-3),
            mu_low=np.maximum(at.mu_low + d_mu, 0.0),
            mu_high=np.maximum(at.mu_high + d_mu, 0.0),
        )


def _of_the_whole(question: Question) -> tuple[float, ...]:
    """Uncertainties with the doubt of a single step as one of the whole flight.

    The formulas know steps all alike. Every step as far off as one is, that is more than a robot
    sees that stands on two of them; in return the flight may have several such steps.
    """
    flight = question.flight
    if flight is None or not (flight.uncertainty.rise or flight.uncertainty.going):
        return question.spread
    L, C_L, C_N, angle, spacing, friction = question.spread
    s_r, s_g, theta_s = flight.uncertainty.rise, flight.uncertainty.going, flight.angle
    of_a_step = local_angle_deviation(theta_s=theta_s, p=flight.nosing_spacing, s_r=s_r, s_g=s_g)
    along = math.hypot(s_r * math.sin(theta_s), s_g * math.cos(theta_s))
    return L, C_L, C_N, math.hypot(angle, of_a_step), math.hypot(spacing, along), friction


def sample_count(question: Question) -> int:
    """Samples of the uncertain inputs that the risk asks for."""
    return max(SAMPLES, math.ceil(BEYOND / question.risk))


def _decisive(steps: list[tuple[float, float]]) -> tuple[Array, Array]:
    """Slope and nosing spacing of the steps that no other outdoes in every failure mode.

    Each mode gets worse with a longer spacing and, one way, with a steeper or a gentler slope.
    So a step counts if no other is both as long and as steep, or both as long and as gentle.
    """
    rise, going = np.array(steps).T
    theta_s, p = np.arctan2(rise, going), np.hypot(rise, going)
    if len(steps) == 1:
        return theta_s, p
    counts = np.zeros(len(steps), dtype=bool)
    for steepness in (theta_s, -theta_s):
        order = np.lexsort((-p, -steepness))
        longest = np.concatenate([[-np.inf], np.maximum.accumulate(p[order])[:-1]])
        counts[order[p[order] > longest]] = True
    return theta_s[counts], p[counts]


@cache
def unit_draws(count: int, rows: int = 6) -> Array:
    """Latin hypercube of independent standard normals, shape (rows, count).

    The first rows are the same however many there are.
    """
    from statistics import NormalDist

    strata = (np.arange(count) + 0.5) / count
    normal = np.array([NormalDist().inv_cdf(float(q)) for q in strata])
    shuffle = np.random.default_rng(2016)
    return np.stack([shuffle.permutation(normal) for _ in range(rows)])
