"""Events of a traverse as people tell them: one line a move, a regular flight told once."""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from kaidan.climb import Climb, Happening
from kaidan.contact import BELLY, FLIPPER, Event
from kaidan.profile import STEEP

Array = NDArray[np.float64]

MOST_LINES = 60
"""Most lines that a way is told in."""
_LONGEST_PERIOD = 8
_ENDS_OF_TURN = (Event.CAUGHT, Event.FELL_FORWARD, Event.FELL_BACKWARD, Event.STUCK)


@dataclass(frozen=True)
class Place:
    """Something the robot touches."""

    what: str
    """nosing, corner, tread, riser, lower landing, upper landing, ground."""
    number: int | None
    """Of the step, from the bottom."""
    part: str
    """Part of the robot: track, front flipper, rear flipper, belly."""

    @property
    def where(self) -> str:
        """Its name and number."""
        return self.what if self.number is None else f"{self.what} {self.number}"

    @property
    def text(self) -> str:
        """In words, with the part of the robot that touches it."""
        return self.where if self.part == "track" else f"{self.where} ({self.part})"


@dataclass(frozen=True)
class Move:
    """One or more events that belong together."""

    kind: str
    """passes, rests, swings, falls, arrives, stuck, resettled."""
    phase: str
    way: float
    """Arclength of the centroid's path [m]."""
    inclination: float
    """Of the body at its start, leading end up [deg]."""
    text: str
    """In words."""
    step: int | None
    """Number of the step it leads to."""
    signature: tuple[object, ...]
    """Equal for two moves that differ only by the step where they happen."""
    swing: float = 0.0
    """How far it turns [deg]."""


def moves_of(found: Climb, leading: str) -> tuple[Move, ...]:
    """Moves of a traverse, in order."""
    events, told = found.events, found.happenings
    moves, at = [], 0
    while at < len(events):
        code = Event(int(events[at, 0]))
        after = Event(int(events[at + 1, 0])) if at + 1 < len(events) else None
        contact = code in (Event.MADE, Event.TAIL_RESTS) and after is Event.LOST
        turn = code in (Event.NOSE_DROPS, Event.TIPS_BACK) and after in _ENDS_OF_TURN
        group = 2 if contact or turn else 1
        moves.append(_move(found, leading, events[at : at + group], told[at : at + group]))
        at += group
    return tuple(moves)


def _move(found: Climb, leading: str, events: Array, told: tuple[Happening, ...]) -> Move:
    code, last = Event(int(events[0, 0])), Event(int(events[-1, 0]))
    first = place_of(found, int(events[0, 5]), leading)
    trailing = "tail" if leading == "nose" else "nose"
    swing = told[-1].swing_deg or 0.0
    places: tuple[Place, ...] = (first,)
    if code in (Event.REACHED, Event.LEFT):
        kind = code.name.lower()
        goes = "comes under" if code is Event.REACHED else "leaves"
        text = f"{first.where} {goes} the {first.part}"
    elif code in (Event.MADE, Event.TAIL_RESTS, Event.LOST):
        other = place_of(found, int(events[0, 6]), leading)
        places = (first, other)
        if code is Event.TAIL_RESTS:
            kind, text = "rests", f"{trailing} comes to rest on {first.text}, off {other.text}"
        else:
            kind, text = "passes", f"contact passes from {other.text} to {first.text}"
        if (first.what, first.number) == (other.what, other.number) and first != other:
            text = f"contact passes from {other.part} to {first.part}, on {other.where}"
    elif last is Event.CAUGHT:
        down = code is Event.NOSE_DROPS
        by = place_of(found, int(events[-1, 6 if down else 5]), leading)
        places = (by, first)
        verb = "drops" if down else "rises"
        kind = "swings"
        text = f"{leading} {verb} by {swing:.1f} deg about {first.text}, caught by {by.text}"
        if told[-1].toppled_with_momentum:
            text += "; with the momentum gained it would topple"
    elif last in (Event.FELL_FORWARD, Event.FELL_BACKWARD):
        end = leading if last is Event.FELL_FORWARD else trailing
        kind, text = "falls", f"falls over its {end}, about {first.text}"
    elif last is Event.STUCK:
        kind, text = "stuck", f"is stuck on {first.text}"
    elif last is Event.ARRIVED:
        kind, text, places = "arrives", "stands on the landing", ()
    else:
        kind, text = "resettled", "was let down again by the solver, within 10 mm"
    numbers = [place.number for place in places if place.number is not None]
    step = numbers[0] if numbers else None
    signature = (
        kind,
        told[0].phase,
        tuple((place.what, place.part) for place in places),
        tuple(number - (step or 0) for number in numbers),
        round(told[0].inclination_deg, 1),
        round(swing, 1),
    )
    return Move(
        kind, told[0].phase.value, told[0].way_m, told[0].inclination_deg, text, step, signature,
        swing,
    )  # fmt: skip


