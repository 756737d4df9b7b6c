"""Resting from scratch: the touching height at given x and phi, and the stable pose at given x.

::

    z_C(x, phi) = max over terrain of [h - underside], reached at a vertex under the outline or
    where an end disc is tangent to a segment; Delta = x_contact - x_C.

    Delta > 0: the nose goes up.  Delta < 0: it comes down.  Stable: + to - as phi grows.
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    CONVEX,
    COSINE,
    DISC_1,
    DISC_2,
    E_X,
    E_Z,
    LENGTH,
    NO_FEATURE,
    PART,
    POINT,
    R1,
    R2,
    SINE,
    U_X,
    U_Z,
    X1,
    X2,
    Z1,
    Z2,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.gaps import FAR, contact_point, gap, relabelled
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.tables import BodyTable, GroundTable


@entry
def touching(
    ground: GroundTable, body: BodyTable, x: float, c: float, s: float
) -> tuple[float, int]:
    """Lowest height of the centroid at which nothing is penetrated, and the feature that touches.

    Valid for inclinations within 90 degrees either way.  Vertical risers are passed over: a disc
    beside a riser is lifted onto it only when some part of it lies above the riser's edge.

    Returns
    -------
    z [m], feature
    """
    z, feature, _ = touching_near(ground, body, x, c, s, 0)
    return z, feature


def touching_near(
    ground: GroundTable, body: BodyTable, x: float, c: float, s: float, hint: int
) -> tuple[float, int, int]:
    """The same, with a point of the terrain near the rear of the robot, from the call before.

    Returns
    -------
    z [m], feature, hint for the next call
    """
    n = ground.shape[0]
    best = -FAR
    which = NO_FEATURE
    for part in range(body.shape[0]):
        r1 = body[part, R1]
        r2 = body[part, R2]
        # disc centres and lower common tangent, relative to the centroid, in the world
        x1 = c * body[part, X1] - s * body[part, Z1]
        z1 = s * body[part, X1] + c * body[part, Z1]
        x2 = c * body[part, X2] - s * body[part, Z2]
        z2 = s * body[part, X2] + c * body[part, Z2]
        e_x = c * body[part, E_X] - s * body[part, E_Z]
        e_z = s * body[part, E_X] + c * body[part, E_Z]
        cosine = body[part, COSINE]
        if e_x < 0.0:
            cosine = -cosine
        n_x = body[part, SINE] * e_x + cosine * e_z
        n_z = body[part, SINE] * e_z - cosine * e_x
        t1_x = x1 + r1 * n_x
        t1_z = z1 + r1 * n_z
        t2_x = x2 + r2 * n_x
        t2_z = z2 + r2 * n_z
        slope = 0.0
        if t2_x != t1_x:
            slope = (t2_z - t1_z) / (t2_x - t1_x)
        left = x + min(x1 - r1, x2 - r2)
        right = x + max(x1 + r1, x2 + r2)
        k = first_index(ground, left, hint)
        hint = k
        while k < n - 1 and ground[k, X] <= right:
            if ground[k, CONVEX] == 1.0:
                d = ground[k, X] - x
                if (d - t1_x) * (d - t2_x) <= 0.0:
                    z = ground[k, Z] - (t1_z + slope * (d - t1_x))
                    if z > best:
                        best = z
                        which = POINT * k + PART * part
                else:
                    h1 = r1 * r1 - (d - x1) * (d - x1)
                    if h1 >= 0.0:
                        z = ground[k, Z] - (z1 - math.sqrt(h1))
                        if z > best:
                            best = z
                            which = POINT * k + PART * part
                    h2 = r2 * r2 - (d - x2) * (d - x2)
                    if h2 >= 0.0:
                        z = ground[k, Z] - (z2 - math.sqrt(h2))
                        if z > best:
                            best = z
                            which = POINT * k + PART * part
            u_x = ground[k, U_X]
            u_z = ground[k, U_Z]
            if u_x > 1e-9:
                to_x = x + x1 - ground[k, X]
                foot_x = to_x + r1 * u_z
                if foot_x >= 0.0 and foot_x <= ground[k, LENGTH] * u_x:
                    z = ground[k, Z] + (r1 + u_z * to_x) / u_x - z1
                    if z > best:
                        best = z
                        which = POINT * k + PART * part + DISC_1
                to_x = x + x2 - ground[k, X]
                foot_x = to_x + r2 * u_z
                if foot_x >= 0.0 and foot_x <= ground[k, LENGTH] * u_x:
                    z = ground[k, Z] + (r2 + u_z * to_x) / u_x - z2
                    if z > best:
                        best = z
                        which = POINT * k + PART * part + DISC_2
            k += 1
    return best, which, hint


def lever(
    ground: GroundTable,
    body: BodyTable,
    feature: int,
    x: float,
    z: float,
    c: float,
    s: float,
    kappa: float,
) -> float:
    """Delta of one contact [m]: how far ahead of the effective gravity line it lies.

    ``kappa`` is the tilt of effective gravity, a cos psi / (g + a sin psi); 0 at rest.
    """
    p_x, p_z = contact_point(ground, body, feature, x, z, c, s)
    return p_x - x + kappa * (z - p_z)


@entry
def settle(
    ground: GroundTable, body: BodyTable, x: float, phi: float, kappa: float
) -> tuple[bool, float, float, int, int]:
    """Stable pose at a given x, the first one in the direction in which the robot turns from phi.

    Parameters
    ----------
    ground, body
        Tables.
    x
        Centroid [m].
    phi
        Inclination from which it settles [rad].
    kappa
        Tilt of effective gravity.

    Returns
    -------
    found, z [m], phi [rad], rear feature, front feature.  ``found`` is False if it turns past
    90 degrees.
    """
    c = math.cos(phi)
    s = math.sin(phi)
    z, feature, hint = touching_near(ground, body, x, c, s, 0)
    delta = lever(ground, body, feature, x, z, c, s, kappa)
    up = delta > 0.0
    step = 0.004
    while True:
        trial = phi + step if up else phi - step
        if abs(trial) > 0.5 * math.pi:
            return False, z, phi, feature, NO_FEATURE
        c = math.cos(trial)
        s = math.sin(trial)
        z, f_trial, hint = touching_near(ground, body, x, c, s, hint)
        delta = lever(ground, body, f_trial, x, z, c, s, kappa)
        if (delta > 0.0) != up:
            break
        phi = trial
        feature = f_trial
        step = min(1.6 * step, 0.05)
    lo, f_lo, hi, f_hi = phi, feature, trial, f_trial
    if not up:
        lo, f_lo, hi, f_hi = trial, f_trial, phi, feature
    for _ in range(80):
        mid = 0.5 * (lo + hi)
        # both contacts at once: Newton on (z, phi) at fixed x
        q_phi = mid
        q_z = z
        good = False
        for _ in range(6):
            c = math.cos(q_phi)
            s = math.sin(q_phi)
            g1, m_x, m_z, p_x, p_z = gap(ground, body, f_lo, x, q_z, c, s)
            g2, n_x, n_z, o_x, o_z = gap(ground, body, f_hi, x, q_z, c, s)
            if abs(g1) < 1e-13 and abs(g2) < 1e-13:
                good = True
                break
            w1 = (p_x - x) * m_z - (p_z - q_z) * m_x
            w2 = (o_x - x) * n_z - (o_z - q_z) * n_x
            det = m_z * w2 - n_z * w1
            if abs(det) < 1e-9:
                break
            q_z -= (g1 * w2 - g2 * w1) / det
            q_phi -= (m_z * g2 - n_z * g1) / det
            if q_phi < lo - 1e-3 or q_phi > hi + 1e-3:
                break
        trial = q_phi
        if not good or q_phi < lo - 1e-12 or q_phi > hi + 1e-12:
            good = False
            trial = mid
            c = math.cos(mid)
            s = math.sin(mid)
        z, f_trial, hint = touching_near(ground, body, x, c, s, hint)
        if good and z <= q_z + 1e-12:
            return True, q_z, trial, f_hi, f_lo
        if hi - lo < 1e-14:
            break
        if lever(ground, body, f_trial, x, z, c, s, kappa) > 0.0:
            lo = trial
            f_lo = f_trial
        else:
            hi = trial
            f_hi = f_trial
    # where an end passes a face the height jumps, to that on the vertex above it: it stands below,
    # against the face
    c = math.cos(lo)
    s = math.sin(lo)
    z, _, hint = touching_near(ground, body, x, c, s, hint)
    z_hi, _, hint = touching_near(ground, body, x, math.cos(hi), math.sin(hi), hint)
    trial = lo
    if z_hi < z:
        trial = hi
        z = z_hi
        c = math.cos(hi)
        s = math.sin(hi)
    rear = relabelled(ground, body, f_hi, x, z, c, s)
    front = relabelled(ground, body, f_lo, x, z, c, s)
    return True, z, trial, rear, front
