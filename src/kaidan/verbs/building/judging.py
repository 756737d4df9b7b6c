"""Each robot on each flight: the ordinary question, judged once for flights that are alike."""

import math
from typing import Any

from kaidan.assessment import with_plan
from kaidan.assessment.sentences import verdicts
from kaidan.assessment.verdict import conclude
from kaidan.modes import SUPPLIES, Undecided, Verdict
from kaidan.question import Question
from kaidan.readers.building import Flight
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.building.answer import Binding, CellShown
from kaidan.verbs.comparison import laid

_BINDS: dict[str, Binding] = {
    "narrow": "width",
    "low": "headroom",
    "landing_room": "landing",
    "turning": "turning",
    "gap": "gap",
    "foot_unseen": "drawing",
    "floor_finish": "drawing",
    Undecided.FRICTION_UNKNOWN.value: "friction",
    **{mode.key: "friction" for mode in SUPPLIES},
}


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
