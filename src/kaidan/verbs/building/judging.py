"""Each robot on each flight: the ordinary question, judged once for flights that are alike."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from kaidan.assessment import with_plan
from kaidan.assessment.verdict import conclude
from kaidan.modes import SUPPLIES, Undecided, Verdict
from kaidan.question import Question
from kaidan.readers.building import SAME_FLOOR, WALL, Building, Flight
from kaidan.readers.interpreters.building import room_on
from kaidan.readers.kinds import Array
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.text import verdicts
from kaidan.verbs.building.answer import Binding, CellShown
from kaidan.verbs.comparison import laid

DEEPEST = 5.0
"""Length of a landing beyond which it makes no difference [m]."""
_BINDS: dict[str, Binding] = {
    "narrow": "width",
    "low": "headroom",
    "landing_room": "landing",
    "turning": "turning",
    "gap": "gap",
    Undecided.FRICTION_UNKNOWN.value: "friction",
    **{mode.key: "friction" for mode in SUPPLIES},
}


def sheet_of(building: Building, flight: Flight) -> Stairs:
    """Data sheet of a flight, with what is clear at its foot and at its head.

    Raises
    ------
    InputError
        Steps that no sheet takes.
    """
    estimate = flight.estimate
    ends = (
        (flight.lower, estimate.middle[0, :2], estimate.heading + math.pi),
        (flight.upper, estimate.middle[-1, :2], estimate.heading),
    )
    room = [_room(building, flight, *end) for end in ends]
    (lower, lower_leaf), (upper, upper_leaf) = room
    sheet = estimate.stairs(flight.identity, lower=lower, upper=upper)
    leaves = {"lower_leaf": lower_leaf, "upper_leaf": upper_leaf}
    return sheet.model_copy(update={name: leaf for name, leaf in leaves.items() if leaf > 0.0})


def _room(
    building: Building, flight: Flight, key: str, at: Array, heading: float
) -> tuple[float, float]:
    """Length of a landing, to a door whose leaf opens onto it if one does, and that leaf [m]."""
    floor = building.floors[key]
    depth = min(room_on(floor, at, heading)[0], DEEPEST)
    ahead = np.array([math.cos(heading), math.sin(heading)])
    end = depth if math.isfinite(depth) else DEEPEST
    found = []
    for door in building.doors:
        away = float(ahead @ (np.array([door.x, door.y]) - at))
        beside = abs(door.level - floor.level) < SAME_FLOOR and away < end + WALL
        if beside and door.opens_onto(at, heading, flight.estimate.width):
            found.append((min(away, end), door.leaf))
    return min(found, key=lambda one: one[0] - one[1], default=(depth, 0.0))


class Judge:
    """Verdicts on pairs; a pair that was met before is not judged again."""

    def __init__(self, flippers: Any, manner: dict[str, Any]) -> None:
        self.flippers, self.manner = flippers, manner
        self._known: dict[tuple[str, str, str], Any] = {}
        self.judged = 0
        """Distinct pairs so far."""

    def cell(self, robot: Robot, flight: Flight, sheet: Stairs, direction: str) -> CellShown:
        """Verdict on a robot on a flight."""
        alike = sheet.model_copy(update={"name": "flight"}).model_dump_json()
        key = (robot.name, alike, direction)
        if key not in self._known:
            self._known[key] = self._judged(robot, sheet, direction)
            self.judged += 1
        found: CellShown = self._known[key]
        return found.model_copy(update={"flight": flight.identity})

    def _judged(self, robot: Robot, sheet: Stairs, direction: str) -> CellShown:
        flippers = laid(robot, self.flippers)
        question, findings, _ = with_plan(
            Question.of(robot, sheet, flippers=flippers, direction=direction, **self.manner)
        )
        conclusion = conclude(question, findings)
        governs = str(conclusion.governs)
        return CellShown(
            robot=robot.name,
            flight=sheet.name,
            direction=question.direction,
            facing=question.facing,
            flippers=question.flippers if robot.flippers() else "",
            verdict=conclusion.verdict,
            governs=governs,
            binds=binds(governs, conclusion.verdict),
            reason=verdicts.reason(question, findings, conclusion),
            margin_deg=math.degrees(conclusion.margin),
            margin_best_deg=math.degrees(conclusion.margin_best),
        )


def binds(governs: str, verdict: Verdict) -> Binding:
    """What decides, in a word."""
    if verdict is Verdict.OUTSIDE_MODEL:
        return "stability"
    return _BINDS.get(governs, "stability")


def worst(verdicts_: Sequence[Verdict], key: Callable[[Verdict], int] | None = None) -> Verdict:
    """Worst of some verdicts."""
    return max(verdicts_, key=key or (lambda one: one.rank))
