"""What the contact model says of one passage, up or down: phases, rotations, falls, margins."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.mechanics.rearing import rear_length_margin
from kaidan.outline import Outline
from kaidan.terrain.profile import Profile
from kaidan.traversal.criterion import Criterion, Tread
from kaidan.traversal.driving import way
from kaidan.traversal.events import TraverseEvent, traverse_events
from kaidan.traversal.extremes import PhaseExtremes, phase_extremes, rises_about_stays
from kaidan.traversal.grip import Grip
from kaidan.traversal.nosing_events import nosing_events
from kaidan.traversal.phases import ROOMS, Phase, phases_of, step_at
from kaidan.traversal.rotations import Chain, Rotation, chains_of, rotations_of, together
from kaidan.traversal.samples import trailing_end_leaves
from kaidan.traversal.static_criterion import flights_of
from kaidan.traversal.tilting import LARGEST, Fall, largest_survived

_OF_FALLS = {"falls_downhill", "falls_uphill", "_limiting_fall"}
"""What depends on the tilts that count."""
_ALIKE = 1e-6
"""Tilt that is rounding [rad]."""
_EVEN = 1e-9
"""Difference of steps that is rounding [m]."""
_BESIDE = math.radians(0.01)
"""Tilt beyond the largest that is survived, at which it is seen where the robot falls [rad]."""


class FirstRock(NamedTuple):
    """Where the least tilt of gravity makes the robot rotate by more than rocking."""

    margin: float
    """That tilt [rad]; negative: it rotates without any."""
    phase: Phase
    step: int
    """Nosing at which, counted from the bottom."""


@dataclass(frozen=True)
class Traverse:
    """What the contact model says of one passage; see `traverse`."""

    status: contact.Status
    descending: bool
    profile: Profile
    """As driven: reflected when descending."""
    outline: Outline
    """As driven: x towards the leading end."""
    acceleration: float
    """Along the path [m/s^2]."""
    path: contact.Path
    """Poses, events and rotations as numbers."""
    tread: Tread
    """Underside on the flight."""
    criterion: Criterion
    """The paper's criterion of no rotation (grade one), on nosings as they are; it judges where
    `whole`."""
    whole: bool
    """Whether one flat carries all along on the flight, so that the criterion judges there; else
    every pose is judged."""
    phase_of_pose: NDArray[np.str_]
    """Phase of each pose of the path."""
    start: contact.Placement | None
    """Where a part of the traverse begins; None: before the flight."""
    until: float | None
    """Where the centroid ends [m]; None: beyond the flight."""
    step: float
    """Arclength between poses [m]."""
    sought: tuple[float, ...] | None
    """Tilts of which alone it counts whether a fall is beyond them, nor where it is [rad]; None:
    the tilt to the fall is found."""
    enough: float = math.inf
    """Tilt of which it does not count how far a fall is beyond it [rad]."""

    def seeking(
        self, sought: tuple[float, ...] | None = None, *, enough: float = math.inf
    ) -> "Traverse":
        """Same traverse of which something else counts; what was worked out stays known."""
        other = replace(self, sought=sought, enough=enough)
        _ = self._survives  # which tilts it survives does not depend on it
        known = vars(self).keys() - vars(other).keys() - _OF_FALLS
        vars(other).update((name, vars(self)[name]) for name in known)
        return other

    @cached_property
    def phases(self) -> tuple[PhaseExtremes, ...]:
        """Extreme figures of each phase; none of a path without margins."""
        if self.path.margins is None:
            return ()
        rises = rises_about_stays(self.criterion, self.descending) if self.whole else ()
        return phase_extremes(
            self.path, self.profile, self.phase_of_pose, self.descending, self.acceleration,
            rises, self.outline, self.whole,
        )  # fmt: skip

    @cached_property
    def events(self) -> tuple[TraverseEvent, ...]:
        """Events of the path, and nosings that the flat reaches and leaves in between."""
        records = self.path.events.merged(nosing_events(self.path))
        return traverse_events(
            self.path, records, self.profile, self.phase_of_pose, self.descending
        )

    @cached_property
    def rotations(self) -> tuple[Rotation, ...]:
        """Rotations in their order, of every phase."""
        return rotations_of(
            self.path,
            self.profile,
            self.phase_of_pose,
            self.descending,
            self.outline.stance.flat_length,
            self.acceleration,
        )

    @cached_property
    def chains(self) -> tuple[Chain, ...]:
        """Rotations that follow one another at once, as a whole."""
        return chains_of(
            self.rotations, together(self.path.rotations, self.outline.stance.flat_length)
        )

    @cached_property
    def grip(self) -> Grip:
        """What friction and grousers make of its contacts."""
        return Grip(self.path, descending=self.descending, acceleration=self.acceleration)

    @cached_property
    def comes_off(self) -> NDArray[np.bool_]:
        """Poses at which the trailing end leaves the last edges as the robot lands.

        Without the friction that they require it slides down, the way it is going.
        """
        landing = self.phase_of_pose == Phase.LAND.value
        return np.asarray(trailing_end_leaves(self.path) & landing)

    @cached_property
    def falls_downhill(self) -> Fall:
        """Tilt of gravity to the fall over the downhill end."""
        return self._fall(downhill=True)

    @cached_property
    def falls_uphill(self) -> Fall:
        """Tilt of gravity to the fall over the uphill end."""
        return self._fall(downhill=False)

    @cached_property
    def _limiting_fall(self) -> Fall:
        """Fall over the downhill end that no tilt to the first rock exceeds."""
        least = min(one.margin for one in self._rocks(downhill=True, of=self.phases))
        if math.isinf(self.falls_downhill.tilt) and least > LARGEST:
            return self._fall(downhill=True, most=_most(least))
        return self.falls_downhill

    @cached_property
    def _survives(self) -> dict[float, bool]:
        """Whether it survives tilts that were tried, backward positive [rad]."""
        return {0.0: self.arrived}

    @property
    def _manner(self) -> dict[str, Any]:
        there = way(self.profile, self.outline, self.start, self.until)
        return {**there, "acceleration": self.acceleration, "step": self.step}

    def _survived(self, back: float, sought: Sequence[float] | None, most: float) -> float:
        """Largest tilt that it survives, back or front, see `largest_survived` [rad]."""
        manner, known = self._manner, self._survives

        def survives(tilt: float) -> bool:
            if back * tilt not in known:
                known[back * tilt] = contact.arrives(**manner, tilt=back * tilt)
            return known[back * tilt]

        return largest_survived(survives, sought=sought, enough=self.enough, most=most)

    def _falls_beyond(self, tilt: float) -> bool:
        """Whether no tilt up to one that counts makes it fall over its downhill end [rad]."""
        tilt = min(tilt, self.enough)
        if self.sought is not None:
            tilt = min(tilt, max(self.sought))
        back = -1.0 if self.descending else 1.0
        return self._survived(back, (tilt,), _most(tilt)) > tilt

    def _fall(self, *, downhill: bool, most: float = LARGEST) -> Fall:
        back = 1.0 if downhill is not self.descending else -1.0
        tilt = self._survived(back, self.sought, most)
        if self.sought is not None or self.enough <= tilt < math.inf:
            return Fall(tilt, *self.end)
        fallen = self.path
        fatal = [abs(each) for each, survives in self._survives.items()
                 if not survives and each * back > 0.0]  # fmt: skip
        if self.arrived and fatal and math.isfinite(tilt):
            # of steps that are alike the first: all of them fall a little beyond
            for beyond in (tilt + _BESIDE, min(fatal)):
                fallen = contact.traverse(**self._manner, tilt=back * beyond, with_margins=False)
                if fallen.status is not contact.Status.OK:
                    break
        if len(fallen.poses) == 0:
            return Fall(tilt, Phase.ENTER, 0)
        phase = phases_of(fallen, self.profile, self.descending, self.outline.stance.flat_length)
        front = float(fallen.poses.front_point[-1, 0])
        return Fall(tilt, Phase(str(phase[-1])), step_at(self.profile, front, self.descending))

    @property
    def end(self) -> tuple[Phase, int]:
        """Phase and step at which the traverse ends."""
        front = float(self.path.poses.front_point[-1, 0])
        step = step_at(self.profile, front, self.descending)
        return Phase(str(self.phase_of_pose[-1])), step

    @property
    def holds(self) -> bool | None:
        """Grade one: nothing rotates on the flight by more than rocking; None: it has no flight."""
        if self.whole:
            return self.criterion.holds
        ways = [self.first_rock(downhill=side, phases=self._on_flight) for side in (True, False)]
        known = [one.margin > 0 for one in ways if one is not None]
        return all(known) if known else None

    @property
    def _on_flight(self) -> tuple[PhaseExtremes, ...]:
        return tuple(each for each in self.phases if each.phase is Phase.TRAVERSE)

    @cached_property
    def rear_length(self) -> tuple[float, float] | None:
        """Margin against being driven upright on its tail, and the riser of which it is least [m].

        None going down or without risers.
        """
        if self.descending or len(self.profile.nosings) == 0:
            return None
        at = self.tread
        return _rear_length(self.profile, at.L - at.C_L, at.R_downhill, at.C_N)

    @property
    def arrived(self) -> bool:
        """Grade two: the whole robot stands on the other landing."""
        return self.status is contact.Status.OK

    @property
    def arrested_with_momentum(self) -> bool:
        """Grade three: no rotation topples with the momentum gained."""
        return self.path.arrives_with_momentum

    @property
    def downhill_margin(self) -> float:
        """Margin of slope against turning about the lowest contact that stays [rad]; NaN: none."""
        return self._rock_margin(downhill=True)

    def _rock_margin(self, *, downhill: bool) -> float:
        found = self.first_rock(downhill=downhill)
        return math.nan if found is None else found.margin

    @property
    def over_landing(self) -> Phase:
        """Phase in which nosings are lost with the uphill end over the upper landing."""
        return Phase.ENTER if self.descending else Phase.LAND

    @property
    def part(self) -> tuple[float, float]:
        """Part of the flight that it is over, by the place of the centroid, uphill positive [m]."""
        first = -math.inf if self.start is None else self.start.x
        last = math.inf if self.until is None else self.until
        return (-last, -first) if self.profile.falls else (first, last)

    def first_rock(
        self, *, downhill: bool, phases: tuple[PhaseExtremes, ...] | None = None
    ) -> FirstRock | None:
        """Least tilt of gravity at which it rotates towards one end, of all or of some phases.

        On the flight the criterion on nosings judges a flat that carries all along, else the poses
        do, as they do entering and landing. None: nothing was looked at.
        """
        of = self.phases if phases is None else phases
        each = self._rocks(downhill=downhill, of=of)
        least = min((one.margin for one in each), default=math.inf)
        may_fall = each and downhill and self.arrived and self._may_fall_first
        if may_fall and not self._falls_beyond(least + _ALIKE):
            # it rocks no later than it falls
            fall = self._limiting_fall
            if phases is None or any(one.phase is fall.phase for one in of):
                each.append(FirstRock(fall.tilt, fall.phase, fall.step))
                least = min(least, fall.tilt)
        # of those that are alike the first: a pose between two phases is of both
        return next((one for one in each if one.margin < least + _ALIKE), None)

    def _rocks(self, *, downhill: bool, of: tuple[PhaseExtremes, ...]) -> list[FirstRock]:
        """Least tilts of the criterion's losses and of the poses in some phases."""
        each = []
        judged = ((False, Phase.TRAVERSE), (True, self.over_landing)) if self.whole else ()
        for landing, phase in judged:
            worst = self.criterion.smallest(downhill=downhill, landing=landing)
            counts = of is self.phases or any(one.phase is phase for one in of)
            if counts and worst is not None:
                each.append(FirstRock(worst.margin, phase, worst.nosing + 1))
        for one in of:
            found = one.tilt_downhill if downhill else one.tilt_uphill
            if math.isfinite(found[0]):
                each.append(FirstRock(found[0], one.phase, found[1]))
        return each

    @cached_property
    def _may_fall_first(self) -> bool:
        """Whether it may fall before the first rock that is found.

        So it may where steps differ, where the first riser is higher than the others, where no flat
        carries or a step is longer than it, and down over the edge of a landing
        (docs/theory/rocking.md).
        """
        if len(self.profile.nosings) < 2:
            return False
        return not self.whole or self.descending or _is_uneven(self.profile, self.tread.L)

    @property
    def centroid_margin(self) -> float:
        """How far the centroid may move along the flat before it turns [m]; NaN: no criterion."""
        if not self.whole:
            return math.nan
        return min((each.centroid for each in self.criterion.losses), default=math.nan)