def place_of(found: Climb, feature: int, leading: str) -> Place:
    """What a feature of the kernel is on these stairs and this robot."""
    part = (feature >> 2) & 15
    outline = found.outline
    name = "track"
    if outline.kinds[part] == BELLY:
        name = "belly"
    elif outline.kinds[part] == FLIPPER:
        ahead = outline.parts[part, 0] + outline.parts[part, 3] > 0
        name = "front flipper" if ahead == (leading == "nose") else "rear flipper"
    ground, k = found.run.ground, feature >> 6
    mirror = -1.0 if found.descending else 1.0
    nosings = found.profile.nosings * np.array([mirror, 1.0])
    nosings = nosings[np.argsort(nosings[:, 0], kind="stable")]
    if feature & 3 == 0:
        return _corner(nosings, mirror * ground[k, 0], float(ground[k, 1]), name)
    ends = ground[[k, k + 1], :2] * np.array([mirror, 1.0])
    ends = ends[np.argsort(ends[:, 1], kind="stable")]
    run, rise = np.abs(ends[1] - ends[0])
    if math.atan2(rise, run) > STEEP:
        top = _corner(nosings, float(ends[1, 0]), float(ends[1, 1]), name)
        return Place("riser", top.number, name)
    return _tread(nosings, float(ends[:, 0].mean()), name, outline.stance.flat_length)


def _corner(nosings: Array, x: float, z: float, part: str) -> Place:
    away = np.hypot(nosings[:, 0] - x, nosings[:, 1] - z)
    if len(away) and away.min() < 1e-6:
        return Place("nosing", int(np.argmin(away)) + 1, part)
    return Place("corner of step", _passed(nosings, x), part)


def _tread(nosings: Array, x: float, part: str, room: float) -> Place:
    number = _passed(nosings, x)
    if len(nosings) == 0:
        return Place("ground", None, part)
    if number == 0:
        return Place("the lower landing", None, part)
    if number == len(nosings):
        return Place("the upper landing", None, part)
    if nosings[number, 0] - nosings[number - 1, 0] >= room:
        return Place("the landing behind step", number, part)
    return Place("tread", number, part)


def _passed(nosings: Array, x: float) -> int:
    return int(np.searchsorted(nosings[:, 0], x + 1e-9, side="right"))


def lines_of(moves: tuple[Move, ...], most: int = MOST_LINES) -> list[str]:
    """Moves in lines: what repeats from step to step is told once, and never more than `most`."""
    lines, at = [], 0
    while at < len(moves):
        period, times = _repeat(moves, at)
        if times > 1:
            lines += [_line(move) for move in moves[at : at + period]]
            block = [move.step for move in moves[at : at + period] if move.step is not None]
            steps = [move.step for move in moves[at + period : at + period * times]]
            known = [step for step in steps if step is not None]
            if len(set(block)) > 1:  # one nosing at one end, another at the other
                more = "once more" if times == 2 else f"{times - 1} times more"
                lines.append(f"{'':27}the same {more}, from step to step")
            else:
                stride = abs(known[period] - known[0]) if times > 2 else 1
                every = "" if stride == 1 else f" by {stride}"
                lines.append(f"{'':27}steps {known[0]} to {known[-1]}{every}: the same")
            at += period * times
        else:
            lines.append(_line(moves[at]))
            at += 1
    if len(lines) > most:
        left = len(lines) - most + 1
        head = 2 * most // 3
        lines[head : head + left] = [f"{'':27}... {left} more lines (all with --json)"]
    return lines


def _line(move: Move) -> str:
    return (
        f"{move.phase:<9}{move.way:6.2f} m {round(move.inclination, 1) + 0.0:6.1f} deg  {move.text}"
    )


def _repeat(moves: tuple[Move, ...], at: int) -> tuple[int, int]:
    """Length of the block that repeats here, and how often; (1, 1) where nothing does."""
    best = (1, 1)
    for period in range(1, _LONGEST_PERIOD + 1):
        times = 1
        while _same(moves, at, at + times * period, period):
            times += 1
        steps = [moves[at + k * period].step or 0 for k in range(times)]
        shifts = {after - before for before, after in pairwise(steps)}
        if len(shifts) > 1:  # as far as the steps advance evenly
            first = steps[1] - steps[0]
            times = 1 + next(
                k for k, pair in enumerate(pairwise(steps)) if pair[1] - pair[0] != first
            )
        if (times - 1) * period >= 2 and times * period > best[0] * best[1] and shifts != {0}:
            best = (period, times)
    return best


def _same(moves: tuple[Move, ...], at: int, then: int, period: int) -> bool:
    if then + period > len(moves):
        return False
    pairs = [(moves[at + k], moves[then + k]) for k in range(period)]
    if any(a.signature != b.signature or a.step is None or b.step is None for a, b in pairs):
        return False
    return len({(b.step or 0) - (a.step or 0) for a, b in pairs}) == 1
