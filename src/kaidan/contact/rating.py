"""Many traverses over one terrain rated in one call: their largest figures, no poses."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact.door import table_of, unknown
from kaidan.contact.layout import (
    Belts,
    Course,
    Edge,
    Flight,
    GrouserCase,
    Job,
    Rating,
    Zone,
)
from kaidan.contact.records import Ratings
from kaidan.contact.remembered import body_of, ground_of
from kaidan.contact.scratch import most_poses
from kaidan.contact.switch import kernel
from kaidan.mechanics import STANDARD_GRAVITY

#: Of no interest.
NO_BELTS = Belts((), np.full(1, math.nan), True, 0.0, 0.0, 0.0)


def rate_many(
    terrain: ArrayLike,
    parts: Sequence[ArrayLike],
    kinds: ArrayLike,
    flats: ArrayLike,
    flights: Sequence[ArrayLike],
    jobs: Sequence[Job],
    *,
    step: float,
    zones: ArrayLike,
    edges: ArrayLike,
    rough: float,
    tilts: tuple[float, float] = (0.0, 0.0),
    belts: Belts | None = None,
) -> Ratings:
    """Rate many traverses over one terrain.

    Parameters
    ----------
    terrain
        Points (n, 2) [m].
    parts, kinds, flats
        Underside (m, 6) of each robot [m], what each part is, length of each robot's flat [m].
    flights
        Flights as each robot sees them (k, 3): first and last x [m], mean slope [rad].
    jobs
        Each of a robot, by its number.
    step
        Arclength between poses [m].
    zones
        Landings (k, 4): smallest and largest x, smallest and largest z of the front contact at
        which the robot lands [m].
    edges, rough
        Edges that may hold an end (k, 2), and how far ahead they have to be [m].
    tilts
        Of gravity, towards the trailing and the leading end that comes down [rad].
    belts
        Belts with grousers; without them it is not found how they hold.

    Returns
    -------
    Ratings

    Examples
    --------
    >>> step, robot = [[-4, 0], [0, 0], [0, 0.1], [4, 0.1]], [[-0.3, 0, 0.06, 0.2, 0, 0.06]]
    >>> found = rate_many(step, [robot], [0], [0.5], [[]], [Job(0, 0, -1.0, 1.0)], step=0.02,
    ...                   zones=[], edges=[[0, 0.1]], rough=0.01)
    >>> found.status.tolist(), found.belly_touches.tolist()
    ([0], [False])
    """
    ground, bodies = ground_of(terrain), [body_of(each, kinds) for each in parts]
    longest = max(each.x_end - each.x_start for each in jobs)
    ratings = unknown(Rating, len(jobs))
    of_belts = belts or NO_BELTS
    of_belts = of_belts._replace(grousers=table_of(GrouserCase, of_belts.grousers))
    course = Course(step, table_of(Zone, zones), table_of(Edge, edges), rough, *tilts)
    kernel().rate_many(
        (ground, np.concatenate(bodies)), np.cumsum([len(each) for each in bodies]),
        np.array(flats, dtype=np.float64), np.cumsum([len(each) for each in flights]),
        table_of(Flight, [row for each in flights for row in each]), table_of(Job, jobs),
        most_poses(longest, step, len(ground)), STANDARD_GRAVITY, course, of_belts, ratings,
    )  # fmt: skip
    return Ratings(ratings)
