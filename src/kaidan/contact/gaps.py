"""Features and their signed gaps: what can touch what, and how far it is from touching.

::

    feature (vertex, part)            feature (end disc, segment)

      .---------------------.             ,---.
     (   flat    | n         )           (  c  )
      '----------+----------'             `-+-'   gap = m.(c - P) - r,
                 | gap                 m ^  | gap  while the foot of c lies in the segment
                 o vertex               P o-+--------o

A vertex is measured to the whole outline of a part (arc, flat, arc): the gap is C1 from flat to
arc.  From vertex to segment it is C1 as well, so a contact may be relabelled without a jump.

A feature is one integer, ``64 k + 4 part + type`` with k the vertex or segment and type 0 (vertex
on part), 1 or 2 (disc 1 or 2 on segment); -1 is "none".
"""

from __future__ import annotations

import math

from kaidan.contact.compiling import kernel, leaf
from kaidan.contact.tables import FloatArray

#: Parts thinner than this are given that much inside below their axis [m], so that a step of some
#: millimetres into a thin part is still seen as "too deep" and not as "through".
INSIDE = 0.01
FAR = 1e9


@leaf
def is_above(
    ground: FloatArray,
    body: FloatArray,
    part: int,
    k: int,
    x: float,
    c: float,
    s: float,
    below: float,
) -> bool:
    """Whether a vertex beyond the axis of a part is outside it, above, and not deep inside.

    The ground reaches down from every vertex, so a vertex just above a thin part has gone through
    it if the part lies under it; a vertex ahead of a lowered nose, or behind a lowered tail, is
    simply above.
    """
    if below < min(body[part, 2], body[part, 5]) - INSIDE:
        return True
    x1 = x + c * body[part, 0] - s * body[part, 1]
    x2 = x + c * body[part, 3] - s * body[part, 4]
    v = ground[k, 0]
    left = min(x1 - body[part, 2], x2 - body[part, 5])
    right = max(x1 + body[part, 2], x2 + body[part, 5])
    return bool(v <= left or v >= right)


@leaf
def gap(
    ground: FloatArray,
    body: FloatArray,
    feature: int,
    x: float,
    z: float,
    c: float,
    s: float,
) -> tuple[float, float, float, float, float]:
    """Signed gap of one feature, its normal and its contact point.

    The gradient of the gap to (x, z, phi) is ``(n_x, n_z, (p_x - x) n_z - (p_z - z) n_x)``.

    Parameters
    ----------
    ground, body
        Tables of :mod:`kaidan.contact.tables`.
    feature
        Code of the feature.
    x, z
        Centroid [m].
    c, s
        Cosine and sine of the inclination.

    Returns
    -------
    gap [m], n_x, n_z (unit, from the ground into the robot), p_x, p_z [m]
    """
    kind = feature & 3
    part = (feature >> 2) & 15
    k = feature >> 6
    if kind == 0:
        d_x = ground[k, 0] - x
        d_z = ground[k, 1] - z
        a_x = c * d_x + s * d_z - body[part, 0]
        a_z = c * d_z - s * d_x - body[part, 1]
        e_x = body[part, 6]
        e_z = body[part, 7]
        side = body[part, 12]
        along = a_x * e_x + a_z * e_z
        below = side * (a_x * e_z - a_z * e_x)
        if below < 0.0 and is_above(ground, body, part, k, x, c, s, below):
            below = -below
            side = -side
        w = along * body[part, 10] - below * body[part, 9]
        if w > 0.0 and w < body[part, 11]:
            distance = along * body[part, 9] + below * body[part, 10] - body[part, 2]
            nu = body[part, 9]
            nv = body[part, 10]
        else:
            radius = body[part, 2]
            if w > 0.0:
                along -= body[part, 8]
                radius = body[part, 5]
            rho = math.sqrt(along * along + below * below)
            distance = rho - radius
            if rho > 1e-15:
                nu = along / rho
                nv = below / rho
            else:
                nu = body[part, 9]
                nv = body[part, 10]
        b_x = nu * e_x + nv * side * e_z
        b_z = nu * e_z - nv * side * e_x
        return distance, s * b_z - c * b_x, -s * b_x - c * b_z, ground[k, 0], ground[k, 1]
    j = 3 * (kind - 1)
    c_x = x + c * body[part, j] - s * body[part, j + 1]
    c_z = z + s * body[part, j] + c * body[part, j + 1]
    radius = body[part, j + 2]
    n_x = -ground[k, 3]
    n_z = ground[k, 2]
    distance = n_x * (c_x - ground[k, 0]) + n_z * (c_z - ground[k, 1]) - radius
    reach = radius + distance
    return distance, n_x, n_z, c_x - reach * n_x, c_z - reach * n_z


