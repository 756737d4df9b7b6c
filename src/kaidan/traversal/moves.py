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

import numpy as np

from kaidan import contact
from kaidan.contact import FLIPPER, TRACK, Feature, Placement
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.modes import Facing, Phase
from kaidan.outline import Outline
from kaidan.robot import FlipperPair, Payload, Posture, Robot

TURN = math.radians(5.0)
"""Largest turn of a flipper from one pose to the next [rad]."""
SNAP = 2.0
"""Rotation of the robot from one pose to the next above which it rocks, over that turn [1]: a
flipper as long as the robot turns it as far as itself."""
_AHEAD = 1e-4
"""Way driven to have a pose with its margins [m]."""


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
    path: contact.Path
    """Has the pose alone."""


@dataclass(frozen=True)
class Move:
    """A change of posture while the robot stands."""

    before: Phase
    """Phase that it prepares."""
    turn: float
    """Largest angle by which a flipper turns [rad]."""
    seconds: float | None
    """Time by the flippers' largest speed [s]; None where it is not known."""
    poses: tuple[MovePose, ...]
    """The first as before, the last as after, or where it ends."""
    rocks: float
    """Largest rotation of the robot from one pose to the next, beyond what follows from the turn of
    the flippers [rad]."""
    stands: bool
    """Whether the robot stands in every pose."""
    spare_torque: float
    """Least torque that the sheet's largest leaves [N m]; NaN: one of the two is not known."""

    @property
    def required_friction(self) -> float:
        """Largest of any pose [1]."""
        return max((each.required_friction for each in self.poses), default=math.nan)

    @property
    def energy(self) -> float:
        """Smallest of any pose [m]."""
        return min((each.energy for each in self.poses), default=math.inf)

    @property
    def torque(self) -> float:
        """Largest of any pose and pair [N m]; NaN: the mass is not known."""
        each = [torque for pose in self.poses for torque in pose.torque.values()]
        return max(each, default=math.nan)

    @property
    def end(self) -> Placement:
        """Where it ends."""
        return self.poses[-1].place


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

    Parameters
    ----------
    robot : Robot
    one, two : Posture
    before : Phase
        Phase that it prepares.
    start : Placement
        Where the robot stands in the first posture, the leading end ahead.
    ground : array, shape (n, 2)
        Terrain as driven [m].
    payload : tuple of Payload
    facing : {"nose-first", "tail-first"}
        Which end leads.

    Returns
    -------
    Move
        A robot that does not stand on the way is an answer, not an error.
    """
    old = _outline(robot, one, payload, facing)
    place, stands, rocks, poses = start, True, 0.0, []
    turn = max((abs(new - was) for was, new, _ in _turns(robot, one, two)), default=0.0)
    allowed = SNAP * TURN
    for posture in (one, *_between(robot, one, two, math.ceil(turn / TURN)), two):
        new = _outline(robot, posture, payload, facing)
        found = _settled(ground, old, new, place)
        if found is None:
            stands = False
            break
        pose, old = _pose(robot, posture, new, found, facing), new
        rocks = max(rocks, abs(pose.place.inclination - place.inclination) - allowed)
        place = pose.place
        poses.append(pose)
    times = [
        abs(new - was) / pair.max_speed
        for was, new, pair in _turns(robot, one, two)
        if pair.max_speed is not None
    ]
    timed = len(times) == len(list(_turns(robot, one, two)))
    return Move(
        before=before,
        turn=turn,
        seconds=max(times, default=0.0) if timed else None,
        poses=tuple(poses),
        rocks=max(rocks, 0.0),
        stands=stands,
        spare_torque=_spare_torque(robot, poses),
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
        yield Posture(**angles, state=one.state)
    if count and one.state != two.state:
        yield two.model_copy(update={"state": one.state})


def _outline(
    robot: Robot, posture: Posture, payload: tuple[Payload, ...], facing: Facing
) -> Outline:
    outline = Outline.of(robot, posture, payload)
    return outline if facing == "nose-first" else outline.turned_round()


def _settled(
    ground: np.ndarray, old: Outline, new: Outline, place: Placement
) -> contact.Path | None:
    """Pose, with its margins, in which the tracks are where they were along; None: none is found.

    The middle of the tracks keeps its place along the ground, to first order in how far the robot
    turns.
    """
    phi = place.inclination
    track = place.x + _along(old, phi)
    for _ in range(2):
        x = track - _along(new, phi)
        settled = contact.settle(ground, new.parts, x, phi, kinds=new.kinds)
        if not settled.found:
            return None
        phi = settled.inclination
    path = contact.traverse(
        ground, new.parts, x, x + _AHEAD,
        kinds=new.kinds, inclination=phi, gyration=new.gyration, with_energy=False,
    )  # fmt: skip
    return path.first() if len(path.poses) else None


def _along(outline: Outline, phi: float) -> float:
    """Middle of the tracks ahead of the centroid along the ground [m]."""
    discs = outline.parts[outline.kinds == TRACK].reshape(-1, 3)[:, :2]
    x, z = discs.mean(axis=0)
    return float(math.cos(phi) * x - math.sin(phi) * z)


def _pose(
    robot: Robot, posture: Posture, outline: Outline, path: contact.Path, facing: Facing
) -> MovePose:
    assert path.margins is not None
    friction = float(path.margins.required_friction[0])
    angles = angles_of(robot, posture)
    return MovePose(
        front=angles.get("front"),
        rear=angles.get("rear"),
        place=path.poses.placement(0),
        required_friction=friction if math.isfinite(friction) else math.inf,
        energy=float(path.energy([0])[0][0]),
        torque=_torques(robot, angles, outline, path, facing),
        outline=outline,
        path=path,
    )


def _torques(
    robot: Robot, angles: dict[str, float], outline: Outline, path: contact.Path, facing: Facing
) -> dict[str, float]:
    """Torque that holds each pair: of the contact that it carries, and of its own weight."""
    mass, place = outline.stance.mass, path.poses.placement(0)
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
    carrying = path.carrying(0)
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


def _spare_torque(robot: Robot, poses: list[MovePose]) -> float:
    spare = [
        pair.max_torque - pose.torque[end]
        for pose in poses
        for end, pair in robot.flippers().items()
        if pair.max_torque is not None and end in pose.torque
    ]
    return min(spare, default=math.nan)
