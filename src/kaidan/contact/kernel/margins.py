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
from kaidan.contact.entries import entry
from kaidan.contact.kernel.continuation import gap_rate, tangent
from kaidan.contact.kernel.forces import ahead_of, contacts_at, two_contact_forces
from kaidan.contact.kernel.passings import where_of
from kaidan.contact.kernel.trigonometry import atan2, cosine_sine
from kaidan.contact.layout import (
    NO_FEATURE,
    Forces,
    Margin,
    Outer,
    Pose,
    Press,
    Pull,
    Scene,
    Touching,
)
from kaidan.contact.memory import Row, Table, empty, put

#: A gap that changes by less than this along a line of poses stays closed [1]: a hundred times the
#: rounding of the line's direction, a hundredth of the flattest way in which contacts close.
STAYS = 1e-6
#: Poses closer than this [m] stand at one place, where several contacts are exchanged.
ONE_PLACE = 1e-8
#: Beyond a contact by more than this [m] the line of gravity has passed it: events are located to
#: about 1e-9 m.
PASSED = 1e-8


#: Gap up to which a feature counts as a contact [m], and contacts of a pose at most.
TOUCH = 1e-9
MOST_CONTACTS = 32


def pivot_rise(p_x: float, p_z: float, x: float, z: float, kappa: float) -> float:
    """Rise of the centroid until it stands over a fixed point (Hirose's energy margin) [m].

    alpha [1 - sin(angle)], angle of the line point to centroid above the effective horizontal.
    """
    d_x = x - p_x
    d_z = z - p_z
    return math.sqrt(d_x * d_x + d_z * d_z) - (d_z + kappa * d_x) / math.sqrt(1.0 + kappa * kappa)


def lasting(scene: Scene, pose: Pose, sense: float, found: Table[Touching]) -> int:
    """Keep those contacts of a pose that stay closed along its line of poses.

    ``sense`` +1 ahead, -1 back. All are kept where one would be run into: the line does not lead
    that way, but is left at once.
    """
    at = where_of(pose)
    t_x, t_z, t_w, _ = tangent(scene, pose.rear.feature, pose.front.feature, at)
    for k in range(len(found)):
        found[k].gap = sense * gap_rate(scene, found[k].feature, at, t_x, t_z, t_w)
        if found[k].gap < -STAYS:
            return len(found)
    kept = 0
    for k in range(len(found)):
        if found[k].gap < STAYS:
            put(found[kept], found[k])
            kept += 1
    return kept


def steepest_normal(pose: Pose, found: Table[Touching]) -> tuple[float, float]:
    """Normal of the steepest contact of a pose, its x taken positive."""
    n_x = abs(pose.rear.n_x)
    n_z = pose.rear.n_z
    if abs(pose.front.n_x) * n_z > pose.front.n_z * n_x:
        n_x = abs(pose.front.n_x)
        n_z = pose.front.n_z
    for k in range(len(found)):
        if abs(found[k].n_x) * n_z > found[k].n_z * n_x:
            n_x = abs(found[k].n_x)
            n_z = found[k].n_z
    return n_x, n_z


def outer_contacts(pose: Pose, found: Table[Touching], kappa: float, down: float) -> Outer:
    """Contacts that bound the margins of a pose: of more than two the outermost."""
    x = pose.x
    z = pose.z
    r_x = pose.rear.x
    r_z = pose.rear.z
    f_x = pose.front.x
    f_z = pose.front.z
    back = -(r_x - x + kappa * (z - r_z)) / down
    front = (f_x - x + kappa * (z - f_z)) / down
    for k in range(len(found)):
        ahead = ahead_of(found[k], x, z, kappa) / down
        if ahead > front:
            front = ahead
            f_x = found[k].x
            f_z = found[k].z
        elif -ahead > back:
            back = -ahead
            r_x = found[k].x
            r_z = found[k].z
    return Outer(back, front, r_x, r_z, f_x, f_z)


def least_forces(
    pose: Pose, found: Table[Touching], kappa: float, w_x: float, w_z: float
) -> Forces:
    """Least required friction of any two contacts of a pose, and the forces on these."""
    x = pose.x
    z = pose.z
    rear = Press(pose.rear.x, pose.rear.z, pose.rear.n_x, pose.rear.n_z)
    front = Press(pose.front.x, pose.front.z, pose.front.n_x, pose.front.n_z)
    least = two_contact_forces(rear, front, x, z, w_x, w_z)
    # all contacts press one way: the active pair's friction, the slope, is the least already
    one_plane = abs(rear.n_x - front.n_x) < 1e-12
    for k in range(len(found)):
        one = found[k]
        if abs(one.n_x - rear.n_x) > 1e-12:
            one_plane = False
        for j in range(0 if one_plane else k):
            other = found[j]
            held = two_contact_forces(
                Press(other.x, other.z, other.n_x, other.n_z),
                Press(one.x, one.z, one.n_x, one.n_z), x, z, w_x, w_z,
            )  # fmt: skip
            if held.required_friction < least.required_friction - 1e-12:
                least = held
                if ahead_of(one, x, z, kappa) < ahead_of(other, x, z, kappa):
                    mu, n1, t1, n2, t2 = held
                    least = Forces(mu, n2, t2, n1, t1)
    return least


