r"""Nosings that pass an end of a flat between two poses, while others carry it.

::

      before   o=======o---.      after    o=======o---.      the flat reaches nosing j where its
              i           j               i         o-- j     end comes over it
"""

from __future__ import annotations

from kaidan.contact.codes import BELLY
from kaidan.contact.entries import entry
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.kernel.trigonometry import placed
from kaidan.contact.layout import (
    KIND_MASK,
    POINT_BITS,
    VERTEX,
    At,
    EventRow,
    Margin,
    Part,
    Passed,
    Point,
    Pose,
    Scene,
)
from kaidan.contact.memory import Row, Table, empty, put

#: Arclength within which an event is at a place [m].
AT_PLACE = 1e-9
#: Rotation between two poses above which the drive has the event [rad].
STRAIGHT = 1e-9
#: Passings of one nosing by two parts in line are one [m], and how many before are looked back on.
IN_LINE = 1e-6
LOOKED_BACK = 8


def where_of(pose: Pose) -> At:
    """Where the body is in a pose."""
    return placed(pose.x, pose.z, pose.inclination)


def along_flat(part: Part, point: Point, at: At) -> tuple[float, float]:
    """Place of a point along the flat of a part and its gap to the flat's line [m]."""
    d_x = point.x - at.x
    d_z = point.z - at.z
    a_x = at.c * d_x + at.s * d_z - part.one.x
    a_z = at.c * d_z - at.s * d_x - part.one.z
    along = a_x * part.e_x + a_z * part.e_z
    below = part.side * (a_x * part.e_z - a_z * part.e_x)
    return (
        along * part.cosine - below * part.sine,
        along * part.sine + below * part.cosine - part.one.r,
    )


def is_of_vertex(feature: int, k: int) -> bool:
    """Whether a feature is a point of the ground under a part."""
    return feature >= 0 and feature & KIND_MASK == VERTEX and feature >> POINT_BITS == k


def is_reported(events: Table[EventRow], first: int, end: float, k: int) -> bool:
    """Whether some event, from a row up to an arclength, is of a point of the ground."""
    for row in range(first, len(events)):
        event = events[row]
        if event.s > end + AT_PLACE:
            return False
        if is_of_vertex(event.feature, k) or is_of_vertex(event.other, k):
            return True
    return False


def nosings_passed(
    scene: Scene, poses: Table[Pose], events: Table[EventRow], rows: Row[int], touch: float,
    reach: float, passed: Table[Passed],
) -> int:  # fmt: skip
    """Find nosings that come under a flat, or leave it, between poses, and of which no event tells.

    Bellies do not count.

    Parameters
    ----------
    poses, events
        Of :func:`kaidan.contact.kernel.driver.drive`.
    rows
        The first of each two poses, ascending.
    touch
        Gap up to which a nosing lies on the flat [m].
    reach
        Distance from the centroid that no part of the robot exceeds [m].
    passed
        To be filled, as far as it reaches.

    Returns
    -------
    number of nosings passed
    """
    ground = scene.ground
    count = 0
    told = 0
    for n in range(len(rows)):
        row = rows[n]
        pose = poses[row]
        next_pose = poses[row + 1]
        at = where_of(pose)
        next_at = where_of(next_pose)
        while told < len(events) and events[told].s < pose.s - AT_PLACE:
            told += 1
        last = max(pose.x, next_pose.x) + reach
        k = first_index(scene, min(pose.x, next_pose.x) - reach)
        while k < len(ground) and ground[k].x <= last:
            for number in range(len(scene.body) if ground[k].convex else 0):
                part = scene.body[number]
                if part.kind == BELLY:
                    continue
                before, gap = along_flat(part, ground[k], at)
                after, then = along_flat(part, ground[k], next_at)
                lay = abs(gap) < touch and before >= 0.0 and before <= part.flat
                lies = abs(then) < touch and after >= 0.0 and after <= part.flat
                if lay == lies or is_reported(events, told, next_pose.s, k):
                    continue
                share = -before / (after - before)
                if min(before, after) >= 0.0:
                    share = (part.flat - before) / (after - before)
                if count < len(passed):
                    found = passed[count]
                    found.s = pose.s + share * (next_pose.s - pose.s)
                    found.reached = lies
                    found.point = k
                    found.part = number
                    found.row = row
                    found.share = share
                count += 1
            k += 1
    return count


def leads_straight(pose: Pose, then: Pose) -> bool:
    """Whether the path leads from a pose straight to the next."""
    return (
        then.leg == pose.leg
        and abs(then.inclination - pose.inclination) < STRAIGHT
        and then.s > pose.s
    )


def contacts_change(margins: Table[Margin], row: int) -> bool:
    """Whether other contacts bound the margins of the next pose, or more or fewer carry it."""
    if row < 0 or row + 1 >= len(margins):
        return False
    one = margins[row]
    other = margins[row + 1]
    return (
        other.outer_rear != one.outer_rear
        or other.outer_front != one.outer_front
        or other.contacts != one.contacts
    )


def comes_before(one: Passed, other: Passed) -> bool:
    """Whether a passing comes before another: by its fields, one after the other."""
    if one.s != other.s:
        return one.s < other.s
    if one.reached != other.reached:
        return other.reached
    if one.point != other.point:
        return one.point < other.point
    if one.part != other.part:
        return one.part < other.part
    if one.row != other.row:
        return one.row < other.row
    return one.share < other.share


def put_passings_in_order(passed: Table[Passed]) -> None:
    """Sort passings, which all but are in their order."""
    swapped = empty(Passed, 1)[0]
    for k in range(1, len(passed)):
        for j in range(k, 0, -1):
            if not comes_before(passed[j], passed[j - 1]):
                break
            put(swapped, passed[j])
            put(passed[j], passed[j - 1])
            put(passed[j - 1], swapped)


def without_twins(passed: Table[Passed]) -> int:
    """Leave out nosings that pass from one part to the next in line with it; how many stay."""
    kept = 0
    for k in range(len(passed)):
        twin = -1
        for j in range(kept - 1, max(kept - LOOKED_BACK, 0) - 1, -1):
            if (
                twin < 0
                and passed[j].point == passed[k].point
                and passed[j].reached != passed[k].reached
                and abs(passed[j].s - passed[k].s) < IN_LINE
            ):
                twin = j
        if twin < 0:
            put(passed[kept], passed[k])
            kept += 1
            continue
        for j in range(twin, kept - 1):
            put(passed[j], passed[j + 1])
        kept -= 1
    return kept


@entry
def find_passings(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], events: Table[EventRow],
    touch: float, reach: float, passed: Table[Passed],
) -> int:  # fmt: skip
    """Find nosings that come under a flat, or leave it, along a path, in their order.

    poses, events, touch, reach: as for `nosings_passed`.
    margins: of the poses; without any it is looked everywhere.
    """
    rows = empty(int, len(poses))
    pieces = 0
    for row in range(len(poses) - 1):
        if not leads_straight(poses[row], poses[row + 1]):
            continue
        # a nosing counts as a contact a little before it comes under the flat: maybe one pose early
        if (
            len(margins) == 0
            or contacts_change(margins, row - 1)
            or contacts_change(margins, row)
            or contacts_change(margins, row + 1)
        ):
            rows[pieces] = row
            pieces += 1
    count = nosings_passed(scene, poses, events, rows[0:pieces], touch, reach, passed)
    if count > len(passed):
        return count
    put_passings_in_order(passed[0:count])
    return without_twins(passed[0:count])
