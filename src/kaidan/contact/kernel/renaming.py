r"""Where a contact takes another name along a line of poses: the path bends, nothing closes.

::

         ,---.                     ,---.
        (  c  )                   (  c  )     disc on the face: normal that of the face
         `-+-'                 ---o`-+-'      disc on the corner: normal to the centre
     ------o      then                        the normal turns with the pose from here on
           |
           | face                  |

Normals and forces are continuous there, their changes are not. So it is where a corner comes from
under an end onto the flat, or leaves it.
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    CONVEX,
    DISC,
    DISC_X,
    DISC_Z,
    KIND_MASK,
    LENGTH,
    PART_BITS,
    PART_MASK,
    POINT_BITS,
    POSE_FRONT,
    POSE_LEG,
    POSE_PHI,
    POSE_REAR,
    POSE_S,
    POSE_X,
    POSE_Z,
    U_X,
    U_Z,
    VERTEX,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.continuation import ARM, distance, stepped, tangent
from kaidan.contact.kernel.event_location import moved_again, next_look
from kaidan.contact.kernel.gaps import FAR, flat_room, gap, on_flat
from kaidan.contact.kernel.recording import record_pose
from kaidan.contact.tables import BodyTable, FloatRow, GroundTable, Held, IntArray, PoseTable

#: How well the place is known [m]: a normal on an arc of 5 mm turns by 2e-7 rad in it.
PLACE = 1e-9
#: Room that counts at least where there is some, or none.
LEAST = 1e-12


def name_room(
    ground: GroundTable, body: BodyTable, feature: int, flat: bool,
    x: float, z: float, c: float, s: float,
) -> float:  # fmt: skip
    """How far a contact may run on before it takes another name, or leaves or meets the flat [m].

    Negative: it has run past. ``flat`` tells whether it was a vertex on the flat.
    """
    kind = feature & KIND_MASK
    part = (feature >> PART_BITS) & PART_MASK
    k = feature >> POINT_BITS
    if kind == VERTEX:
        on = flat_room(ground, body, feature, x, z, c, s)
        if flat:
            return on
        _, n_x, n_z, _, _ = gap(ground, body, feature, x, z, c, s)
        # the normal leans from that of the one segment to that of the other
        behind = n_x * ground[k - 1, U_X] + n_z * ground[k - 1, U_Z]
        return float(min(-on, behind, -(n_x * ground[k, U_X] + n_z * ground[k, U_Z])))
    j = DISC * (kind - 1)
    to_x = x + c * body[part, j + DISC_X] - s * body[part, j + DISC_Z] - ground[k, X]
    to_z = z + s * body[part, j + DISC_X] + c * body[part, j + DISC_Z] - ground[k, Z]
    foot = to_x * ground[k, U_X] + to_z * ground[k, U_Z]
    room = FAR
    if ground[k, CONVEX] == 1.0:
        room = foot
    if ground[k + 1, CONVEX] == 1.0:
        room = min(room, ground[k, LENGTH] - foot)
    return float(room)


def least_room(
    ground: GroundTable, body: BodyTable, rear: int, front: int, rear_on: bool, front_on: bool,
    x: float, z: float, c: float, s: float,
) -> float:  # fmt: skip
    """The smaller `name_room` of both contacts."""
    return min(
        name_room(ground, body, rear, rear_on, x, z, c, s),
        name_room(ground, body, front, front_on, x, z, c, s),
    )


def renaming(
    ground: GroundTable,
    body: BodyTable,
    rear: int,
    front: int,
    x: float,
    z: float,
    phi: float,
    t_x: float,
    t_z: float,
    t_w: float,
    ds: float,
    rear_on: bool,
    front_on: bool,
    near: float,
    far: float,
) -> float:
    """Arclength within a step at which a contact takes another name [m]: `PLACE` beyond it.

    Looked for as in :func:`kaidan.contact.kernel.event_location.closing_time`; ``near`` and ``far``
    are `least_room` at its begin and at its end, by the names at its begin.
    """
    lo = 0.0
    hi = ds
    near = max(near, LEAST)
    far = min(far, -LEAST)
    moved = 0
    for _ in range(60):
        if hi - lo < PLACE:
            break
        mid = next_look(lo, hi, near, far, moved)
        # aimed a hair off the place, so that the other end comes near it too
        beside = mid + 0.4 * PLACE if moved >= 0 else mid - 0.4 * PLACE
        if lo < beside and beside < hi:
            mid = beside
        good, x1, z1, _, c, s, _, _, _, new_rear, new_front = stepped(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, mid
        )
        if not good:
            break
        room = least_room(ground, body, rear, front, rear_on, front_on, x1, z1, c, s)
        before = (
            new_rear == rear
            and new_front == front
            and on_flat(ground, body, rear, x1, z1, c, s) == rear_on
            and on_flat(ground, body, front, x1, z1, c, s) == front_on
        )
        moved = moved_again(moved, before)
        if before:
            lo = mid
            near = max(room, LEAST)
            far *= 0.5 if moved > 1 else 1.0
        else:
            hi = mid
            far = min(room, -LEAST)
            near *= 0.5 if moved < -1 else 1.0
    return hi


def record_renamings(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    n_pose: int,
    path: float,
    at: Held,
    there: Held,
    ds: float,
    leg: int,
) -> tuple[int, float]:
    """Write the poses within a step at which a contact takes another name, or passes a flat's end.

    Parameters
    ----------
    at, there
        The pose at the begin of the step, and at its end.

    Returns
    -------
    poses written in all, and how far it is from pose to pose over the step [m]
    """
    x, z, phi, t_x, t_z, t_w, rear, front = at
    x1, z1, phi1, _, _, _, new_rear, new_front = there
    c1 = math.cos(phi1)
    s1 = math.sin(phi1)
    left = ds
    length = 0.0
    for _ in range(4):
        if n_pose >= poses.shape[0] - 2:
            break
        c = math.cos(phi)
        s = math.sin(phi)
        rear_on = on_flat(ground, body, rear, x, z, c, s)
        front_on = on_flat(ground, body, front, x, z, c, s)
        if (
            rear == new_rear
            and front == new_front
            and rear_on == on_flat(ground, body, rear, x1, z1, c1, s1)
            and front_on == on_flat(ground, body, front, x1, z1, c1, s1)
        ):
            break
        cut = renaming(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, left, rear_on, front_on,
            least_room(ground, body, rear, front, rear_on, front_on, x, z, c, s),
            least_room(ground, body, rear, front, rear_on, front_on, x1, z1, c1, s1),
        )  # fmt: skip
        if cut > left - 2.0 * PLACE:  # the pose at the end of the step is it
            break
        # found, as `renaming` has looked there
        _, x2, z2, phi2, _, _, u_x, u_z, u_w, rear2, front2 = stepped(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, cut
        )
        left -= cut
        length += distance(x, z, phi, x2, z2, phi2)
        x, z, phi, t_x, t_z, t_w, rear, front = x2, z2, phi2, u_x, u_z, u_w, rear2, front2
        now = (x, z, phi, t_x, t_z, t_w, rear, front)
        record_pose(ground, body, poses, n_pose, path + length, now, leg)
        n_pose += 1
    return n_pose, length + distance(x, z, phi, x1, z1, phi1)


@entry
def poses_between(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    rows: IntArray,
    shares: FloatRow,
    count: int,
    between: PoseTable,
) -> None:
    """Work out poses between two of a line of poses.

    Parameters
    ----------
    ground, body
        Tables.
    poses
        Table of :func:`kaidan.contact.kernel.driver.drive`.
    rows
        The first of each two.
    shares
        Of the arclength to the next (0 to 1).
    count
        How many.
    between
        Table of poses to be filled; short of them where the corrector fails.
    """
    for k in range(count):
        row = rows[k]
        x = poses[row, POSE_X]
        z = poses[row, POSE_Z]
        phi = poses[row, POSE_PHI]
        rear = int(poses[row, POSE_REAR])
        front = int(poses[row, POSE_FRONT])
        ds = shares[k] * (poses[row + 1, POSE_S] - poses[row, POSE_S])
        t_x, t_z, t_w, _ = tangent(ground, body, rear, front, x, z, math.cos(phi), math.sin(phi))
        onward = (poses[row + 1, POSE_X] - x) * t_x + (poses[row + 1, POSE_Z] - z) * t_z
        if onward + ARM * (poses[row + 1, POSE_PHI] - phi) * t_w < 0.0:
            t_x, t_z, t_w = -t_x, -t_z, -t_w
        left = ds
        step = ds
        for _ in range(20):
            if left <= PLACE or step <= PLACE:
                break
            good, x1, z1, phi1, _, _, u_x, u_z, u_w, new_rear, new_front = stepped(
                ground, body, rear, front, x, z, phi, t_x, t_z, t_w, min(step, left)
            )
            if good:
                left -= distance(x, z, phi, x1, z1, phi1)
                x, z, phi, t_x, t_z, t_w = x1, z1, phi1, u_x, u_z, u_w
                rear = new_rear
                front = new_front
            else:  # the path bends too much for the step
                step *= 0.5
        now = (x, z, phi, t_x, t_z, t_w, rear, front)
        record_pose(
            ground, body, between, k, poses[row, POSE_S] + ds - left, now,
            int(poses[row, POSE_LEG]),
        )  # fmt: skip
