"""Turning about one contact until the next gap closes, and the energy of doing so.

::

        C
       /|        vertex: the body turns rigidly about the vertex
      / |        disc on a segment: it rolls, the centre moves by -r dphi along the segment
     o--+-->     Delta < 0: nose down; Delta > 0: nose up

A release is a chain of such turns.  Every closing is a plastic impact for grade (iii); the static
grade (ii) goes on turning as long as all contacts lie on the same side of the gravity line.
"""

from __future__ import annotations

import math

from kaidan.contact.branch import PENETRATED, TOGETHER, shallow
from kaidan.contact.compiling import kernel
from kaidan.contact.gaps import gap, relabelled
from kaidan.contact.scan import nearest
from kaidan.contact.settling import lever
from kaidan.contact.tables import FloatArray

#: Largest turn between two looks at all gaps [rad]: the ends move by a few millimetres.
TURN = 0.008
#: The same where only an energy is asked for and a graze may be missed.
COARSE_TURN = 0.03
#: Free gaps beyond this need not be known [m].
LOOK = 0.05


@kernel
def turned(
    ground: FloatArray, body: FloatArray, pivot: int, x: float, z: float, phi: float, angle: float
) -> tuple[float, float]:
    """Centroid after turning by ``angle`` about a contact: closed form, rolling included."""
    c = math.cos(angle)
    s = math.sin(angle)
    kind = pivot & 3
    k = pivot >> 6
    if kind == 0:
        d_x = x - ground[k, 0]
        d_z = z - ground[k, 1]
        return ground[k, 0] + c * d_x - s * d_z, ground[k, 1] + s * d_x + c * d_z
    part = (pivot >> 2) & 15
    j = 3 * (kind - 1)
    o_x = math.cos(phi) * body[part, j] - math.sin(phi) * body[part, j + 1]
    o_z = math.sin(phi) * body[part, j] + math.cos(phi) * body[part, j + 1]
    roll = -body[part, j + 2] * angle
    return (
        x + o_x + roll * ground[k, 2] - c * o_x + s * o_z,
        z + o_z + roll * ground[k, 3] - s * o_x - c * o_z,
    )


@kernel
def foot_limit(
    ground: FloatArray, body: FloatArray, pivot: int, x: float, z: float, phi: float, sense: float
) -> float:
    """Turn after which a rolling disc's foot reaches the end of its segment [rad] (inf: vertex)."""
    kind = pivot & 3
    if kind == 0:
        return 1e9
    k = pivot >> 6
    part = (pivot >> 2) & 15
    j = 3 * (kind - 1)
    c_x = x + math.cos(phi) * body[part, j] - math.sin(phi) * body[part, j + 1]
    c_z = z + math.sin(phi) * body[part, j] + math.cos(phi) * body[part, j + 1]
    foot = (c_x - ground[k, 0]) * ground[k, 2] + (c_z - ground[k, 1]) * ground[k, 3]
    if sense > 0.0:
        return float(max(foot, 0.0) / body[part, j + 2])
    return float(max(ground[k, 4] - foot, 0.0) / body[part, j + 2])


