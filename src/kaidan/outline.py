"""The robot seen from the side: the convex parts of its underside, in a posture, under a load.

The body frame has its origin at the centroid, x towards the nose, z normal to the track, up. Every
part is the convex hull of two discs: the main track (a stadium), a flipper (a tapered capsule),
the belly (a line).
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Self

import numpy as np
from numpy.typing import NDArray

from kaidan.contact import BELLY, FLIPPER, TRACK
from kaidan.mechanics.footprint import Footprint
from kaidan.robot import FlipperPair, Payload, Posture, Robot, Stance
from kaidan.robot.robot import IN_LINE, REMEMBERED
from kaidan.sheet import Itself

Array = NDArray[np.float64]
Disc = tuple[float, float, float]
"""x and z of its centre, radius [m]."""


@dataclass(frozen=True, eq=False)
class Outline:
    """Underside of a robot in a posture."""

    parts: Array
    """Shape (m, 6): x, z, radius of the one disc, x, z, radius of the other [m]."""
    kinds: NDArray[np.int64]
    """Shape (m,): `kaidan.contact.TRACK`, FLIPPER or BELLY."""
    stance: Stance
    """Flat length, centroid and mass that go with it."""
    stated_gyration: float | None
    """Radius of gyration about the lateral axis through the centroid [m]; None: the sheet gives no
    moment of inertia."""

    @property
    def gyration_estimated(self) -> bool:
        """Whether the radius of gyration is estimated."""
        return self.stated_gyration is None

    @cached_property
    def gyration(self) -> float:
        """Radius of gyration about the lateral axis through the centroid [m].

        Where the sheet gives none, that of an even box as long as the robot and twice as high as
        its centroid.
        """
        if self.stated_gyration is not None:
            return self.stated_gyration
        return math.hypot(sum(self.reach), 2 * self.stance.com_height) / math.sqrt(12.0)

    @property
    def least_gyration(self) -> float:
        """Radius of gyration to count on [m]: of an estimate, that of half the moment of inertia.

        Heavy parts in the middle make it less than that of an even box.
        """
        return self.gyration * (math.sqrt(0.5) if self.gyration_estimated else 1.0)

    @staticmethod
    def of(
        robot: Robot, posture: Posture | None = None, payload: Iterable[Payload] = ()
    ) -> "Outline":
        """Outline of a robot in a posture under its payload."""
        return outline_of(Itself(robot), posture or Posture(), *payload)

    @cached_property
    def discs(self) -> list[Disc]:
        """Discs of all parts, two of each, one after the other."""
        numbers = self.parts.ravel().tolist()
        return list(zip(numbers[::3], numbers[1::3], numbers[2::3], strict=True))

    @cached_property
    def reach(self) -> tuple[float, float]:
        """Distances from the centroid to the ends of the robot behind it and ahead of it [m]."""
        return -min(x - r for x, _, r in self.discs), max(x + r for x, _, r in self.discs)

    @cached_property
    def trail(self) -> float:
        """Largest distance of what lies behind the centroid, whatever the inclination [m]."""
        behind = (abs(complex(x, z)) + r for x, z, r in self.discs if x - r < 0.0)
        return max(behind, default=0.0)

    @cached_property
    def lead(self) -> float:
        """Largest distance ahead of the centroid of what may touch a level floor it stands on [m].

        A flipper that is pushed below the flat raises its end of the robot, and then reaches
        further ahead than in line with the floor.
        """
        ahead = self.reach[1]
        if min(z - r for _, z, r in self.discs) + self.stance.com_height >= -IN_LINE:
            return ahead
        low = (abs(complex(x, z)) + r for x, z, r in self.discs if x + r > 0.0 and z < 0.0)
        return max([ahead, *low])

    def turned_round(self) -> Self:
        """Outline with nose and tail swapped, x counting towards the tail."""
        swapped = self.parts[:, [3, 4, 5, 0, 1, 2]] * np.array([-1.0, 1.0, 1.0, -1.0, 1.0, 1.0])
        return replace(self, parts=swapped)


@lru_cache(maxsize=REMEMBERED)
def outline_of(itself: Itself[Robot], posture: Posture, *payload: Payload) -> Outline:
    """Outline of a robot, remembered: a search meets the same postures again and again."""
    robot = itself.sheet
    stance = robot.stance(posture, payload)
    front_tip = stance.com_from_front - stance.front_extension
    rear_tip = front_tip - robot.track.flat_length
    bottom = -stance.com_height
    discs = _main_track(robot, rear_tip, front_tip, bottom)
    kinds = [TRACK] * len(discs)
    ends = (
        ("rear", robot.rear_flippers, rear_tip, -1.0),
        ("front", robot.front_flippers, front_tip, 1.0),
    )
    for end, pair, tip, outward in ends:
        if pair is not None:
            discs.append(_flipper(pair, getattr(posture, end), tip, outward, bottom))
            kinds.append(FLIPPER)
    if robot.track.belly_clearance is not None:
        height = bottom + robot.track.belly_clearance
        discs.append((rear_tip, height, 0.0, front_tip, height, 0.0))
        kinds.append(BELLY)
    gyration = None
    if robot.inertia is not None and robot.mass is not None:
        gyration = math.sqrt(robot.inertia / robot.mass)
    parts, of_kinds = np.array(discs), np.array(kinds, dtype=np.int64)
    for array in (parts, of_kinds):
        array.flags.writeable = False
    return Outline(parts, of_kinds, stance, gyration)


def footprint_of(robot: Robot, outline: Outline) -> Footprint:
    """Rectangle that a robot covers in a posture, about its turning centre.

    Of unknown width (NaN) where the robot's sheet states none.
    """
    stance = outline.stance
    ahead = stance.com_from_front - stance.flat_length / 2
    if robot.turning_centre is not None:
        ahead = stance.com_from_front - stance.front_extension - robot.turning_centre
    behind, front = outline.reach
    return Footprint(front - ahead, behind + ahead, robot.overall_width)


def height_of(robot: Robot, outline: Outline) -> float:
    """Highest point above the underside in a posture [m]; NaN: the robot's sheet states none."""
    if robot.height is None:
        return math.nan
    discs = outline.parts.reshape(-1, 3)
    tops = discs[:, 1] + discs[:, 2] + outline.stance.com_height
    return max(robot.height, float(tops.max()))


