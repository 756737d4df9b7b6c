"""Nosings that the flat reaches and leaves while others carry it: events that turn nothing.

The kernel follows the pair of contacts that carries the robot. On a straight line of nosings the
flat slides on to the next one, and off the last, without a change of pose: those exchanges are
found here, from the poses, where they pass an end of the flat.
"""

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.contact import BELLY

Array = NDArray[np.float64]

TOUCH = 1e-7
"""Gap up to which a nosing lies on the flat [m]: ten times what poses are solved to."""
BLOCK = 256
"""Poses that are looked at together: what lies under them is a short piece of the ground."""
STRAIGHT = 1e-9
"""Turn between two poses above which the kernel has the event [rad]."""


def exchanges_of(run: contact.Traverse) -> Array:
    """Events REACHED and LEFT of a traverse, in its order.

    Parameters
    ----------
    run : Traverse
        With its poses.

    Returns
    -------
    ndarray (k, 8)
        Rows as those of `Traverse.events`: code, arclength, x, z, inclination, feature, -1, row of
        the pose before.
    """
    told = _told(run)
    rows: list[tuple[float, ...]] = []
    for first in range(0, len(run.s) - 1, BLOCK):
        block = np.arange(first, min(first + BLOCK + 1, len(run.s)))
        for part in np.flatnonzero(run.body[:, 13] != BELLY):
            rows += _of_block(run, block, int(part), told)
    return _once(np.array(sorted(rows, key=lambda each: each[1])).reshape(-1, 8))


def _of_block(
    run: contact.Traverse, block: NDArray[np.int64], part: int, told: dict[int, list[float]]
) -> list[tuple[float, ...]]:
    """Events of some consecutive poses and one part."""
    s, phi, leg = run.s[block], run.inclination[block], run.poses[block, 15]
    together = (leg[1:] == leg[:-1]) & (np.abs(np.diff(phi)) < STRAIGHT) & (np.diff(s) > 0)
    if not together.any():
        return []
    x, reach = run.x[block], float(np.abs(run.body[:, :6]).sum(axis=1).max())
    near = (run.ground[:, 0] > x.min() - reach) & (run.ground[:, 0] < x.max() + reach)
    corners = np.flatnonzero(near & (run.ground[:, 5] == 1.0))
    w, gap = _along_flat(run, block, corners, part)
    length = float(run.body[part, 11])
    lies = (np.abs(gap) < TOUCH) & (w >= 0) & (w <= length)
    rows: list[tuple[float, ...]] = []
    for row, column in np.argwhere((lies[1:] != lies[:-1]) & together[:, None]):
        k = int(corners[column])
        if any(at - 1e-9 <= s[row + 1] and s[row] <= at + 1e-9 for at in told.get(k, ())):
            continue
        before, after = float(w[row, column]), float(w[row + 1, column])
        share = ((0.0 if min(before, after) < 0 else length) - before) / (after - before)
        code = contact.Event.LEFT if lies[row, column] else contact.Event.REACHED
        pose, then = run.poses[block[row], :4], run.poses[block[row + 1], :4]
        at = pose + share * (then - pose)
        rows.append((float(code), *at, 64.0 * k + 4.0 * part, -1.0, float(block[row])))
    return rows


def _along_flat(
    run: contact.Traverse, rows: NDArray[np.int64], corners: NDArray[np.int64], part: int
) -> tuple[Array, Array]:
    """Place along the flat of a part and gap to its line [m], of some poses and corners."""
    body, phi = run.body[part], run.inclination[rows]
    c, s = np.cos(phi)[:, None], np.sin(phi)[:, None]
    d_x = run.ground[corners, 0] - run.x[rows, None]
    d_z = run.ground[corners, 1] - run.z[rows, None]
    a_x, a_z = c * d_x + s * d_z - body[0], c * d_z - s * d_x - body[1]
    along = a_x * body[6] + a_z * body[7]
    below = body[12] * (a_x * body[7] - a_z * body[6])
    w = along * body[10] - below * body[9]
    return w, along * body[9] + below * body[10] - body[2]


def _told(run: contact.Traverse) -> dict[int, list[float]]:
    """Arclengths at which the kernel tells of each vertex [m]."""
    told: dict[int, list[float]] = {}
    for event in run.events:
        for feature in (int(event[5]), int(event[6])):
            if feature >= 0 and feature & 3 == 0:
                told.setdefault(feature >> 6, []).append(float(event[1]))
    return told


def _once(events: Array) -> Array:
    """Without those of a nosing that passes from one part to the next in line with it."""
    kept: list[Array] = []
    for event in events:
        twin = next(
            (
                k
                for k in range(len(kept) - 1, max(len(kept) - 8, 0) - 1, -1)
                if int(kept[k][5]) >> 6 == int(event[5]) >> 6
                and kept[k][0] != event[0]
                and abs(kept[k][1] - event[1]) < 1e-6
            ),
            None,
        )
        if twin is None:
            kept.append(event)
        else:
            del kept[twin]
    return np.array(kept).reshape(-1, 8)