@kernel
def turn_until(
    ground: FloatArray,
    body: FloatArray,
    pivot: int,
    x: float,
    z: float,
    phi: float,
    sense: float,
    most: float,
    kappa: float,
    uphill: bool,
    hint: int,
) -> tuple[int, float, float, float, float, int]:
    """Turn about one contact until a gap closes.

    Parameters
    ----------
    pivot
        The contact.
    sense
        +1 nose up, -1 nose down.
    most
        Largest turn [rad].
    kappa
        Tilt of effective gravity (frozen).
    uphill
        False: a release, stops also where the turn no longer goes down (Delta changes sign).
        True: lifting against gravity, stops where it no longer goes up.
    hint
        For the scan.

    Returns
    -------
    outcome
        a feature that closed; -1 nothing closed within ``most``; -2 the centroid came over
        the pivot; -3 the disc has run off its segment (rename the pivot)
    x, z, phi, turn [rad], hint
    """
    limit = foot_limit(ground, body, pivot, x, z, phi, sense)
    end = min(most, limit)
    want = sense
    if uphill:
        want = -sense
    done = 0.0
    # a gap of d cannot close within a turn of d / (greatest distance of the body from the pivot)
    _, _, _, p_x, p_z = gap(ground, body, pivot, x, z, math.cos(phi), math.sin(phi))
    reach = 0.0
    for part in range(body.shape[0]):
        reach = max(
            reach,
            math.hypot(body[part, 0], body[part, 1]) + body[part, 2],
            math.hypot(body[part, 3], body[part, 4]) + body[part, 5],
        )
    reach += math.hypot(x - p_x, z - p_z)
    least = TURN
    if uphill:
        least = COARSE_TURN
    step = least
    for _ in range(2000):
        ahead = min(done + step, end)
        x1, z1, phi1 = x, z, phi
        c, s = 1.0, 0.0
        which = -1
        distance = 0.0
        for _ in range(30):
            x1, z1 = turned(ground, body, pivot, x, z, phi, sense * ahead)
            phi1 = phi + sense * ahead
            c = math.cos(phi1)
            s = math.sin(phi1)
            which, distance, hint = nearest(ground, body, x1, z1, c, s, pivot, -1, LOOK, hint)
            if which < 0 or ahead - done < 1e-8 or shallow(body, which, distance):
                break
            ahead = done + 0.4 * (ahead - done)
        step = max(least, min(distance, LOOK) / reach)
        delta = lever(ground, body, pivot, x1, z1, c, s, kappa)
        over = delta * want <= 0.0
        if over:
            lo = done
            hi = ahead
            x0, z0 = turned(ground, body, pivot, x, z, phi, sense * lo)
            c = math.cos(phi + sense * lo)
            s = math.sin(phi + sense * lo)
            g0 = lever(ground, body, pivot, x0, z0, c, s, kappa) * want
            g1 = delta * want
            for turn in range(60):
                if hi - lo < 1e-13:
                    break
                mid = (lo * g1 - hi * g0) / (g1 - g0) if g1 != g0 else 0.5 * (lo + hi)
                if turn % 4 == 3 or not (lo < mid < hi):
                    mid = 0.5 * (lo + hi)
                x1, z1 = turned(ground, body, pivot, x, z, phi, sense * mid)
                c = math.cos(phi + sense * mid)
                s = math.sin(phi + sense * mid)
                value = lever(ground, body, pivot, x1, z1, c, s, kappa) * want
                if value > 0.0:
                    lo = mid
                    g0 = value
                    g1 *= 0.5
                else:
                    hi = mid
                    g1 = value
                    g0 *= 0.5
                    if value > -1e-13:
                        break
            ahead = hi
            x1, z1 = turned(ground, body, pivot, x, z, phi, sense * ahead)
            phi1 = phi + sense * ahead
            which, distance, hint = nearest(
                ground, body, x1, z1, math.cos(phi1), math.sin(phi1), pivot, -1, 0.0, hint
            )
        closed = -1
        deep = PENETRATED
        for _ in range(16):
            if which < 0 or distance >= -deep:
                break
            deep = TOGETHER
            closed = which
            lo = done
            hi = ahead
            x0, z0 = turned(ground, body, pivot, x, z, phi, sense * lo)
            c = math.cos(phi + sense * lo)
            s = math.sin(phi + sense * lo)
            name = relabelled(ground, body, which, x0, z0, c, s)
            g0, _, _, _, _ = gap(ground, body, name, x0, z0, c, s)
            g0 += 0.5 * PENETRATED
            g1 = distance + 0.5 * PENETRATED
            if g0 <= 0.0:
                hi = lo
            for turn in range(80):
                if hi - lo < 1e-13:
                    break
                mid = (lo * g1 - hi * g0) / (g1 - g0)
                if turn % 4 == 3 or not (lo < mid < hi):
                    mid = 0.5 * (lo + hi)
                x1, z1 = turned(ground, body, pivot, x, z, phi, sense * mid)
                c = math.cos(phi + sense * mid)
                s = math.sin(phi + sense * mid)
                name = relabelled(ground, body, which, x1, z1, c, s)
                value, _, _, _, _ = gap(ground, body, name, x1, z1, c, s)
                value += 0.5 * PENETRATED
                if value > 0.0:
                    lo = mid
                    g0 = value
                    g1 *= 0.5
                else:
                    hi = mid
                    g1 = value
                    g0 *= 0.5
                    if value > -0.5 * PENETRATED:
                        break
            if ahead == hi:
                break
            ahead = hi
            over = False
            x1, z1 = turned(ground, body, pivot, x, z, phi, sense * ahead)
            phi1 = phi + sense * ahead
            which, distance, hint = nearest(
                ground, body, x1, z1, math.cos(phi1), math.sin(phi1), pivot, -1, 0.0, hint
            )
            if hi - done <= 0.0:
                break
        if closed >= 0:
            closed = relabelled(ground, body, closed, x1, z1, math.cos(phi1), math.sin(phi1))
            return closed, x1, z1, phi1, ahead, hint
        if over:
            return -2, x1, z1, phi1, ahead, hint
        done = ahead
        if done >= end:
            if limit <= most:
                return -3, x1, z1, phi1, done, hint
            return -1, x1, z1, phi1, done, hint
    return -1, x1, z1, phi1, done, hint


