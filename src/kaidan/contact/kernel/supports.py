r"""What each pose stands on: the two contacts that carry it, and nosings under a flat beside them.

::

         .--------------.
        (  flat          )      the outer nosings carry the pose, the one between them touches the
         '-o-----o-----o-'      flat as well: all three may bear a load, or a grouser
           |_____|     |_____
"""

from __future__ import annotations

import math

from kaidan.contact.codes import BELLY, TRACK
from kaidan.contact.entries import entry
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.passings import along_flat, is_of_vertex, where_of
from kaidan.contact.kernel.trigonometry import atan2
from kaidan.contact.kernel.way_order import WHOLE
from kaidan.contact.layout import (
    DISC_2,
    FACE,
    KIND_MASK,
    NOSING,
    NOWHERE,
    PART_BITS,
    PART_MASK,
    POINT_BITS,
    TREAD,
    VERTEX,
    At,
    Load,
    Part,
    Point,
    Pose,
    Scene,
    Stance,
    Support,
    Touch,
)
from kaidan.contact.memory import Row, Table, empty

#: Smallest radius of a belt [m].
SHARPEST = 1e-3
#: What is one after the digits to which supports are compared: a tenth of a micrometre.
ALIKE = 1e7
#: Poses unlike each other that a pose is compared with at most, the last first.
COMPARED = 1024


@entry
def find_supports(
    scene: Scene, parts: int, poses: Table[Pose], treads: Row[float], stance: Stance,
    supports: Table[Support], slots: int,
) -> int:  # fmt: skip
    """Find what each pose stands on: the contacts that carry it first, then nosings by their place.

    scene, parts: terrain and robot: one for all poses, or one for each, as many parts one below the
        other.
    treads: tilt of the normal of the tread uphill of each point of the ground [rad]; NaN: none.
    supports, slots: to be filled, and how many rows a pose has; supports beyond them are left out.
    """
    most = 2
    ground = scene.ground
    bodies = scene.body
    for row in range(len(poses)):
        if len(bodies) > parts:
            scene.body = bodies[row * parts : (row + 1) * parts]
        pose = poses[row]
        own = supports[row * slots : (row + 1) * slots]
        for slot in range(slots):
            own[slot].is_one = False
            own[slot].point = NOWHERE
        at = where_of(pose)
        describe(scene, pose, pose.rear, at, stance, own[0])
        describe(scene, pose, pose.front, at, stance, own[1])
        count = 2
        k = first_index(scene, pose.x - stance.reach)
        while k < len(ground) and ground[k].x < pose.x + stance.reach:
            if (
                ground[k].convex
                and not is_of_vertex(pose.rear.feature, k)
                and not is_of_vertex(pose.front.feature, k)
            ):
                number = touching_part(scene, ground[k], at, stance.touch)
                if number >= 0:
                    if count < slots:
                        normal = flat_tilt(scene.body[number]) - pose.inclination
                        support = own[count]
                        place(support, ground[k].x - pose.x, ground[k].z - pose.z, normal)
                        support.place = NOSING
                        support.point = k
                        support.curvature = 0.0
                        support.lift = math.nan
                        support.beside = beside(scene, number, ground[k], at)
                    count += 1
            k += 1
        most = max(most, count)
        for slot in range(min(count, slots)):
            support = own[slot]
            support.tread = treads[support.point] if support.point >= 0 else math.nan
            if math.isnan(support.tread):
                support.point = NOWHERE
    return most


def place(support: Support, x: float, z: float, normal: float) -> None:
    """Write where a support is, from the centroid [m], and the tilt of its normal [rad]."""
    support.is_one = True
    support.x = x
    support.z = z
    support.normal = normal
    support.beyond = 0.0
    support.flat = math.nan
    support.beside = math.inf


def describe(
    scene: Scene, pose: Pose, touch: Touch, at: At, stance: Stance, support: Support
) -> None:
    """Write what a contact that carries a pose stands on, and the belt there."""
    place(support, touch.x - pose.x, touch.z - pose.z, atan2(touch.n_x, touch.n_z))
    k = touch.feature >> POINT_BITS
    number = (touch.feature >> PART_BITS) & PART_MASK
    kind = touch.feature & KIND_MASK
    point = scene.ground[k]
    part = scene.body[number]
    support.lift = math.nan
    second = kind == DISC_2
    on_flat = False
    if kind == VERTEX:
        along, _ = along_flat(part, point, at)
        second = along > 0.0
        on_flat = along >= 0.0 and along <= part.flat
    radius = part.two.r if second and not on_flat else part.one.r
    support.curvature = 0.0 if on_flat else 1.0 / max(radius, SHARPEST)
    if not second:
        support.flat = flat_tilt(part) - pose.inclination
    if kind == VERTEX:
        support.place = NOSING
        support.point = k
        support.beside = beside(scene, number, point, at)
        return
    then = scene.ground[k + 1]
    step_z = then.z - point.z
    if abs(atan2(step_z, then.x - point.x)) <= stance.steep:
        support.place = TREAD
        if stance.climbs and point.convex:
            support.point = k
            support.beyond = pose.x + support.x - point.x
        return
    support.place = FACE
    if stance.climbs and step_z > 0.0:
        disc = part.two if second else part.one
        axle = pose.z + at.s * disc.x + at.c * disc.z
        support.point = k + 1
        support.lift = then.z - axle


