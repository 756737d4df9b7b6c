"""What it takes to turn the robot off its poses: energy, or a tilt of gravity."""

from __future__ import annotations

import math

from kaidan.contact.codes import ROCKING
from kaidan.contact.columns import (
    BACK_RISE,
    BOUNDED,
    CARRIED_TO,
    ENERGY,
    ENERGY_SIDE,
    FRONT_RISE,
    OUTER_FRONT,
    OUTER_REAR,
    POSE_PHI,
    POSE_S,
    POSE_X,
    POSE_Z,
    ROCKS_BY,
    TILT,
    WITHOUT,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.margins import pose_margins
from kaidan.contact.kernel.renaming import poses_between
from kaidan.contact.kernel.reserves import barrier, carrying_tilt
from kaidan.contact.tables import (
    BodyTable,
    ContactTable,
    FloatRow,
    GroundTable,
    IntArray,
    MarginTable,
    PoseTable,
    TiltTable,
)


@entry
def flow_energy(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, rows: IntArray
) -> None:
    """Work out the energy margin along the flow, its side and whether it is bounded, at some poses.

    Parameters
    ----------
    ground, body, poses
        As for :func:`kaidan.contact.kernel.margins.pose_margins`.
    margins
        Table that it has filled.
    rows
        Which poses.
    """
    hint = 0
    for k in range(rows.shape[0]):
        hint = work_out_energy(ground, body, poses, margins, rows[k], hint)


def work_out_energy(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, row: int,
    hint: int,
) -> int:  # fmt: skip
    """Work out the energy margin along the flow at one pose; hint for the next call."""
    x = poses[row, POSE_X]
    z = poses[row, POSE_Z]
    phi = poses[row, POSE_PHI]
    kappa = margins[row, TILT]
    rise_back = abs(margins[row, BACK_RISE])
    rise_front = abs(margins[row, FRONT_RISE])
    rear = int(margins[row, OUTER_REAR])
    ahead = int(margins[row, OUTER_FRONT])
    # the side with the smaller bound first, the other only if it can be less
    side = 1.0
    pivot = rear
    bound = rise_front
    if rise_front < rise_back:
        side = -1.0
        pivot = ahead
        bound = rise_back
    bounded, rise, _, hint = barrier(ground, body, pivot, x, z, phi, side, kappa, ROCKING, hint)
    if rise > bound:
        pivot = ahead if side > 0.0 else rear
        other_bounded, other_rise, _, hint = barrier(
            ground, body, pivot, x, z, phi, -side, kappa, ROCKING, hint
        )
        if other_rise < rise:
            rise = other_rise
            bounded = other_bounded
            side = -side
    margins[row, ENERGY] = rise
    margins[row, ENERGY_SIDE] = side
    margins[row, BOUNDED] = 1.0 if bounded else 0.0
    return hint


@entry
def least_flow_energy(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, rows: IntArray,
    side: float, weights: FloatRow, tie: float,
) -> tuple[float, int]:  # fmt: skip
    """Smallest weighted rise of the centroid that a fall to one side needs, of some poses.

    A fall to either side needs the smaller barrier of both along the flow, and a fall to this side
    the rise about its pivot, whichever is more. So only poses whose pivot's rise is below the least
    found are worked out.

    Parameters
    ----------
    ground, body, poses, margins
        As for :func:`flow_energy`.
    rows
        Which poses, that with the smallest weighted rise about its pivot first.
    side
        +1 back, -1 front.
    weights
        Of the rise of each [1].
    tie
        Difference of rises that is none [m].

    Returns
    -------
    rise [m], the first row that needs no more (-1: no pose needs a finite one)
    """
    hint = 0
    least = math.inf
    column = BACK_RISE if side > 0.0 else FRONT_RISE
    known = 0
    while known < rows.shape[0] and weights[known] * margins[rows[known], column] < least + tie:
        row = rows[known]
        if math.isnan(margins[row, ENERGY]):
            hint = work_out_energy(ground, body, poses, margins, row, hint)
        rise = max(margins[row, ENERGY], margins[row, column])
        least = min(least, weights[known] * rise)
        known += 1
    first = -1
    for k in range(known):
        row = rows[k]
        rise = max(margins[row, ENERGY], margins[row, column])
        if weights[k] * rise <= least + tie and least < math.inf:
            first = row if first < 0 else min(first, row)
    return least, first


@entry
def flow_tilts(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, rows: IntArray,
    side: float, tolerance: FloatRow, found: TiltTable,
) -> None:  # fmt: skip
    """Work out beyond which tilt of gravity some poses rotate by more than rocking, to one side.

    Parameters
    ----------
    ground, body, poses
        As for :func:`kaidan.contact.kernel.margins.pose_margins`.
    margins
        Table that it has filled.
    rows
        Which poses.
    side
        +1 back, -1 front.
    tolerance
        Rotation of each that is rocking [rad].
    found
        A row for each pose, to be filled: tilt and rocking [rad].
    """
    hint = 0
    column = OUTER_REAR if side > 0.0 else OUTER_FRONT
    for k in range(rows.shape[0]):
        row = rows[k]
        found[k, CARRIED_TO], found[k, ROCKS_BY], hint = carrying_tilt(
            ground, body, int(margins[row, column]), poses[row, POSE_X], poses[row, POSE_Z],
            poses[row, POSE_PHI], side, margins[row, TILT], tolerance[k],
            int(margins[row, WITHOUT]), hint,
        )  # fmt: skip


@entry
def find_tilt_jumps(
    ground: GroundTable, body: BodyTable, poses: PoseTable, rows: IntArray, side: float,
    whence: FloatRow, of_tilt: IntArray, half: FloatRow, falls: IntArray, within: float, a: float,
    g: float, touch: float, share: FloatRow, between: PoseTable, margins: MarginTable,
    found: ContactTable, low: FloatRow, high: FloatRow,
) -> None:  # fmt: skip
    """Halve out where rocking, or the tilt after it, jumps on the way from some poses to the next.

    Parameters
    ----------
    ground, body, poses, a, g, touch
        As for :func:`kaidan.contact.kernel.margins.pose_margins`.
    rows
        The first of each two poses.
    side
        +1 back, -1 front.
    whence
        Inclination from which each came down by rocking [rad]; minus infinity: from none.
    of_tilt, half, falls
        1 where the tilt jumps, 0 where the rocking does; figure between its values before and after
        [rad]; 1 where it is more before.
    within
        To which the places are found [m].
    share, between, margins, found
        Scratch: one share, pose, row of margins; the contacts of a pose.
    low, high
        To be filled: shares of the arclength to the next pose, just before and just after.
    """
    longest = 0.0
    for k in range(rows.shape[0]):
        longest = max(longest, poses[rows[k] + 1, POSE_S] - poses[rows[k], POSE_S])
    hint = 0
    column = OUTER_REAR if side > 0.0 else OUTER_FRONT
    for k in range(rows.shape[0]):
        low[k] = 0.0
        high[k] = 1.0
        while longest * (high[k] - low[k]) > within:
            share[0] = 0.5 * (low[k] + high[k])
            poses_between(ground, body, poses, rows[k : k + 1], share, between)
            pose_margins(ground, body, between, 1, a, g, touch, margins, found)
            reach = max(whence[k] - between[0, POSE_PHI], 0.0) + ROCKING
            tilt, rocks_by, hint = carrying_tilt(
                ground, body, int(margins[0, column]), between[0, POSE_X], between[0, POSE_Z],
                between[0, POSE_PHI], side, margins[0, TILT], reach, int(margins[0, WITHOUT]),
                hint,
            )  # fmt: skip
            figure = tilt if of_tilt[k] == 1 else rocks_by
            if (figure > half[k]) == (falls[k] == 1):
                low[k] = share[0]
            else:
                high[k] = share[0]
