"""Straight flights among level surfaces: chains of treads, cut where the nosings turn.

::

    plan     |     |     |     |           |        The front edge of each surface, where it faces
             | 1 > | 2 > | 3 > |  landing  |        the one below, is a nosing. Nosings that are
             |     |     |     |           |        parallel make up a flight; between two flights
                                -----------         lies a landing, or winders.
                                |  | 5 | 6
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.readers.solids.levels import Plate
from kaidan.terrain.gap import DEEPEST_TREAD

Array = NDArray[np.float64]

RISES = (0.04, 0.45)
"""Least and largest riser that is looked for [m]."""
REACH = 0.04
"""Half the gap in the plan up to which two surfaces are next to each other [m]."""
SHARED = 0.45
"""Part of the shorter of two long sides along which a riser must lie [1]."""
NARROWEST = 0.08
"""Depth below which a surface is no tread but a foot that is flush with a floor [m]."""
PARALLEL = math.radians(2.0)
"""Angle up to which nosings are parallel [rad]."""
FEWEST = 2
"""Parallel nosings that make a flight."""
STRAIGHT = 0.6
"""Part of a front edge that is one line where it is a nosing and no curve [1]."""


@dataclass(frozen=True, eq=False)
class Run:
    """A straight flight, or winders between two, or a curved flight."""

    steps: tuple[int, ...]
    """Numbers of the surfaces behind its nosings, from the lowest up."""
    below: int | None
    """Number of the surface before the first nosing; None: there is none."""
    complete: bool
    """Whether the last of `steps` is what the flight leads to; else that is not in the model."""
    heading: float
    """Of the ascent [rad]; NaN: it is not straight."""
    turned: float = 0.0
    """Angle by which the nosings turn, where it is not straight [rad]."""


class Edge(NamedTuple):
    """Front edge of a surface, where it faces the one below."""

    direction: float
    """Along the edge, modulo half a turn [rad]; NaN: it is a curve."""
    middle: Array
    """Shape (2,) [m]."""


def runs_of(plates: Sequence[Plate]) -> list[Run]:
    """Flights, winders and curved flights of level surfaces."""
    up, down = _next_to(plates)
    reach = _grown([each.shape for each in plates], 2 * REACH)
    depth = [each.depth for each in plates]
    is_tread = [NARROWEST <= each < DEEPEST_TREAD for each in depth]

    def follows(low: int) -> int | None:
        high = up.get(low)
        return high if high is not None and is_tread[high] and down.get(high) == low else None

    found: list[Run] = []
    for number in range(len(plates)):
        below = down.get(number)
        if not is_tread[number] or (
            below is not None and is_tread[below] and follows(below) == number
        ):
            continue
        chain = [number]
        while (high := follows(chain[-1])) is not None:
            chain.append(high)
        above = up.get(chain[-1])
        found += _cut(plates, reach, chain, below, above)
    return found


def _next_to(plates: Sequence[Plate]) -> tuple[dict[int, int], dict[int, int]]:
    """Next surface up behind each, and next surface down before each, across a riser."""
    import shapely

    up: dict[int, int] = {}
    down: dict[int, int] = {}
    if not plates:
        return up, down
    grown = _grown([each.shape for each in plates], REACH)
    low, high = shapely.STRtree(grown).query(grown, predicate="intersects")
    levels = np.array([each.level for each in plates])
    rise = levels[high] - levels[low]
    keep = (rise >= RISES[0]) & (rise <= RISES[1])
    low, high, rise = low[keep], high[keep], rise[keep]
    shared = shapely.area(shapely.intersection(grown[low], grown[high])) / (2 * REACH)
    long = np.array([each.box[0] for each in plates])
    enough = shared >= SHARED * np.minimum(long[low], long[high]) + 2 * REACH
    for k in np.argsort(rise, kind="stable"):
        if enough[k]:
            up.setdefault(int(low[k]), int(high[k]))
            down.setdefault(int(high[k]), int(low[k]))
    return up, down


def _grown(shapes: Any, by: float) -> Any:
    import shapely

    return np.atleast_1d(shapely.buffer(shapes, by, join_style="mitre", mitre_limit=2.0))


def _cut(
    plates: Sequence[Plate], reach: Any, chain: list[int], below: int | None, above: int | None
) -> Iterator[Run]:
    """Straight flights of a chain, and what turns between them."""
    steps = chain if above is None else [*chain, above]
    lower = [below, *chain]
    pairs = list(zip(lower, steps, strict=False))
    seen = [(low, high) for low, high in pairs if low is not None]
    found = iter(_front_edges([plates[high] for _, high in seen], reach[[low for low, _ in seen]]))
    edges = [None if low is None else next(found) for low, _ in pairs]
    if edges[0] is None:  # no floor below: the first nosing is taken as parallel to the second
        second = edges[1] if len(edges) > 1 else None
        direction = math.nan if second is None else second.direction
        edges[0] = Edge(direction, plates[steps[0]].middle)
    known = [each for each in edges if each is not None]
    groups: list[list[int]] = []
    for k, each in enumerate(known):
        first = known[groups[-1][0]].direction if groups else math.nan
        if abs(_between(first, each.direction)) <= PARALLEL:
            groups[-1].append(k)
        else:
            groups.append([k])
    straight = [group for group in groups if len(group) >= FEWEST]
    turn = sum(
        abs(_between(one.direction, two.direction))
        for one, two in pairwise(known)
        if math.isfinite(one.direction + two.direction)
    )
    if not straight or (len(straight) < len(groups) and len(known) <= 2 * len(groups)):
        if len(known) >= 3:
            yield Run(tuple(steps), below, above is not None, math.nan, turn)
        return
    for group in groups:
        first, last = group[0], group[-1]
        before = below if first == 0 else steps[first - 1]
        members = tuple(steps[first : last + 1])
        complete = last < len(steps) - 1 or above is not None
        if len(group) < FEWEST:
            yield Run(members, before, complete, math.nan, turn)
            continue
        across = known[last].direction
        ahead = known[last].middle - known[first].middle
        heading = across + math.pi / 2
        if math.cos(heading) * ahead[0] + math.sin(heading) * ahead[1] < 0:
            heading -= math.pi
        yield Run(members, before, complete, heading)


def _between(one: float, two: float) -> float:
    """Angle from one direction to another, modulo half a turn [rad]; infinite: unknown."""
    if math.isnan(one + two):
        return math.inf
    return (two - one + math.pi / 2) % math.pi - math.pi / 2


def _front_edges(upper: Sequence[Plate], reach: Any) -> list[Edge]:
    """Edge of each surface along the one below it, whose reaches those are."""
    import shapely

    along = shapely.intersection(shapely.boundary([each.shape for each in upper]), reach)
    parts, of = shapely.get_parts(along, return_index=True)
    lines = shapely.get_type_id(parts) == 1
    points, line = shapely.get_coordinates(parts[lines], return_index=True)
    pieces, within = np.hstack([points[:-1], points[1:]]), line[:-1] == line[1:]
    pieces, owner = pieces[within], of[lines][line[:-1][within]]
    return [_edge(pieces[owner == k], each) for k, each in enumerate(upper)]


def _edge(pieces: Array, upper: Plate) -> Edge:
    """Edge of a surface of pieces of its boundary, x, y of both ends, shape (n, 4)."""
    if len(pieces) == 0:
        return Edge(math.nan, upper.middle)
    ahead = pieces[:, 2:] - pieces[:, :2]
    length = np.hypot(*ahead.T)
    direction = np.arctan2(ahead[:, 1], ahead[:, 0]) % math.pi
    best = int(np.argmax(length))
    off = np.abs((direction - direction[best] + math.pi / 2) % math.pi - math.pi / 2)
    same = off <= PARALLEL
    middles = (pieces[:, :2] + pieces[:, 2:]) / 2
    along_it = length[same]
    middle = along_it @ middles[same] / along_it.sum()
    straight = along_it.sum() >= STRAIGHT * length.sum()
    return Edge(float(direction[best]) if straight else math.nan, middle)
