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

from collections.abc import Callable, Sequence

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
_LEAST = 1e-6
"""Difference of any figure that is none."""
_ALIKE = 9
"""Digits after the point to which two ways are one that repeats itself."""
_FOUR = np.arange(-1, 3)[:, None]
_SHARES = np.linspace(0.0, 1.0, PIECES + 1)[:, None]
_ABOUT = (np.arange(PIECES) + 1 + _FOUR).ravel()
"""Of each piece the place behind, both ends and the place ahead."""


# Ways between two poses, one a column: row of the path before it; place of the pose behind, of both
# ends and of the pose ahead [m]; the figure there, NaN where the path does not lead on to it; how
# high the figure may be in between.
_ROW, _S, _HEIGHT, _PROMISE = 0, slice(1, 5), slice(5, 9), 9


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

    def open_(of: Rows, may: Array) -> NDArray[np.bool_]:
        return np.asarray(may > (largest + _LEAST + tolerance * np.abs(largest))[of])

    pool = _ways_of(path, values, group, narrow, open_)
    for _ in range(ROUNDS):
        of = group[_rows(pool)]
        still = open_(of, pool[_PROMISE])
        pool = _once(pool[:, still], of[still])
        if pool.shape[1] == 0:
            break
        chosen = _first_of_each(group[_rows(pool)])
        cut = pool[:, chosen]
        before, (_, begin, end, _) = _rows(cut), cut[_S]
        ends = path.s[before], path.s[before + 1]
        s = begin + _SHARES * (end - begin)
        row = np.tile(before, PIECES - 1)
        there = (s[1:-1] - ends[0]) / (ends[1] - ends[0])
        new = path.between(row, there.ravel(), acceleration=acceleration)
        found.append(new)
        rows.append(row)
        inside = figure(new).reshape(PIECES - 1, -1)
        np.maximum.at(largest, group[before], inside.max(axis=0))
        height = np.vstack([cut[_HEIGHT][:2], inside, cut[_HEIGHT][2:]])
        s = np.vstack([cut[_S][:1], s, cut[_S][3:]])
        four = s[_ABOUT].reshape(4, -1), height[_ABOUT].reshape(4, -1)
        pieces = _ways(np.tile(before, PIECES), *four, promise(*four))
        pool = np.hstack([np.delete(pool, chosen, axis=1), pieces])
    return found, np.concatenate(rows)


def _ways(row: Rows, s: Array, height: Array, may: Array) -> Array:
    return np.vstack([row[None], s, height, may[None]])


def _rows(ways: Array) -> Rows:
    return np.asarray(ways[_ROW].astype(np.int64))


def _first_of_each(group: Rows) -> Rows:
    """The first `AT_ONCE` of each group."""
    each = [np.flatnonzero(group == one)[:AT_ONCE] for one in sorted({*group.tolist()})]
    return np.concatenate(each)


def _ways_of(
    path: contact.Path,
    values: Array,
    group: Rows,
    narrow: NDArray[np.bool_] | None,
    open_: Callable[[Rows, Array], NDArray[np.bool_]],
) -> Array:
    """Ways from each pose of a group to the next that promise enough."""
    s, finite = path.s, np.isfinite(values)
    told = path.poses.leads_on & finite[1:] & finite[:-1]
    slope = np.full(len(values) + 1, np.nan)
    with np.errstate(invalid="ignore", divide="ignore"):
        np.divide(values[1:] - values[:-1], s[1:] - s[:-1], out=slope[1:-1], where=told)
    row = np.flatnonzero(told & (group[:-1] >= 0))
    before, after = values[row], values[row + 1]
    may = _promise(s[row + 1] - s[row], before, after, (slope[row], slope[row + 1], slope[row + 2]))
    if narrow is not None:
        higher = np.maximum(before, after)
        may = np.where(narrow[row], higher + NEAR * np.abs(higher), may)
    some = open_(group[row], may)
    row, may = row[some], may[some]
    about = np.clip(row + _FOUR, 0, len(values) - 1)
    height = values[about]
    height[0, np.isnan(slope[row])] = np.nan
    height[3, np.isnan(slope[row + 2])] = np.nan
    return _ways(row, s[about], height, may)


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
        slopes = (height[1:] - height[:-1]) / (s[1:] - s[:-1])
    return _promise(s[2] - s[1], height[1], height[2], slopes)


def _promise(length: Array, begin: Array, end: Array, slopes: Sequence[Array] | Array) -> Array:
    """The same of ways so long, the figure at their ends and its slopes before, on and after."""
    rises, falls = np.fmax(slopes[0], slopes[1]), np.fmin(slopes[2], slopes[1])
    from_behind, from_ahead = begin + rises * length, end - falls * length
    bends = np.where(rises - falls > 0.0, rises - falls, np.inf)
    meet = begin + rises * np.clip((end - begin - falls * length) / bends, 0, length)
    before, after = np.isnan(slopes[0]), np.isnan(slopes[2])
    higher = np.maximum(begin, end)
    meet = np.where(before, from_ahead, np.where(after, from_behind, meet))
    may = np.where(before & after, higher + NEAR * np.abs(higher), meet)
    return np.asarray(np.maximum(higher, may))


def _once(pool: Array, group: Rows) -> Array:
    """Those that repeat themselves once, the most promising first."""
    kinds = np.round(np.vstack([group[None], pool[[_PROMISE, 6, 7]]]), _ALIKE)
    order = np.lexsort(kinds[::-1])
    ordered = kinds[:, order]
    new = np.ones(len(order), dtype=np.bool_)
    new[1:] = (ordered[:, 1:] != ordered[:, :-1]).any(axis=0)
    once = order[new]
    return pool[:, once[np.argsort(-pool[_PROMISE, once], kind="stable")]]
