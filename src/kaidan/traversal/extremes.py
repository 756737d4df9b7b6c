"""Extreme figures of each phase of a traverse."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.outline import Outline
from kaidan.terrain.profile import Profile
from kaidan.traversal.criterion import Criterion
from kaidan.traversal.phases import ROOMS, Phase, step_at, top_zones
from kaidan.traversal.rotations import ROCKING, together
from kaidan.traversal.samples import samples_of
from kaidan.traversal.static_criterion import flights_of

_TIE = 1e-9
_PLACE = 1e-6
"""Distance that is none [m]."""


@dataclass(frozen=True, kw_only=True)
class PhaseExtremes:
    """Extreme figures of a phase; None where it has no pose."""

    phase: Phase
    required_friction: float
    """Largest required friction of any pose [1], but of those that `slides_below` tells of."""
    required_friction_step: int
    slides_below: float | None
    """Friction below which the trailing end slides down as it leaves the last edges and the
    robot lands, going down [1]: it goes where it is going, by a riser at most. None: it leaves
    none."""
    energy_margin: float
    """Smallest rise of the centroid that a fall towards the downhill end needs [m]; traversing,
    that any rotation needs about the contact that stays, as in the paper, whatever arrests it.
    Entering on the way down the edge of the landing obliges to rotate, so only what stays counts:
    infinite where no flat carries."""
    energy_margin_step: int
    steadiness: tuple[float, int]
    """`energy_margin` where the belt pulls at the flat; elsewhere the rise about the flat that the
    same sudden stop or start brings about [m], and the step."""
    uphill_steadiness: tuple[float, int]
    """The same towards the uphill end, traversing, as long as the next nosing uphill is still to
    come: over the last one the robot has to drop onto the landing."""
    static_margin: float
    """Smallest static stability margin towards the downhill end [m]."""
    traction_over_weight: float
    """Largest tractive force over weight [1]."""
    largest_rotation: float
    """Largest angle of rotations that follow one another at once and are arrested [rad]."""
    tilt_downhill: tuple[float, int]
    """Tilt of gravity at which it rotates towards the downhill end by more than rocking [rad], and
    the step; infinite where the terrain obliges to rotate so, over the edge of the landing above,
    and traversing where the criterion on nosings judges."""
    tilt_uphill: tuple[float, int]
    """The same towards the uphill end, traversing, as long as the next nosing is to come."""
    belly_touches: bool
    """Whether the belly carries the robot somewhere (high-centring)."""


class Rise(NamedTuple):
    """Rise to stand over the contact that stays, as a nosing is lost or met."""

    downhill: bool
    """Whether it falls towards the downhill end."""
    rise: float
    """Of the centroid, less what rocking frees [m]."""
    step: int
    """Nosing at which, counted from the bottom."""
    phase: Phase
    """TRAVERSE, or where the uphill end is over the upper landing LAND, going down ENTER."""


def phase_extremes(
    path: contact.Path,
    profile: Profile,
    phase: NDArray[np.str_],
    descending: bool,
    acceleration: float,
    rises: tuple[Rise, ...],
    body: Outline,
    whole: bool,
) -> tuple[PhaseExtremes, ...]:
    """Extreme figures of each phase that the traverse has, in their order."""
    room = body.stance.flat_length
    chains = together(path.rotations, room)
    way = _Way(path, profile, phase, descending, whole)
    each = contact.extremes_of(
        samples_of(path, phase, acceleration),
        *(_nowhere(path) if descending else _came_down(path, chains, whole)),
        contact.Manner(
            descending=descending,
            whole=whole,
            counts=_counts(profile, descending, rises),
            tops=top_zones(profile, descending, room),
            flights=_flights(profile, room),
            nosings=profile.nosings[:, 0].copy(),
            height=body.stance.com_height,
            gyration=body.least_gyration,
            acceleration=acceleration,
        ),
    )
    rotated = _chain_angles(path, chains)
    return tuple(
        _of_phase(way, name, found, [one for one in rises if one.phase is name], rotated)
        for name, found in zip(Phase, each, strict=True)
        if found is not None
    )


class _Way(NamedTuple):
    """A path over a profile, with its phases."""

    path: contact.Path
    profile: Profile
    phase: NDArray[np.str_]
    descending: bool
    whole: bool

    def step(self, place: float) -> int:
        """Step at a place of the front contact [m]; 0 where nothing was looked at."""
        return 0 if math.isnan(place) else step_at(self.profile, place, self.descending)


def _of_phase(
    way: _Way,
    name: Phase,
    found: contact.Extreme,
    rises: Sequence[Rise],
    rotated: Sequence[tuple[int, float]],
) -> PhaseExtremes:
    """Extreme figures of a phase: of its poses, of rises about nosings, of rotations."""
    downhill, uphill = (_least_rise(rises, downhill=each) for each in (True, False))
    energy, steady, uphill_steady = (
        (least, way.step(place)) if least < rise[0] else rise
        for least, place, rise in (
            (found.energy, found.energy_place, downhill),
            (found.steadiness, found.steadiness_place, downhill),
            (found.uphill, found.uphill_place, uphill),
        )
    )
    side = -1.0 if way.descending else 1.0
    turns = [angle for at, angle in rotated if way.phase[at] == name.value]
    return PhaseExtremes(
        phase=name,
        required_friction=found.friction,
        required_friction_step=way.step(found.friction_place),
        slides_below=None if math.isnan(found.slides_below) else found.slides_below,
        energy_margin=energy[0],
        energy_margin_step=energy[1],
        steadiness=steady,
        uphill_steadiness=uphill_steady,
        static_margin=found.static_margin,
        traction_over_weight=found.traction / STANDARD_GRAVITY,
        largest_rotation=max(turns, default=0.0),
        tilt_downhill=min(
            (found.tilt_downhill, way.step(found.tilt_downhill_place)), _rotated(way, name, side)
        ),
        tilt_uphill=min(
            (found.tilt_uphill, way.step(found.tilt_uphill_place)), _rotated(way, name, -side)
        ),
        belly_touches=found.belly > 0.0,
    )


def _counts(profile: Profile, descending: bool, rises: Sequence[Rise]) -> tuple[int, int, int]:
    """Which poses of each phase count for its energy.

    Where nosings carry, the criterion's contacts count, not those of a moment; and the edge of the
    landing above obliges the robot to rotate.
    """
    counts = dict.fromkeys(Phase, contact.EVERY_POSE)
    for each in rises:
        on_flight = each.phase is Phase.TRAVERSE
        counts[each.phase] = contact.NO_POSE if on_flight else contact.BESIDE_NOSINGS
    if descending and not profile.is_level:
        counts[Phase.ENTER] = contact.NO_POSE
    enter, traverse, land = counts.values()
    return enter, traverse, land


@lru_cache(maxsize=ROOMS)
def _flights(profile: Profile, room: float) -> tuple[tuple[float, float], ...]:
    """Where the contacts stand on each flight, which the criterion on nosings judges [m].

    Steps as long as the flat, or longer, are no flight to it, but landings of one step each.
    """
    x = profile.nosings[:, 0].tolist()
    runs = flights_of(profile.nosings, room)
    return tuple((x[first] - _PLACE, x[last] + _PLACE) for first, last in runs)


class _CameDown(NamedTuple):
    """Poses to which the leading end came down about an edge that is still the rear contact.

    Gravity, tilted back, returns them whence it came.
    """

    whence: NDArray[np.float64]
    """Inclination whence it came by rocking at most, from a nosing under a flat [rad]: the robot
    rocks back onto it as long as it is there. Minus infinity: any other pose."""
    back: NDArray[np.bool_]
    """Poses to which it came otherwise: they only come back."""


def _came_down(path: contact.Path, chains: Sequence[range], whole: bool) -> _CameDown:
    """Where one flat carries all along the criterion judges what it rocks back from."""
    assert path.margins is not None
    found = _nowhere(path)
    rotations = list(path.rotations)
    for chain in chains:
        each = rotations[chain.start : chain.stop]
        rocks = not whole and sum(record.angle for record in each) <= ROCKING
        for record in each:
            pivot = contact.Feature.of(record.pivot)
            on_edge = pivot.kind is contact.FeatureKind.VERTEX
            if record.sense > 0 or not record.arrested or not on_edge:
                continue
            row = path.row_before(record.s)
            rear = contact.FeatureTable.of(path.margins.outermost[row + 1 :, 0])
            on_it = np.logical_and.accumulate(
                (rear.point == pivot.point) & (rear.kind == pivot.kind)
            )
            if rocks and path.is_on_flat(int(path.poses.rear[row]), row):
                found.whence[row + 1 :][on_it] = record.start.inclination
            else:
                found.back[row + 1 :] |= on_it
    return found


def _nowhere(path: contact.Path) -> _CameDown:
    """The same of a path on which gravity tilted towards the downhill end returns nothing."""
    count = len(path.poses)
    return _CameDown(np.full(count, -np.inf), np.zeros(count, dtype=np.bool_))


def rises_about_stays(criterion: Criterion, descending: bool) -> tuple[Rise, ...]:
    """Rises about the contact that stays, of each loss and gain."""
    over_landing = Phase.ENTER if descending else Phase.LAND
    return tuple(
        Rise(
            each.downhill,
            max(each.rise - each.freed, 0.0),
            each.nosing + 1,
            over_landing if each.landing else Phase.TRAVERSE,
        )
        for each in criterion.losses
    )


def _rotated(way: _Way, name: Phase, side: float) -> tuple[float, int]:
    """Rotation on the flight to one side that no nosing under a flat arrests, and the step.

    As a tilt it is negative. An end that arrests it on a nosing or a tread is no carrier: the
    paper's rig fell where one would have arrested it.
    """
    least = math.inf, 0
    if name is not Phase.TRAVERSE or way.whole:
        return least
    path = way.path
    for record in path.rotations:
        row = path.row_before(record.s)
        if record.sense * side <= 0 or way.phase[row] != name.value or row + 1 >= len(path.poses):
            continue
        arrests = path.poses.rear if record.sense > 0 else path.poses.front
        if not path.is_on_flat(int(arrests[row + 1]), row + 1):
            at = way.step(float(path.poses.front_point[row, 0]))
            least = min(least, (-record.angle, at))
    return least


def _least_rise(rises: Sequence[Rise], *, downhill: bool) -> tuple[float, int]:
    """Smallest rise towards one end, and the first step at which [m]."""
    some = [(each.rise, each.step) for each in rises if each.downhill is downhill]
    least = min((rise for rise, _ in some), default=math.inf)
    return least, min((step for rise, step in some if rise <= least + _TIE), default=0)


def _chain_angles(path: contact.Path, chains: Sequence[range]) -> list[tuple[int, float]]:
    """Row of the pose at which each arrested chain of rotations begins, and its angle [rad]."""
    each = list(path.rotations)
    return [
        (path.row_before(each[chain[0]].s), sum(each[k].angle for k in chain))
        for chain in chains
        if each[chain[-1]].arrested
    ]
