"""Turning on landings: in the posture of the climb, else in another one that does."""

import math
from collections.abc import Iterator

import numpy as np

from kaidan.mechanics.clearance import spin_circle
from kaidan.mechanics.turning import (
    Footprint,
    Goal,
    Manoeuvre,
    inscribed_circle,
    manoeuvre,
    walls_of,
)
from kaidan.outline import Outline, footprint_of
from kaidan.readers.building import Building, Flight
from kaidan.readers.kinds import Array
from kaidan.robot import Posture, Robot
from kaidan.verbs.building.answer import TurnShown, TurnWay

STRAIGHT_ON = math.radians(15.0)
"""Angle between two flights up to which the robot goes straight on [rad]."""
KEPT = 0.1
"""Distance that the turning centre keeps from the flight below while it turns [m]: the centroid may
lie behind it, and beyond the nosing the robot would tip back down."""
LANE = 1.5
"""Length of the flight over which the robot's tail may still hang [m]."""


def turn_on(
    building: Building, robot: Robot, before: Flight, after: Flight, flippers: str
) -> TurnShown:
    """How a robot gets from one flight onto the next on the landing between them.

    Parameters
    ----------
    building : Building
    robot : Robot
    before, after : Flight
        The flight below and the one above.
    flippers : str
        Posture in which it climbs, as the option is written; a plan counts with its last part.
    """
    turn = math.remainder(after.estimate.heading - before.estimate.heading, 2 * math.pi)
    floor = building.floors[before.upper]
    tried = [
        (name, footprint_of(robot, Outline.of(robot, Posture.parse(name, robot))))
        for name in _postures(robot, flippers)
    ]
    name, footprint = tried[0]
    room: float | None = None
    way: TurnWay = "unknown"
    found: Manoeuvre | None = None
    if abs(turn) < STRAIGHT_ON:
        way = "straight"
    elif floor.outlines and math.isfinite(footprint.width):
        landing = max(floor.outlines, key=lambda one: _area(one))
        walls = np.vstack([_room(landing, before), floor.walls])
        room = float(2 * inscribed_circle(np.vstack([walls_of(landing), floor.walls]), landing)[2])
        way = "none"
        for posture, covered in tried:
            spins = _circle(covered) <= room
            found = None if spins else _driven(covered, before, after, landing, walls)
            if spins or found is not None:
                way = "spin" if spins else "manoeuvre"
                name, footprint = posture, covered
                break
    circle = _circle(footprint)
    return TurnShown(
        robot=robot.name,
        floor=floor.key,
        from_flight=before.identity,
        to_flight=after.identity,
        turn_deg=math.degrees(turn),
        way=way,
        flippers=name if robot.flippers() else "",
        changed=name != tried[0][0],
        circle_m=circle,
        room_m=room,
        moves=found.moves if found else 0,
        path=[tuple(pose) for pose in found.poses.tolist()] if found else (),
        footprint=tuple(footprint) if math.isfinite(footprint.width) else None,
    )


def _postures(robot: Robot, flippers: str) -> Iterator[str]:
    """Posture of the climb, then the shorter ones that the robot has."""
    climbing = (flippers.rpartition("/")[2].rpartition(":")[2]) or "stowed"
    yield climbing
    if robot.flippers() and climbing != "stowed":
        yield "stowed"


def _circle(footprint: Footprint) -> float:
    return float(spin_circle(front=footprint.front, rear=footprint.rear, w=footprint.width))


def _area(outline: Array) -> float:
    x, y = outline.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def _ahead(heading: float) -> Array:
    return np.array([math.cos(heading), math.sin(heading)])


def _room(landing: Array, before: Flight) -> Array:
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


def _driven(
    footprint: Footprint, before: Flight, after: Flight, landing: Array, walls: Array
) -> Manoeuvre | None:
    """Manoeuvre from the head of one flight to the foot of the next."""
    ahead = _ahead(before.estimate.heading)
    start = before.lane[1:3].mean(axis=0)
    edge = float(before.estimate.middle[-1, :2] @ ahead)
    start = start + (KEPT + 0.01 + edge - float(start @ ahead)) * ahead
    kept = _beyond(landing, ahead, edge + KEPT)
    if len(kept) == 0:
        return None
    foot = after.lane[[0, 3]].mean(axis=0)
    return manoeuvre(
        footprint,
        start=(float(start[0]), float(start[1]), before.estimate.heading),
        goal=Goal(
            float(foot[0]), float(foot[1]), after.estimate.heading, float(after.estimate.width)
        ),
        landing=kept,
        walls=walls,
    )


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
