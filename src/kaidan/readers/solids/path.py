"""The way up a flight: its nosings as a line in a lane, and the floors at both ends."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.solids.section import INSET, Frame

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Path:
    """Nosings and floors of a flight in its frame."""

    frame: Frame
    lane: tuple[float, float]
    """Right and left side of what all treads cover, t [m]."""
    left: Array
    """s of the nosings near the left side, shape (m,) [m]."""
    right: Array
    """The same near the right side [m]."""
    levels: Array
    """Heights of the nosings, shape (m,) [m]."""
    base: float
    """Level of the floor before the first nosing [m]."""

    @property
    def middle(self) -> float:
        """Middle of the lane, t [m]."""
        return sum(self.lane) / 2

    @cached_property
    def nosings(self) -> Array:
        """Nosings in the middle of the lane, s, shape (m,) [m]."""
        return np.asarray((self.left + self.right) / 2)

    @cached_property
    def skew(self) -> float:
        """How far the nosings lead ahead from right to left [1]."""
        low, high = self.lane
        return float((self.left - self.right).mean()) / (high - low - 2 * INSET)

    def at(self, t: float) -> Array:
        """Nosings at a place across, s, shape (m,) [m]."""
        return np.asarray(self.nosings + self.skew * (t - self.middle))

    def square(self, points: Array) -> Array:
        """(s, t, z) of points, shape (n, 3), as if the nosings lay square to the flight [m]."""
        flat = self.frame.of(points[:, :2])
        s = flat[:, 0] - self.skew * (flat[:, 1] - self.middle)
        return np.column_stack([s, flat[:, 1], points[:, 2]])

    def line(self, before: float, behind: float) -> Array:
        """Line above which heights are measured, s and z, shape (m + 3, 2) [m].

        Through the nosings, down to the floor before the first at the slope of the flight, and on
        over both floors.
        """
        s, z = self.nosings, self.levels
        slope = (z[-1] - z[0]) / (s[-1] - s[0]) if len(s) > 1 else 1.0
        foot = s[0] - max(z[0] - self.base, 0.0) / slope
        ends = [(min(foot, s[0] - before) - 1e-6, self.base), (foot - 1e-9, self.base)]
        return np.vstack([ends, np.column_stack([s, z]), (s[-1] + behind + 1e-6, z[-1])])

    def over(self, base: float) -> "Path":
        """Path that begins on a floor of a level [m]."""
        return replace(self, base=base)

    def longer(self, level: float, left: float, right: float) -> "Path":
        """Path with one nosing more, s of its left and its right end [m]."""
        return replace(
            self,
            left=np.append(self.left, left),
            right=np.append(self.right, right),
            levels=np.append(self.levels, level),
        )
