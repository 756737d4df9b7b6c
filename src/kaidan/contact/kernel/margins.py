r"""Every margin at every pose of a traverse.

::

              C
             /|\         back: to the rear contact       front: to the front contact
        rear  |  front    static stability: distance of the gravity line from each contact
      ----o---+---o----   energy: rise of C before it stands over that contact
"""

from __future__ import annotations

import math

from kaidan.contact.codes import BELLY
from kaidan.contact.columns import (
    BACK,
    BACK_RISE,
    BELLY_TOUCHES,
    BOUNDED,
    CONTACT_COLUMNS,
    CONTACT_FEATURE,
    CONTACT_GAP,
    CONTACT_KIND,
    CONTACT_N_X,
    CONTACT_N_Z,
    CONTACT_X,
    CONTACT_Z,
    CONTACTS,
    ENERGY,
    ENERGY_SIDE,
    FORCE_ANGLE,
    FRICTION,
    FRONT,
    FRONT_N,
    FRONT_N_X,
    FRONT_N_Z,
    FRONT_RISE,
    FRONT_T,
    FRONT_X,
    FRONT_Z,
    NO_FEATURE,
    OUTER_FRONT,
    OUTER_REAR,
    POSE_FRONT,
    POSE_PHI,
    POSE_PSI,
    POSE_REAR,
    POSE_S,
    POSE_X,
    POSE_Z,
    REAR_N,
    REAR_N_X,
    REAR_N_Z,
    REAR_T,
    REAR_X,
    REAR_Z,
    STEEPEST,
    TILT,
    TRACTION,
    WITHOUT,
    ZMP,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.continuation import gap_rate, tangent
from kaidan.contact.kernel.forces import contacts_at, two_contact_forces
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    GroundTable,
    IntArray,
    MarginTable,
    PoseTable,
)

#: A gap that changes by less than this along a line of poses stays closed [1]: a hundred times the
#: rounding of the line's direction, a hundredth of the flattest way in which contacts close.
STAYS = 1e-6
#: Poses closer than this [m] stand at one place, where several contacts are exchanged.
ONE_PLACE = 1e-8
#: Beyond a contact by more than this [m] the line of gravity has passed it: events are located to
#: about 1e-9 m.
PASSED = 1e-8


def pivot_rise(p_x: float, p_z: float, x: float, z: float, kappa: float) -> float:
    """Rise of the centroid until it stands over a fixed point (Hirose's energy margin) [m].

    alpha [1 - sin(angle)], angle of the line point to centroid above the effective horizontal.
    """
    d_x = x - p_x
    d_z = z - p_z
    return math.sqrt(d_x * d_x + d_z * d_z) - (d_z + kappa * d_x) / math.sqrt(1.0 + kappa * kappa)


def lasting(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    row: int,
    sense: float,
    found: ContactTable,
    many: int,
) -> int:
    """Keep those contacts of a pose that stay closed along its line of poses.

    ``sense`` +1 ahead, -1 back. All are kept where one would be run into: the line does not lead
    that way, but is left at once.

    Returns
    -------
    number of contacts kept, at the head of ``found``
    """
    x = poses[row, POSE_X]
    z = poses[row, POSE_Z]
    c = math.cos(poses[row, POSE_PHI])
    s = math.sin(poses[row, POSE_PHI])
    t_x, t_z, t_w, _ = tangent(
        ground, body, int(poses[row, POSE_REAR]), int(poses[row, POSE_FRONT]), x, z, c, s
    )
    for k in range(many):
        found[k, CONTACT_GAP] = sense * gap_rate(
            ground, body, int(found[k, CONTACT_FEATURE]), x, z, c, s, t_x, t_z, t_w
        )
        if found[k, CONTACT_GAP] < -STAYS:
            return many
    kept = 0
    for k in range(many):
        if found[k, CONTACT_GAP] < STAYS:
            for column in range(CONTACT_COLUMNS):
                found[kept, column] = found[k, column]
            kept += 1
    return kept


