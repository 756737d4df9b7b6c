"""The robot driven from one x to another: lines of stable poses, rotations between them, events."""

from __future__ import annotations

import math

from kaidan.contact.codes import Advance, Event, RotationOutcome, Status
from kaidan.contact.columns import DISC_1, KIND_MASK, NO_FEATURE, POSE_S
from kaidan.contact.entries import entry
from kaidan.contact.kernel.advance import advance, thinnest_radius
from kaidan.contact.kernel.contact_changes import (
    effective_gravity,
    exchanged,
    onset,
    rotate,
    settled,
    settled_again,
)
from kaidan.contact.kernel.continuation import tangent, tilt
from kaidan.contact.kernel.gaps import relabelled
from kaidan.contact.kernel.recording import record_pose, repeats, write_event
from kaidan.contact.kernel.renaming import record_renamings
from kaidan.contact.kernel.toppling import same_place
from kaidan.contact.tables import (
    BodyTable,
    EventTable,
    GroundTable,
    Held,
    PoseTable,
    RotationTable,
)

#: Steps that lead nowhere before the robot counts as stuck.
IDLE = 20
#: Inclination at which it has fallen, and how nearly a step is cut there [rad].
UPRIGHT = 0.5 * math.pi
NEARLY = 1e-4
#: Times that the robot may be settled again.
FAILURES = 50
#: No status: the drive goes on after a rotation.
GOES_ON = -1


def end_of_fall(outcome: int, sense: float) -> tuple[int, int]:
    """Status and event of a rotation that no contact arrests."""
    if outcome == RotationOutcome.PAST_VERTICAL or outcome == RotationOutcome.ROCKING:
        if sense < 0.0:
            return Status.FELL_FORWARD, Event.FELL_FORWARD
        return Status.FELL_BACKWARD, Event.FELL_BACKWARD
    if outcome == RotationOutcome.ENDLESS:
        return Status.NOT_CONVERGED, Event.STUCK
    return Status.STUCK, Event.STUCK


def step_on(
    ground: GroundTable, body: BodyTable, at: Held, x_end: float, step: float, thinnest: float,
    a: float, g: float, kappa_g: float, hint: int,
) -> tuple[int, Held, int, float, bool]:  # fmt: skip
    """One step, cut where the robot arrives or is driven upright: linear in the step.

    Returns
    -------
    outcome, pose, hint, step taken [m]
        As :func:`kaidan.contact.kernel.advance.advance`.
    ends
        Whether it comes to ``x_end``.
    """
    what, there, hint, ds = advance(ground, body, at, step, thinnest, a, g, kappa_g, hint)
    ends = there[0] >= x_end and at[0] < x_end
    if ends and ds > 1e-9:
        part = (x_end - at[0]) / (there[0] - at[0])
        if part < 1.0:
            what, there, hint, ds = advance(
                ground, body, at, ds * part, thinnest, a, g, kappa_g, hint
            )
    if abs(there[2]) > UPRIGHT > abs(at[2]):
        part = (UPRIGHT - abs(at[2])) / (abs(there[2]) - abs(at[2]))
        what, there, hint, ds = advance(ground, body, at, ds * part, thinnest, a, g, kappa_g, hint)
        ends = there[0] >= x_end and at[0] < x_end
    return what, there, hint, ds, ends


def kept_pose(
    ground: GroundTable, body: BodyTable, poses: PoseTable, n_pose: int, path: float, at: Held,
    leg: int, kept: bool,
) -> int:  # fmt: skip
    """Write a pose behind others, where poses are kept; number of poses written."""
    if not kept:
        return n_pose
    record_pose(ground, body, poses, n_pose, path, at, leg)
    return n_pose + 1


