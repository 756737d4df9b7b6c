"""A robot that stands while its posture changes: one settled pose after the other."""

from __future__ import annotations

import math

from kaidan.contact.columns import POSE_PHI, POSE_X
from kaidan.contact.entries import entry
from kaidan.contact.kernel.contact_changes import settled
from kaidan.contact.kernel.energy_margins import flow_energy
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.recording import record_pose
from kaidan.contact.kernel.settling import settle
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    FloatRow,
    GroundTable,
    IntArray,
    MarginTable,
    PoseTable,
)


def standing_pose(
    ground: GroundTable, body: BodyTable, x: float, phi: float, poses: PoseTable, row: int
) -> bool:
    """Write the pose in which the robot stands at centroid x, settled from an inclination."""
    found, at = settled(ground, body, x, phi, 0.0)
    if found:
        record_pose(ground, body, poses, row, 0.0, at, 0)
    return found


@entry
def stand_in_turn(
    ground: GroundTable,
    bodies: BodyTable,
    ends: IntArray,
    along: FloatRow,
    above: FloatRow,
    x: float,
    phi: float,
    g: float,
    touch: float,
    poses: PoseTable,
    margins: MarginTable,
    found: ContactTable,
    rows: IntArray,
) -> int:
    """Settle one posture after the other, with the tracks where they are along the ground.

    Parameters
    ----------
    ground, bodies, ends
        Ground table; body tables one below the other, and the row after the end of each.
    along, above
        Middle of the tracks from the centroid in each posture, in the body frame [m].
    x, phi
        Centroid [m] and inclination [rad] in the first posture.
    g, touch
        Gravity [m/s^2], gap of a contact [m].
    poses, margins
        To be filled, a row a posture.
    found, rows
        Scratch, see :func:`kaidan.contact.kernel.margins.pose_margins`; ``rows`` is a zero.

    Returns
    -------
    number of postures in which the robot stands; the next one finds no stable pose
    """
    was = 0
    count = 0
    for k in range(ends.shape[0]):
        first = 0
        if k > 0:
            first = ends[k - 1]
        body = bodies[first : ends[k]]
        track = x + math.cos(phi) * along[was] - math.sin(phi) * above[was]
        for _ in range(2):  # to first order in how far the robot turns
            x = track - math.cos(phi) * along[k] + math.sin(phi) * above[k]
            good, _, phi, _, _ = settle(ground, body, x, phi, 0.0)
            if not good:
                return count
        if not standing_pose(ground, body, x, phi, poses, k):
            return count
        here = poses[k : k + 1]
        own = margins[k : k + 1]
        pose_margins(ground, body, here, 1, 0.0, g, touch, own, found)
        flow_energy(ground, body, here, own, rows)
        x = poses[k, POSE_X]
        phi = poses[k, POSE_PHI]
        was = k
        count += 1
    return count
