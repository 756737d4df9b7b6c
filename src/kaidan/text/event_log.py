"""Event log of a traverse in lines, and what each entry says."""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.traversal.event_log import Place
    from kaidan.verbs.traverse_report import LogEntryShown

MOST_LINES = 60
"""Most lines of a log."""
_LONGEST_PERIOD = 8


def where(place: "Place") -> str:
    """Name and number of a place: "nosing 3"."""
    return place.what if place.number is None else f"{place.what} {place.number}"


def touched(place: "Place") -> str:
    """The same, with the part of the robot that touches it, unless that is its track."""
    return where(place) if place.part == "track" else f"{where(place)} ({place.part})"


def sentence(
    kind: str,
    places: "Sequence[Place]",
    end: str | None,
    rotation_deg: float = 0.0,
    topples_with_momentum: bool = False,
) -> str:
    """What an entry says.

    Parameters
    ----------
    kind : str
        As `kaidan.traversal.event_log.LogEntry` has it.
    places : sequence of Place
        What it leads to, then what it comes from.
    end : str or None
        End of the robot that it is about.
    rotation_deg : float
        Angle of a rotation [deg].
    topples_with_momentum : bool
        Whether the momentum of the rotation carries it over.
    """
    if kind == "arrives":
        return "stands on the landing"
    first = places[0]
    if kind in ("reached", "left"):
        return f"{where(first)} {'comes under' if kind == 'reached' else 'leaves'} the {first.part}"
    if kind in ("rests", "passes"):
        other = places[1]
        if (first.what, first.number) == (other.what, other.number) and first.part != other.part:
            return f"contact passes from {other.part} to {first.part}, on {where(other)}"
        if kind == "rests":
            return f"{end} comes to rest on {touched(first)}, off {touched(other)}"
        return f"contact passes from {touched(other)} to {touched(first)}"
    if kind in ("drops", "rises"):
        text = (
            f"{end} {kind} by {rotation_deg:.1f} deg about {touched(places[1])}, arrested by "
            f"{touched(first)}"
        )
        return text + ("; the momentum topples it" if topples_with_momentum else "")
    if kind == "falls":
        return f"falls over its {end}, about {touched(first)}"
    if kind == "stuck":
        return f"is stuck on {touched(first)}"
    return "the solver set it down again, within 10 mm"


def change(
    posture: str, turn_deg: float, time_s: float | None, torque_Nm: float, *, stands: bool
) -> str:
    """What the change to another posture says; a torque of NaN is not known."""
    if not stands:
        return f"does not stand while its posture changes to {posture}"
    time = "time not known" if time_s is None else f"{time_s:.1f} s"
    torque = "" if torque_Nm != torque_Nm else f", {torque_Nm:.0f} N m"
    return f"stands, changes its posture to {posture} ({turn_deg:.0f} deg, {time}{torque})"


def lines_of(entries: "Sequence[LogEntryShown]", most: int = MOST_LINES) -> list[str]:
    """Log in lines: what repeats from step to step stands there once, and at most `most` lines."""
    return [
        f"{phase:<9}{path:>8} {inclination:>10}  {text}"
        for phase, path, inclination, text in rows_of(entries, most)
    ]


def rows_of(
    entries: "Sequence[LogEntryShown]", most: int = MOST_LINES
) -> list[tuple[str, str, str, str]]:
    """The same as rows: phase, path, inclination, what happens; of what repeats that alone."""
    rows: list[tuple[str, str, str, str]] = []
    at = 0
    while at < len(entries):
        period, times = _repeat(entries, at)
        rows += [_row(entry) for entry in entries[at : at + period]]
        if times > 1:
            rows.append(("", "", "", _repeated(entries[at : at + period * times], period, times)))
        at += period * times
    if len(rows) > most:
        left = len(rows) - most + 1
        head = 2 * most // 3
        rows[head : head + left] = [("", "", "", f"... {left} more lines (all with --json)")]
    return rows


def _repeated(entries: "Sequence[LogEntryShown]", period: int, times: int) -> str:
    """That a block repeats, and at which steps."""
    block = {entry.step for entry in entries[:period] if entry.step is not None}
    known = [entry.step for entry in entries[period:] if entry.step is not None]
    if len(block) > 1:  # one nosing at one end, another at the other
        more = "once more" if times == 2 else f"{times - 1} times more"
        return f"the same {more}, from step to step"
    if known[0] == known[-1]:
        return f"step {known[0]}: the same"
    stride = abs(known[period] - known[0]) if times > 2 else 1
    every = "" if stride == 1 else f" by {stride}"
    return f"steps {known[0]} to {known[-1]}{every}: the same"


def _row(entry: "LogEntryShown") -> tuple[str, str, str, str]:
    inclination = round(entry.inclination_deg, 1) + 0.0
    return entry.phase, f"{entry.path_m:.2f} m", f"{inclination:.1f} deg", entry.text


def _repeat(entries: "Sequence[LogEntryShown]", at: int) -> tuple[int, int]:
    """Length of the block that repeats here, and how often; (1, 1) where nothing does."""
    best = (1, 1)
    for period in range(1, _LONGEST_PERIOD + 1):
        times = 1
        while _same(entries, at, at + times * period, period):
            times += 1
        steps = [entries[at + k * period].step or 0 for k in range(times)]
        shifts = {after - before for before, after in pairwise(steps)}
        if len(shifts) > 1:  # as far as the steps advance evenly
            first = steps[1] - steps[0]
            times = 1 + next(
                k for k, pair in enumerate(pairwise(steps)) if pair[1] - pair[0] != first
            )
        if (times - 1) * period >= 2 and times * period > best[0] * best[1] and shifts != {0}:
            best = (period, times)
    return best


def _same(entries: "Sequence[LogEntryShown]", at: int, then: int, period: int) -> bool:
    if then + period > len(entries):
        return False
    pairs = [(entries[at + k], entries[then + k]) for k in range(period)]
    if any(_signature(a) != _signature(b) or a.step is None or b.step is None for a, b in pairs):
        return False
    return len({(b.step or 0) - (a.step or 0) for a, b in pairs}) == 1


def _signature(entry: "LogEntryShown") -> tuple[object, ...]:
    """Equal for two entries that differ only by the step where they happen."""
    return (
        entry.kind,
        entry.phase,
        tuple((place.what, place.part) for place in entry.places),
        tuple(
            place.number - (entry.step or 0) for place in entry.places if place.number is not None
        ),
        round(entry.inclination_deg, 1),
        round(entry.rotation_deg, 1),
    )