def exchange(
    ground: GroundTable, body: BodyTable, made: int, at: Held, kappa: float, kept: bool,
    path: float, leg: int, poses: PoseTable, n_pose: int, events: EventTable, n_event: int,
) -> tuple[bool, Held, int, int]:  # fmt: skip
    """Exchange a contact for another that has closed, and write that down.

    Parameters
    ----------
    kept
        As for `drive`.

    Returns
    -------
    good, pose, poses written, events written
    """
    good, lost, at = exchanged(ground, body, made, at, kappa)
    if not good:
        return False, at, n_pose, n_event
    x, z, phi, t_x, t_z, t_w, rear, _ = at
    if same_place(ground, body, made, lost, x, z, phi):
        # one contact by the name of the part that carries from here on
        kept_pose(ground, body, poses, n_pose - 1, path, at, leg, kept)
        return True, at, n_pose, n_event
    # the same pose with its new contacts: the forces jump here
    now = kept_pose(ground, body, poses, n_pose, path, at, leg, kept)
    code = Event.TAIL_RESTS if made & KIND_MASK == DISC_1 and made == rear else Event.MADE
    write_event(events, n_event, code, path, (x, z, phi, t_x, t_z, t_w, made, lost), n_pose)
    write_event(
        events, n_event + 1, Event.LOST, path, (x, z, phi, t_x, t_z, t_w, lost, made), n_pose
    )
    return True, at, now, n_event + 2


def rotate_on(
    ground: GroundTable, body: BodyTable, at: Held, sense: float, kappa: float,
    gyration: float, gravity: float, kept: bool, path: float, leg: int, hint: int,
    poses: PoseTable, n_pose: int, events: EventTable, n_event: int,
    rotations: RotationTable, n_rotation: int,
) -> tuple[int, Held, int, int, int, int]:  # fmt: skip
    """Rotate until two contacts hold the robot again, or it falls; and write that down.

    Parameters
    ----------
    kept
        As for `drive`.
    leg
        Line of poses after the rotation.

    Returns
    -------
    status
        `GOES_ON`, or the `Status` with which the drive ends.
    pose, poses written, events written, rotations written, hint
    """
    x, z, phi, t_x, t_z, t_w, rear, front = at
    pivot = rear if sense > 0.0 else front
    outcome, new_rear, new_front, x1, z1, phi1, angle, count, hint = rotate(
        ground, body, pivot, x, z, phi, sense, kappa, gyration, gravity, kept, path,
        rotations, n_rotation, hint,
    )  # fmt: skip
    if count > n_rotation:
        code: int = Event.TIPS_BACK if sense > 0.0 else Event.NOSE_DROPS
        about = (x, z, phi, t_x, t_z, t_w, pivot, rear)
        write_event(events, n_event, code, path, about, n_pose - 1)
        n_event += 1
    if outcome != RotationOutcome.ARRESTED:
        status, code = end_of_fall(outcome, sense)
        about = (x1, z1, phi1, t_x, t_z, t_w, pivot, NO_FEATURE)
        write_event(events, n_event, code, path, about, n_pose - 1)
        return status, about, n_pose, n_event + 1, count, hint
    c = math.cos(phi1)
    s = math.sin(phi1)
    rear = relabelled(ground, body, new_rear, x1, z1, c, s)
    front = relabelled(ground, body, new_front, x1, z1, c, s)
    t_x, t_z, t_w, size = tangent(ground, body, rear, front, x1, z1, c, s)
    at = (x1, z1, phi1, t_x, t_z, t_w, rear, front)
    if size == 0.0:
        return Status.NOT_CONVERGED, at, n_pose, n_event, count, hint
    now = kept_pose(ground, body, poses, n_pose, path, at, leg, kept)
    if angle > 1e-7:
        write_event(events, n_event, Event.ARRESTED, path, at, n_pose)
        n_event += 1
        if repeats(rotations, count):
            write_event(events, n_event, Event.STUCK, path, at, n_pose)
            return Status.STUCK, at, now, n_event + 1, count, hint
    return GOES_ON, at, now, n_event, count, hint


