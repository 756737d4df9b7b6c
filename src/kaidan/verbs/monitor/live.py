"""The monitor of a climb that somebody watches: each state with its tilt and the phase it is in."""

import math

from kaidan.modes import Phase
from kaidan.question import Question
from kaidan.verbs.monitor.alarm import AlarmLimits
from kaidan.verbs.monitor.answer import MonitorAnswer, MonitorState
from kaidan.verbs.monitor.online import Monitor
from kaidan.verbs.monitor.samples import Sample

ON_FLIGHT, OFF_FLIGHT = 0.8, 0.5
"""Share of the slope at which the robot counts as on the flight, and below which it lands [1]."""


class LiveState(MonitorState):
    """What the monitor says of one sample to who watches."""

    tilt_deg: float | None
    """Inclination of the body, uphill end up positive [deg]; None if there is none."""
    phase: Phase
    """Part of the traverse, by the inclination so far."""


class LiveMonitor:
    """Monitor whose states have tilt and phase.

    Parameters
    ----------
    question : Question
        Robot, stairs, direction, facing, posture and payload.
    limits : AlarmLimits, optional
        When the alarm is raised and cleared.

    Examples
    --------
    >>> from kaidan import Stairs
    >>> stairs = Stairs.inclined(angle=0.80, nosing_spacing=0.150)
    >>> watch = LiveMonitor(Question.of("kenaf", stairs))
    >>> [watch.feed(Sample(t, angle, 0.0, 0.0)).phase.value
    ...  for t, angle in enumerate((0.0, 0.4, 0.75, 0.5, 0.1))]
    ['enter', 'enter', 'traverse', 'traverse', 'land']
    """

    def __init__(self, question: Question, *, limits: AlarmLimits | None = None) -> None:
        self._watch = Monitor.of(question, limits=limits)
        flight = question.steepest_flight
        assert flight is not None  # the monitor refuses a terrain without steps
        self.slope = flight.angle
        self._sign = 1.0 if question.nose_up else -1.0
        self._phase = Phase.ENTER

    def feed(self, sample: Sample, arrived: float | None = None) -> LiveState:
        """Take one sample; see `kaidan.verbs.monitor.online.Monitor.feed`."""
        state = self._watch.feed(sample, arrived)
        tilt = self._sign * sample.inclination if state.judged else math.nan
        if state.judged:
            self._phase = self._next_phase(tilt / self.slope)
        return self._state(state, tilt)

    def overdue(self, now: float) -> LiveState | None:
        """State if the next sample has not arrived in time, else None."""
        state = self._watch.overdue(now)
        return None if state is None else self._state(state, math.nan)

    def answer(self) -> MonitorAnswer:
        """Answer to all samples so far; see `kaidan.verbs.monitor.online.Monitor.answer`."""
        return self._watch.answer()

    def _state(self, state: MonitorState, tilt: float) -> LiveState:
        return LiveState(
            **{name: getattr(state, name) for name in MonitorState.model_fields},
            tilt_deg=math.degrees(tilt),
            phase=self._phase,
        )

    def _next_phase(self, share: float) -> Phase:
        if share >= ON_FLIGHT:
            return Phase.TRAVERSE
        if self._phase is Phase.TRAVERSE and share <= OFF_FLIGHT:
            return Phase.LAND
        return self._phase
