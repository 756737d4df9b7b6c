"""Turning on landings: in the posture of the climb, else in another one that does."""

import math
from collections.abc import Iterator

import numpy as np

from kaidan.mechanics.footprint import walls_of
from kaidan.mechanics.turning import Goal
from kaidan.models.clearance import KEPT
from kaidan.models.landings import LANE, Room, Turned, shown, turned
from kaidan.outline import Outline, footprint_of
from kaidan.readers.building import SAME_FLOOR, WALL, Building, Flight, Floor
from kaidan.readers.estimate import STRAIGHT_ON
from kaidan.readers.kinds import Array
from kaidan.robot import Posture, Robot
from kaidan.verbs.building.answer import TurnShown


def turn_on(
    building: Building, robot: Robot, before: Flight, after: Flight, flippers: str
) -> TurnShown:
    """How a robot gets from one flight onto the next on the landing between them."""
    turn = math.remainder(after.estimate.heading - before.estimate.heading, 2 * math.pi)
    floor = building.floors[before.upper]
    tried = [
        (name, footprint_of(robot, Outline.of(robot, Posture.parse(name, robot))))
        for name in _postures(robot, flippers)
    ]
    (climbing, footprint), *_ = tried
    found = Turned("straight", False, climbing, footprint, None, None)
    if abs(turn) >= STRAIGHT_ON:
        found = turned(tried, _room(building, floor, before, after) if floor.outlines else None)
    footprint = found.footprint
    return TurnShown(
        robot=robot.name,
        floor=floor.key,
        from_flight=before.identity,
        to_flight=after.identity,
        path=[tuple(pose) for pose in found.path.poses.tolist()] if found.path else (),
        footprint=tuple(footprint) if math.isfinite(footprint.width) else None,
        **shown(found, climbing, turn, robot),
    )


def _postures(robot: Robot, flippers: str) -> Iterator[str]:
    """Posture of the climb, then the shorter ones that the robot has."""
    climbing = (flippers.rpartition("/")[2].rpartition(":")[2]) or "stowed"
    yield climbing
    if robot.flippers() and climbing != "stowed":
        yield "stowed"


def _room(building: Building, floor: Floor, before: Flight, after: Flight) -> Room:
    """Room on a landing from the head of one flight to the foot of the next."""
    landing = max(floor.outlines, key=_area)
    standing = np.vstack([floor.walls, *_leaves(building, floor, landing)])
    ahead = _ahead(before.estimate.heading)
    edge = float(before.estimate.middle[-1, :2] @ ahead)
    start = before.lane[1:3].mean(axis=0)
    start = start + (edge - float(start @ ahead)) * ahead
    foot = after.lane[[0, 3]].mean(axis=0)
    goal = Goal(float(foot[0]), float(foot[1]), after.estimate.heading, float(after.estimate.width))
    return Room(
        start=(float(start[0]), float(start[1]), before.estimate.heading),
        level=False,
        goal=goal,
        landing=landing,
        inside=np.vstack([walls_of(landing), standing]),
        walls=np.vstack([_sides(landing, before), standing]),
        kept=_beyond(landing, ahead, edge + KEPT),
    )


def _leaves(building: Building, floor: Floor, landing: Array) -> Iterator[Array]:
    """Sides of what the leaves of doors sweep of a landing, taken as rectangles, shape (3, 4)."""
    low, high = landing.min(axis=0), landing.max(axis=0)
    for door in building.doors:
        middle, near = np.array([door.x, door.y]), door.leaf + WALL
        if not (door.leaf > 0.0 and abs(door.level - floor.level) < SAME_FLOOR):
            continue
        if (middle < low - near).any() or (middle > high + near).any():
            continue
        opens = np.array(door.opens)
        half = door.width / 2 * np.array([-opens[1], opens[0]])
        for way in (opens, -opens) if door.both else (opens,):
            out = middle + door.leaf * way
            corners = [middle - half, out - half, out + half, middle + half]
            yield np.hstack([corners[:-1], corners[1:]])


def _area(outline: Array) -> float:
    x, y = outline.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def _ahead(heading: float) -> Array:
    return np.array([math.cos(heading), math.sin(heading)])


def _sides(landing: Array, before: Flight) -> Array:
    """Sides of the landing, but for the one across the flight below, and sides of its lane."""
    foot_right, head_right, head_left, _ = before.lane
    ahead = _ahead(before.estimate.heading)
    across = np.array([-ahead[1], ahead[0]])
    low, high = sorted(float(each @ across) for each in (head_right, head_left))
    end = float((before.estimate.middle[-1, :2]) @ ahead)
    walls: list[Array] = []
    for a, b in zip(landing, np.roll(landing, -1, axis=0), strict=True):
        walls += _outside(a, b, ahead, across, low, high, end)
    length = min(LANE, float(np.linalg.norm(head_right - foot_right)))
    walls += [np.hstack([corner - length * ahead, corner]) for corner in (head_right, head_left)]
    return np.array(walls)


def _outside(
    a: Array, b: Array, ahead: Array, across: Array, low: float, high: float, end: float
) -> Iterator[Array]:
    """Parts of a side of the landing that do not lie in the mouth of the flight below."""
    near = max(abs(float(each @ ahead) - end) for each in (a, b)) < 0.1
    t_a, t_b = float(a @ across), float(b @ across)
    if not near or abs(t_b - t_a) < 1e-9:
        yield np.hstack([a, b])
        return
    for left, right in ((-math.inf, low), (high, math.inf)):
        s0, s1 = sorted((each - t_a) / (t_b - t_a) for each in (left, right))
        s0, s1 = max(0.0, s0), min(1.0, s1)
        if s1 - s0 > 1e-9:
            yield np.hstack([a + s0 * (b - a), a + s1 * (b - a)])


def _beyond(outline: Array, ahead: Array, distance: float) -> Array:
    """Part of an outline that lies ahead of a line across a direction."""
    off = outline @ ahead - distance
    found = []
    for k, (a, b) in enumerate(zip(outline, np.roll(outline, -1, axis=0), strict=True)):
        one, two = off[k], off[(k + 1) % len(off)]
        if one >= 0:
            found.append(a)
        if (one >= 0) != (two >= 0):
            found.append(a + one / (one - two) * (b - a))
    return np.array(found) if len(found) > 2 else outline[:0]