def forces_over_one(
    pose: Pose, found: Table[Touching], outer: Outer, w_x: float, w_z: float
) -> Forces:
    """Friction and forces, as of `least_forces`, of a pose that already turns about a contact.

    Under an acceleration the last pose before a rotation may be that far on: gravity leans along
    the path of belts that give way here, and along that of rigid ones where the rotation begins.
    """
    ahead = outer.front < outer.back
    p_x = outer.f_x if ahead else outer.r_x
    p_z = outer.f_z if ahead else outer.r_z
    n_x = pose.front.n_x if ahead else pose.rear.n_x
    n_z = pose.front.n_z if ahead else pose.rear.n_z
    for k in range(len(found)):
        if found[k].x == p_x and found[k].z == p_z:
            n_x = found[k].n_x
            n_z = found[k].n_z
    normal = w_x * n_x + w_z * n_z
    tangential = w_x * n_z - w_z * n_x
    mu = abs(tangential) / normal if normal > 0.0 else math.inf
    if ahead:
        return Forces(mu, 0.0, 0.0, normal, tangential)
    return Forces(mu, normal, tangential, 0.0, 0.0)


def margins_at(pose: Pose, pull: Pull, found: Table[Touching], margin: Margin) -> None:
    """Work out forces and margins at one pose, with its contacts; see :func:`pose_margins`."""
    x = pose.x
    z = pose.z
    a = pull.a
    g = pull.g
    psi = pose.path_direction
    kappa = 0.0
    gravity = g
    ahead, up = cosine_sine(psi)
    if a != 0.0:
        kappa = a * ahead / (g + a * up)
        gravity = math.sqrt(g * g + a * a + 2.0 * g * a * up)
    down = math.sqrt(1.0 + kappa * kappa)
    w_x = gravity * kappa / down
    w_z = gravity / down
    # two contacts are those that carry the pose
    more = found[0 : len(found) if len(found) > 2 else 0]
    outer = outer_contacts(pose, more, kappa, down)
    back, front, r_x, r_z, f_x, f_z = outer
    if min(back, front) < -PASSED:
        forces = forces_over_one(pose, more, outer, w_x, w_z)
    else:
        forces = least_forces(pose, more, kappa, w_x, w_z)
    margin.required_friction = forces.required_friction
    margin.rear_load = forces.first_load
    margin.rear_traction = forces.first_traction
    margin.front_load = forces.second_load
    margin.front_traction = forces.second_traction
    margin.traction = g * up + a
    margin.back = back
    margin.front = front
    rise_back = pivot_rise(r_x, r_z, x, z, kappa)
    rise_front = pivot_rise(f_x, f_z, x, z, kappa)
    margin.back_rise = rise_back if back >= 0.0 else -rise_back
    margin.front_rise = rise_front if front >= 0.0 else -rise_front
    angle_back = atan2(back, (z - r_z + kappa * (x - r_x)) / down)
    angle_front = atan2(front, (z - f_z + kappa * (x - f_x)) / down)
    margin.force_angle = min(angle_back * abs(back) * gravity, angle_front * abs(front) * gravity)
    margin.zmp = back / (back + front) if back + front > 0.0 else math.nan
    margin.contacts = max(len(found), 2)
    margin.belly_touches = False
    for k in range(len(found)):
        if found[k].kind == BELLY:
            margin.belly_touches = True
    n_x, n_z = steepest_normal(pose, more)
    margin.steepest_face = atan2(n_x, n_z)
    margin.tilt = kappa
    margin.outer_rear = pose.rear.feature
    margin.outer_front = pose.front.feature
    for k in range(len(more)):
        if more[k].x == r_x and more[k].z == r_z:
            margin.outer_rear = more[k].feature
        if more[k].x == f_x and more[k].z == f_z:
            margin.outer_front = more[k].feature
    margin.energy = math.nan
    margin.energy_side = math.nan
    margin.bounded = False
    margin.without = NO_FEATURE


@entry
def pose_margins(scene: Scene, poses: Table[Pose], pull: Pull, margins: Table[Margin]) -> None:
    """Work out forces and margins at each of some poses that follow one another.

    All but the energy margin along the flow, which takes as long as the rest and of which often the
    least value alone is required: that is :func:`flow_energy`'s. Where a contact is exchanged the
    path has two poses at one place: those contacts count that hold before it, and after it.

    poses: of :func:`kaidan.contact.kernel.driver.drive`.
    """
    found = empty(Touching, MOST_CONTACTS)
    for row in range(len(poses)):
        pose = poses[row]
        many = contacts_at(scene, pose.x, pose.z, pose.inclination, TOUCH, found)
        after = row > 0 and pose.s - poses[row - 1].s < ONE_PLACE
        before = row + 1 < len(poses) and poses[row + 1].s - pose.s < ONE_PLACE
        if after != before:
            many = lasting(scene, pose, 1.0 if after else -1.0, found[0:many])
        margins_at(pose, pull, found[0:many], margins[row])


def margins_without(
    scene: Scene, poses: Table[Pose], without: Row[int], pull: Pull, margins: Table[Margin]
) -> None:
    """Work out forces and margins at some poses as if one of their contacts were not there.

    without: that nosing's point of the ground, for each.
    """
    found = empty(Touching, MOST_CONTACTS)
    for row in range(len(poses)):
        pose = poses[row]
        point = scene.ground[without[row]]
        many = contacts_at(scene, pose.x, pose.z, pose.inclination, TOUCH, found)
        kept = 0
        for k in range(many):
            if found[k].x != point.x or found[k].z != point.z:
                put(found[kept], found[k])
                kept += 1
        margins_at(pose, pull, found[0:kept], margins[row])
        margins[row].without = without[row]
