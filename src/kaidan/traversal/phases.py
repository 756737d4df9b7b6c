"""Parts of a traverse: entering, traversing, landing, and the numbers of its steps."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.modes import Phase as Phase
from kaidan.terrain.profile import Profile

REMEMBERED = 16
"""Profiles of which spans and the like are remembered: one is driven again and again."""
ROOMS = 64
"""Profiles with a length of a flat of which landings are."""
_NAMES = np.array([each.value for each in Phase])
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
    zones = entering_zones(profile, descending, room), landing_zones(profile, descending, room)
    return np.asarray(_NAMES[contact.phases_by_zones(path, *zones)])


@lru_cache(maxsize=ROOMS)
def entering_zones(
    profile: Profile, descending: bool, room: float
) -> tuple[tuple[contact.Zone, ...], ...]:
    """Where the rear contact stands of a robot that enters, of each flight."""
    on = profile.roughness + _ON
    level, up = float(profile.points[0, 1]), math.inf
    first, _ = flights_span(profile, descending)
    # before the edge whatever the height (measured landings are not level), on it by the height
    before = -up, math.nextafter(first - on, -up), -up, up
    below, above = math.nextafter(level - on, up), math.nextafter(level + on, -up)
    flights: list[tuple[contact.Zone, ...]] = [(before, (-up, first + on, below, above))]
    for (x_0, z_0), (x_1, z_1) in _between(profile, room):
        # going up the edge behind it belongs to the flight that it leaves
        begin = x_0 - _ON if descending else math.nextafter(x_0 + on, up)
        above = math.nextafter((z_0 if descending else z_1) - _ON, -up)
        flights.append(((begin, x_1 + _ON, -up, above),))
    return tuple(flights)


@lru_cache(maxsize=ROOMS)
def landing_zones(profile: Profile, descending: bool, room: float) -> tuple[contact.Zone, ...]:
    """Where the front contact stands of a robot that lands."""
    on, end = profile.roughness + _ON, float(profile.points[-1, 1])
    _, last = flights_span(profile, descending)
    zones = [(last + on, math.inf, -math.inf, math.inf), (last - on, math.inf, end - on, end + on)]
    for (x_0, z_0), (x_1, z_1) in _between(profile, room):
        # its end is where the next flight begins: on its first riser, or going down its edge
        zones.append((x_0 - _ON, x_1 - _ON, -math.inf, (z_0 if descending else z_1) - _ON))
    return tuple(zones)


@lru_cache(maxsize=ROOMS)
def _between(profile: Profile, room: float) -> tuple[list[list[float]], ...]:
    """Nosings (2, 2) behind and ahead of each landing between flights [m]."""
    x = profile.nosings[:, 0]
    wide = np.flatnonzero(x[1:] - x[:-1] >= room)
    return tuple(profile.nosings[k : k + 2].tolist() for k in wide)


def step_at(profile: Profile, x: float, descending: bool) -> int:
    """Nosing number from the bottom at a place along the profile."""
    passed = profile.step_of(x)
    return len(profile.nosings) - passed + 1 if descending and passed else passed


@lru_cache(maxsize=ROOMS)
def top_zones(profile: Profile, descending: bool, room: float) -> tuple[contact.Zone, ...]:
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
