r"""Rotations of a traverse: how far, how hard they end, and whether the path obliges to them.

::

            C .                      start: the centroid C stands over the front contact P
        ____._|____                  end:   the next contact B arrests the rotation
             P \      .
                \   .  the path obliges to what it turns until an edge E within the
            ..E  \B    flat's length lies under it; what it turns beyond is avoidable

A chain is what follows at once, with no way driven in between: it is one motion of the robot.
Of what is avoidable counts as rocking on a flight no more than the inclinations are off its slope.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.mechanics.rocking import rocking
from kaidan.terrain.polyline import ROUGHNESS
from kaidan.terrain.profile import Profile
from kaidan.traversal.phases import ROOMS, Phase, step_at
from kaidan.traversal.static_criterion import flights_of, mean_slope

ROCKING = contact.ROCKING
"""Rocking that nothing is made of [rad]."""
TAKEN_UP = math.radians(0.01)
"""Rotation that the rubber takes up, so that it begins none [rad]: an end half a metre off moves by
less than 0.1 mm."""
_ROUNDING = 1e-8
"""Rotation that is rounding [rad]: of one of 1e-17 rad a mirror would decide what it obliges to."""
PLACE = 1e-6
"""Length by which a contact may lie beside a nosing that it is on [m]."""
Slope = tuple[float, float, float]
"""Where a flight begins and ends, and its mean slope [m, m, rad]."""
AT_ONCE = 0.01
"""Way of the centroid between two rotations of a chain, at most, over the flat's length [1]."""


@dataclass(frozen=True, kw_only=True)
class Rotation:
    """Rotation about one contact after the other, until two hold the robot or it has fallen."""

    phase: Phase
    step: int
    """Nosing number from the bottom, 1 the first; 0 before it."""
    path: float
    """Arclength at which it begins [m]."""
    start: float
    """Inclination at which it begins, leading end up [rad]."""
    reached: float
    """Inclination at which it ends [rad]."""
    angle: float
    """How far it turns [rad]."""
    leading_end_down: bool
    """Whether the leading end comes down; else the trailing one."""
    drop: float
    """Fall of the centroid along effective gravity [m]."""
    moved: float
    """Its way across effective gravity, towards the end that comes down [m]."""
    impact_speed: float
    """Speed at which the end hits the contact that arrests it [m/s]; NaN: nothing does."""
    avoidable: float
    """Part of the angle that a longer robot, or another place of the centroid, would spare [rad]:
    what it turns beyond the line to the next edge, all of it where the trailing end comes down."""
    theta_s: float
    """Mean slope of the flight on which it begins and ends, as driven [rad]; NaN: on none."""
    pivot: int
    """Contact that it begins about, read by `kaidan.contact.Feature.of`."""
    arrested_by: int | None
    """Contact that arrests it; None: it falls, or is wedged."""
    rise: float
    """Rise of the centroid still to climb before it topples [m]."""
    ahead: float
    """Its way across effective gravity meanwhile, as for `moved` [m]."""
    left: float
    """Height that a plastic impact leaves of the drop, as energy [m]."""

    @property
    def rocking(self) -> float:
        """What of it counts as rocking [rad]."""
        return Chain((self,)).rocking

    def spare_after_impact(self, tilt: float) -> float:
        """Rise still to climb less what a plastic impact leaves of the drop [m], gravity tilted."""
        share = self.left / self.drop if self.drop > 0.0 else 0.0
        left = share * (math.cos(tilt) * self.drop + math.sin(tilt) * self.moved)
        return math.cos(tilt) * self.rise - math.sin(tilt) * self.ahead - max(left, 0.0)

    @property
    def arrested(self) -> bool:
        """Whether the next contact arrests it."""
        return self.arrested_by is not None

    @property
    def obliged(self) -> bool:
        """Whether the path obliges to it, but for `ROCKING`.

        The leading end comes down, and no edge ahead within the length of the flat would have held
        it higher: it comes down onto a landing, over the top edge, off a kerb, into a gap longer
        than the flat. The next nosing of a flight, or the far edge of a short gap, would have.
        A rotation of which all could be avoided is rocking at most, and nothing obliges to it.
        """
        return Chain((self,)).obliged