def steepest_normal(
    poses: PoseTable, row: int, found: ContactTable, many: int
) -> tuple[float, float]:
    """Normal of the steepest contact of a pose, its x taken positive."""
    n_x = abs(poses[row, REAR_N_X])
    n_z = poses[row, REAR_N_Z]
    if abs(poses[row, FRONT_N_X]) * n_z > poses[row, FRONT_N_Z] * n_x:
        n_x = abs(poses[row, FRONT_N_X])
        n_z = poses[row, FRONT_N_Z]
    for k in range(many if many > 2 else 0):
        if abs(found[k, CONTACT_N_X]) * n_z > found[k, CONTACT_N_Z] * n_x:
            n_x = abs(found[k, CONTACT_N_X])
            n_z = found[k, CONTACT_N_Z]
    return n_x, n_z


def outer_contacts(
    poses: PoseTable, row: int, found: ContactTable, many: int, kappa: float, down: float
) -> tuple[float, float, float, float, float, float]:
    """Contacts that bound the margins of a pose: of more than two the outermost.

    Returns
    -------
    how far behind and how far ahead of the gravity line they lie [m], their points [m]
    """
    x = poses[row, POSE_X]
    z = poses[row, POSE_Z]
    r_x = poses[row, REAR_X]
    r_z = poses[row, REAR_Z]
    f_x = poses[row, FRONT_X]
    f_z = poses[row, FRONT_Z]
    back = -(r_x - x + kappa * (z - r_z)) / down
    front = (f_x - x + kappa * (z - f_z)) / down
    for k in range(many if many > 2 else 0):
        ahead = (found[k, CONTACT_X] - x + kappa * (z - found[k, CONTACT_Z])) / down
        if ahead > front:
            front = ahead
            f_x = found[k, CONTACT_X]
            f_z = found[k, CONTACT_Z]
        elif -ahead > back:
            back = -ahead
            r_x = found[k, CONTACT_X]
            r_z = found[k, CONTACT_Z]
    return back, front, r_x, r_z, f_x, f_z


def least_forces(
    poses: PoseTable, row: int, found: ContactTable, many: int, kappa: float, w_x: float, w_z: float
) -> tuple[float, float, float, float, float]:
    """Least required friction of any two contacts of a pose, and the forces on these.

    Returns
    -------
    mu, N and T of the rear one, N and T of the front one
    """
    x = poses[row, POSE_X]
    z = poses[row, POSE_Z]
    mu, n1, t1, n2, t2 = two_contact_forces(
        poses[row, REAR_X], poses[row, REAR_Z], poses[row, REAR_N_X], poses[row, REAR_N_Z],
        poses[row, FRONT_X], poses[row, FRONT_Z], poses[row, FRONT_N_X], poses[row, FRONT_N_Z],
        x, z, w_x, w_z,
    )  # fmt: skip
    # all contacts press one way: the active pair's friction, the slope, is the least already
    one_plane = abs(poses[row, REAR_N_X] - poses[row, FRONT_N_X]) < 1e-12
    for k in range(many if many > 2 else 0):
        if abs(found[k, CONTACT_N_X] - poses[row, REAR_N_X]) > 1e-12:
            one_plane = False
        ahead = found[k, CONTACT_X] - x + kappa * (z - found[k, CONTACT_Z])
        for j in range(0 if one_plane else k):
            other = found[j, CONTACT_X] - x + kappa * (z - found[j, CONTACT_Z])
            mu2, m1, u1, m2, u2 = two_contact_forces(
                found[j, CONTACT_X], found[j, CONTACT_Z],
                found[j, CONTACT_N_X], found[j, CONTACT_N_Z],
                found[k, CONTACT_X], found[k, CONTACT_Z],
                found[k, CONTACT_N_X], found[k, CONTACT_N_Z],
                x, z, w_x, w_z,
            )  # fmt: skip
            if mu2 < mu - 1e-12:
                mu, n1, t1, n2, t2 = mu2, m1, u1, m2, u2
                if ahead < other:
                    n1, t1, n2, t2 = m2, u2, m1, u1
    return mu, n1, t1, n2, t2


