"""Lines as they were measured: their upper envelope, and the corners that are nosings."""

import math
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kaidan.errors import InputError

Array = NDArray[np.float64]

STEEP = math.radians(45.0)
"""Slope from which a part of the terrain is a riser and no tread [rad]: stairs have risers near
90 degrees and treads near 0, and no code allows a flight steeper than 70 degrees."""
ROUGHNESS = 15e-3
"""Prominence of bumps and dents that make no nosing [m]: less than the lowest riser of a uniform
flight, 20 mm, and what a scan with a noise of 3 mm and a point every centimetre does not reach.
They are driven over all the same."""
_ROUNDING = 1e-9
"""Length that is rounding [m]."""
MOST_PAIRS = 10_000_000
"""Pairs of segments that are checked for crossings: about a second's work."""
LARGEST_EXTENT = 1e4
"""Largest coordinate taken for metres [m]."""


def measured_line(points: ArrayLike) -> Array:
    """Points of a line that leads ahead, shape (n, 2) [m], without repeated ones."""
    try:
        line = np.array(points, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError("profile: points must be numbers, shape (n, 2)") from None
    if line.ndim != 2 or line.shape[1] != 2:
        raise InputError(f"profile: points have shape {line.shape}, not (n, 2)")
    if not np.isfinite(line).all():
        row = int(np.flatnonzero(~np.isfinite(line).all(axis=1))[0])
        raise InputError(
            f"profile: point {row + 1} is {line[row].tolist()}, not two finite numbers"
        )
    if len(line) and np.abs(line).max() > LARGEST_EXTENT:
        worst = float(line.flat[int(np.abs(line).argmax())])
        raise InputError(
            f"profile: {worst:g} m is not within -{LARGEST_EXTENT:g} to {LARGEST_EXTENT:g} m "
            "(in millimetres?)"
        )
    line = line[np.r_[True, (np.diff(line, axis=0) != 0).any(axis=1)]] if len(line) else line
    if len(line) < 2 or not line[-1, 0] > line[0, 0]:
        raise InputError("profile: needs at least two different points that lead ahead in x")
    return line


def convex_corners(points: Array) -> tuple[NDArray[np.int64], NDArray[np.int64], float]:
    """Corners that stand out by more than `ROUGHNESS`, and the largest bump or dent that does not.

    ::

                o_________     o  peak of z - x: the line leads up to it steeper than
                |                 45 degrees, and on from it less steep
        ________|

    A corner that rises is a peak of ``z - x`` along the line, one that falls a peak of ``z + x``.
    Its prominence is how far it stands above the higher of the two lowest places that lie between
    it and higher ones, or the ends of the line, on either side. So it depends on the line alone,
    not on where points lie on it, and moving all points by d changes it by 2 sqrt(2) d at most.

    Rows of the points at the upper end of a steep part that rises, and of one that falls; largest
    prominence of peaks and dents of z, z - x and z + x that are up to `ROUGHNESS` [m].
    """
    x, z = points.T
    rising, climbing = _peaks(z - x)
    falling, descending = _peaks((z + x)[::-1])
    return rising, (len(x) - 1 - falling)[::-1], max(climbing, descending, _peaks(z)[1])


def _peaks(u: Array) -> tuple[NDArray[np.int64], float]:
    """Rows of the peaks more prominent than `ROUGHNESS`, and the largest prominence below it.

    Pairs of turning points are taken out, the inner ones first (rainflow counting, Matsuishi &
    Endo 1968), until those that are left are farther apart.
    """
    rows = np.r_[0, np.flatnonzero(np.diff(u)) + 1]
    rises = np.diff(u[rows]) > 0
    turns = rows[np.r_[0, np.flatnonzero(rises[1:] != rises[:-1]) + 1, -1]]
    left: list[int] = []
    heights: list[float] = []
    ignored = 0.0
    for row, height in zip(turns.tolist(), u[turns].tolist(), strict=True):
        left.append(row)
        heights.append(height)
        while len(left) > 3:
            apart = abs(heights[-2] - heights[-3])
            outer = min(abs(heights[-1] - heights[-2]), abs(heights[-3] - heights[-4]))
            if apart > min(outer, ROUGHNESS + _ROUNDING):
                break
            ignored = max(ignored, apart)
            del left[-3:-1], heights[-3:-1]
    ways = np.diff(heights)
    small = np.sort(np.abs(ways))[:-1]  # the largest is the height of the whole line
    ignored = max(ignored, float(small[small <= ROUGHNESS + _ROUNDING].max(initial=0.0)))
    high = np.flatnonzero(np.minimum(ways[:-1], -ways[1:]) > ROUGHNESS + _ROUNDING) + 1
    # the first point of a flat top
    found = [left[k] for k in high]
    for k, row in enumerate(found):
        while u[row - 1] > u[found[k]] - _ROUNDING:
            row -= 1
        found[k] = row
    return np.array(found, dtype=np.int64), ignored


def upper_envelope(line: Array) -> tuple[Array, bool]:
    """Highest point over each x of a line that may hang over itself, and whether it does."""
    back = np.flatnonzero(np.diff(line[:, 0]) < 0)
    if len(back) == 0:
        return line, False
    farthest = np.maximum.accumulate(line[:, 0])
    # from the last point before the deepest one behind, to where the line leads ahead for good
    begins = np.searchsorted(farthest, line[back + 1, 0], side="left") - 1
    ends = np.searchsorted(farthest, farthest[back], side="right")
    begins, ends = np.maximum(begins, 0), np.minimum(ends, len(line) - 1)
    pieces, done, pairs = [], 0, 0
    for begin, end in _merged(begins, ends):
        pairs += (end - begin) ** 2
        if pairs > MOST_PAIRS:
            raise InputError(
                f"profile: it runs back on itself over too many points (from x = "
                f"{line[begin, 0]:g} m on) to be checked for crossings; smooth or thin it"
            )
        pieces += [line[done:begin], _window_envelope(line[begin : end + 1])]
        done = end + 1
    return np.concatenate([*pieces, line[done:]]), True


def _merged(begins: NDArray[np.int64], ends: NDArray[np.int64]) -> list[tuple[int, int]]:
    """Ranges of rows without those that overlap or touch, in order."""
    found: list[tuple[int, int]] = []
    for begin, end in sorted(zip(begins.tolist(), ends.tolist(), strict=True)):
        if found and begin <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], end))
        else:
            found.append((begin, end))
    return found


