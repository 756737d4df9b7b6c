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
    s, phi, leg = run.s, run.inclination, run.poses[:, 15]
    together = (leg[1:] == leg[:-1]) & (np.abs(np.diff(phi)) < STRAIGHT) & (np.diff(s) > 0)
    told = _told(run)
    rows: list[tuple[float, ...]] = []
    for part in np.flatnonzero(run.body[:, 13] != BELLY):
        w, gap = _along_flat(run, int(part))
        length = float(run.body[part, 11])
        lies = (np.abs(gap) < TOUCH) & (w >= 0) & (w <= length)
        for row, k in np.argwhere((lies[1:] != lies[:-1]) & together[:, None]):
            if any(lo - 1e-9 <= s[row + 1] and s[row] <= lo + 1e-9 for lo in told.get(int(k), ())):
                continue
            end = 0.0 if min(w[row, k], w[row + 1, k]) < 0 else length
            share = (end - w[row, k]) / (w[row + 1, k] - w[row, k])
            code = contact.Event.LEFT if lies[row, k] else contact.Event.REACHED
            at = run.poses[row, :4] + share * (run.poses[row + 1, :4] - run.poses[row, :4])
            rows.append((float(code), *at, 64.0 * k + 4.0 * part, -1.0, float(row)))
    return _once(np.array(sorted(rows, key=lambda each: each[1])).reshape(-1, 8))


def _along_flat(run: contact.Traverse, part: int) -> tuple[Array, Array]:
    """Place along the flat of a part and gap to its line [m], of each pose and vertex."""
    body = run.body[part]
    c, s = np.cos(run.inclination)[:, None], np.sin(run.inclination)[:, None]
    d_x = run.ground[:, 0] - run.x[:, None]
    d_z = run.ground[:, 1] - run.z[:, None]
    a_x, a_z = c * d_x + s * d_z - body[0], c * d_z - s * d_x - body[1]
    along = a_x * body[6] + a_z * body[7]
    below = body[12] * (a_x * body[7] - a_z * body[6])
    w = along * body[10] - below * body[9]
    gap = along * body[9] + below * body[10] - body[2]
    corner = run.ground[:, 5] == 1.0
    return w, np.where(corner, gap, np.inf)


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
                for k, other in enumerate(kept)
                if int(other[5]) >> 6 == int(event[5]) >> 6
                and other[0] != event[0]
                and abs(other[1] - event[1]) < 1e-6
            ),
            None,
        )
        if twin is None:
            kept.append(event)
        else:
            del kept[twin]
    return np.array(kept).reshape(-1, 8)
