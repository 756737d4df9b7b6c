"""What it takes to turn the robot off its poses: energy, or a tilt of gravity."""

from __future__ import annotations

import math

from kaidan.contact.codes import ROCKING
from kaidan.contact.columns import (
    BACK_RISE,
    BOUNDED,
    ENERGY,
    ENERGY_SIDE,
    FRONT_RISE,
    OUTER_FRONT,
    OUTER_REAR,
    POSE_PHI,
    POSE_X,
    POSE_Z,
    TILT,
    WITHOUT,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.heaps import heap_of, taken
from kaidan.contact.kernel.reserves import barrier, carrying_tilt
from kaidan.contact.tables import (
    BodyTable,
    FloatRow,
    GroundTable,
    IntArray,
    MarginTable,
    PoseTable,
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
    side: float, weights: FloatRow, tie: float, order: IntArray, pivots: FloatRow,
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
        Which poses.
    side
        +1 back, -1 front.
    weights
        Of the rise at each pose of the table [1].
    tie
        Difference of rises that is none [m].
    order, pivots
        Scratch, as long as the rows.

    Returns
    -------
    rise [m], the first row that needs no more (-1: no pose needs a finite one)
    """
    hint = 0
    least = math.inf
    column = BACK_RISE if side > 0.0 else FRONT_RISE
    for k in range(rows.shape[0]):
        order[k] = k
        pivots[k] = weights[rows[k]] * margins[rows[k], column]
    left = rows.shape[0]
    heap_of(order, pivots, left)
    while left > 0 and pivots[order[0]] < least + tie:
        row = rows[taken(order, pivots, left)]
        left -= 1
        if math.isnan(margins[row, ENERGY]):
            hint = work_out_energy(ground, body, poses, margins, row, hint)
        rise = max(margins[row, ENERGY], margins[row, column])
        least = min(least, weights[row] * rise)
    first = -1
    for k in range(left, rows.shape[0]):
        row = rows[order[k]]
        rise = max(margins[row, ENERGY], margins[row, column])
        if weights[row] * rise <= least + tie and least < math.inf:
            first = row if first < 0 else min(first, row)
    return least, first


def pose_tilt(
    ground: GroundTable, body: BodyTable, poses: PoseTable, margins: MarginTable, row: int,
    side: float, tolerance: float, hint: int,
) -> tuple[float, float, int]:  # fmt: skip
    """Tilt of gravity beyond which a pose rotates to one side by more than rocking.

    Returns
    -------
    tilt [rad], rocking [rad], hint
        As :func:`kaidan.contact.kernel.reserves.carrying_tilt`.
    """
    column = OUTER_REAR if side > 0.0 else OUTER_FRONT
    return carrying_tilt(
        ground, body, int(margins[row, column]), poses[row, POSE_X], poses[row, POSE_Z],
        poses[row, POSE_PHI], side, margins[row, TILT], tolerance, int(margins[row, WITHOUT]),
        hint,
    )  # fmt: skip
