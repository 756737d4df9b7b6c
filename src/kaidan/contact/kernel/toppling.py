r"""Turning on from contact to contact: a release.

::

    release: about one contact after the
    other, until two of them straddle C

       C        C        C
      /        / \      / \
     o   ->   o   o    held

A release is a chain of such turns.  Every closing is a plastic impact for grade (iii); the static
grade (ii) goes on turning as long as all contacts lie on the same side of the gravity line.
"""

from __future__ import annotations

import math

from kaidan.contact.codes import RotationOutcome
from kaidan.contact.columns import NO_FEATURE
from kaidan.contact.kernel.first_closing import first_closing
from kaidan.contact.kernel.gaps import contact_point, gap
from kaidan.contact.kernel.rotation import (
    NEVER,
    angle_until_over,
    foot_limit,
    next_pivot,
    turned,
)
from kaidan.contact.kernel.settling import lever
from kaidan.contact.tables import BodyTable, GroundTable

#: Contacts that close within this of a turn are one impact [rad]: on nosings all alike they close
#: at once, and rounding alone would say which is the first.
AT_ONCE = 2e-3
#: Gap of the pivot that still touches [m], with what closed at once before the last contact.
TOUCHES = 1e-9


def same_place(
    ground: GroundTable,
    body: BodyTable,
    one: int,
    other: int,
    x: float,
    z: float,
    phi: float,
) -> bool:
    """Whether two features are one contact under two names (points within 2 um)."""
    c = math.cos(phi)
    s = math.sin(phi)
    p_x, p_z = contact_point(ground, body, one, x, z, c, s)
    o_x, o_z = contact_point(ground, body, other, x, z, c, s)
    return abs(p_x - o_x) < 2e-6 and abs(p_z - o_z) < 2e-6


def rates(
    ground: GroundTable, body: BodyTable, about: int, closed: int, x: float, z: float, phi: float,
    k2: float, freely: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Rates of turn before and after an impact [rad/s], and what is left of the energy [J/kg].

    Parameters
    ----------
    about, closed
        Contact about which it has turned, and the one that closes; -1: none does.
    k2
        Square of the radius of gyration [m^2].
    freely
        Energy of a free turn about ``about`` [J/kg].
    """
    c = math.cos(phi)
    s = math.sin(phi)
    a_x, a_z = contact_point(ground, body, about, x, z, c, s)
    a_x = x - a_x
    a_z = z - a_z
    before = math.sqrt(max(2.0 * freely / (k2 + a_x * a_x + a_z * a_z), 0.0))
    if closed < 0:
        return before, 0.0, 0.0
    b_x, b_z = contact_point(ground, body, closed, x, z, c, s)
    b_x = x - b_x
    b_z = z - b_z
    arm = k2 + b_x * b_x + b_z * b_z
    after = before * max(k2 + a_x * b_x + a_z * b_z, 0.0) / arm
    return before, after, 0.5 * after * after * arm


def fall(
    ground: GroundTable,
    body: BodyTable,
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
        A `RotationOutcome`.
    rear, front
        The two contacts that arrest it, if it is arrested.
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

    Of contacts that close at once, within `AT_ONCE`, the last one takes the impact: the others take
    nothing of the rate.
    """
    total = 0.0
    kinetic = 0.0
    freely = 0.0
    since = NEVER
    about = pivot
    omega_minus = 0.0
    omega_plus = 0.0
    still = 0
    k2 = gyration * gyration
    down = math.sqrt(1.0 + kappa * kappa)
    outcome: int = RotationOutcome.ENDLESS
    rear = pivot
    front = NO_FEATURE
    for _ in range(60 + 2 * ground.shape[0]):  # an end rolls over each point by two names
        most = min(0.5 * math.pi - sense * phi, 0.5 * math.pi - total)
        if most <= 0.0:
            outcome = RotationOutcome.PAST_VERTICAL
            break
        height = (z + kappa * x) / down
        c = math.cos(phi)
        s = math.sin(phi)
        limit = foot_limit(ground, body, pivot, x, z, c, s, sense)
        rest = angle_until_over(ground, body, pivot, x, z, c, s, sense, kappa, True)
        closed, angle, hint = first_closing(
            ground, body, pivot, x, z, c, s, sense, min(most, limit, rest), hint
        )
        x, z = turned(ground, body, pivot, x, z, phi, sense * angle)
        phi += sense * angle
        gained = gravity * (height - (z + kappa * x) / down)
        kinetic += gained
        freely += gained
        total += angle
        since += angle
        if since > AT_ONCE:
            about = pivot
            freely = kinetic
        still = 0 if angle > 1e-12 else still + 1
        omega_minus, after, left = rates(ground, body, about, closed, x, z, phi, k2, freely)
        if closed < 0:
            if rest > angle and limit <= angle:
                pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
                continue
            outcome = RotationOutcome.ROCKING if rest <= angle else RotationOutcome.PAST_VERTICAL
            break
        omega_plus = after
        kinetic = left
        since = 0.0
        c = math.cos(phi)
        s = math.sin(phi)
        if lever(ground, body, closed, x, z, c, s, kappa) * sense <= 0.0:
            stays = pivot
            if about != pivot and abs(gap(ground, body, about, x, z, c, s)[0]) < TOUCHES:
                stays = about
            outcome = RotationOutcome.ARRESTED
            rear = closed if sense >= 0.0 else stays
            front = stays if sense >= 0.0 else closed
            break
        if still > 12:
            outcome = RotationOutcome.WEDGED
            break
        pivot = closed
    return outcome, rear, front, x, z, phi, omega_minus, omega_plus, total, hint
