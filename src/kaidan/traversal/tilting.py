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
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.modes import Phase
from kaidan.traversal.peaks import peaks_between

Array = NDArray[np.float64]
Rows = NDArray[np.int64]

LARGEST = math.radians(30.0)
"""Largest tilt to a fall that is looked for [rad]: stairs are hardly steeper."""
WITHIN = math.radians(0.002)
"""To which the tilt to a fall is found [rad]."""
_FIRST = math.radians(4.0)
_AT_ONCE = 8
_PLACE = 1e-6
"""To which the place is found where a nosing is left [m]."""
_JUMP = 0.25
"""Share of the rocking between two poses by which it jumps from nosing to nosing [1]."""
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
    path: contact.Path,
    rows: Rows,
    side: float,
    *,
    own: int,
    acceleration: float = 0.0,
    whence: Array | None = None,
) -> Rock:
    """Least tilt of gravity at which some poses rotate by more than rocking, to one side.

    Of nosings under a flat those too carry that it only rests on after rocking. Where the flat
    leaves such a nosing nothing closes or opens, so that no pose may stand there: the place is
    halved out between two. So is the place of a least tilt. Left, the nosing leaves the robot
    steeper by what it rocked, which is subtracted there, down to a tilt at which it rocks nowhere.

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
    whence : ndarray, optional
        Inclination from which each pose of the path came down by rocking [rad]: gravity tilted back
        returns it there, and that is rocking too. Minus infinity: from none.
    """
    if len(rows) == 0:
        return Rock(math.inf, -1)
    if whence is None:
        whence = np.full(len(path.poses), -np.inf)
    tilted = _Tilted(path, side, acceleration, whence)
    tilts = tilted.tilts(rows)
    along = rows < own
    dips, before = tilted.dips(rows[along], tilts.alone[along])
    if dips:
        more = tilted.at(contact.joined(dips), before)
        tilts = _Tilts(*(np.append(one, two) for one, two in zip(tilts, more, strict=True)))
        rows = np.append(rows, before)
    alone, tilt = tilts
    least = float(tilt.min())
    near = rows[alone < least + tilted.reach(rows)]
    lost, row = tilted.lost_between(near, rows[rows < own], least, float(alone.min()))
    if lost < least - _TIE:
        return Rock(lost, row)
    return Rock(least, int(rows[np.flatnonzero(tilt <= least + _TIE)[0]]))


class _Tilts(NamedTuple):
    """Tilts of gravity at which poses rotate to one side [rad]."""

    alone: Array
    """At all."""
    tilt: Array
    """By more than rocking; infinite where it is not the least."""


