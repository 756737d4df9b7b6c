"""A robot that slips from pose to pose of a path until a grouser stands."""

from __future__ import annotations

import numpy as np

from kaidan.contact.records import Poses
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray


def held_while_slipping(
    poses: Poses, points: IntArray, standing: FloatArray, friction: FloatArray, *, way: float,
    over: float, ahead: bool,
) -> FloatArray:  # fmt: skip
    """With how much to spare each pose holds before the robot slips for good [rad].

    Parameters
    ----------
    poses
        n of them, along a path.
    points
        Shape (n, k): points of the ground at which grousers may stand; -1: none.
    standing
        Shape (n, k): margin with a grouser that stands there [rad].
    friction
        Shape (n,): margin by friction alone [rad].
    way
        Arclength of the slip [m].
    over
        Arclength that nothing holds and that a slip ahead passes over [m].
    ahead
        Whether it slips towards the end of the path, else back.

    Returns
    -------
    ndarray (n,)
    """
    found = np.empty(len(poses))
    kernel().held_while_slipping(
        poses.table, np.ascontiguousarray(points).ravel(), standing.ravel(),
        np.ascontiguousarray(friction), points.shape[1], 1 if ahead else -1, way, over, found,
    )  # fmt: skip
    return found
