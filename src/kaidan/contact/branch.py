"""Following a line of stable poses: two gaps held at zero, the pose moved by arclength.

::

    phi ^          t = grad g_rear x grad g_front
        |      .--->
        |   .-'          corrector: back to g_rear = g_front = 0, across t
        | -'
        +------------------> x

x is not monotone along such a line (a nose that starts up a riser moves the centroid back), hence
arclength; phi enters it times :data:`ARM`.
"""

from __future__ import annotations

import math

from kaidan.contact.compiling import kernel, leaf
from kaidan.contact.gaps import gap, relabelled
from kaidan.contact.scan import nearest
from kaidan.contact.settling import lever
from kaidan.contact.tables import FloatArray

#: Length by which inclination is counted in the arclength [m]; about half a robot, so that a step
#: means a like displacement of its ends.
ARM = 0.3
#: A gap is closed at this [m] or less: a hundred times the rounding of coordinates of metres.
CLOSED = 2e-13
#: A gap below minus this [m] is a penetration.  An end's arc leaves a nosing like e^2/(2 R), so an
#: event is seen sqrt(2 R 2e-12) = 0.5 um late for R = 60 mm; still ten times the corrector's rest.
PENETRATED = 2e-12
#: Features that close within this of one another [m] close together.
TOGETHER = 5e-10


@kernel
def tangent(
    ground: FloatArray,
    body: FloatArray,
    rear: int,
    front: int,
    x: float,
    z: float,
    c: float,
    s: float,
) -> tuple[float, float, float, float]:
    """Return the unit tangent (x, z, ARM phi) of the line of poses and its definition (0: none).

    Its sign is the forward drive's: the underside moves ahead over the contacts.
    """
    _, m_x, m_z, p_x, p_z = gap(ground, body, rear, x, z, c, s)
    _, n_x, n_z, o_x, o_z = gap(ground, body, front, x, z, c, s)
    m_w = ((p_x - x) * m_z - (p_z - z) * m_x) / ARM
    n_w = ((o_x - x) * n_z - (o_z - z) * n_x) / ARM
    t_x = m_z * n_w - m_w * n_z
    t_z = m_w * n_x - m_x * n_w
    t_w = m_x * n_z - m_z * n_x
    size = math.sqrt(t_x * t_x + t_z * t_z + t_w * t_w)
    if size < 1e-12:
        return 1.0, 0.0, 0.0, 0.0
    t_x /= size
    t_z /= size
    t_w /= size
    turn = t_w / ARM
    ahead = (
        (t_x - turn * (p_z - z)) * m_z
        - (t_z + turn * (p_x - x)) * m_x
        + (t_x - turn * (o_z - z)) * n_z
        - (t_z + turn * (o_x - x)) * n_x
    )
    if ahead < 0.0:
        return -t_x, -t_z, -t_w, size
    return t_x, t_z, t_w, size


@kernel
def gap_rate(
    ground: FloatArray,
    body: FloatArray,
    feature: int,
    x: float,
    z: float,
    c: float,
    s: float,
    t_x: float,
    t_z: float,
    t_w: float,
) -> float:
    """Change of a gap along a direction (x, z, ARM phi)."""
    _, n_x, n_z, p_x, p_z = gap(ground, body, feature, x, z, c, s)
    return n_x * t_x + n_z * t_z + ((p_x - x) * n_z - (p_z - z) * n_x) * t_w / ARM


