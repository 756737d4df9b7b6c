"""Extreme figures of each phase of a path, worked out where its poses are."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from kaidan.contact import columns as at
from kaidan.contact.path import TOUCH, Path
from kaidan.contact.records import BoolArray
from kaidan.contact.scratch import peak_scratch
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray
from kaidan.mechanics import STANDARD_GRAVITY

#: Phases of a path: it enters, traverses, lands.
PHASES = 3


class Extreme(NamedTuple):
    """Extreme figures of a phase; each place is that of the front contact there [m]."""

    poses: float
    """How many."""
    friction: float
    """Largest that is required [1]."""
    friction_place: float
    slides_below: float
    """Friction below which the trailing end slides down as the robot lands [1]; NaN: it leaves no
    edge."""
    static_margin: float
    """Smallest towards the downhill end [m]."""
    traction: float
    """Largest tractive force over mass [N/kg]."""
    belly: float
    """1: it carries somewhere."""
    energy: float
    """Least rise that a fall downhill needs [m]; infinite: no pose counts."""
    energy_place: float
    steadiness: float
    """The same about the flat, by the sudden stop that brings it about [m]."""
    steadiness_place: float
    uphill: float
    """The same uphill, traversing [m]."""
    uphill_place: float
    tilt_downhill: float
    """Least tilt of gravity at which it rotates by more than rocking [rad]."""
    tilt_downhill_place: float
    tilt_uphill: float
    """The same uphill, traversing [rad]."""
    tilt_uphill_place: float


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
    """Which poses of each phase count for its energy: `NO_POSE`, `BESIDE_NOSINGS`, `EVERY_POSE`."""
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
    path, size = samples.path, len(samples.row)
    assert path.margins is not None
    scratch = peak_scratch(size, 1)
    most = size + len(scratch.rows)
    weights, came, pivots, values = np.empty((4, size))
    rows, posed, some, heap, group, narrow = np.empty((6, size), dtype=np.int64)
    marks, pose, beside = np.empty((3, most), dtype=np.int64)
    reach, alone, tilt = np.empty((3, most))
    table = np.empty((PHASES, at.EXTREME_COLUMNS))
    flights = [(*each, math.nan) for each in manner.flights]
    lasts, leaves = samples.lasts.astype(np.int64), samples.comes_off.astype(np.int64)
    kernel().find_extremes(
        path.ground.table, path.body.table, path.poses.table, path.margins.table, samples.phase,
        samples.corner.astype(np.int64), samples.row, lasts, samples.friction, samples.traction,
        leaves, whence, back.astype(np.int64), np.array(manner.counts), manner.descending,
        manner.whole, np.array(manner.tops).reshape(-1, at.ZONE_COLUMNS),
        np.array(flights).reshape(-1, at.FLIGHT_COLUMNS), manner.nosings, manner.height,
        manner.gyration, manner.acceleration, STANDARD_GRAVITY, TOUCH, weights, came, rows, posed,
        some, heap, pivots, values, group, narrow, marks, pose, reach, alone, tilt, beside,
        *scratch, table,
    )  # fmt: skip
    return [Extreme._make(row) if row[0] > 0 else None for row in table.tolist()]
