"""Parts of a traverse: entering, traversing, landing, and the numbers of its steps."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.modes import Phase as Phase
from kaidan.terrain.profile import Profile

Array = NDArray[np.float64]
Zone = tuple[float, float, float, float]
"""Places of a contact: smallest and largest x, smallest and largest z [m]."""

REMEMBERED = 16
"""Profiles of which spans and the like are remembered: one is driven again and again."""
ROOMS = 64
"""Profiles with a length of a flat of which landings are."""
_ON = 1e-6
_LEVEL = 1e-9
"""Height by which points of level ground may differ [m]: rounding."""


@lru_cache(maxsize=REMEMBERED)
def uneven_span(profile: Profile) -> tuple[float, float]:
    """Where the level ground before ends and the level ground behind begins: all that is driven.

    A riser that leans, a ramp or a hole before the first nosing, a drop behind the last one lie in
    between.
    """
    x, z = profile.points.T
    rises, falls = (np.flatnonzero(np.abs(z - end) > _LEVEL) for end in (z[0], z[-1]))
    if len(rises) == 0:  # level
        return float(x[0]), float(x[0])
    return float(x[rises[0] - 1]), float(x[falls[-1] + 1])


def flights_span(profile: Profile, descending: bool) -> tuple[float, float]:
    """Where the flight begins and ends along the path: landings lie before and behind."""
    if len(profile.nosings) == 0:
        return uneven_span(profile)
    first, last = float(profile.nosings[0, 0]), float(profile.nosings[-1, 0])
    if descending:  # the foot of the last riser, rough as the landing may be
        floor = profile.points[-1, 1] + profile.roughness + _LEVEL
        last = max(
            last,
            float(profile.points[profile.points[:, 1] > floor, 0].max(initial=last)),
        )
    return first, last


def phases_of(
    path: contact.Path, profile: Profile, descending: bool, room: float
) -> NDArray[np.str_]:
    """Phase of each pose, from where its two contacts stand.

    Between two flights lies a landing where a nosing is `room` or more, the length of the flat,
    from the next: there the robot lands from the one and enters the other.
    """
    on = profile.roughness + _ON
    start_level = profile.points[0, 1]
    first, _ = flights_span(profile, descending)
    rear, front = path.poses.rear_point, path.poses.front_point
    # before the edge whatever the height (measured landings are not level), on it by the height
    entering = (rear[:, 0] < first - on) | (
        (np.abs(rear[:, 1] - start_level) < on) & (rear[:, 0] <= first + on)
    )
    landing = np.zeros(len(front), dtype=np.bool_)
    for x_0, x_1, z_0, z_1 in landing_zones(profile, descending, room):
        landing |= (
            (front[:, 0] >= x_0)
            & (front[:, 0] <= x_1)
            & (front[:, 1] >= z_0)
            & (front[:, 1] <= z_1)
        )
    entering = _without_gaps(entering)
    for ends in _between(profile, room):
        leaves = _on_landing(rear, ends, descending)
        if not descending:  # the edge behind it belongs to the flight that it leaves
            leaves &= rear[:, 0] > ends[0, 0] + on
        entering |= _without_gaps(leaves)
    phase = np.full(len(path.poses), Phase.TRAVERSE.value, dtype="<U8")
    phase[entering] = Phase.ENTER.value
    phase[landing] = Phase.LAND.value
    return phase


@lru_cache(maxsize=ROOMS)
def landing_zones(profile: Profile, descending: bool, room: float) -> tuple[Zone, ...]:
    """Where the front contact stands of a robot that lands."""
    on, end = profile.roughness + _ON, float(profile.points[-1, 1])
    _, last = flights_span(profile, descending)
    zones = [(last + on, math.inf, -math.inf, math.inf), (last - on, math.inf, end - on, end + on)]
    for (x_0, z_0), (x_1, z_1) in _between(profile, room):
        # its end is where the next flight begins: on its first riser, or going down its edge
        zones.append((x_0 - _ON, x_1 - _ON, -math.inf, (z_0 if descending else z_1) - _ON))
    return tuple(zones)


def _without_gaps(some: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """All poses from the first to the last of some: in between others may carry it for a while."""
    rows = np.flatnonzero(some)
    filled = np.zeros_like(some)
    if len(rows):
        filled[rows[0] : rows[-1] + 1] = True
    return filled


@lru_cache(maxsize=ROOMS)
def _between(profile: Profile, room: float) -> tuple[Array, ...]:
    """Nosings (2, 2) behind and ahead of each landing between flights [m]."""
    x = profile.nosings[:, 0]
    wide = np.flatnonzero(x[1:] - x[:-1] >= room)
    return tuple(profile.nosings[k : k + 2] for k in wide)


def _on_landing(points: Array, ends: Array, descending: bool) -> NDArray[np.bool_]:
    """Which points lie on a landing, its edge included, and not on the flight above it."""
    along = (points[:, 0] >= ends[0, 0] - _ON) & (points[:, 0] <= ends[1, 0] + _ON)
    above = ends[0, 1] if descending else ends[1, 1]
    return np.asarray(along & (points[:, 1] < above - _ON))


def step_at(profile: Profile, x: float, descending: bool) -> int:
    """Nosing number from the bottom at a place along the profile."""
    passed = profile.step_of(x)
    return len(profile.nosings) - passed + 1 if descending and passed else passed


@lru_cache(maxsize=ROOMS)
def top_zones(profile: Profile, descending: bool, room: float) -> tuple[Zone, ...]:
    """Where the uppermost contact stands on a flight's last nosing or beyond: no other will come.

    A landing between two flights ends where the next one begins.
    """
    if len(profile.nosings) == 0:
        return ()
    on = profile.roughness + _ON
    first, last = float(profile.nosings[0, 0]) + on, float(profile.nosings[-1, 0]) - on
    up = math.inf
    zones = [(-up, first, -up, up) if descending else (last, up, -up, up)]
    for (x_0, z_0), (x_1, z_1) in _between(profile, room):
        ends = x_1 + _ON if descending else math.nextafter(x_1 - _ON, -up)
        above = math.nextafter((z_0 if descending else z_1) - _ON, -up)
        zones.append((x_0 - _ON, ends, -up, above))
    return tuple(zones)
