"""Which flights of a cloud are one that was seen in parts."""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.flight import FlightEstimate
from kaidan.readers.kinds import Array
from kaidan.readers.stairfit.views import rotated

SAME_NOSING = 0.04
"""Distance of nosings that are one [m]."""
CONTINUES = 0.3
"""Distance from the place of the next nosing up to which another one is that, in steps [1]."""


def beside(one: FlightEstimate, other: FlightEstimate) -> bool:
    """Whether two flights are parts of one, which somebody stood on, side by side."""
    if abs(math.sin((one.heading - other.heading) / 2)) > 0.03:
        return False
    s, _, z = rotated(one.middle, other.heading)
    line_s, _, line_z = rotated(other.middle, other.heading)
    k = np.abs(s[:, None] - line_s).argmin(axis=1)
    return bool(np.median(np.hypot(s - line_s[k], z - line_z[k])) < SAME_NOSING)


def continues(one: FlightEstimate, other: FlightEstimate) -> bool:
    """Whether a flight leads on from another one without a landing, as its far end does.

    It is the same flight, of which too little was seen between; the other one says that its end was
    not seen.
    """
    if abs(math.sin((one.heading - other.heading) / 2)) > 0.03:
        return False
    lower, upper = sorted((one, other), key=lambda each: float(each.middle[0, 2]))
    s, t, z = rotated(np.vstack([lower.middle[-1], upper.middle[0]]), other.heading)
    step = np.array([other.regular.going, other.regular.rise])
    off = np.array([s[1] - s[0], z[1] - z[0]]) - np.arange(1, 4)[:, None] * step
    aside = abs(t[1] - t[0]) > max(one.width, other.width) / 2
    return bool((np.abs(off) < CONTINUES * step).all(axis=1).any()) and not aside


def wider(flight: FlightEstimate, other: FlightEstimate) -> FlightEstimate:
    """Flight with another one beside it, its own nosings drawn out over the width of both."""
    left = np.array([-math.sin(flight.heading), math.cos(flight.heading)])
    sides = np.vstack([flight.left, flight.right, other.left, other.right])[:, :2] @ left
    across = (flight.left - flight.right) / flight.width
    middle = flight.middle[:, :2] @ left
    high, low = float(sides.max()), float(sides.min())
    return replace(
        flight,
        left=flight.middle + across * (high - middle)[:, None],
        right=flight.middle + across * (low - middle)[:, None],
        width=high - low,
    )


def within(flight: FlightEstimate, thin: Array) -> NDArray[np.bool_]:
    """Points that belong to a flight: about its steps and between its sides."""
    s, t, z = rotated(thin, flight.heading)
    places = rotated(flight.middle, flight.heading)
    sides = rotated(np.vstack([flight.left, flight.right]), flight.heading)[1]
    along, up = places[0], places[2]
    slope = (up[-1] - up[0]) / (along[-1] - along[0])
    over = z - up[0] - slope * (s - along[0])
    return np.asarray(
        (s > along[0] - 0.25) & (s < along[-1] + 0.25) & (np.abs(over) < 0.35)
        & (t > sides.min() - 0.1) & (t < sides.max() + 0.1)
    )  # fmt: skip