@kernel
def next_pivot(
    ground: FloatArray, body: FloatArray, pivot: int, x: float, z: float, phi: float, sense: float
) -> int:
    """Name of the pivot after its disc has run to the end of its segment."""
    k = pivot >> 6
    part = (pivot >> 2) & 15
    if sense > 0.0:
        if ground[k, 5] == 1.0:
            return 64 * k + 4 * part
        return 64 * (k - 1) + (pivot & 63)
    if ground[k + 1, 5] == 1.0:
        return 64 * (k + 1) + 4 * part
    return 64 * (k + 1) + (pivot & 63)


@kernel
def same_place(
    ground: FloatArray,
    body: FloatArray,
    one: int,
    other: int,
    x: float,
    z: float,
    phi: float,
) -> bool:
    """Whether two features are one contact under two names (points within 2 um)."""
    c = math.cos(phi)
    s = math.sin(phi)
    _, _, _, p_x, p_z = gap(ground, body, one, x, z, c, s)
    _, _, _, o_x, o_z = gap(ground, body, other, x, z, c, s)
    return abs(p_x - o_x) < 2e-6 and abs(p_z - o_z) < 2e-6


@kernel
def fall(
    ground: FloatArray,
    body: FloatArray,
    pivot: int,
    x: float,
    z: float,
    phi: float,
    sense: float,
    kappa: float,
    gyration: float,
    gravity: float,
    hint: int,
) -> tuple[int, int, int, float, float, float, float, float, float, int]:
    """Follow a release to the next stable pose, or past the vertical.

    Parameters
    ----------
    pivot
        Contact over which the centroid stands.
    x, z, phi, sense, kappa
        Pose, sense of the turn, tilt of effective gravity (frozen).
    gyration
        Radius of gyration about the centroid [m]: I / M = gyration^2.
    gravity
        Effective gravity [m/s^2].

    Returns
    -------
    outcome
        0 caught by two contacts; 1 past the vertical or 90 degrees of turn; 2 wedged between
        contacts on one side; 3 rocks on one rolling contact; 4 too many contacts in turn
    rear, front
        The two contacts when caught.
    x, z, phi
    omega_minus
        Rate of turn just before the last impact [rad/s].
    omega_plus
        and just after it, turning about the last contact (0 if it stops).
    turned
        Angle through which it turned [rad].
    hint

    Notes
    -----
    Per unit mass, with k the radius of gyration, A the pivot and B the contact that closes::

        omega_minus^2 (k^2 + r_A^2) / 2 = g fall + what was left before
        omega_plus = omega_minus (k^2 + r_A . r_B) / (k^2 + r_B^2)     never below 0
    """
    total = 0.0
    kinetic = 0.0
    omega_minus = 0.0
    omega_plus = 0.0
    still = 0
    k2 = gyration * gyration
    down = math.sqrt(1.0 + kappa * kappa)
    for _ in range(60):
        most = min(0.5 * math.pi - sense * phi, 0.5 * math.pi - total)
        if most <= 0.0:
            return 1, pivot, -1, x, z, phi, omega_minus, omega_plus, total, hint
        height = (z + kappa * x) / down
        closed, x1, z1, phi1, angle, hint = turn_until(
            ground, body, pivot, x, z, phi, sense, most, kappa, False, hint
        )
        kinetic += gravity * (height - (z1 + kappa * x1) / down)
        total += angle
        if angle > 1e-12:
            still = 0
        else:
            still += 1
        x, z, phi = x1, z1, phi1
        c = math.cos(phi)
        s = math.sin(phi)
        _, _, _, a_x, a_z = gap(ground, body, pivot, x, z, c, s)
        a_x = x - a_x
        a_z = z - a_z
        omega_minus = math.sqrt(max(2.0 * kinetic / (k2 + a_x * a_x + a_z * a_z), 0.0))
        if closed == -1:
            return 1, pivot, -1, x, z, phi, omega_minus, omega_plus, total, hint
        if closed == -2:
            return 3, pivot, pivot, x, z, phi, omega_minus, omega_plus, total, hint
        if closed == -3:
            pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
            continue
        _, _, _, b_x, b_z = gap(ground, body, closed, x, z, c, s)
        b_x = x - b_x
        b_z = z - b_z
        share = max(k2 + a_x * b_x + a_z * b_z, 0.0)
        omega_plus = omega_minus * share / (k2 + b_x * b_x + b_z * b_z)
        kinetic = 0.5 * omega_plus * omega_plus * (k2 + b_x * b_x + b_z * b_z)
        delta = lever(ground, body, closed, x, z, c, s, kappa)
        if delta * sense <= 0.0:
            rear = closed
            front = pivot
            if sense < 0.0:
                rear = pivot
                front = closed
            return 0, rear, front, x, z, phi, omega_minus, omega_plus, total, hint
        if still > 12:
            return 2, pivot, closed, x, z, phi, omega_minus, omega_plus, total, hint
        pivot = relabelled(ground, body, closed, x, z, c, s)
    return 4, pivot, -1, x, z, phi, omega_minus, omega_plus, total, hint