@dataclass(frozen=True)
class _Tilted:
    """Poses of a path under gravity that is tilted to one side; see `first_rock`."""

    path: contact.Path
    side: float
    acceleration: float
    whence: Array

    def reach(self, rows: Rows) -> Array:
        """Rotation of some poses that is rocking [rad]."""
        return _reach(self.whence[rows], self.path.poses.inclination[rows])

    def tilts(self, rows: Rows) -> _Tilts:
        """Of some poses."""
        return _least_tilts(self.path, rows, self.side, self.reach(rows))

    def at(self, between: contact.Path, before: Rows) -> _Tilts:
        """Of poses between two, each with the row before it."""
        reach = _reach(self.whence[before], between.poses.inclination)
        return _least_tilts(between, np.arange(len(before)), self.side, reach)

    def dips(self, rows: Rows, alone: Array) -> tuple[list[contact.Path], Rows]:
        """Poses between two at which the tilt may be the least, and the row before each."""
        values = np.full(len(self.path.poses), -np.inf)
        values[rows] = -alone
        return peaks_between(
            self.path,
            values,
            np.where(np.isfinite(values), 0, -1),
            _WITHIN,
            lambda between: (
                -between.tilts(np.arange(len(between.poses)), self.side, tolerance=0.0).tilt
            ),
            acceleration=self.acceleration,
        )

    def lost_between(self, rocking: Rows, rows: Rows, least: float, lowest: float) -> Rock:
        """Least tilt as the flat comes to leave, or to reach, a nosing that it would rock onto.

        Parameters
        ----------
        rocking : ndarray of int
            Poses at which some may be rocked onto.
        rows : ndarray of int
            Poses that count, each followed by the next of the path.
        least : float
            Tilt of any pose [rad]: a place is looked for where it may be less.
        lowest : float
            Tilt below which the robot has rocked nowhere [rad].
        """
        path = self.path
        onto = rocking[self._carried(rocking, 0)[0] > 0.0]
        if len(onto) == 0:
            return Rock(math.inf, -1)
        counts, beside = np.zeros((2, len(path.poses) + 1), dtype=np.bool_)
        counts[rows] = True
        beside[onto], beside[np.maximum(onto - 1, 0)] = True, True
        begin = np.flatnonzero(beside[:-1] & counts[:-1] & counts[1:])
        along = (path.poses.leg[begin] == path.poses.leg[begin + 1]) & (
            path.s[begin] < path.s[begin + 1]
        )
        begin = begin[along]
        before, after = (self._carried(begin, k) for k in (0, 1))
        steeper, differ = np.abs(after - before)
        may = np.minimum(before, after)[1] - steeper < least + contact.ROCKING
        may &= np.maximum(steeper, differ) > _TIE
        begin, before, after = begin[may], before[:, may], after[:, may]
        if len(begin) == 0:
            return Rock(math.inf, -1)
        # from one nosing to the next the rocking jumps; or if hardly, the tilt
        of_tilt = steeper[may] <= _JUMP * np.maximum(before, after)[0]
        by = of_tilt.astype(np.int64), np.arange(len(begin))
        low, high = path.tilt_jumps(
            begin,
            self.side,
            self.whence[begin],
            of_tilt,
            0.5 * (before + after)[by],
            before[by] > after[by],
            _PLACE,
            acceleration=self.acceleration,
        )
        (rocked, one), (rocks, other) = (
            self._carried_between(begin, share) for share in (low, high)
        )
        left = np.maximum(other - np.maximum(rocked - rocks, 0.0), lowest)
        tilt = np.minimum(one, np.minimum(other, left))
        at = int(np.argmin(tilt))
        return Rock(float(tilt[at]), int(begin[at]))

    def _carried(self, rows: Rows, further: int) -> Array:
        """Shape (2, k): rocking of some poses, or as many rows further, and the tilt after it."""
        reach = _reach(self.whence[rows], self.path.poses.inclination[rows + further])
        found = self.path.tilts(rows + further, self.side, reach)
        return np.stack([found.rocking, found.tilt])

    def _carried_between(self, begin: Rows, share: Array) -> Array:
        """Shape (2, k): the same between poses and the next ones."""
        there = self.path.between(begin, share, acceleration=self.acceleration)
        reach = _reach(self.whence[begin], there.poses.inclination)
        found = there.tilts(np.arange(len(begin)), self.side, reach)
        return np.stack([found.rocking, found.tilt])


def _reach(whence: Array, inclination: Array) -> Array:
    return np.maximum(whence - inclination, 0.0) + contact.ROCKING


def _least_tilts(path: contact.Path, rows: Rows, side: float, reach: Array) -> _Tilts:
    """Only those that rotate at all before any by more than rocking are looked at for more."""
    alone = path.tilts(rows, side, tolerance=0.0).tilt
    order = np.argsort(alone, kind="stable")
    tilt = np.full(len(rows), np.inf)
    done = 0
    while done < len(order) and alone[order[done]] < tilt.min() - _TIE:
        some = order[done : done + _AT_ONCE]
        done += len(some)
        tilt[some] = path.tilts(rows[some], side, reach[some]).tilt
    return _Tilts(alone, tilt)


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
