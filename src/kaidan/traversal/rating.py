"""Many postures over parts of one profile, rated in one call: their largest figures, no poses."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.contact import Belts, Grousers, Job, Placement, Status
from kaidan.outline import Outline
from kaidan.terrain.polyline import ROUGHNESS, STEEP
from kaidan.terrain.profile import Profile
from kaidan.traversal.driving import (
    criterion_of,
    ground_for,
    is_whole,
    refuse_too_long,
    span,
    tread_of,
)
from kaidan.traversal.grip import treads_of
from kaidan.traversal.nosing_events import TOUCH
from kaidan.traversal.phases import landing_zones
from kaidan.traversal.rotations import slopes_of_flights

Array = NDArray[np.float64]
Zones = tuple[contact.Zone, ...]
"""Places of the front contact at which a robot lands, see `landing_zones`."""


class Part(NamedTuple):
    """A robot over a part of a profile; see `kaidan.traversal.traverse`."""

    outline: Outline
    """x towards the leading end."""
    start: Placement | None = None
    until: float | None = None


class Case(NamedTuple):
    """Grousers in one case, and the friction beside them."""

    grousers: Grousers
    phi: tuple[float, float, float]
    """Angles of friction of nosings, treads and riser faces [rad]."""
    best: bool
    """Whether it is of the best case, or of the worst."""


Gripping = tuple[Case, ...]
"""Cases of belts with grousers: all of the worst have to hold, and all of the best."""


class Rated(NamedTuple):
    """Largest figures of a part of a traverse that arrives."""

    required_friction: float
    """But where the trailing end leaves the last edges as the robot lands [1]."""
    belly_touches: bool
    rotation: float
    """Largest of those that follow one another at once [rad]."""
    rocking: float
    """Largest part of one that counts as rocking [rad]."""
    impact_speed: float
    """Largest [m/s]."""
    spare: float
    """Least rise still to climb before rotations topple, gravity tilted [m]; infinite: nothing
    rotates."""
    held: float
    """Least margin of belts with grousers at the poses looked at [rad]; infinite: not known."""
    held_at_best: float
    """The same in the best case [rad]."""
    downhill: float
    """Least margin of the criterion of no rotation [rad]; infinite: no flat carries all along."""
    uphill: float
    """The same towards the uphill end [rad]."""


def rate(
    profile: Profile,
    parts: Sequence[Part],
    *,
    descending: bool = False,
    acceleration: float = 0.0,
    tilts: tuple[float, float] = (0.0, 0.0),
    step: float = contact.STEP,
    belts: Gripping | None = None,
) -> list[Rated | None]:
    """Rate robots, or one in many postures, on their way over parts of a profile.

    acceleration: acceleration UP the stairs [m/s^2].
    tilts: of gravity, towards the downhill and the uphill end that comes down [rad].
    step: arclength between poses [m].
    belts: belts with grousers; without them it is not found how they hold.

    None for one that does not arrive.
    """
    driven = profile.reflected() if descending else profile
    lengths = [each.outline.stance.flat_length for each in parts]
    zones_of = {each: landing_zones(driven, descending, each) for each in set(lengths)}
    together: dict[Zones, list[int]] = {}
    for k, length in enumerate(lengths):
        together.setdefault(zones_of[length], []).append(k)
    found: dict[int, Rated | None] = {}
    for zones, which in together.items():
        found |= zip(
            which,
            _rated(
                driven, [parts[k] for k in which], zones, descending, acceleration, tilts, step,
                belts,
            ),
            strict=True,
        )  # fmt: skip
    return [found[k] for k in range(len(parts))]


def _rated(
    driven: Profile, parts: Sequence[Part], zones: Zones, descending: bool, acceleration: float,
    tilts: tuple[float, float], step: float, belts: Gripping | None,
) -> list[Rated | None]:  # fmt: skip
    """The same of robots that land in the same zones."""
    along = -acceleration if descending else acceleration
    spans = [span(driven, each.outline, each.start, each.until) for each in parts]
    longest = max(range(len(parts)), key=lambda k: spans[k][1] - spans[k][0])
    refuse_too_long(driven, parts[longest].outline, spans[longest], step)
    outlines = [each.outline for each in parts]
    lengths = [each.stance.flat_length for each in outlines]
    flights = {length: slopes_of_flights(driven, length) for length in set(lengths)}
    ground = ground_for(driven, outlines)
    ratings = contact.rate_many(
        ground,
        [each.parts for each in outlines],
        outlines[0].kinds,
        lengths,
        [flights[length] for length in lengths],
        [
            Job(0, k, *ends, _inclination(part), along, part.outline.gyration)
            for k, (part, ends) in enumerate(zip(parts, spans, strict=True))
        ],
        step=step,
        zones=zones,
        edges=driven.edges,
        rough=ROUGHNESS,
        tilts=tilts[::-1] if descending else tilts,
        belts=None if belts is None else _on(ground, belts, descending),
    )
    arrives = (ratings.status == Status.OK).tolist()
    figures = zip(
        ratings.required_friction.tolist(), ratings.belly_touches.tolist(),
        ratings.largest_rotation.tolist(), ratings.rocking.tolist(),
        ratings.impact_speed.tolist(), ratings.spare.tolist(), ratings.held.tolist(),
        ratings.held_at_best.tolist(), strict=True,
    )  # fmt: skip
    return [
        Rated._make((*each, *_tips(driven, part, ends, along))) if arrived else None
        for arrived, each, part, ends in zip(arrives, figures, parts, spans, strict=True)
    ]


def _on(ground: Array, belts: Gripping, descending: bool) -> Belts:
    """Belts on some ground [m]."""
    treads = treads_of(contact.Ground(contact.ground_of(ground)), descending)
    cases = tuple((*each.grousers, *each.phi, each.best) for each in belts)
    return contact.belts_on(
        cases, treads, climbs=not descending, steep=STEEP, touch=TOUCH, slip=contact.STEP
    )


def _inclination(part: Part) -> float:
    return 0.0 if part.start is None else part.start.inclination


def _tips(
    driven: Profile, part: Part, ends: tuple[float, float], along: float
) -> tuple[float, float]:
    """Least margins of the criterion downhill and uphill [rad]."""
    if not is_whole(tread_of(part.outline), part.outline):
        return math.inf, math.inf
    _, criterion = criterion_of(driven, part.outline, along)
    if criterion.holds is None:
        return math.inf, math.inf
    if part.start is not None or part.until is not None:
        criterion = criterion.within(*((-ends[1], -ends[0]) if driven.falls else ends))
    down, up = (
        min((each.margin for each in criterion.losses if each.downhill is side), default=math.inf)
        for side in (True, False)
    )
    return down, up
