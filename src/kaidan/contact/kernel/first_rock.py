r"""Least tilt of gravity at which a robot rotates to one side by more than rocking.

::

        C           gravity tilted towards the downhill end until its line passes the contact that
       /|\          stays: there the robot rotates
      / | \
     o  |  o
        v
"""

from __future__ import annotations

import math

from kaidan.contact.codes import ROCKING
from kaidan.contact.columns import POSE_LEG, POSE_PHI, POSE_S
from kaidan.contact.entries import entry
from kaidan.contact.kernel.energy_margins import pose_tilt
from kaidan.contact.kernel.heaps import heap_of, taken
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.peak_search import find_peaks
from kaidan.contact.kernel.renaming import poses_between
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    FloatRow,
    GroundTable,
    IntArray,
    MarginTable,
    PoseTable,
    WayTable,
)

#: Difference of tilts that is none [rad].
TIE = 1e-9
#: Share of the least tilt to which it is found between poses [1].
WITHIN = 1e-5
#: Poses that are looked at together for more than where they rotate at all.
LOOKED_AT_ONCE = 8
#: Share of the rocking between two poses by which it jumps from nosing to nosing [1].
JUMP = 0.25
#: To which the place is found where a nosing is left [m].
LEFT_AT = 1e-6


def rocking_of(whence: float, phi: float) -> float:
    """Rotation of a pose that is rocking, where it came down from an inclination [rad]."""
    return max(whence - phi, 0.0) + ROCKING


def least_tilts(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, pose: IntArray,
    reach: FloatRow, begin: int, end: int, side: float, order: IntArray, alone: FloatRow,
    tilt: FloatRow,
) -> None:  # fmt: skip
    """Tilts at which some poses rotate at all; and by more than rocking, as far as it may be least.

    Parameters
    ----------
    ground, body, poses, margins
        As for :func:`kaidan.contact.kernel.margins.pose_margins`.
    pose, reach
        Row of each pose, rotation that is rocking [rad].
    begin, end
        Which of them.
    side
        +1 back, -1 front.
    order
        Scratch, as long as they are.
    alone, tilt
        To be filled [rad]: infinite where it is not looked for, as it is not the least.
    """
    hint = 0
    left = end - begin
    for k in range(begin, end):
        alone[k], _, hint = pose_tilt(ground, body, poses, margins, pose[k], side, 0.0, hint)
        tilt[k] = math.inf
        order[k - begin] = k
    heap_of(order, alone, left)
    least = math.inf
    while left > 0 and alone[order[0]] < least - TIE:
        found = least
        for _ in range(min(LOOKED_AT_ONCE, left)):
            k = taken(order, alone, left)
            left -= 1
            tilt[k], _, hint = pose_tilt(
                ground, body, poses, margins, pose[k], side, reach[k], hint
            )
            found = min(found, tilt[k])
        least = found


def mark_ways(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, at: IntArray,
    alone: FloatRow, count: int, side: float, whence: FloatRow, least: float, group: IntArray,
    beside: IntArray,
) -> None:  # fmt: skip
    """Mark the ways between poses that count, at one of which a nosing may be rocked onto.

    Parameters
    ----------
    at, alone, count
        Rows that may, tilt at which each rotates at all [rad], how many.
    least
        Tilt of any pose [rad].
    group
        0 where a pose counts.
    beside
        To be filled: 1 where the way to the next pose is one.
    """
    for row in range(poses.shape[0]):
        beside[row] = 0
    hint = 0
    for k in range(count):
        row = at[k]
        reach = rocking_of(whence[row], poses[row, POSE_PHI])
        if alone[k] >= least + reach:
            continue
        _, rocks, hint = pose_tilt(ground, body, poses, margins, row, side, reach, hint)
        if rocks > 0.0:
            beside[row] = 1
            beside[max(row - 1, 0)] = 1
    for row in range(poses.shape[0]):
        last = row + 1 == poses.shape[0]
        if last or group[row] != 0 or group[row + 1] != 0:
            beside[row] = 0


