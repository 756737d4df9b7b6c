"""Figures that may be the largest between two poses of a path, and the tilt to the first rock."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from kaidan.contact.path import TOUCH, Path
from kaidan.contact.records import BoolArray
from kaidan.contact.scratch import peak_scratch
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray
from kaidan.mechanics import STANDARD_GRAVITY


class Between(NamedTuple):
    """Poses between two of a path."""

    path: Path
    """Those poses with their margins."""
    rows: IntArray
    """Of the pose before each."""


class Rock(NamedTuple):
    """Pose at which the least tilt of gravity makes the robot rotate."""

    tilt: float
    """Less what the robot rocks before [rad]; infinite: no pose was looked at."""
    row: int
    """Of the pose; -1: none."""


def friction_peaks(
    path: Path, values: FloatArray, group: IntArray, narrow: BoolArray, tolerance: float, *,
    acceleration: float, gravity: float = STANDARD_GRAVITY,
) -> Between:  # fmt: skip
    """Poses between two at which the required friction may be the largest of a group of poses.

    Parameters
    ----------
    path
        With margins.
    values
        The friction at each pose [1].
    group
        Number of the group of each pose; negative: of none.
    narrow
        Whether the way from each pose to the next may hide a peak that no line tells of (n - 1).
    tolerance
        Share of the largest figure of a group above which is not looked for [1].
    acceleration, gravity
        As for :meth:`Path.margins_of`.
    """
    scratch = peak_scratch(len(values), int(group.max(initial=-1)) + 1)
    count = kernel().find_peaks(
        path.ground.table, path.body.table, path.poses.table, values, group,
        narrow.astype(np.int64), tolerance, 0.0, acceleration, gravity, TOUCH, *scratch,
    )  # fmt: skip
    poses = path.with_poses(scratch.between[:count].copy(), scratch.margins[:count].copy())
    return Between(poses, scratch.rows[:count].copy())


def first_rock(
    path: Path, rows: IntArray, side: float, *, own: int, whence: FloatArray | None = None,
    acceleration: float = 0.0, gravity: float = STANDARD_GRAVITY,
) -> Rock:  # fmt: skip
    """Least tilt of gravity at which some poses rotate by more than rocking, to one side.

    See :func:`kaidan.contact.kernel.first_rock.first_rock`.

    Parameters
    ----------
    path
        With margins.
    rows
        Which poses, ascending.
    side
        +1 back, -1 front.
    own
        Poses at the head of the path that follow one another; the rest lie between two of them.
    whence
        Inclination from which each pose of the path came down by rocking [rad]: gravity tilted back
        returns it there, and that is rocking too. Minus infinity: from none, which is so of all
        without it.
    acceleration, gravity
        As for :meth:`Path.margins_of`.
    """
    if path.margins is None:
        raise ValueError("traverse: tilts need with_margins=True")
    if len(rows) == 0:
        return Rock(math.inf, -1)
    size = len(path.poses)
    scratch = peak_scratch(size, 1)
    most = size + len(scratch.rows)
    group, narrow, at, pose, beside = np.empty((5, most), dtype=np.int64)
    reach, alone, tilt = np.empty((3, most))
    if whence is None:
        whence = np.full(size, -math.inf)
    return Rock(
        *kernel().first_rock(
            path.ground.table, path.body.table, path.poses.table, path.margins.table, rows, own,
            side, whence, acceleration, gravity, TOUCH, np.empty(size), group, narrow, at, pose,
            reach, alone, tilt, beside, *scratch,
        )
    )  # fmt: skip
