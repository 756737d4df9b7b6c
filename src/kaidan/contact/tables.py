"""Terrain and robot as the tables that the kernel reads, see `kaidan.contact.layout`."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kaidan.contact.codes import PartKind
from kaidan.contact.door import Records, table_of, zeros
from kaidan.contact.layout import Disc, Part, Point

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
#: Numbers of a disc: centre and radius.
DISC = 3

#: Points closer than this to the line of those beside them are dropped [m]; far below any scan,
#: far above the rounding of coordinates of some metres.
COLLINEAR = 1e-11
#: Discs are never sharper than this [m]: a rounding of a millimetre, drawn inside the part so that
#: its flat stays where it is, gives every contact a normal.
SHARPEST = 1e-3
#: What a part may be.
KINDS = frozenset(float(kind) for kind in PartKind)
#: How far the first and last segments are continued [m].
BEYOND = 30.0


def ground_table(terrain: ArrayLike) -> Records:
    """Terrain polyline as the kernel's table.

    Repeated points and points on the line of those beside them are dropped, and folds of a vertical
    face, so that refining a profile changes nothing; the first and the last segment are continued
    by 30 m (level, if the profile begins or ends with a riser).

    Parameters
    ----------
    terrain
        Points (n, 2): x and z [m], x non-decreasing, at least two different points.

    Returns
    -------
    ndarray (k,)
        Rows of `kaidan.contact.layout.Point`.

    Raises
    ------
    ValueError
        If the array has the wrong shape, is not finite, runs backwards or is a single point.

    Examples
    --------
    >>> ground_table([[0, 0], [1, 0], [2, 0], [2, 0.2], [3, 0.2]])["convex"].tolist()
    [False, False, True, False]
    """
    points = np.array(terrain, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"terrain: expected points of shape (n, 2), got {points.shape}")
    if not np.isfinite(points).all():
        raise ValueError("terrain: every coordinate must be finite")
    if (np.diff(points[:, 0]) < 0).any():
        where = int(np.argmax(np.diff(points[:, 0]) < 0))
        raise ValueError(f"terrain: x runs backwards after point {where}")
    last, *others = points.tolist()
    keep = [last]
    for point in others:
        if _length(point[0] - last[0], point[1] - last[1]) > COLLINEAR:
            keep.append(point)
            last = point
    if len(keep) < 2:
        raise ValueError("terrain: at least two different points are needed")
    keep = without_folds(np.array(keep)).tolist()
    keep = [_beyond(keep[1], keep[0], -1.0), *keep, _beyond(keep[-2], keep[-1], 1.0)]
    xy = np.array(_corners(keep))
    table = zeros(Point, len(xy))
    table["x"], table["z"] = xy.T
    step = np.diff(xy, axis=0)
    length = np.sqrt(step[:, 0] * step[:, 0] + step[:, 1] * step[:, 1])
    unit = step / length[:, None]
    u_x, u_z = np.vstack([unit, unit[-1:]]).T
    table["u_x"], table["u_z"] = u_x, u_z
    table["length"][:-1] = length
    turn = u_x[:-2] * u_z[1:-1] - u_z[:-2] * u_x[1:-1]
    back = (turn == 0) & (u_z[:-2] > 0) & (u_z[1:-1] < 0)  # a tip of a face
    table["convex"][1:-1] = (turn < 0) | back
    return table


def without_folds(points: FloatArray) -> FloatArray:
    """Points of a line that leads ahead, no vertical face of which goes up and down within itself.

    The noise of a scan folds a face so. It is the same face: of its points only the ends count, and
    what is higher or lower than both.

    Examples
    --------
    >>> face = [(0.0, 0.0), (0.0, 0.04), (0.0, 0.02), (0.0, 0.1)]
    >>> without_folds(np.array([(-1.0, 0.0), *face, (1.0, 0.1)])).tolist()
    [[-1.0, 0.0], [0.0, 0.0], [0.0, 0.1], [1.0, 0.1]]
    """
    x, z = points.T
    begins = np.append(np.flatnonzero(np.diff(x, prepend=-math.inf)), len(x))
    keep = np.ones(len(x), dtype=np.bool_)
    for k in np.flatnonzero(np.diff(begins) > 2):
        first, last = begins[k], begins[k + 1] - 1
        face = z[first : last + 1]
        ways = np.sign(np.diff(face))
        if np.ptp(ways) == 0:
            continue
        keep[first + 1 : last] = False
        top, bottom = int(np.argmax(face)), int(np.argmin(face))
        keep[first + top] |= face[top] > max(face[0], face[-1]) + COLLINEAR
        keep[first + bottom] |= face[bottom] < min(face[0], face[-1]) - COLLINEAR
    return points[keep]


def _corners(points: list[list[float]]) -> list[list[float]]:
    """Points that do not lie straight between the last one kept and the next; and both ends."""
    last, here = points[:2]
    corners = [last]
    b_x, b_z = here[0] - last[0], here[1] - last[1]
    for then in points[2:]:
        a_x, a_z = then[0] - here[0], then[1] - here[1]
        across = abs(b_x * a_z - b_z * a_x)
        before, after = _length(b_x, b_z), _length(a_x, a_z)
        short, long = (before, after) if before < after else (after, before)
        if across > min(COLLINEAR, 1e-7 * short) * long or b_x * a_x + b_z * a_z <= 0.0:
            corners.append(here)
            last = here
            b_x, b_z = a_x, a_z
        else:
            b_x, b_z = then[0] - last[0], then[1] - last[1]
        here = then
    corners.append(here)
    return corners


def _beyond(last: list[float], end: list[float], level: float) -> list[float]:
    """Point to which the terrain is continued over an end: straight on, or level over a riser."""
    u_x, u_z = level, 0.0
    if last[0] != end[0]:
        away = _length(end[0] - last[0], end[1] - last[1])
        u_x, u_z = (end[0] - last[0]) / away, (end[1] - last[1]) / away
    return [end[0] + BEYOND * u_x, end[1] + BEYOND * u_z]


def body_table(parts: ArrayLike, kinds: ArrayLike | None = None) -> Records:
    """Robot underside as the kernel's table.

    Parameters
    ----------
    parts
        Array (m, 6): x1, z1, r1, x2, z2, r2 [m] of two discs whose hull is the part, in the body
        frame (origin at the centroid, x uphill, z up).
    kinds
        m integers: 0 track, 1 flipper, 2 belly; all track if not given.

    Returns
    -------
    ndarray (m,)
        Rows of `kaidan.contact.layout.Part`.

    Raises
    ------
    ValueError
        If the shape is wrong, a number is not finite, a radius is negative or a kind is unknown.

    Examples
    --------
    >>> body_table([[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]])["flat"].round(9)
    array([0.47])
    """
    rows = np.array(parts, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 2 * DISC or not 1 <= len(rows) <= 16:
        raise ValueError(f"parts: expected shape (m, 6) with 1 <= m <= 16, got {rows.shape}")
    if not np.isfinite(rows).all():
        raise ValueError("parts: every number must be finite")
    if (rows[:, [2, 5]] < 0).any():
        raise ValueError("parts: radii must not be negative")
    kind = np.zeros(len(rows)) if kinds is None else np.array(kinds, dtype=np.float64)
    if kind.shape != (len(rows),) or not KINDS.issuperset(kind.tolist()):
        raise ValueError("kinds: one of 0 (track), 1 (flipper), 2 (belly) for each part")
    each = zip(rows.tolist(), kind.tolist(), strict=True)
    return table_of(Part, [_part(Disc(*of[:DISC]), Disc(*of[DISC:]), int(of_kind))
                           for of, of_kind in each])  # fmt: skip


def _part(one: Disc, two: Disc, kind: int) -> Part:
    distance = _length(two.x - one.x, two.z - one.z)
    if distance <= abs(one.r - two.r) + 1e-9:  # one disc holds the other: a single disc
        larger = one if one.r >= two.r else two
        only = Disc(larger.x, larger.z, max(larger.r, SHARPEST))
        return Part(only, only, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, kind)
    e_x, e_z = (two.x - one.x) / distance, (two.z - one.z) / distance
    side = 1.0 if e_x >= 0 else -1.0  # the side of the axis that looks down
    sine = (one.r - two.r) / distance
    cosine = math.sqrt(1.0 - sine * sine)
    n_x = sine * e_x + cosine * side * e_z
    n_z = sine * e_z - cosine * side * e_x
    if one.r < SHARPEST or two.r < SHARPEST:
        return _part(_grown(one, n_x, n_z), _grown(two, n_x, n_z), kind)
    return Part(one, two, e_x, e_z, distance, sine, cosine, distance * cosine, side, kind)


def _grown(disc: Disc, n_x: float, n_z: float) -> Disc:
    """Disc no sharper than `SHARPEST` that touches the same flat, whose normal is given."""
    grow = max(SHARPEST - disc.r, 0.0)
    return Disc(disc.x - grow * n_x, disc.z - grow * n_z, disc.r + grow)


def _length(x: float, z: float) -> float:
    """Length of a vector; unlike a hypotenuse of some libm it is the same on every machine."""
    return math.sqrt(x * x + z * z)


def mirror(terrain: ArrayLike, parts: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Reflected profile and robot: x to -x, points reversed, ends swapped.

    Driving up the mirrored profile is driving down the given one with the other end in front.

    Examples
    --------
    >>> ground, robot = mirror([[0, 0], [1, 0.5]], [[-0.3, 0, 0.05, 0.2, 0, 0.06]])
    >>> ground.tolist(), robot.tolist()
    ([[-1.0, 0.5], [0.0, 0.0]], [[-0.2, 0.0, 0.06, 0.3, 0.0, 0.05]])
    """
    points = np.array(terrain, dtype=np.float64)[::-1] * np.array([-1.0, 1.0])
    rows = np.array(parts, dtype=np.float64)
    swapped = rows[:, [3, 4, 5, 0, 1, 2]] * np.array([-1.0, 1.0, 1.0, -1.0, 1.0, 1.0])
    return points + 0.0, swapped + 0.0
