r"""How far a pose is from rocking and from a fall: rise of the centroid, and tilt of gravity.

::

    turned on about the outermost contact against gravity,      C  .   over the pivot: the rise is
    and about each that closes farther out on the way         / .      known from one angle, unless
                                                            /.         the tail (or the nose) comes
                                                           o  \        down on the way
                                                       pivot   \ tail
                                                                `.___

Each pivot holds up to the tilt at which the gravity line passes it, the angle between that line and
the line pivot - centroid as the pivot takes over. On its way the robot comes to rest wherever two
contacts straddle the gravity line. A rest within `tolerance` of the pose counts as the same pose:
the robot has rocked.
"""

from __future__ import annotations

import math

from kaidan.contact.kernel.first_closing import first_closing
from kaidan.contact.kernel.gaps import gap, on_flat
from kaidan.contact.kernel.rotation import angle_until_over, foot_limit, next_pivot, turned
from kaidan.contact.kernel.settling import lever
from kaidan.contact.tables import BodyTable, GroundTable

#: A contact that closes as the centroid comes over the pivot, or this much beyond [rad], closes
#: first: a robot that rotates back to where its rotation began stands there on what carried it.
AS_IT_COMES_OVER = 1e-6


def barrier(
    ground: GroundTable,
    body: BodyTable,
    pivot: int,
    x: float,
    z: float,
    phi: float,
    sense: float,
    kappa: float,
    tolerance: float,
    hint: int,
) -> tuple[bool, float, int]:
    """Rise of the centroid along the flow before it turns by more than rocking: the energy margin.

    It turns about ``pivot`` against gravity; where another gap closes farther out the turn goes on
    about that contact, until the centroid stands over the pivot. If it then comes to rest within
    ``tolerance`` [rad] of the pose, the turn goes on from there.

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
    for _ in range(60):
        delta = lever(ground, body, pivot, x, z, math.cos(phi), math.sin(phi), kappa)
        over = 0.0
        if delta * sense < 0.0:
            over = max(angle_until_over(ground, body, pivot, x, z, phi, sense, kappa, False), 0.0)
        elif total >= tolerance:
            return True, best, hint
        most = 0.5 * math.pi - total
        if most <= 0.0:
            return False, best, hint
        limit = foot_limit(ground, body, pivot, x, z, phi, sense)
        end = min(limit, most)
        if over <= end:  # past the pivot only as far as rocking is tolerated
            end = min(max(over + AS_IT_COMES_OVER, tolerance - total), end)
        closed, angle, hint = first_closing(ground, body, pivot, x, z, phi, sense, end, hint)
        if over < angle:
            top_x, top_z = turned(ground, body, pivot, x, z, phi, sense * over)
            best = max(best, (top_z + kappa * top_x) / down - height)
        x, z = turned(ground, body, pivot, x, z, phi, sense * angle)
        phi += sense * angle
        total += angle
        best = max(best, (z + kappa * x) / down - height)
        if closed >= 0:
            pivot = closed
        elif over <= angle and angle < limit:
            return True, best, hint
        elif limit <= angle:
            pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
        else:
            return False, best, hint
    return False, best, hint


def lean(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, phi: float,
    sense: float, kappa: float,
) -> float:  # fmt: skip
    """Tilt of gravity at which its line through the centroid passes a contact [rad]."""
    _, _, _, p_x, p_z = gap(ground, body, pivot, x, z, math.cos(phi), math.sin(phi))
    return math.atan2(sense * (x - p_x - kappa * (z - p_z)), z - p_z + kappa * (x - p_x))


def carrying_tilt(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, phi: float,
    sense: float, kappa: float, tolerance: float, hint: int,
) -> tuple[float, float, int]:  # fmt: skip
    """Tilt of gravity beyond which a pose rotates by more than rocking.

    Of the nosings under the flats all within ``tolerance`` carry, those that the robot has to rock
    onto too; an end that only comes to touch in rotating does not.

    Parameters
    ----------
    pivot
        Outermost contact on the side to which it would turn.
    sense
        +1 nose up, -1 nose down.
    tolerance
        Rotation that is rocking [rad].

    Returns
    -------
    tilt [rad]
        Largest lean about a pivot that takes over within the tolerance.
    rocking [rad]
        Rotation after which that pivot takes over.
    hint
    """
    most = lean(ground, body, pivot, x, z, phi, sense, kappa)
    rocking = 0.0
    total = 0.0
    for _ in range(20):
        limit = foot_limit(ground, body, pivot, x, z, phi, sense)
        closed, angle, hint = first_closing(
            ground, body, pivot, x, z, phi, sense, min(tolerance - total, limit), hint
        )
        x, z = turned(ground, body, pivot, x, z, phi, sense * angle)
        phi += sense * angle
        total += angle
        if closed >= 0:
            pivot = closed
            held = lean(ground, body, pivot, x, z, phi, sense, kappa)
            if held > most and on_flat(ground, body, pivot, x, z, math.cos(phi), math.sin(phi)):
                most = held
                rocking = total
        elif limit <= angle:
            pivot = next_pivot(ground, body, pivot, x, z, phi, sense)
        if total >= tolerance:
            break
    return most, rocking, hint
