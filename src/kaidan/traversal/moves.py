r"""A change of posture between two parts of a traverse: the robot stands, flippers and arm move.

::

      before          on the way: the flippers turn together, a few degrees at a time, and the robot
        o  o  o       settles anew with its tracks where they are; then an arm or payload moves
    ---------------   after: the pose from which the next part of the traverse is driven

Quasi-static: each pose on the way is a stable one, next to the one before it. A robot that finds
no such pose rotates although nobody drives it.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from kaidan import contact
from kaidan.contact import FLIPPER, Feature, Placement
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.modes import Facing, Phase
from kaidan.outline import Outline
from kaidan.robot import FlipperPair, Payload, Posture, Robot
from kaidan.traversal.drift import drift

BEHIND = 0.01
"""How much farther back than meant it may have stopped besides [m]."""
TURN = math.radians(5.0)
"""Largest turn of a flipper from one pose to the next [rad]."""
SNAP = 2.0
"""Rotation of the robot from one pose to the next above which it rocks, over that turn [1]: a
flipper as long as the robot turns it as far as itself."""


@dataclass(frozen=True)
class MovePose:
    """A pose on the way from one posture to the next."""

    front: float | None
    """Angle of the front flippers [rad]; None without a pair."""
    rear: float | None
    """Angle of the rear flippers [rad]; None without a pair."""
    place: Placement
    required_friction: float
    """[1]; infinite: none is enough."""
    energy: float
    """Rise of the centroid that a rotation needs, to the side that needs less [m]."""
    torque: dict[str, float]
    """Torque about the pivot of each pair, front and rear [N m]; none of an unknown mass."""
    outline: Outline
    """As it stands, x towards the leading end."""


@dataclass(frozen=True)
class Move:
    """A change of posture while the robot stands."""

    robot: Robot
    facing: Facing
    """Which end leads."""
    before: Phase
    """Phase that it prepares."""
    turn: float
    """Largest angle by which a flipper turns [rad]."""
    seconds: float | None
    """Time by the flippers' largest speed [s]; None where it is not known."""
    postures: tuple[Posture, ...]
    """On the way: the first as before, the last as after."""
    outlines: tuple[Outline, ...]
    """In each posture, x towards the leading end."""
    path: contact.Path
    """A pose for each posture, up to the last in which it stands."""
    rocks: float
    """Largest rotation of the robot from one pose to the next, beyond what follows from the turn of
    the flippers [rad]."""

    @property
    def stands(self) -> bool:
        """Whether the robot stands in every pose."""
        return len(self.path.poses) == len(self.postures)

    @cached_property
    def poses(self) -> tuple[MovePose, ...]:
        """The first as before, the last as after, or where it ends."""
        return tuple(self._pose(row) for row in range(len(self.path.poses)))

    @property
    def required_friction(self) -> float:
        """Largest of any pose [1]; NaN: it stands in none."""
        if not len(self.path.poses):
            return math.nan
        assert self.path.margins is not None
        required = self.path.margins.required_friction
        return float(np.where(np.isfinite(required), required, np.inf).max())

    @property
    def energy(self) -> float:
        """Smallest of any pose [m]."""
        assert self.path.margins is not None
        return float(self.path.margins.energy.min(initial=math.inf))

    def tilt(self, side: float) -> float:
        """Tilt of gravity at which it rotates about its outermost contact on the way [rad].

        side, {1.0, -1.0}: back or front.

        Infinite where that is no less than before and after, which the traverse tells.
        """
        poses = self.path.poses
        outermost = poses.rear_point if side > 0 else poses.front_point
        off_x = side * (self.path.x - outermost[:, 0])
        tilts = np.arctan2(off_x, self.path.z - outermost[:, 1])
        if len(tilts) < len(self.postures) or tilts.min() >= min(tilts[0], tilts[-1]):
            return math.inf
        return float(tilts.min())

    @property
    def torque(self) -> float:
        """Largest of any pose and pair [N m]; NaN: the mass is not known."""
        each = [torque for pose in self.poses for torque in pose.torque.values()]
        return max(each, default=math.nan)

    @property
    def spare_torque(self) -> float:
        """Least torque that the sheet's largest leaves [N m]; NaN: one of the two is not known."""
        largest = {
            end: pair.max_torque
            for end, pair in self.robot.flippers().items()
            if pair.max_torque is not None
        }
        if not largest:
            return math.nan
        spare = [
            most - pose.torque[end]
            for pose in self.poses
            for end, most in largest.items()
            if end in pose.torque
        ]
        return min(spare, default=math.nan)

    @cached_property
    def drift(self) -> float:
        """How far behind the last pose it may stand, as one contact slides or the other [m]."""
        return drift(self.path)

    @property
    def end(self) -> Placement:
        """Where it ends, as far back as it may."""
        drawn = self.path.poses.placement(-1)
        return drawn._replace(x=drawn.x - self.drift - BEHIND)

    def _pose(self, row: int) -> MovePose:
        assert self.path.margins is not None
        angles = angles_of(self.robot, self.postures[row])
        friction = float(self.path.margins.required_friction[row])
        return MovePose(
            front=angles.get("front"),
            rear=angles.get("rear"),
            place=self.path.poses.placement(row),
            required_friction=friction if math.isfinite(friction) else math.inf,
            energy=float(self.path.margins.energy[row]),
            torque=_torques(self.robot, angles, self.outlines[row], self.path, row, self.facing),
            outline=self.outlines[row],
        )