@dataclass(frozen=True)
class Chain:
    """Rotations that follow one another at once, as a whole."""

    rotations: tuple[Rotation, ...]

    @property
    def phase(self) -> Phase:
        """Phase in which it begins."""
        return self.rotations[0].phase

    @property
    def step(self) -> int:
        """Step at which it begins."""
        return self.rotations[0].step

    @property
    def path(self) -> float:
        """Arclength at which it begins [m]."""
        return self.rotations[0].path

    @property
    def start(self) -> float:
        """Inclination at which it begins [rad]."""
        return self.rotations[0].start

    @property
    def reached(self) -> float:
        """Inclination farthest from where it began [rad]."""
        return max((each.reached for each in self.rotations), key=lambda x: abs(x - self.start))

    @property
    def angle(self) -> float:
        """All angles together [rad]."""
        return sum(each.angle for each in self.rotations)

    @property
    def drop(self) -> float:
        """Fall of the centroid in all [m]."""
        return sum(each.drop for each in self.rotations)

    @property
    def impact_speed(self) -> float:
        """Largest speed at which an end hits [m/s]; NaN: none does."""
        speeds = [each.impact_speed for each in self.rotations if each.arrested]
        return max(speeds, default=math.nan)

    @property
    def avoidable(self) -> float:
        """Avoidable parts of all angles [rad]."""
        return sum(each.avoidable for each in self.rotations)

    @property
    def inclinations(self) -> tuple[float, float]:
        """Smallest and largest inclination at which a rotation begins or ends [rad]."""
        each = [at for one in self.rotations for at in (one.start, one.reached)]
        return min(each), max(each)

    @property
    def theta_s(self) -> float:
        """Mean slope of the flight on which it stays, as driven [rad]; NaN: on none."""
        slopes = {each.theta_s for each in self.rotations}
        return slopes.pop() if len(slopes) == 1 else math.nan

    @property
    def beyond_slope(self) -> float:
        """How far its inclinations are off that slope at most [rad]; NaN: on no flight."""
        return max(abs(each - self.theta_s) for each in self.inclinations)

    @property
    def rocking(self) -> float:
        """What of all angles counts as rocking [rad]."""
        before, after = self.inclinations
        turn = self.avoidable
        return float(rocking(turn=turn, before=before, after=after, theta_s=self.theta_s))

    @property
    def obliged(self) -> bool:
        """Whether the path obliges to all of it, but for `ROCKING`."""
        free = self.angle - self.avoidable > _ROUNDING
        return self.arrested and self.rocking <= ROCKING and free

    @property
    def arrested(self) -> bool:
        """Whether the last one is arrested."""
        return self.rotations[-1].arrested

    @property
    def arrested_by(self) -> int | None:
        """Contact that arrests the last one."""
        return self.rotations[-1].arrested_by

    def spare(self, tilts: tuple[float, float]) -> float:
        """Least rise still to climb before it topples, less all drops so far [m].

        Positive if it would hold even though no impact took anything of the momentum. A tilt of
        gravity adds the way across it to what falls and takes it from what rises.

        tilts: of gravity, towards the trailing and the leading end that comes down [rad].
        """
        fallen = moved = 0.0  # the way towards the leading end
        each = []
        for one in self.rotations:
            ahead = 1.0 if one.leading_end_down else -1.0
            tilt = tilts[one.leading_end_down]
            fallen += one.drop
            moved += ahead * one.moved
            way = ahead * moved + one.ahead
            each.append(math.cos(tilt) * (one.rise - fallen) - math.sin(tilt) * way)
        return min(each)

    def spare_after_impact(self, tilts: tuple[float, float]) -> float:
        """Least rise still to climb less what a plastic impact leaves of the drop before [m]."""
        return min(one.spare_after_impact(tilts[one.leading_end_down]) for one in self.rotations)


