"""The verdict in one sentence, and the notes beneath it."""

import math
from typing import TYPE_CHECKING

from kaidan.assessment.sentences import failures
from kaidan.models.sentences import dynamic, terrain, turning
from kaidan.modes import FAILURE_MODES, HIGH_CENTRING, IMPACT, MODELS, Undecided, Verdict
from kaidan.readers.sentences.robot_file import BELT_ASSUMED

if TYPE_CHECKING:
    from kaidan.assessment.verdict import Conclusion
    from kaidan.models.findings import Findings
    from kaidan.question import Question
    from kaidan.robot import Robot, Stance


HOW_ROUGH = {IMPACT.key: "lands hard", HIGH_CENTRING.key: "rests on its belly"}
"""What a ROUGH robot does by these modes; by the others it rocks."""


def reason(question: "Question", found: "Findings", conclusion: "Conclusion") -> str:
    """The verdict in one sentence: what decides, with its number, and where."""
    if conclusion.verdict is Verdict.OUTSIDE_MODEL:
        return f"The {MODELS[found.model].label} has no answer: {found.outside}."
    many = failures.figures_with(found, "failure_interval")
    if many is not None and many.draws > 1 and conclusion.governs != Undecided.FRICTION_UNKNOWN:
        mode = FAILURE_MODES.get(conclusion.governs)
        happens = None if mode is None else f"{mode.label}{failures.at(conclusion)}"
        return dynamic.of_many(many, happens)
    if conclusion.governs == Undecided.FRICTION_UNKNOWN:
        return failures.of_friction(question, found, conclusion, "none is stated")
    if conclusion.governs == Undecided.MARGIN_UNKNOWN:
        but = "T" if conclusion.doubts else "Nothing fails, but t"
        return f"{but}he {MODELS[found.model].label} knows no margin."
    mode = FAILURE_MODES[conclusion.governs]
    if conclusion.verdict is Verdict.GO:
        return (
            f"It holds with {math.degrees(conclusion.margin):.1f} deg to spare; nearest is "
            f"{mode.label}{failures.at(conclusion)}."
        )
    finding = found.of(mode)
    if finding is not None and finding.margin(question.risk) > 0:
        return (
            f"With a probability of {(conclusion.samples <= 0).mean():.2g}, more than the accepted "
            f"{question.risk:g}, it fails in one way or another; nearest is "
            f"{mode.label}{failures.at(conclusion)}."
        )
    say = failures.SAYINGS.get(mode.key)
    said = None if say is None or finding is None else say(question, found, conclusion, finding)
    if said is not None:
        return said
    fails = "fails" if conclusion.verdict is Verdict.NO_GO else "may fail"
    return f"It {fails} by {mode.label}{failures.at(conclusion)}."


def notes(question: "Question", found: "Findings", conclusion: "Conclusion") -> tuple[str, ...]:
    """What to secure, other doubts than the governing one, what was assumed, what the sheet has."""
    each = []
    if conclusion.verdict is Verdict.ROUGH:
        does = HOW_ROUGH.get(conclusion.governs, "rocks")
        each.append(
            f"Secure payload, arm and antennas: it {does}. Keep people off the flight below."
        )
    for finding in conclusion.doubts:
        say = failures.SAYINGS.get(finding.mode.key)
        fails = not finding.margin(question.risk) > 0  # by itself
        if fails and finding.mode.key != conclusion.governs and say is not None:
            own = conclusion._replace(phase=finding.phase, step=finding.step)
            each.append(say(question, found, own, finding))
    turns = failures.figure_of(found, "turns") or ()
    each += [*turning.lines(turns), turning.IN_LINE] if turns else []
    each += terrain.note(question)
    each += found.notes
    each += [assumed] if (assumed := belt_assumed(question.robot)) else []
    for name, value in (("theta_d", question.allowance_d), ("theta_M", question.allowance_M)):
        if value.source == "default":
            each.append(
                f"{name} is not measured: 0 to {math.degrees(value.high):.1f} deg assumed. Measure "
                "it to settle the doubt."
            )
    if question.surface is None:
        each.append("No friction was stated, so no GO can be given.")
    each += _of_drive(question, question.stance)
    sheets = (question.robot.notes, *(flight.notes for flight in question.flights))
    each += (" ".join(said.split()) for said in sheets if said)
    return tuple(each)


def belt_assumed(robot: "Robot") -> str:
    """What the belt of a robot is assumed over; empty where it is known."""
    over = robot.track.assumed_over
    return "" if over is None else BELT_ASSUMED[over]


def _of_drive(question: "Question", stance: "Stance") -> list[str]:
    drive = question.robot.drive
    limits = drive.max_traction is not None or (
        drive.max_power is not None and question.speed and question.direction == "up"
    )
    if limits and stance.mass is not None:
        return []
    if drive.max_traction is None and drive.max_power is None:
        return ["The drive's traction is not known and not judged."]
    missing = "mass" if stance.mass is None else "speed"
    return [f"The drive is not judged: that takes the {missing}, which is not stated."]
