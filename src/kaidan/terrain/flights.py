"""Straight flights in a row as one line: faces of risers, treads, landings between, and gaps."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.terrain.doubt import common_doubts, covariance_of_steps
from kaidan.terrain.gap import Gap, carved
from kaidan.terrain.polyline import ROUGHNESS, frozen
from kaidan.terrain.stairs import Stairs

Array = NDArray[np.float64]

_SAME = 1e-6
"""Length that is rounding [m]."""


def behind(flights: Sequence[Stairs], number: int) -> float:
    """Length of the landing behind a flight [m]: its own, else as the next sheet states it."""
    following = flights[number + 1 : number + 2]
    if flights[number].upper_landing is None and following:
        return following[0].landings[0]
    return flights[number].landings[1]


class FlightsLine(NamedTuple):
    """Flights in a row as a line; see `kaidan.terrain.profile.Profile`."""

    points: Array
    """Shape (n, 2), the first nosing at x = 0, its lower landing at z = 0 [m]."""
    nosings: Array
    """Shape (m, 2), the far edge of a gap among them where it is higher than the near one [m]."""
    edges: Array
    """Nosings and edges of gaps, shape (k, 2) [m]."""
    covariance: Array | None
    """Of the nosings, shape (2m, 2m) [m^2]; None: exact."""


def line_of_flights(flights: Sequence[Stairs]) -> FlightsLine:
    """Line of flights with their landings and gaps.

    flights: one at least, from bottom to top.

    Examples
    --------
    >>> line_of_flights([Stairs(rise=0.2, going=0.3, steps=2)]).nosings.tolist()
    [[0.0, 0.2], [0.3, 0.4]]
    """
    x = z = 0.0
    points = [(-max(flights[0].landings[0], 1e-3), 0.0), (0.0, 0.0)]
    nosings: list[tuple[float, float]] = []
    sigma: list[tuple[float, float]] = []
    common: list[Array] = []
    gaps: list[Gap] = []
    for number, flight in enumerate(flights):
        gaps += [_shifted(each, x) for each in flight.gaps if each.length is not None]
        treads = (*flight.step_goings, max(behind(flights, number), 1e-3))
        sigma += [(0.0, max(flight.uncertainty.rise, flight.uncertainty.first_rise))]
        sigma += [(flight.uncertainty.going, flight.uncertainty.rise)] * (len(treads) - 2)
        last = max(flight.uncertainty.rise, flight.uncertainty.last_rise)
        sigma += [(flight.uncertainty.going, last)]
        if len(flights) > 1:  # the common doubt of one flight alone goes with its angle
            common += common_doubts(flight, len(nosings))
        for rise, tread in zip(flight.step_rises, treads, strict=True):
            z += rise
            nosings.append((x, z))
            points.append((x, z))
            x += tread
            points.append((x, z))
    covariance = covariance_of_steps(np.array(sigma), common)
    found = FlightsLine(np.array(points), np.array(nosings), np.array(nosings), covariance)
    found = _with_gaps(found, gaps) if gaps else found
    points_, nosings_, edges, covariance = found
    return FlightsLine(frozen(points_), frozen(nosings_), frozen(edges), covariance)


def _shifted(gap: Gap, x: float) -> Gap:
    assert gap.start is not None
    assert gap.end is not None
    return gap.model_copy(update={"start": gap.start + x, "end": gap.end + x})


def _with_gaps(line: FlightsLine, gaps: Sequence[Gap]) -> FlightsLine:
    """Line with its gaps, whose edges count.

    The far edge is a nosing where it is higher than the near one; it errs with the nosing that the
    gap takes, else with the one before. Across a level gap the robot goes on as it went.
    """
    points, edges = carved(line.points, gaps)
    near, far = edges[0::2], edges[1::2]
    x = line.nosings[:, 0]
    taken = ((x >= near[:, :1] - _SAME) & (x < far[:, :1] - _SAME)).any(axis=0)
    rises = far[:, 1] - near[:, 1] > ROUGHNESS
    own = np.array([np.abs(x - at).min() < _SAME for at in far[:, 0]], dtype=bool)
    more = far[rises & ~own]
    of = np.r_[np.flatnonzero(~taken), np.maximum(np.searchsorted(x, more[:, 0]) - 1, 0)]
    nosings = np.vstack([line.nosings[~taken], more])
    order = np.argsort(nosings[:, 0], kind="stable")
    nosings, of = nosings[order], of[order]
    edges = np.vstack([nosings, near, far[~rises]])
    covariance = line.covariance
    if covariance is not None:
        rows = np.column_stack([2 * of, 2 * of + 1]).ravel()
        covariance = frozen(covariance[np.ix_(rows, rows)])
    order = np.argsort(edges[:, 0], kind="stable")
    return FlightsLine(points, nosings, edges[order], covariance)
