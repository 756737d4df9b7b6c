r"""Turning on from contact to contact: a release, and the rise before it would tip over.

::

    release: about one contact after the       lifting:       C  .  over the pivot: known from one
    other, until two of them straddle C                     / .     angle, unless the tail (or the
                                                          /.        nose) comes down on the way
       C        C        C                               o  \
      /        / \      / \                          pivot   \ tail
     o   ->   o   o    held                                    `.___

A release is a chain of such turns.  Every closing is a plastic impact for grade (iii); the static
grade (ii) goes on turning as long as all contacts lie on the same side of the gravity line.
"""

from __future__ import annotations

import math

from kaidan.contact.compiling import kernel
from kaidan.contact.gaps import gap
from kaidan.contact.settling import lever
from kaidan.contact.tables import FloatArray
from kaidan.contact.turning import (
    angle_until_over,
    first_closing,
    foot_limit,
    next_pivot,
    turned,
)


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
        limit = foot_limit(ground, body, pivot, x, z, phi, sense)
        rest = angle_until_over(ground, body, pivot, x, z, phi, sense, kappa, True)
        closed, angle, hint = first_closing(
            ground, body, pivot, x, z, phi, sense, min(most, limit, rest), hint
        )
        x1, z1 = turned(ground, body, pivot, x, z, phi, sense * angle)
        phi1 = phi + sense * angle
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
        if closed < 0 and rest <= angle:
            return 3, pivot, pivot, x, z, phi, omega_minus, omega_plus, total, hint
        if closed < 0 and limit <= angle:
            pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
            continue
        if closed < 0:
            return 1, pivot, -1, x, z, phi, omega_minus, omega_plus, total, hint
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
        pivot = closed
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
        over = max(angle_until_over(ground, body, pivot, x, z, phi, sense, kappa, False), 0.0)
        limit = foot_limit(ground, body, pivot, x, z, phi, sense)
        end = min(over, limit, most)
        closed, angle, hint = first_closing(ground, body, pivot, x, z, phi, sense, end, hint)
        x, z = turned(ground, body, pivot, x, z, phi, sense * angle)
        phi += sense * angle
        total += angle
        best = max(best, (z + kappa * x) / down - height)
        if closed >= 0:
            pivot = closed
        elif over <= end:
            return True, best, hint
        elif limit <= end:
            pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
        else:
            return False, best, hint
    return False, best, hint
