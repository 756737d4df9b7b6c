r"""Whether a belt runs under a robot from end to end of its flat run, and how that is known.

::

      .---.   .---.        Wheels in one plane that lie in one another are no wheels: solid ones
     /  .--\-/--.  \       cannot turn so. They stand for a belt. Wheels that do not, p >= 2 R, let
    (  (    X    )  )      an edge between them: touching its faces, at 45 degrees each, it lies
     \  '--/-\--'  /       p/2 - (sqrt(2) - 1) R above the flat, 0.59 R at least, and no flat
      '---'   '---'        carries the robot there.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from kaidan.readers.robots.gear import Gear
from kaidan.readers.robots.side_view import SideView
from kaidan.readers.robots.silhouette import Piece

Drawn = Literal["wheels", "box"]
_TOUCHING = 1e-6
"""Distance up to which shapes touch [m]: files round to it."""
_AT_THE_RUN = 0.005, 0.02
"""How far from the run what carries it may lie: so many metres, or that share of the run."""
_SIDES = ("left", "right")
_Part = tuple[float, float]


@dataclass(frozen=True)
class Belt:
    """What carries a robot along its flat run, on the side where least of it is a belt."""

    called: bool
    """Whether the file calls or declares a track what lies at both ends of the run."""
    gap: float
    """Length of the longest part of the run that is no belt; 0: all of it is one [m]."""
    middle: float
    """Length of the middle part of the run that holds it [m]."""
    drawn: Drawn
    """What the file draws there."""
    wheels: int
    """Wheels that stand on the run."""
    radius: float
    """Of the largest of them [m]."""

    @property
    def assumed(self) -> Drawn | None:
        """What a file draws in place of a belt, which is then assumed; None: wheels of a track."""
        return None if self.called and self.drawn == "wheels" else self.drawn


class _Standing(NamedTuple):
    """A piece that touches the flat run."""

    first: float
    """Behind the front end of the run [m]."""
    last: float
    radius: float
    """0 of a box [m]."""
    piece: Piece


def belt_of(side: SideView, gear: Gear) -> Belt:
    """Belt under the main tracks of a robot."""
    middle = (max(each.left for each in gear.main) + min(each.right for each in gear.main)) / 2
    called = set(map(id, gear.called))
    sides = (
        _of_one_side(side, [each for each in gear.main if each.left > middle], called),
        _of_one_side(side, [each for each in gear.main if each.right < middle], called),
    )
    return max(sides, key=lambda each: (not each.called, each.gap, each.drawn))


def _of_one_side(side: SideView, pieces: Sequence[Piece], called: set[int]) -> Belt:
    length, near = side.flat_length, max(_AT_THE_RUN[0], _AT_THE_RUN[1] * side.flat_length)
    standing = _standing(side, pieces, near)
    by_word = [each for each in standing if id(each.piece) in called]
    belts = _belts_called(by_word, near)
    is_called = bool(belts) and belts[0][0] <= near and belts[-1][1] >= length - near
    if not is_called:
        belts = _merged([*belts, *_belts_drawn(standing)])
    ends = [0.0, *(end for belt in belts for end in belt), length]
    gaps = [(end, begin) for end, begin in zip(ends[::2], ends[1::2], strict=True)]
    first, last = max(gaps, key=lambda gap: gap[1] - gap[0])
    gap = last - first if last - first > near else 0.0
    radii = [each.radius for each in standing if each.radius]
    return Belt(
        called=is_called,
        gap=gap,
        middle=length - 2 * min(first, length - last) if gap else 0.0,
        drawn="wheels" if radii else "box",
        wheels=len(radii),
        radius=max(radii, default=0.0),
    )


def _standing(side: SideView, pieces: Sequence[Piece], near: float) -> list[_Standing]:
    """Pieces that touch the run, the foremost first."""
    found = []
    for piece in pieces:
        behind, height, radius = side.above(piece.discs).T
        low = abs(height - radius) <= near
        if low.any():
            at = behind[low]
            found.append(
                _Standing(float(at.min()), float(at.max()), float(radius[low].max()), piece)
            )
    return sorted(found, key=lambda each: each.first)


def _belts_called(standing: Sequence[_Standing], near: float) -> list[_Part]:
    """Parts of the run under what the file calls tracks, the foremost first.

    Each link is a belt of its own, unless some of them are single wheels: those have one in common.
    """
    links: dict[str, _Part] = {}
    for each in standing:
        first, last = links.get(each.piece.link, (each.first, each.last))
        links[each.piece.link] = min(first, each.first), max(last, each.last)
    whole = _merged(links.values())
    single = any(last - first <= near for first, last in links.values())
    return [(whole[0][0], whole[-1][1])] if single else whole


def _belts_drawn(standing: Sequence[_Standing]) -> list[_Part]:
    """Parts of the run under boxes, and under wheels that lie in one another."""
    found = [(each.first, each.last) for each in standing]
    first, radius = (np.array([each[k] for each in standing]) for k in (0, 2))
    left, right = (np.array([getattr(each.piece, k) for each in standing]) for k in _SIDES)
    for number, one in enumerate(standing):
        apart = first - one.last
        # circles that touch one line lie in one another up to twice the root of both radii apart
        reach = 2 * np.sqrt(one.radius * radius) if one.radius else radius
        reach = np.where(radius > 0.0, reach, one.radius) + _TOUCHING
        beside = (left > right[number]) & (left[number] > right)
        joined = first[beside & (apart >= 0.0) & (apart <= reach)]
        found.append((one.last, float(joined.max(initial=one.last))))
    return found


def _merged(parts: Iterable[_Part]) -> list[_Part]:
    """Parts of the run without those that overlap, the foremost first."""
    found: list[_Part] = []
    for first, last in sorted(parts):
        if found and first <= found[-1][1] + _TOUCHING:
            found[-1] = found[-1][0], max(found[-1][1], last)
        else:
            found.append((first, last))
    return found
