r"""How far behind the drawn pose a robot may stand once its flippers have moved.

::

     before   o=====o        after   o==.           the tip slides over the ground as it comes
              .-----'  flipper           '.  flipper  down, or the tracks do, or both in part:
     ---------'                ---------'  o         which of them it is, friction decides

The tracks are drawn where they are along the ground. But the distance between what the robot stands
on changes as its flippers turn, so that one of its two contacts slides, whichever friction holds
less. The drawn poses are one way between two: either contact may be the one that stays.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.contact import Contact, Feature, Placement
from kaidan.outline import Outline

STEEPEST = 0.5 * np.sqrt(2.0)
"""Upward part of the normal below which a contact holds no robot in its place: 45 degrees [1]."""

Vector = NDArray[np.float64]


def drift(path: contact.Path, outlines: Sequence[Outline]) -> float:
    """Distance by which it may stand behind where it is drawn [m], at least zero.

    Parameters
    ----------
    path : contact.Path
        A pose for each posture.
    outlines : sequence of Outline
        In each posture, x towards the leading end.
    """
    poses = path.poses
    slid = np.zeros(2)
    for row in range(len(poses) - 1):
        was, new = poses.placement(row), poses.placement(row + 1)
        for k, each in enumerate(path.carrying(row)):
            slid[k] += _slides(each, outlines[row], was, outlines[row + 1], new)
    return float(max(0.0, *slid))


def _slides(
    held: Contact, before: Outline, was: Placement, after: Outline, new: Placement
) -> float:
    """Way along the ground by which the belt at a contact moves ahead [m]."""
    n_x, n_z = held.normal
    if n_z < STEEPEST:
        return 0.0
    part = Feature.of(held.feature).part
    one, two = _discs(before, part, was), _discs(after, part, new)
    turn = _direction(two, new) - _direction(one, was)
    c, s = np.cos(turn), np.sin(turn)
    d_x, d_z = np.array(held.point) - one[0]
    point = two[0] + [c * d_x - s * d_z, s * d_x + c * d_z]
    return float((point - held.point) @ [n_z, -n_x])


def _discs(outline: Outline, part: int, place: Placement) -> Vector:
    """Centres of both discs of a part (2, 2) [m]."""
    c, s = np.cos(place.inclination), np.sin(place.inclination)
    centres = outline.parts[part].reshape(2, 3)[:, :2]
    return np.asarray(np.array([place.x, place.z]) + centres @ np.array([[c, s], [-s, c]]))


def _direction(centres: Vector, place: Placement) -> float:
    """Inclination of a part; of one that is a disc, the robot's [rad]."""
    along = centres[1] - centres[0]
    return float(np.arctan2(along[1], along[0])) if along.any() else place.inclination
