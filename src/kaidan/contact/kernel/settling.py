"""Resting from scratch: the touching height at given x and phi, and the stable pose at given x.

::

    z_C(x, phi) = max over terrain of [h - underside], reached at a vertex under the outline or
    where an end disc is tangent to a segment; Delta = x_contact - x_C.

    Delta > 0: the nose goes up.  Delta < 0: it comes down.  Stable: + to - as phi grows.
"""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.kernel.gaps import FAR, contact_point, gap, relabelled
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import (
    DISC_1,
    DISC_2,
    NO_FEATURE,
    PART,
    POINT,
    At,
    Scene,
)


@entry
def touching(scene: Scene, x: float, c: float, s: float) -> tuple[float, int]:
    """Lowest height of the centroid at which nothing is penetrated, and the feature that touches.

    Valid for inclinations within 90 degrees either way.  Vertical risers are passed over: a disc
    beside a riser is lifted onto it only when some part of it lies above the riser's edge.

    z [m], feature.
    """
    ground = scene.ground
    n = len(ground)
    best = -FAR
    which = NO_FEATURE
    for number in range(len(scene.body)):
        part = scene.body[number]
        r1 = part.one.r
        r2 = part.two.r
        # disc centres and lower common tangent, relative to the centroid, in the world
        x1 = c * part.one.x - s * part.one.z
        z1 = s * part.one.x + c * part.one.z
        x2 = c * part.two.x - s * part.two.z
        z2 = s * part.two.x + c * part.two.z
        e_x = c * part.e_x - s * part.e_z
        e_z = s * part.e_x + c * part.e_z
        cosine = -part.cosine if e_x < 0.0 else part.cosine
        n_x = part.sine * e_x + cosine * e_z
        n_z = part.sine * e_z - cosine * e_x
        t1_x = x1 + r1 * n_x
        t1_z = z1 + r1 * n_z
        t2_x = x2 + r2 * n_x
        t2_z = z2 + r2 * n_z
        slope = 0.0
        if t2_x != t1_x:
            slope = (t2_z - t1_z) / (t2_x - t1_x)
        left = x + min(x1 - r1, x2 - r2)
        right = x + max(x1 + r1, x2 + r2)
        k = first_index(scene, left)
        while k < n - 1 and ground[k].x <= right:
            point = ground[k]
            if point.convex:
                d = point.x - x
                if (d - t1_x) * (d - t2_x) <= 0.0:
                    z = point.z - (t1_z + slope * (d - t1_x))
                    if z > best:
                        best = z
                        which = POINT * k + PART * number
                else:
                    h1 = r1 * r1 - (d - x1) * (d - x1)
                    if h1 >= 0.0:
                        z = point.z - (z1 - math.sqrt(h1))
                        if z > best:
                            best = z
                            which = POINT * k + PART * number
                    h2 = r2 * r2 - (d - x2) * (d - x2)
                    if h2 >= 0.0:
                        z = point.z - (z2 - math.sqrt(h2))
                        if z > best:
                            best = z
                            which = POINT * k + PART * number
            u_x = point.u_x
            u_z = point.u_z
            if u_x > 1e-9:
                to_x = x + x1 - point.x
                foot_x = to_x + r1 * u_z
                if foot_x >= 0.0 and foot_x <= point.length * u_x:
                    z = point.z + (r1 + u_z * to_x) / u_x - z1
                    if z > best:
                        best = z
                        which = POINT * k + PART * number + DISC_1
                to_x = x + x2 - point.x
                foot_x = to_x + r2 * u_z
                if foot_x >= 0.0 and foot_x <= point.length * u_x:
                    z = point.z + (r2 + u_z * to_x) / u_x - z2
                    if z > best:
                        best = z
                        which = POINT * k + PART * number + DISC_2
            k += 1
    return best, which


def lever(scene: Scene, feature: int, at: At, kappa: float) -> float:
    """Delta of one contact [m]: how far ahead of the effective gravity line it lies.

    ``kappa`` is the tilt of effective gravity, a cos psi / (g + a sin psi); 0 at rest.
    """
    p_x, p_z = contact_point(scene, feature, at)
    return p_x - at.x + kappa * (at.z - p_z)


@entry
def settle(scene: Scene, x: float, phi: float, kappa: float) -> tuple[bool, float, float, int, int]:
    """Stable pose at a given x, the first one in the direction in which the robot turns from phi.

    Parameters
    ----------
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
    at = placed(x, 0.0, phi)
    z, feature = touching(scene, x, at.c, at.s)
    up = lever(scene, feature, At(x, z, at.c, at.s), kappa) > 0.0
    step = 0.004
    while True:
        trial = phi + step if up else phi - step
        if abs(trial) > 0.5 * math.pi:
            return False, z, phi, feature, NO_FEATURE
        at = placed(x, 0.0, trial)
        z, f_trial = touching(scene, x, at.c, at.s)
        delta = lever(scene, f_trial, At(x, z, at.c, at.s), kappa)
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
            at = placed(x, q_z, q_phi)
            g1, m_x, m_z, p_x, p_z = gap(scene, f_lo, at)
            g2, n_x, n_z, o_x, o_z = gap(scene, f_hi, at)
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
            at = placed(x, 0.0, mid)
        z, f_trial = touching(scene, x, at.c, at.s)
        if good and z <= q_z + 1e-12:
            return True, q_z, trial, f_hi, f_lo
        if hi - lo < 1e-14:
            break
        if lever(scene, f_trial, At(x, z, at.c, at.s), kappa) > 0.0:
            lo = trial
            f_lo = f_trial
        else:
            hi = trial
            f_hi = f_trial
    # where an end passes a face the height jumps, to that on the vertex above it: it stands below,
    # against the face
    at = placed(x, 0.0, lo)
    above = placed(x, 0.0, hi)
    z, _ = touching(scene, x, at.c, at.s)
    z_hi, _ = touching(scene, x, above.c, above.s)
    trial = lo
    if z_hi < z:
        trial = hi
        z = z_hi
        at = above
    at = At(x, z, at.c, at.s)
    return True, z, trial, relabelled(scene, f_hi, at), relabelled(scene, f_lo, at)
