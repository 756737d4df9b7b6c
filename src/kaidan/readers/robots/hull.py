"""The convex hull of discs in a plane, exactly: which discs touch it, and the edges between them.

A corner is a disc of radius zero, a wheel one of its own.

::

        .--------.            Seen along the outward normal (sin a, -cos a), the disc that lies
      (    i      '---. j     farthest supports the hull. Two discs i and j share an edge where
        '-----edge----'       both lie equally far:  (c_j - c_i) . n(a) + r_j - r_i = 0.
              | n(a)
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_SAME = 1e-9
"""Angles and distances closer than this are the same [rad, m]."""


@dataclass(frozen=True)
class Edge:
    """A straight piece of the hull, seen with the hull on its left."""

    first: int
    """Disc at which it begins."""
    second: int
    """Disc at which it ends."""
    normal: float
    """Angle of the outward normal from straight down, towards x [rad]."""
    begin: tuple[float, float]
    """Point at which it leaves the first disc [m]."""
    end: tuple[float, float]
    """Point at which it meets the second [m]."""

    @property
    def length(self) -> float:
        """[m]."""
        return math.dist(self.begin, self.end)


def hull_of_discs(discs: Array) -> tuple[Edge, ...]:
    """Edges of the convex hull of discs, anticlockwise from straight left.

    discs, shape (n, 3): x, z, radius [m].

    None without discs, for a single one, or where one holds all others.

    Examples
    --------
    Two wheels of one size: the lower edge runs from one to the other, the upper one back.

    >>> for edge in hull_of_discs(np.array([[0.0, 0.1, 0.1], [0.5, 0.1, 0.1]])):
    ...     print([round(each, 3) for each in (*edge.begin, *edge.end)])
    [0.0, 0.0, 0.5, 0.0]
    [0.5, 0.2, 0.0, 0.2]
    """
    if not len(discs):
        return ()
    at, stop = -math.pi / 2, 1.5 * math.pi
    current = _farthest(discs, at)
    edges: list[Edge] = []
    while len(edges) <= 2 * len(discs):
        nearest = _next(discs, current, at)
        if nearest is None:
            break
        other, at = nearest
        if at > stop + _SAME:
            break
        normal = np.array([math.sin(at), -math.cos(at)])
        ends = [tuple((discs[k, :2] + discs[k, 2] * normal).tolist()) for k in (current, other)]
        edges.append(Edge(current, other, at, *ends))
        current = other
    return tuple(edges)


def outline_of(discs: Array) -> Array:
    """Points around the convex hull of discs, anticlockwise, arcs every 6 degrees; shape (m, 2)."""
    edges = hull_of_discs(discs)
    if not edges:
        x, z, r = discs[int(discs[:, 2].argmax())]
        around = np.linspace(0.0, 2 * math.pi, 60, endpoint=False)
        return np.column_stack([x + r * np.cos(around), z + r * np.sin(around)])
    points = []
    for edge, after in zip(edges, (*edges[1:], edges[0]), strict=True):
        points.append(np.array([edge.begin]))
        x, z, r = discs[edge.second]
        turn = (after.normal - edge.normal) % (2 * math.pi)
        at = edge.normal + np.linspace(0.0, turn, 2 + int(turn / math.radians(6.0)) if r else 1)
        points.append(np.column_stack([x + r * np.sin(at), z - r * np.cos(at)]))
    return np.concatenate(points)


def outer_discs(discs: Array) -> Array:
    """Discs without those that cannot touch the hull, and each of them once.

    What lies within the polygon of the points farthest in 64 directions cannot.
    """
    discs = np.unique(discs, axis=0)
    if len(discs) < 3:
        return discs
    ways = np.linspace(0.0, 2 * math.pi, 64, endpoint=False)
    normals = np.column_stack([np.cos(ways), np.sin(ways)])
    far = discs[:, :2] @ normals.T + discs[:, 2:]
    outer = discs[far.argmax(axis=0)]
    corners = outer[:, :2] + outer[:, 2:] * normals
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(*sides.T)
    real = lengths > _SAME
    if real.sum() < 3:
        return discs
    outward = np.column_stack([sides[real, 1], -sides[real, 0]]) / lengths[real, None]
    reach = discs[:, :2] @ outward.T + discs[:, 2:] - (corners[real] * outward).sum(axis=1)
    return np.asarray(discs[(reach > -_SAME).any(axis=1)])


def _farthest(discs: Array, at: float) -> int:
    """Disc that supports the hull in a direction, of several the one that the hull leaves last."""
    x, z, r = discs.T
    far = x * math.sin(at) - z * math.cos(at) + r
    onward = x * math.cos(at) + z * math.sin(at)
    candidates = np.flatnonzero(far >= far.max() - _SAME)
    return _last(candidates, onward, r)


def _next(discs: Array, current: int, at: float) -> tuple[int, float] | None:
    """Disc that takes over after a direction, and the direction in which it does."""
    dx, dz, dr = (discs - discs[current]).T
    length = np.hypot(dx, dz)
    apart = length > np.abs(dr) + _SAME  # of two, neither holds the other
    if not apart.any():
        return None
    # dx sin a - dz cos a = -dr, of the two solutions the one at which the other disc grows
    with np.errstate(divide="ignore", invalid="ignore"):
        angle = np.arctan2(dz, dx) - np.arcsin(np.clip(dr / length, -1.0, 1.0))
    ahead = np.mod(angle - at + _SAME, 2 * math.pi) - _SAME
    ahead[~apart] = math.inf
    least = float(ahead.min())
    if not math.isfinite(least):
        return None
    same = np.flatnonzero(ahead <= least + _SAME)
    edge = np.sqrt(np.maximum(length**2 - dr**2, 0.0))
    return _last(same, edge, discs[:, 2]), at + max(least, 0.0)


def _last(candidates: NDArray[np.int64], far: Array, radius: Array) -> int:
    """Candidate that lies farthest on; of those at one point the largest: it holds the others."""
    last = candidates[far[candidates] >= far[candidates].max() - _SAME]
    return int(last[np.argmax(radius[last])])
