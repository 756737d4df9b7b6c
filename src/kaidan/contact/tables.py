"""Terrain and robot as the flat tables of numbers that the kernel reads.

::

    ground table, one row a point k              body table, one row a part (hull of two discs)

       k+1 o------                                    e = unit vector disc 1 -> disc 2
           | u (unit vector k -> k+1)              .--------------------------.
           | m = left normal of u                 ( c1 . r1 --> e      c2 . r2 )
      -----o k                                     '--------------------------'  flat: the lower
                                                                                 common tangent
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: In the kernel: a table (rows, columns), a list of numbers, a list of indices, contiguous all.
#: The three are told apart by type, for the compiler's signatures are read from the annotations.
FloatArray = NDArray[np.float64]
FloatRow = np.ndarray[tuple[int], np.dtype[np.float64]]
IntArray = NDArray[np.int64]

#: Kinds of parts.
TRACK, FLIPPER, BELLY = 0, 1, 2

#: Points closer to the line of their neighbours than this are dropped [m]; far below any scan,
#: far above the rounding of coordinates of some metres.
COLLINEAR = 1e-11
#: Discs are never sharper than this [m]: a rounding of a millimetre, drawn inside the part so that
#: its flat stays where it is, gives every contact a normal.
SHARPEST = 1e-3
#: How far the first and last segments are continued [m].
BEYOND = 30.0


def ground_table(terrain: ArrayLike) -> FloatArray:
    """Terrain polyline as the kernel's table.

    Repeated points and points on the line of their neighbours are dropped, so that refining a
    profile changes nothing; the first and the last segment are continued by 30 m (level, if the
    profile begins or ends with a riser).

    Parameters
    ----------
    terrain
        Points (n, 2): x and z [m], x non-decreasing, at least two different points.

    Returns
    -------
    ndarray (k, 6)
        x, z, unit vector to the next point (2), length of that segment, 1.0 if the point is convex.

    Raises
    ------
    ValueError
        If the array has the wrong shape, is not finite, runs backwards or is a single point.

    Examples
    --------
    >>> ground_table([[0, 0], [1, 0], [2, 0], [2, 0.2], [3, 0.2]])[:, 5]
    array([0., 0., 1., 0.])
    """
    points = np.array(terrain, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"terrain: expected points of shape (n, 2), got {points.shape}")
    if not np.isfinite(points).all():
        raise ValueError("terrain: every coordinate must be finite")
    if (np.diff(points[:, 0]) < 0).any():
        where = int(np.argmax(np.diff(points[:, 0]) < 0))
        raise ValueError(f"terrain: x runs backwards after point {where}")
    keep = [points[0]]
    for point in points[1:]:
        if np.hypot(*(point - keep[-1])) > COLLINEAR:
            keep.append(point)
    if len(keep) < 2:
        raise ValueError("terrain: at least two different points are needed")
    if keep[1][0] - keep[0][0] > 0:
        u = (keep[0] - keep[1]) / np.hypot(*(keep[0] - keep[1]))
    else:
        u = np.array([-1.0, 0.0])
    keep.insert(0, keep[0] + BEYOND * u)
    if keep[-1][0] - keep[-2][0] > 0:
        u = (keep[-1] - keep[-2]) / np.hypot(*(keep[-1] - keep[-2]))
    else:
        u = np.array([1.0, 0.0])
    keep.append(keep[-1] + BEYOND * u)
    corners = [keep[0]]
    for k in range(1, len(keep) - 1):
        before = keep[k] - corners[-1]
        after = keep[k + 1] - keep[k]
        across = before[0] * after[1] - before[1] * after[0]
        along = before[0] * after[0] + before[1] * after[1]
        short = min(np.hypot(*before), np.hypot(*after))
        if (
            along <= 0
            or abs(across) > COLLINEAR * max(np.hypot(*before), np.hypot(*after))
            or (abs(across) > 1e-7 * short * max(np.hypot(*before), np.hypot(*after)))
        ):
            corners.append(keep[k])
    corners.append(keep[-1])
    xy = np.array(corners)
    table = np.zeros((len(xy), 6))
    table[:, :2] = xy
    step = np.diff(xy, axis=0)
    length = np.hypot(step[:, 0], step[:, 1])
    table[:-1, 2:4] = step / length[:, None]
    table[-1, 2:4] = table[-2, 2:4]
    table[:-1, 4] = length
    turn = table[:-2, 2] * table[1:-1, 3] - table[:-2, 3] * table[1:-1, 2]
    table[1:-1, 5] = turn < 0
    return table


def body_table(parts: ArrayLike, kinds: ArrayLike | None = None) -> FloatArray:
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
    ndarray (m, 14)
        c1 (2), r1, c2 (2), r2, e (2), distance, sine and cosine of the taper, length of the flat,
        side of the underside, kind.

    Raises
    ------
    ValueError
        If the shape is wrong, a number is not finite, a radius is negative or a kind is unknown.

    Examples
    --------
    >>> round(float(body_table([[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]])[0, 11]), 9)
    0.47
    """
    rows = np.array(parts, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != 6 or not 1 <= len(rows) <= 16:
        raise ValueError(f"parts: expected shape (m, 6) with 1 <= m <= 16, got {rows.shape}")
    if not np.isfinite(rows).all():
        raise ValueError("parts: every number must be finite")
    if (rows[:, [2, 5]] < 0).any():
        raise ValueError("parts: radii must not be negative")
    kind = np.zeros(len(rows)) if kinds is None else np.array(kinds, dtype=np.float64)
    if kind.shape != (len(rows),) or not np.isin(kind, (TRACK, FLIPPER, BELLY)).all():
        raise ValueError("kinds: one of 0 (track), 1 (flipper), 2 (belly) for each part")
    table = np.zeros((len(rows), 14))
    for row, (x1, z1, r1, x2, z2, r2) in enumerate(rows.tolist()):
        table[row] = _body_row(x1, z1, r1, x2, z2, r2, kind[row])
    return table


def _body_row(
    x1: float, z1: float, r1: float, x2: float, z2: float, r2: float, kind: float
) -> list[float]:
    distance = float(np.hypot(x2 - x1, z2 - z1))
    if distance <= abs(r1 - r2) + 1e-9:  # one disc holds the other: a single disc
        if r1 >= r2:
            x2, z2, r2 = x1, z1, r1
        else:
            x1, z1, r1 = x2, z2, r2
        r1 = r2 = max(r1, SHARPEST)
        return [x1, z1, r1, x2, z2, r2, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, kind]
    e_x, e_z = (x2 - x1) / distance, (z2 - z1) / distance
    side = 1.0 if e_x >= 0 else -1.0  # the side of the axis that looks down
    sine = (r1 - r2) / distance
    cosine = float(np.sqrt(1.0 - sine * sine))
    n_x = sine * e_x + cosine * side * e_z
    n_z = sine * e_z - cosine * side * e_x
    if r1 < SHARPEST or r2 < SHARPEST:
        grow1, grow2 = max(SHARPEST - r1, 0.0), max(SHARPEST - r2, 0.0)
        return _body_row(
            x1 - grow1 * n_x, z1 - grow1 * n_z, r1 + grow1,
            x2 - grow2 * n_x, z2 - grow2 * n_z, r2 + grow2, kind,
        )  # fmt: skip
    flat = distance * cosine
    return [x1, z1, r1, x2, z2, r2, e_x, e_z, distance, sine, cosine, flat, side, kind]


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
