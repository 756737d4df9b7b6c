"""Time of a stream of samples, from stamps that may be wrong and arrivals that may be unknown."""

import math
from enum import IntEnum
from typing import NamedTuple

SLOWEST = 0.2
"""Period of the slowest source without a stated limit [s]."""
FASTEST = 1e-4
"""Least period taken for one of a source [s]."""
JUMP = 0.5
"""Largest step of a stamp back, and forward beyond the time that passed [s]."""
SETTLING = 5.0
"""Time over which the period of the source is averaged [s]."""
GAP = 3.0
"""Periods from which on a step says nothing of the period."""


class Order(IntEnum):
    """Of a stamp, compared with the latest one."""

    EARLIER = -1
    SAME = 0
    """Or no number."""
    LATER = 1


class Step(NamedTuple):
    """From the sample before to this one."""

    passed: float
    """Time that passed [s]."""
    order: Order
    """Of its stamp."""
    jumped: bool
    """Whether the stamp jumped by more than `JUMP`; in a recording a gap looks the same."""
    period: float
    """Time for each sample, as stamp or arrival tells it [s]; NaN where neither does."""


class Timeline:
    """Time that passes from sample to sample, and the period of the source.

    Of stamp and arrival the one counts that tells of more. A sample of which neither tells anything
    counts as one period. What passed before the stamps say so, they make up for later.

    Parameters
    ----------
    period : float
        Taken for that of the source until it is known [s].

    Examples
    --------
    >>> line = Timeline(SLOWEST)
    >>> for t in (5.0, 5.1, 5.1, 5.3):
    ...     step = line.step(t, None)
    ...     line.learn(step)
    ...     print(f"{step.passed:.1f} s, {step.order.name}")
    0.0 s, LATER
    0.1 s, LATER
    0.1 s, SAME
    0.1 s, LATER
    """

    def __init__(self, period: float) -> None:
        self.arrived: float | None = None
        """When the last sample came [s]; None in a recording, and before the first one."""
        self.period = period
        """Mean time from sample to sample [s]."""
        self.learned = 0
        """Samples of which it is the mean; 0: it is not known."""
        self._begun = False
        self._latest = math.nan
        self._lead, self._unstamped = 0.0, 0  # of the time that passed, before the stamps

    def step(self, t: float, arrived: float | None) -> Step:
        """Step to the next sample.

        Parameters
        ----------
        t : float
            Its stamp [s].
        arrived : float, optional
            When it came, by a clock that never goes back [s]; None in a recording.
        """
        live = arrived is not None and self.arrived is not None
        waited = max(arrived - self.arrived, 0.0) if live else 0.0  # type: ignore[operator]
        ahead = t - self._latest if math.isfinite(t) else math.nan
        first = math.isnan(self._latest) and math.isfinite(t)
        beyond = ahead - self._lead
        jumped = ahead < -JUMP or beyond - max(waited, self.period) > JUMP
        passed = waited
        if ahead > 0 and not (jumped and waited):
            passed = max(waited, beyond)
        elif self._begun and not waited:
            passed = self.period
        period = passed if live else ahead / (1 + self._unstamped) if ahead > 0 else math.nan
        if first or ahead > 0 or jumped:
            self._lead = min(max(self._lead + passed - ahead, 0.0), SLOWEST) if ahead > 0 else 0.0
            self._latest, self._unstamped = t, 0
        else:
            self._lead += passed
            self._unstamped += 1
        self._begun, self.arrived = True, arrived
        return Step(passed, _order(ahead, first=first), jumped, period)

    def learn(self, step: Step) -> None:
        """Take a step into the period, unless it is a gap."""
        gap = step.jumped or (self.learned and step.passed > GAP * max(self.period, SLOWEST))
        if not gap and not math.isnan(step.period):
            self.learned += 1
            share = max(1.0 / self.learned, min(self.period / SETTLING, 1.0))
            self.period = max(self.period + share * (step.period - self.period), FASTEST)


def _order(ahead: float, *, first: bool) -> Order:
    if first or ahead > 0:
        return Order.LATER
    return Order.EARLIER if ahead < 0 else Order.SAME
