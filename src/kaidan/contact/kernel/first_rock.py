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
from kaidan.contact.kernel.energy_margins import pose_tilt
from kaidan.contact.kernel.heaps import heap_of, taken
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.peak_search import find_peaks, most_peaks
from kaidan.contact.kernel.renaming import poses_between
from kaidan.contact.layout import Figures, Looked, Margin, Pose, Pull, Samples, Scene
from kaidan.contact.memory import Row, Table, empty

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
    scene: Scene, poses: Table[Pose], margins: Table[Margin], side: float, looked: Looked
) -> None:
    """Tilts at which some poses rotate at all; and by more than rocking, as far as it may be least.

    side: +1 back, -1 front.
    looked: tilts are to be filled: infinite where it is not looked for, as it is not the least.
    """
    left = len(looked.pose)
    order = empty(int, left)
    for k in range(left):
        row = looked.pose[k]
        looked.alone[k], _ = pose_tilt(scene, poses[row], margins[row], side, 0.0)
        looked.tilt[k] = math.inf
        order[k] = k
    heap_of(order, looked.alone, left)
    least = math.inf
    while left > 0 and looked.alone[order[0]] < least - TIE:
        found = least
        for _ in range(min(LOOKED_AT_ONCE, left)):
            k = taken(order, looked.alone, left)
            left -= 1
            row = looked.pose[k]
            tilt, _ = pose_tilt(scene, poses[row], margins[row], side, looked.reach[k])
            looked.tilt[k] = tilt
            found = min(found, tilt)
        least = found


def mark_ways(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], looked: Looked, side: float,
    whence: Row[float], least: float, group: Row[int], beside: Row[bool],
) -> None:  # fmt: skip
    """Mark the ways between poses that count, at one of which a nosing may be rocked onto.

    least: tilt of any pose [rad].
    group: 0 where a pose counts.
    """
    for row in range(len(poses)):
        beside[row] = False
    for k in range(len(looked.at)):
        row = looked.at[k]
        reach = rocking_of(whence[row], poses[row].inclination)
        if looked.alone[k] >= least + reach:
            continue
        _, rocks = pose_tilt(scene, poses[row], margins[row], side, reach)
        if rocks > 0.0:
            beside[row] = True
            beside[max(row - 1, 0)] = True
    for row in range(len(poses)):
        last = row + 1 == len(poses)
        if last or group[row] != 0 or group[row + 1] != 0:
            beside[row] = False


def between_tilt(
    scene: Scene, poses: Table[Pose], row: int, share: float, side: float, whence: float, pull: Pull
) -> tuple[float, float]:
    """Tilt and rocking, as of `pose_tilt`, at a share of the arclength from a pose to the next."""
    rows = empty(int, 1)
    shares = empty(float, 1)
    new = empty(Pose, 1)
    margins = empty(Margin, 1)
    rows[0] = row
    shares[0] = share
    poses_between(scene, poses, rows, shares, new)
    pose_margins(scene, new, pull, margins)
    reach = rocking_of(whence, new[0].inclination)
    return pose_tilt(scene, new[0], margins[0], side, reach)


def lost_between(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], beside: Row[bool], side: float,
    whence: Row[float], least: float, lowest: float, pull: Pull,
) -> tuple[float, int]:  # fmt: skip
    """Least tilt as the flat comes to leave, or to reach, a nosing that it would rock onto.

    beside: whether the way to the next pose counts, and a nosing may be rocked onto at one of both.
    least: tilt of any pose [rad]: a place is looked for where it may be less.
    lowest: tilt below which the robot has rocked nowhere [rad].

    tilt [rad], row before it (-1: none).
    """
    longest = 0.0
    lost = math.inf
    at = -1
    for halved in range(2):
        for row in range(len(poses) - 1):
            pose = poses[row]
            then = poses[row + 1]
            if not beside[row] or pose.leg != then.leg or pose.s >= then.s:
                continue
            reach = rocking_of(whence[row], pose.inclination)
            tilt0, rocks0 = pose_tilt(scene, pose, margins[row], side, reach)
            reach = rocking_of(whence[row], then.inclination)
            tilt1, rocks1 = pose_tilt(scene, then, margins[row + 1], side, reach)
            steeper = abs(rocks1 - rocks0)
            if (
                min(tilt0, tilt1) - steeper >= least + ROCKING
                or max(steeper, abs(tilt1 - tilt0)) <= TIE
            ):
                continue
            if halved == 0:
                longest = max(longest, then.s - pose.s)
                continue
            # from one nosing to the next the rocking jumps; or if hardly, the tilt
            of_tilt = steeper <= JUMP * max(rocks0, rocks1)
            half = 0.5 * (tilt0 + tilt1) if of_tilt else 0.5 * (rocks0 + rocks1)
            falls = tilt0 > tilt1 if of_tilt else rocks0 > rocks1
            low = 0.0
            high = 1.0
            while longest * (high - low) > LEFT_AT:
                middle = 0.5 * (low + high)
                tilt, rocks = between_tilt(scene, poses, row, middle, side, whence[row], pull)
                if ((tilt if of_tilt else rocks) > half) == falls:
                    low = middle
                else:
                    high = middle
            before, rocked = between_tilt(scene, poses, row, low, side, whence[row], pull)
            after, rocks = between_tilt(scene, poses, row, high, side, whence[row], pull)
            # left, the nosing leaves the robot steeper by what it rocked
            left = max(after - max(rocked - rocks, 0.0), lowest)
            found = min(before, after, left)
            if found < lost:
                lost = found
                at = row
    return lost, at