def between_tilt(
    ground: GroundTable, body: BodyTable, poses: PoseTable, row: int, at: float, side: float,
    whence: float, a: float, g: float, touch: float, places: IntArray, shares: FloatRow,
    new: PoseTable, new_margins: MarginTable, contacts: ContactTable, hint: int,
) -> tuple[float, float, int]:  # fmt: skip
    """Tilt and rocking, as of `pose_tilt`, at a share of the arclength from a pose to the next."""
    places[0] = row
    shares[0] = at
    poses_between(ground, body, poses, places, shares, 1, new)
    pose_margins(ground, body, new, 1, a, g, touch, new_margins, contacts)
    reach = rocking_of(whence, new[0, POSE_PHI])
    return pose_tilt(ground, body, new, new_margins, 0, side, reach, hint)


def lost_between(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable,
    beside: IntArray, side: float, whence: FloatRow, least: float, lowest: float,
    a: float, g: float, touch: float, places: IntArray, shares: FloatRow, new: PoseTable,
    new_margins: MarginTable, contacts: ContactTable,
) -> tuple[float, int]:  # fmt: skip
    """Least tilt as the flat comes to leave, or to reach, a nosing that it would rock onto.

    Parameters
    ----------
    beside
        1 where the way to the next pose counts, and a nosing may be rocked onto at one of both.
    least
        Tilt of any pose [rad]: a place is looked for where it may be less.
    lowest
        Tilt below which the robot has rocked nowhere [rad].

    Returns
    -------
    tilt [rad], row before it (-1: none)
    """
    longest = 0.0
    hint = 0
    lost = math.inf
    at = -1
    for halved in range(2):
        for row in range(poses.shape[0] - 1):
            if (
                beside[row] == 0
                or poses[row, POSE_LEG] != poses[row + 1, POSE_LEG]
                or poses[row, POSE_S] >= poses[row + 1, POSE_S]
            ):
                continue
            reach = rocking_of(whence[row], poses[row, POSE_PHI])
            tilt0, rocks0, hint = pose_tilt(ground, body, poses, margins, row, side, reach, hint)
            reach = rocking_of(whence[row], poses[row + 1, POSE_PHI])
            tilt1, rocks1, hint = pose_tilt(
                ground, body, poses, margins, row + 1, side, reach, hint
            )
            steeper = abs(rocks1 - rocks0)
            if (
                min(tilt0, tilt1) - steeper >= least + ROCKING
                or max(steeper, abs(tilt1 - tilt0)) <= TIE
            ):
                continue
            if halved == 0:
                longest = max(longest, poses[row + 1, POSE_S] - poses[row, POSE_S])
                continue
            # from one nosing to the next the rocking jumps; or if hardly, the tilt
            of_tilt = steeper <= JUMP * max(rocks0, rocks1)
            half = 0.5 * (tilt0 + tilt1) if of_tilt else 0.5 * (rocks0 + rocks1)
            falls = tilt0 > tilt1 if of_tilt else rocks0 > rocks1
            low = 0.0
            high = 1.0
            while longest * (high - low) > LEFT_AT:
                middle = 0.5 * (low + high)
                tilt, rocks, hint = between_tilt(
                    ground, body, poses, row, middle, side, whence[row], a, g, touch,
                    places, shares, new, new_margins, contacts, hint,
                )  # fmt: skip
                if ((tilt if of_tilt else rocks) > half) == falls:
                    low = middle
                else:
                    high = middle
            before, rocked, hint = between_tilt(
                ground, body, poses, row, low, side, whence[row], a, g, touch,
                places, shares, new, new_margins, contacts, hint,
            )  # fmt: skip
            after, rocks, hint = between_tilt(
                ground, body, poses, row, high, side, whence[row], a, g, touch,
                places, shares, new, new_margins, contacts, hint,
            )  # fmt: skip
            # left, the nosing leaves the robot steeper by what it rocked
            left = max(after - max(rocked - rocks, 0.0), lowest)
            found = min(before, after, left)
            if found < lost:
                lost = found
                at = row
    return lost, at


