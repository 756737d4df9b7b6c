r"""How far behind the drawn pose a robot may stand once its flippers have moved.

::

     before   o=====o        after   o==.           the tip slides over the ground as it comes
              .-----'  flipper           '.  flipper  down, or the tracks do, or both in part:
     ---------'                ---------'  o         which of them it is, friction decides

The tracks are drawn where they are along the ground. But the distance between what the robot stands
on changes as its flippers turn, so that one of its two contacts slides, whichever friction holds
less. The drawn poses are one way between two: either contact may be the one that stays, and now the
one, now the other. So at every turn the one counts whose belt ran ahead by more.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.contact import FeatureTable
from kaidan.outline import Outline

STEEPEST = 0.5 * np.sqrt(2.0)
"""Upward part of the normal below which a contact holds no robot in its place: 45 degrees [1]."""

Array = NDArray[np.float64]
Places = NDArray[np.complex128]
"""Places as complex numbers, along the ground and up."""


def drift(path: contact.Path, outlines: Sequence[Outline]) -> float:
    """Distance by which it may stand behind where it is drawn [m], at least zero.

    Parameters
    ----------
    path : contact.Path
        A pose for each posture.
    outlines : sequence of Outline
        In each posture, x towards the leading end.
    """
    return float(max(0.0, slides(path.poses, outlines).max(axis=0).sum()))


def slides(poses: contact.Poses, outlines: Sequence[Outline]) -> Array:
    """Way along the ground by which the belt at a contact moves ahead, from pose to pose [m].

    Parameters
    ----------
    poses : contact.Poses
    outlines : sequence of Outline
        In each pose.

    Returns
    -------
    ndarray (2, poses - 1)
        At the rear and at the front contact.
    """
    turn = np.exp(1j * poses.inclination)
    parts = np.stack([each.parts for each in outlines[: len(turn)]])
    # both discs of each part in each pose (2, poses, parts)
    discs = np.stack([parts[:, :, 0] + 1j * parts[:, :, 1], parts[:, :, 3] + 1j * parts[:, :, 4]])
    discs = (poses.x + 1j * poses.z)[:, None] + turn[:, None] * discs
    rear, front = FeatureTable.of(poses.rear).part, FeatureTable.of(poses.front).part
    return np.stack([
        _slides(rear, poses.rear_point, poses.rear_normal, discs, turn),
        _slides(front, poses.front_point, poses.front_normal, discs, turn),
    ])  # fmt: skip


def _slides(
    part: NDArray[np.int64], point: Array, normal: Array, discs: Places, turn: Places
) -> Array:
    """The same at one contact of each pose; a part that is a disc turns with the robot."""
    rows = np.arange(len(part) - 1)
    one, two = discs[:, rows, part[:-1]], discs[:, rows + 1, part[:-1]]
    was, new = one[1] - one[0], two[1] - two[0]
    turned = np.where(was == 0.0, turn[1:] / turn[:-1], new / np.where(was == 0.0, 1.0, was))
    at = point[:-1, 0] + 1j * point[:-1, 1]
    along = normal[:-1, 1] - 1j * normal[:-1, 0]
    slides = ((two[0] + turned / np.abs(turned) * (at - one[0]) - at) * along.conj()).real
    return np.where(normal[:-1, 1] < STEEPEST, 0.0, slides)