@kernel
def corrected(
    ground: FloatArray, body: FloatArray, rear: int, front: int, x: float, z: float, phi: float
) -> tuple[bool, float, float, float, float, float, float]:
    """Nearest pose at which both gaps are closed (Newton across the tangent).

    Returns
    -------
    converged, x, z, phi, then the unit tangent (x, z, ARM phi), its sign left open
    """
    for _ in range(12):
        c = math.cos(phi)
        s = math.sin(phi)
        g1, m_x, m_z, p_x, p_z = gap(ground, body, rear, x, z, c, s)
        g2, n_x, n_z, o_x, o_z = gap(ground, body, front, x, z, c, s)
        m_w = ((p_x - x) * m_z - (p_z - z) * m_x) / ARM
        n_w = ((o_x - x) * n_z - (o_z - z) * n_x) / ARM
        t_x = m_z * n_w - m_w * n_z
        t_z = m_w * n_x - m_x * n_w
        t_w = m_x * n_z - m_z * n_x
        square = t_x * t_x + t_z * t_z + t_w * t_w
        if square < 1e-20:
            return False, x, z, phi, 1.0, 0.0, 0.0
        if abs(g1) < CLOSED and abs(g2) < CLOSED:
            size = math.sqrt(square)
            return True, x, z, phi, t_x / size, t_z / size, t_w / size
        if abs(g1) > 0.1 or abs(g2) > 0.1:
            return False, x, z, phi, 1.0, 0.0, 0.0
        # -(g1 (G2 x t) + g2 (t x G1)) / t.t
        x -= (g1 * (n_z * t_w - n_w * t_z) + g2 * (t_z * m_w - t_w * m_z)) / square
        z -= (g1 * (n_w * t_x - n_x * t_w) + g2 * (t_w * m_x - t_x * m_w)) / square
        phi -= (g1 * (n_x * t_z - n_z * t_x) + g2 * (t_x * m_z - t_z * m_x)) / (square * ARM)
    return False, x, z, phi, 1.0, 0.0, 0.0


@kernel
def stepped(
    ground: FloatArray,
    body: FloatArray,
    rear: int,
    front: int,
    x: float,
    z: float,
    phi: float,
    t_x: float,
    t_z: float,
    t_w: float,
    ds: float,
) -> tuple[bool, float, float, float, float, float, float, int, int]:
    """Pose one step of arclength further, contacts renamed where they run on.

    Returns
    -------
    good, x, z, phi, tangent (3, same sense as before), rear, front
    """
    good, x1, z1, phi1, u_x, u_z, u_w = corrected(
        ground, body, rear, front, x + ds * t_x, z + ds * t_z, phi + ds * t_w / ARM
    )
    if good:
        for _ in range(8):
            c = math.cos(phi1)
            s = math.sin(phi1)
            new_rear = relabelled(ground, body, rear, x1, z1, c, s)
            new_front = relabelled(ground, body, front, x1, z1, c, s)
            if new_rear == rear and new_front == front:
                break
            rear = new_rear
            front = new_front
            good, x1, z1, phi1, u_x, u_z, u_w = corrected(ground, body, rear, front, x1, z1, phi1)
            if not good:
                break
    if good:
        d_x = x1 - x
        d_z = z1 - z
        d_w = ARM * (phi1 - phi)
        moved = math.sqrt(d_x * d_x + d_z * d_z + d_w * d_w)
        if u_x * t_x + u_z * t_z + u_w * t_w < 0.0:
            u_x = -u_x
            u_z = -u_z
            u_w = -u_w
        turned = u_x * t_x + u_z * t_z + u_w * t_w
        # no jump to another line, no turn too sharp for the step
        if abs(moved - ds) > 0.2 * ds + 1e-10 or turned < 0.9:
            good = False
    return good, x1, z1, phi1, u_x, u_z, u_w, rear, front


@leaf
def tilt(a: float, g: float, t_x: float, t_z: float) -> float:
    """Tilt kappa of effective gravity for acceleration ``a`` along the path of the centroid."""
    if a == 0.0:
        return 0.0
    speed = math.sqrt(t_x * t_x + t_z * t_z)
    if speed < 1e-12:
        return 0.0
    return a * t_x / (speed * g + a * t_z)


