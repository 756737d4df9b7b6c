"""Many traverses over one terrain rated in one call: their largest figures, no poses."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact.door import given, stacked, table_of, unknown
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
from kaidan.contact.tables import FloatArray
from kaidan.mechanics import STANDARD_GRAVITY

#: Some rows, each as the fields of one record.
Rows = Sequence[Sequence[float]] | FloatArray


def belts_on(
    cases: Iterable[Sequence[float]],
    treads: FloatArray,
    *,
    climbs: bool,
    steep: float,
    touch: float,
    slip: float,
) -> Belts:
    """Belts with grousers, and on what they stand.

    Parameters
    ----------
    cases
        Of grousers, nosings and friction, all of which have to hold: fields as of
        `kaidan.contact.layout.GrouserCase`.
    treads
        Tilt of the normal of the tread uphill of each point of the ground (n,) [rad]; NaN: none.
    climbs
        Whether the way leads up the stairs.
    steep
        Slope beyond which the ground is a face [rad].
    touch
        Gap up to which a nosing lies on a flat [m].
    slip
        How far beyond the spacing of grousers a slip is followed [m].
    """
    return given(Belts, table_of(GrouserCase, cases), treads, climbs, steep, touch, slip)


#: Of no interest.
NO_BELTS = belts_on([], np.full(1, math.nan), climbs=True, steep=0.0, touch=0.0, slip=0.0)


def rate_many(
    terrain: ArrayLike,
    parts: Sequence[ArrayLike],
    kinds: ArrayLike,
    flats: ArrayLike,
    flights: Sequence[Rows],
    jobs: Sequence[Job],
    *,
    step: float,
    zones: Rows,
    edges: Rows,
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
        Of `belts_on`; without them it is not found how they hold.

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
    course = given(Course, step, table_of(Zone, zones), table_of(Edge, edges), rough, *tilts)
    kernel().rate_many(
        (ground, stacked(bodies)), np.cumsum([len(each) for each in bodies]),
        np.array(flats, dtype=np.float64), np.cumsum([len(each) for each in flights]),
        table_of(Flight, [row for each in flights for row in each]), table_of(Job, jobs),
        most_poses(longest, step, len(ground)), STANDARD_GRAVITY, course,
        NO_BELTS if belts is None else belts, ratings,
    )  # fmt: skip
    return Ratings(ratings)
