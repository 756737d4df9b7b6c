"""What it takes to turn the robot off its poses: energy, or a tilt of gravity."""

from __future__ import annotations

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
    POSE_X,
    POSE_Z,
    ROCKS_BY,
    TILT,
    WITHOUT,
)
from kaidan.contact.entries import entry
from kaidan.contact.kernel.reserves import barrier, carrying_tilt
from kaidan.contact.tables import (
    BodyTable,
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
        row = rows[k]
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
        bounded, rise, hint = barrier(ground, body, pivot, x, z, phi, side, kappa, ROCKING, hint)
        if rise > bound:
            pivot = ahead if side > 0.0 else rear
            other_bounded, other_rise, hint = barrier(
                ground, body, pivot, x, z, phi, -side, kappa, ROCKING, hint
            )
            if other_rise < rise:
                rise = other_rise
                bounded = other_bounded
                side = -side
        margins[row, ENERGY] = rise
        margins[row, ENERGY_SIDE] = side
        margins[row, BOUNDED] = 1.0 if bounded else 0.0


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
