"""How well counts of falls and a measured extra inclination go with simulated ones."""

import math
from collections.abc import Sequence

import numpy as np

from kaidan.lab.calibration.bench import Count
from kaidan.lab.calibration.evidence import Evidence


def log_falls(falls: int, trials: int, simulated: Count) -> float:
    """Logarithm of the probability that so many of some trials fall, given simulated ones.

    Beta-binomial: the share of falls is unknown but for the simulated trials and Jeffreys' prior
    (1/2, 1/2), so five simulated trials without a fall do not exclude one.

    Examples
    --------
    >>> five = Count(trials=5, falls=0, extras=(0.0,) * 5)
    >>> [round(math.exp(log_falls(k, 5, five)), 3) for k in (0, 1, 5)]
    [0.716, 0.188, 0.001]
    """
    a, b = 0.5 + simulated.falls, 0.5 + simulated.trials - simulated.falls
    choose = math.log(math.comb(trials, falls))
    return choose + _log_beta(falls + a, trials - falls + b) - _log_beta(a, b)


def _log_beta(a: float, b: float) -> float:
    return math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b)


def log_any_falls(trials: int, simulated: Count) -> float:
    """The same for one fall or more."""
    return math.log(-math.expm1(log_falls(0, trials, simulated)))


def log_extra(measured: float, uncertainty: float, extras: Sequence[float]) -> float:
    """Logarithm of the density of a measured extra inclination, given simulated ones [1/deg].

    Normal about their mean; the variance is the measurement's plus theirs.

    Returns
    -------
    float
        Minus infinity where every simulated trial fell, so that there is none to measure.
    """
    if not extras:
        return -math.inf
    spread = float(np.var(extras, ddof=1)) if len(extras) > 1 else 0.0
    variance = uncertainty**2 + spread
    away = measured - float(np.mean(extras))
    return -0.5 * (away**2 / variance + math.log(2 * math.pi * variance))


def log_likelihood(
    evidence: Evidence, trials: int, below: Count, low: Count, high: Count, at_theta_d: Count
) -> tuple[float, float]:
    """Logarithms of the likelihoods of the fall zone and of theta_d.

    The zone means: none of five falls below it, at least one at its lower end, all of five
    at its upper end. theta_d is measured in trials that do not fall: where all fall at its slope,
    at the next gentler one ("the angle of inclination of the stairs was approximately marginal").
    """
    zone = (
        log_falls(0, trials, below) + log_any_falls(trials, low) + log_falls(trials, trials, high)
    )
    measured = evidence.theta_d
    extras = at_theta_d.extras or low.extras or below.extras
    return zone, log_extra(measured.extra, measured.uncertainty, extras)


def log_best_zone(trials: int) -> float:
    """Logarithm of the probability of the fall zone where simulated trials fell just as read.

    None of five below it, all of five at its upper end, four or five of five at its lower end:
    what five simulated trials can say at best.
    """
    none = Count(trials, 0, (0.0,) * trials)
    every = Count(trials, trials, ())
    return (
        log_falls(0, trials, none) + log_any_falls(trials, every) + log_falls(trials, trials, every)
    )
