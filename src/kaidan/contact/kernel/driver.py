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
    settled_again,
)
from kaidan.contact.kernel.continuation import tangent, tilt
from kaidan.contact.kernel.gaps import relabelled
from kaidan.contact.kernel.recording import record_pose, repeats, write_event
from kaidan.contact.kernel.renaming import record_renamings
from kaidan.contact.kernel.settling import settle
from kaidan.contact.kernel.toppling import same_place
from kaidan.contact.tables import BodyTable, EventTable, GroundTable, PoseTable, RotationTable

#: Steps that lead nowhere before the robot counts as stuck.
IDLE = 20
#: Inclination at which it has fallen, and how nearly a step is cut there [rad].
UPRIGHT = 0.5 * math.pi
NEARLY = 1e-4
#: Times that the robot may be settled again.
FAILURES = 50


def end_of_fall(outcome: int, sense: float) -> tuple[int, int]:
    """Status and event of a rotation that no contact arrests."""
    if outcome == RotationOutcome.PAST_VERTICAL or outcome == RotationOutcome.ROCKING:
        if sense < 0.0:
            return Status.FELL_FORWARD, Event.FELL_FORWARD
        return Status.FELL_BACKWARD, Event.FELL_BACKWARD
    if outcome == RotationOutcome.ENDLESS:
        return Status.NOT_CONVERGED, Event.STUCK
    return Status.STUCK, Event.STUCK


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
    poses, events, rotations
        Tables of :func:`kaidan.contact.tables.path_tables`; columns in
        :mod:`kaidan.contact.columns`, meanings in :mod:`kaidan.contact.records`.

    Returns
    -------
    status, poses written, events written, rotations written
    """
    # the path at the start is taken to run along the inclination given
    kappa = tilt(a, g, kappa_g, math.cos(phi_start), math.sin(phi_start))
    found, z, phi, rear, front = settle(ground, body, x_start, phi_start, kappa)
    if not found or rear == front:
        return Status.NO_START, 0, 0, 0
    x = x_start
    t_x, t_z, t_w, size = tangent(ground, body, rear, front, x, z, math.cos(phi), math.sin(phi))
    if size == 0.0:
        return Status.NO_START, 0, 0, 0
    thinnest = thinnest_radius(body)
    path = 0.0
    leg = 0
    hint = 0
    record_pose(ground, body, poses, 0, path, x, z, phi, rear, front, t_x, t_z, t_w, leg)
    n_pose = 1
    n_event = 0
    n_rotation = 0
    idle = 0
    failures = 0
    for _ in range(30 * poses.shape[0]):
        if n_pose >= poses.shape[0] - 2 or n_event >= events.shape[0] - 4:
            return Status.TOO_LONG, n_pose, n_event, n_rotation
        what, x1, z1, phi1, u_x, u_z, u_w, r1, f1, hint, ds = advance(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, step, thinnest, a, g, kappa_g, hint
        )
        ends = x1 >= x_end and x < x_end
        if ends and ds > 1e-9:
            # cut at the end, linear in the step: the pose itself stays on the line
            part = (x_end - x) / (x1 - x)
            if part < 1.0:
                what, x1, z1, phi1, u_x, u_z, u_w, r1, f1, hint, ds = advance(
                    ground, body, rear, front, x, z, phi, t_x, t_z, t_w, ds * part, thinnest,
                    a, g, kappa_g, hint,
                )  # fmt: skip
        if what == Advance.NOTHING and abs(phi1) > UPRIGHT:
            # it is driven upright: cut there, linear in the step
            part = (UPRIGHT - abs(phi)) / (abs(phi1) - abs(phi))
            what, x1, z1, phi1, u_x, u_z, u_w, r1, f1, hint, ds = advance(
                ground, body, rear, front, x, z, phi, t_x, t_z, t_w, ds * part, thinnest,
                a, g, kappa_g, hint,
            )  # fmt: skip
            ends = x1 >= x_end and x < x_end
        if what == Advance.NOT_CONVERGED:
            failures += 1
            found, nudge, z, phi, rear, front, t_x, t_z, t_w = settled_again(
                ground, body, x, z, phi, kappa, t_x, t_z, t_w
            )
            if not found or failures > FAILURES:
                return Status.NOT_CONVERGED, n_pose, n_event, n_rotation
            x += nudge
            path += abs(nudge)
            write_event(events, n_event, Event.RESETTLED, path, x, z, phi, rear, front, n_pose - 1)
            n_event += 1
            continue
        n_pose, moved = record_renamings(
            ground, body, poses, n_pose, path, x, z, phi, t_x, t_z, t_w, rear, front, r1, f1,
            x1, z1, phi1, ds, leg,
        )  # fmt: skip
        x, z, phi = x1, z1, phi1
        t_x, t_z, t_w, rear, front = u_x, u_z, u_w, r1, f1
        path += moved
        if ends and (what == Advance.NOTHING or x >= x_end - 1e-9):
            record_pose(
                ground, body, poses, n_pose, path, x, z, phi, rear, front, t_x, t_z, t_w, leg
            )
            n_pose += 1
            if x >= x_end - 1e-7:
                write_event(
                    events, n_event, Event.ARRIVED, path, x, z, phi, rear, front, n_pose - 1
                )
                return Status.OK, n_pose, n_event + 1, n_rotation
            continue
        if ds > 1e-10:
            idle = 0
        else:
            idle += 1
            if idle > IDLE:
                write_event(events, n_event, Event.STUCK, path, x, z, phi, rear, front, n_pose - 1)
                return Status.STUCK, n_pose, n_event + 1, n_rotation
        upright = abs(phi) > UPRIGHT - NEARLY
        if upright or what != Advance.NOTHING or path - poses[n_pose - 1, POSE_S] > 0.7 * step:
            record_pose(
                ground, body, poses, n_pose, path, x, z, phi, rear, front, t_x, t_z, t_w, leg
            )
            n_pose += 1
        if upright:
            status, code = end_of_fall(RotationOutcome.PAST_VERTICAL, phi)
            write_event(events, n_event, code, path, x, z, phi, rear, front, n_pose - 1)
            return status, n_pose, n_event + 1, n_rotation
        if what == Advance.NOTHING:
            continue
        kappa = tilt(a, g, kappa_g, t_x, t_z)
        if what >= 0:
            good, rear, front, lost, x, z, phi, t_x, t_z, t_w = exchanged(
                ground, body, what, rear, front, x, z, phi, kappa, t_x, t_z, t_w
            )
            if not good:
                return Status.NOT_CONVERGED, n_pose, n_event, n_rotation
            if same_place(ground, body, what, lost, x, z, phi):
                # one contact by the name of the part that carries from here on
                record_pose(
                    ground, body, poses, n_pose - 1, path, x, z, phi, rear, front, t_x, t_z, t_w,
                    leg,
                )  # fmt: skip
            else:
                # the same pose with its new contacts: the forces jump here
                record_pose(
                    ground, body, poses, n_pose, path, x, z, phi, rear, front, t_x, t_z, t_w, leg
                )
                n_pose += 1
                code = Event.MADE
                if what & KIND_MASK == DISC_1 and what == rear:
                    code = Event.TAIL_RESTS
                write_event(events, n_event, code, path, x, z, phi, what, lost, n_pose - 1)
                n_event += 1
                write_event(events, n_event, Event.LOST, path, x, z, phi, lost, what, n_pose - 1)
                n_event += 1
            kappa = tilt(a, g, kappa_g, t_x, t_z)
            sense = onset(ground, body, rear, front, x, z, phi, kappa)
            if sense == 0.0:
                continue
        else:
            sense = 1.0 if what == Advance.OVER_REAR else -1.0
        if n_rotation >= rotations.shape[0]:
            return Status.TOO_LONG, n_pose, n_event, n_rotation
        pivot = rear if sense > 0.0 else front
        outcome, new_rear, new_front, x1, z1, phi1, angle, count, hint = rotate(
            ground, body, pivot, x, z, phi, sense, kappa, gyration,
            effective_gravity(a, g, t_x, t_z), path, rotations, n_rotation, hint,
        )  # fmt: skip
        if count > n_rotation:
            n_rotation = count
            code = Event.TIPS_BACK if sense > 0.0 else Event.NOSE_DROPS
            write_event(events, n_event, code, path, x, z, phi, pivot, rear, n_pose - 1)
            n_event += 1
        leg += 1
        x, z, phi = x1, z1, phi1
        if outcome != RotationOutcome.ARRESTED:
            status, code = end_of_fall(outcome, sense)
            write_event(events, n_event, code, path, x, z, phi, pivot, NO_FEATURE, n_pose - 1)
            return status, n_pose, n_event + 1, n_rotation
        c = math.cos(phi)
        s = math.sin(phi)
        rear = relabelled(ground, body, new_rear, x, z, c, s)
        front = relabelled(ground, body, new_front, x, z, c, s)
        t_x, t_z, t_w, size = tangent(ground, body, rear, front, x, z, c, s)
        if size == 0.0:
            return Status.NOT_CONVERGED, n_pose, n_event, n_rotation
        record_pose(ground, body, poses, n_pose, path, x, z, phi, rear, front, t_x, t_z, t_w, leg)
        n_pose += 1
        if angle > 1e-7:
            write_event(events, n_event, Event.ARRESTED, path, x, z, phi, rear, front, n_pose - 1)
            n_event += 1
            if repeats(rotations, n_rotation):
                write_event(events, n_event, Event.STUCK, path, x, z, phi, rear, front, n_pose - 1)
                return Status.STUCK, n_pose, n_event + 1, n_rotation
        if x >= x_end:  # the rotation carried it there
            write_event(events, n_event, Event.ARRIVED, path, x, z, phi, rear, front, n_pose - 1)
            return Status.OK, n_pose, n_event + 1, n_rotation
    return Status.TOO_LONG, n_pose, n_event, n_rotation
