"""The robot driven from one x to another: lines of stable poses, releases between them, events.

Codes of events (column 0 of the table of events):

== ============== ============================================================================
0  MADE           a contact closed while driving
1  LOST           a contact opened while driving (it was replaced on its side of the centroid)
2  NOSE_DROPS     the centroid passed the front contact: the robot turns nose down
3  TIPS_BACK      the centroid fell behind the rear contact: the robot turns nose up
4  CAUGHT         the turn ended on two contacts that hold the robot
5  TAIL_RESTS     MADE, and it is a rear end disc that came to rest on a segment
6  FELL_FORWARD   the turn went past the vertical
7  FELL_BACKWARD
8  ARRIVED        the centroid reached the end
9  STUCK          wedged, rocking on the spot, or no way ahead
10 RESETTLED      the corrector failed and the robot was let down again within 10 mm, on a pose
                  within 5 mm and 0.02 rad (sharp parts on rough ground only)
== ============== ============================================================================
"""

from __future__ import annotations

import math

import numpy as np

from kaidan.contact.branch import advance, corrected, gap_rate, tangent, tilt
from kaidan.contact.compiling import entry, kernel
from kaidan.contact.gaps import gap, relabelled
from kaidan.contact.release import barrier, fall, same_place
from kaidan.contact.settling import lever, settle
from kaidan.contact.tables import FloatArray

POSE_COLUMNS = 16
EVENT_COLUMNS = 8
RELEASE_COLUMNS = 18

OK, FELL_BACK, FELL_FRONT, STUCK_STATUS, NOT_CONVERGED, TOO_LONG, NO_START = 0, 1, 2, 3, 4, 5, 6


@kernel
def record_pose(
    ground: FloatArray,
    body: FloatArray,
    poses: FloatArray,
    row: int,
    path: float,
    x: float,
    z: float,
    phi: float,
    rear: int,
    front: int,
    t_x: float,
    t_z: float,
    t_w: float,
    leg: int,
) -> None:
    """Write one pose: s, x, z, phi, rear, front, their points, normals' angles, tangent, leg."""
    c = math.cos(phi)
    s = math.sin(phi)
    _, m_x, m_z, p_x, p_z = gap(ground, body, rear, x, z, c, s)
    _, n_x, n_z, o_x, o_z = gap(ground, body, front, x, z, c, s)
    poses[row, 0] = path
    poses[row, 1] = x
    poses[row, 2] = z
    poses[row, 3] = phi
    poses[row, 4] = rear
    poses[row, 5] = front
    poses[row, 6] = p_x
    poses[row, 7] = p_z
    poses[row, 8] = o_x
    poses[row, 9] = o_z
    poses[row, 10] = m_x
    poses[row, 11] = m_z
    poses[row, 12] = n_x
    poses[row, 13] = n_z
    speed = math.sqrt(t_x * t_x + t_z * t_z)
    poses[row, 14] = math.atan2(t_z, t_x) if speed > 1e-12 else 0.0
    poses[row, 15] = leg


