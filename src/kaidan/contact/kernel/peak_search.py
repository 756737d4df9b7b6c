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
from kaidan.contact.kernel.energy_margins import pose_tilt
from kaidan.contact.kernel.margins import ONE_PLACE, pose_margins
from kaidan.contact.kernel.peaks import chosen_ways, cut_ways, open_ways, places_on_ways
from kaidan.contact.kernel.renaming import poses_between
from kaidan.contact.layout import Figures, Margin, Pose, Pull, Samples, Scene, Way
from kaidan.contact.memory import Table, empty


def figure_of(scene: Scene, pose: Pose, margin: Margin, side: float) -> float:
    """Figure of a pose of which peaks are looked for.

    ``side`` 0: the friction that it requires [1], infinite where nothing holds. +1 back, -1 front:
    the tilt of gravity at which it rotates to that side, with its sign turned [rad].
    """
    if side == 0.0:
        friction = margin.required_friction
        return friction if abs(friction) < math.inf else math.inf
    tilt, _ = pose_tilt(scene, pose, margin, side, 0.0)
    return -tilt


def leads_on(poses: Table[Pose], row: int) -> bool:
    """Whether the path leads on from a pose to the next along one line of poses."""
    if row + 1 >= len(poses):
        return False
    then = poses[row + 1]
    return then.leg == poses[row].leg and then.s - poses[row].s > ONE_PLACE


def most_peaks(groups: int) -> int:
    """Poses that are found at most."""
    return ROUNDS * (PIECES - 1) * CUT_AT_ONCE * groups


def find_peaks(
    scene: Scene, poses: Table[Pose], figures: Figures, groups: int, tolerance: float, side: float,
    pull: Pull, found: Samples,
) -> int:  # fmt: skip
    """Find poses between two of a path at which a figure may be the largest of a group of poses.

    figures, tolerance: as for :func:`kaidan.contact.kernel.peaks.open_ways`; places and lines are
        to be filled.
    side: which figure, see `figure_of`.
    found: to be filled: row before each pose, the pose, its margins.
    """
    for row in range(len(poses)):
        figures.s[row] = poses[row].s
        figures.line[row] = leads_on(poses, row)
    at_once = CUT_AT_ONCE * groups
    most = most_peaks(groups) + len(poses)
    places = (PIECES - 1) * at_once
    largest = empty(float, groups)
    ways = empty(Way, most)
    kept = empty(Way, most)
    chosen = empty(int, at_once)
    rows = empty(int, places)
    shares = empty(float, places)
    inside = empty(float, places)
    count = open_ways(figures, tolerance, largest, ways)
    total = 0
    for _ in range(ROUNDS):
        many, cut = chosen_ways(ways[0:count], largest, tolerance, CUT_AT_ONCE, kept, chosen)
        if cut == 0:
            break
        fresh = (PIECES - 1) * cut
        new = found.poses[total : total + fresh]
        margins = found.margins[total : total + fresh]
        places_on_ways(figures.s, kept, chosen[0:cut], rows, shares)
        poses_between(scene, poses, rows[0:fresh], shares, new)
        pose_margins(scene, new, pull, margins)
        for k in range(fresh):
            inside[k] = figure_of(scene, new[k], margins[k], side)
            found.rows[total + k] = rows[k]
        total += fresh
        count = cut_ways(kept[0:many], chosen[0:cut], inside, largest, ways)
    return total
