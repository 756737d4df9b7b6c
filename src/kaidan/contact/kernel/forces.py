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

from kaidan.contact.columns import (
    CONTACT_FEATURE,
    CONTACT_GAP,
    CONTACT_KIND,
    CONTACT_N_X,
    CONTACT_N_Z,
    CONTACT_X,
    CONTACT_Z,
    CONVEX,
    COSINE,
    DISC_2,
    E_X,
    E_Z,
    KIND,
    LENGTH,
    PART,
    POINT,
    R1,
    R2,
    SIDE,
    SINE,
    U_X,
    U_Z,
    VERTEX,
    X1,
    X2,
    Z1,
    Z2,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.gaps import gap, pressed_normal
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.tables import BodyTable, ContactTable, FloatRow, GroundTable

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
    p1_x: float, p1_z: float, n1_x: float, n1_z: float,
    p2_x: float, p2_z: float, n2_x: float, n2_z: float,
    x: float, z: float, w_x: float, w_z: float,
) -> tuple[float, float, float, float, float]:  # fmt: skip
    """Smallest friction with which two contacts hold the robot, and the forces that do it.

    Parameters
    ----------
    p1_x, p1_z, n1_x, n1_z, p2_x, p2_z, n2_x, n2_z
        Points [m] and unit normals (into the robot) of the two contacts.
    x, z
        Centroid [m].
    w_x, w_z
        Sum of the contact forces, that is minus effective gravity [N/kg].

    Returns
    -------
    mu, N1, T1, N2, T2
        T positive where it drives the robot ahead. ``mu`` is infinite if no friction suffices; if
        it is only approached by an ever growing inner force (jamming between two faces) the
        forces are NaN.

    Notes
    -----
    max(|T1|/N1, |T2|/N2) is quasi-convex in the inner force, so its minimum lies where one ratio
    vanishes, where both are equal, or at infinity; each is a root of a polynomial of degree <= 2.
    """
    d_x = p2_x - p1_x
    d_z = p2_z - p1_z
    d = math.sqrt(d_x * d_x + d_z * d_z)
    size = math.sqrt(w_x * w_x + w_z * w_z)
    if d < 1e-12:
        return NEVER, math.nan, math.nan, math.nan, math.nan
    e_x = d_x / d
    e_z = d_z / d
    across2 = ((x - p1_x) * w_z - (z - p1_z) * w_x) / d
    across1 = -w_x * e_z + w_z * e_x - across2
    along = w_x * e_x + w_z * e_z
    # N = n0 + n1 lambda, T = t0 + t1 lambda; forward tangent = (n_z, -n_x)
    an1 = e_x * n1_x + e_z * n1_z
    at1 = e_x * n1_z - e_z * n1_x
    bn1 = across1 * (-e_z * n1_x + e_x * n1_z)
    bt1 = across1 * (-e_z * n1_z - e_x * n1_x)
    an2 = -(e_x * n2_x + e_z * n2_z)
    at2 = -(e_x * n2_z - e_z * n2_x)
    bn2 = across2 * (-e_z * n2_x + e_x * n2_z) - along * an2
    bt2 = across2 * (-e_z * n2_z - e_x * n2_x) - along * at2
    if abs(n1_x - n2_x) + abs(n1_z - n2_z) < 1e-12:
        # one plane: the friction is its slope, and least where all forces are parallel
        normal = w_x * n1_x + w_z * n1_z
        tangential = w_x * n1_z - w_z * n1_x
        split = d_x * w_z - d_z * w_x
        if abs(split) > 1e-9 * d * size:
            share = ((x - p1_x) * w_z - (z - p1_z) * w_x) / split
            if 0.0 <= share <= 1.0:
                return (
                    cone_angle(tangential, normal, size),
                    (1.0 - share) * normal, (1.0 - share) * tangential,
                    share * normal, share * tangential,
                )  # fmt: skip
    best = NEVER
    at = math.nan
    # at infinity
    if an1 * an2 > 0.0 and min(abs(an1), abs(an2)) > 1e-12:
        best = max(abs(at1 / an1), abs(at2 / an2))
    for case in range(8):
        trial = 0.0
        if case == 0:
            if abs(at1) < 1e-15:
                continue
            trial = -bt1 / at1
        elif case == 1:
            if abs(at2) < 1e-15:
                continue
            trial = -bt2 / at2
        elif case == 2:
            trial = along
        elif case >= 4:
            # T1 N2 = +- T2 N1
            sign = 1.0 if case < 6 else -1.0
            q2 = at1 * an2 - sign * at2 * an1
            q1 = at1 * bn2 + bt1 * an2 - sign * (at2 * bn1 + bt2 * an1)
            q0 = bt1 * bn2 - sign * bt2 * bn1
            root = q1 * q1 - 4.0 * q2 * q0
            if root < 0.0:
                continue
            half = -0.5 * (q1 + math.copysign(math.sqrt(root), q1))
            if case == 4 or case == 6:
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
    return best, bn1 + an1 * at, bt1 + at1 * at, bn2 + an2 * at, bt2 + at2 * at


