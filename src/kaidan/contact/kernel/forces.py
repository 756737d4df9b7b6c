r"""Contact forces at a pose: friction needed by two contacts, sharing among more.

::

           C   W = -(effective weight)
           |          F1 + F2 = W,  (p2 - p1) x F2 = (C - p1) x W
       F1  v  F2
        \     /        One number is left free, the inner force lambda along p1 p2;
        p1---p2        required friction = min over lambda of max |T_i| / N_i.

All forces are per unit mass [N/kg].
"""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.kernel.gaps import centre_of, gap, pressed_normal
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import (
    DISC_1,
    DISC_2,
    PART,
    POINT,
    VERTEX,
    Forces,
    Press,
    Scene,
    Touching,
)
from kaidan.contact.memory import Row, Table

NEVER = math.inf
#: A force below this part of the weight is none: events are located to about 1e-9 m, so a contact
#: under the centroid may seem to pull by a few 1e-9 of the weight.
NOTHING = 1e-7


def cone_angle(tangential: float, normal: float, scale: float) -> float:
    """Friction coefficient one force needs; 0 for no force, infinite for a pull."""
    if normal <= 0.0:
        if math.sqrt(tangential * tangential + normal * normal) <= NOTHING * scale:
            return 0.0
        return NEVER
    if abs(tangential) <= 1e-14 * scale:
        return 0.0
    return abs(tangential) / normal


@entry
def two_contact_forces(
    one: Press, two: Press, x: float, z: float, w_x: float, w_z: float
) -> Forces:
    """Smallest friction with which two contacts hold the robot, and the forces that do it.

    x, z: centroid [m].
    w_x, w_z: sum of the contact forces, that is minus effective gravity [N/kg].

    The friction is infinite if none suffices; if it is only approached by an ever growing inner
    force (jamming between two faces) the forces are NaN.

    Notes
    -----
    max(|T1|/N1, |T2|/N2) is quasi-convex in the inner force, so its minimum lies where one ratio
    vanishes, where both are equal, or at infinity; each is a root of a polynomial of degree <= 2.
    """
    d_x = two.x - one.x
    d_z = two.z - one.z
    d = math.sqrt(d_x * d_x + d_z * d_z)
    size = math.sqrt(w_x * w_x + w_z * w_z)
    if d < 1e-12:
        return Forces(NEVER, math.nan, math.nan, math.nan, math.nan)
    e_x = d_x / d
    e_z = d_z / d
    across2 = ((x - one.x) * w_z - (z - one.z) * w_x) / d
    across1 = -w_x * e_z + w_z * e_x - across2
    along = w_x * e_x + w_z * e_z
    # N = n0 + n1 lambda, T = t0 + t1 lambda; forward tangent = (n_z, -n_x)
    an1 = e_x * one.n_x + e_z * one.n_z
    at1 = e_x * one.n_z - e_z * one.n_x
    bn1 = across1 * (-e_z * one.n_x + e_x * one.n_z)
    bt1 = across1 * (-e_z * one.n_z - e_x * one.n_x)
    an2 = -(e_x * two.n_x + e_z * two.n_z)
    at2 = -(e_x * two.n_z - e_z * two.n_x)
    bn2 = across2 * (-e_z * two.n_x + e_x * two.n_z) - along * an2
    bt2 = across2 * (-e_z * two.n_z - e_x * two.n_x) - along * at2
    if abs(one.n_x - two.n_x) + abs(one.n_z - two.n_z) < 1e-12:
        # one plane: the friction is its slope, and least where all forces are parallel
        normal = w_x * one.n_x + w_z * one.n_z
        tangential = w_x * one.n_z - w_z * one.n_x
        split = d_x * w_z - d_z * w_x
        if abs(split) > 1e-9 * d * size:
            share = ((x - one.x) * w_z - (z - one.z) * w_x) / split
            if share >= 0.0 and share <= 1.0:
                return Forces(
                    cone_angle(tangential, normal, size),
                    (1.0 - share) * normal, (1.0 - share) * tangential,
                    share * normal, share * tangential,
                )  # fmt: skip
    best = NEVER
    at = math.nan
    # at infinity
    if an1 * an2 > 0.0 and min(abs(an1), abs(an2)) > 1e-12:
        best = max(abs(at1 / an1), abs(at2 / an2))
    for way in range(8):
        trial = 0.0
        if way == 0:
            if abs(at1) < 1e-15:
                continue
            trial = -bt1 / at1
        elif way == 1:
            if abs(at2) < 1e-15:
                continue
            trial = -bt2 / at2
        elif way == 2:
            trial = along
        elif way >= 4:
            # T1 N2 = +- T2 N1
            sign = 1.0 if way < 6 else -1.0
            q2 = at1 * an2 - sign * at2 * an1
            q1 = at1 * bn2 + bt1 * an2 - sign * (at2 * bn1 + bt2 * an1)
            q0 = bt1 * bn2 - sign * bt2 * bn1
            root = q1 * q1 - 4.0 * q2 * q0
            if root < 0.0:
                continue
            half = -0.5 * (q1 + math.copysign(math.sqrt(root), q1))
            if way == 4 or way == 6:
                if half == 0.0:
                    continue
                trial = q0 / half
            else:
                if abs(q2) < 1e-14:
                    continue
                trial = half / q2
        mu = max(
            cone_angle(bt1 + at1 * trial, bn1 + an1 * trial, size),
            cone_angle(bt2 + at2 * trial, bn2 + an2 * trial, size),
        )
        if mu < best or (mu == best and math.isnan(at)):
            best = mu
            at = trial
    return Forces(best, bn1 + an1 * at, bt1 + at1 * at, bn2 + an2 * at, bt2 + at2 * at)


