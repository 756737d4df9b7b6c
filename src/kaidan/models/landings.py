"""Turning on landings: in the posture of the climb, else in another one that does.

Best case: the footprint as it is. Worst case: larger all round by what a driver needs for
corrections, and of no more moves than the robot's sheet states. What is shown is the first way that
has room in the worst case, else in the best.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics.clearance import OFF_LINE, corner_margin, spin_circle
from kaidan.mechanics.footprint import Footprint, inscribed_circle, walls_of
from kaidan.mechanics.turning import Goal, Manoeuvre, manoeuvre, on_the_spot
from kaidan.models.clearance import KEPT
from kaidan.models.findings import Finding, Findings, Later
from kaidan.models.landing_figures import LandingTurn, LandingTurns, TurnWay
from kaidan.modes import TURNING, Phase
from kaidan.outline import Outline, footprint_of
from kaidan.question import Question
from kaidan.robot import Posture, Robot
from kaidan.terrain.landings import TURNS, Landing

Array = NDArray[np.float64]
LANE = 1.5
"""Length of the flight over which the robot's tail may still hang [m]."""
PASSAGE = 3.0
"""Length of a level passage in which it may manoeuvre [m]."""


class Room(NamedTuple):
    """Room to turn in, in the plan."""

    start: tuple[float, float, float]
    """Middle of the edge where the way arrives, x, y [m], and heading [rad]."""
    level: bool
    """Whether it arrives on the level, so that nothing tips back down."""
    goal: Goal
    landing: Array
    """Corners of the landing, shape (n, 2) [m]."""
    inside: Array
    """Its sides and what stands on it, segments of shape (m, 4) [m]."""
    walls: Array
    """The same but for the mouths of the ways, whose sides are among them."""
    kept: Array
    """Corners of where the turning centre may be, shape (k, 2) [m]."""
    corner: tuple[float, float, float] | None = None
    """Of two ways at a right angle, one of them level: clear widths, and the length of the landing
    along the flight [m]."""


class Turned(NamedTuple):
    """What was found."""

    way: TurnWay
    tight: bool
    posture: str
    footprint: Footprint
    path: Manoeuvre | None
    room: float | None
    """Largest circle inside the landing [m]."""


def turned(tried: Sequence[tuple[str, Footprint]], room: Room | None) -> Turned:
    """First posture and way in which a robot turns.

    room: none: not known.
    """
    name, footprint = tried[0]
    if room is None or not math.isfinite(footprint.width):
        return Turned("unknown", False, name, footprint, None, None)
    nearest = min(tried, key=lambda each: circle(each[1]))
    if len(room.kept) < 3:
        return Turned("none", False, *nearest, None, 0.0)
    largest = float(2 * inscribed_circle(room.inside, room.landing)[2])
    for more in (OFF_LINE, 0.0):
        for search in (_at_once, _back_and_forth):
            for name, covered in tried:
                way, path = search(_grown(covered, more), room)
                if way != "none":
                    return Turned(way, not more, name, covered, path, largest)
    return Turned("none", False, *nearest, None, largest)


def _grown(footprint: Footprint, more: float) -> Footprint:
    """Footprint larger all round [m]."""
    front, rear, width = footprint
    return Footprint(front + more, rear + more, width + 2 * more)


def _at_once(footprint: Footprint, room: Room) -> tuple[TurnWay, Manoeuvre | None]:
    """On the spot, or round the corner in one go."""
    path = on_the_spot(footprint, **_asked(footprint, room))
    if path is not None:
        return "spin", path
    rounds = room.corner is not None and _rounds(footprint, room.level, *room.corner)
    return "corner" if rounds else "none", None


def _back_and_forth(footprint: Footprint, room: Room) -> tuple[TurnWay, Manoeuvre | None]:
    path = manoeuvre(footprint, **_asked(footprint, room))
    return "none" if path is None else "manoeuvre", path


def _asked(footprint: Footprint, room: Room) -> dict[str, Any]:
    """Arguments of a search for a footprint that arrives on the landing."""
    x, y, heading = room.start
    into = -footprint.front if room.level else KEPT + 0.01
    start = (x + into * math.cos(heading), y + into * math.sin(heading), heading)
    return {"start": start, "goal": room.goal, "landing": room.kept, "walls": room.walls}


def _rounds(footprint: Footprint, level: bool, a: float, b: float, deep: float) -> bool:
    """Whether it slides round a corner in one go and stays on the landing meanwhile.

    Before a flight it must not reach the first riser askew; behind one its turning centre must not
    get back to the last nosing.
    """
    front, rear, w = footprint
    turns = float(corner_margin(w=w, length=front + rear, a=a, b=b)) >= 0.0
    needed = math.hypot(front + rear, w) if level else math.hypot(max(front, rear), w / 2) + KEPT
    return turns and deep >= needed


