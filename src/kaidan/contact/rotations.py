"""Rotations of a path: where the body is within one, and how fast an end comes down."""

import math

import numpy as np

from kaidan.contact.path import Path
from kaidan.contact.records import Placement, RotationRecord
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray


def impact_speeds(path: Path) -> FloatArray:
    """Speed at which an end comes down at the end of each rotation [m/s]; NaN: not arrested.

    The rate just before the last impact, from the energy of the fall as a free rotation about
    the pivot, times how far the contacts lie apart.
    """
    table = path.rotations.table
    speeds = np.full(len(table), math.nan)
    for row in np.flatnonzero(path.rotations.arrested).tolist():
        speeds[row] = kernel().impact_speed(path.scene, table, row)
    return speeds


def rotated(path: Path, rotation: RotationRecord, angle: float) -> Placement:
    """Where the body is after a part of a rotation about its first pivot [rad]."""
    x, z, phi = rotation.start
    turn = rotation.sense * angle
    x, z = kernel().turned(path.scene, rotation.pivot, x, z, phi, turn)
    return Placement(x, z, phi + turn)
