r"""Peaks of a figure between the poses of a path: which may be the largest, and how high they are.

::

             x          <- between two poses it is no higher than where the lines through their
           .' '.           outer poses meet
         o       o
       .'         '.
      o             o      o  a pose of the path

The way between two poses that promises most is cut into pieces with poses between them, and these
again, until none promises more than is found. Figures have kinks, for example where a belt begins
to give way at a nosing: lines bound them as well as an arch, a parabola would not.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact

Array = NDArray[np.float64]
Rows = NDArray[np.int64]

AT_ONCE = 4
"""Ways between two poses that are cut together in a group: the most promising first."""
ROUNDS = 8
"""Times that more of them are cut, at most."""
PIECES = 8
"""Pieces into which each is cut."""
NEAR = 0.05
"""Share of a figure by which it may be higher where no line tells [1]."""
ONE_PLACE = 1e-8
"""Distance of poses that stand at one place, where several contacts are exchanged [m]."""
_LEAST = 1e-6
"""Difference of any figure that is none."""
_ALIKE = 9
"""Digits after the point to which two ways are one that repeats itself."""
_FOUR = np.arange(-1, 3)[:, None]


class _Ways(NamedTuple):
    """Ways between two poses, with the poses beside them."""

    row: Rows
    """Row of the path before each."""
    s: Array
    """Pose behind, both ends, pose ahead [m], shape (4, n)."""
    height: Array
    """The figure there, shape (4, n); NaN where the path does not lead on to it."""
    promise: Array
    """How high the figure may be in between."""

    def those(self, some: Rows | NDArray[np.bool_]) -> "_Ways":
        return _Ways(self.row[some], self.s[:, some], self.height[:, some], self.promise[some])

    def and_those(self, others: "_Ways") -> "_Ways":
        return _Ways(
            np.append(self.row, others.row),
            np.hstack([self.s, others.s]),
            np.hstack([self.height, others.height]),
            np.append(self.promise, others.promise),
        )


def leads_on(path: contact.Path) -> NDArray[np.bool_]:
    """Whether the path leads on from each pose to the next along one line of poses."""
    poses = path.poses
    return np.asarray((poses.leg[1:] == poses.leg[:-1]) & (np.diff(poses.s) > ONE_PLACE))


def peaks_between(
    path: contact.Path,
    values: Array,
    group: Rows,
    tolerance: float,
    figure: Callable[[contact.Path], Array],
    *,
    narrow: NDArray[np.bool_] | None = None,
    acceleration: float,
) -> tuple[list[contact.Path], Rows]:
    """Poses between two at which a figure may be the largest of a group of poses.

    Parameters
    ----------
    path : contact.Path
        With margins.
    values : ndarray
        The figure at each pose.
    group : ndarray of int
        Number of the group of each pose; negative: of none.
    tolerance : float
        Share of the largest figure of a group above which is not looked for [1].
    figure : callable
        The figure at the poses of another path.
    narrow : ndarray of bool, optional
        Whether the way from each pose to the next may hide a peak that no line tells of.
    acceleration : float
        Along the path [m/s^2].

    Returns
    -------
    poses, rows
        Some at a time, and the row before each.
    """
    found: list[contact.Path] = []
    rows = [np.empty(0, dtype=np.int64)]
    largest = np.full(int(group.max(initial=-1)) + 1, -np.finfo(np.float64).max)
    np.maximum.at(largest, group[group >= 0], values[group >= 0])
    pool = _ways_of(path, values, group, narrow)
    for _ in range(ROUNDS):
        of = group[pool.row]
        open_ = pool.promise > (largest + _LEAST + tolerance * np.abs(largest))[of]
        pool = _once(pool.those(open_), group)
        if len(pool.row) == 0:
            break
        of = group[pool.row]
        chosen = np.concatenate([np.flatnonzero(of == each)[:AT_ONCE] for each in np.unique(of)])
        cut = pool.those(chosen)
        ends = path.s[cut.row], path.s[cut.row + 1]
        shares = np.linspace(0.0, 1.0, PIECES + 1)[:, None]
        s = cut.s[1] + shares * (cut.s[2] - cut.s[1])
        row = np.tile(cut.row, PIECES - 1)
        there = (s[1:-1] - ends[0]) / (ends[1] - ends[0])
        new = path.between(row, there.ravel(), acceleration=acceleration)
        found.append(new)
        rows.append(row)
        inside = figure(new).reshape(PIECES - 1, -1)
        np.maximum.at(largest, group[cut.row], inside.max(axis=0))
        height = np.vstack([cut.height[:2], inside, cut.height[2:]])
        s = np.vstack([cut.s[:1], s, cut.s[3:]])
        about = (np.arange(PIECES) + 1 + _FOUR).ravel()
        four = s[about].reshape(4, -1), height[about].reshape(4, -1)
        pieces = _Ways(np.tile(cut.row, PIECES), *four, promise(*four))
        pool = pool.those(np.delete(np.arange(len(pool.row)), chosen)).and_those(pieces)
    return found, np.concatenate(rows)


def _ways_of(
    path: contact.Path, values: Array, group: Rows, narrow: NDArray[np.bool_] | None
) -> _Ways:
    """Ways from each pose of a group to the next."""
    on = leads_on(path)
    some = on & (group[:-1] >= 0) & np.isfinite(values[1:]) & np.isfinite(values[:-1])
    row = np.flatnonzero(some)
    about = np.clip(row + _FOUR, 0, len(values) - 1)
    height = values[about]
    on = np.concatenate([[False], on, [False]])
    height[0, ~(on[row] & np.isfinite(height[0]))] = np.nan
    height[3, ~(on[row + 2] & np.isfinite(height[3]))] = np.nan
    s = path.s[about]
    may = promise(s, height)
    if narrow is not None:
        higher = height[1:3].max(axis=0)
        may = np.where(narrow[row], higher + NEAR * np.abs(higher), may)
    return _Ways(row, s, height, may)


def promise(s: Array, height: Array) -> Array:
    """How high a figure may be between the second and the third of four poses.

    Parameters
    ----------
    s, height : ndarray (4, n)
        Places and figures; NaN where the first or the last pose tells nothing.

    Returns
    -------
    ndarray (n,)
        The height where the lines of the first two and of the last two meet, if that is higher than
        both. Without one of these the other line counts, without both `NEAR` above the higher.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        slopes = np.diff(height, axis=0) / np.diff(s, axis=0)
    length = s[2] - s[1]
    rises, falls = np.fmax(slopes[0], slopes[1]), np.fmin(slopes[2], slopes[1])
    from_behind, from_ahead = height[1] + rises * length, height[2] - falls * length
    bends = np.where(rises - falls > 0.0, rises - falls, np.inf)
    meet = height[1] + rises * np.clip((height[2] - height[1] - falls * length) / bends, 0, length)
    before, after = np.isnan(height[0]), np.isnan(height[3])
    higher = height[1:3].max(axis=0)
    meet = np.where(before, from_ahead, np.where(after, from_behind, meet))
    may = np.where(before & after, higher + NEAR * np.abs(higher), meet)
    return np.asarray(np.maximum(higher, may))


def _once(pool: _Ways, group: Rows) -> _Ways:
    """Those that repeat themselves once, the most promising first."""
    kinds = np.vstack([group[pool.row], pool.promise, pool.height[1:3]])
    _, once = np.unique(np.round(kinds, _ALIKE), axis=1, return_index=True)
    once = once[np.argsort(-pool.promise[once], kind="stable")]
    return pool.those(once)