def forces_over_one(
    poses: PoseTable, row: int, found: ContactTable, many: int, p_x: float, p_z: float,
    ahead: bool, w_x: float, w_z: float,
) -> tuple[float, float, float, float, float]:  # fmt: skip
    """Friction and forces, as of `least_forces`, of a pose that already turns about a contact.

    Under an acceleration the last pose before a rotation may be that far on: gravity leans along
    the path of belts that give way here, and along that of rigid ones where the rotation begins.
    """
    n_x = poses[row, FRONT_N_X] if ahead else poses[row, REAR_N_X]
    n_z = poses[row, FRONT_N_Z] if ahead else poses[row, REAR_N_Z]
    for k in range(many if many > 2 else 0):
        if found[k, CONTACT_X] == p_x and found[k, CONTACT_Z] == p_z:
            n_x = found[k, CONTACT_N_X]
            n_z = found[k, CONTACT_N_Z]
    normal = w_x * n_x + w_z * n_z
    tangential = w_x * n_z - w_z * n_x
    mu = abs(tangential) / normal if normal > 0.0 else math.inf
    if ahead:
        return mu, 0.0, 0.0, normal, tangential
    return mu, normal, tangential, 0.0, 0.0


def margins_at(
    poses: PoseTable,
    row: int,
    a: float,
    g: float,
    found: ContactTable,
    many: int,
    margins: MarginTable,
) -> None:
    """Work out forces and margins at one pose, with its contacts; see :func:`pose_margins`."""
    x = poses[row, POSE_X]
    z = poses[row, POSE_Z]
    psi = poses[row, POSE_PSI]
    kappa = 0.0
    gravity = g
    if a != 0.0:
        kappa = a * math.cos(psi) / (g + a * math.sin(psi))
        gravity = math.sqrt(g * g + a * a + 2.0 * g * a * math.sin(psi))
    down = math.sqrt(1.0 + kappa * kappa)
    w_x = gravity * kappa / down
    w_z = gravity / down
    back, front, r_x, r_z, f_x, f_z = outer_contacts(poses, row, found, many, kappa, down)
    if min(back, front) < -PASSED:
        ahead = front < back
        p_x = f_x if ahead else r_x
        p_z = f_z if ahead else r_z
        mu, n1, t1, n2, t2 = forces_over_one(poses, row, found, many, p_x, p_z, ahead, w_x, w_z)
    else:
        mu, n1, t1, n2, t2 = least_forces(poses, row, found, many, kappa, w_x, w_z)
    margins[row, FRICTION] = mu
    margins[row, REAR_N] = n1
    margins[row, REAR_T] = t1
    margins[row, FRONT_N] = n2
    margins[row, FRONT_T] = t2
    margins[row, TRACTION] = g * math.sin(psi) + a
    margins[row, BACK] = back
    margins[row, FRONT] = front
    rise_back = pivot_rise(r_x, r_z, x, z, kappa)
    rise_front = pivot_rise(f_x, f_z, x, z, kappa)
    margins[row, BACK_RISE] = rise_back if back >= 0.0 else -rise_back
    margins[row, FRONT_RISE] = rise_front if front >= 0.0 else -rise_front
    angle_back = math.atan2(back, (z - r_z + kappa * (x - r_x)) / down)
    angle_front = math.atan2(front, (z - f_z + kappa * (x - f_x)) / down)
    margins[row, FORCE_ANGLE] = min(
        angle_back * abs(back) * gravity, angle_front * abs(front) * gravity
    )
    margins[row, ZMP] = back / (back + front) if back + front > 0.0 else math.nan
    margins[row, CONTACTS] = max(many, 2)
    margins[row, BELLY_TOUCHES] = 0.0
    for k in range(many):
        if int(found[k, CONTACT_KIND]) == BELLY:
            margins[row, BELLY_TOUCHES] = 1.0
    n_x, n_z = steepest_normal(poses, row, found, many)
    margins[row, STEEPEST] = math.atan2(n_x, n_z)
    margins[row, TILT] = kappa
    margins[row, OUTER_REAR] = poses[row, POSE_REAR]
    margins[row, OUTER_FRONT] = poses[row, POSE_FRONT]
    for k in range(many if many > 2 else 0):
        if found[k, CONTACT_X] == r_x and found[k, CONTACT_Z] == r_z:
            margins[row, OUTER_REAR] = found[k, CONTACT_FEATURE]
        if found[k, CONTACT_X] == f_x and found[k, CONTACT_Z] == f_z:
            margins[row, OUTER_FRONT] = found[k, CONTACT_FEATURE]
    margins[row, ENERGY] = math.nan
    margins[row, ENERGY_SIDE] = math.nan
    margins[row, BOUNDED] = 0.0
    margins[row, WITHOUT] = NO_FEATURE


