"""Flights of one cloud as staircases: which leads on from which, over which landing."""

import math
from itertools import pairwise

import numpy as np

from kaidan.readers.estimate import LandingEstimate, StairsEstimate
from kaidan.readers.flight import FlightEstimate
from kaidan.readers.kinds import Array, Provenance

SAME_LEVEL = 0.08
"""Difference of levels at which two flights meet on one landing [m]."""
LONGEST_LANDING = 3.5
"""Farthest that the foot of a flight is from the head of the one below [m]."""


def staircases(
    flights: tuple[FlightEstimate, ...], provenance: Provenance, frame: Array | None = None
) -> tuple[StairsEstimate, ...]:
    """Staircases from bottom to top, those with most nosings first.

    `frame` is the rotation from the file's frame to that of the flights, where it is another one
    than that which lifts the up axis.
    """
    rest = sorted(flights, key=lambda flight: float(flight.middle[0, 2]))
    found: list[StairsEstimate] = []
    while rest:
        chain = [rest.pop(0)]
        while True:
            following = [each for each in rest if _follows(chain[-1], each)]
            if not following:
                break
            chain.append(following[0])
            rest.remove(following[0])
        found.append(_staircase(chain, provenance, len(found), frame))
    found.sort(key=lambda stairs: -sum(map(len, stairs.flights)))
    return tuple(found)


def _follows(below: FlightEstimate, above: FlightEstimate) -> bool:
    head, foot = below.middle[-1], above.middle[0]
    regular = above.regular.rise
    levels = abs(above.base - head[2]) if above.begins else abs(foot[2] - regular - head[2])
    return levels < SAME_LEVEL and float(np.hypot(*(foot - head)[:2])) < LONGEST_LANDING


def _staircase(
    chain: list[FlightEstimate], provenance: Provenance, number: int, frame: Array | None
) -> StairsEstimate:
    landings = [LandingEstimate(chain[0].room_before, chain[0].width, chain[0].base)]
    for below, above in pairwise(chain):
        turn = above.heading - below.heading
        turn = math.atan2(math.sin(turn), math.cos(turn))
        landings.append(_landing(below, above, turn))
    last = chain[-1]
    landings.append(LandingEstimate(last.room_behind, last.width, float(last.middle[-1, 2])))
    name = "stairs" if not number else f"stairs-{number + 1}"
    return StairsEstimate(tuple(chain), tuple(landings), provenance, name, frame=frame)


def _landing(below: FlightEstimate, above: FlightEstimate, turn: float) -> LandingEstimate:
    """Landing between two flights: as deep as to what stands across it, as wide as both need."""
    level = float(below.middle[-1, 2])
    if abs(turn) < math.radians(20):
        ahead = np.array([math.cos(below.heading), math.sin(below.heading)])
        depth = float((above.middle[0] - below.middle[-1])[:2] @ ahead)
        return LandingEstimate(depth, below.width, level, turn)
    side = np.array([-math.sin(below.heading), math.cos(below.heading)])
    ends = np.vstack([below.left[-1], below.right[-1], above.left[0], above.right[0]])[:, :2] @ side
    return LandingEstimate(below.room_behind, float(np.ptp(ends)), level, turn)
