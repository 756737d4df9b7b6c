"""Poses between two of a path at which a figure may be the largest."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from kaidan.contact.codes import CUT_AT_ONCE, PIECES, ROUNDS
from kaidan.contact.door import stacked, zeros
from kaidan.contact.layout import Margin, Pose, Pull
from kaidan.contact.nosings import nosings_passed
from kaidan.contact.path import Path
from kaidan.contact.switch import kernel
from kaidan.contact.tables import IntArray
from kaidan.mechanics import STANDARD_GRAVITY

GROUPS = 4
"""Groups of poses of which peaks are looked for: phases, and what leaves an edge as it lands."""


class Between(NamedTuple):
    """Poses of a path and between two of it."""

    path: Path
    """Those poses with their margins."""
    rows: IntArray
    """Of the pose before each."""


def samples_of(
    path: Path, phase: IntArray, touch: float, *, acceleration: float,
    gravity: float = STANDARD_GRAVITY,
) -> Between:  # fmt: skip
    """Poses of a path, and those between them at which its extremes may lie.

    Where a nosing comes under a flat or leaves it, as if it were not there; where the friction that
    a phase requires may be the largest; where the path stands upright.

    Parameters
    ----------
    path
        With margins.
    phase
        Number of the phase of each pose: in 2 the robot lands.
    touch
        Gap up to which a nosing lies on a flat [m].
    acceleration, gravity
        As for :meth:`Path.between`.

    Returns
    -------
    Between
        The poses of the path first, with their own rows. Where it turns steadily over the upright,
        the traction is that of all the weight.
    """
    assert path.margins is not None
    passed, count = nosings_passed(path, touch), len(path.poses)
    room = 3 * count + len(passed) + GROUPS * ROUNDS * (PIECES - 1) * CUT_AT_ONCE
    rows, poses, margins = np.zeros(room, dtype=np.int64), zeros(Pose, room), zeros(Margin, room)
    total = kernel().find_samples(
        path.scene, path.poses.table, path.margins.table, phase, passed,
        Pull(acceleration, gravity), (rows, poses, margins),
    )  # fmt: skip
    found = path.with_poses(stacked([poses[:total]]), stacked([margins[:total]]))
    return Between(found, rows[:total].copy())