@entry
def pose_margins(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    count: int,
    a: float,
    g: float,
    touch: float,
    margins: MarginTable,
    found: ContactTable,
) -> None:
    """Work out forces and margins at each pose of a table of poses.

    All but the energy margin along the flow, which takes as long as the rest and of which often the
    least value alone is required: that is :func:`flow_energy`'s. Where a contact is exchanged the
    path has two poses at one place: those contacts count that hold before it, and after it.

    Parameters
    ----------
    ground, body
        Tables.
    poses, count
        Table of :func:`kaidan.contact.kernel.driver.drive` and the number of its rows in use.
    a, g
        Acceleration along the path, gravity [m/s^2].
    touch
        Gap up to which a feature counts as a contact [m].
    margins
        Table to be filled, see :class:`kaidan.contact.records.Margins`.
    found
        Scratch, see :func:`kaidan.contact.kernel.forces.contacts_at`.
    """
    hint = 0
    for row in range(count):
        many, hint = contacts_at(
            ground, body, poses[row, POSE_X], poses[row, POSE_Z], poses[row, POSE_PHI], touch,
            found, hint,
        )  # fmt: skip
        s = poses[row, POSE_S]
        after = row > 0 and s - poses[row - 1, POSE_S] < ONE_PLACE
        before = row + 1 < count and poses[row + 1, POSE_S] - s < ONE_PLACE
        if after != before:
            many = lasting(ground, body, poses, row, 1.0 if after else -1.0, found, many)
        margins_at(poses, row, a, g, found, many, margins)


def margins_without(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    without: IntArray,
    count: int,
    a: float,
    g: float,
    touch: float,
    margins: MarginTable,
    found: ContactTable,
) -> None:
    """Work out forces and margins at some poses as if one of their contacts were not there.

    Parameters
    ----------
    ground, body, a, g, touch, margins, found
        As for :func:`pose_margins`.
    poses
        Poses at which a nosing comes under the flat, or leaves it.
    without
        That nosing's point of the ground, for each.
    count
        How many.
    """
    hint = 0
    for row in range(count):
        many, hint = contacts_at(
            ground, body, poses[row, POSE_X], poses[row, POSE_Z], poses[row, POSE_PHI], touch,
            found, hint,
        )  # fmt: skip
        kept = 0
        for k in range(many):
            if (
                found[k, CONTACT_X] != ground[without[row], X]
                or found[k, CONTACT_Z] != ground[without[row], Z]
            ):
                for column in range(CONTACT_COLUMNS):
                    found[kept, column] = found[k, column]
                kept += 1
        margins_at(poses, row, a, g, found, kept, margins)
        margins[row, WITHOUT] = without[row]
