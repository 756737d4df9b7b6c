r"""Nosings that pass an end of a flat between two poses, while others carry it.

::

      before   o=======o---.      after    o=======o---.      the flat reaches nosing j where its
              i           j               i         o-- j     end comes over it
"""

from __future__ import annotations

import math

from kaidan.contact.codes import BELLY
from kaidan.contact.columns import (
    CONTACTS,
    CONVEX,
    COSINE,
    E_X,
    E_Z,
    EVENT_FEATURE,
    EVENT_OTHER,
    EVENT_S,
    FLAT,
    KIND,
    KIND_MASK,
    OUTER_FRONT,
    OUTER_REAR,
    PASSED_COLUMNS,
    PASSED_PART,
    PASSED_POINT,
    PASSED_REACHED,
    PASSED_ROW,
    PASSED_S,
    PASSED_SHARE,
    POINT_BITS,
    POSE_LEG,
    POSE_PHI,
    POSE_S,
    POSE_X,
    POSE_Z,
    R1,
    SIDE,
    SINE,
    VERTEX,
    X1,
    Z1,
    X,
    Z,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.nearest_feature import first_index
from kaidan.contact.tables import (
    BodyTable,
    EventTable,
    GroundTable,
    IntArray,
    MarginTable,
    PassedTable,
    PoseTable,
)

#: Arclength within which an event is at a place [m].
AT_PLACE = 1e-9
#: Rotation between two poses above which the drive has the event [rad].
STRAIGHT = 1e-9
#: Passings of one nosing by two parts in line are one [m], and how many before are looked back on.
IN_LINE = 1e-6
LOOKED_BACK = 8


def along_flat(
    ground: GroundTable, body: BodyTable, poses: PoseTable, row: int, part: int, k: int
) -> tuple[float, float]:
    """Place of a point along the flat of a part and its gap to the flat's line [m]."""
    c = math.cos(poses[row, POSE_PHI])
    s = math.sin(poses[row, POSE_PHI])
    d_x = ground[k, X] - poses[row, POSE_X]
    d_z = ground[k, Z] - poses[row, POSE_Z]
    a_x = c * d_x + s * d_z - body[part, X1]
    a_z = c * d_z - s * d_x - body[part, Z1]
    along = a_x * body[part, E_X] + a_z * body[part, E_Z]
    below = body[part, SIDE] * (a_x * body[part, E_Z] - a_z * body[part, E_X])
    return (
        along * body[part, COSINE] - below * body[part, SINE],
        along * body[part, SINE] + below * body[part, COSINE] - body[part, R1],
    )


def is_reported(events: EventTable, first: int, end: float, k: int) -> bool:
    """Whether some event, from a row up to an arclength, is of a point of the ground."""
    for row in range(first, events.shape[0]):
        if events[row, EVENT_S] > end + AT_PLACE:
            return False
        one = int(events[row, EVENT_FEATURE])
        other = int(events[row, EVENT_OTHER])
        if one >= 0 and one >> POINT_BITS == k and one & KIND_MASK == VERTEX:
            return True
        if other >= 0 and other >> POINT_BITS == k and other & KIND_MASK == VERTEX:
            return True
    return False


def nosings_passed(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    events: EventTable,
    rows: IntArray,
    touch: float,
    reach: float,
    passed: PassedTable,
) -> int:
    """Find nosings that come under a flat, or leave it, between poses, and of which no event tells.

    Parameters
    ----------
    ground, body
        Tables; bellies do not count.
    poses, events
        Tables of :func:`kaidan.contact.kernel.driver.drive`.
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
    count = 0
    hint = 0
    told = 0
    for n in range(rows.shape[0]):
        row = rows[n]
        begin = poses[row, POSE_S]
        end = poses[row + 1, POSE_S]
        while told < events.shape[0] and events[told, EVENT_S] < begin - AT_PLACE:
            told += 1
        first = min(poses[row, POSE_X], poses[row + 1, POSE_X]) - reach
        last = max(poses[row, POSE_X], poses[row + 1, POSE_X]) + reach
        hint = first_index(ground, first, hint)
        k = hint
        while k < ground.shape[0] and ground[k, X] <= last:
            if ground[k, CONVEX] == 1.0:
                for part in range(body.shape[0]):
                    if int(body[part, KIND]) == BELLY:
                        continue
                    before, gap = along_flat(ground, body, poses, row, part, k)
                    after, then = along_flat(ground, body, poses, row + 1, part, k)
                    length = body[part, FLAT]
                    lay = abs(gap) < touch and before >= 0.0 and before <= length
                    lies = abs(then) < touch and after >= 0.0 and after <= length
                    if lay == lies or is_reported(events, told, end, k):
                        continue
                    share = -before / (after - before)
                    if min(before, after) >= 0.0:
                        share = (length - before) / (after - before)
                    if count < passed.shape[0]:
                        passed[count, PASSED_S] = begin + share * (end - begin)
                        passed[count, PASSED_REACHED] = 1.0 if lies else 0.0
                        passed[count, PASSED_POINT] = k
                        passed[count, PASSED_PART] = part
                        passed[count, PASSED_ROW] = row
                        passed[count, PASSED_SHARE] = share
                    count += 1
            k += 1
    return count


def leads_straight(poses: PoseTable, row: int) -> bool:
    """Whether the path leads from a pose straight to the next."""
    return bool(
        poses[row + 1, POSE_LEG] == poses[row, POSE_LEG]
        and abs(poses[row + 1, POSE_PHI] - poses[row, POSE_PHI]) < STRAIGHT
        and poses[row + 1, POSE_S] > poses[row, POSE_S]
    )


def contacts_change(margins: MarginTable, row: int) -> bool:
    """Whether other contacts bound the margins of the next pose, or more or fewer carry it."""
    if row < 0 or row + 1 >= margins.shape[0]:
        return False
    return bool(
        margins[row + 1, OUTER_REAR] != margins[row, OUTER_REAR]
        or margins[row + 1, OUTER_FRONT] != margins[row, OUTER_FRONT]
        or margins[row + 1, CONTACTS] != margins[row, CONTACTS]
    )


def comes_before(passed: PassedTable, one: int, other: int) -> bool:
    """Whether a passing comes before another: by its columns, one after the other."""
    for column in range(PASSED_COLUMNS):
        if passed[one, column] != passed[other, column]:
            return bool(passed[one, column] < passed[other, column])
    return False


def put_passings_in_order(passed: PassedTable, count: int) -> None:
    """Sort some passings, which all but are in their order."""
    for k in range(1, count):
        for j in range(k, 0, -1):
            if not comes_before(passed, j, j - 1):
                break
            for column in range(PASSED_COLUMNS):
                swapped = passed[j, column]
                passed[j, column] = passed[j - 1, column]
                passed[j - 1, column] = swapped


def without_twins(passed: PassedTable, count: int) -> int:
    """Leave out nosings that pass from one part to the next in line with it; how many stay."""
    kept = 0
    for k in range(count):
        twin = -1
        for j in range(kept - 1, max(kept - LOOKED_BACK, 0) - 1, -1):
            if (
                twin < 0
                and passed[j, PASSED_POINT] == passed[k, PASSED_POINT]
                and passed[j, PASSED_REACHED] != passed[k, PASSED_REACHED]
                and abs(passed[j, PASSED_S] - passed[k, PASSED_S]) < IN_LINE
            ):
                twin = j
        if twin < 0:
            for column in range(PASSED_COLUMNS):
                passed[kept, column] = passed[k, column]
            kept += 1
            continue
        for j in range(twin, kept - 1):
            for column in range(PASSED_COLUMNS):
                passed[j, column] = passed[j + 1, column]
        kept -= 1
    return kept


@entry
def find_passings(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    margins: MarginTable,
    known: bool,
    events: EventTable,
    touch: float,
    reach: float,
    rows: IntArray,
    passed: PassedTable,
) -> int:
    """Find nosings that come under a flat, or leave it, along a path, in their order.

    Parameters
    ----------
    ground, body, poses, events, touch, reach
        As for `nosings_passed`.
    margins, known
        Margins of the poses, and whether there are any: without them it is looked everywhere.
    rows
        Scratch, as long as the poses.
    passed
        To be filled.

    Returns
    -------
    number of passings; more than there is room for: too many to be found
    """
    pieces = 0
    for row in range(poses.shape[0] - 1):
        if not leads_straight(poses, row):
            continue
        # a nosing counts as a contact a little before it comes under the flat: maybe one pose early
        if (
            not known
            or contacts_change(margins, row - 1)
            or contacts_change(margins, row)
            or contacts_change(margins, row + 1)
        ):
            rows[pieces] = row
            pieces += 1
    count = nosings_passed(ground, body, poses, events, rows[0:pieces], touch, reach, passed)
    if count > passed.shape[0]:
        return count
    put_passings_in_order(passed, count)
    return without_twins(passed, count)
