"""Many traverses over one terrain rated in one call: their largest figures, no poses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact import columns as at
from kaidan.contact.margin_records import Job
from kaidan.contact.path import TOUCH
from kaidan.contact.records import BoolArray, _Table
from kaidan.contact.remembered import body_of, ground_of
from kaidan.contact.scratch import holding_scratch, most_poses, path_scratch
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, IntArray, margin_tables
from kaidan.mechanics import STANDARD_GRAVITY


class Ratings(_Table):
    """One row a job; but for the status NaN where the robot does not arrive."""

    @property
    def status(self) -> IntArray:
        """`Status` of each."""
        return self._whole(at.RATED_STATUS)

    @property
    def required_friction(self) -> FloatArray:
        """Largest required friction, but where the trailing end leaves an edge as it lands [1]."""
        return self._column(at.RATED_FRICTION)

    @property
    def belly_touches(self) -> BoolArray:
        """Whether the belly touches the ground somewhere."""
        return self.table[:, at.RATED_BELLY] > 0.0

    @property
    def largest_rotation(self) -> FloatArray:
        """Largest angle of rotations that follow one another at once [rad]."""
        return self._column(at.RATED_ANGLE)

    @property
    def rocking(self) -> FloatArray:
        """Largest part of such an angle that counts as rocking [rad]."""
        return self._column(at.RATED_ROCKING)

    @property
    def impact_speed(self) -> FloatArray:
        """Largest speed at which an end comes down [m/s]."""
        return self._column(at.RATED_IMPACT)

    @property
    def spare(self) -> FloatArray:
        """Least rise still to climb before rotations topple, less all drops so far [m].

        Under gravity that is tilted as stated.
        """
        return self._column(at.RATED_SPARE)

    @property
    def held(self) -> FloatArray:
        """Least margin of the belts with grousers in the worst case [rad].

        Infinite without grousers, or where more nosings than there is room for touch a flat.
        """
        return self._column(at.RATED_HELD)

    @property
    def held_at_best(self) -> FloatArray:
        """The same in the best case [rad]."""
        return self._column(at.RATED_HELD_BEST)


class Belts(NamedTuple):
    """Belts with grousers, and on what they stand."""

    grousers: tuple[tuple[float, ...], ...]
    """Cases, see `kaidan.contact.columns`: all of the worst have to hold, and of the best."""
    treads: FloatArray
    """Tilt of the normal of the tread uphill of each point of the ground [rad]; NaN: none."""
    climbs: bool
    """Whether the way leads up the stairs."""
    steep: float
    """Slope beyond which the ground is a face [rad]."""
    touch: float
    """Gap up to which a nosing lies on a flat [m]."""
    slip: float
    """How far beyond the spacing of grousers a slip is followed [m]."""


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
    size = most_poses(longest, step, len(ground))
    on = [np.array(each, dtype=np.float64).reshape(-1, at.FLIGHT_COLUMNS) for each in flights]
    ratings = np.full((len(jobs), at.RATING_COLUMNS), math.nan)
    of_belts = NO_BELTS if belts is None else belts
    cases = np.array(of_belts.grousers, dtype=np.float64).reshape(-1, at.GROUSER_COLUMNS)
    kernel().rate_many(
        ground, np.concatenate(bodies), np.cumsum([len(each) for each in bodies]),
        np.array(flats, dtype=np.float64),
        np.cumsum([len(each) for each in on]), np.concatenate(on),
        np.array(jobs, dtype=np.float64).reshape(-1, at.JOB_COLUMNS),
        step, STANDARD_GRAVITY, TOUCH, rough, *tilts,
        np.array(zones, dtype=np.float64).reshape(-1, at.ZONE_COLUMNS),
        np.array(edges, dtype=np.float64).reshape(-1, at.POINT_COLUMNS),
        *of_belts[1:], cases,
        *path_scratch(size), *margin_tables(size), *holding_scratch(size if belts else 1), ratings,
    )  # fmt: skip
    return Ratings(ratings)
