"""What a monitor counts of its states, and the answer that is made of it."""

from collections import Counter
from collections.abc import Iterable

from kaidan.errors import InputError
from kaidan.verbs.monitor.alarm import Cause
from kaidan.verbs.monitor.answer import MonitorAnswer, MonitorState, SampleStatus

UNJUDGED = (
    SampleStatus.NOT_FINITE,
    SampleStatus.IMPLAUSIBLE,
    SampleStatus.UNREADABLE,
    SampleStatus.OUTSIDE_MODEL,
)


class Tally:
    """Counts of states: by status, alarms, the lowest margin.

    Parameters
    ----------
    robot, stairs : str
        Their names.
    """

    def __init__(self, robot: str, stairs: str) -> None:
        self._names = (robot, stairs)
        self._statuses: Counter[str] = Counter()
        self._first_unjudged = ""
        self._lowest: MonitorState | None = None
        self._causes: tuple[Cause, ...] = ()
        self._alarms = 0
        self._raised: Counter[str] = Counter()
        self._first_alarm: MonitorState | None = None

    def count(self, state: MonitorState) -> MonitorState:
        """State, counted; one of a sample that is missing counts for the alarm alone."""
        if state.status is not SampleStatus.MISSING:
            self._statuses[state.status] += 1
        if state.status in UNJUDGED:
            self._first_unjudged = self._first_unjudged or state.message
        self._raised.update(cause for cause in state.causes if cause not in self._causes)
        if state.alarm and not self._causes:
            self._alarms += 1
            self._first_alarm = self._first_alarm or state
        self._causes = state.causes
        lowest = None if self._lowest is None else self._lowest.margin_deg
        if state.margin_deg is not None and (lowest is None or state.margin_deg < lowest):
            self._lowest = state
        return state

    def answer(
        self, states: Iterable[MonitorState], *, rate: float | None, inside_model: bool
    ) -> MonitorAnswer:
        """Answer to all states so far.

        Parameters
        ----------
        states : iterable of MonitorState
            Those that are to stand in it.
        rate : float, optional
            Samples a second [Hz].
        inside_model : bool
            Whether there is a prediction.

        Raises
        ------
        InputError
            No sample has come.
        """
        samples = sum(self._statuses.values())
        if not samples:
            raise InputError("no samples came")
        lowest, first = self._lowest, self._first_alarm
        robot, stairs = self._names
        return MonitorAnswer(
            robot=robot,
            stairs=stairs,
            samples=samples,
            judged=samples - sum(self._statuses[status] for status in UNJUDGED),
            statuses=dict(self._statuses),
            first_unjudged=self._first_unjudged,
            lowest_margin_deg=None if lowest is None else lowest.margin_deg,
            lowest_margin_t_s=None if lowest is None else lowest.t_s,
            alarms=self._alarms,
            raised=dict(self._raised),
            first_alarm_row=None if first is None else first.row,
            first_alarm_t_s=None if first is None else first.t_s,
            rate_hz=rate,
            inside_model=inside_model,
            states=tuple(states),
        )
