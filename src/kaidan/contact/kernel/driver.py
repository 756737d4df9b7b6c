"""The robot driven from one x to another: lines of stable poses, rotations between them, events."""

from __future__ import annotations

import math

from kaidan.contact.codes import Advance, Event, RotationOutcome, Status
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
from kaidan.contact.kernel.recording import keep_pose, record_pose, repeats, write_event
from kaidan.contact.kernel.renaming import record_renamings
from kaidan.contact.kernel.toppling import same_place
from kaidan.contact.kernel.trigonometry import cos, placed, sin
from kaidan.contact.layout import (
    DISC_1,
    KIND_MASK,
    NO_FEATURE,
    Held,
    Journey,
    Log,
    Pull,
    Release,
    Scene,
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
    scene: Scene, held: Held, x_end: float, step: float, thinnest: float, pull: Pull
) -> tuple[int, Held, float, bool]:
    """One step, cut where the robot arrives or is driven upright: linear in the step.

    As :func:`kaidan.contact.kernel.advance.advance`.
    ends: whether it comes to ``x_end``.
    """
    what, there, ds = advance(scene, held, step, thinnest, pull)
    ends = there.x >= x_end and held.x < x_end
    if ends and ds > 1e-9:
        part = (x_end - held.x) / (there.x - held.x)
        if part < 1.0:
            what, there, ds = advance(scene, held, ds * part, thinnest, pull)
    if abs(there.phi) > UPRIGHT and abs(held.phi) < UPRIGHT:
        part = (UPRIGHT - abs(held.phi)) / (abs(there.phi) - abs(held.phi))
        what, there, ds = advance(scene, held, ds * part, thinnest, pull)
        ends = there.x >= x_end and held.x < x_end
    return what, there, ds, ends


def exchange(scene: Scene, made: int, held: Held, kappa: float, log: Log) -> tuple[bool, Held]:
    """Exchange a contact for another that has closed, and write that down."""
    good, lost, then = exchanged(scene, made, held, kappa)
    if not good:
        return False, then
    if same_place(scene, made, lost, placed(then.x, then.z, then.phi)):
        # one contact by the name of the part that carries from here on
        if log.keeps:
            record_pose(scene, log.poses[log.n_pose - 1], log.s, then, log.leg)
        return True, then
    # the same pose with its new contacts: the forces jump here
    now = log.n_pose
    keep_pose(scene, log, then)
    kind = Event.TAIL_RESTS if made & KIND_MASK == DISC_1 and made == then.rear else Event.MADE
    write_event(log, kind, then, made, lost, now)
    write_event(log, Event.LOST, then, lost, made, now)
    return True, then


def rotate_on(
    scene: Scene, held: Held, sense: float, kappa: float, gyration: float, gravity: float, log: Log
) -> tuple[int, Held]:
    """Rotate until two contacts hold the robot again, or it falls; and write that down.

    status: `GOES_ON`, or the `Status` with which the drive ends.
    """
    x, z, phi, t_x, t_z, t_w, rear, front = held
    pivot = rear if sense > 0.0 else front
    count = log.n_rotation
    fallen = rotate(scene, pivot, Release(x, z, phi, sense, kappa), gyration, gravity, log)
    if log.n_rotation > count:
        kind: int = Event.TIPS_BACK if sense > 0.0 else Event.NOSE_DROPS
        write_event(log, kind, held, pivot, rear, log.n_pose - 1)
    x, z, phi = fallen.x, fallen.z, fallen.phi
    if fallen.outcome != RotationOutcome.ARRESTED:
        status, kind = end_of_fall(fallen.outcome, sense)
        then = Held(x, z, phi, t_x, t_z, t_w, pivot, NO_FEATURE)
        write_event(log, kind, then, pivot, NO_FEATURE, log.n_pose - 1)
        return status, then
    at = placed(x, z, phi)
    rear = relabelled(scene, fallen.rear, at)
    front = relabelled(scene, fallen.front, at)
    t_x, t_z, t_w, size = tangent(scene, rear, front, at)
    then = Held(x, z, phi, t_x, t_z, t_w, rear, front)
    if size == 0.0:
        return Status.NOT_CONVERGED, then
    now = log.n_pose
    keep_pose(scene, log, then)
    if fallen.angle > 1e-7:
        write_event(log, Event.ARRESTED, then, rear, front, now)
        if repeats(log.rotations, log.n_rotation):
            write_event(log, Event.STUCK, then, rear, front, now)
            return Status.STUCK, then
    return GOES_ON, then


