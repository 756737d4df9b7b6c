"""What a monitor says: a head, a row a sample, and sentences on all samples."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.verbs.monitor.answer import MonitorAnswer, MonitorState

HEAD = f"{'t [s]':>10}  {'margin [deg]':>12}  {'over its':<8}  {'tips in [s]':>11}  alarm"
_TIMES = {0: "never raised", 1: "raised once"}
_CAUSES = {
    "tipped over": "Gravity alone turned the robot over.",
    "silent": "No sample came in time. State --no-data for a sensor below 5 Hz.",
    "no data": "Samples came, and none could be judged.",
    "half blind": "Half of the samples or more were lost or could not be judged.",
    "frozen": "All values stayed the same. State --resolution for a coarse sensor at rest.",
    "clock": "The time stamps stood still, jumped, or came from two clocks.",
}
"""What was wrong at the alarms that are not of a small margin."""
_SLOW = 5.0
"""Rate below which an alarm may take longer than 0.5 s [Hz]."""


def text(answer: "MonitorAnswer") -> str:
    """State after each sample, if the answer holds them, and the summary."""
    rows = [HEAD, *map(row, answer.states), ""] if answer.states else []
    return "\n".join([*rows, summary(answer)])


def row(state: "MonitorState") -> str:
    """One line for one sample."""
    t = "-" if state.t_s is None else f"{state.t_s:.3f}"
    alarm = "ALARM" if state.alarm else "no"
    notes = [", ".join(cause for cause in state.causes if cause in _CAUSES)]
    notes += [f"{state.status}: {state.message}"] if state.message else []
    note = "".join(f"  {each}" for each in notes if each)
    down, up = state.margin_downhill_deg, state.margin_uphill_deg
    if state.margin_deg is None or down is None or up is None:
        figures = f"{'-':>12}  {'-':<8}  {'-':>11}"
    else:
        end = "downhill" if down <= up else "uphill"
        time = "-" if state.time_to_tip_s is None else f"{state.time_to_tip_s:.2f}"
        figures = f"{state.margin_deg:>+12.1f}  {end:<8}  {time:>11}"
    return f"{t:>10}  {figures}  {alarm:<5}{note}".rstrip()


def summary(answer: "MonitorAnswer") -> str:
    """How many samples there were, what could not be judged, the lowest margin, the alarm."""
    lost = answer.samples - answer.judged
    if not answer.inside_model:
        return (
            f"{answer.samples} samples, none judged\nOUTSIDE THE MODEL  {answer.first_unjudged}"
        ).rstrip()
    share = f" ({100 * answer.unjudged_share:.0f} %)" if lost else ""
    parts = [f"{answer.samples} samples, {lost} not judged{share}"]
    if answer.lowest_margin_deg is not None:
        parts.append(f"lowest margin {answer.lowest_margin_deg:+.1f} deg{_at(answer)}")
    alarm = _TIMES.get(answer.alarms, f"raised {answer.alarms} times")
    if answer.alarms:
        t = answer.first_alarm_t_s
        first = f"in row {answer.first_alarm_row}" if t is None else f"at t = {t:.3f} s"
        alarm += f", first {first}"
    lines = ["; ".join([*parts, f"alarm {alarm}"])]
    lines += [
        f"{cause.upper()}  {said}" for cause, said in _CAUSES.items() if cause in answer.raised
    ]
    if lost:
        lines.append(f"The first not judged: {answer.first_unjudged}")
    if answer.rate_hz is not None and answer.rate_hz < _SLOW - 0.1:
        lines.append(f"Samples came at {answer.rate_hz:.1f} Hz: below 5 Hz an alarm may come late.")
    if answer.exit_code == 2:
        lines.append(
            "NO ANSWER  Fewer than half of the samples could be judged: no alarm means nothing."
        )
    return "\n".join(lines)


def _at(answer: "MonitorAnswer") -> str:
    return "" if answer.lowest_margin_t_s is None else f" at t = {answer.lowest_margin_t_s:.3f} s"
