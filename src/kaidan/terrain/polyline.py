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
"""Height of bumps and dents that make no nosing [m]: five times the noise of a scan of 3 mm, less
than the lowest riser of a uniform flight, 20 mm. They are driven over all the same."""
MOST_PAIRS = 10_000_000
"""Pairs of segments that are checked for crossings: about a second's work."""
LARGEST_EXTENT = 1e4
"""Largest coordinate taken for metres [m]."""


def measured_line(points: ArrayLike) -> Array:
    """Points of a line that leads ahead, shape (n, 2) [m], without repeated ones.

    Raises
    ------
    InputError
        Not (n, 2) finite numbers of metres, or fewer than two different points.
    """
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
    """Corners between a part steeper than 45 degrees and one less steep, and roughness.

    Returns
    -------
    rising, falling, roughness
        Rows of the points at the upper end of a steep part that rises, and of one that falls;
        largest distance of a point from the coarser line [m].
    """
    kept, roughness = _coarser(points, ROUGHNESS)
    steps = np.diff(points[kept], axis=0)
    steep = np.abs(np.arctan2(steps[:, 1], steps[:, 0])) > STEEP
    up = steps[:, 1] > 0
    rising = np.flatnonzero(steep[:-1] & up[:-1] & ~steep[1:]) + 1
    falling = np.flatnonzero(~steep[:-1] & steep[1:] & ~up[1:]) + 1
    return kept[rising], kept[falling], roughness


def _coarser(points: Array, tolerance: float) -> tuple[NDArray[np.int64], float]:
    """Points of a coarser line, and how far from it the others are (Douglas & Peucker 1973)."""
    last = len(points) - 1
    kept, spans, left = [0, last], [(0, last)], 0.0
    while spans:
        begin, end = spans.pop()
        if end - begin < 2:
            continue
        away, chord = points[begin + 1 : end] - points[begin], points[end] - points[begin]
        along = np.clip(away @ chord / max(float(chord @ chord), 1e-300), 0.0, 1.0)
        apart = np.hypot(*(away - along[:, None] * chord).T)
        farthest = int(np.argmax(apart))
        if apart[farthest] > tolerance:
            middle = begin + 1 + farthest
            kept.append(middle)
            spans += [(begin, middle), (middle, end)]
        else:
            left = max(left, float(apart[farthest]))
    return np.unique(kept), left


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
