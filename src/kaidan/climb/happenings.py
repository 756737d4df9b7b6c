"""Events of a way with the step and the phase at which they happen."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.climb.phases import Phase, step_at
from kaidan.profile import Profile


@dataclass(frozen=True, kw_only=True)
class Happening:
    """An event along the way."""

    phase: Phase
    step: int
    """Nosing number from the bottom, 1 the first; 0 before it."""
    what: str
    """made, lost, nose-drops, tips-back, caught, tail-rests, fell-forward, ..."""
    way_m: float
    """Arclength of the centroid's path [m]."""
    inclination_deg: float
    """Inclination of the body, uphill positive when going up, downhill when going down [deg]."""
    swing_deg: float | None
    """How far it turned, for caught [deg]."""
    toppled_with_momentum: bool | None
    """Whether the momentum gained would carry it over, for caught."""


def happenings_of(
    run: contact.Traverse,
    events: NDArray[np.float64],
    way: Profile,
    phase: NDArray[np.str_],
    descending: bool,
) -> tuple[Happening, ...]:
    """Events in words, in their order."""
    told = []
    release = -1
    for code, s, _, _, phi, *_, row in events:
        event = contact.Event(int(code))
        at = int(min(max(row, 0), len(run.poses) - 1))
        if event in (contact.Event.NOSE_DROPS, contact.Event.TIPS_BACK):
            release += 1
        caught = event is contact.Event.CAUGHT and 0 <= release < len(run.releases)
        told.append(
            Happening(
                phase=Phase(str(phase[at])),
                step=step_at(way, float(run.poses[at, 8]), descending),
                what=event.name.lower().replace("_", "-"),
                way_m=float(s),
                inclination_deg=math.degrees(phi),
                swing_deg=math.degrees(run.releases[release, 9]) if caught else None,
                toppled_with_momentum=bool(run.releases[release, 14] > 0) if caught else None,
            )
        )
    return tuple(told)