@kernel
def closing_time(
    ground: FloatArray,
    body: FloatArray,
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
) -> tuple[int, float]:
    """Arclength at which one quantity changes sign within a step (regula falsi, bisection).

    ``what`` is a feature (its gap) or -1 (centroid over the rear contact) or -2 (over the front).
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
        good, x1, z1, phi1, u_x, u_z, _, new_rear, new_front = stepped(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, mid
        )
        if not good:
            return 0, lo
        if new_rear == what or new_front == what:
            return 2, mid
        value = quantity(
            ground, body, what, new_rear, new_front, x1, z1, phi1, tilt(a, g, u_x, u_z)
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


@kernel
def quantity(
    ground: FloatArray,
    body: FloatArray,
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
    if what == -1:
        return -lever(ground, body, rear, x, z, c, s, kappa)
    if what == -2:
        return lever(ground, body, front, x, z, c, s, kappa)
    # under the name that holds here: the line of a segment means nothing beyond its end
    what = relabelled(ground, body, what, x, z, c, s)
    if what == rear or what == front:  # noqa: SIM109
        return 0.5 * PENETRATED
    distance, _, _, _, _ = gap(ground, body, what, x, z, c, s)
    return distance + 0.5 * PENETRATED


@kernel
def shallow(body: FloatArray, feature: int, distance: float) -> bool:
    """Whether a penetration is shallow enough to tell which feature is hit.

    A disc that has gone in by less than half its radius still has its centre outside; a thin part
    that has gone in farther may be nearer to a face it never met.
    """
    part = (feature >> 2) & 15
    return bool(distance > -0.5 * min(body[part, 2], body[part, 5]))


@kernel
def lever_rate(
    ground: FloatArray,
    body: FloatArray,
    feature: int,
    x: float,
    z: float,
    phi: float,
    t_x: float,
    t_z: float,
    t_w: float,
) -> float:
    """Change of a contact's Delta with arclength (tilt of gravity held)."""
    kind = feature & 3
    if kind == 0:
        return -t_x
    part = (feature >> 2) & 15
    k = feature >> 6
    j = 3 * (kind - 1)
    o_x = math.cos(phi) * body[part, j] - math.sin(phi) * body[part, j + 1]
    o_z = math.sin(phi) * body[part, j] + math.cos(phi) * body[part, j + 1]
    turn = t_w / ARM
    along = (t_x - turn * o_z) * ground[k, 2] + (t_z + turn * o_x) * ground[k, 3]
    return float(along * ground[k, 2] - t_x)


@kernel
def may_graze(
    ground: FloatArray, body: FloatArray, one: int, other: int, sign: float,
    kappa: float, kappa1: float,
    x0: float, z0: float, phi0: float, t_x: float, t_z: float, t_w: float,
    x1: float, z1: float, phi1: float, u_x: float, u_z: float, u_w: float, ds: float,
) -> bool:  # fmt: skip
    """Whether the centroid may pass a contact and come back within one step.

    ``sign`` +1 for the front contact, -1 for the rear one, ``one`` and ``other`` its names at both
    ends, ``kappa`` and ``kappa1`` the tilt of effective gravity there: where the course bends back,
    the tilt at its end hides what was passed. The tangents at both ends meet below the true course
    if that is convex.
    """
    v1 = sign * lever(ground, body, other, x1, z1, math.cos(phi1), math.sin(phi1), kappa)
    if v1 > 3.0 * ds:
        return False
    if (
        v1
        <= 0.0
        < sign * lever(ground, body, other, x1, z1, math.cos(phi1), math.sin(phi1), kappa1)
    ):
        return True
    rate1 = sign * lever_rate(ground, body, other, x1, z1, phi1, u_x, u_z, u_w)
    rate0 = sign * lever_rate(ground, body, one, x0, z0, phi0, t_x, t_z, t_w)
    if rate0 >= 0.0 or rate1 <= 0.0:
        return False
    v0 = sign * lever(ground, body, one, x0, z0, math.cos(phi0), math.sin(phi0), kappa)
    meet = (v1 - v0 - rate1 * ds) / (rate0 - rate1)
    return v0 + rate0 * meet <= 0.0


@kernel
def careful(
    ground: FloatArray,
    body: FloatArray,
    rear: int,
    front: int,
    x: float,
    z: float,
    phi: float,
    ds: float,
    hint: int,
) -> float:
    """Choose a step that does not jump through a spike.

    Thin parts move no farther than they are clear.

    Parts with end radii above the step need no such care.
    """
    thinnest = 1.0
    for part in range(body.shape[0]):
        thinnest = min(thinnest, body[part, 2], body[part, 5])
    if thinnest >= ds:
        return ds
    _, clear, _ = nearest(
        ground, body, x, z, math.cos(phi), math.sin(phi), rear, front, 2.0 * ds, hint
    )
    return min(ds, max(0.4 * clear, thinnest, 0.1 * ds))