@entry
def drive(
    ground: FloatArray,
    body: FloatArray,
    x_start: float,
    x_end: float,
    phi_start: float,
    step: float,
    a: float,
    g: float,
    gyration: float,
    poses: FloatArray,
    events: FloatArray,
    releases: FloatArray,
) -> tuple[int, int, int, int]:
    """Drive from ``x_start`` to ``x_end`` (centroid), writing into the three tables.

    Parameters
    ----------
    ground, body
        Tables.
    x_start, x_end
        Centroid at start and end [m], ``x_end`` > ``x_start``.
    phi_start
        Inclination from which the robot is let go at the start [rad].
    step
        Arclength between poses [m].
    a, g
        Acceleration along the path of the centroid, gravity [m/s^2].
    gyration
        Radius of gyration about the centroid [m], for the energy of releases.
    poses
        (n, 16): s, x, z, phi, rear feature, front feature, rear point (2), front point (2), rear
        normal (2), front normal (2), direction psi of the path, number of the line of poses (it
        grows by one with every release).
    events
        (n, 8): code, s, x, z, phi, feature, other feature, row of the pose.
    releases
        (n, 18): sense (+1 nose up), s, pivot, x, z, phi at its start; x, z, phi at its end; angle
        turned; omega before and after the last impact [rad/s]; energy per unit mass after it over
        what is still to climb [J/kg] (2); topples with momentum (0, 1); outcome; point of the
        pivot (2).

    Returns
    -------
    status, poses written, events written, releases written
    """
    n_pose = 0
    n_event = 0
    n_release = 0
    # the path at the start is taken to run along the inclination given
    kappa = tilt(a, g, math.cos(phi_start), math.sin(phi_start))
    found, z, phi, rear, front = settle(ground, body, x_start, phi_start, kappa)
    if not found or rear == front:
        return NO_START, 0, 0, 0
    x = x_start
    path = 0.0
    leg = 0
    hint = 0
    t_x, t_z, t_w, size = tangent(ground, body, rear, front, x, z, math.cos(phi), math.sin(phi))
    if size == 0.0:
        return NO_START, 0, 0, 0
    record_pose(ground, body, poses, 0, path, x, z, phi, rear, front, t_x, t_z, t_w, leg)
    n_pose = 1
    idle = 0
    failures = 0
    for _ in range(30 * poses.shape[0]):
        if n_pose >= poses.shape[0] - 2 or n_event >= events.shape[0] - 4:
            return TOO_LONG, n_pose, n_event, n_release
        o_x, o_z, o_w, old_rear, old_front = t_x, t_z, t_w, rear, front
        what, x1, z1, phi1, t_x, t_z, t_w, rear, front, hint, ds, _ = advance(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, step, a, g, hint
        )
        if what == -9:
            # let it down again a little farther on, if that is the same pose to within millimetres
            failures += 1
            again = False
            for k in range(4):
                nudge = math.copysign(1e-5 * 10.0**k, t_x)
                again, z1, phi1, new_rear, new_front = settle(ground, body, x + nudge, phi, kappa)
                if again and new_rear != new_front:
                    u_x, u_z, u_w, size = tangent(
                        ground, body, new_rear, new_front, x + nudge, z1,
                        math.cos(phi1), math.sin(phi1),
                    )  # fmt: skip
                    again = (
                        size > 0.0
                        and abs(z1 - z) < 5e-3
                        and abs(phi1 - phi) < 0.02
                        and u_x * t_x + u_z * t_z + u_w * t_w > 0.0
                    )
                if again:
                    x += nudge
                    z, phi, rear, front = z1, phi1, new_rear, new_front
                    t_x, t_z, t_w = u_x, u_z, u_w
                    break
            if not again or failures > 50:
                return NOT_CONVERGED, n_pose, n_event, n_release
            path += abs(nudge)
            write_event(events, n_event, 10, path, x, z, phi, rear, front, n_pose - 1)
            n_event += 1
            continue
        if x1 >= x_end and x < x_end:
            # cut the last step at x_end (linear in the step: the pose itself stays on the line)
            part = (x_end - x) / (x1 - x)
            if part < 1.0 and ds > 1e-9:
                what, x1, z1, phi1, t_x, t_z, t_w, rear, front, hint, ds, _moved = advance(
                    ground, body, old_rear, old_front, x, z, phi, o_x, o_z, o_w, ds * part, a, g,
                    hint,
                )  # fmt: skip
                if what == -9:
                    return NOT_CONVERGED, n_pose, n_event, n_release
            x, z, phi = x1, z1, phi1
            path += ds
            if what == -3 or x >= x_end - 1e-9:
                record_pose(
                    ground, body, poses, n_pose, path, x, z, phi, rear, front, t_x, t_z, t_w, leg
                )
                n_pose += 1
                if x >= x_end - 1e-7:
                    write_event(events, n_event, 8, path, x, z, phi, rear, front, n_pose - 1)
                    return OK, n_pose, n_event + 1, n_release
                continue
        x, z, phi = x1, z1, phi1
        path += ds
        if ds > 1e-10:
            idle = 0
        else:
            idle += 1
            if idle > 20:
                write_event(events, n_event, 9, path, x, z, phi, rear, front, n_pose - 1)
                return STUCK_STATUS, n_pose, n_event + 1, n_release
        if what != -3 or path - poses[n_pose - 1, 0] > 0.7 * step:
            record_pose(
                ground, body, poses, n_pose, path, x, z, phi, rear, front, t_x, t_z, t_w, leg
            )
            n_pose += 1
        if abs(phi) > 0.5 * math.pi:
            status = FELL_BACK
            code = 7
            if phi < 0.0:
                status = FELL_FRONT
                code = 6
            write_event(events, n_event, code, path, x, z, phi, rear, front, n_pose - 1)
            return status, n_pose, n_event + 1, n_release
        if what == -3:
            continue
        c = math.cos(phi)
        s = math.sin(phi)
        kappa = tilt(a, g, t_x, t_z)
        sense = 0.0
        if what >= 0:
            lost = front
            if lever(ground, body, what, x, z, c, s, kappa) < 0.0:
                lost = rear
                rear = what
            else:
                front = what
            good, x1, z1, phi1, _, _, _ = corrected(ground, body, rear, front, x, z, phi)
            if good and abs(x1 - x) + abs(z1 - z) + abs(phi1 - phi) < 1e-8:
                x, z, phi = x1, z1, phi1
                c = math.cos(phi)
                s = math.sin(phi)
            u_x, u_z, u_w, size = tangent(ground, body, rear, front, x, z, c, s)
            if size == 0.0:
                return NOT_CONVERGED, n_pose, n_event, n_release
            opening = gap_rate(ground, body, lost, x, z, c, s, u_x, u_z, u_w)
            if abs(opening) < 1e-4:
                opening = u_x * t_x + u_z * t_z + u_w * t_w
            if opening < 0.0:
                u_x = -u_x
                u_z = -u_z
                u_w = -u_w
            t_x, t_z, t_w = u_x, u_z, u_w
            if not same_place(ground, body, what, lost, x, z, phi):
                # the same pose with its new contacts: the forces jump here
                record_pose(
                    ground, body, poses, n_pose, path, x, z, phi, rear, front, t_x, t_z, t_w, leg
                )
                n_pose += 1
                code = 0
                if what & 3 == 1 and what == rear:
                    code = 5
                write_event(events, n_event, code, path, x, z, phi, what, lost, n_pose - 1)
                write_event(events, n_event + 1, 1, path, x, z, phi, lost, what, n_pose - 1)
                n_event += 2
            kappa = tilt(a, g, t_x, t_z)
            if lever(ground, body, rear, x, z, c, s, kappa) > 0.0:
                sense = 1.0
            elif lever(ground, body, front, x, z, c, s, kappa) < 0.0:
                sense = -1.0
            if sense == 0.0:
                continue
        elif what == -1:
            sense = 1.0
        else:
            sense = -1.0
        pivot = rear
        if sense < 0.0:
            pivot = front
        if n_release >= releases.shape[0]:
            return TOO_LONG, n_pose, n_event, n_release
        _, _, _, p_x, p_z = gap(ground, body, pivot, x, z, c, s)
        speed = math.sqrt(t_x * t_x + t_z * t_z)
        sin_psi = 0.0
        if speed > 1e-12:
            sin_psi = t_z / speed
        gravity = math.sqrt(max(g * g + a * a + 2.0 * g * a * sin_psi, 0.0))
        outcome, new_rear, new_front, x1, z1, phi1, before, after, angle, hint = fall(
            ground, body, pivot, x, z, phi, sense, kappa, gyration, gravity, hint
        )
        if angle > 1e-7 or outcome != 0:
            row = n_release
            n_release += 1
            releases[row, 0] = sense
            releases[row, 1] = path
            releases[row, 2] = pivot
            releases[row, 3] = x
            releases[row, 4] = z
            releases[row, 5] = phi
            releases[row, 6] = x1
            releases[row, 7] = z1
            releases[row, 8] = phi1
            releases[row, 9] = angle
            releases[row, 10] = before
            releases[row, 11] = after
            releases[row, 15] = outcome
            releases[row, 16] = p_x
            releases[row, 17] = p_z
            code = 3
            if sense < 0.0:
                code = 2
            write_event(events, n_event, code, path, x, z, phi, pivot, rear, n_pose - 1)
            n_event += 1
            if outcome == 0:
                last = new_rear
                if sense < 0.0:
                    last = new_front
                # momentum: what is left after the impact against what is still to climb
                c1 = math.cos(phi1)
                s1 = math.sin(phi1)
                _, _, _, p_x, p_z = gap(ground, body, last, x1, z1, c1, s1)
                arm = (x1 - p_x) * (x1 - p_x) + (z1 - p_z) * (z1 - p_z) + gyration * gyration
                kinetic = 0.5 * arm * after * after
                bounded, rise, hint = barrier(ground, body, last, x1, z1, phi1, sense, kappa, hint)
                releases[row, 12] = kinetic
                releases[row, 13] = gravity * rise
                if kinetic > gravity * rise and bounded:
                    releases[row, 14] = 1.0
            else:
                releases[row, 14] = 1.0
        leg += 1
        x, z, phi = x1, z1, phi1
        if outcome != 0:
            status = STUCK_STATUS
            code = 9
            if outcome == 1 or outcome == 3:
                status = FELL_BACK
                code = 7
                if sense < 0.0:
                    status = FELL_FRONT
                    code = 6
            elif outcome == 4:
                status = NOT_CONVERGED
            write_event(events, n_event, code, path, x, z, phi, pivot, -1, n_pose - 1)
            return status, n_pose, n_event + 1, n_release
        c = math.cos(phi)
        s = math.sin(phi)
        rear = relabelled(ground, body, new_rear, x, z, c, s)
        front = relabelled(ground, body, new_front, x, z, c, s)
        t_x, t_z, t_w, size = tangent(ground, body, rear, front, x, z, c, s)
        if size == 0.0:
            return NOT_CONVERGED, n_pose, n_event, n_release
        record_pose(ground, body, poses, n_pose, path, x, z, phi, rear, front, t_x, t_z, t_w, leg)
        n_pose += 1
        if angle > 1e-7:
            write_event(events, n_event, 4, path, x, z, phi, rear, front, n_pose - 1)
            n_event += 1
            for row in range(max(0, n_release - 12), n_release - 1):
                if (
                    abs(releases[row, 3] - releases[n_release - 1, 3]) < 1e-8
                    and abs(releases[row, 5] - releases[n_release - 1, 5]) < 1e-8
                    and releases[row, 0] == releases[n_release - 1, 0]
                ):
                    write_event(events, n_event, 9, path, x, z, phi, rear, front, n_pose - 1)
                    return STUCK_STATUS, n_pose, n_event + 1, n_release
        if x >= x_end:  # the turn carried it there
            write_event(events, n_event, 8, path, x, z, phi, rear, front, n_pose - 1)
            return OK, n_pose, n_event + 1, n_release
    return TOO_LONG, n_pose, n_event, n_release


@kernel
def write_event(
    events: FloatArray,
    row: int,
    code: int,
    path: float,
    x: float,
    z: float,
    phi: float,
    feature: int,
    other: int,
    pose: int,
) -> None:
    """Write one event: code, s, x, z, phi, feature, other feature, row of the pose."""
    events[row, 0] = code
    events[row, 1] = path
    events[row, 2] = x
    events[row, 3] = z
    events[row, 4] = phi
    events[row, 5] = feature
    events[row, 6] = other
    events[row, 7] = pose


@entry
def new_tables(size: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Empty tables for :func:`drive`."""
    return (
        np.empty((size, POSE_COLUMNS)),
        np.zeros((size, EVENT_COLUMNS)),
        np.zeros((size // 8 + 16, RELEASE_COLUMNS)),
    )
