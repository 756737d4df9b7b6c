"""Where along a step an event lies: a gap closes, or the centroid comes over a contact."""

from __future__ import annotations

import math

from kaidan.contact.codes import Advance
from kaidan.contact.kernel.continuation import stepped, tilt
from kaidan.contact.kernel.gaps import gap_anywhere
from kaidan.contact.kernel.settling import lever
from kaidan.contact.tables import BodyTable, GroundTable

#: A gap below minus this [m] is a penetration.  An end's arc leaves a nosing like e^2/(2 R), so an
#: event is seen sqrt(2 R 2e-12) = 0.5 um late for R = 60 mm; still ten times the corrector's rest.
PENETRATED = 2e-12


def quantity(
    ground: GroundTable,
    body: BodyTable,
    what: int,
    rear: int,
    front: int,
    x: float,
    z: float,
    phi: float,
    kappa: float,
) -> float:
    """Return what is positive as long as nothing happens: a gap, or a contact's lever [m]."""
    c = math.cos(phi)
    s = math.sin(phi)
    if what == Advance.OVER_REAR:
        return -lever(ground, body, rear, x, z, c, s, kappa)
    if what == Advance.OVER_FRONT:
        return lever(ground, body, front, x, z, c, s, kappa)
    if what == rear or what == front:  # noqa: SIM109
        return 0.5 * PENETRATED
    return gap_anywhere(ground, body, what, x, z, c, s) + 0.5 * PENETRATED


def closing_time(
    ground: GroundTable,
    body: BodyTable,
    what: int,
    rear: int,
    front: int,
    x: float,
    z: float,
    phi: float,
    t_x: float,
    t_z: float,
    t_w: float,
    ds: float,
    f0: float,
    f1: float,
    a: float,
    g: float,
    kappa_g: float,
) -> tuple[int, float]:
    """Arclength at which one quantity changes sign within a step (regula falsi, bisection).

    ``what`` is a feature (its gap), `Advance.OVER_REAR` or `Advance.OVER_FRONT` (a lever).
    ``f0`` > 0 >= ``f1`` are the values at the ends.

    Returns
    -------
    0 not found, 1 found, 2 no event: one of the two contacts takes that name on the way
    arclength [m]
        On the far side of the event, within 1e-9 m or a gap of 1e-12 m.
    """
    lo = 0.0
    hi = ds
    weight0 = f0
    weight1 = f1
    for turn in range(90):
        if hi - lo < 1e-10:
            break
        # aimed a hair beyond the zero, so that a straight course ends with the first look
        mid = lo + (hi - lo) * (weight0 + 0.2 * PENETRATED) / (weight0 - weight1)
        if turn % 4 == 3 or not (lo < mid < hi):
            mid = 0.5 * (lo + hi)
        good, x1, z1, phi1, _, _, u_x, u_z, _, new_rear, new_front = stepped(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, mid
        )
        if not good:
            return 0, lo
        if new_rear == what or new_front == what:
            return 2, mid
        value = quantity(
            ground,
            body,
            what,
            new_rear,
            new_front,
            x1,
            z1,
            phi1,
            tilt(a, g, kappa_g, u_x, u_z),
        )
        if value > 0.0:
            lo = mid
            weight0 = value
            weight1 *= 0.5
        else:
            hi = mid
            weight1 = value
            weight0 *= 0.5
            if value > -0.5 * PENETRATED:
                break
    return 1, hi