def _main_track(robot: Robot, rear: float, front: float, bottom: float) -> list[tuple[float, ...]]:
    """Parts of the main track: the flat, or what a gap leaves of it, then raised nose and tail.

    The belt is the hull of a chain of wheels, so of its underside each two in turn are a part.
    """
    r_rear, r_front = robot.track.rear_radius, robot.track.front_radius
    tail, nose = (rear, bottom + r_rear, r_rear), (front, bottom + r_front, r_front)
    gap = robot.track.gap
    parts: list[tuple[float, ...]] = [(*tail, *nose)]
    if gap > 0:
        half = (front - rear - gap) / 2
        parts = [
            (*tail, rear + half, bottom + r_rear, r_rear),
            (front - half, bottom + r_front, r_front, *nose),
        ]
    raised = [
        (front - each.from_front, bottom + each.height, each.radius) for each in robot.track.wheels
    ]
    behind = sorted(disc for disc in raised if disc[0] < rear)
    ahead = sorted(disc for disc in raised if disc[0] > front)
    parts += [(*one, *two) for one, two in pairwise([*behind, tail])]
    parts += [(*one, *two) for one, two in pairwise([nose, *ahead])]
    return parts


def _flipper(
    pair: FlipperPair, wanted: float | str | None, tip: float, outward: float, bottom: float
) -> tuple[float, ...]:
    if wanted is None:
        angle = pair.stowed_angle
    else:
        angle = pair.flat_angle if isinstance(wanted, str) else wanted
    x, z = tip - outward * pair.pivot_inset, bottom + pair.pivot_height
    end = (x + outward * pair.length * math.cos(angle), z + pair.length * math.sin(angle))
    root = (x, z, pair.root_radius)
    if outward > 0:
        return (*root, *end, pair.tip_radius)
    return (*end, pair.tip_radius, *root)
