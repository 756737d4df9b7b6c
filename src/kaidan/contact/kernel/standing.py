"""A robot that stands while its posture changes: settled poses in turn, and how belts slide."""

from __future__ import annotations

import math

from kaidan.contact.codes import PartKind
from kaidan.contact.entries import entry
from kaidan.contact.kernel.contact_changes import settled
from kaidan.contact.kernel.energy_margins import work_out_energy
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.passings import where_of
from kaidan.contact.kernel.recording import record_pose
from kaidan.contact.kernel.settling import settle
from kaidan.contact.kernel.trigonometry import cos, sin
from kaidan.contact.layout import (
    PART_BITS,
    PART_MASK,
    Margin,
    Part,
    Pose,
    Pull,
    Scene,
    Slide,
    Touch,
)
from kaidan.contact.memory import Table

#: Upward part of the normal below which a contact holds no robot in its place: 45 degrees [1].
STEEPEST = 0.5 * math.sqrt(2.0)


def middle_of_tracks(body: Table[Part]) -> tuple[float, float]:
    """Middle of all discs of the tracks from the centroid, in the body frame [m]."""
    x = 0.0
    z = 0.0
    count = 0
    for k in range(len(body)):
        part = body[k]
        if part.kind == PartKind.TRACK:
            x += part.one.x + part.two.x
            z += part.one.z + part.two.z
            count += 2
    return x / count, z / count


@entry
def stand_in_turn(
    scene: Scene, parts: int, x: float, phi: float, pull: Pull, poses: Table[Pose],
    margins: Table[Margin],
) -> int:  # fmt: skip
    """Settle one posture after the other, with the tracks where they are along the ground.

    Parameters
    ----------
    scene, parts
        Terrain, and the robot in each posture, as many parts one below the other.
    x, phi
        Centroid [m] and inclination [rad] in the first posture.
    poses, margins
        To be filled, a row a posture.

    Returns
    -------
    number of postures in which the robot stands; the next one finds no stable pose
    """
    bodies = scene.body
    was_x, was_z = middle_of_tracks(bodies[0:parts])
    for k in range(len(poses)):
        scene.body = bodies[k * parts : (k + 1) * parts]
        along, above = middle_of_tracks(scene.body)
        track = x + cos(phi) * was_x - sin(phi) * was_z
        for _ in range(2):  # to first order in how far the robot turns
            x = track - cos(phi) * along + sin(phi) * above
            good, _, phi, _, _ = settle(scene, x, phi, 0.0)
            if not good:
                return k
        found, held = settled(scene, x, phi, 0.0)
        if not found:
            return k
        record_pose(scene, poses[k], 0.0, held, 0)
        pose_margins(scene, poses[k : k + 1], pull, margins[k : k + 1])
        work_out_energy(scene, poses[k], margins[k])
        x = poses[k].x
        phi = poses[k].inclination
        was_x = along
        was_z = above
    return len(poses)


def belt_slide(part: Part, then: Part, pose: Pose, next_pose: Pose, touch: Touch) -> float:
    """Way along the ground by which the belt at a contact moves ahead to the next pose [m].

    A part that is a disc turns with the robot.
    """
    if touch.n_z < STEEPEST:
        return 0.0
    at = where_of(pose)
    next_at = where_of(next_pose)
    # from the centre of the first disc to the contact, and that centre in the next pose
    arm_x = touch.x - (at.x + at.c * part.one.x - at.s * part.one.z)
    arm_z = touch.z - (at.z + at.s * part.one.x + at.c * part.one.z)
    to_x = next_at.x + next_at.c * then.one.x - next_at.s * then.one.z
    to_z = next_at.z + next_at.s * then.one.x + next_at.c * then.one.z
    # turn of the part within the robot, and with it
    turn_c = 1.0
    turn_s = 0.0
    if part.axis > 0.0:
        turn_c = part.e_x * then.e_x + part.e_z * then.e_z
        turn_s = part.e_x * then.e_z - part.e_z * then.e_x
    with_c = at.c * next_at.c + at.s * next_at.s
    with_s = at.c * next_at.s - at.s * next_at.c
    c = turn_c * with_c - turn_s * with_s
    s = turn_c * with_s + turn_s * with_c
    moved_x = to_x + c * arm_x - s * arm_z - touch.x
    moved_z = to_z + s * arm_x + c * arm_z - touch.z
    return moved_x * touch.n_z - moved_z * touch.n_x


@entry
def belt_slides(bodies: Table[Part], parts: int, poses: Table[Pose], slides: Table[Slide]) -> None:
    """Way along the ground by which the belts at both contacts move ahead, from pose to pose.

    Parameters
    ----------
    bodies, parts
        Parts of the robot in each pose one below the other, and how many each has.
    poses
        One a body.
    slides
        To be filled, a row for each pose but the last.
    """
    for k in range(len(poses) - 1):
        pose = poses[k]
        then = poses[k + 1]
        rear = parts * k + ((pose.rear.feature >> PART_BITS) & PART_MASK)
        front = parts * k + ((pose.front.feature >> PART_BITS) & PART_MASK)
        slides[k].rear = belt_slide(bodies[rear], bodies[rear + parts], pose, then, pose.rear)
        slides[k].front = belt_slide(bodies[front], bodies[front + parts], pose, then, pose.front)
