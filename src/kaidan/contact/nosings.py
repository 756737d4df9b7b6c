"""Nosings that a flat reaches and leaves between the poses of a path."""

import numpy as np

from kaidan.contact.codes import FeatureTable
from kaidan.contact.columns import PASSED_COLUMNS
from kaidan.contact.path import TOUCH, Path
from kaidan.contact.records import Events
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray, margin_tables
from kaidan.mechanics import STANDARD_GRAVITY


def nosings_passed(path: Path, rows: IntArray, touch: float) -> FloatArray:
    """Nosings that a flat reaches or leaves on the way from some poses to the next.

    Those of which an event tells are left out.

    Parameters
    ----------
    path
        As driven.
    rows
        The first of each two poses, which lie on one straight piece of the path.
    touch
        Gap up to which a nosing lies on a flat [m].

    Returns
    -------
    ndarray (k, 6)
        Arclength [m], 1 where it is reached, point of the ground, part, row before, share of
        the arclength to the next pose; in this order.
    """
    if len(rows) == 0:
        return np.empty((0, PASSED_COLUMNS))
    size, count = 0, 2 * len(rows) + 8
    while count > size:
        size = count
        table = np.empty((size, PASSED_COLUMNS))
        count = kernel().nosings_passed(
            path.ground.table, path.body.table, path.poses.table, path.events.table, rows,
            touch, path.reach, table,
        )  # fmt: skip
    found = table[:count]
    return found[np.lexsort(found.T[::-1])]


def without_nosings(
    path: Path, events: Events, *, acceleration: float = 0.0, gravity: float = STANDARD_GRAVITY
) -> Path:
    """Poses at which nosings come under the flat or leave it, as if these were not there.

    Parameters
    ----------
    path
        As driven.
    events
        REACHED and LEFT, between two poses on one straight piece of the path.
    acceleration, gravity
        As for :meth:`Path.margins_of`.

    Returns
    -------
    Path
        A pose for each event, with its margins just before the nosing is reached, or just
        after it is left; neither events nor rotations.
    """
    begin = path.s[events.pose]
    shares = (events.s - begin) / (path.s[events.pose + 1] - begin)
    poses = path.table_between(events.pose, shares)
    points = FeatureTable.of(events.feature).point
    margins, found = margin_tables(len(poses))
    kernel().margins_without(
        path.ground.table, path.body.table, poses, points, acceleration, gravity, TOUCH,
        margins, found,
    )  # fmt: skip
    return path.with_poses(poses, margins)
