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

from kaidan.contact.columns import (
    FRONT_N_X,
    FRONT_N_Z,
    KIND_MASK,
    MARGIN_COLUMNS,
    PASSED_POINT,
    PASSED_ROW,
    PASSED_S,
    POSE_COLUMNS,
    POSE_FRONT,
    POSE_PHI,
    POSE_PSI,
    POSE_REAR,
    POSE_S,
    REAR_LEAN,
    REAR_N_X,
    REAR_N_Z,
    TRACTION,
    VERTEX,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.margins import margins_without, pose_margins
from kaidan.contact.kernel.peak_search import figure_of, find_peaks, leads_on
from kaidan.contact.kernel.phases import LANDS
from kaidan.contact.kernel.renaming import poses_between
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    FloatRow,
    GroundTable,
    IntArray,
    MarginTable,
    PassedTable,
    PoseTable,
    WayTable,
)

#: Share of the largest friction of a phase above which a peak is not looked for [1].
TOLERANCE = 1e-4
#: Difference of two directions that is rounding [rad].
ROUNDING = 1e-9
#: Group of what leaves an edge as it lands; other groups are the phases.
LEAVES = 3


def leaves_edge(poses: PoseTable, row: int) -> bool:
    """Whether the trailing end leaves an edge as the robot goes down.

    Its contact lies beyond the flat, on the end's arc or on a face, so that it pushes the robot
    ahead more than the flat would; and the path falls.
    """
    flat = max(-poses[row, POSE_PHI], 0.0)
    leans: bool = poses[row, REAR_LEAN] > flat + ROUNDING
    return leans and math.sin(poses[row, POSE_PSI]) < 0.0


def turns_at_end(poses: PoseTable, row: int, feature: int, n_x: int, n_z: int) -> bool:
    """Whether a corner moves along the end of a belt from a pose to the next.

    ``feature``, ``n_x`` and ``n_z`` are the columns of the contact and of its normal.
    """
    one = int(poses[row, feature]) & KIND_MASK
    two = int(poses[row + 1, feature]) & KIND_MASK
    if one != VERTEX and two != VERTEX:
        return False
    was = math.atan2(poses[row, n_x], poses[row, n_z]) + poses[row, POSE_PHI]
    new = math.atan2(poses[row + 1, n_x], poses[row + 1, n_z]) + poses[row + 1, POSE_PHI]
    return bool(abs(new - was) > ROUNDING)


def moves_along_end(poses: PoseTable, row: int) -> bool:
    """Whether a nosing moves along the end of a belt from a pose to the next.

    There the belt gives way at it up to some height and then no more: two kinks of the friction,
    which may be nearer to one another than the poses.
    """
    return leads_on(poses, row) and (
        turns_at_end(poses, row, POSE_REAR, REAR_N_X, REAR_N_Z)
        or turns_at_end(poses, row, POSE_FRONT, FRONT_N_X, FRONT_N_Z)
    )


def turn_to(one: float, other: float) -> float:
    """Angle from one direction to another, within half a revolution [rad]."""
    return math.atan2(math.sin(other - one), math.cos(other - one))


def upright_at(poses: PoseTable, row: int, upright: float) -> float:
    """Share of the arclength to the next pose at which the path may stand upright; -1: nowhere."""
    psi = poses[row, POSE_PSI]
    then = poses[row + 1, POSE_PSI]
    # between two directions on one side of upright the path does not pass it
    if not leads_on(poses, row) or math.cos(psi) * math.cos(then) >= ROUNDING:
        return -1.0
    swept = turn_to(psi, then)
    away = turn_to(psi, upright)
    if away * swept > 0.0 and abs(away) < abs(swept):
        return away / swept
    return -1.0


