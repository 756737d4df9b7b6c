"""Where the rectangle that a robot covers has room: walls, points inside, the largest circle."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Footprint(NamedTuple):
    """Rectangle that a robot covers, about its turning centre."""

    front: float
    """From the turning centre to the front [m]."""
    rear: float
    """From the turning centre to the rear [m]."""
    width: float
    """Over all [m]."""


def walls_of(polygon: Array) -> Array:
    """Sides of a polygon as walls, shape (n, 4): x, y of one end and of the other [m]."""
    corners = np.asarray(polygon, dtype=float)
    return np.hstack([corners, np.roll(corners, -1, axis=0)])


def blocked(footprint: Footprint, poses: Array, walls: Array) -> NDArray[np.bool_]:
    """Whether a wall cuts the footprint, for each pose; separating axes, exact.

    Parameters
    ----------
    footprint : Footprint
    poses : array, shape (n, 3)
        x, y [m] and heading [rad].
    walls : array, shape (m, 4)
        Segments [m].

    Returns
    -------
    array of bool, shape (n,)
        A wall that only touches does not block.

    Examples
    --------
    >>> square = walls_of([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> print(blocked(Footprint(0.4, 0.4, 0.5), np.array([[0.5, 0.5, 0], [0.7, 0.5, 0]]), square))
    [False  True]
    """
    x, y, psi = (each[:, None] for each in poses.T)
    cos, sin = np.cos(psi), np.sin(psi)
    middle, half = (footprint.front - footprint.rear) / 2, footprint.width / 2
    reach = (footprint.front + footprint.rear) / 2
    ends = []
    for k in (0, 2):
        dx, dy = walls[None, :, k] - x, walls[None, :, k + 1] - y
        ends.append((dx * cos + dy * sin - middle, dy * cos - dx * sin))
    (ax, ay), (bx, by) = ends
    tiny = 1e-9
    apart = (np.minimum(ax, bx) >= reach - tiny) | (np.maximum(ax, bx) <= tiny - reach)
    apart |= (np.minimum(ay, by) >= half - tiny) | (np.maximum(ay, by) <= tiny - half)
    apart |= np.abs(ax * by - ay * bx) >= reach * np.abs(by - ay) + half * np.abs(bx - ax) - tiny
    return np.asarray(~apart.all(axis=1))


def inside(points: Array, polygon: Array) -> NDArray[np.bool_]:
    """Whether points (n, 2) lie in a polygon (m, 2), by the even-odd rule."""
    x, y = points[:, :1], points[:, 1:2]
    ax, ay, bx, by = walls_of(polygon).T
    crosses = (ay > y) != (by > y)
    rise = np.where(by == ay, 1.0, by - ay)
    left = x < ax + (y - ay) * (bx - ax) / rise
    return np.asarray((crosses & left).sum(axis=1) % 2 == 1)


def inscribed_circle(walls: Array, polygon: Array, *, precision: float = 0.005) -> Array:
    """Largest circle inside a polygon that crosses no wall: x, y of its middle and its radius.

    Parameters
    ----------
    walls : array, shape (m, 4)
        Segments, the sides of the polygon among them [m].
    polygon : array, shape (n, 2)
        Corners [m].
    precision : float
        By how much the radius may fall short [m].

    Returns
    -------
    array, shape (3,)

    Examples
    --------
    >>> square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> print(inscribed_circle(walls_of(square), square).round(2))
    [0.5 0.5 0.5]
    """
    corners = np.asarray(polygon, dtype=float)
    low, high = corners.min(axis=0), corners.max(axis=0)
    half = float((high - low).max()) / 2
    middles = ((low + high) / 2)[None]
    best = np.array([*middles[0], 0.0])
    while half > 0 and len(middles):
        distance = np.where(inside(middles, corners), 1.0, -1.0) * to_walls(middles, walls)
        top = int(np.argmax(distance))
        if distance[top] > best[2]:
            best = np.array([*middles[top], distance[top]])
        keep = distance + half * np.sqrt(2.0) > best[2] + precision
        half /= 2
        quarters = half * np.array([(-1, -1), (1, -1), (-1, 1), (1, 1)])
        middles = (middles[keep][:, None] + quarters).reshape(-1, 2)
    return best


def to_walls(points: Array, walls: Array) -> Array:
    """Distance of each point to the nearest wall [m]."""
    a, d = walls[None, :, :2], walls[None, :, 2:] - walls[None, :, :2]
    from_a = points[:, None] - a
    length = np.maximum((d**2).sum(axis=-1), 1e-18)
    t = np.clip((from_a * d).sum(axis=-1) / length, 0.0, 1.0)
    off = from_a - t[..., None] * d
    return np.asarray(np.sqrt((off**2).sum(axis=-1)).min(axis=1))
