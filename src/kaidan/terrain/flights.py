"""Straight flights in a row as one line: faces of risers, treads and the landings between."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from kaidan.terrain.doubt import common_doubts, covariance_of_steps
from kaidan.terrain.polyline import frozen
from kaidan.terrain.stairs import Stairs

Array = NDArray[np.float64]


def behind(flights: Sequence[Stairs], number: int) -> float:
    """Length of the landing behind a flight [m]: its own, else as the next sheet states it."""
    following = flights[number + 1 : number + 2]
    if flights[number].upper_landing is None and following:
        return following[0].landings[0]
    return flights[number].landings[1]


def line_of_flights(flights: Sequence[Stairs]) -> tuple[Array, Array, Array | None]:
    """Points, nosings and the covariance of the nosings, see `kaidan.terrain.profile.Profile`.

    Parameters
    ----------
    flights : sequence of Stairs
        One at least, from bottom to top.

    Returns
    -------
    points, nosings, covariance
        Shapes (n, 2) and (m, 2) [m], the first nosing at x = 0, its lower landing at z = 0;
        shape (2m, 2m) [m^2], None: exact.

    Raises
    ------
    InputError
        Too many nosings with a doubt of their own.

    Examples
    --------
    >>> points, nosings, _ = line_of_flights([Stairs(rise=0.2, going=0.3, steps=2)])
    >>> nosings.tolist()
    [[0.0, 0.2], [0.3, 0.4]]
    """
    x = z = 0.0
    points = [(-max(flights[0].landings[0], 1e-3), 0.0), (0.0, 0.0)]
    nosings: list[tuple[float, float]] = []
    sigma: list[tuple[float, float]] = []
    common: list[Array] = []
    for number, flight in enumerate(flights):
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
    return frozen(np.array(points)), frozen(np.array(nosings)), covariance
