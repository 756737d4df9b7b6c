"""The rows of the tables that a drive fills: poses, events, rotations."""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    BARRIER,
    BARRIER_ACROSS,
    END_PHI,
    END_X,
    END_Z,
    EVENT_FEATURE,
    EVENT_KIND,
    EVENT_OTHER,
    EVENT_PHI,
    EVENT_POSE,
    EVENT_S,
    EVENT_X,
    EVENT_Z,
    FRONT_N_X,
    FRONT_N_Z,
    FRONT_X,
    FRONT_Z,
    KINETIC,
    OUTCOME,
    PIVOT_X,
    PIVOT_Z,
    POSE_FRONT,
    POSE_LEG,
    POSE_PHI,
    POSE_PSI,
    POSE_REAR,
    POSE_S,
    POSE_X,
    POSE_Z,
    RATE_AFTER,
    RATE_BEFORE,
    REAR_LEAN,
    REAR_N_X,
    REAR_N_Z,
    REAR_X,
    REAR_Z,
    ROTATION_ANGLE,
    ROTATION_PIVOT,
    ROTATION_S,
    ROTATION_SENSE,
    START_PHI,
    START_X,
    START_Z,
    TOPPLES,
)
from kaidan.contact.kernel.gaps import gap, pressed_normal
from kaidan.contact.tables import (
    BodyTable,
    EventTable,
    GroundTable,
    Held,
    PoseTable,
    RotationTable,
)


def record_pose(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    row: int,
    path: float,
    at: Held,
    leg: int,
) -> None:
    """Write one pose: s, x, z, phi, rear, front, their points and normals, tangent, leg.

    Normals, and with them the direction of the path, are those of the belt as it gives way.
    """
    x, z, phi, t_x, t_z, _, rear, front = at
    c = math.cos(phi)
    s = math.sin(phi)
    _, m_x, m_z, p_x, p_z = gap(ground, body, rear, x, z, c, s)
    _, n_x, n_z, o_x, o_z = gap(ground, body, front, x, z, c, s)
    rear_x, rear_z = pressed_normal(ground, body, rear, x, z, c, s, m_x, m_z)
    front_x, front_z = pressed_normal(ground, body, front, x, z, c, s, n_x, n_z)
    if rear_x != m_x or rear_z != m_z or front_x != n_x or front_z != n_z:
        # the way on which both contacts stay closed
        arm_1 = (p_x - x) * rear_z - (p_z - z) * rear_x
        arm_2 = (o_x - x) * front_z - (o_z - z) * front_x
        u_x = rear_z * arm_2 - front_z * arm_1
        u_z = front_x * arm_1 - rear_x * arm_2
        ahead = math.copysign(1.0, u_x * t_x + u_z * t_z)
        t_x, t_z = ahead * u_x, ahead * u_z
    poses[row, POSE_S] = path
    poses[row, POSE_X] = x
    poses[row, POSE_Z] = z
    poses[row, POSE_PHI] = phi
    poses[row, POSE_REAR] = rear
    poses[row, POSE_FRONT] = front
    poses[row, REAR_X] = p_x
    poses[row, REAR_Z] = p_z
    poses[row, FRONT_X] = o_x
    poses[row, FRONT_Z] = o_z
    poses[row, REAR_N_X] = rear_x
    poses[row, REAR_N_Z] = rear_z
    poses[row, FRONT_N_X] = front_x
    poses[row, FRONT_N_Z] = front_z
    speed = math.sqrt(t_x * t_x + t_z * t_z)
    poses[row, POSE_PSI] = math.atan2(t_z, t_x) if speed > 1e-12 else 0.0
    poses[row, POSE_LEG] = leg
    poses[row, REAR_LEAN] = math.atan2(m_x, m_z)


def write_event(events: EventTable, row: int, code: int, path: float, at: Held, pose: int) -> None:
    """Write one event: code, s, x, z, phi, its two features, row of the pose."""
    x, z, phi, _, _, _, feature, other = at
    events[row, EVENT_KIND] = code
    events[row, EVENT_S] = path
    events[row, EVENT_X] = x
    events[row, EVENT_Z] = z
    events[row, EVENT_PHI] = phi
    events[row, EVENT_FEATURE] = feature
    events[row, EVENT_OTHER] = other
    events[row, EVENT_POSE] = pose


def write_rotation(
    rotations: RotationTable, row: int, sense: float, path: float, pivot: int,
    p_x: float, p_z: float, x: float, z: float, phi: float, x1: float, z1: float, phi1: float,
    angle: float, before: float, after: float, outcome: int,
) -> None:  # fmt: skip
    """Write one rotation; what it could still do is added by :func:`write_momentum`."""
    rotations[row, ROTATION_SENSE] = sense
    rotations[row, ROTATION_S] = path
    rotations[row, ROTATION_PIVOT] = pivot
    rotations[row, START_X] = x
    rotations[row, START_Z] = z
    rotations[row, START_PHI] = phi
    rotations[row, END_X] = x1
    rotations[row, END_Z] = z1
    rotations[row, END_PHI] = phi1
    rotations[row, ROTATION_ANGLE] = angle
    rotations[row, RATE_BEFORE] = before
    rotations[row, RATE_AFTER] = after
    rotations[row, OUTCOME] = outcome
    rotations[row, PIVOT_X] = p_x
    rotations[row, PIVOT_Z] = p_z


def write_momentum(
    rotations: RotationTable, row: int, kinetic: float, needed: float, across: float, topples: bool
) -> None:
    """Write the energy after the last impact and the energy that toppling needs [J/kg].

    ``across`` is how far the centroid has moved across effective gravity where it needs that [m].
    """
    rotations[row, KINETIC] = kinetic
    rotations[row, BARRIER] = needed
    rotations[row, BARRIER_ACROSS] = across
    rotations[row, TOPPLES] = 1.0 if topples else 0.0


def repeats(rotations: RotationTable, count: int) -> bool:
    """Whether the last rotation began as one of the twelve before it: rocking on the spot."""
    last = count - 1
    for row in range(max(0, count - 12), last):
        if (
            abs(rotations[row, START_X] - rotations[last, START_X]) < 1e-8
            and abs(rotations[row, START_PHI] - rotations[last, START_PHI]) < 1e-8
            and rotations[row, ROTATION_SENSE] == rotations[last, ROTATION_SENSE]
        ):
            return True
    return False