def rotations_of(
    path: contact.Path,
    profile: Profile,
    phase: NDArray[np.str_],
    descending: bool,
    flat_length: float,
    acceleration: float,
) -> tuple[Rotation, ...]:
    """Rotations of a path in their order.

    phase: phase of each pose.
    flat_length: length of the flat [m].
    acceleration: along the path [m/s^2].
    """
    found = []
    on_flights = slopes_of_flights(profile, flat_length)
    for record, speed in zip(path.rotations, contact.impact_speeds(path).tolist(), strict=True):
        row = path.row_before(record.s)
        psi = float(path.poses.path_direction[row])
        ahead, up = acceleration * math.cos(psi), STANDARD_GRAVITY + acceleration * math.sin(psi)
        gravity = math.hypot(ahead, up)
        start, end = record.start, record.end
        drop = (up * (start.z - end.z) + ahead * (start.x - end.x)) / gravity
        down = record.sense < 0
        towards = 1.0 if down else -1.0
        moved = towards * (up * (end.x - start.x) - ahead * (end.z - start.z)) / gravity
        arrested_by, theta_s = None, math.nan
        if record.arrested:
            arrested_by = int((path.poses.front if down else path.poses.rear)[row + 1])
            theta_s = _slope_under(path.poses, row, on_flights)
        found.append(
            Rotation(
                phase=Phase(str(phase[row])),
                step=step_at(profile, float(path.poses.front_point[row, 0]), descending),
                path=record.s,
                start=start.inclination,
                reached=end.inclination,
                angle=record.angle,
                leading_end_down=down,
                drop=drop,
                moved=moved,
                impact_speed=speed,
                avoidable=_beyond_the_edge(record, profile, flat_length) if down else record.angle,
                theta_s=theta_s,
                pivot=record.pivot,
                arrested_by=arrested_by,
                rise=record.barrier / gravity,
                ahead=towards * record.barrier_across,
                left=record.kinetic / gravity,
            )
        )
    return tuple(found)


@lru_cache(maxsize=ROOMS)
def slopes_of_flights(profile: Profile, flat_length: float) -> tuple[Slope, ...]:
    """Where each flight of a profile begins and ends, and its mean slope [m, m, rad].

    Two nosings have but the slope of their chord, so that no mean is known.
    """
    each = []
    for first, last in flights_of(profile.nosings, flat_length):
        if last - first < 2:
            continue
        nosings = profile.nosings[first : last + 1]
        ends = float(nosings[0, 0]) - PLACE, float(nosings[-1, 0]) + PLACE
        each.append((*ends, mean_slope(nosings)))
    return tuple(each)


def _slope_under(poses: contact.Poses, row: int, on_flights: Sequence[Slope]) -> float:
    """Mean slope of the flight on which both contacts of a pose and of the next stand [rad]."""
    rear = poses.rear_point[row : row + 2, 0].min()
    front = poses.front_point[row : row + 2, 0].max()
    on = (slope for begin, end, slope in on_flights if begin <= rear and front <= end)
    return next(on, math.nan)


def chains_of(rotations: Sequence[Rotation], groups: Sequence[range]) -> tuple[Chain, ...]:
    """Rotations in chains, by their numbers; see `together`."""
    return tuple(Chain(tuple(rotations[k] for k in group)) for group in groups)


def together(rotations: Sequence[contact.RotationRecord], flat_length: float) -> list[range]:
    """Numbers of the rotations of each chain: between them the centroid hardly moves."""
    each = list(rotations)
    driven = [math.dist(one.end[:2], other.start[:2]) for one, other in pairwise(each)]
    breaks = [k for k, way in enumerate(driven, 1) if way > AT_ONCE * flat_length]
    ends = [0, *breaks, len(each)]
    return [range(one, two) for one, two in pairwise(ends) if two > one]


def _beyond_the_edge(
    rotation: contact.RotationRecord, profile: Profile, flat_length: float
) -> float:
    """How far the leading end goes below the line from the pivot to the next edge [rad].

    The line is the highest to an edge within the length of the flat, and never above that of the
    flat where the rotation begins. Nothing where there is no such edge.
    """
    x, z = rotation.pivot_point
    edges = profile.edges - (x, z)
    ahead = (edges[:, 0] > ROUGHNESS) & (np.hypot(edges[:, 0], edges[:, 1]) <= flat_length)
    edges = edges[ahead]
    if len(edges) == 0:
        return 0.0
    line = float(np.arctan2(edges[:, 1], edges[:, 0]).max())
    return max(min(line, rotation.start.inclination) - rotation.end.inclination, 0.0)
