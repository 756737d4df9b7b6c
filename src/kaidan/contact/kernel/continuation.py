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
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import At, Held, Pull, Scene

#: Length by which inclination is counted in the arclength [m]; about half a robot, so that a step
#: means a like displacement of its ends.
ARM = 0.3
#: A gap is closed at this [m] or less: a hundred times the rounding of coordinates of metres.
CLOSED = 2e-13
#: Names of one contact within a step, at most: two for each point of the ground. Beyond them the
#: step is too long.
MOST_NAMES = 40


def distance(one: Held, other: Held) -> float:
    """Distance between two poses [m]."""
    d_x = other.x - one.x
    d_z = other.z - one.z
    d_w = ARM * (other.phi - one.phi)
    return math.sqrt(d_x * d_x + d_z * d_z + d_w * d_w)


def tangent(scene: Scene, rear: int, front: int, at: At) -> tuple[float, float, float, float]:
    """Return the unit tangent (x, z, ARM phi) of the line of poses and its definition (0: none).

    Its sign is the forward drive's: the underside moves ahead over the contacts.
    """
    _, m_x, m_z, p_x, p_z = gap(scene, rear, at)
    _, n_x, n_z, o_x, o_z = gap(scene, front, at)
    m_w = ((p_x - at.x) * m_z - (p_z - at.z) * m_x) / ARM
    n_w = ((o_x - at.x) * n_z - (o_z - at.z) * n_x) / ARM
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
        (t_x - turn * (p_z - at.z)) * m_z
        - (t_z + turn * (p_x - at.x)) * m_x
        + (t_x - turn * (o_z - at.z)) * n_z
        - (t_z + turn * (o_x - at.x)) * n_x
    )
    if ahead < 0.0:
        return -t_x, -t_z, -t_w, size
    return t_x, t_z, t_w, size


def gap_rate(scene: Scene, feature: int, at: At, t_x: float, t_z: float, t_w: float) -> float:
    """Change of a gap along a direction (x, z, ARM phi)."""
    _, n_x, n_z, p_x, p_z = gap(scene, feature, at)
    return n_x * t_x + n_z * t_z + ((p_x - at.x) * n_z - (p_z - at.z) * n_x) * t_w / ARM


def corrected(
    scene: Scene, rear: int, front: int, x: float, z: float, phi: float
) -> tuple[bool, Held, At]:
    """Nearest pose at which both gaps are closed (Newton across the tangent)."""
    for _ in range(12):
        at = placed(x, z, phi)
        g1, m_x, m_z, p_x, p_z = gap(scene, rear, at)
        g2, n_x, n_z, o_x, o_z = gap(scene, front, at)
        m_w = ((p_x - x) * m_z - (p_z - z) * m_x) / ARM
        n_w = ((o_x - x) * n_z - (o_z - z) * n_x) / ARM
        t_x = m_z * n_w - m_w * n_z
        t_z = m_w * n_x - m_x * n_w
        t_w = m_x * n_z - m_z * n_x
        square = t_x * t_x + t_z * t_z + t_w * t_w
        if square < 1e-20:
            break
        if abs(g1) < CLOSED and abs(g2) < CLOSED:
            size = math.sqrt(square)
            return True, Held(x, z, phi, t_x / size, t_z / size, t_w / size, rear, front), at
        if abs(g1) > 0.1 or abs(g2) > 0.1:
            break
        # -(g1 (G2 x t) + g2 (t x G1)) / t.t
        x -= (g1 * (n_z * t_w - n_w * t_z) + g2 * (t_z * m_w - t_w * m_z)) / square
        z -= (g1 * (n_w * t_x - n_x * t_w) + g2 * (t_w * m_x - t_x * m_w)) / square
        phi -= (g1 * (n_x * t_z - n_z * t_x) + g2 * (t_x * m_z - t_z * m_x)) / (square * ARM)
    return False, Held(x, z, phi, 1.0, 0.0, 0.0, rear, front), placed(x, z, phi)


def stepped(scene: Scene, at: Held, ds: float) -> tuple[bool, Held, At]:
    """Pose one step of arclength further, contacts renamed where they run on."""
    good, there, where = corrected(
        scene, at.rear, at.front, at.x + ds * at.t_x, at.z + ds * at.t_z, at.phi + ds * at.t_w / ARM
    )
    for names in range(MOST_NAMES + 1):
        if not good:
            return False, there, where
        rear = relabelled(scene, there.rear, where)
        front = relabelled(scene, there.front, where)
        if rear == there.rear and front == there.front:
            break
        if names == MOST_NAMES:
            return False, there, where
        good, there, where = corrected(scene, rear, front, there.x, there.z, there.phi)
    x, z, phi, u_x, u_z, u_w, rear, front = there
    turned = u_x * at.t_x + u_z * at.t_z + u_w * at.t_w
    if turned < 0.0:
        turned = -turned
        there = Held(x, z, phi, -u_x, -u_z, -u_w, rear, front)
    # no jump to another line, no turn too sharp for the step
    return abs(distance(at, there) - ds) <= 0.2 * ds + 1e-10 and turned >= 0.9, there, where


def tilt(pull: Pull, t_x: float, t_z: float) -> float:
    """Tilt kappa of effective gravity for an acceleration along the path of the centroid."""
    if pull.a == 0.0:
        return pull.tilt
    speed = math.sqrt(t_x * t_x + t_z * t_z)
    if speed < 1e-12:
        return pull.tilt
    return (pull.a * t_x + pull.tilt * pull.g * speed) / (speed * pull.g + pull.a * t_z)