@entry
def drive(
    ground: GroundTable,
    body: BodyTable,
    x_start: float,
    x_end: float,
    phi_start: float,
    step: float,
    a: float,
    g: float,
    kappa_g: float,
    gyration: float,
    kept: bool,
    poses: PoseTable,
    events: EventTable,
    rotations: RotationTable,
) -> tuple[int, int, int, int]:
    """Drive from ``x_start`` to ``x_end`` (centroid), writing into the three tables.

    Parameters
    ----------
    ground, body
        Tables.
    x_start, x_end
        Centroid at start and end [m], ``x_end`` > ``x_start``.
    phi_start
        Inclination from which the robot settles at the start [rad].
    step
        Arclength between poses [m].
    a, g
        Acceleration along the path of the centroid, gravity [m/s^2].
    kappa_g
        Tilt of gravity itself: its horizontal part backward over its vertical part g.
    gyration
        Radius of gyration about the centroid [m], for the energy of rotations.
    kept
        Whether poses are written down, and what the momentum of a rotation can still do: without
        them a drive tells no more than how it ends.
    poses, events, rotations
        Tables of :func:`kaidan.contact.tables.path_tables`; columns in
        :mod:`kaidan.contact.columns`, meanings in :mod:`kaidan.contact.records`.

    Returns
    -------
    status, poses written, events written, rotations written
    """
    # the path at the start is taken to run along the inclination given
    kappa = tilt(a, g, kappa_g, math.cos(phi_start), math.sin(phi_start))
    good, at = settled(ground, body, x_start, phi_start, kappa)
    if not good:
        return Status.NO_START, 0, 0, 0
    thinnest = thinnest_radius(body)
    path = 0.0
    leg = 0
    hint = 0
    n_pose = kept_pose(ground, body, poses, 0, path, at, leg, kept)
    n_event = 0
    n_rotation = 0
    idle = 0
    failures = 0
    for _ in range(30 * poses.shape[0]):
        if n_pose >= poses.shape[0] - 2 or n_event >= events.shape[0] - 4:
            break
        what, there, hint, ds, ends = step_on(
            ground, body, at, x_end, step, thinnest, a, g, kappa_g, hint
        )
        if what == Advance.NOT_CONVERGED:
            failures += 1
            good, nudge, at = settled_again(ground, body, at, kappa)
            if not good or failures > FAILURES:
                return Status.NOT_CONVERGED, n_pose, n_event, n_rotation
            path += abs(nudge)
            write_event(events, n_event, Event.RESETTLED, path, at, n_pose - 1)
            n_event += 1
            continue
        moved = ds
        if kept:
            n_pose, moved = record_renamings(ground, body, poses, n_pose, path, at, there, ds, leg)
        at = there
        path += moved
        if ends and (what == Advance.NOTHING or at[0] >= x_end - 1e-9):
            n_pose = kept_pose(ground, body, poses, n_pose, path, at, leg, kept)
            if at[0] >= x_end - 1e-7:
                write_event(events, n_event, Event.ARRIVED, path, at, n_pose - 1)
                return Status.OK, n_pose, n_event + 1, n_rotation
            continue
        idle = 0 if ds > 1e-10 else idle + 1
        if idle > IDLE:
            write_event(events, n_event, Event.STUCK, path, at, n_pose - 1)
            return Status.STUCK, n_pose, n_event + 1, n_rotation
        upright = abs(at[2]) > UPRIGHT - NEARLY
        if kept and (
            upright or what != Advance.NOTHING or path - poses[n_pose - 1, POSE_S] > 0.7 * step
        ):
            n_pose = kept_pose(ground, body, poses, n_pose, path, at, leg, kept)
        if upright:
            status, code = end_of_fall(RotationOutcome.PAST_VERTICAL, at[2])
            write_event(events, n_event, code, path, at, n_pose - 1)
            return status, n_pose, n_event + 1, n_rotation
        if what == Advance.NOTHING:
            continue
        kappa = tilt(a, g, kappa_g, at[3], at[4])
        sense = 1.0 if what == Advance.OVER_REAR else -1.0
        if what >= 0:
            good, at, n_pose, n_event = exchange(
                ground, body, what, at, kappa, kept, path, leg, poses, n_pose, events, n_event
            )
            if not good:
                return Status.NOT_CONVERGED, n_pose, n_event, n_rotation
            kappa = tilt(a, g, kappa_g, at[3], at[4])
            sense = onset(ground, body, at, kappa)
            if sense == 0.0:
                continue
        if n_rotation >= rotations.shape[0]:
            break
        leg += 1
        status, at, n_pose, n_event, n_rotation, hint = rotate_on(
            ground, body, at, sense, kappa, gyration, effective_gravity(a, g, at[3], at[4]),
            kept, path, leg, hint, poses, n_pose, events, n_event, rotations, n_rotation,
        )  # fmt: skip
        if status != GOES_ON:
            return status, n_pose, n_event, n_rotation
        if at[0] >= x_end:  # the rotation carried it there
            write_event(events, n_event, Event.ARRIVED, path, at, n_pose - 1)
            return Status.OK, n_pose, n_event + 1, n_rotation
    return Status.TOO_LONG, n_pose, n_event, n_rotation
