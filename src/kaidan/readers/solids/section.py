"""Nosings of a straight flight, exactly: outlines of its treads cut along lines, and one section.

::

      z |            .--------   tread: the outline's front edge, at the level of the surface
        |        (---'           a rounded nosing reaches further out than the level surface
        |        |  <- overhang
        |   .----'
        +-------------- s
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.solids.levels import Plate
from kaidan.readers.solids.rays import Triangles

Array = NDArray[np.float64]

INSET = 0.03
"""Distance of the ends of a nosing from the sides of the narrowest tread [m]."""
NOSE = 0.04
"""Height of what counts as the nosing, below its tread [m]."""
REACHING = 0.06
"""Distance by which a nosing may reach beyond its level surface [m]."""
FALL = 0.012
"""Largest height by which a tread falls towards its nosing [m]."""
SEEN = 1e-3
"""Least overhang [m]."""


class Frame(NamedTuple):
    """Plan frame of a flight: s along the ascent, t to the left of it."""

    origin: Array
    heading: float

    def of(self, points: Array) -> Array:
        """(s, t) of points x, y, shape (n, 2)."""
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        x, y = (points - self.origin).T
        return np.column_stack([x * cos + y * sin, y * cos - x * sin])

    def back(self, s: float, t: float) -> Array:
        """Point x, y."""
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        return np.asarray(self.origin + np.array([s * cos - t * sin, s * sin + t * cos]))


@dataclass(frozen=True, eq=False)
class Section:
    """Nosings of a flight."""

    frame: Frame
    lane: tuple[float, float]
    """Right and left side of what all treads cover, t [m]."""
    left: Array
    """s of the nosings near the left side, shape (m,) [m]."""
    right: Array
    """The same near the right side [m]."""
    levels: Array
    """Heights of the nosings, shape (m,) [m]."""
    overhang: float
    """Largest overhang of a nosing over what is below it [m]."""
    open_risers: bool
    """Whether one of the risers is open."""
    rounding: float
    """Distance by which the nosings reach beyond their level surfaces [m]."""


def section_of(
    plates: list[Plate], heading: float, solids: Triangles, *, complete: bool
) -> Section | None:
    """Nosings of a flight; None where no lane runs over all of its treads.

    heading: of the ascent [rad].
    """
    treads = plates[:-1] if complete and len(plates) > 1 else plates
    frame = Frame(plates[0].middle, heading)
    sides = np.array(
        [(t.min(), t.max()) for t in (frame.of(each.corners)[:, 1] for each in treads)]
    )
    low, high = float(sides[:, 0].max()), float(sides[:, 1].min())
    if high - low < 4 * INSET:
        return None
    sides_of = [
        np.vstack([frame.of(each.sides[:, :2]).T, frame.of(each.sides[:, 2:]).T]) for each in plates
    ]
    lines = {}
    for name, t in (("left", high - INSET), ("right", low + INSET), ("middle", (low + high) / 2)):
        lines[name] = _front_edges(sides_of, t)
    levels = np.array([each.level for each in plates])
    segments = cut(solids, frame, (low + high) / 2)
    levels = _at_nosings(segments, lines["middle"], levels)
    reach, overhang, is_open = _noses(segments, lines["middle"], levels)
    return Section(
        frame=frame,
        lane=(low, high),
        left=lines["left"] - reach,
        right=lines["right"] - reach,
        levels=levels,
        overhang=overhang,
        open_risers=is_open,
        rounding=float(reach.max(initial=0.0)),
    )


def _front_edges(sides: list[Array], t: float) -> Array:
    """Where each surface begins along a line: nearest to where the one below it ends."""
    found: list[float] = []
    end = math.nan
    for each in sides:
        s = _crossings(each, t)
        if len(s) == 0:
            return np.full(len(sides), np.nan)
        found.append(float(s.min() if math.isnan(end) else s[np.argmin(np.abs(s - end))]))
        end = float(s.max())
    return np.array(found)


def _crossings(sides: Array, t: float) -> Array:
    """Where sides of a surface cross a line along the flight, s [m]."""
    s_a, t_a, s_b, t_b = sides
    cut = (t_a - t) * (t_b - t) < 0
    s_a, t_a, s_b, t_b = s_a[cut], t_a[cut], s_b[cut], t_b[cut]
    return np.asarray(s_a + (t - t_a) * (s_b - s_a) / (t_b - t_a))


def cut(solids: Triangles, frame: Frame, t: float) -> Array:
    """Section of solids along a line, shape (n, 4): s, z of one end and of the other [m]."""
    flat = frame.of(solids.corners[:, :, :2].reshape(-1, 2)).reshape(-1, 3, 2)
    off = flat[:, :, 1] - t
    off = np.where(np.abs(off) < 1e-9, 1e-9, off)  # a corner on the line counts to its left
    crossed = (off.max(axis=1) > 0) & (off.min(axis=1) < 0)
    flat, off, z = flat[crossed], off[crossed], solids.corners[crossed, :, 2]
    ends = []
    for k in range(3):
        j = (k + 1) % 3
        share = off[:, k] / np.where(off[:, k] == off[:, j], 1.0, off[:, k] - off[:, j])
        valid = off[:, k] * off[:, j] < 0
        point = np.column_stack(
            [
                flat[:, k, 0] + share * (flat[:, j, 0] - flat[:, k, 0]),
                z[:, k] + share * (z[:, j] - z[:, k]),
            ]
        )
        ends.append(np.where(valid[:, None], point, np.nan))
    stacked = np.stack(ends, axis=1)
    order = np.argsort(np.isnan(stacked[:, :, 0]), axis=1, kind="stable")
    two = np.take_along_axis(stacked, order[:, :2, None], axis=1)
    return np.asarray(two.reshape(-1, 4))


def _least(segments: Array, low: Array, high: Array) -> Array:
    """Least s of segments within ranges of z, shape (m, n); infinite where one is outside."""
    s0, z0, s1, z1 = segments.T
    low, high = low[:, None], high[:, None]
    level = np.abs(z1 - z0) < 1e-9
    rise = np.where(level, 1.0, z1 - z0)
    a, b = (np.clip((each - z0) / rise, 0.0, 1.0) for each in (low, high))
    a, b = np.where(level, 0.0, a), np.where(level, 1.0, b)
    inside = np.where(
        level, (z0 >= low) & (z0 <= high), (np.maximum(z0, z1) > low) & (np.minimum(z0, z1) < high)
    )
    return np.where(inside, s0 + np.minimum(a * (s1 - s0), b * (s1 - s0)), np.inf)


def _at_nosings(segments: Array, fronts: Array, levels: Array) -> Array:
    """Heights of the surfaces at their front edges: a tread may fall towards it."""
    ends = segments.reshape(-1, 2)
    found = levels.copy()
    for k, (s, z) in enumerate(zip(fronts, levels, strict=True)):
        at = ends[(np.abs(ends[:, 0] - s) < 1e-3) & (np.abs(ends[:, 1] - z) < FALL), 1]
        if len(at):
            found[k] = at.max()
    return found


def _noses(segments: Array, fronts: Array, levels: Array) -> tuple[Array, float, bool]:
    """How far each nosing reaches beyond its surface; the largest overhang; open risers."""
    going = float(np.diff(fronts).mean()) if len(fronts) > 1 else 0.25
    s = _least(segments, levels - NOSE, levels - 1e-6)
    near = _first(s, fronts - REACHING, fronts + 1e-6)
    reach = np.where(np.isfinite(near), np.maximum(fronts - near, 0.0), 0.0)
    tip = (fronts - reach)[1:]
    low = levels[:-1] + 0.02
    face = _least(segments, low, np.maximum(levels[1:] - NOSE - 0.02, low + 1e-3))
    face = _first(face, tip - SEEN, tip + 0.9 * going)
    seen = np.isfinite(face)
    overhang = float((face - tip)[seen].max(initial=0.0))
    return reach, overhang if overhang > SEEN else 0.0, not seen.all()


def _first(s: Array, low: Array, high: Array) -> Array:
    """Least s of each row between two bounds; infinite: there is none."""
    between = (s > low[:, None]) & (s < high[:, None])
    return np.asarray(np.where(between, s, np.inf).min(axis=1, initial=np.inf))