@kernel
def barrier(
    ground: FloatArray,
    body: FloatArray,
    pivot: int,
    x: float,
    z: float,
    phi: float,
    sense: float,
    kappa: float,
    hint: int,
) -> tuple[bool, float, int]:
    """Rise of the centroid along the flow before it tips over: the energy margin.

    It turns about ``pivot`` against gravity; where another gap closes farther out the turn goes on
    about that contact, until the centroid stands over the pivot.

    Returns
    -------
    bounded
        False if no such pose lies within 90 degrees (then the rise is a lower bound).
    rise [m]
        Along effective gravity.
    hint
    """
    down = math.sqrt(1.0 + kappa * kappa)
    height = (z + kappa * x) / down
    total = 0.0
    best = 0.0
    for _ in range(40):
        delta = lever(ground, body, pivot, x, z, math.cos(phi), math.sin(phi), kappa)
        if delta * sense >= 0.0:
            return True, best, hint
        most = 0.5 * math.pi - total
        if most <= 0.0:
            return False, best, hint
        closed, x, z, phi, angle, hint = turn_until(
            ground, body, pivot, x, z, phi, sense, most, kappa, True, hint
        )
        total += angle
        best = max(best, (z + kappa * x) / down - height)
        if closed == -2:
            return True, best, hint
        if closed == -1:
            return False, best, hint
        if closed == -3:
            pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
        else:
            pivot = relabelled(ground, body, closed, x, z, math.cos(phi), math.sin(phi))
    return False, best, hint
