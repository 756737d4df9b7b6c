r"""Two margins in one unit: the tilt of gravity to the first rock, and to the fall.

::

        C           gravity tilted towards the downhill end until its line passes the contact that
       /|\          stays: there the robot rotates. To the first rock it is known at every pose. Of
      / | \         the fall the traverse itself tells, driven once more under tilted gravity:
     o  |  o        whatever the next contact arrests, the robot goes on as it then stands.
        v
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.modes import Phase
from kaidan.traversal.peaks import peaks_between

Array = NDArray[np.float64]

LARGEST = math.radians(30.0)
"""Largest tilt to a fall that is looked for [rad]: stairs are hardly steeper."""
WITHIN = math.radians(0.002)
"""To which the tilt to a fall is found [rad]."""
_FIRST = math.radians(4.0)
_AT_ONCE = 8
_PLACE = 1e-6
"""To which the place is found where a nosing is left [m]."""
_TIE = 1e-9
_WITHIN = 1e-5
"""Share of the least tilt to which it is found between poses [1]."""


class Rock(NamedTuple):
    """Pose at which the least tilt of gravity makes the robot rotate."""

    tilt: float
    """Less what the robot rocks before [rad]; infinite: no pose was looked at."""
    row: int
    """Of the pose."""


class Fall(NamedTuple):
    """Fall under the least tilt of gravity."""

    tilt: float
    """Largest tilt that the robot survives [rad]; infinite beyond `LARGEST`; negative where it
    falls without any, and minus a right angle where that takes more than `LARGEST` off."""
    phase: Phase
    """Part of the traverse in which it falls."""
    step: int
    """Nosing at which, counted from the bottom."""


def first_rock(
    path: contact.Path, rows: NDArray[np.int64], side: float, *, own: int, acceleration: float = 0.0
) -> Rock:
    """Least tilt of gravity at which some poses rotate by more than rocking, to one side.

    Of nosings under a flat those too carry that it only rests on after rocking. While it rests on
    them it is steeper by that much, so the rocking is subtracted; or they do not count. Where the
    flat leaves such a nosing nothing closes or opens, so that no pose may stand there: the place is
    halved out between two. So is the place of a least tilt.

    Parameters
    ----------
    path : contact.Path
        With margins.
    rows : ndarray of int
        Which poses.
    side : {1.0, -1.0}
        Back or front.
    own : int
        Poses at the head of the path that follow one another; the rest lie between two of them.
    acceleration : float
        Along the path [m/s^2].
    """
    if len(rows) == 0:
        return Rock(math.inf, -1)
    tilts = _tilts(path, rows, side)
    along = rows < own
    dips, before = _dips(path, rows[along], tilts.alone[along], side, acceleration)
    if dips:
        between = contact.joined(dips)
        more = _tilts(between, np.arange(len(between.poses)), side)
        tilts = _Tilts(*(np.append(one, two) for one, two in zip(tilts, more, strict=True)))
        rows = np.append(rows, before)
    alone, tilt, rocking = tilts
    lost, row = _lost_between(path, rows[alone < tilt.min()], rows[rows < own], side, acceleration)
    if lost < tilt.min():
        tilt = np.append(tilt, lost)
        alone, rocking = np.append(alone, lost), np.append(rocking, 0.0)
        rows = np.append(rows, row)
    least = float(tilt.min())
    rocked = least - float(rocking[alone < least].max(initial=0.0))
    lowest = float(alone.min())
    if rocked > lowest:
        return Rock(rocked, int(rows[np.flatnonzero(tilt <= least + _TIE)[0]]))
    return Rock(lowest, int(rows[np.flatnonzero(alone <= lowest + _TIE)[0]]))


class _Tilts(NamedTuple):
    """Tilts of gravity at which poses rotate to one side [rad]."""

    alone: Array
    """At all."""
    tilt: Array
    """By more than rocking; infinite where it is not the least."""
    rocking: Array
    """What it rocks before."""


def _tilts(path: contact.Path, rows: NDArray[np.int64], side: float) -> _Tilts:
    alone = path.tilts(rows, side, tolerance=0.0).tilt
    order = np.argsort(alone, kind="stable")
    tilt, rocking = np.full(len(rows), np.inf), np.zeros(len(rows))
    done = 0
    while done < len(order) and alone[order[done]] < tilt.min() - _TIE:
        some = order[done : done + _AT_ONCE]
        done += len(some)
        found = path.tilts(rows[some], side)
        tilt[some], rocking[some] = found.tilt, found.rocking
    return _Tilts(alone, tilt, rocking)


def _dips(
    path: contact.Path, rows: NDArray[np.int64], alone: Array, side: float, acceleration: float
) -> tuple[list[contact.Path], NDArray[np.int64]]:
    """Poses between two at which the tilt may be the least, and the row before each."""
    values = np.full(len(path.poses), -np.inf)
    values[rows] = -alone
    return peaks_between(
        path,
        values,
        np.where(np.isfinite(values), 0, -1),
        _WITHIN,
        lambda between: -between.tilts(np.arange(len(between.poses)), side, tolerance=0.0).tilt,
        acceleration=acceleration,
    )


def _lost_between(
    path: contact.Path,
    rocking: NDArray[np.int64],
    rows: NDArray[np.int64],
    side: float,
    acceleration: float,
) -> Rock:
    """Least tilt as the flat comes to leave, or to reach, a nosing that it would rock onto.

    Parameters
    ----------
    path, side, acceleration
        As for `first_rock`.
    rocking : ndarray of int
        Poses at which some may be rocked onto.
    rows : ndarray of int
        Poses that count, each followed by the next of the path.
    """
    onto = rocking[path.tilts(rocking, side).rocking > 0.0]
    counts, beside = np.zeros((2, len(path.poses) + 1), dtype=np.bool_)
    counts[rows] = True
    beside[onto], beside[np.maximum(onto - 1, 0)] = True, True
    begin = np.flatnonzero(beside[:-1] & counts[:-1] & counts[1:])
    along = (path.poses.leg[begin] == path.poses.leg[begin + 1]) & (
        path.s[begin] < path.s[begin + 1]
    )
    begin = begin[along]
    ends = [path.tilts(begin + k, side).rocking > 0.0 for k in (0, 1)]
    differ = ends[0] != ends[1]
    begin, leaves = begin[differ], ends[0][differ]
    if len(begin) == 0:
        return Rock(math.inf, -1)
    length = path.s[begin + 1] - path.s[begin]
    low, high = np.zeros(len(begin)), np.ones(len(begin))
    while float((length * (high - low)).max()) > _PLACE:
        middle = 0.5 * (low + high)
        there = path.between(begin, middle, acceleration=acceleration)
        rocks = there.tilts(np.arange(len(begin)), side).rocking > 0.0
        first = rocks == leaves
        low, high = np.where(first, middle, low), np.where(first, high, middle)
    beyond = path.between(begin, np.where(leaves, high, low), acceleration=acceleration)
    tilt = beyond.tilts(np.arange(len(begin)), side).tilt
    least = int(np.argmin(tilt))
    return Rock(float(tilt[least]), int(begin[least]))


def largest_survived(
    survives: Callable[[float], bool],
    *,
    sought: Sequence[float] | None = None,
    enough: float = math.inf,
    most: float = LARGEST,
) -> float:
    """Largest tilt that is survived, see `Fall`, to `WITHIN` [rad].

    Parameters
    ----------
    survives : callable
        Whether the robot survives a tilt.
    sought : sequence of float, optional
        Tilts which it may only exceed or not [rad]: a smaller one is found where that says as much
        of each.
    enough : float
        Tilt beyond which one that is survived is as good as any [rad]: a smaller one than the
        largest is found there.
    most : float
        Tilt that is survived only by what no tilt fells [rad].
    """

    def is_open(low: float, high: float) -> bool:
        if low >= enough:
            return False
        return sought is None or any(low <= each < high for each in sought)

    low, high, tilt = 0.0, math.inf, _FIRST
    if survives(0.0):
        while high == math.inf and is_open(low, high):
            if not survives(tilt):
                high = tilt
            elif tilt >= most:
                return math.inf
            else:
                low, tilt = tilt, min(2.0 * tilt, most)
    else:
        low, high = -math.pi / 2, 0.0
        while low == -math.pi / 2 and is_open(low, high):
            if survives(-tilt):
                low = -tilt
            elif tilt >= LARGEST:
                return low
            else:
                high, tilt = -tilt, min(2.0 * tilt, LARGEST)
    while high - low > WITHIN and is_open(low, high):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if survives(middle) else (low, middle)
    return low