def move(
    robot: Robot,
    one: Posture,
    two: Posture,
    *,
    before: Phase,
    start: Placement,
    ground: np.ndarray,
    payload: tuple[Payload, ...] = (),
    facing: Facing = "nose-first",
) -> Move:
    """Move from one posture to another.

    ground, shape (n, 2): terrain as driven [m].
    facing, {"nose-first", "tail-first"}: which end leads.

    A robot that does not stand on the way is an answer, not an error.
    """
    turns = list(_turns(robot, one, two))
    turn = max((abs(new - was) for was, new, _ in turns), default=0.0)
    postures = (one, *_between(robot, one, two, math.ceil(turn / TURN)), two)
    outlines = [_outline(robot, each, payload, facing) for each in postures]
    path = contact.stand_in_turn(
        ground,
        [each.parts for each in outlines],
        outlines[0].kinds,
        start.x,
        start.inclination,
    )
    inclinations = np.concatenate([[start.inclination], path.inclination])
    rocks = float(np.abs(np.diff(inclinations)).max(initial=0.0)) - SNAP * TURN
    times = [
        abs(new - was) / pair.max_speed for was, new, pair in turns if pair.max_speed is not None
    ]
    return Move(
        robot=robot,
        facing=facing,
        before=before,
        turn=turn,
        seconds=max(times, default=0.0) if len(times) == len(turns) else None,
        postures=postures,
        outlines=tuple(outlines),
        path=path,
        rocks=max(rocks, 0.0),
    )


def angles_of(robot: Robot, posture: Posture) -> dict[str, float]:
    """Angle of each pair of flippers of a posture, words turned into numbers [rad]."""
    angles = {}
    for end, pair in robot.flippers().items():
        at = getattr(posture, end)
        if at is None:
            angles[end] = pair.stowed_angle
        else:
            angles[end] = pair.flat_angle if isinstance(at, str) else float(at)
    return angles


def _turns(robot: Robot, one: Posture, two: Posture) -> Iterator[tuple[float, float, FlipperPair]]:
    """Angle before and after of each pair that turns."""
    was, new = angles_of(robot, one), angles_of(robot, two)
    for end, pair in robot.flippers().items():
        if was[end] != new[end]:
            yield was[end], new[end], pair


def _between(robot: Robot, one: Posture, two: Posture, count: int) -> Iterator[Posture]:
    """Postures on the way: all flippers turn together, in the state before."""
    was, new = angles_of(robot, one), angles_of(robot, two)
    for k in range(1, count):
        angles = {end: was[end] + (new[end] - was[end]) * k / count for end in was}
        yield one.model_copy(update=angles)
    if count and one.state != two.state:
        yield two.model_copy(update={"state": one.state})


def _outline(
    robot: Robot, posture: Posture, payload: tuple[Payload, ...], facing: Facing
) -> Outline:
    outline = Outline.of(robot, posture, payload)
    return outline if facing == "nose-first" else outline.turned_round()


def _torques(
    robot: Robot,
    angles: dict[str, float],
    outline: Outline,
    path: contact.Path,
    at: int,
    facing: Facing,
) -> dict[str, float]:
    """Torque that holds each pair: of the contact that it carries, and of its own weight."""
    mass, place = outline.stance.mass, path.poses.placement(at)
    if mass is None:
        return {}
    c, s = math.cos(place.inclination), math.sin(place.inclination)
    pairs = list(robot.flippers())
    rows = np.flatnonzero(outline.kinds == FLIPPER).tolist()  # rear first, as the outline has them
    ends = dict(zip(rows, sorted(pairs, key=("rear", "front").index), strict=True))
    own = {
        end: pair.mass * STANDARD_GRAVITY * pair.com_from_pivot
        for end, pair in robot.flippers().items()
    }
    torque = {end: abs(own[end] * math.cos(angles[end])) for end in pairs}
    carrying = path.carrying(at)
    _, n_1, t_1, n_2, t_2 = contact.pair_forces(
        *carrying, (place.x, place.z), (0.0, STANDARD_GRAVITY)
    )
    for each, load, traction in zip(carrying, (n_1, n_2), (t_1, t_2), strict=True):
        row = Feature.of(each.feature).part
        end = ends.get(row)
        if end is None:
            continue
        # the pivot is the inner disc: the first of the front pair, the second of the rear one
        first = (end == "front") == (facing == "nose-first")
        b_x, b_z = outline.parts[row, :2] if first else outline.parts[row, 3:5]
        arm_x = each.point[0] - (place.x + c * b_x - s * b_z)
        arm_z = each.point[1] - (place.z + s * b_x + c * b_z)
        n_x, n_z = each.normal
        force_x, force_z = load * n_x + traction * n_z, load * n_z - traction * n_x
        torque[end] += abs(mass * (arm_x * force_z - arm_z * force_x))
    return torque
