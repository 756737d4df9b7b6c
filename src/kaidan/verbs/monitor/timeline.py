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
    told: float
    """Time that stamp or arrival tell [s]; NaN where neither does."""
    samples: int
    """Samples that came in that time."""


class Timeline:
    """Time that passes from sample to sample, and the period of the source.

    Of stamp and arrival the one counts that tells of more. A sample of which neither tells anything
    counts as one period. What passed before the stamps say so, they make up for later.

    period: taken for that of the source until it is known [s].

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
        self._lead, self._unstamped = 0.0, 0

    def step(self, t: float, arrived: float | None) -> Step:
        """Step to the next sample.

        t: its stamp [s].
        arrived: when it came, by a clock that never goes back [s]; None in a recording.
        """
        waited = self._waited(arrived)
        known = math.isfinite(t)
        ahead = t - self._latest if known else math.nan  # NaN at the first stamp
        jumped = ahead < -JUMP or ahead - self._lead - max(waited or 0.0, self.period) > JUMP
        if ahead > 0 and not (jumped and waited):
            passed = max(waited or 0.0, ahead - self._lead)
        else:
            passed = waited or self.period * self._begun
        order = Order.EARLIER if ahead < 0 else Order.SAME
        if ahead > 0 or (known and math.isnan(self._latest)):
            order = Order.LATER
        if waited is not None:
            step = Step(passed, order, jumped, told=passed, samples=1)
        else:
            stood = self.learned > 0 and self._lead > SLOWEST
            told = ahead if ahead > 0 and not stood else math.nan
            step = Step(passed, order, jumped, told, samples=1 + self._unstamped)
        self._keep(step, t, ahead)
        self._begun, self.arrived = True, arrived
        return step

    def _waited(self, arrived: float | None) -> float | None:
        """Time from one arrival to the next [s]; None if it is not known."""
        if arrived is None or self.arrived is None:
            return None
        return max(arrived - self.arrived, 0.0)

    def _keep(self, step: Step, t: float, ahead: float) -> None:
        """Keep the latest stamp, and how far the time that passed leads the stamps."""
        if step.order is not Order.LATER and not step.jumped:
            self._lead += step.passed
            self._unstamped += 1
            return
        lead = self._lead + step.passed - ahead if ahead > 0 else 0.0
        self._lead = min(max(lead, 0.0), SLOWEST)
        self._latest, self._unstamped = t, 0

    def learn(self, step: Step) -> None:
        """Take a step into the period, unless it is a gap."""
        gap = step.jumped or (self.learned and step.passed > GAP * max(self.period, SLOWEST))
        if not gap and not math.isnan(step.told):
            self.learned += step.samples
            share = max(1 / self.learned, min(self.period / SETTLING, 1.0))
            more = share * (step.told - step.samples * self.period)
            self.period = max(self.period + more, FASTEST)