def touching_part(scene: Scene, point: Point, at: At, touch: float) -> int:
    """Number of the first part on whose flat a point lies; -1: none."""
    for number in range(len(scene.body)):
        part = scene.body[number]
        if part.kind != BELLY:
            along, gap = along_flat(part, point, at)
            if abs(gap) < touch and along >= 0.0 and along <= part.flat:
                return number
    return -1


def beside(scene: Scene, own: int, point: Point, at: At) -> float:
    """Gap between a point and the next belt that passes it another way than the own one [m].

    One is on a flat and the other on the round of an end; infinity: there is none. Parts of the
    track have one belt.
    """
    along, _ = along_flat(scene.body[own], point, at)
    on_flat = along >= 0.0 and along <= scene.body[own].flat
    nearest = math.inf
    for number in range(len(scene.body)):
        part = scene.body[number]
        same_belt = part.kind == TRACK and scene.body[own].kind == TRACK
        if number == own or part.kind == BELLY or same_belt:
            continue
        along, gap = along_flat(part, point, at)
        if on_flat == (along >= 0.0 and along <= part.flat):
            continue
        if on_flat:
            gap = end_gap(part, along < 0.0, point, at)
        nearest = min(nearest, abs(gap))
    return nearest


def end_gap(part: Part, first: bool, point: Point, at: At) -> float:
    """Gap between a point and the round of an end of a part, the first or the second [m]."""
    disc = part.one if first else part.two
    a_x = point.x - at.x - at.c * disc.x + at.s * disc.z
    a_z = point.z - at.z - at.s * disc.x - at.c * disc.z
    return math.sqrt(a_x * a_x + a_z * a_z) - disc.r


def flat_tilt(part: Part) -> float:
    """Tilt of the normal of the flat of a part, from the ground into it, in the body frame."""
    across = part.cosine * part.side
    return atan2(
        -part.sine * part.e_x - across * part.e_z, across * part.e_x - part.sine * part.e_z
    )


def is_same(one: float, other: float) -> bool:
    """Whether two numbers are one to the digits that count, or both are not known."""
    if math.isnan(one) and math.isnan(other):
        return True
    return one * ALIKE + WHOLE - WHOLE == other * ALIKE + WHOLE - WHOLE


def are_alike(one: Support, other: Support) -> bool:
    """Whether two supports are alike, but for which points of the ground those are."""
    if not one.is_one or not other.is_one:
        return one.is_one == other.is_one
    return (
        (one.point == NOWHERE) == (other.point == NOWHERE)
        and one.place == other.place
        and is_same(one.x, other.x)
        and is_same(one.z, other.z)
        and is_same(one.normal, other.normal)
        and is_same(one.tread, other.tread)
        and is_same(one.curvature, other.curvature)
        and is_same(one.lift, other.lift)
        and is_same(one.beyond, other.beyond)
        and is_same(one.flat, other.flat)
        and is_same(one.beside, other.beside)
    )


def stand_alike(
    supports: Table[Support], slots: int, loads: Table[Load], one: int, other: int
) -> bool:
    """Whether two poses stand on the same, but for which points of the ground those are."""
    if not (
        is_same(loads[one].x, loads[other].x)
        and is_same(loads[one].z, loads[other].z)
        and is_same(loads[one].coulomb, loads[other].coulomb)
    ):
        return False
    for slot in range(slots):
        if not are_alike(supports[one * slots + slot], supports[other * slots + slot]):
            return False
    return True


@entry
def find_alike(supports: Table[Support], slots: int, loads: Table[Load], like: Row[int]) -> None:
    """Find of each pose the first one that stands alike: a regular flight repeats itself.

    supports, slots: as `find_supports` filled them.
    loads: of each pose.
    like: to be filled: its own row where none before stands alike.
    """
    unlike = empty(int, len(loads))
    count = 0
    for row in range(len(loads)):
        like[row] = row
        for k in range(min(count, COMPARED)):
            other = unlike[count - 1 - k]
            if stand_alike(supports, slots, loads, row, other):
                like[row] = other
                break
        if like[row] == row:
            unlike[count] = row
            count += 1