@entry
def contacts_at(
    scene: Scene, x: float, z: float, phi: float, touch: float, found: Table[Touching]
) -> int:
    """All contacts of a pose: every feature whose gap is at most ``touch``.

    found: to be filled; features within 2 um of one already there are the same contact.
    """
    at = placed(x, z, phi)
    ground = scene.ground
    count = 0
    for number in range(len(scene.body)):
        part = scene.body[number]
        x1, z1 = centre_of(part.one, at)
        x2, z2 = centre_of(part.two, at)
        left = min(x1 - part.one.r, x2 - part.two.r) - touch
        right = max(x1 + part.one.r, x2 + part.two.r) + touch
        # downward normal of the flat
        b_x = part.sine * part.e_x + part.cosine * part.side * part.e_z
        b_z = part.sine * part.e_z - part.cosine * part.side * part.e_x
        q_x = at.c * b_x - at.s * b_z
        q_z = at.s * b_x + at.c * b_z
        line = x1 * q_x + z1 * q_z + part.one.r + touch
        k = first_index(scene, left)
        while k < len(ground) - 1 and ground[k].x <= right:
            point = ground[k]
            for kind in range(VERTEX, DISC_2 + 1):
                if kind == VERTEX:
                    # below the line of the flat a vertex is farther from the part than from it
                    if not point.convex or point.x * q_x + point.z * q_z > line:
                        continue
                else:
                    to_x = (x1 if kind == DISC_1 else x2) - point.x
                    to_z = (z1 if kind == DISC_1 else z2) - point.z
                    radius = part.one.r if kind == DISC_1 else part.two.r
                    foot = to_x * point.u_x + to_z * point.u_z
                    if foot < 0.0 or foot > point.length:
                        continue
                    if point.u_x * to_z - point.u_z * to_x - radius > touch:
                        continue
                feature = POINT * k + PART * number + kind
                distance, n_x, n_z, p_x, p_z = gap(scene, feature, at)
                if abs(distance) > touch or is_there(found, count, p_x, p_z):
                    continue
                if count < len(found):
                    contact = found[count]
                    n_x, n_z = pressed_normal(scene, feature, at, n_x, n_z)
                    contact.feature = feature
                    contact.x = p_x
                    contact.z = p_z
                    contact.n_x = n_x
                    contact.n_z = n_z
                    contact.gap = distance
                    contact.kind = part.kind
                    count += 1
            k += 1
    return count


def is_there(found: Table[Touching], count: int, x: float, z: float) -> bool:
    """Whether a place is that of a contact that has been found."""
    for row in range(count):
        if abs(found[row].x - x) < 2e-6 and abs(found[row].z - z) < 2e-6:
            return True
    return False


def ahead_of(contact: Touching, x: float, z: float, kappa: float) -> float:
    """How far ahead of the line of effective gravity through the centroid a contact lies [m]."""
    return contact.x - x + kappa * (z - contact.z)


@entry
def shared_loads(
    found: Table[Touching], x: float, z: float, kappa: float, gravity: float, loads: Row[float]
) -> int:
    """Share of each contact in the effective weight, equal springs [N/kg].

    Every contact is a spring along effective gravity; contacts that would pull are dropped and the
    rest solved again.  On a straight underside this is the formula of docs/theory/loads.md,
    ``N_i = W cos(theta) [1/m + (x_z - mean)(x_i - mean) / sum (x_j - mean)^2]`` with
    ``N_i = load cos(theta)``.  Contacts on faces cannot be carried so: see the
    two-contact solution.
    """
    count = len(found)
    for row in range(count):
        loads[row] = 1.0
    for _ in range(count):
        m = 0
        mean = 0.0
        for row in range(count):
            if loads[row] != 0.0:
                m += 1
                mean += ahead_of(found[row], x, z, kappa)
        mean /= m
        square = 0.0
        for row in range(count):
            if loads[row] != 0.0:
                d = ahead_of(found[row], x, z, kappa) - mean
                square += d * d
        worst = 0.0
        which = -1
        for row in range(count):
            if loads[row] != 0.0:
                d = ahead_of(found[row], x, z, kappa) - mean
                share = 1.0 / m
                if square > 0.0:
                    share -= mean * d / square
                loads[row] = share * gravity
                if share < worst:
                    worst = share
                    which = row
        if which < 0 or m <= 2:
            return m
        loads[which] = 0.0
    return 0