def ended(log: Log, kind: int, held: Held, status: int) -> tuple[int, int, int, int]:
    """Write the event with which a drive ends; its status, and the rows that it wrote."""
    write_event(log, kind, held, held.rear, held.front, log.n_pose - 1)
    return status, log.n_pose, log.n_event, log.n_rotation


@entry
def drive(scene: Scene, journey: Journey, pull: Pull, log: Log) -> tuple[int, int, int, int]:
    """Drive from ``x_start`` to ``x_end`` (centroid), writing a log."""
    x_end = journey.x_end
    step = journey.step
    gyration = journey.gyration
    # the path at the start is taken to run along the inclination given
    kappa = tilt(pull, cos(journey.inclination), sin(journey.inclination))
    good, held = settled(scene, journey.x_start, journey.inclination, kappa)
    if not good:
        return Status.NO_START, 0, 0, 0
    thinnest = thinnest_radius(scene.body)
    keep_pose(scene, log, held)
    idle = 0
    failures = 0
    for _ in range(30 * len(log.poses)):
        if log.n_pose >= len(log.poses) - 2 or log.n_event >= len(log.events) - 4:
            break
        what, there, ds, ends = step_on(scene, held, x_end, step, thinnest, pull)
        if what == Advance.NOT_CONVERGED:
            failures += 1
            good, nudge, held = settled_again(scene, held, kappa)
            if not good or failures > FAILURES:
                return Status.NOT_CONVERGED, log.n_pose, log.n_event, log.n_rotation
            log.s += abs(nudge)
            write_event(log, Event.RESETTLED, held, held.rear, held.front, log.n_pose - 1)
            continue
        log.s += record_renamings(scene, log, held, there, ds) if log.keeps else ds
        held = there
        if ends and (what == Advance.NOTHING or held.x >= x_end - 1e-9):
            keep_pose(scene, log, held)
            if held.x >= x_end - 1e-7:
                return ended(log, Event.ARRIVED, held, Status.OK)
            continue
        idle = 0 if ds > 1e-10 else idle + 1
        if idle > IDLE:
            return ended(log, Event.STUCK, held, Status.STUCK)
        upright = abs(held.phi) > UPRIGHT - NEARLY
        if log.keeps and (
            upright or what != Advance.NOTHING or log.s - log.poses[log.n_pose - 1].s > 0.7 * step
        ):
            keep_pose(scene, log, held)
        if upright:
            status, kind = end_of_fall(RotationOutcome.PAST_VERTICAL, held.phi)
            return ended(log, kind, held, status)
        if what == Advance.NOTHING:
            continue
        kappa = tilt(pull, held.t_x, held.t_z)
        sense = 1.0 if what == Advance.OVER_REAR else -1.0
        if what >= 0:
            good, held = exchange(scene, what, held, kappa, log)
            if not good:
                return Status.NOT_CONVERGED, log.n_pose, log.n_event, log.n_rotation
            kappa = tilt(pull, held.t_x, held.t_z)
            sense = onset(scene, held, kappa)
            if sense == 0.0:
                continue
        if log.n_rotation >= len(log.rotations):
            break
        log.leg += 1
        gravity = effective_gravity(pull, held.t_x, held.t_z)
        status, held = rotate_on(scene, held, sense, kappa, gyration, gravity, log)
        if status != GOES_ON:
            return status, log.n_pose, log.n_event, log.n_rotation
        if held.x >= x_end:  # the rotation carried it there
            return ended(log, Event.ARRIVED, held, Status.OK)
    return Status.TOO_LONG, log.n_pose, log.n_event, log.n_rotation
