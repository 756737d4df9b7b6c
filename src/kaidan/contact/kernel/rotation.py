"""Rotating about one contact: where the centroid goes, and how far it may.

::

        C
       /|        vertex: the body turns rigidly about the vertex
      / |        disc on a segment: it rolls, the centre moves by -r dphi along the segment
     o--+-->     Delta < 0: nose down; Delta > 0: nose up
"""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.kernel.gaps import centre_of, disc_of
from kaidan.contact.kernel.trigonometry import asin, atan2, cosine_sine, placed
from kaidan.contact.layout import (
    KIND_MASK,
    PART,
    PART_MASK,
    POINT,
    POINT_BITS,
    VERTEX,
    At,
    Scene,
)

NEVER = 1e9


@entry
def turned(
    scene: Scene, pivot: int, x: float, z: float, phi: float, angle: float
) -> tuple[float, float]:
    """Centroid after turning by ``angle`` about a contact: closed form, rolling included."""
    c, s = cosine_sine(angle)
    return carried(scene, pivot, placed(x, z, phi), angle, c, s)


def carried(
    scene: Scene, pivot: int, at: At, angle: float, c: float, s: float
) -> tuple[float, float]:
    """Centroid after turning by ``angle``; ``c`` and ``s`` are its cosine and sine."""
    point = scene.ground[pivot >> POINT_BITS]
    if pivot & KIND_MASK == VERTEX:
        d_x = at.x - point.x
        d_z = at.z - point.z
        return point.x + c * d_x - s * d_z, point.z + s * d_x + c * d_z
    disc = disc_of(scene, pivot)
    o_x = at.c * disc.x - at.s * disc.z
    o_z = at.s * disc.x + at.c * disc.z
    roll = -disc.r * angle
    return (
        at.x + o_x + roll * point.u_x - c * o_x + s * o_z,
        at.z + o_z + roll * point.u_z - s * o_x - c * o_z,
    )


def turned_on(scene: Scene, pivot: int, at: At, sense: float, angle: float) -> At:
    """Where the body is after turning by an angle in a sense about a contact."""
    c, s = cosine_sine(angle)
    return turned_by(scene, pivot, at, sense, angle, c, s)


def turned_by(
    scene: Scene, pivot: int, at: At, sense: float, angle: float, cosine: float, sine: float
) -> At:
    """The same of an angle whose cosine and sine are known."""
    c = cosine
    s = sense * sine
    x, z = carried(scene, pivot, at, sense * angle, c, s)
    return At(x, z, at.c * c - at.s * s, at.s * c + at.c * s)


def foot_limit(scene: Scene, pivot: int, at: At, sense: float) -> float:
    """Turn after which a rolling disc's foot reaches the end of its segment [rad]; vertex: 1e9."""
    if pivot & KIND_MASK == VERTEX:
        return NEVER
    point = scene.ground[pivot >> POINT_BITS]
    disc = disc_of(scene, pivot)
    c_x, c_z = centre_of(disc, at)
    foot = (c_x - point.x) * point.u_x + (c_z - point.z) * point.u_z
    if sense > 0.0:
        return max(foot, 0.0) / disc.r
    return max(point.length - foot, 0.0) / disc.r


def next_pivot(scene: Scene, pivot: int, sense: float) -> int:
    """Name of the pivot after its disc has run to the end of its segment.

    Over the end of the terrain itself it turns about that end.
    """
    ground = scene.ground
    k = pivot >> POINT_BITS
    part = pivot & (PART * PART_MASK)
    if sense > 0.0:
        if ground[k].convex or k == 0:
            return POINT * k + part
        return POINT * (k - 1) + (pivot & (POINT - 1))
    if ground[k + 1].convex or k + 2 == len(ground):
        return POINT * (k + 1) + part
    return POINT * (k + 1) + (pivot & (POINT - 1))


def angle_until_over(
    scene: Scene, pivot: int, at: At, sense: float, kappa: float, below: bool
) -> float:
    """Turn after which the centroid stands over the pivot, or hangs below it [rad]; 1e9: never.

    With d the centroid from the vertex (or from the centre of the rolling disc), t the angle of
    effective gravity: |d| sin(t - angle of d) = q, q = 0 for a vertex, and for a disc its contact's
    offset from the gravity line through its centre; the second root of the sine is the stable one,
    on which a disc comes to rest rocking. A vertex is never hung from within 90 degrees.
    """
    point = scene.ground[pivot >> POINT_BITS]
    if pivot & KIND_MASK == VERTEX:
        if below:
            return NEVER
        d_x = at.x - point.x
        d_z = at.z - point.z
        angle = sense * atan2(d_x - kappa * d_z, d_z + kappa * d_x)
        return angle + 2.0 * math.pi if angle < -1e-9 else angle
    disc = disc_of(scene, pivot)
    d_x = at.s * disc.z - at.c * disc.x
    d_z = -at.s * disc.x - at.c * disc.z
    ratio = disc.r * (point.u_z + kappa * point.u_x)
    size = math.sqrt((d_x * d_x + d_z * d_z) * (1.0 + kappa * kappa))
    if abs(ratio) >= size:
        return NEVER
    lean = asin(ratio / size)
    if below:
        lean = math.pi - lean
    angle = sense * (atan2(1.0, kappa) - lean - atan2(d_z, d_x))
    return angle + 2.0 * math.pi if angle < -1e-9 else angle