def shown(found: Turned, climbing: str, turn: float | None, robot: Robot) -> dict[str, Any]:
    """Fields of `TurnFigures`, in its order.

    turn: angle between both ways [rad]; None: not known.
    """
    return {
        "turn_deg": None if turn is None else math.degrees(turn),
        "way": found.way,
        "tight": found.tight,
        "flippers": found.posture if robot.flippers() else "",
        "changed": found.posture != climbing,
        "circle_m": circle(found.footprint),
        "room_m": found.room,
        "moves": found.path.moves if found.path else 0,
        "reversals": found.path.reversals if found.path else 0,
        "most_moves": robot.turning_moves,
    }


def circle(footprint: Footprint) -> float:
    """Circle that a footprint sweeps on the spot [m]; NaN: of unknown width."""
    return float(spin_circle(front=footprint.front, rear=footprint.rear, w=footprint.width))


def turns_of(question: Question) -> tuple[LandingTurn, ...]:
    """How the robot of a question turns on each landing where the way turns."""
    return tuple(_turns(question))


def _turns(question: Question) -> Iterator[LandingTurn]:
    robot = question.robot
    for landing in question.landings:
        climbing = _posture_at(question, landing).spelled(robot)
        names = [climbing]
        if robot.flippers() and climbing != "stowed":
            names.append("stowed")
        tried = tuple((name, _footprint(question, name)) for name in names)
        known = landing.turn != "unknown"
        found = _turned_on(tried, landing._replace(place="")) if known else turned(tried, None)
        turn = TURNS[landing.turn] if known else None
        yield LandingTurn(landing=landing.place, **shown(found, climbing, turn, robot))


def _posture_at(question: Question, landing: Landing) -> Posture:
    """Posture in which the robot comes to a landing, or leaves it for the flight."""
    first, last = Phase.ENTER, Phase.LAND
    if question.direction == "down":
        first, last = last, first
    phase = {"lower": first, "between": Phase.TRAVERSE, "upper": last}[landing.end]
    return question.postures[phase]


def _footprint(question: Question, name: str) -> Footprint:
    """Footprint with the end ahead that points up the stairs: what turns going down, turns back."""
    posture = Posture.parse(name, question.robot)
    found = footprint_of(question.robot, Outline.of(question.robot, posture, question.payload))
    return found if question.nose_up else Footprint(found.rear, found.front, found.width)


@lru_cache(maxsize=256)
def _turned_on(tried: tuple[tuple[str, Footprint], ...], landing: Landing) -> Turned:
    return turned(tried, room_of(landing))


def room_of(landing: Landing) -> Room:
    """Rectangle of a landing in the plan, arriving along x at x = 0, turning to the left.

    The way by which one arrives lies at the outer side, that by which one goes on at the far end.
    """
    depth, width = max(landing.depth, 0.0), landing.width
    arrives = min(landing.arrives, width)
    half = landing.turn == "half"
    leaves = min(landing.leaves, width if half else depth)
    onto, off = landing.level == "arrives", landing.level == "leaves"
    corners = np.array([(0.0, 0.0), (depth, 0.0), (depth, width), (0.0, width)])
    walls = [(0.0, 0.0, depth, 0.0), (depth, 0.0, depth, width)]
    walls += [(-LANE, 0.0, 0.0, 0.0), (-LANE, arrives, 0.0, arrives)]
    if half:
        goal = Goal(0.0, width - leaves / 2, math.pi, leaves, off)
        walls += [(0.0, width, depth, width)]
        walls += [(0.0, arrives, 0.0, max(arrives, width - leaves) if off else width)]
        beside = [(0.0, at, -LANE, at) for at in (width - leaves, width)]
    else:
        goal = Goal(depth - leaves / 2, width, math.pi / 2, leaves, off)
        walls += [(0.0, arrives, 0.0, width), (0.0, width, depth - leaves if off else depth, width)]
        beside = [(at, width, at, width + LANE) for at in (depth - leaves, depth)]
    kept = np.maximum(corners, (KEPT, 0.0))
    if onto:
        kept = np.array([(-PASSAGE, 0.0), *corners[1:], (0.0, arrives), (-PASSAGE, arrives)])
    return Room(
        start=(0.0, arrives / 2, 0.0),
        level=onto,
        goal=goal,
        landing=corners,
        inside=walls_of(corners),
        walls=np.array(walls + (beside if off else [])),
        kept=kept,
        corner=(arrives, leaves, width if onto else depth) if landing.level and not half else None,
    )


def beside(question: Question, found: Findings) -> Findings:
    """Findings of a model with whether the robot turns on all landings where the way turns."""
    turns = turns_of(question)
    worst = not all(each.holds for each in turns)
    best = any(each.way == "none" for each in turns)
    finding = Finding(
        mode=TURNING,
        worst=np.array([-math.inf if worst else math.inf]),
        best=np.array([-math.inf if best else math.inf]),
        model=found.model,
    )
    figures = Later(lambda: (*found.figures, LandingTurns(turns=turns)))
    return replace(found, each=(*found.each, finding), figures=figures)