def _window_envelope(line: Array) -> Array:
    """Envelope of a short piece, segment against segment."""
    a, b = line[:-1], line[1:]
    _refuse_crossings(a, b)
    places = np.unique(line[:, 0])
    result = [(float(places[0]), float(line[line[:, 0] == places[0], 1].max()))]
    left, right = np.minimum(a[:, 0], b[:, 0]), np.maximum(a[:, 0], b[:, 0])
    for x0, x1 in pairwise(places):
        over = (left <= x0) & (right >= x1)
        heights = [
            a[over, 1] + (b[over, 1] - a[over, 1]) * (x - a[over, 0]) / (b[over, 0] - a[over, 0])
            for x in (x0, x1)
        ]
        top = int(np.argmax(heights[0] + heights[1]))
        result += [(float(x0), float(heights[0][top])), (float(x1), float(heights[1][top]))]
    result.append((float(places[-1]), float(line[line[:, 0] == places[-1], 1].max())))
    kept = [result[0]]
    for point in result[1:]:
        if math.dist(point, kept[-1]) > 1e-12:
            kept.append(point)
    return np.array(kept)


def _refuse_crossings(a: Array, b: Array) -> None:
    def side(p: Array, q: Array, r: Array) -> Array:
        ahead = q - p
        return np.asarray(
            ahead[..., 0] * (r[..., 1] - p[..., 1]) - ahead[..., 1] * (r[..., 0] - p[..., 0])
        )

    a1, b1, a2, b2 = a[:, None], b[:, None], a[None], b[None]
    crossing = (side(a1, b1, a2) * side(a1, b1, b2) < 0) & (side(a2, b2, a1) * side(a2, b2, b1) < 0)
    if crossing.any():
        i, _ = np.argwhere(crossing)[0]
        x, z = a[i]
        raise InputError(f"profile: the line crosses itself near x = {x:g} m, z = {z:g} m")


def frozen(array: Array) -> Array:
    """Array that cannot be written to."""
    array = np.ascontiguousarray(array, dtype=np.float64)
    array.flags.writeable = False
    return array