@entry
def contacts_at(
    ground: GroundTable,
    body: BodyTable,
    x: float,
    z: float,
    phi: float,
    touch: float,
    found: ContactTable,
    hint: int,
) -> tuple[int, int]:
    """All contacts of a pose: every feature whose gap is at most ``touch``.

    Parameters
    ----------
    found
        Table to be filled (k, CONTACT_COLUMNS); features within 2 um of one already there are
        the same contact.
    hint
        For the scan.

    Returns
    -------
    number of contacts (at most the rows of ``found``), hint
    """
    c = math.cos(phi)
    s = math.sin(phi)
    n = ground.shape[0]
    count = 0
    new_hint = n
    for part in range(body.shape[0]):
        x1 = x + c * body[part, X1] - s * body[part, Z1]
        z1 = z + s * body[part, X1] + c * body[part, Z1]
        x2 = x + c * body[part, X2] - s * body[part, Z2]
        z2 = z + s * body[part, X2] + c * body[part, Z2]
        left = min(x1 - body[part, R1], x2 - body[part, R2]) - touch
        right = max(x1 + body[part, R1], x2 + body[part, R2]) + touch
        # downward normal of the flat
        side = body[part, SIDE]
        b_x = body[part, SINE] * body[part, E_X] + body[part, COSINE] * side * body[part, E_Z]
        b_z = body[part, SINE] * body[part, E_Z] - body[part, COSINE] * side * body[part, E_X]
        q_x = c * b_x - s * b_z
        q_z = s * b_x + c * b_z
        line = x1 * q_x + z1 * q_z + body[part, R1] + touch
        k = first_index(ground, left, hint)
        hint = k
        if k < new_hint:
            new_hint = k
        while k < n - 1 and ground[k, X] <= right:
            for kind in range(VERTEX, DISC_2 + 1):
                if kind == VERTEX:
                    # below the line of the flat a vertex is farther from the part than from it
                    if ground[k, CONVEX] != 1.0 or ground[k, X] * q_x + ground[k, Z] * q_z > line:
                        continue
                else:
                    to_x = x1 - ground[k, X]
                    to_z = z1 - ground[k, Z]
                    radius = body[part, R1]
                    if kind == DISC_2:
                        to_x = x2 - ground[k, X]
                        to_z = z2 - ground[k, Z]
                        radius = body[part, R2]
                    foot = to_x * ground[k, U_X] + to_z * ground[k, U_Z]
                    if foot < 0.0 or foot > ground[k, LENGTH]:
                        continue
                    off = ground[k, U_X] * to_z - ground[k, U_Z] * to_x
                    if off - radius > touch:
                        continue
                feature = POINT * k + PART * part + kind
                g, n_x, n_z, p_x, p_z = gap(ground, body, feature, x, z, c, s)
                if abs(g) > touch:
                    continue
                new = True
                for row in range(count):
                    if (
                        abs(found[row, CONTACT_X] - p_x) < 2e-6
                        and abs(found[row, CONTACT_Z] - p_z) < 2e-6
                    ):
                        new = False
                        break
                if new and count < found.shape[0]:
                    n_x, n_z = pressed_normal(ground, body, feature, x, z, c, s, n_x, n_z)
                    found[count, CONTACT_FEATURE] = feature
                    found[count, CONTACT_X] = p_x
                    found[count, CONTACT_Z] = p_z
                    found[count, CONTACT_N_X] = n_x
                    found[count, CONTACT_N_Z] = n_z
                    found[count, CONTACT_GAP] = g
                    found[count, CONTACT_KIND] = body[part, KIND]
                    count += 1
            k += 1
    return count, new_hint


@entry
def shared_loads(
    found: ContactTable,
    count: int,
    x: float,
    z: float,
    kappa: float,
    gravity: float,
    loads: FloatRow,
) -> int:
    """Share of each contact in the effective weight, equal springs [N/kg].

    Every contact is a spring along effective gravity; contacts that would pull are dropped and the
    rest solved again.  On a straight underside this is the formula of docs/theory/loads.md,
    ``N_i = W cos(theta) [1/m + (x_z - mean)(x_i - mean) / sum (x_j - mean)^2]`` with
    ``N_i = load cos(theta)``.  Contacts on faces cannot be carried so: see the
    two-contact solution.

    Returns
    -------
    number of contacts that carry
    """
    for row in range(count):
        loads[row] = 1.0
    for _ in range(count):
        m = 0
        mean = 0.0
        for row in range(count):
            if loads[row] != 0.0:
                m += 1
                mean += found[row, CONTACT_X] - x + kappa * (z - found[row, CONTACT_Z])
        mean /= m
        square = 0.0
        for row in range(count):
            if loads[row] != 0.0:
                d = found[row, CONTACT_X] - x + kappa * (z - found[row, CONTACT_Z]) - mean
                square += d * d
        worst = 0.0
        which = -1
        for row in range(count):
            if loads[row] != 0.0:
                d = found[row, CONTACT_X] - x + kappa * (z - found[row, CONTACT_Z]) - mean
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
