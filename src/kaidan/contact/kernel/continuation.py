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

from kaidan.contact.kernel.gaps import gap, relabelled
from kaidan.contact.tables import BodyTable, GroundTable

#: Length by which inclination is counted in the arclength [m]; about half a robot, so that a step
#: means a like displacement of its ends.
ARM = 0.3
#: A gap is closed at this [m] or less: a hundred times the rounding of coordinates of metres.
CLOSED = 2e-13
#: Names of one contact within a step, at most: two for each point of the ground. Beyond them the
#: step is too long.
MOST_NAMES = 40


def distance(x: float, z: float, phi: float, x1: float, z1: float, phi1: float) -> float:
    """Distance between two poses [m]."""
    d_x = x1 - x
    d_z = z1 - z
    d_w = ARM * (phi1 - phi)
    return math.sqrt(d_x * d_x + d_z * d_z + d_w * d_w)


def tangent(
    ground: GroundTable,
    body: BodyTable,
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


def gap_rate(
    ground: GroundTable,
    body: BodyTable,
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


def corrected(
    ground: GroundTable, body: BodyTable, rear: int, front: int, x: float, z: float, phi: float
) -> tuple[bool, float, float, float, float, float, float, float, float]:
    """Nearest pose at which both gaps are closed (Newton across the tangent).

    Returns
    -------
    converged, x, z, phi, its cosine and sine, then the unit tangent (x, z, ARM phi), sign left open
    """
    c = math.cos(phi)
    s = math.sin(phi)
    for _ in range(12):
        g1, m_x, m_z, p_x, p_z = gap(ground, body, rear, x, z, c, s)
        g2, n_x, n_z, o_x, o_z = gap(ground, body, front, x, z, c, s)
        m_w = ((p_x - x) * m_z - (p_z - z) * m_x) / ARM
        n_w = ((o_x - x) * n_z - (o_z - z) * n_x) / ARM
        t_x = m_z * n_w - m_w * n_z
        t_z = m_w * n_x - m_x * n_w
        t_w = m_x * n_z - m_z * n_x
        square = t_x * t_x + t_z * t_z + t_w * t_w
        if square < 1e-20:
            return False, x, z, phi, c, s, 1.0, 0.0, 0.0
        if abs(g1) < CLOSED and abs(g2) < CLOSED:
            size = math.sqrt(square)
            return True, x, z, phi, c, s, t_x / size, t_z / size, t_w / size
        if abs(g1) > 0.1 or abs(g2) > 0.1:
            return False, x, z, phi, c, s, 1.0, 0.0, 0.0
        # -(g1 (G2 x t) + g2 (t x G1)) / t.t
        x -= (g1 * (n_z * t_w - n_w * t_z) + g2 * (t_z * m_w - t_w * m_z)) / square
        z -= (g1 * (n_w * t_x - n_x * t_w) + g2 * (t_w * m_x - t_x * m_w)) / square
        phi -= (g1 * (n_x * t_z - n_z * t_x) + g2 * (t_x * m_z - t_z * m_x)) / (square * ARM)
        c = math.cos(phi)
        s = math.sin(phi)
    return False, x, z, phi, c, s, 1.0, 0.0, 0.0


def stepped(
    ground: GroundTable,
    body: BodyTable,
    rear: int,
    front: int,
    x: float,
    z: float,
    phi: float,
    t_x: float,
    t_z: float,
    t_w: float,
    ds: float,
) -> tuple[bool, float, float, float, float, float, float, float, float, int, int]:
    """Pose one step of arclength further, contacts renamed where they run on.

    Returns
    -------
    good, x, z, phi, its cosine and sine, tangent (3, same sense as before), rear, front
    """
    good, x1, z1, phi1, c, s, u_x, u_z, u_w = corrected(
        ground, body, rear, front, x + ds * t_x, z + ds * t_z, phi + ds * t_w / ARM
    )
    if good:
        for names in range(MOST_NAMES + 1):
            new_rear = relabelled(ground, body, rear, x1, z1, c, s)
            new_front = relabelled(ground, body, front, x1, z1, c, s)
            if new_rear == rear and new_front == front:
                break
            if names == MOST_NAMES:
                good = False
                break
            rear = new_rear
            front = new_front
            good, x1, z1, phi1, c, s, u_x, u_z, u_w = corrected(
                ground, body, rear, front, x1, z1, phi1
            )
            if not good:
                break
    if good:
        moved = distance(x, z, phi, x1, z1, phi1)
        if u_x * t_x + u_z * t_z + u_w * t_w < 0.0:
            u_x = -u_x
            u_z = -u_z
            u_w = -u_w
        turned = u_x * t_x + u_z * t_z + u_w * t_w
        # no jump to another line, no turn too sharp for the step
        if abs(moved - ds) > 0.2 * ds + 1e-10 or turned < 0.9:
            good = False
    return good, x1, z1, phi1, c, s, u_x, u_z, u_w, rear, front


def tilt(a: float, g: float, kappa_g: float, t_x: float, t_z: float) -> float:
    """Tilt kappa of effective gravity for acceleration ``a`` along the path of the centroid.

    ``kappa_g`` is that of gravity itself: its horizontal part backward over its vertical part g.
    """
    if a == 0.0:
        return kappa_g
    speed = math.sqrt(t_x * t_x + t_z * t_z)
    if speed < 1e-12:
        return kappa_g
    return (a * t_x + kappa_g * g * speed) / (speed * g + a * t_z)