@kernel
def advance(
    ground: FloatArray,
    body: FloatArray,
    rear: int,
    front: int,
    x: float,
    z: float,
    phi: float,
    t_x: float,
    t_z: float,
    t_w: float,
    ds: float,
    a: float,
    g: float,
    hint: int,
) -> tuple[int, float, float, float, float, float, float, int, int, int, float, int]:
    """One step along the line of poses, cut short at the first event.

    Returns
    -------
    outcome
        -9 no convergence; -3 nothing happened; -1, -2 centroid over the rear or front contact;
        a feature: that feature has closed.
    x, z, phi, t_x, t_z, t_w, rear, front
        The pose reached, its tangent and contacts.
    hint, ds, moved
        For the scan; the step actually taken [m].
    """
    ds = careful(ground, body, rear, front, x, z, phi, ds, hint)
    good = False
    third = -1
    distance = 0.0
    x1, z1, phi1, u_x, u_z, u_w = x, z, phi, t_x, t_z, t_w
    r1, f1 = rear, front
    behind = 0.0
    ahead = 0.0
    kappa = 0.0
    kappa0 = tilt(a, g, t_x, t_z)
    for _ in range(60):
        good, x1, z1, phi1, u_x, u_z, u_w, r1, f1 = stepped(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, ds
        )
        if good:
            third, distance, hint = nearest(
                ground, body, x1, z1, math.cos(phi1), math.sin(phi1), r1, f1, 0.0, hint
            )
            if third < 0 or ds < 1e-8 or shallow(body, third, distance):
                c = math.cos(phi1)
                s = math.sin(phi1)
                kappa = tilt(a, g, u_x, u_z)
                behind = -lever(ground, body, r1, x1, z1, c, s, kappa)
                ahead = lever(ground, body, f1, x1, z1, c, s, kappa)
                if ds < 2e-5 or not (
                    (
                        min(ahead, lever(ground, body, f1, x1, z1, c, s, kappa0)) <= 3.0 * ds
                        and may_graze(
                            ground, body, front, f1, 1.0, kappa0, kappa,
                            x, z, phi, t_x, t_z, t_w, x1, z1, phi1, u_x, u_z, u_w, ds,
                        )
                    )
                    or (
                        min(behind, -lever(ground, body, r1, x1, z1, c, s, kappa0)) <= 3.0 * ds
                        and may_graze(
                            ground, body, rear, r1, -1.0, kappa0, kappa,
                            x, z, phi, t_x, t_z, t_w, x1, z1, phi1, u_x, u_z, u_w, ds,
                        )
                    )
                ):  # fmt: skip
                    break
            good = False
        ds *= 0.4
        if ds < 1e-9:
            break
    if not good:
        return -9, x, z, phi, t_x, t_z, t_w, rear, front, hint, ds, 0
    what = -3
    deep = PENETRATED
    for again in range(24):
        if again > 0:
            c = math.cos(phi1)
            s = math.sin(phi1)
            kappa = tilt(a, g, u_x, u_z)
            behind = -lever(ground, body, r1, x1, z1, c, s, kappa)
            ahead = lever(ground, body, f1, x1, z1, c, s, kappa)
            third, distance, hint = nearest(ground, body, x1, z1, c, s, r1, f1, 0.0, hint)
        new = -3
        if third >= 0 and distance < -deep:
            new = third
        elif behind <= 0.0:
            new = -1
        elif ahead <= 0.0:
            new = -2
        if new == -3 or new == what:
            if what >= 0:
                what = relabelled(ground, body, what, x1, z1, c, s)
            return what, x1, z1, phi1, u_x, u_z, u_w, r1, f1, hint, ds, 1
        what = new
        deep = TOGETHER
        value0 = quantity(ground, body, what, rear, front, x, z, phi, tilt(a, g, t_x, t_z))
        value1 = quantity(ground, body, what, r1, f1, x1, z1, phi1, kappa)
        if value0 <= 0.0:
            if what >= 0:
                what = relabelled(ground, body, what, x, z, math.cos(phi), math.sin(phi))
            return what, x, z, phi, t_x, t_z, t_w, rear, front, hint, 0.0, 1
        found, cut = closing_time(
            ground, body, what, rear, front, x, z, phi, t_x, t_z, t_w, ds, value0, value1, a, g
        )
        ds = cut
        if found == 2:
            what = -3
            deep = PENETRATED
        if found == 0 or ds <= 0.0:
            return -9, x, z, phi, t_x, t_z, t_w, rear, front, hint, ds, 0
        good, x1, z1, phi1, u_x, u_z, u_w, r1, f1 = stepped(
            ground, body, rear, front, x, z, phi, t_x, t_z, t_w, ds
        )
        if not good:
            return -9, x, z, phi, t_x, t_z, t_w, rear, front, hint, ds, 0
    return -9, x, z, phi, t_x, t_z, t_w, rear, front, hint, ds, 0
