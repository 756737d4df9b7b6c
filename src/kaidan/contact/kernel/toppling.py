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
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import NO_FEATURE, At, Fallen, Release, Scene

#: Contacts that close within this of a turn are one impact [rad]: on nosings all alike they close
#: at once, and rounding alone would say which is the first.
AT_ONCE = 2e-3
#: Gap of the pivot that still touches [m], with what closed at once before the last contact.
TOUCHES = 1e-9


def same_place(scene: Scene, one: int, other: int, at: At) -> bool:
    """Whether two features are one contact under two names (points within 2 um)."""
    p_x, p_z = contact_point(scene, one, at)
    o_x, o_z = contact_point(scene, other, at)
    return abs(p_x - o_x) < 2e-6 and abs(p_z - o_z) < 2e-6


def rates(
    scene: Scene, about: int, closed: int, at: At, k2: float, freely: float
) -> tuple[float, float, float]:
    """Rates of turn before and after an impact [rad/s], and what is left of the energy [J/kg].

    about, closed: contact about which it has turned, and the one that closes; -1: none does.
    k2: square of the radius of gyration [m^2].
    freely: energy of a free turn about ``about`` [J/kg].
    """
    a_x, a_z = contact_point(scene, about, at)
    a_x = at.x - a_x
    a_z = at.z - a_z
    before = math.sqrt(max(2.0 * freely / (k2 + a_x * a_x + a_z * a_z), 0.0))
    if closed < 0:
        return before, 0.0, 0.0
    b_x, b_z = contact_point(scene, closed, at)
    b_x = at.x - b_x
    b_z = at.z - b_z
    arm = k2 + b_x * b_x + b_z * b_z
    after = before * max(k2 + a_x * b_x + a_z * b_z, 0.0) / arm
    return before, after, 0.5 * after * after * arm


def fall(scene: Scene, pivot: int, release: Release, gyration: float, gravity: float) -> Fallen:
    """Follow a release to the next stable pose, or past the vertical.

    gyration: radius of gyration about the centroid [m]: I / M = gyration^2.
    gravity: effective gravity [m/s^2].

    Notes
    -----
    Per unit mass, with k the radius of gyration, A the pivot and B the contact that closes::

        omega_minus^2 (k^2 + r_A^2) / 2 = g fall + what was left before
        omega_plus = omega_minus (k^2 + r_A . r_B) / (k^2 + r_B^2)     never below 0

    Of contacts that close at once, within `AT_ONCE`, the last one takes the impact: the others take
    nothing of the rate.
    """
    x, z, phi, sense, kappa = release
    total = 0.0
    kinetic = 0.0
    freely = 0.0
    since = NEVER
    about = pivot
    before = 0.0
    after = 0.0
    still = 0
    k2 = gyration * gyration
    down = math.sqrt(1.0 + kappa * kappa)
    outcome: int = RotationOutcome.ENDLESS
    rear = pivot
    front = NO_FEATURE
    for _ in range(60 + 2 * len(scene.ground)):  # an end rolls over each point by two names
        most = min(0.5 * math.pi - sense * phi, 0.5 * math.pi - total)
        if most <= 0.0:
            outcome = RotationOutcome.PAST_VERTICAL
            break
        height = (z + kappa * x) / down
        at = placed(x, z, phi)
        limit = foot_limit(scene, pivot, at, sense)
        rest = angle_until_over(scene, pivot, at, sense, kappa, True)
        angle, closed = first_closing(scene, pivot, at, sense, min(most, limit, rest))
        x, z = turned(scene, pivot, x, z, phi, sense * angle)
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
        at = placed(x, z, phi)
        before, on, left = rates(scene, about, closed, at, k2, freely)
        if closed < 0:
            if rest > angle and limit <= angle:
                pivot = next_pivot(scene, pivot, sense)
                continue
            outcome = RotationOutcome.ROCKING if rest <= angle else RotationOutcome.PAST_VERTICAL
            break
        after = on
        kinetic = left
        since = 0.0
        if lever(scene, closed, at, kappa) * sense <= 0.0:
            stays = pivot
            if about != pivot:
                distance, _, _, _, _ = gap(scene, about, at)
                stays = about if abs(distance) < TOUCHES else pivot
            outcome = RotationOutcome.ARRESTED
            rear = closed if sense >= 0.0 else stays
            front = stays if sense >= 0.0 else closed
            break
        if still > 12:
            outcome = RotationOutcome.WEDGED
            break
        pivot = closed
    return Fallen(outcome, rear, front, x, z, phi, before, after, total)
