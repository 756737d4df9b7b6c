"""Grade two: the steepest flight that is climbed, whatever rotates and is arrested."""

from __future__ import annotations

import math
from collections.abc import Callable

from numpy.typing import ArrayLike

from kaidan.contact.codes import Status
from kaidan.contact.traversing import traverse


def steepest_flight(
    flight: Callable[[float], tuple[ArrayLike, float, float]],
    parts: ArrayLike,
    *,
    largest_extra: float = math.radians(45.0),
    low: float = 0.0,
    high: float = math.radians(85.0),
    tolerance: float = 1e-5,
    step: float = 1e-3,
) -> float:
    """Grade two: steepest flight that is climbed with a bounded extra inclination [rad].

    Parameters
    ----------
    flight
        Angle [rad] to (terrain, x_start, x_end).
    parts
        Robot.
    largest_extra
        Bound on inclination minus angle of the flight [rad].
    low, high
        Angles known to hold and not to hold; bisected, which finds one limit if there are several.

    Returns
    -------
    float
        NaN if even ``low`` is not climbed.
    """

    def holds(angle: float) -> bool:
        terrain, x_start, x_end = flight(angle)
        run = traverse(
            terrain, parts, x_start, x_end,
            step=step, with_margins=False,
        )  # fmt: skip
        return run.status is Status.OK and run.largest_inclination() - angle <= largest_extra

    if not holds(low):
        return math.nan
    while high - low > tolerance:
        mid = 0.5 * (low + high)
        if holds(mid):
            low = mid
        else:
            high = mid
    return low
