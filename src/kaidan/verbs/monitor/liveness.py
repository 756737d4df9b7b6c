"""Liveness: whether the samples of a sensor tell what the robot does, counted in time.

One rule for a recording, a pipe, the page and ROS. It knows nothing of tipping over; it names what
makes a monitor blind, within 0.5 s of the first sample that is bad or missing.
"""

from collections import Counter, deque

from kaidan.verbs.monitor.alarm import AlarmLimits, Cause
from kaidan.verbs.monitor.samples import Sample
from kaidan.verbs.monitor.timeline import FASTEST, SLOWEST, Order, Step, Timeline

SHORTEST, PERIODS = 0.2, 3.0
"""Least time without data at which an alarm is raised [s], and that time in periods."""
TOO_SLOW = 0.25
"""Mean period above which a source without a stated limit is refused [s]: 5 Hz and jitter."""
MANY = 50
"""Samples after which a period of no source is the fault of its clock."""
WINDOW = 0.45
"""Time of which half or less is judged when half blind [s]. If less than half of a second is
judged, so is less than half of one of its halves; 0.05 s are left for the jitter of samples."""
FROZEN, REPEATS = 0.5, 3
"""How long all values stay the same until they are frozen [s], and how often they come again."""
RARE = 0.15
"""Period above which one stamp that goes back tells of two clocks [s]: a second comes too late."""
TIMERS = 1e-3
"""How much earlier than it is set a timer may wake [s]."""
HOLD = 1.0
"""How long a fault has to be gone until a good sample clears its alarm [s]."""


class _Window:
    """Samples of the last while, counted."""

    def __init__(self) -> None:
        self._held: deque[tuple[float, bool, Order | None]] = deque()
        self.judged = 0
        self.orders: Counter[Order | None] = Counter()
        """Of their stamps; None for rows that could not be read."""

    def __len__(self) -> int:
        return len(self._held)

    def add(self, at: float, *, judged: bool, order: Order | None) -> None:
        """Take one in that came at a time [s]."""
        self._held.append((at, judged, order))
        self.judged += judged
        self.orders[order] += 1

    def forget(self, until: float) -> None:
        """Leave out those that came until a time [s]."""
        while self._held and self._held[0][0] <= until:
            _, judged, order = self._held.popleft()
            self.judged -= judged
            self.orders[order] -= 1


class Liveness:
    """State machine of the liveness contract.

    Parameters
    ----------
    limits : AlarmLimits
        Of which `no_data_on` and `resolution` count.

    Examples
    --------
    >>> watch = Liveness(AlarmLimits())
    >>> for k in range(60):
    ...     watch.take(Sample(0.01 * k, 0.5, 0.0, 0.0), judged=True)
    >>> watch.raised
    (<Cause.FROZEN: 'frozen'>,)
    """

    def __init__(self, limits: AlarmLimits) -> None:
        self._limits = limits
        self._line = Timeline(max(SLOWEST, limits.no_data_on or 0.0))
        self._raised: dict[Cause, float] = {}
        self._now = 0.0
        self._restart()

    @property
    def raised(self) -> tuple[Cause, ...]:
        """Alarms that are on, the most urgent first."""
        return tuple(cause for cause in Cause if cause in self._raised)

    @property
    def limit(self) -> float:
        """Time without data at which an alarm is raised [s]."""
        if self._limits.no_data_on is not None:
            return self._limits.no_data_on
        return max(SHORTEST, PERIODS * min(self._line.period, SLOWEST))

    @property
    def due(self) -> float | None:
        """Time until the next sample has to arrive [s]; None where samples do not come live."""
        return None if self._line.arrived is None else self.limit

    @property
    def rate(self) -> float | None:
        """Samples a second [Hz]; None until it is known."""
        return 1.0 / self._line.period if self._line.learned else None

    def take(self, sample: Sample, *, judged: bool, arrived: float | None = None) -> None:
        """Take the next sample.

        Parameters
        ----------
        judged : bool
            Whether it could be judged.
        arrived : float, optional
            When it came, by a clock that never goes back [s]; None in a recording.
        """
        step = self._line.step(sample.t, arrived)
        found = self._pass_time(step)
        order = None if sample.fault else step.order
        self._window.add(self._now, judged=judged, order=order)
        found |= self._unjudged(judged) | self._frozen(sample, judged) | self._disordered(order)
        self._raised |= dict.fromkeys(found, self._now)
        if judged and order is Order.LATER and not found:
            held = self._raised.items()
            self._raised = {cause: at for cause, at in held if self._now - at < HOLD}

    def overdue(self, now: float) -> bool:
        """Whether the next sample has not arrived in time by then [s], which raises the alarm."""
        arrived = self._line.arrived
        late = arrived is not None and now - arrived >= self.limit - TIMERS
        if late:
            self._raised[Cause.SILENT] = self._now
        return late

    def _restart(self) -> None:
        """Begin to count, at the start and when the sensor was silent."""
        self._window = _Window()
        self._begun = self._judged_at = self._same_since = self._now
        self._values: tuple[float, ...] = ()
        self._same = 0

    def _pass_time(self, step: Step) -> set[Cause]:
        """Let the time of a step pass, in which the sensor may have been silent."""
        line = self._line
        found = {Cause.CLOCK} if step.jumped else set()
        if step.passed > self.limit:
            self._restart()
            return found | {Cause.SILENT}
        line.learn(step)
        self._now += step.passed
        self._window.forget(self._now - self._span)
        if self._limits.no_data_on is None and line.period > TOO_SLOW:
            found.add(Cause.SILENT)
        if line.period <= FASTEST and line.learned > MANY:
            found.add(Cause.CLOCK)
        return found

    @property
    def _span(self) -> float:
        """Time of the window [s]: it has room for three samples."""
        return WINDOW * max(1.0, self._line.period / SLOWEST)

    @property
    def _whole(self) -> bool:
        """Whether the window has had the time to fill."""
        return self._now - self._begun >= self._span - self._line.period

    def _unjudged(self, judged: bool) -> set[Cause]:
        """No data, and half blind."""
        found = set()
        if judged:
            self._judged_at = self._now
        elif self._now - self._judged_at >= self.limit - self._line.period / 2:
            found.add(Cause.NO_DATA)
        expected = max(len(self._window), self._span / self._line.period)
        if self._whole and 2 * self._window.judged <= expected:
            found.add(Cause.HALF_BLIND)
        return found

    def _frozen(self, sample: Sample, judged: bool) -> set[Cause]:
        """Frozen: all values the same, which a rate within the resolution explains."""
        if not judged:
            return set()
        values = (sample.inclination, sample.inclination_rate, sample.acceleration)
        if values != self._values:
            self._values, self._same_since, self._same = values, self._now, 0
            return set()
        self._same += 1
        long = self._now - self._same_since >= FROZEN - self._line.period / 2
        explained = abs(sample.inclination_rate) * FROZEN <= self._limits.resolution
        if not long or self._same < REPEATS or (self._limits.resolution and explained):
            return set()
        return {Cause.FROZEN}

    def _disordered(self, order: Order | None) -> set[Cause]:
        """Clock: stamps that go back, or stand still."""
        seen = self._window.orders
        stamps = len(self._window) - seen[None]
        stands = self._whole and stamps > 0 and seen[Order.LATER] == 0
        enough = seen[Order.EARLIER] >= (1 if self._line.period > RARE else 2)
        return {Cause.CLOCK} if stands or (order is Order.EARLIER and enough) else set()
