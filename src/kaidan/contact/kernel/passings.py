r"""Nosings that pass an end of a flat between two poses, while others carry it.

::

      before   o=======o---.      after    o=======o---.      the flat reaches nosing j where its
              i           j               i         o-- j     end comes over it
"""

from __future__ import annotations

import math

from kaidan.contact.codes import BELLY
from kaidan.contact.columns import (
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
    PASSED_PART,
    PASSED_POINT,
    PASSED_REACHED,
    PASSED_ROW,
    PASSED_S,
    PASSED_SHARE,
    POINT_BITS,
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
    PassedTable,
    PoseTable,
)

#: Arclength within which an event is at a place [m].
AT_PLACE = 1e-9


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


@entry
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
