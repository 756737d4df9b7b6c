r"""Poses between those of a path at which its extremes may lie.

::

    required      .            o  a pose of the path
    friction    o' 'o          .  the peak between two
             _o'       u       u  where the path stands upright, and the traction is the largest
           o'                  |  a nosing comes under the flat, or leaves it: just before and
                  |               just after, another nosing carries in its place
"""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.kernel.margins import margins_without, pose_margins
from kaidan.contact.kernel.peak_search import figure_of, find_peaks, leads_on
from kaidan.contact.kernel.phases import LANDS
from kaidan.contact.kernel.renaming import poses_between
from kaidan.contact.kernel.trigonometry import atan2, cos, sin
from kaidan.contact.layout import (
    KIND_MASK,
    VERTEX,
    Figures,
    Margin,
    Passed,
    Pose,
    Pull,
    Samples,
    Scene,
    Touch,
)
from kaidan.contact.memory import Row, Table, empty, put

#: Share of the largest friction of a phase above which a peak is not looked for [1].
TOLERANCE = 1e-4
#: Difference of two directions that is rounding [rad].
ROUNDING = 1e-9
#: Group of what leaves an edge as it lands; other groups are the phases.
LEAVES = 3


#: Groups: phases, and what leaves an edge as it lands.
GROUPS = 4


def leaves_edge(pose: Pose) -> bool:
    """Whether the trailing end leaves an edge as the robot goes down.

    Its contact lies beyond the flat, on the end's arc or on a face, so that it pushes the robot
    ahead more than the flat would; and the path falls.
    """
    flat = max(-pose.inclination, 0.0)
    return pose.rear_lean > flat + ROUNDING and sin(pose.path_direction) < 0.0


def turns_at_end(one: Touch, phi: float, other: Touch, then: float) -> bool:
    """Whether a corner moves along the end of a belt from a pose to the next.

    ``phi`` and ``then`` are the inclinations of the poses [rad].
    """
    if one.feature & KIND_MASK != VERTEX and other.feature & KIND_MASK != VERTEX:
        return False
    was = atan2(one.n_x, one.n_z) + phi
    new = atan2(other.n_x, other.n_z) + then
    return abs(new - was) > ROUNDING


def moves_along_end(poses: Table[Pose], row: int) -> bool:
    """Whether a nosing moves along the end of a belt from a pose to the next.

    There the belt gives way at it up to some height and then no more: two kinks of the friction,
    which may be nearer to one another than the poses.
    """
    if not leads_on(poses, row):
        return False
    one = poses[row]
    other = poses[row + 1]
    phi = one.inclination
    then = other.inclination
    rear = turns_at_end(one.rear, phi, other.rear, then)
    return rear or turns_at_end(one.front, phi, other.front, then)


def turn_to(one: float, other: float) -> float:
    """Angle from one direction to another, within half a revolution [rad]."""
    return atan2(sin(other - one), cos(other - one))


def upright_at(poses: Table[Pose], row: int, upright: float) -> float:
    """Share of the arclength to the next pose at which the path may stand upright; -1: nowhere."""
    if not leads_on(poses, row):
        return -1.0
    psi = poses[row].path_direction
    then = poses[row + 1].path_direction
    # between two directions on one side of upright the path does not pass it
    if cos(psi) * cos(then) >= ROUNDING:
        return -1.0
    swept = turn_to(psi, then)
    away = turn_to(psi, upright)
    if away * swept > 0.0 and abs(away) < abs(swept):
        return away / swept
    return -1.0


def turns_steadily(one: Pose, other: Pose, psi: float) -> bool:
    """Whether the path turns steadily over a direction from a pose to the next.

    Where it comes to a stand and goes back, its direction jumps: nothing stands upright there.
    """
    first = turn_to(one.path_direction, psi)
    then = turn_to(psi, other.path_direction)
    half = 0.5 * math.pi
    return first * then > 0.0 and abs(first) < half and abs(then) < half


@entry
def find_samples(
    scene: Scene, path: Table[Pose], path_margins: Table[Margin], phase: Row[int],
    passed: Table[Passed], pull: Pull, found: Samples,
) -> int:  # fmt: skip
    """Find poses between those of a path at which its extremes may lie.

    phase: number of the phase of each pose, the last one `LANDS`.
    passed: nosings that a flat reaches or leaves.
    found: to be filled: poses of the path and those between them, with their margins and the row of
        the path before each. Where the path turns steadily over the upright, the traction is that
        of all the weight.
    """
    count = len(path)
    rows = found.rows
    poses = found.poses
    margins = found.margins
    figures = Figures(
        empty(float, count), empty(bool, count), empty(float, count), empty(int, count),
        empty(bool, count),
    )  # fmt: skip
    for row in range(count):
        rows[row] = row
        put(poses[row], path[row])
        put(margins[row], path_margins[row])
        figures.values[row] = figure_of(scene, path[row], path_margins[row], 0.0)
        leaves = phase[row] == LANDS and leaves_edge(path[row])
        figures.group[row] = LEAVES if leaves else phase[row]
        figures.narrow[row] = moves_along_end(path, row)
    parts = empty(float, len(passed) + 2 * count)
    points = empty(int, len(passed))
    for k in range(len(passed)):
        row = passed[k].row
        rows[count + k] = row
        parts[k] = (passed[k].s - path[row].s) / (path[row + 1].s - path[row].s)
        points[k] = passed[k].point
    total = count + len(passed)
    poses_between(scene, path, rows[count:total], parts, poses[count:total])
    margins_without(scene, poses[count:total], points, pull, margins[count:total])
    left = Samples(rows[total:], poses[total:], margins[total:])
    total += find_peaks(scene, path, figures, GROUPS, TOLERANCE, 0.0, pull, left)
    last = total
    for downward in range(2):
        direction = -0.5 * math.pi if downward == 1 else 0.5 * math.pi
        for row in range(count - 1):
            share = upright_at(path, row, direction)
            if share >= 0.0:
                rows[last] = row
                parts[last - total] = share
                last += 1
    poses_between(scene, path, rows[total:last], parts, poses[total:last])
    pose_margins(scene, poses[total:last], pull, margins[total:last])
    for k in range(total, last):
        psi = poses[k].path_direction
        if turns_steadily(path[rows[k]], path[rows[k] + 1], psi):
            margins[k].traction = (pull.g if sin(psi) > 0.0 else -pull.g) + pull.a
    return last
