"""The rows of the tables that a drive fills: poses, events, rotations."""

from __future__ import annotations

import math

from kaidan.contact.kernel.gaps import gap, pressed_normal
from kaidan.contact.kernel.trigonometry import atan2, placed
from kaidan.contact.layout import Fallen, Held, Log, Pose, Release, RotationRow, Scene, Touch
from kaidan.contact.memory import Table


def record_touch(touch: Touch, feature: int, x: float, z: float, n_x: float, n_z: float) -> None:
    """Write a contact that carries a pose."""
    touch.feature = feature
    touch.x = x
    touch.z = z
    touch.n_x = n_x
    touch.n_z = n_z


def record_pose(scene: Scene, pose: Pose, s: float, held: Held, leg: int) -> None:
    """Write one pose, with its arclength and the number of its line of poses.

    Normals, and with them the direction of the path, are those of the belt as it gives way.
    """
    x, z, phi, t_x, t_z, _, rear, front = held
    at = placed(x, z, phi)
    _, m_x, m_z, p_x, p_z = gap(scene, rear, at)
    _, n_x, n_z, o_x, o_z = gap(scene, front, at)
    rear_x, rear_z = pressed_normal(scene, rear, at, m_x, m_z)
    front_x, front_z = pressed_normal(scene, front, at, n_x, n_z)
    if rear_x != m_x or rear_z != m_z or front_x != n_x or front_z != n_z:
        # the way on which both contacts stay closed
        arm_1 = (p_x - x) * rear_z - (p_z - z) * rear_x
        arm_2 = (o_x - x) * front_z - (o_z - z) * front_x
        u_x = rear_z * arm_2 - front_z * arm_1
        u_z = front_x * arm_1 - rear_x * arm_2
        ahead = math.copysign(1.0, u_x * t_x + u_z * t_z)
        t_x, t_z = ahead * u_x, ahead * u_z
    pose.s = s
    pose.x = x
    pose.z = z
    pose.inclination = phi
    record_touch(pose.rear, rear, p_x, p_z, rear_x, rear_z)
    record_touch(pose.front, front, o_x, o_z, front_x, front_z)
    speed = math.sqrt(t_x * t_x + t_z * t_z)
    pose.path_direction = atan2(t_z, t_x) if speed > 1e-12 else 0.0
    pose.leg = leg
    pose.rear_lean = atan2(m_x, m_z)


def keep_pose(scene: Scene, log: Log, held: Held) -> None:
    """Write a pose behind others, where poses are kept."""
    if log.keeps:
        record_pose(scene, log.poses[log.n_pose], log.s, held, log.leg)
        log.n_pose += 1


def write_event(log: Log, kind: int, held: Held, feature: int, other: int, pose: int) -> None:
    """Write one event behind others: what happens to which features, at which row of the poses."""
    event = log.events[log.n_event]
    event.kind = kind
    event.s = log.s
    event.x = held.x
    event.z = held.z
    event.inclination = held.phi
    event.feature = feature
    event.other = other
    event.pose = pose
    log.n_event += 1


def write_rotation(
    row: RotationRow, s: float, pivot: int, p_x: float, p_z: float, release: Release,
    fallen: Fallen,
) -> None:  # fmt: skip
    """Write one rotation about a contact at a place; what it could still do is added later."""
    row.sense = release.sense
    row.s = s
    row.pivot = pivot
    row.start.x = release.x
    row.start.z = release.z
    row.start.inclination = release.phi
    row.end.x = fallen.x
    row.end.z = fallen.z
    row.end.inclination = fallen.phi
    row.angle = fallen.angle
    row.rate_before = fallen.before
    row.rate_after = fallen.after
    row.outcome = fallen.outcome
    row.pivot_x = p_x
    row.pivot_z = p_z


def write_momentum(
    row: RotationRow, kinetic: float, needed: float, across: float, topples: bool
) -> None:
    """Write the energy after the last impact and the energy that toppling needs [J/kg].

    ``across`` is how far the centroid has moved across effective gravity where it needs that [m].
    """
    row.kinetic = kinetic
    row.barrier = needed
    row.barrier_across = across
    row.topples_with_momentum = topples


def repeats(rotations: Table[RotationRow], count: int) -> bool:
    """Whether the last rotation began as one of the twelve before it: rocking on the spot."""
    last = rotations[count - 1]
    for k in range(max(0, count - 12), count - 1):
        row = rotations[k]
        if (
            abs(row.start.x - last.start.x) < 1e-8
            and abs(row.start.inclination - last.start.inclination) < 1e-8
            and row.sense == last.sense
        ):
            return True
    return False
