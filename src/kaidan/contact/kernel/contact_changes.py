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
from kaidan.contact.tables import BodyTable, GroundTable, Held, RotationTable


def settled(
    ground: GroundTable, body: BodyTable, x: float, phi: float, kappa: float
) -> tuple[bool, Held]:
    """Settle the robot from an inclination, on two contacts.

    Returns
    -------
    found, and the pose
    """
    found, z, phi, rear, front = settle(ground, body, x, phi, kappa)
    if not found or rear == front:
        return False, (x, z, phi, 0.0, 0.0, 0.0, rear, front)
    t_x, t_z, t_w, size = tangent(ground, body, rear, front, x, z, math.cos(phi), math.sin(phi))
    return size > 0.0, (x, z, phi, t_x, t_z, t_w, rear, front)


def settled_again(
    ground: GroundTable, body: BodyTable, at: Held, kappa: float
) -> tuple[bool, float, Held]:
    """Settle the robot a little farther on, where the corrector has failed.

    Returns
    -------
    found
        Whether that is the same pose to within millimetres, with a path that goes on ahead.
    nudge
        How far farther on [m].
    pose
    """
    x, z, phi, t_x, t_z, t_w, _, _ = at
    for k in range(4):
        nudge = math.copysign(1e-5 * 10.0**k, t_x)
        found, there = settled(ground, body, x + nudge, phi, kappa)
        _, z1, phi1, u_x, u_z, u_w, _, _ = there
        if (
            found
            and abs(z1 - z) < 5e-3
            and abs(phi1 - phi) < 0.02
            and u_x * t_x + u_z * t_z + u_w * t_w > 0.0
        ):
            return True, nudge, there
    return False, 0.0, at


def exchanged(
    ground: GroundTable, body: BodyTable, made: int, at: Held, kappa: float
) -> tuple[bool, int, Held]:
    """Replace the contact on the side of the centroid on which another has closed.

    Returns
    -------
    good
        Whether the new pair has a line of poses.
    lost
        The contact that opens.
    pose
        With the tangent along which the lost contact opens.
    """
    x, z, phi, t_x, t_z, t_w, rear, front = at
    c = math.cos(phi)
    s = math.sin(phi)
    lost = front
    if lever(ground, body, made, x, z, c, s, kappa) < 0.0:
        lost = rear
        rear = made
    else:
        front = made
    good, x1, z1, phi1, c1, s1, _, _, _ = corrected(ground, body, rear, front, x, z, phi)
    if good and abs(x1 - x) + abs(z1 - z) + abs(phi1 - phi) < 1e-8:
        x, z, phi, c, s = x1, z1, phi1, c1, s1
    u_x, u_z, u_w, size = tangent(ground, body, rear, front, x, z, c, s)
    if size == 0.0:
        return False, lost, at
    opening = gap_rate(ground, body, lost, x, z, c, s, u_x, u_z, u_w)
    if abs(opening) < 1e-4:
        opening = u_x * t_x + u_z * t_z + u_w * t_w
    if opening < 0.0:
        u_x = -u_x
        u_z = -u_z
        u_w = -u_w
    return True, lost, (x, z, phi, u_x, u_z, u_w, rear, front)


def onset(ground: GroundTable, body: BodyTable, at: Held, kappa: float) -> float:
    """Sense in which the robot rotates: +1 nose up, -1 nose down, 0 while the contacts hold."""
    x, z, phi, _, _, _, rear, front = at
    c = math.cos(phi)
    s = math.sin(phi)
    if lever(ground, body, rear, x, z, c, s, kappa) > 0.0:
        return 1.0
    if lever(ground, body, front, x, z, c, s, kappa) < 0.0:
        return -1.0
    return 0.0


def effective_gravity(a: float, g: float, t_x: float, t_z: float) -> float:
    """Effective gravity for acceleration ``a`` along the path of the centroid [m/s^2]."""
    speed = math.sqrt(t_x * t_x + t_z * t_z)
    sin_psi = 0.0
    if speed > 1e-12:
        sin_psi = t_z / speed
    return math.sqrt(max(g * g + a * a + 2.0 * g * a * sin_psi, 0.0))


def rotate(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, phi: float,
    sense: float, kappa: float, gyration: float, gravity: float, kept: bool, path: float,
    rotations: RotationTable, count: int, hint: int,
) -> tuple[int, int, int, float, float, float, float, int, int]:  # fmt: skip
    """Rotate about a contact until two hold the robot again, or it falls; and write that down.

    Parameters
    ----------
    kept
        Whether it is written down too what its momentum can still do.
    path
        Arclength [m].
    rotations, count
        Table to be written to and rows that it has.

    Returns
    -------
    outcome
        A `RotationOutcome`.
    rear, front
        The two contacts that arrest it, if it is arrested.
    x, z, phi, angle
        The pose at the end, and how far it rotated [rad].
    count
        One more, unless it was arrested at once.
    hint
    """
    p_x, p_z = contact_point(ground, body, pivot, x, z, math.cos(phi), math.sin(phi))
    outcome, rear, front, x1, z1, phi1, before, after, angle, hint = fall(
        ground, body, pivot, x, z, phi, sense, kappa, gyration, gravity, hint
    )
    if angle <= 1e-7 and outcome == RotationOutcome.ARRESTED:
        return outcome, rear, front, x1, z1, phi1, angle, count, hint
    write_rotation(
        rotations, count, sense, path, pivot, p_x, p_z, x, z, phi, x1, z1, phi1,
        angle, before, after, outcome,
    )  # fmt: skip
    if kept and outcome == RotationOutcome.ARRESTED:
        # momentum: what is left after the impact against what is still to climb
        last = rear if sense >= 0.0 else front
        c1 = math.cos(phi1)
        s1 = math.sin(phi1)
        p_x, p_z = contact_point(ground, body, last, x1, z1, c1, s1)
        arm = (x1 - p_x) * (x1 - p_x) + (z1 - p_z) * (z1 - p_z) + gyration * gyration
        kinetic = 0.5 * arm * after * after
        bounded, rise, across, hint = barrier(
            ground, body, last, x1, z1, phi1, sense, kappa, ROCKING, hint
        )
        needed = gravity * rise
        write_momentum(rotations, count, kinetic, needed, across, kinetic > needed and bounded)
    else:
        write_momentum(rotations, count, 0.0, 0.0, 0.0, True)
    return outcome, rear, front, x1, z1, phi1, angle, count + 1, hint
