"""A predicted record in the form of ASTM E2804: what a test on these stairs would write down."""

import math
from typing import TYPE_CHECKING

from kaidan.modes import Verdict
from kaidan.text.assessment import headline, margin_line
from kaidan.text.document import Block, Facts, Heading, Paragraph, Table

if TYPE_CHECKING:
    from kaidan.assessment.answer import Assessment
    from kaidan.verbs.report.answer import Mission

_IS = (
    "ASTM E2804-11 (2020) is the standard test method for response robots on stairs and landings. "
    "The standard is not reproduced here. Public of it is this: the robot starts on the lower "
    "landing, one repetition is complete when the whole robot has been on the upper landing and "
    "is back at the start, an administrator times and counts repetitions, and notes faults with "
    "their time; the apparatus is set to the next inclination when all repetitions are done; it "
    "comes in lateral clearances of 2.4, 1.2 and 0.6 m."
)
_IS_NOT = (
    "This is a prediction in that order of entries. It is no test result, no certificate, and no "
    "copy of the standard's form: nobody drove, counted or timed anything. Empty entries are for "
    "who tests."
)


def record(mission: "Mission") -> list[Block]:
    """Blocks of the record."""
    question, card = mission.assessment.question, mission.card
    room = question.room
    width = math.inf if room is None else room.width_up_to(question.needs.flat)
    there, back = mission.assessment, mission.way_back
    up_first = question.direction == "up"
    up, down = (there, back) if up_first else (back, there)
    time = "not predicted: state a speed"
    if card.time_s is not None:
        time = f"{card.time_s:.0f} s {question.direction} (way back not timed)"
    return [
        Heading("Predicted record, in the form of ASTM E2804", 2),
        Paragraph(_IS),
        Paragraph(_IS_NOT),
        Facts(
            (
                ("Robot", question.robot.title or question.robot.name),
                ("Configuration", f"flippers {question.flippers}, {_mass(there)}"),
                ("Apparatus", question.terrain_name),
                ("Inclination", _inclination(there)),
                (
                    "Lateral clearance",
                    f"{1e3 * width:.0f} mm" if math.isfinite(width) else "not stated",
                ),
                ("Surface", "not stated" if question.surface is None else question.surface.name),
                ("Predicted time", time),
                ("Date, place, weather", ""),
                ("Operator, administrator", ""),
            )
        ),
        Table(
            ("task", "predicted", "margin", "repetitions done", "faults, with time"),
            (_task("to the upper landing", up), _task("back to the start", down)),
            (18, 32, 24, 13, 13),
        ),
    ]


def _mass(answer: "Assessment") -> str:
    return "mass not known" if answer.mass_kg is None else f"{answer.mass_kg:g} kg"


def _inclination(answer: "Assessment") -> str:
    return "no flight" if answer.angle_deg is None else f"{answer.angle_deg:.1f} deg"


def _task(name: str, answer: "Assessment | None") -> tuple[str, ...]:
    if answer is None:
        return name, Verdict.OUTSIDE_MODEL.label, "not known", "", ""
    return name, headline(answer), margin_line(answer, labels=True), "", ""
