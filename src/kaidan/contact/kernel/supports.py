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
from kaidan.contact.columns import (
    CONVEX,
    COSINE,
    DISC_2,
    E_X,
    E_Z,
    FACE,
    FLAT,
    FRONT_N_X,
    FRONT_N_Z,
    FRONT_X,
    FRONT_Z,
    KIND,
    KIND_MASK,
    LOAD_COULOMB,
    NOSING,
    NOWHERE,
    PART_BITS,
    PART_MASK,
    POINT_BITS,
    POSE_FRONT,
    POSE_PHI,
    POSE_REAR,
    POSE_X,
    POSE_Z,
    R1,
    R2,
    REAR_N_X,
    REAR_N_Z,
    REAR_X,
    REAR_Z,
    SIDE,
    SINE,
    SUPPORT_BESIDE,
    SUPPORT_BEYOND,
    SUPPORT_CURVATURE,
    SUPPORT_FLAT,
    SUPPORT_IS_ONE,
    SUPPORT_LIFT,
    SUPPORT_NORMAL,
    SUPPORT_PLACE,
    SUPPORT_POINT,
    SUPPORT_TREAD,
    SUPPORT_X,
    SUPPORT_Z,
    TREAD,
    VERTEX,
    X1,
    X2,
    Z1,
    Z2,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.passings import along_flat
from kaidan.contact.kernel.way_order import WHOLE
from kaidan.contact.tables import (
    BodyTable,
    FloatRow,
    GroundTable,
    IntArray,
    LoadTable,
    PoseTable,
    SupportTable,
)

#: Smallest radius of a belt [m].
SHARPEST = 1e-3
#: What is one after the digits to which supports are compared: a tenth of a micrometre.
ALIKE = 1e7
#: Poses unlike each other that a pose is compared with at most, the last first.
COMPARED = 1024


@entry
def find_supports(
    ground: GroundTable,
    bodies: BodyTable,
    parts: int,
    own: bool,
    poses: PoseTable,
    treads: FloatRow,
    climbs: bool,
    steep: float,
    touch: float,
    reach: float,
    supports: SupportTable,
    slots: int,
) -> int:
    """Find what each pose stands on: the contacts that carry it first, then nosings by their place.

    Parameters
    ----------
    ground
        Terrain.
    bodies, parts, own
        Robot, number of its parts, and whether each pose has a posture of its own: bodies one below
        the other.
    poses
        Poses.
    treads
        Tilt of the normal of the tread uphill of each point of the ground [rad]; NaN: none.
    climbs
        Whether the robot goes up: going down, the belt brings no tips over the edge of a face
        behind.
    steep
        Slope beyond which a segment of the ground is a face [rad].
    touch, reach
        Gap up to which a nosing lies on a flat; distance from the centroid that no part of the
        robot exceeds [m].
    supports, slots
        To be filled, and how many rows a pose has; supports beyond them are left out.

    Returns
    -------
    most supports of a pose
    """
    most = 2
    hint = 0
    for row in range(poses.shape[0]):
        body = row * parts if own else 0
        first = row * slots
        for at in range(first, first + slots):
            supports[at, SUPPORT_IS_ONE] = 0.0
            supports[at, SUPPORT_POINT] = NOWHERE
        rear = int(poses[row, POSE_REAR])
        front = int(poses[row, POSE_FRONT])
        place(supports, first, poses[row, REAR_X] - poses[row, POSE_X],
              poses[row, REAR_Z] - poses[row, POSE_Z],
              math.atan2(poses[row, REAR_N_X], poses[row, REAR_N_Z]))  # fmt: skip
        describe(ground, bodies, body, parts, poses, row, rear, climbs, steep, supports, first)
        place(supports, first + 1, poses[row, FRONT_X] - poses[row, POSE_X],
              poses[row, FRONT_Z] - poses[row, POSE_Z],
              math.atan2(poses[row, FRONT_N_X], poses[row, FRONT_N_Z]))  # fmt: skip
        describe(ground, bodies, body, parts, poses, row, front, climbs, steep, supports, first + 1)
        count = 2
        hint = first_index(ground, poses[row, POSE_X] - reach, hint)
        k = hint
        while k < ground.shape[0] and ground[k, X] < poses[row, POSE_X] + reach:
            if ground[k, CONVEX] == 1.0 and not is_vertex(rear, k) and not is_vertex(front, k):
                part = touching_part(ground, bodies, body, parts, poses, row, k, touch)
                if part >= 0:
                    if count < slots:
                        at = first + count
                        place(supports, at, ground[k, X] - poses[row, POSE_X],
                              ground[k, Z] - poses[row, POSE_Z],
                              flat_tilt(bodies, part) - poses[row, POSE_PHI])  # fmt: skip
                        supports[at, SUPPORT_PLACE] = NOSING
                        supports[at, SUPPORT_POINT] = k
                        supports[at, SUPPORT_CURVATURE] = 0.0
                        supports[at, SUPPORT_LIFT] = math.nan
                        supports[at, SUPPORT_BESIDE] = beside(
                            ground, bodies, body, parts, poses, row, part, k
                        )  # fmt: skip
                    count += 1
            k += 1
        most = max(most, count)
        for at in range(first, first + min(count, slots)):
            point = int(supports[at, SUPPORT_POINT])
            supports[at, SUPPORT_TREAD] = treads[point] if point >= 0 else math.nan
            if math.isnan(supports[at, SUPPORT_TREAD]):
                supports[at, SUPPORT_POINT] = NOWHERE
    return most


def is_vertex(feature: int, k: int) -> bool:
    """Whether a feature is a point of the ground under a part."""
    return feature & KIND_MASK == VERTEX and feature >> POINT_BITS == k


def place(supports: SupportTable, at: int, x: float, z: float, normal: float) -> None:
    """Write where a support is, from the centroid [m], and the tilt of its normal [rad]."""
    supports[at, SUPPORT_IS_ONE] = 1.0
    supports[at, SUPPORT_X] = x
    supports[at, SUPPORT_Z] = z
    supports[at, SUPPORT_NORMAL] = normal
    supports[at, SUPPORT_BEYOND] = 0.0
    supports[at, SUPPORT_FLAT] = math.nan
    supports[at, SUPPORT_BESIDE] = math.inf


def describe(
    ground: GroundTable, bodies: BodyTable, body: int, parts: int, poses: PoseTable, row: int,
    feature: int, climbs: bool, steep: float, supports: SupportTable, at: int,
) -> None:  # fmt: skip
    """Write what a contact that carries a pose stands on, and the belt there."""
    point = feature >> POINT_BITS
    part = body + ((feature >> PART_BITS) & PART_MASK)
    kind = feature & KIND_MASK
    supports[at, SUPPORT_LIFT] = math.nan
    second = kind == DISC_2
    on_flat = False
    if kind == VERTEX:
        along, _ = along_flat(ground, bodies, poses, row, part, point)
        second = along > 0.0
        on_flat = along >= 0.0 and along <= bodies[part, FLAT]
    radius = bodies[part, R2] if second and not on_flat else bodies[part, R1]
    supports[at, SUPPORT_CURVATURE] = 0.0 if on_flat else 1.0 / max(radius, SHARPEST)
    if not second:
        supports[at, SUPPORT_FLAT] = flat_tilt(bodies, part) - poses[row, POSE_PHI]
    if kind == VERTEX:
        supports[at, SUPPORT_PLACE] = NOSING
        supports[at, SUPPORT_POINT] = point
        supports[at, SUPPORT_BESIDE] = beside(
            ground, bodies, body, parts, poses, row, part, point
        )  # fmt: skip
        return
    step_x = ground[point + 1, X] - ground[point, X]
    step_z = ground[point + 1, Z] - ground[point, Z]
    if abs(math.atan2(step_z, step_x)) <= steep:
        supports[at, SUPPORT_PLACE] = TREAD
        if climbs and ground[point, CONVEX] == 1.0:
            supports[at, SUPPORT_POINT] = point
            supports[at, SUPPORT_BEYOND] = (
                poses[row, POSE_X] + supports[at, SUPPORT_X] - ground[point, X]
            )
        return
    supports[at, SUPPORT_PLACE] = FACE
    if climbs and step_z > 0.0:
        d_x = bodies[part, X2] if second else bodies[part, X1]
        d_z = bodies[part, Z2] if second else bodies[part, Z1]
        phi = poses[row, POSE_PHI]
        axle = poses[row, POSE_Z] + math.sin(phi) * d_x + math.cos(phi) * d_z
        supports[at, SUPPORT_POINT] = point + 1
        supports[at, SUPPORT_LIFT] = ground[point + 1, Z] - axle


def touching_part(
    ground: GroundTable, bodies: BodyTable, body: int, parts: int, poses: PoseTable, row: int,
    k: int, touch: float,
) -> int:  # fmt: skip
    """First row of the bodies, of those of a pose, on whose flat a point lies; -1: none."""
    for part in range(body, body + parts):
        if int(bodies[part, KIND]) != BELLY:
            along, gap = along_flat(ground, bodies, poses, row, part, k)
            if abs(gap) < touch and along >= 0.0 and along <= bodies[part, FLAT]:
                return part
    return -1


def beside(
    ground: GroundTable, bodies: BodyTable, body: int, parts: int, poses: PoseTable, row: int,
    own: int, k: int,
) -> float:  # fmt: skip
    """Gap between a point and the next belt that passes it another way than the own one [m].

    One is on a flat and the other on the round of an end; infinity: there is none. Parts of the
    track have one belt.
    """
    along, _ = along_flat(ground, bodies, poses, row, own, k)
    on_flat = along >= 0.0 and along <= bodies[own, FLAT]
    nearest = math.inf
    for part in range(body, body + parts):
        kind = int(bodies[part, KIND])
        if part == own or kind == BELLY or (kind == TRACK and int(bodies[own, KIND]) == TRACK):
            continue
        along, gap = along_flat(ground, bodies, poses, row, part, k)
        if on_flat == (along >= 0.0 and along <= bodies[part, FLAT]):
            continue
        if on_flat:
            gap = end_gap(ground, bodies, poses, row, part, along < 0.0, k)
        nearest = min(nearest, abs(gap))
    return nearest


def end_gap(
    ground: GroundTable, bodies: BodyTable, poses: PoseTable, row: int, part: int, first: bool,
    k: int,
) -> float:  # fmt: skip
    """Gap between a point and the round of an end of a part, the first or the second [m]."""
    d_x = bodies[part, X1] if first else bodies[part, X2]
    d_z = bodies[part, Z1] if first else bodies[part, Z2]
    radius = bodies[part, R1] if first else bodies[part, R2]
    c = math.cos(poses[row, POSE_PHI])
    s = math.sin(poses[row, POSE_PHI])
    a_x = ground[k, X] - poses[row, POSE_X] - c * d_x + s * d_z
    a_z = ground[k, Z] - poses[row, POSE_Z] - s * d_x - c * d_z
    return float(math.sqrt(a_x * a_x + a_z * a_z) - radius)


def flat_tilt(bodies: BodyTable, part: int) -> float:
    """Tilt of the normal of the flat of a part, from the ground into it, in the body frame."""
    across = bodies[part, COSINE] * bodies[part, SIDE]
    sine = bodies[part, SINE]
    return math.atan2(
        -sine * bodies[part, E_X] - across * bodies[part, E_Z],
        across * bodies[part, E_X] - sine * bodies[part, E_Z],
    )


def is_same(one: float, other: float) -> bool:
    """Whether two numbers are one to the digits that count, or both are not known."""
    if math.isnan(one) and math.isnan(other):
        return True
    return one * ALIKE + WHOLE - WHOLE == other * ALIKE + WHOLE - WHOLE


def stand_alike(supports: SupportTable, slots: int, loads: LoadTable, one: int, other: int) -> bool:
    """Whether two poses stand on the same, but for which points of the ground those are."""
    for column in range(LOAD_COULOMB + 1):
        if not is_same(loads[one, column], loads[other, column]):
            return False
    for slot in range(slots):
        a = one * slots + slot
        b = other * slots + slot
        if supports[a, SUPPORT_IS_ONE] != supports[b, SUPPORT_IS_ONE]:
            return False
        if supports[a, SUPPORT_IS_ONE] == 0.0:
            continue
        nowhere = supports[a, SUPPORT_POINT] == NOWHERE
        if nowhere != (supports[b, SUPPORT_POINT] == NOWHERE):
            return False
        for column in range(SUPPORT_X, SUPPORT_BESIDE + 1):
            if column != SUPPORT_POINT and not is_same(supports[a, column], supports[b, column]):
                return False
    return True


@entry
def find_alike(
    supports: SupportTable, slots: int, loads: LoadTable, unlike: IntArray, like: IntArray
) -> None:
    """Find of each pose the first one that stands alike: a regular flight repeats itself.

    Parameters
    ----------
    supports, slots
        As `find_supports` filled them.
    loads
        Of each pose.
    unlike
        Scratch, as long as the poses.
    like
        To be filled: its own row where none before stands alike.
    """
    count = 0
    for row in range(loads.shape[0]):
        like[row] = row
        for k in range(min(count, COMPARED)):
            other = unlike[count - 1 - k]
            if stand_alike(supports, slots, loads, row, other):
                like[row] = other
                break
        if like[row] == row:
            unlike[count] = row
            count += 1
