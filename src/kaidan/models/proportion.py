"""How sure a count of trials is: the interval of the probability behind it."""

import math
from collections.abc import Callable

CONFIDENCE = 0.95
_ROUNDS = 60


def interval(failed: int, trials: int) -> tuple[float, float]:
    """Clopper-Pearson interval of a probability, 95 %.

    Probabilities with which so many or more, and so many or fewer, fail in 2.5 % of all cases; 0
    and 1 where none and all did.

    Examples
    --------
    None of five trials, as the paper made them, says little: 0.025 is the fifth power of 0.478.

    >>> print(*(round(end, 3) for end in interval(0, 5)))
    0.0 0.522

    References
    ----------
    Clopper & Pearson 1934, doi:10.1093/biomet/26.4.404.
    """
    low, high = 0.0, 1.0
    tail = (1.0 - CONFIDENCE) / 2
    if failed > 0:
        low = _solved(lambda p: 1.0 - _at_most(failed - 1, trials, p) < tail)
    if failed < trials:
        high = _solved(lambda p: _at_most(failed, trials, p) > tail)
    return low, high


def _solved(below: Callable[[float], bool]) -> float:
    """Probability up to which something is so, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(_ROUNDS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if below(middle) else (low, middle)
    return 0.5 * (low + high)


def _at_most(count: int, trials: int, p: float) -> float:
    """Probability of at most so many, each with p."""
    if p <= 0.0:
        return 1.0
    if p >= 1.0:
        return float(count >= trials)
    log_p, log_q = math.log(p), math.log1p(-p)
    whole = math.lgamma(trials + 1)
    return math.fsum(
        math.exp(
            whole - math.lgamma(k + 1) - math.lgamma(trials - k + 1) + k * log_p
            + (trials - k) * log_q
        )
        for k in range(count + 1)
    )  # fmt: skip
