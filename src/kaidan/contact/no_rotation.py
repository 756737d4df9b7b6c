"""Grade one: no rotation at all, the paper's criterion on any profile.

::

        flat of length L, centroid s_C from its rear tip, C_N above
        rear tip                         front tip
           |----o--------o-------o-----------|
         lost   j        |                   made next: V_m
                       s_z = s_C - C_N (tan theta + a / (g cos theta)):  gravity line

    back: when the rear tip leaves a nosing, the next contact j on the flat must lie on the
          downhill side of the gravity line:  s_j <= s_z
    front: when the front tip is about to reach V_m, the last contact l on the flat must lie on
          the uphill side:  s_l >= s_z

Both are judged on the undisturbed pose, from the nosings alone: no end radius enters, and nothing
is measured on a robot that has begun to rotate.  On uniform nosings they are
``theta_s_sup(a)`` with ``x = L - p - C_L`` and ``theta_s_inf`` with ``x = p - C_L`` (theory
section 3).  Poses that touch a segment as long as the flat are entering or landing and are left
out.  On irregular nosings a contact counts as "on the flat" if it lies within ``slack`` below it;
the inclination is then that of the two contacts on which the flat comes to rest.
"""

from __future__ import annotations

import math

import numpy as np

from kaidan.contact.compiling import entry
from kaidan.contact.tables import FloatArray

CRITERION_COLUMNS = 9


@entry
def flat_of(body: FloatArray) -> tuple[float, float, float, float]:
    """Straight underside: length, centroid from its front tip, centroid above it, tilt in the body.

    The longest track part, lengthened by parts whose undersides lie in the same line within 1e-9 m
    and touch it within 1 mm (flippers laid out flat).

    Returns
    -------
    L, C_L, C_N [m], tilt [rad] (inclination of the flat = inclination of the body + tilt)
    """
    main = -1
    longest = -1.0
    for part in range(body.shape[0]):
        if body[part, 13] == 0.0 and body[part, 11] > longest:
            longest = body[part, 11]
            main = part
    if main < 0 or longest <= 0.0:
        return 0.0, math.nan, math.nan, math.nan
    e_x = body[main, 6]
    e_z = body[main, 7]
    side = body[main, 12]
    n_x = body[main, 9] * e_x + body[main, 10] * side * e_z
    n_z = body[main, 9] * e_z - body[main, 10] * side * e_x
    u_x = -n_z
    u_z = n_x
    depth = n_x * body[main, 0] + n_z * body[main, 1] + body[main, 2]
    s1 = u_x * body[main, 0] + u_z * body[main, 1]
    s2 = u_x * body[main, 3] + u_z * body[main, 4]
    rear = min(s1, s2)
    front = max(s1, s2)
    for _ in range(body.shape[0]):
        for part in range(body.shape[0]):
            if body[part, 13] == 2.0 or body[part, 11] <= 0.0:
                continue
            d1 = n_x * body[part, 0] + n_z * body[part, 1] + body[part, 2]
            d2 = n_x * body[part, 3] + n_z * body[part, 4] + body[part, 5]
            if abs(d1 - depth) > 1e-9 or abs(d2 - depth) > 1e-9:
                continue
            s1 = u_x * body[part, 0] + u_z * body[part, 1]
            s2 = u_x * body[part, 3] + u_z * body[part, 4]
            if min(s1, s2) <= front + 1e-3 and max(s1, s2) >= rear - 1e-3:
                rear = min(rear, s1, s2)
                front = max(front, s1, s2)
    return front - rear, front, depth, math.atan2(u_z, u_x)


@entry
def limit_angle(x: float, C_N: float, a: float, g: float) -> float:
    """Slope at which the gravity line passes a contact x behind the centroid's foot [rad].

    ``arccos(C_N a / (g hypot(x, C_N))) - atan2(C_N, x)``; NaN if no slope does.

    Examples
    --------
    >>> round(math.degrees(limit_angle(0.124, 0.071, 0.0, 9.80665)), 3)
    60.205
    """
    ratio = C_N * a / (g * math.hypot(x, C_N))
    if abs(ratio) > 1.0:
        return math.nan
    return math.acos(ratio) - math.atan2(C_N, x)


