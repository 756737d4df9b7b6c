"""Side views of a cloud along the headings that stairs may have, each made when it is looked at."""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.kinds import Array, Indices
from kaidan.readers.stairfit.patches import Patches, directions, in_cubes
from kaidan.readers.stairfit.quantiles import quantile

COLUMN = 0.1
"""Width of the columns of a side view in which a floor must be seen [m]."""
PLAN, STOREY, TALL = 0.07, 0.12, 5
"""Side of a square of the plan, height of a level in it [m], and levels that no riser fills."""
FLOOR = 0.03
"""Thickness of the levels in which floors are looked for [m]."""
SWEEP = 10
"""Angle between headings where no plumb patch says which to try [deg]."""


def rotated(xyz: Array, heading: float) -> tuple[Array, Array, Array]:
    """Coordinates along a heading, to the left of it, and up [m]."""
    c, s = math.cos(heading), math.sin(heading)
    return xyz[:, 0] * c + xyz[:, 1] * s, xyz[:, 1] * c - xyz[:, 0] * s, xyz[:, 2]


def headings(patches: Patches) -> list[float]:
    """Axes along which stairs may climb, each within half a circle [rad]."""
    plumb = np.abs(patches.normal[:, 2]) < 0.17
    if plumb.sum() < 8:
        return [math.radians(each) for each in range(0, 180, SWEEP)]
    flat = replace(
        patches,
        normal=_levelled(patches.normal[plumb]),
        weight=patches.weight[plumb],
        middle=patches.middle[plumb],
    )
    axes: list[float] = []
    for each in directions(flat):
        here = math.atan2(each[1], each[0])
        for angle in (here, here + math.pi / 2):
            if all(abs(math.sin(angle - other)) > math.sin(math.radians(6)) for other in axes):
                axes.append(angle)
    return axes[:6]


def _levelled(normals: Array) -> Array:
    flat = normals * np.array([1.0, 1.0, 0.0])
    return np.asarray(flat / np.maximum(np.linalg.norm(flat, axis=1), 1e-12)[:, None])


@dataclass(frozen=True, eq=False)
class View:
    """A thinned cloud along one heading, without what stands up: side walls, people, posts."""

    heading: float
    """[rad]"""
    rows: Indices
    """Of the cloud, shape (m,)."""
    s: Array
    t: Array
    z: Array
    """Of them, shape (m,) [m]."""
    level: NDArray[np.bool_]
    """Whether they lie on a floor, in which no steps are sought, shape (m,)."""

    def of(self, which: NDArray[np.bool_]) -> "View":
        """The same of some rows of the cloud."""
        kept = np.flatnonzero(which[self.rows])
        s, t, z = (each[kept] for each in (self.s, self.t, self.z))
        return View(self.heading, self.rows[kept], s, t, z, self.level[kept])

    def turned(self, by: float) -> "View":
        """The same along another heading."""
        c, sine = math.cos(by), math.sin(by)
        s, t = self.s * c + self.t * sine, self.t * c - self.s * sine
        return View(self.heading + by, self.rows, s, t, self.z, self.level)

    def steps(self) -> tuple[Array, Array]:
        """(s, z) of what lies on no floor."""
        kept = np.flatnonzero(~self.level)
        return self.s[kept], self.z[kept]


@dataclass(eq=False)
class Views:
    """All of them of one cloud."""

    xyz: Array
    """Thinned cloud, z up, shape (n, 3) [m]."""
    patches: Patches
    """Of the cloud, z up."""
    of_point: Indices
    """Patch of each point, -1 without one, shape (n,)."""

    def __post_init__(self) -> None:
        self._made: dict[int, View] = {}

    @cached_property
    def headings(self) -> list[float]:
        """Along which stairs may climb, an axis and that across it in turn [rad]."""
        return headings(self.patches)

    @cached_property
    def _normal(self) -> Array:
        return np.vstack([self.patches.normal[:, :2], np.zeros(2)])[self.of_point]

    @cached_property
    def _low(self) -> NDArray[np.bool_]:
        return ~tall(self.xyz)

    def steps(self, left: NDArray[np.bool_]) -> int:
        """How many of some points are low and lie on no floor of the views that were made."""
        free = left & self._low
        for view in self._made.values():
            free[view.rows[view.level]] = False
        return int(free.sum())

    def along(self, number: int) -> View:
        """View along one of the headings."""
        if number not in self._made:
            axis, normal = self.headings[number], self._normal
            across = np.abs(normal[:, 1] * math.cos(axis) - normal[:, 0] * math.sin(axis))
            # side walls say nothing and cover everything
            rows = np.flatnonzero((across < 0.85) & self._low)
            s, t, z = rotated(self.xyz.T.take(rows, axis=1).T, axis)
            self._made[number] = View(axis, rows, s, t, z, floors(s, z))
        return self._made[number]


def tall(xyz: Array) -> NDArray[np.bool_]:
    """Points of what stands up farther than a riser: walls, people, posts.

    Seen in the plan they are in a small square that holds points in many levels. A handrail above
    a tread, or a ceiling, fills few of them.
    """
    place = np.floor(xyz.T * np.array([[1 / PLAN], [1 / PLAN], [1 / STOREY]]))
    order, begins, counts = in_cubes(place)
    squares = place[:2, order[begins]]
    each = np.flatnonzero(np.r_[True, (squares[:, 1:] != squares[:, :-1]).any(axis=0)])
    levels = np.diff(np.r_[each, len(begins)])
    found = np.empty(len(xyz), dtype=np.bool_)
    found[order] = np.repeat(np.repeat(levels >= TALL, levels), counts)
    return found


def floors(s: Array, z: Array) -> NDArray[np.bool_]:
    """Points in thin levels that hold many more than those about them, and are long."""
    if not len(s):
        return np.zeros(0, dtype=bool)
    level = ((z - z.min()) / FLOOR).astype(np.int64)
    column = ((s - s.min()) / COLUMN).astype(np.int64)
    wide = int(column.max()) + 1
    view = np.bincount(level * wide + column, minlength=(int(level.max()) + 1) * wide)
    view = view.reshape(-1, wide)
    count = view.sum(axis=1)
    beside = np.lib.stride_tricks.sliding_window_view(np.pad(count, 8), 17)
    usual = np.partition(beside, 8, axis=1)[:, 8]
    floor = np.zeros(len(count), dtype=bool)
    for each in np.flatnonzero(count > 2.0 * usual + 10):
        along = view[each]
        floor[each] = (along > 0.3 * quantile(along[along > 0], 0.9)).sum() * COLUMN > 1.0
    floor |= np.r_[floor[1:], False] | np.r_[False, floor[:-1]]
    return np.asarray(floor[level])