@leaf
def relabelled(
    ground: FloatArray, body: FloatArray, feature: int, x: float, z: float, c: float, s: float
) -> int:
    """Name the same contact as it is called at this pose.

    A disc whose foot has run past the end of its segment stands on the vertex there; a vertex
    under an end disc whose centre has come over one of the vertex's segments is a contact with that
    segment.  Both changes are C1, so they are no events.
    """
    kind = feature & 3
    part = (feature >> 2) & 15
    k = feature >> 6
    if kind == 0:
        d_x = ground[k, 0] - x
        d_z = ground[k, 1] - z
        a_x = c * d_x + s * d_z - body[part, 0]
        a_z = c * d_z - s * d_x - body[part, 1]
        along = a_x * body[part, 6] + a_z * body[part, 7]
        below = body[part, 12] * (a_x * body[part, 7] - a_z * body[part, 6])
        if below < 0.0 and is_above(ground, body, part, k, x, c, s, below):
            below = -below
        w = along * body[part, 10] - below * body[part, 9]
        if w > 0.0 and w < body[part, 11]:
            return feature
        kind = 1
        if w > 0.0:
            kind = 2
        j = 3 * (kind - 1)
        to_x = x + c * body[part, j] - s * body[part, j + 1] - ground[k, 0]
        to_z = z + s * body[part, j] + c * body[part, j + 1] - ground[k, 1]
        if to_x * ground[k, 2] + to_z * ground[k, 3] > 0.0:
            return 64 * k + 4 * part + kind
        if to_x * ground[k - 1, 2] + to_z * ground[k - 1, 3] < 0.0:
            return 64 * (k - 1) + 4 * part + kind
        return feature
    j = 3 * (kind - 1)
    to_x = x + c * body[part, j] - s * body[part, j + 1] - ground[k, 0]
    to_z = z + s * body[part, j] + c * body[part, j + 1] - ground[k, 1]
    foot = to_x * ground[k, 2] + to_z * ground[k, 3]
    if foot < 0.0 and ground[k, 5] == 1.0:
        return 64 * k + 4 * part
    if foot > ground[k, 4] and ground[k + 1, 5] == 1.0:
        return 64 * (k + 1) + 4 * part
    return feature


@kernel
def on_flat(
    ground: FloatArray, body: FloatArray, feature: int, x: float, z: float, c: float, s: float
) -> bool:
    """Whether a feature is a vertex under the straight underside of its part."""
    if feature & 3 != 0:
        return False
    part = (feature >> 2) & 15
    k = feature >> 6
    d_x = ground[k, 0] - x
    d_z = ground[k, 1] - z
    a_x = c * d_x + s * d_z - body[part, 0]
    a_z = c * d_z - s * d_x - body[part, 1]
    along = a_x * body[part, 6] + a_z * body[part, 7]
    below = body[part, 12] * (a_x * body[part, 7] - a_z * body[part, 6])
    w = along * body[part, 10] - below * body[part, 9]
    return bool(0.0 <= w <= body[part, 11])
