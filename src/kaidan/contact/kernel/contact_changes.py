"""What becomes of a pose where its contacts change: exchanged, found again, or rotated about."""

from __future__ import annotations

import math

from kaidan.contact.codes import ROCKING, RotationOutcome
from kaidan.contact.kernel.continuation import corrected, gap_rate, tangent
from kaidan.contact.kernel.gaps import contact_point
from kaidan.contact.kernel.recording import write_momentum, write_rotation
from kaidan.contact.kernel.reserves import barrier
from kaidan.contact.kernel.settling import lever, settle
from kaidan.contact.kernel.toppling import fall
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import Fallen, Held, Log, Pull, Release, Scene


def settled(scene: Scene, x: float, phi: float, kappa: float) -> tuple[bool, Held]:
    """Settle the robot from an inclination, on two contacts."""
    found, z, phi, rear, front = settle(scene, x, phi, kappa)
    if not found or rear == front:
        return False, Held(x, z, phi, 0.0, 0.0, 0.0, rear, front)
    t_x, t_z, t_w, size = tangent(scene, rear, front, placed(x, z, phi))
    return size > 0.0, Held(x, z, phi, t_x, t_z, t_w, rear, front)


def settled_again(scene: Scene, held: Held, kappa: float) -> tuple[bool, float, Held]:
    """Settle the robot a little farther on, where the corrector has failed.

    nudge: how far farther on [m].
    """
    nudge = math.copysign(1e-5, held.t_x)
    for _ in range(4):
        found, there = settled(scene, held.x + nudge, held.phi, kappa)
        if (
            found
            and abs(there.z - held.z) < 5e-3
            and abs(there.phi - held.phi) < 0.02
            and there.t_x * held.t_x + there.t_z * held.t_z + there.t_w * held.t_w > 0.0
        ):
            return True, nudge, there
        nudge *= 10.0
    return False, 0.0, held


def exchanged(scene: Scene, made: int, held: Held, kappa: float) -> tuple[bool, int, Held]:
    """Replace the contact on the side of the centroid on which another has closed."""
    x, z, phi, t_x, t_z, t_w, rear, front = held
    at = placed(x, z, phi)
    lost = front
    if lever(scene, made, at, kappa) < 0.0:
        lost = rear
        rear = made
    else:
        front = made
    good, there, where = corrected(scene, rear, front, x, z, phi)
    if good and abs(there.x - x) + abs(there.z - z) + abs(there.phi - phi) < 1e-8:
        x = there.x
        z = there.z
        phi = there.phi
        at = where
    u_x, u_z, u_w, size = tangent(scene, rear, front, at)
    if size == 0.0:
        return False, lost, held
    opening = gap_rate(scene, lost, at, u_x, u_z, u_w)
    if abs(opening) < 1e-4:
        opening = u_x * t_x + u_z * t_z + u_w * t_w
    if opening < 0.0:
        u_x, u_z, u_w = -u_x, -u_z, -u_w
    return True, lost, Held(x, z, phi, u_x, u_z, u_w, rear, front)


def onset(scene: Scene, held: Held, kappa: float) -> float:
    """Sense in which the robot rotates: +1 nose up, -1 nose down, 0 while the contacts hold."""
    at = placed(held.x, held.z, held.phi)
    if lever(scene, held.rear, at, kappa) > 0.0:
        return 1.0
    if lever(scene, held.front, at, kappa) < 0.0:
        return -1.0
    return 0.0


def effective_gravity(pull: Pull, t_x: float, t_z: float) -> float:
    """Effective gravity for an acceleration along the path of the centroid [m/s^2]."""
    a = pull.a
    g = pull.g
    speed = math.sqrt(t_x * t_x + t_z * t_z)
    sin_psi = 0.0
    if speed > 1e-12:
        sin_psi = t_z / speed
    return math.sqrt(max(g * g + a * a + 2.0 * g * a * sin_psi, 0.0))


def rotate(
    scene: Scene, pivot: int, release: Release, gyration: float, gravity: float, log: Log
) -> Fallen:
    """Rotate about a contact until two hold the robot again, or it falls; and write that down.

    Nothing is written where it is arrested at once.
    """
    p_x, p_z = contact_point(scene, pivot, placed(release.x, release.z, release.phi))
    fallen = fall(scene, pivot, release, gyration, gravity)
    if fallen.angle <= 1e-7 and fallen.outcome == RotationOutcome.ARRESTED:
        return fallen
    row = log.rotations[log.n_rotation]
    log.n_rotation += 1
    write_rotation(row, log.s, pivot, p_x, p_z, release, fallen)
    if log.keeps and fallen.outcome == RotationOutcome.ARRESTED:
        # momentum: what is left after the impact against what is still to climb
        x, z, phi = fallen.x, fallen.z, fallen.phi
        last = fallen.rear if release.sense >= 0.0 else fallen.front
        p_x, p_z = contact_point(scene, last, placed(x, z, phi))
        arm = (x - p_x) * (x - p_x) + (z - p_z) * (z - p_z) + gyration * gyration
        kinetic = 0.5 * arm * fallen.after * fallen.after
        bounded, rise, across = barrier(
            scene, last, Release(x, z, phi, release.sense, release.kappa), ROCKING
        )
        needed = gravity * rise
        write_momentum(row, kinetic, needed, across, kinetic > needed and bounded)
    else:
        write_momentum(row, 0.0, 0.0, 0.0, True)
    return fallen
