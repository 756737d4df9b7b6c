"""Rotating about one contact: where the centroid goes, and how far it may.

::

        C
       /|        vertex: the body turns rigidly about the vertex
      / |        disc on a segment: it rolls, the centre moves by -r dphi along the segment
     o--+-->     Delta < 0: nose down; Delta > 0: nose up
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    CONVEX,
    DISC,
    DISC_1,
    DISC_R,
    DISC_X,
    DISC_Z,
    KIND_MASK,
    LENGTH,
    PART,
    PART_BITS,
    PART_MASK,
    POINT,
    POINT_BITS,
    U_X,
    U_Z,
    VERTEX,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.tables import BodyTable, GroundTable

NEVER = 1e9


@entry
def turned(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, phi: float, angle: float
) -> tuple[float, float]:
    """Centroid after turning by ``angle`` about a contact: closed form, rolling included."""
    return carried(
        ground, body, pivot, x, z, math.cos(phi), math.sin(phi), angle,
        math.cos(angle), math.sin(angle),
    )  # fmt: skip


def carried(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, c0: float, s0: float,
    angle: float, c: float, s: float,
) -> tuple[float, float]:  # fmt: skip
    """Centroid after turning by ``angle``; cosines and sines of the inclination and of the turn."""
    kind = pivot & KIND_MASK
    k = pivot >> POINT_BITS
    if kind == VERTEX:
        g_x = ground[k, X]
        g_z = ground[k, Z]
        d_x = x - g_x
        d_z = z - g_z
        return g_x + c * d_x - s * d_z, g_z + s * d_x + c * d_z
    part = (pivot >> PART_BITS) & PART_MASK
    j = DISC * (kind - DISC_1)
    b_x = body[part, j + DISC_X]
    b_z = body[part, j + DISC_Z]
    o_x = c0 * b_x - s0 * b_z
    o_z = s0 * b_x + c0 * b_z
    roll = -body[part, j + DISC_R] * angle
    return (
        x + o_x + roll * ground[k, U_X] - c * o_x + s * o_z,
        z + o_z + roll * ground[k, U_Z] - s * o_x - c * o_z,
    )


def foot_limit(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, c: float, s: float,
    sense: float,
) -> float:  # fmt: skip
    """Turn after which a rolling disc's foot reaches the end of its segment [rad] (inf: vertex)."""
    kind = pivot & KIND_MASK
    if kind == VERTEX:
        return 1e9
    k = pivot >> POINT_BITS
    part = (pivot >> PART_BITS) & PART_MASK
    j = DISC * (kind - DISC_1)
    c_x = x + c * body[part, j + DISC_X] - s * body[part, j + DISC_Z]
    c_z = z + s * body[part, j + DISC_X] + c * body[part, j + DISC_Z]
    foot = (c_x - ground[k, X]) * ground[k, U_X] + (c_z - ground[k, Z]) * ground[k, U_Z]
    if sense > 0.0:
        return float(max(foot, 0.0) / body[part, j + DISC_R])
    return float(max(ground[k, LENGTH] - foot, 0.0) / body[part, j + DISC_R])


def next_pivot(
    ground: GroundTable, body: BodyTable, pivot: int, x: float, z: float, phi: float, sense: float
) -> int:
    """Name of the pivot after its disc has run to the end of its segment.

    Over the end of the terrain itself it turns about that end.
    """
    k = pivot >> POINT_BITS
    part = (pivot >> PART_BITS) & PART_MASK
    if sense > 0.0:
        if ground[k, CONVEX] == 1.0 or k == 0:
            return POINT * k + PART * part
        return POINT * (k - 1) + (pivot & (POINT - 1))
    if ground[k + 1, CONVEX] == 1.0 or k + 2 == ground.shape[0]:
        return POINT * (k + 1) + PART * part
    return POINT * (k + 1) + (pivot & (POINT - 1))


def angle_until_over(
    ground: GroundTable,
    body: BodyTable,
    pivot: int,
    x: float,
    z: float,
    c: float,
    s: float,
    sense: float,
    kappa: float,
    below: bool,
) -> float:
    """Turn after which the centroid stands over the pivot, or hangs below it [rad]; 1e9: never.

    With d the centroid from the vertex (or from the centre of the rolling disc), t the angle of
    effective gravity: |d| sin(t - angle of d) = q, q = 0 for a vertex, and for a disc its contact's
    offset from the gravity line through its centre; the second root of the sine is the stable one,
    on which a disc comes to rest rocking. A vertex is never hung from within 90 degrees.
    """
    k = pivot >> POINT_BITS
    if pivot & KIND_MASK == VERTEX:
        if below:
            return NEVER
        d_x = x - ground[k, X]
        d_z = z - ground[k, Z]
        angle = sense * math.atan2(d_x - kappa * d_z, d_z + kappa * d_x)
        return angle + 2.0 * math.pi if angle < -1e-9 else angle
    part = (pivot >> PART_BITS) & PART_MASK
    j = DISC * ((pivot & KIND_MASK) - DISC_1)
    d_x = s * body[part, j + DISC_Z] - c * body[part, j + DISC_X]
    d_z = -s * body[part, j + DISC_X] - c * body[part, j + DISC_Z]
    ratio = body[part, j + DISC_R] * (ground[k, U_Z] + kappa * ground[k, U_X])
    size = math.sqrt((d_x * d_x + d_z * d_z) * (1.0 + kappa * kappa))
    if abs(ratio) >= size:
        return NEVER
    lean = math.asin(ratio / size)
    if below:
        lean = math.pi - lean
    angle = sense * (math.atan2(1.0, kappa) - lean - math.atan2(d_z, d_x))
    return angle + 2.0 * math.pi if angle < -1e-9 else angle