@lru_cache(maxsize=ROOMS)
def _is_uneven(profile: Profile, room: float) -> bool:
    """Whether steps differ, the first riser is the highest, or a step is as long as the flat."""
    nosings = profile.nosings
    on = sum(last - first + 1 for first, last in flights_of(nosings, room))
    steps = np.diff(nosings, axis=0)
    uneven = bool(np.ptp(steps, axis=0).max() > _EVEN)
    first = float(nosings[0, 1] - profile.points[0, 1])
    return on < len(nosings) or uneven or first > float(steps[:, 1].max()) + _EVEN


@lru_cache(maxsize=ROOMS)
def _rear_length(profile: Profile, behind: float, R: float, C_N: float) -> tuple[float, float]:
    """Margin against being driven upright, the centroid so far ahead of the tail; and the riser."""
    each = np.diff(profile.nosings[:, 1], prepend=profile.points[0, 1]).round(12)
    rises = np.array(sorted({*each.tolist()}))
    margins = rear_length_margin(b=behind, h=rises, R=R, C_N=C_N)
    worst = int(np.argmin(margins))
    return float(margins[worst]), float(rises[worst])


def _most(tilt: float) -> float:
    """Largest tilt to try, so that a robot which rocks no earlier than at `tilt` is tried [rad]."""
    return min(max(tilt, LARGEST), math.pi / 2)
