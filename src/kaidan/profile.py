"""The terrain along the robot's path: a 2-D polyline, faces of risers included.

From any `Stairs`, from several flights with landings between them, or from points that somebody
measured. What overhangs (nosings, scans) is replaced by its upper envelope and flagged: a track
rests on what it meets from above.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kaidan.errors import InputError
from kaidan.stairs import Stairs

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


class Profile(NamedTuple):
    """Terrain from the lower to the upper landing; frozen, complete, checked.

    Build it with `of_stairs`, `of_flights` or `of_points`.
    """

    points: Array
    """Upper envelope, shape (n, 2): x ahead (up the stairs), z up [m]; x never decreases."""
    nosings: Array
    """Nosings from bottom to top, shape (m, 2) [m]."""
    overhangs: bool
    """Whether the terrain hung over itself and was replaced by its envelope."""
    open_risers: bool
    """Whether risers are open, so that their faces stand here but carry nothing."""
    roughness: float = 0.0
    """Largest distance of a point from the coarser line on which the nosings were found [m]."""

    @classmethod
    def of_stairs(cls, stairs: Stairs) -> Self:
        """Profile of a flight with its landings."""
        return cls.of_flights([stairs])

    @classmethod
    def of_flights(cls, flights: Sequence[Stairs]) -> Self:
        """Profile of several straight flights in a row.

        Parameters
        ----------
        flights : sequence of Stairs
            From bottom to top. Between two flights lies the upper landing of the lower one.

        Returns
        -------
        Profile
            The first nosing of the first flight stands at x = 0, its lower landing at z = 0.

        Raises
        ------
        InputError
            No flight.
        """
        if not flights:
            raise InputError("profile: no flight of stairs was given")
        x = z = 0.0
        points = [(-max(flights[0].lower_landing, 1e-3), 0.0), (0.0, 0.0)]
        nosings = []
        for flight in flights:
            treads = (*flight.step_goings, max(flight.upper_landing, 1e-3))
            for rise, tread in zip(flight.step_rises, treads, strict=True):
                z += rise
                nosings.append((x, z))
                points.append((x, z))
                x += tread
                points.append((x, z))
        return cls(
            points=_frozen(np.array(points)),
            nosings=_frozen(np.array(nosings)),
            overhangs=any(flight.nosing_overhang > 0 for flight in flights),
            open_risers=any(flight.open_risers for flight in flights),
        )

    @classmethod
    def of_points(cls, points: ArrayLike) -> Self:
        """Profile through measured points.

        Parameters
        ----------
        points : array, shape (n, 2)
            x ahead and z up [m], in order along the surface from the lower to the upper end.

        Returns
        -------
        Profile
            Nosings are the convex corners between a part steeper than 45 degrees and one less
            steep, but for a roughness of 15 mm. Repeated points are dropped.

        Raises
        ------
        InputError
            Not (n, 2) finite numbers of metres, fewer than two different points, or a line that
            crosses itself.
        """
        try:
            line = np.array(points, dtype=np.float64)
        except (TypeError, ValueError):
            raise InputError("profile: points must be numbers, shape (n, 2)") from None
        if line.ndim != 2 or line.shape[1] != 2:
            raise InputError(f"profile: points have shape {line.shape}, not (n, 2)")
        if not np.isfinite(line).all():
            row = int(np.flatnonzero(~np.isfinite(line).all(axis=1))[0])
            raise InputError(
                f"profile: point {row} is {line[row].tolist()}, not two finite numbers"
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
        envelope, overhangs = _upper_envelope(line)
        nosings, roughness = _convex_corners(envelope)
        return cls(
            points=_frozen(envelope),
            nosings=_frozen(nosings),
            overhangs=overhangs,
            open_risers=False,
            roughness=roughness,
        )

    @property
    def spacings(self) -> Array:
        """Distances from nosing to nosing [m], one fewer than the nosings."""
        apart = np.diff(self.nosings, axis=0)
        return np.asarray(np.hypot(apart[:, 0], apart[:, 1]))

    @property
    def nosing_spacing(self) -> float:
        """Mean distance from nosing to nosing [m]; NaN with fewer than two."""
        return float(self.spacings.mean()) if len(self.nosings) > 1 else math.nan

    @property
    def angle(self) -> float:
        """Slope of the line fitted to the nosings [rad]; NaN with fewer than two."""
        if len(self.nosings) < 2:
            return math.nan
        x, z = (self.nosings - self.nosings.mean(axis=0)).T
        return math.atan2(float(x @ z), float(x @ x))

    @property
    def irregularity(self) -> float:
        """Largest distance of a nosing from the line fitted to them, across it [m]."""
        if len(self.nosings) < 2:
            return math.nan
        x, z = (self.nosings - self.nosings.mean(axis=0)).T
        return float(np.abs(z * math.cos(self.angle) - x * math.sin(self.angle)).max())

    @property
    def landings(self) -> tuple[float, float]:
        """Lengths before the first nosing and behind the last one [m]; without nosings, of all."""
        first, last = float(self.points[0, 0]), float(self.points[-1, 0])
        if len(self.nosings) == 0:
            return last - first, last - first
        return float(self.nosings[0, 0]) - first, last - float(self.nosings[-1, 0])

    def reflected(self) -> Self:
        """Profile seen from the other side: x reversed."""
        mirror = np.array([-1.0, 1.0])
        return self._replace(
            points=_frozen(self.points[::-1] * mirror), nosings=_frozen(self.nosings[::-1] * mirror)
        )

    def step_of(self, x: float) -> int:
        """Number of the last nosing at or behind x, counted from 1 at the bottom; 0 before it."""
        return int(np.searchsorted(self.nosings[:, 0], x + 1e-9, side="right"))


def _frozen(array: Array) -> Array:
    array = np.ascontiguousarray(array, dtype=np.float64)
    array.flags.writeable = False
    return array


def _convex_corners(points: Array) -> tuple[Array, float]:
    """Convex corners between a part steeper than 45 degrees and one less steep, and roughness."""
    kept, roughness = _coarser(points, ROUGHNESS)
    line = points[kept]
    steps = np.diff(line, axis=0)
    steep = np.abs(np.arctan2(steps[:, 1], steps[:, 0])) > STEEP
    rising = steps[:, 1] > 0
    corner = np.flatnonzero(steep[:-1] & rising[:-1] & ~steep[1:]) + 1
    return line[corner], roughness


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


def _upper_envelope(line: Array) -> tuple[Array, bool]:
    """Highest point over each x of a line that may hang over itself, and whether it does."""
    back = np.flatnonzero(np.diff(line[:, 0]) < 0)
    if len(back) == 0:
        return line, False
    farthest = np.maximum.accumulate(line[:, 0])
    # from the last point before the deepest one behind, to where the line leads ahead for good
    begins = np.searchsorted(farthest, line[back + 1, 0], side="left") - 1
    ends = np.searchsorted(farthest, farthest[back], side="right")
    begins, ends = np.maximum(begins, 0), np.minimum(ends, len(line) - 1)
    pieces, done = [], 0
    at, pairs = 0, 0
    while at < len(back):
        begin, end = int(begins[at]), int(ends[at])
        while at + 1 < len(back) and begins[at + 1] <= end:
            at += 1
            begin, end = min(begin, int(begins[at])), max(end, int(ends[at]))
        pairs += (end - begin) ** 2
        if pairs > MOST_PAIRS:
            raise InputError(
                f"profile: it runs back on itself over too many points (from x = "
                f"{line[begin, 0]:g} m on) to be checked for crossings; smooth or thin it"
            )
        pieces += [line[done:begin], _window_envelope(line[begin : end + 1])]
        done = end + 1
        at += 1
    return np.concatenate([*pieces, line[done:]]), True


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
