"""Extreme figures of each phase of a traverse."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.measures import sudden_stop_height
from kaidan.outline import Outline
from kaidan.terrain.profile import Profile
from kaidan.traversal.criterion import Criterion
from kaidan.traversal.phases import Phase, over_the_top, step_at
from kaidan.traversal.rotations import ROCKING, together
from kaidan.traversal.samples import corners, samples_of
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
    rotated = _chain_angles(path, room)
    samples = samples_of(path, phase, acceleration)
    seen = samples.path
    assert seen.margins is not None
    places, own = seen.poses.front_point[:, 0], len(path.poses)
    top = over_the_top(seen, profile, descending, room)
    closed = _closed(path, phase)
    came_down = None if descending else _came_down(path, room, whole)
    whence = None if came_down is None else came_down.whence[samples.row]
    as_it_is = np.ones(len(seen.poses))
    sudden = {side: _as_on_the_flat(seen, body, side) for side in (-1.0, 1.0)}
    # of a pose between two phases the other one judges
    of_criterion = _on_a_flight(seen, profile, room) | (phase[samples.row] != Phase.TRAVERSE.value)
    at_nosing = _at_nosing(places, profile) if rises else np.zeros(0, dtype=np.bool_)
    on_belly = seen.margins.belly_touches
    extremes = []
    for name in Phase:
        rows = np.flatnonzero(closed[name][samples.row] & samples.lasts)
        if len(rows) == 0:
            continue
        margins, side = (seen.margins.front, -1.0) if descending else (seen.margins.back, 1.0)
        of_rises = [each for each in rises if each.phase is name]
        posed = np.ones(len(rows), dtype=np.bool_)
        if of_rises:  # where nosings carry, the criterion's contacts count, not those of a moment
            posed[:] = name is not Phase.TRAVERSE
            posed &= ~at_nosing[rows]
        if descending and name is Phase.ENTER and not profile.is_level:
            # the edge of the landing obliges it to rotate
            posed[:] = False
        uphill = rows[posed & ~top[rows]] if name is Phase.TRAVERSE else rows[:0]
        barriers = []
        for counts, to, weights in (
            (rows[posed], side, as_it_is),
            (rows[posed], side, sudden[side]),
            (uphill, -side, sudden[-side]),
        ):
            flat = _least_rise(of_rises, downhill=to == side)
            least, at = _least_energy(seen, counts, to, weights)
            there = least < flat[0]
            barriers.append((least, step_at(profile, at, descending)) if there else flat)
        (energy, step), steady, uphill_steady = barriers
        judged = rows[~of_criterion[rows]] if whole and name is Phase.TRAVERSE else rows
        downhill_rows = rows[:0] if descending and name is Phase.ENTER else judged
        if came_down is not None:
            downhill_rows = downhill_rows[~came_down.back[samples.row[downhill_rows]]]
        uphill_rows = judged[~top[judged]] if name is Phase.TRAVERSE else rows[:0]
        slides = samples.comes_off[rows] & (name is Phase.LAND)
        friction = samples.friction[rows]
        held = np.where(slides, 0.0, friction)
        hardest = int(np.flatnonzero(held >= held.max() - _TIE)[0])  # inf - _TIE is inf
        extremes.append(
            PhaseExtremes(
                phase=name,
                required_friction=float(held[hardest]),
                slides_below=float(friction[slides].max()) if slides.any() else None,
                required_friction_step=step_at(profile, float(places[rows[hardest]]), descending),
                energy_margin=energy,
                energy_margin_step=step,
                steadiness=steady,
                uphill_steadiness=uphill_steady,
                static_margin=float(np.fmin.reduce(margins[rows])),
                traction_over_weight=float(
                    np.fmax.reduce(np.where(slides, 0.0, samples.traction[rows]))
                )
                / STANDARD_GRAVITY,
                largest_rotation=max(
                    (angle for at, angle in rotated if phase[at] == name.value), default=0.0
                ),
                tilt_downhill=min(
                    _rock(
                        seen,
                        downhill_rows,
                        side,
                        profile,
                        descending,
                        acceleration,
                        own,
                        whence,
                    ),
                    _rotated(path, phase, name, side, profile, descending, whole),
                ),
                tilt_uphill=min(
                    _rock(seen, uphill_rows, -side, profile, descending, acceleration, own),
                    _rotated(path, phase, name, -side, profile, descending, whole),
                ),
                belly_touches=bool(on_belly[rows].any()),
            )
        )
    return tuple(extremes)


def _on_a_flight(path: contact.Path, profile: Profile, room: float) -> NDArray[np.bool_]:
    """Poses whose contacts stand on one flight, which the criterion on nosings judges.

    Steps as long as the flat, or longer, are no flight to it, but landings of one step each.
    """
    rear, front = path.poses.rear_point[:, 0], path.poses.front_point[:, 0]
    found = np.zeros(len(rear), dtype=np.bool_)
    for first, last in flights_of(profile.nosings, room):
        begin, end = profile.nosings[[first, last], 0]
        found |= (rear >= begin - _PLACE) & (front <= end + _PLACE)
    return found


def _at_nosing(places: NDArray[np.float64], profile: Profile) -> NDArray[np.bool_]:
    """Places at which a nosing stands, to the last digit."""
    nosings = np.append(profile.nosings[:, 0], math.inf)
    return np.asarray(nosings[np.searchsorted(nosings[:-1], places)] == places)


def _closed(path: contact.Path, phase: NDArray[np.str_]) -> dict[Phase, NDArray[np.bool_]]:
    """Poses of each phase, with the pose between two phases in both.

    A phase ends where a contact is exchanged, with a pose on either side; or where one runs over a
    corner of the ground and takes its name, with one pose.
    """
    corner = corners(path)
    closed = {}
    for name in Phase:
        rows = phase == name.value
        beside = np.zeros_like(rows)
        beside[1:] |= rows[:-1]
        beside[:-1] |= rows[1:]
        closed[name] = rows | (corner & beside)
    return closed


class _CameDown(NamedTuple):
    """Poses to which the leading end came down about an edge that is still the rear contact.

    Gravity, tilted back, returns them whence it came.
    """

    whence: NDArray[np.float64]
    """Inclination whence it came by rocking at most, from a nosing under a flat [rad]: the robot
    rocks back onto it as long as it is there. Minus infinity: any other pose."""
    back: NDArray[np.bool_]
    """Poses to which it came otherwise: they only come back."""


def _came_down(path: contact.Path, flat_length: float, whole: bool) -> _CameDown:
    """Where one flat carries all along the criterion judges what it rocks back from."""
    assert path.margins is not None
    whence = np.full(len(path.poses), -np.inf)
    back = np.zeros(len(path.poses), dtype=np.bool_)
    rear = contact.FeatureTable.of(path.margins.outermost[:, 0])
    rotations = path.rotations
    for chain in together(rotations, flat_length):
        rocks = not whole and rotations.angle[chain].sum() <= ROCKING
        for record in list(rotations)[chain.start : chain.stop]:
            pivot = contact.Feature.of(record.pivot)
            on_edge = pivot.kind is contact.FeatureKind.VERTEX
            if record.sense > 0 or not record.arrested or not on_edge:
                continue
            row = path.row_before(record.s)
            on_it = np.zeros(len(back), dtype=np.bool_)
            on_it[row + 1 :] = np.logical_and.accumulate(
                (rear.point[row + 1 :] == pivot.point) & (rear.kind[row + 1 :] == pivot.kind)
            )
            if rocks and path.is_on_flat(int(path.poses.rear[row]), row):
                whence[on_it] = record.start.inclination
            else:
                back |= on_it
    return _CameDown(whence, back)


def _as_on_the_flat(path: contact.Path, body: Outline, side: float) -> NDArray[np.float64]:
    """Rise about the flat over that about the outermost contact, of one sudden stop, each pose."""
    poses = path.poses
    point, normal = (
        (poses.rear_point, poses.rear_normal)
        if side > 0
        else (poses.front_point, poses.front_normal)
    )
    lever = (path.x - point[:, 0]) * normal[:, 0] + (path.z - point[:, 1]) * normal[:, 1]
    flat, here = (
        sudden_stop_height(v=1.0, lever=each, gyration=body.least_gyration)
        for each in (body.stance.com_height, lever)
    )
    return np.asarray(flat / np.maximum(here, _PLACE * flat))


def _least_energy(
    path: contact.Path,
    rows: NDArray[np.int64],
    side: float,
    weights: NDArray[np.float64],
) -> tuple[float, float]:
    """Smallest weighted rise that a fall to one side needs [m], and at which contact."""
    if len(rows) == 0:
        return math.inf, math.nan
    least, row = path.least_energy(rows, side, weights, _TIE)
    return least, float(path.poses.front_point[row, 0])


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


def _rock(
    path: contact.Path, rows: NDArray[np.int64], side: float, profile: Profile, descending: bool,
    acceleration: float, own: int, whence: NDArray[np.float64] | None = None,
) -> tuple[float, int]:  # fmt: skip
    """Least tilt at which some poses rotate to one side [rad], and the step."""
    tilt, row = contact.first_rock(
        path, rows, side, own=own, acceleration=acceleration, whence=whence
    )
    if row < 0:
        return tilt, 0
    return tilt, step_at(profile, float(path.poses.front_point[row, 0]), descending)


def _rotated(
    path: contact.Path, phase: NDArray[np.str_], name: Phase, side: float, profile: Profile,
    descending: bool, whole: bool,
) -> tuple[float, int]:  # fmt: skip
    """Rotation on the flight to one side that no nosing under a flat arrests, and the step.

    As a tilt it is negative. An end that arrests it on a nosing or a tread is no carrier: the
    paper's rig fell where one would have arrested it.
    """
    least = math.inf, 0
    if name is not Phase.TRAVERSE or whole:
        return least
    for record in path.rotations:
        row = path.row_before(record.s)
        if record.sense * side <= 0 or phase[row] != name.value or row + 1 >= len(path.poses):
            continue
        arrests = path.poses.rear if record.sense > 0 else path.poses.front
        if not path.is_on_flat(int(arrests[row + 1]), row + 1):
            at = step_at(profile, float(path.poses.front_point[row, 0]), descending)
            least = min(least, (-record.angle, at))
    return least


def _least_rise(rises: Sequence[Rise], *, downhill: bool) -> tuple[float, int]:
    """Smallest rise towards one end, and the first step at which [m]."""
    some = [(each.rise, each.step) for each in rises if each.downhill is downhill]
    least = min((rise for rise, _ in some), default=math.inf)
    return least, min((step for rise, step in some if rise <= least + _TIE), default=0)


def _chain_angles(path: contact.Path, flat_length: float) -> list[tuple[int, float]]:
    """Row of the pose at which each arrested chain of rotations begins, and its angle [rad]."""
    rotations = path.rotations
    return [
        (path.row_before(float(rotations.s[chain[0]])), float(rotations.angle[chain].sum()))
        for chain in together(rotations, flat_length)
        if rotations.arrested[chain[-1]]
    ]
