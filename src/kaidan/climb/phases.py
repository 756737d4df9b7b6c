"""Parts of a way, entering, traversing, landing, and the numbers of its steps."""

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.profile import Profile

Array = NDArray[np.float64]

_ON = 1e-6
_LEVEL = 1e-9
"""Height by which points of level ground may differ [m]: rounding."""


class Phase(StrEnum):
    """Part of the way."""

    ENTER = "enter"
    """From the lower (going down: upper) landing until the trailing end has left it."""
    TRAVERSE = "traverse"
    """On the flight alone."""
    LAND = "land"
    """From the first contact with the other landing until the whole robot stands on it."""


def ends_of_way(way: Profile) -> tuple[float, float]:
    """Where the level ground before ends and the level ground behind begins: all that is driven.

    A riser that leans, a ramp or a hole before the first nosing, a drop behind the last one lie in
    between.
    """
    x, z = way.points.T
    rises, falls = (np.flatnonzero(np.abs(z - end) > _LEVEL) for end in (z[0], z[-1]))
    if len(rises) == 0:  # level all the way
        return float(x[0]), float(x[0])
    return float(x[rises[0] - 1]), float(x[falls[-1] + 1])


def ends_of_flights(way: Profile, descending: bool) -> tuple[float, float]:
    """Where the flight begins and ends along the way: landings lie before and behind."""
    if len(way.nosings) == 0:
        return ends_of_way(way)
    first, last = float(way.nosings[0, 0]), float(way.nosings[-1, 0])
    if descending:  # the foot of the last riser, rough as the landing may be
        floor = way.points[-1, 1] + max(_LEVEL, way.roughness)
        last = max(
            last,
            float(way.points[way.points[:, 1] > floor, 0].max(initial=last)),
        )
    return first, last


def phases_of(
    run: contact.Traverse, way: Profile, descending: bool, room: float
) -> NDArray[np.str_]:
    """Phase of each pose, from where its two contacts stand.

    Between two flights lies a landing where a nosing is `room` or more, the length of the flat,
    from the next: there the robot lands from the one and enters the other.
    """
    on = max(_ON, way.roughness)
    start_level, end_level = way.points[0, 1], way.points[-1, 1]
    first, last = ends_of_flights(way, descending)
    rear, front = run.poses[:, 6:8], run.poses[:, 8:10]
    # before the edge whatever the height (measured landings are not level), on it by the height
    entering = (rear[:, 0] < first - on) | (
        (np.abs(rear[:, 1] - start_level) < on) & (rear[:, 0] <= first + on)
    )
    landing = (front[:, 0] > last + on) | (
        (np.abs(front[:, 1] - end_level) < on) & (front[:, 0] >= last - on)
    )
    entering = _without_gaps(entering)
    for ends in _between(way, room):
        leaves = _on_landing(rear, ends, descending)
        if not descending:  # the edge behind it belongs to the flight that it leaves
            leaves &= rear[:, 0] > ends[0, 0] + on
        entering |= _without_gaps(leaves)
        landing |= _on_landing(front, ends, descending) & ~_at_its_end(front, ends)
    phase = np.full(len(run.poses), Phase.TRAVERSE.value, dtype="<U8")
    phase[entering] = Phase.ENTER.value
    phase[landing] = Phase.LAND.value
    return phase


def _without_gaps(some: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """All poses from the first to the last of some: in between others may carry it for a while."""
    rows = np.flatnonzero(some)
    filled = np.zeros_like(some)
    if len(rows):
        filled[rows[0] : rows[-1] + 1] = True
    return filled


def _between(way: Profile, room: float) -> list[Array]:
    """Nosings (2, 2) behind and ahead of each landing between flights [m]."""
    wide = np.flatnonzero(np.diff(way.nosings[:, 0]) >= room)
    return [way.nosings[k : k + 2] for k in wide]


def _on_landing(points: Array, ends: Array, descending: bool) -> NDArray[np.bool_]:
    """Which points lie on a landing, its edge included, and not on the flight above it."""
    along = (points[:, 0] >= ends[0, 0] - _ON) & (points[:, 0] <= ends[1, 0] + _ON)
    above = ends[0, 1] if descending else ends[1, 1]
    return np.asarray(along & (points[:, 1] < above - _ON))


def _at_its_end(points: Array, ends: Array) -> NDArray[np.bool_]:
    """Which points lie where the next flight begins: on its first riser, or going down its edge."""
    return np.asarray(points[:, 0] >= ends[1, 0] - _ON)


def step_at(way: Profile, x: float, descending: bool) -> int:
    """Nosing number from the bottom at a place along the way."""
    passed = way.step_of(x)
    return len(way.nosings) - passed + 1 if descending and passed else passed


def over_the_top(
    run: contact.Traverse, way: Profile, descending: bool, room: float
) -> NDArray[np.bool_]:
    """Poses whose uppermost contact is a flight's last nosing or beyond: no other will come."""
    if len(way.nosings) == 0:
        return np.zeros(len(run.poses), dtype=np.bool_)
    upper = run.poses[:, 6:8] if descending else run.poses[:, 8:10]
    on = max(_ON, way.roughness)
    over = (
        upper[:, 0] <= way.nosings[0, 0] + on
        if descending
        else upper[:, 0] >= way.nosings[-1, 0] - on
    )
    for ends in _between(way, room):
        here = _on_landing(upper, ends, descending)
        over = over | (here if descending else here & ~_at_its_end(upper, ends))
    return np.asarray(over)
