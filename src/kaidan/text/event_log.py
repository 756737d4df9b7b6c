"""Event log of a traverse in lines, and what each entry says."""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.verbs.traverse_report import LogEntryShown

MOST_LINES = 60
"""Most lines of a log."""
_LONGEST_PERIOD = 8


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
