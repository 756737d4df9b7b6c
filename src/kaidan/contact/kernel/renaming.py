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

from kaidan.contact.entries import entry
from kaidan.contact.kernel.continuation import ARM, distance, stepped, tangent
from kaidan.contact.kernel.event_location import moved_again, next_look
from kaidan.contact.kernel.gaps import FAR, centre_of, disc_of, flat_room, gap, on_flat
from kaidan.contact.kernel.recording import record_pose
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import (
    KIND_MASK,
    POINT_BITS,
    VERTEX,
    At,
    Held,
    Log,
    Pose,
    Scene,
)
from kaidan.contact.memory import Row, Table

#: How well the place is known [m]: a normal on an arc of 5 mm turns by 2e-7 rad in it.
PLACE = 1e-9
#: Room that counts at least where there is some, or none.
LEAST = 1e-12


def name_room(scene: Scene, feature: int, flat: bool, at: At) -> float:
    """How far a contact may run on before it takes another name, or leaves or meets the flat [m].

    Negative: it has run past. ``flat`` tells whether it was a vertex on the flat.
    """
    ground = scene.ground
    k = feature >> POINT_BITS
    point = ground[k]
    if feature & KIND_MASK == VERTEX:
        on = flat_room(scene, feature, at)
        if flat:
            return on
        _, n_x, n_z, _, _ = gap(scene, feature, at)
        # the normal leans from that of the one segment to that of the other
        behind = n_x * ground[k - 1].u_x + n_z * ground[k - 1].u_z
        return min(-on, behind, -(n_x * point.u_x + n_z * point.u_z))
    c_x, c_z = centre_of(disc_of(scene, feature), at)
    foot = (c_x - point.x) * point.u_x + (c_z - point.z) * point.u_z
    room = foot if point.convex else FAR
    if ground[k + 1].convex:
        room = min(room, point.length - foot)
    return room


def least_room(scene: Scene, held: Held, rear_on: bool, front_on: bool, at: At) -> float:
    """The smaller `name_room` of both contacts of a pose, where the body is elsewhere."""
    return min(name_room(scene, held.rear, rear_on, at), name_room(scene, held.front, front_on, at))


def renaming(
    scene: Scene, held: Held, ds: float, rear_on: bool, front_on: bool, near: float, far: float
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
        good, there, at = stepped(scene, held, mid)
        if not good:
            break
        room = least_room(scene, held, rear_on, front_on, at)
        before = (
            there.rear == held.rear
            and there.front == held.front
            and on_flat(scene, held.rear, at) == rear_on
            and on_flat(scene, held.front, at) == front_on
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


def record_renamings(scene: Scene, log: Log, held: Held, there: Held, ds: float) -> float:
    """Write the poses within a step at which a contact takes another name, or passes a flat's end.

    how far it is from pose to pose over the step [m].
    """
    now = held
    at1 = placed(there.x, there.z, there.phi)
    left = ds
    length = 0.0
    for _ in range(4):
        if log.n_pose >= len(log.poses) - 2:
            break
        at = placed(now.x, now.z, now.phi)
        rear_on = on_flat(scene, now.rear, at)
        front_on = on_flat(scene, now.front, at)
        if (
            now.rear == there.rear
            and now.front == there.front
            and rear_on == on_flat(scene, now.rear, at1)
            and front_on == on_flat(scene, now.front, at1)
        ):
            break
        near = least_room(scene, now, rear_on, front_on, at)
        far = least_room(scene, now, rear_on, front_on, at1)
        cut = renaming(scene, now, left, rear_on, front_on, near, far)
        if cut > left - 2.0 * PLACE:  # the pose at the end of the step is it
            break
        # found, as `renaming` has looked there
        _, then, _ = stepped(scene, now, cut)
        left -= cut
        length += distance(now, then)
        now = then
        record_pose(scene, log.poses[log.n_pose], log.s + length, now, log.leg)
        log.n_pose += 1
    return length + distance(now, there)


@entry
def poses_between(
    scene: Scene, poses: Table[Pose], rows: Row[int], shares: Row[float], between: Table[Pose]
) -> None:
    """Work out poses between two of a line of poses.

    poses: of :func:`kaidan.contact.kernel.driver.drive`.
    rows: the first of each two.
    shares: of the arclength to the next (0 to 1).
    between: to be filled; short of them where the corrector fails.
    """
    for k in range(len(rows)):
        pose = poses[rows[k]]
        then = poses[rows[k] + 1]
        rear = pose.rear.feature
        front = pose.front.feature
        ds = shares[k] * (then.s - pose.s)
        at = placed(pose.x, pose.z, pose.inclination)
        t_x, t_z, t_w, _ = tangent(scene, rear, front, at)
        onward = (then.x - pose.x) * t_x + (then.z - pose.z) * t_z
        if onward + ARM * (then.inclination - pose.inclination) * t_w < 0.0:
            t_x, t_z, t_w = -t_x, -t_z, -t_w
        held = Held(pose.x, pose.z, pose.inclination, t_x, t_z, t_w, rear, front)
        left = ds
        step = ds
        for _ in range(20):
            if left <= PLACE or step <= PLACE:
                break
            good, there, _ = stepped(scene, held, min(step, left))
            if good:
                left -= distance(held, there)
                held = there
            else:  # the path bends too much for the step
                step *= 0.5
        record_pose(scene, between[k], pose.s + ds - left, held, pose.leg)
