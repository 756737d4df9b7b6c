"""A robot that stands while its posture changes: settled poses in turn, and how belts slide."""

from __future__ import annotations

import math

from kaidan.contact.codes import PartKind
from kaidan.contact.columns import (
    AXIS,
    E_X,
    E_Z,
    FRONT_N_X,
    FRONT_N_Z,
    FRONT_X,
    FRONT_Z,
    KIND,
    PART_BITS,
    PART_MASK,
    POSE_FRONT,
    POSE_PHI,
    POSE_REAR,
    POSE_X,
    POSE_Z,
    REAR_N_X,
    REAR_N_Z,
    REAR_X,
    REAR_Z,
    X1,
    X2,
    Z1,
    Z2,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.contact_changes import settled
from kaidan.contact.kernel.energy_margins import flow_energy
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.recording import record_pose
from kaidan.contact.kernel.settling import settle
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    GroundTable,
    IntArray,
    MarginTable,
    PointTable,
    PoseTable,
)

#: Upward part of the normal below which a contact holds no robot in its place: 45 degrees [1].
STEEPEST = 0.5 * math.sqrt(2.0)


def standing_pose(
    ground: GroundTable, body: BodyTable, x: float, phi: float, poses: PoseTable, row: int
) -> bool:
    """Write the pose in which the robot stands at centroid x, settled from an inclination."""
    found, at = settled(ground, body, x, phi, 0.0)
    if found:
        record_pose(ground, body, poses, row, 0.0, at, 0)
    return found


def middle_of_tracks(body: BodyTable) -> tuple[float, float]:
    """Middle of all discs of the tracks from the centroid, in the body frame [m]."""
    x = 0.0
    z = 0.0
    count = 0
    for part in range(body.shape[0]):
        if int(body[part, KIND]) == PartKind.TRACK:
            x += body[part, X1] + body[part, X2]
            z += body[part, Z1] + body[part, Z2]
            count += 2
    return x / count, z / count


@entry
def stand_in_turn(
    ground: GroundTable,
    bodies: BodyTable,
    ends: IntArray,
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
    count = 0
    was_x = 0.0
    was_z = 0.0
    for k in range(ends.shape[0]):
        first = 0
        if k > 0:
            first = ends[k - 1]
        body = bodies[first : ends[k]]
        along, above = middle_of_tracks(body)
        if k == 0:
            was_x = along
            was_z = above
        track = x + math.cos(phi) * was_x - math.sin(phi) * was_z
        for _ in range(2):  # to first order in how far the robot turns
            x = track - math.cos(phi) * along + math.sin(phi) * above
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
        was_x = along
        was_z = above
        count += 1
    return count


def belt_slide(
    bodies: BodyTable, row: int, then: int, poses: PoseTable, k: int, x: int, z: int, n_x: int,
    n_z: int,
) -> float:  # fmt: skip
    """Way along the ground by which the belt at a contact moves ahead to the next pose [m].

    A part that is a disc turns with the robot.

    Parameters
    ----------
    bodies, row, then
        Body tables, the row of the part that stands there and of the same part in the next pose.
    poses, k
        The pose.
    x, z, n_x, n_z
        Columns of the contact and of its normal.
    """
    if poses[k, n_z] < STEEPEST:
        return 0.0
    c0 = math.cos(poses[k, POSE_PHI])
    s0 = math.sin(poses[k, POSE_PHI])
    c1 = math.cos(poses[k + 1, POSE_PHI])
    s1 = math.sin(poses[k + 1, POSE_PHI])
    # from the centre of the first disc to the contact, and that centre in the next pose
    arm_x = poses[k, x] - (poses[k, POSE_X] + c0 * bodies[row, X1] - s0 * bodies[row, Z1])
    arm_z = poses[k, z] - (poses[k, POSE_Z] + s0 * bodies[row, X1] + c0 * bodies[row, Z1])
    to_x = poses[k + 1, POSE_X] + c1 * bodies[then, X1] - s1 * bodies[then, Z1]
    to_z = poses[k + 1, POSE_Z] + s1 * bodies[then, X1] + c1 * bodies[then, Z1]
    # turn of the part within the robot, and with it
    turn_c = 1.0
    turn_s = 0.0
    if bodies[row, AXIS] > 0.0:
        turn_c = bodies[row, E_X] * bodies[then, E_X] + bodies[row, E_Z] * bodies[then, E_Z]
        turn_s = bodies[row, E_X] * bodies[then, E_Z] - bodies[row, E_Z] * bodies[then, E_X]
    with_c = c0 * c1 + s0 * s1
    with_s = c0 * s1 - s0 * c1
    c = turn_c * with_c - turn_s * with_s
    s = turn_c * with_s + turn_s * with_c
    moved_x = to_x + c * arm_x - s * arm_z - poses[k, x]
    moved_z = to_z + s * arm_x + c * arm_z - poses[k, z]
    return float(moved_x * poses[k, n_z] - moved_z * poses[k, n_x])


@entry
def belt_slides(bodies: BodyTable, size: int, poses: PoseTable, slides: PointTable) -> None:
    """Way along the ground by which the belts at both contacts move ahead, from pose to pose.

    Parameters
    ----------
    bodies, size
        Body tables of each pose one below the other, and the number of parts of each.
    poses
        One a body.
    slides
        To be filled, a row for each pose but the last: at the rear and at the front contact [m].
    """
    for k in range(poses.shape[0] - 1):
        rear = size * k + ((int(poses[k, POSE_REAR]) >> PART_BITS) & PART_MASK)
        front = size * k + ((int(poses[k, POSE_FRONT]) >> PART_BITS) & PART_MASK)
        slides[k, 0] = belt_slide(
            bodies, rear, rear + size, poses, k, REAR_X, REAR_Z, REAR_N_X, REAR_N_Z
        )
        slides[k, 1] = belt_slide(
            bodies, front, front + size, poses, k, FRONT_X, FRONT_Z, FRONT_N_X, FRONT_N_Z
        )