@entry
def first_rock(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    margins: MarginTable,
    rows: IntArray,
    own: int,
    side: float,
    whence: FloatRow,
    a: float,
    g: float,
    touch: float,
    values: FloatRow,
    group: IntArray,
    narrow: IntArray,
    at: IntArray,
    pose: IntArray,
    reach: FloatRow,
    alone: FloatRow,
    tilt: FloatRow,
    beside: IntArray,
    largest: FloatRow,
    s: FloatRow,
    line: IntArray,
    ways: WayTable,
    kept: WayTable,
    order: IntArray,
    chosen: IntArray,
    places: IntArray,
    shares: FloatRow,
    inside: FloatRow,
    new: PoseTable,
    new_margins: MarginTable,
    contacts: ContactTable,
    dips: IntArray,
    between: PoseTable,
    between_margins: MarginTable,
) -> tuple[float, int]:
    """Least tilt of gravity at which some poses rotate by more than rocking, to one side.

    Of nosings under a flat those too carry that it only rests on after rocking. Where the flat
    leaves such a nosing nothing closes or opens, so that no pose may stand there: the place is
    halved out between two. So is the place of a least tilt. Left, the nosing leaves the robot
    steeper by what it rocked, which is subtracted there, down to a tilt at which it rocks nowhere.

    Parameters
    ----------
    ground, body, poses, margins, a, g, touch
        As for :func:`kaidan.contact.kernel.margins.pose_margins`.
    rows
        Which poses, ascending.
    own
        Poses at the head of the table that follow one another; the rest lie between two of them.
    side
        +1 back, -1 front.
    whence
        Inclination from which each pose came down by rocking [rad]: gravity tilted back returns it
        there, and that is rocking too. Minus infinity: from none.
    values, group, narrow, at, pose, reach, alone, tilt, beside
        Scratch: of each pose, minus the tilt at which it rotates, its group, whether a way is
        narrow; of each that is looked at, the row that it counts as, its own, rocking and tilts;
        which ways are looked at.
    largest, s, line, ways, kept, order, chosen, places, shares, inside, new, new_margins, contacts
        Scratch of :func:`kaidan.contact.kernel.peak_search.find_peaks`.
    dips, between, between_margins
        Likewise what it fills.

    Returns
    -------
    tilt [rad], row of the pose
    """
    for row in range(poses.shape[0]):
        values[row] = -math.inf
        group[row] = -1
        narrow[row] = 0
    many = rows.shape[0]
    for k in range(many):
        at[k] = rows[k]
        pose[k] = rows[k]
        reach[k] = rocking_of(whence[rows[k]], poses[rows[k], POSE_PHI])
    least_tilts(ground, body, poses, margins, pose, reach, 0, many, side, order, alone, tilt)
    for k in range(many):
        if rows[k] < own:
            values[rows[k]] = -alone[k]
            group[rows[k]] = 0
    found = find_peaks(
        ground, body, poses, values, group, narrow, WITHIN, side, a, g, touch, largest, s, line,
        ways, kept, order, chosen, places, shares, inside, new, new_margins, contacts,
        dips, between, between_margins,
    )  # fmt: skip
    for k in range(found):
        at[many + k] = dips[k]
        pose[many + k] = k
        reach[many + k] = rocking_of(whence[dips[k]], between[k, POSE_PHI])
    least_tilts(
        ground, body, between, between_margins, pose, reach, many, many + found, side, order,
        alone, tilt,
    )  # fmt: skip
    least = math.inf
    lowest = math.inf
    for k in range(many + found):
        least = min(least, tilt[k])
        lowest = min(lowest, alone[k])
    mark_ways(
        ground, body, poses, margins, at, alone, many + found, side, whence, least, group, beside
    )
    lost, before = lost_between(
        ground, body, poses, margins, beside, side, whence, least, lowest, a, g, touch,
        places, shares, new, new_margins, contacts,
    )  # fmt: skip
    if lost < least - TIE:
        return lost, before
    for k in range(many + found):
        if tilt[k] <= least + TIE:
            return least, at[k]
    return least, -1
