r"""Poses between two at which a figure may be the largest: the ways that promise most are cut.

::

             x          A way that promises more than is found is cut into pieces with poses between
           .' '.        them, and these again, until none promises more. Figures have kinks, for
         o       o      example where a belt begins to give way at a nosing: lines bound them as
       .'         '.    well as an arch, a parabola would not.
      o             o
"""

from __future__ import annotations

import math

from kaidan.contact.codes import CUT_AT_ONCE, PIECES, ROUNDS
from kaidan.contact.columns import FRICTION, MARGIN_COLUMNS, POSE_COLUMNS, POSE_LEG, POSE_S
from kaidan.contact.kernel.energy_margins import pose_tilt
from kaidan.contact.kernel.margins import ONE_PLACE, pose_margins
from kaidan.contact.kernel.peaks import chosen_ways, cut_ways, open_ways, places_on_ways
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


def figure_of(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, row: int,
    side: float, hint: int,
) -> tuple[float, int]:  # fmt: skip
    """Figure of a pose of which peaks are looked for; hint for the next call.

    ``side`` 0: the friction that it requires [1], infinite where nothing holds. +1 back, -1 front:
    the tilt of gravity at which it rotates to that side, with its sign turned [rad].
    """
    if side == 0.0:
        friction = margins[row, FRICTION]
        return (friction if -math.inf < friction < math.inf else math.inf), hint
    tilt, _, hint = pose_tilt(ground, body, poses, margins, row, side, 0.0, hint)
    return -tilt, hint


def leads_on(poses: PoseTable, row: int) -> bool:
    """Whether the path leads on from a pose to the next along one line of poses."""
    return bool(
        poses[row + 1, POSE_LEG] == poses[row, POSE_LEG]
        and poses[row + 1, POSE_S] - poses[row, POSE_S] > ONE_PLACE
    )


def find_peaks(
    ground: GroundTable,
    body: BodyTable,
    poses: PoseTable,
    values: FloatRow,
    group: IntArray,
    narrow: IntArray,
    tolerance: float,
    side: float,
    a: float,
    g: float,
    touch: float,
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
    between: PoseTable,
    margins: MarginTable,
) -> int:
    """Find poses between two of a path at which a figure may be the largest of a group of poses.

    Parameters
    ----------
    ground, body, a, g, touch
        As for :func:`kaidan.contact.kernel.margins.pose_margins`.
    poses
        The path.
    values, group, narrow, tolerance
        As for :func:`kaidan.contact.kernel.peaks.open_ways`.
    side
        Which figure, see `figure_of`.
    largest, s, line, ways, kept, order, chosen, places, shares, inside, new, new_margins, contacts
        Scratch: figure of each group; place, and whether the path leads on, of each pose; ways and
        those kept of them, with their order and which are cut; places on them with their figures
        and poses.
    rows, between, margins
        To be filled: row before each pose, the pose, its margins.

    Returns
    -------
    number of poses
    """
    for row in range(poses.shape[0]):
        s[row] = poses[row, POSE_S]
        line[row] = 1 if row + 1 < poses.shape[0] and leads_on(poses, row) else 0
    count = open_ways(s, line, values, group, narrow, largest, tolerance, ways)
    total = 0
    hint = 0
    for _ in range(ROUNDS):
        many, cut = chosen_ways(ways, count, largest, tolerance, CUT_AT_ONCE, order, kept, chosen)
        if cut == 0:
            break
        places_on_ways(s, kept, chosen, cut, places, shares)
        fresh = (PIECES - 1) * cut
        poses_between(ground, body, poses, places, shares, fresh, new)
        pose_margins(ground, body, new, fresh, a, g, touch, new_margins, contacts)
        for k in range(fresh):
            inside[k], hint = figure_of(ground, body, new, new_margins, k, side, hint)
            rows[total] = places[k]
            for column in range(POSE_COLUMNS):
                between[total, column] = new[k, column]
            for column in range(MARGIN_COLUMNS):
                margins[total, column] = new_margins[k, column]
            total += 1
        count = cut_ways(kept, many, chosen, cut, inside, largest, ways)
    return total
