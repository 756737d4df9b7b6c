r"""What the underside of a robot is, seen from the side: the flat run, its ends, raised wheels.

::

      .-.                               C_N is measured square to the flat run, C_L along it from
     ( o ) raised     C                 its front end. The flat run is the longest lower edge of
      '-.'-.          |                 the convex hull that slopes by less than 3 degrees.
         '-.\_________|__________
            '----------------- o )
           rear end         front end
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from kaidan.readers.robots.hull import Edge, hull_of_discs, outer_discs
from kaidan.readers.robots.mechanism import Array
from kaidan.readers.robots.silhouette import Piece, discs_of

STEEPEST = math.radians(3.0)
"""Slope up to which a lower edge can be the flat run [rad]."""
_STRAIGHT = math.radians(0.5)
"""Edges that differ by less than this are one run [rad]."""
_AT_THE_END = 0.005, 0.02
"""How far from the end of the run its wheel may be: so many metres, or that share of the run."""


@dataclass(frozen=True)
class Raised:
    """A wheel beyond the flat run that the belt runs over."""

    from_front: float
    """[m]"""
    height: float
    """Axle above the underside [m]."""
    radius: float
    """[m]"""


@dataclass(frozen=True, eq=False)
class SideView:
    """Underside of some pieces, and where the centroid lies above it."""

    flat_length: float
    """L [m]."""
    com_from_front: float
    """C_L [m]."""
    com_height: float
    """C_N [m]."""
    radii: tuple[float, float]
    """Of the front and of the rear end; 0 where it is a corner [m]."""
    raised: tuple[Raised, ...]
    slope: float
    """Of the run in the file, nose up positive [rad]."""
    front: tuple[float, float]
    """Front end of the run in the file's x forward, z up [m]."""
    rear: tuple[float, float]
    """Rear end likewise [m]."""
    hull: tuple[Edge, ...]
    discs: Array
    """Of all pieces but those within the hull, shape (n, 3): x, z, radius [m]."""

    def above(self, discs: Array) -> Array:
        """Discs as distance behind the front end, height above the run, radius; shape (n, 3)."""
        along, up = np.array(_way(self.slope)), np.array(_way(self.slope + math.pi / 2))
        away = discs[:, :2] - np.array(self.front)
        return np.column_stack([-(away @ along), away @ up, discs[:, 2]])


def side_view(pieces: Sequence[Piece], centroid: tuple[float, float]) -> SideView | None:
    """Underside of pieces; None where none of it is level.

    centroid: x forward and z up of the whole robot [m].
    """
    discs = outer_discs(discs_of(pieces))
    hull = hull_of_discs(discs)
    level = [number for number, edge in enumerate(hull) if abs(edge.normal) < STEEPEST]
    if not level:
        return None
    longest = max(level, key=lambda number: hull[number].length)
    at = hull[longest].normal
    run = [hull[number] for number in level if abs(hull[number].normal - at) < _STRAIGHT]
    rear, front = run[0].begin, run[-1].end
    length = math.dist(rear, front)
    if length <= 0.0:
        return None
    slope = math.atan2(front[1] - rear[1], front[0] - rear[0])
    bare = SideView(
        length, math.nan, math.nan, (0.0, 0.0), (), slope, front, rear, hull, discs
    )  # fmt: skip
    com = bare.above(np.array([[*centroid, 0.0]]))[0]
    placed = bare.above(discs)
    return SideView(
        flat_length=length,
        com_from_front=float(com[0]),
        com_height=float(com[1]),
        radii=(_end_radius(placed, 0.0, length), _end_radius(placed, length, length)),
        raised=_raised(placed, length, {edge.first for edge in hull}),
        slope=slope,
        front=front,
        rear=rear,
        hull=hull,
        discs=discs,
    )


def _end_radius(placed: Array, end: float, length: float) -> float:
    """Radius of the largest wheel that stands on the run at its end; 0: none does."""
    near = max(_AT_THE_END[0], _AT_THE_END[1] * length)
    behind, height, radius = placed.T
    stands = (np.abs(behind - end) <= near) & (np.abs(height - radius) <= near) & (radius > 0.0)
    return float(radius[stands].max(initial=0.0))


def _raised(placed: Array, length: float, on_hull: set[int]) -> tuple[Raised, ...]:
    """Wheels of the hull beyond the run, higher than it."""
    near = max(_AT_THE_END[0], _AT_THE_END[1] * length)
    found = {}
    for number in sorted(on_hull):
        behind, height, radius = (float(each) for each in placed[number])
        beyond = behind < 0.0 or behind > length
        if radius > 0.0 and beyond and height - radius > near:
            found[round(behind, 4), round(height, 4)] = Raised(behind, height, radius)
    return tuple(sorted(found.values(), key=lambda wheel: wheel.from_front))


def _way(angle: float) -> tuple[float, float]:
    return math.cos(angle), math.sin(angle)