@entry
def no_rotation(
    ground: FloatArray,
    body: FloatArray,
    x_start: float,
    x_end: float,
    a: float,
    g: float,
    slack: float,
    out: FloatArray,
) -> int:
    """Judge every loss and every gain of a contact of the flat by the criterion above.

    Parameters
    ----------
    ground, body
        Tables.
    x_start, x_end
        Only nosings between these are judged [m].
    a, g
        Acceleration along the flat, gravity [m/s^2].
    slack
        How far below the flat a nosing may lie and still count as on it [m].
    out
        Table to be filled (n, 9): +1 back or -1 front; index, x, z of the nosing lost or made;
        inclination of the flat [rad]; margin [m], margin [rad] (positive when safe; NaN where no
        slope is the limit); contacts that remain on the flat; index of the contact judged.

    Returns
    -------
    number of rows (fewer than two remaining contacts: margins are NaN, outside the criterion)
    """
    L, C_L, C_N, _ = flat_of(body)
    if L <= 0.0:
        return 0
    n = ground.shape[0]
    rows = 0
    chain = np.empty(256, dtype=np.int64)
    for i in range(1, n - 1):
        if ground[i, 5] != 1.0 or ground[i, 0] < x_start or ground[i, 0] > x_end:
            continue
        for side in (1, -1):
            if rows >= out.shape[0]:
                return rows
            # inclination of the flat with this tip on vertex i and everything else below it
            steepest = -1e9 if side > 0 else 1e9
            k = i + side
            while 0 < k < n - 1 and abs(ground[k, 0] - ground[i, 0]) <= L:
                d_x = ground[k, 0] - ground[i, 0]
                d_z = ground[k, 1] - ground[i, 1]
                if ground[k, 5] == 1.0 and abs(d_x) > 1e-9 and math.hypot(d_x, d_z) <= L + 1e-12:
                    slope = d_z / d_x
                    if (side > 0 and slope > steepest) or (side < 0 and slope < steepest):
                        steepest = slope
                k += side
            if abs(steepest) > 1e8:
                continue
            theta = math.atan(steepest)
            u_x = math.cos(theta)
            u_z = math.sin(theta)
            # entering or landing: a segment as long as the flat lies under it
            far = ground[i, 0] + side * L * u_x
            lo = min(far, ground[i, 0]) + 1e-9
            hi = max(far, ground[i, 0]) - 1e-9
            outside = False
            k = i if side > 0 else i - 1
            while 0 <= k < n - 1:
                if ground[k + 1, 0] > lo and ground[k, 0] < hi:
                    if ground[k, 4] >= L:
                        outside = True
                        break
                elif (side > 0 and ground[k, 0] >= hi) or (side < 0 and ground[k + 1, 0] <= lo):
                    break
                k += side
            if outside:
                continue
            # the contacts that stay: upper hull of the nosings on the flat, nearest first
            count = 0
            k = i + side
            while 0 < k < n - 1:
                d_x = ground[k, 0] - ground[i, 0]
                d_z = ground[k, 1] - ground[i, 1]
                along = side * (u_x * d_x + u_z * d_z)
                if abs(d_x) > L:
                    break
                depth = u_z * d_x - u_x * d_z
                if (
                    ground[k, 5] == 1.0
                    and along > 1e-9
                    and along <= L + 1e-12
                    and depth <= slack
                    and count < 256
                ):
                    while count >= 2:
                        b = chain[count - 1]
                        c = chain[count - 2]
                        cross = (ground[b, 0] - ground[c, 0]) * (ground[k, 1] - ground[c, 1]) - (
                            ground[b, 1] - ground[c, 1]
                        ) * (ground[k, 0] - ground[c, 0])
                        if side * cross > 1e-12:
                            count -= 1
                        else:
                            break
                    chain[count] = k
                    count += 1
                k += side
            j = int(chain[0]) if count > 0 else -1
            out[rows, 0] = side
            out[rows, 1] = i
            out[rows, 2] = ground[i, 0]
            out[rows, 3] = ground[i, 1]
            out[rows, 4] = theta
            out[rows, 5] = math.nan
            out[rows, 6] = math.nan
            out[rows, 7] = count
            out[rows, 8] = j
            if count >= 2:
                o = int(chain[1])
                theta = math.atan2(
                    side * (ground[o, 1] - ground[j, 1]), side * (ground[o, 0] - ground[j, 0])
                )
                out[rows, 4] = theta
                step = math.hypot(ground[j, 0] - ground[i, 0], ground[j, 1] - ground[i, 1])
                # x: from the contact judged to the foot of the centroid, along the flat
                x = L - C_L - step if side > 0 else step - C_L
                lever = x - C_N * (math.tan(theta) + a / (g * math.cos(theta)))
                out[rows, 5] = side * lever
                out[rows, 6] = side * (limit_angle(x, C_N, a, g) - theta)
            rows += 1
    return rows