def turns_steadily(poses: PoseTable, row: int, psi: float) -> bool:
    """Whether the path turns steadily over a direction from a pose to the next.

    Where it comes to a stand and goes back, its direction jumps: nothing stands upright there.
    """
    first = turn_to(poses[row, POSE_PSI], psi)
    then = turn_to(psi, poses[row + 1, POSE_PSI])
    half = 0.5 * math.pi
    return first * then > 0.0 and abs(first) < half and abs(then) < half


@entry
def find_samples(
    ground: GroundTable,
    body: BodyTable,
    path: PoseTable,
    path_margins: MarginTable,
    phase: IntArray,
    passed: PassedTable,
    passings: int,
    a: float,
    g: float,
    touch: float,
    values: FloatRow,
    group: IntArray,
    narrow: IntArray,
    points: IntArray,
    parts: FloatRow,
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
    rows: IntArray,
    poses: PoseTable,
    margins: MarginTable,
) -> int:
    """Find poses between those of a path at which its extremes may lie.

    Parameters
    ----------
    ground, body, a, g, touch
        As for :func:`kaidan.contact.kernel.margins.pose_margins`.
    path, path_margins
        Poses and their margins.
    phase
        Number of the phase of each pose, the last one `LANDS`.
    passed, passings
        Nosings that a flat reaches or leaves, and their number.
    values, group, narrow, points, parts
        Scratch: of each pose its friction, its group, whether the way from it is narrow; of each
        pose in between the point of a nosing that does not count, the share of the arclength.
    largest, s, line, ways, kept, order, chosen, places, shares, inside, new, new_margins, contacts
        Scratch of :func:`kaidan.contact.kernel.peak_search.find_peaks`.
    rows, poses, margins
        To be filled: poses of the path and those between them, with their margins and the row of
        the path before each. Where the path turns steadily over the upright, the traction is that
        of all the weight.

    Returns
    -------
    number of poses
    """
    count = path.shape[0]
    hint = 0
    for row in range(count):
        rows[row] = row
        for column in range(POSE_COLUMNS):
            poses[row, column] = path[row, column]
        for column in range(MARGIN_COLUMNS):
            margins[row, column] = path_margins[row, column]
        values[row], hint = figure_of(ground, body, path, path_margins, row, 0.0, hint)
        group[row] = phase[row]
        if phase[row] == LANDS and leaves_edge(path, row):
            group[row] = LEAVES
        narrow[row] = 1 if row + 1 < count and moves_along_end(path, row) else 0
    for k in range(passings):
        row = int(passed[k, PASSED_ROW])
        begin = path[row, POSE_S]
        rows[count + k] = row
        parts[k] = (passed[k, PASSED_S] - begin) / (path[row + 1, POSE_S] - begin)
        points[k] = int(passed[k, PASSED_POINT])
    total = count + passings
    poses_between(ground, body, path, rows[count:total], parts, passings, poses[count:total])
    margins_without(
        ground, body, poses[count:total], points, passings, a, g, touch, margins[count:total],
        contacts,
    )  # fmt: skip
    total += find_peaks(
        ground, body, path, values, group, narrow, TOLERANCE, 0.0, a, g, touch, largest, s, line,
        ways, kept, order, chosen, places, shares, inside, new, new_margins, contacts,
        rows[total : rows.shape[0]], poses[total : poses.shape[0]],
        margins[total : margins.shape[0]],
    )  # fmt: skip
    upright = 0
    for downward in range(2):
        direction = -0.5 * math.pi if downward == 1 else 0.5 * math.pi
        for row in range(count - 1):
            share = upright_at(path, row, direction)
            if share >= 0.0:
                rows[total + upright] = row
                parts[upright] = share
                upright += 1
    last: int = total + upright
    poses_between(ground, body, path, rows[total:last], parts, upright, poses[total:last])
    pose_margins(
        ground, body, poses[total:last], upright, a, g, touch, margins[total:last], contacts
    )
    for k in range(total, last):
        psi = poses[k, POSE_PSI]
        if turns_steadily(path, rows[k], psi):
            margins[k, TRACTION] = (g if math.sin(psi) > 0.0 else -g) + a
    return last