def first_rock(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], rows: Row[int], own: int,
    side: float, whence: Row[float], pull: Pull,
) -> tuple[float, int]:  # fmt: skip
    """Least tilt of gravity at which some poses rotate by more than rocking, to one side.

    Of nosings under a flat those too carry that it only rests on after rocking. Where the flat
    leaves such a nosing nothing closes or opens, so that no pose may stand there: the place is
    halved out between two. So is the place of a least tilt. Left, the nosing leaves the robot
    steeper by what it rocked, which is subtracted there, down to a tilt at which it rocks nowhere.

    side: +1 back, -1 front.
    whence: inclination from which each pose came down by rocking [rad]: gravity tilted back returns
        it there, and that is rocking too. Minus infinity: from none.

    tilt [rad], row of the pose.
    """
    size = len(poses)
    figures = Figures(
        empty(float, size), empty(bool, size), empty(float, size), empty(int, size),
        empty(bool, size),
    )  # fmt: skip
    for row in range(size):
        figures.values[row] = -math.inf
        figures.group[row] = -1
        figures.narrow[row] = False
    many = len(rows)
    most = many + most_peaks(1)
    looked = Looked(
        empty(int, most), empty(int, most), empty(float, most), empty(float, most),
        empty(float, most),
    )  # fmt: skip
    for k in range(many):
        looked.at[k] = rows[k]
        looked.pose[k] = rows[k]
        looked.reach[k] = rocking_of(whence[rows[k]], poses[rows[k]].inclination)
    least_tilts(scene, poses, margins, side, part_of_looked(looked, 0, many))
    for k in range(many):
        if rows[k] < own:
            figures.values[rows[k]] = -looked.alone[k]
            figures.group[rows[k]] = 0
    dips = Samples(
        empty(int, most_peaks(1)), empty(Pose, most_peaks(1)), empty(Margin, most_peaks(1))
    )
    count = many + find_peaks(scene, poses, figures, 1, WITHIN, side, pull, dips)
    for k in range(many, count):
        looked.at[k] = dips.rows[k - many]
        looked.pose[k] = k - many
        phi = dips.poses[k - many].inclination
        looked.reach[k] = rocking_of(whence[looked.at[k]], phi)
    least_tilts(scene, dips.poses, dips.margins, side, part_of_looked(looked, many, count))
    least = math.inf
    lowest = math.inf
    for k in range(count):
        least = min(least, looked.tilt[k])
        lowest = min(lowest, looked.alone[k])
    beside = empty(bool, size)
    mark_ways(
        scene, poses, margins, part_of_looked(looked, 0, count), side, whence, least,
        figures.group, beside,
    )  # fmt: skip
    lost, before = lost_between(scene, poses, margins, beside, side, whence, least, lowest, pull)
    if lost < least - TIE:
        return lost, before
    for k in range(count):
        if looked.tilt[k] <= least + TIE:
            return least, looked.at[k]
    return least, -1


def part_of_looked(looked: Looked, first: int, last: int) -> Looked:
    """Some of the poses that are looked at."""
    return Looked(
        looked.at[first:last], looked.pose[first:last], looked.reach[first:last],
        looked.alone[first:last], looked.tilt[first:last],
    )  # fmt: skip
