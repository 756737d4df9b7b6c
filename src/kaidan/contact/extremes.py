"""Extreme figures of each phase of a path, worked out where its poses are."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from kaidan.contact.door import given, table_of, zeros
from kaidan.contact.layout import Extreme, Flight, Known, Leading, Pull, Zone
from kaidan.contact.path import Path
from kaidan.contact.records import BoolArray
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray
from kaidan.mechanics import STANDARD_GRAVITY

#: Phases of a path: it enters, traverses, lands.
PHASES = 3


class Sampled(NamedTuple):
    """Poses of a path and behind them some between two of it, and what is known of each."""

    path: Path
    """With margins."""
    phase: IntArray
    """Number of the phase of each pose of the path: 0 enters, 1 traverses, 2 lands."""
    corner: BoolArray
    """Where a contact runs over a corner: the pose between two phases is of both."""
    row: IntArray
    """Pose of the path that each counts as."""
    lasts: BoolArray
    """Whether the robot stands so for a while."""
    friction: FloatArray
    """Required [1]."""
    traction: FloatArray
    """Tractive force over mass, without its sign [N/kg]."""
    comes_off: BoolArray
    """Whether the trailing end leaves an edge."""


class Manner(NamedTuple):
    """How a path leads over which terrain."""

    descending: bool
    whole: bool
    """Whether one flat carries all along on a flight."""
    counts: tuple[int, int, int]
    """Which poses of each phase count: ``NO_POSE``, ``BESIDE_NOSINGS`` or ``EVERY_POSE``."""
    tops: Sequence[tuple[float, float, float, float]]
    """Where the uppermost contact stands on a flight's last nosing or beyond: smallest and largest
    x, smallest and largest z [m]."""
    flights: Sequence[tuple[float, float]]
    """First and last place of the contacts on each flight [m]."""
    nosings: FloatArray
    """Places of the nosings in their order [m]."""
    height: float
    """Centroid above the flat [m]."""
    gyration: float
    """Least radius of gyration about the centroid [m]."""
    acceleration: float = 0.0
    """Along the path [m/s^2]."""


def extremes_of(
    samples: Sampled, whence: FloatArray, back: BoolArray, manner: Manner
) -> list[Extreme | None]:
    """Extreme figures of each phase of a path; None where it has no pose.

    Parameters
    ----------
    samples
        Poses at which they may lie.
    whence
        Inclination from which each pose of the path came down by rocking [rad]; minus infinity:
        from none.
    back
        Which came down otherwise, so that they only come back.
    manner
    """
    path = samples.path
    assert path.margins is not None
    known = given(
        Known, samples.phase, samples.corner, samples.row, samples.lasts, samples.friction,
        samples.traction, samples.comes_off, whence, back,
    )  # fmt: skip
    leading = given(
        Leading, manner.descending, manner.whole, np.array(manner.counts),
        table_of(Zone, manner.tops),
        table_of(Flight, [(*each, math.nan) for each in manner.flights]), manner.nosings,
        manner.height, manner.gyration,
    )  # fmt: skip
    table = zeros(Extreme, PHASES)
    kernel().find_extremes(
        path.scene, path.poses.table, path.margins.table, known, leading,
        Pull(manner.acceleration, STANDARD_GRAVITY), table,
    )  # fmt: skip
    return [Extreme(*row) if row[0] > 0 else None for row in table.tolist()]
