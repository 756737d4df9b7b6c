"""The page for the field: verdict, sketch, flippers by phase, what to watch, when to stop."""

from typing import TYPE_CHECKING

from kaidan.models.sentences import turning
from kaidan.modes import FAILURE_MODES
from kaidan.tables import decimals, fixed
from kaidan.text.assessment import (
    change_line,
    change_name,
    friction_line,
    headline,
    margin_line,
    stairs_line,
    unknown_line,
)
from kaidan.text.document import Block, Facts, Heading, Paragraph, Picture, Points, Table, Verdict
from kaidan.words import place

if TYPE_CHECKING:
    from kaidan.models.contact_figures import RotationFigures
    from kaidan.verbs.report.answer import Mission, PhasePosture

MOST = 5
"""Most points of a list on this page."""
SEEN = 0.5
"""Rotation that an operator sees [deg]."""


def field_page(mission: "Mission", number: int) -> tuple[Block, ...]:
    """Blocks of the page.

    number: of the mission in its document, from 0.
    """
    answer = mission.assessment
    blocks: list[Block] = [
        Verdict(answer.verdict, headline(answer).partition("  ")[2]),
        Paragraph(answer.reason),
        Picture(f"sketch-{number}", _sketch_says(mission), 72),
        Facts(tuple(_facts(mission))),
    ]
    if answer.question.robot.flippers():
        blocks += [Heading("Flippers", 2), _postures(mission)]
    blocks += [
        Heading("Watch", 2),
        Points(tuple(watch(mission)[:MOST])),
        Heading("Stop", 2),
        Points(tuple(stop(mission))),
    ]
    return tuple(blocks)


def _facts(mission: "Mission") -> list[tuple[str, str]]:
    answer, card = mission.assessment, mission.card
    question = answer.question
    rows = [
        ("Go", f"{question.direction}, {question.facing.replace('-', ' ')}"),
        ("Speed", _speed(card.speed, card.judged_speed)),
    ]
    if answer.to_secure:
        rows.insert(0, ("First", answer.to_secure))
    names = (change_name(answer), "Or")
    for name, change in zip(names, answer.what_would_help[:2], strict=False):
        rows.append((name, change_line(change, answer)))
    rows += [
        ("Stairs", stairs_line(answer)),
        ("Margin", margin_line(answer, labels=True)),
        ("Friction", friction_line(answer)),
    ]
    if card.time_s is not None and card.path_m is not None:
        rows.append(("Time", f"{card.time_s:.0f} s for {card.path_m:.1f} m"))
    rows += [("Landing", line) for line in turning.lines(answer.turns)]
    unknown = unknown_line(answer)
    return [*rows, ("Not known", unknown)] if unknown else rows


def _speed(stated: float | None, judged: float) -> str:
    if stated:
        return f"{stated:g} m/s at most, as judged"
    return f"none was stated: no faster than {judged:g} m/s, at which it was judged"


def _postures(mission: "Mission") -> Table:
    return Table(
        ("phase", "when", "front", "rear", "as an option"),
        tuple(_posture(each) for each in mission.card.postures),
        (14, 34, 14, 14, 24),
    )


def _posture(each: "PhasePosture") -> tuple[str, ...]:
    when = "before the start"
    if each.before_step is not None:
        when = f"stand with the centroid before step {each.before_step}"
    front, rear = (
        "none" if angle is None else f"{fixed(angle, 0, '+')} deg"
        for angle in (each.front_deg, each.rear_deg)
    )
    return each.phase, when, front, rear, each.flippers


def watch(mission: "Mission") -> list[str]:
    """What to watch: what rotates and where, what fails or may, a friction that nobody stated."""
    answer = mission.assessment
    said = []
    if answer.contact is not None:
        seen = [each for each in answer.contact.rotations if abs(each.angle_deg) >= SEEN]
        said += [_rotates(each) for each in sorted(seen, key=_size)[:2]]
    fails = [
        one
        for key in answer.doubts
        if (one := answer.findings.get(key)) is not None and key in FAILURE_MODES
    ]
    for one in sorted(fails, key=lambda one: one.holds_best is not False):  # the certain ones first
        where = place(one.phase, one.step)
        margin = ""
        if one.margin is not None:
            margin = f": {fixed(one.margin, decimals(one.margin, 1), '+')} {one.unit}"
        sure = "Certain" if one.holds_best is False else "Possible"
        said.append(f"{sure}: {one.label}{where}{margin}.")
    if answer.friction is None:
        said.append("Nobody stated the friction: try the tracks on the first riser before you go.")
    return said or ["Nothing in particular: no failure mode is in doubt, and nothing rotates."]


def _size(each: "RotationFigures") -> float:
    return -abs(each.angle_deg)


def _rotates(each: "RotationFigures") -> str:
    where = place(each.phase, each.step)
    if not each.arrested:
        return f"It falls over{where}."
    does = "drops" if each.obliged else "rotates"
    speed = "" if each.impact_speed is None else f", its end hits at {each.impact_speed:.1f} m/s"
    return f"It {does} by {abs(each.angle_deg):.0f} deg{where}{speed}."


def stop(mission: "Mission") -> list[str]:
    """When to stop and back off: what the judged traverse does not come to."""
    answer, card = mission.assessment, mission.card
    if answer.verdict == "no-go":
        return ["Do not drive it like this."]
    if answer.verdict == "outside-model":
        return ["Do not rely on this sheet: the model has no answer for this pair."]
    said = []
    if card.stop_above_deg is not None and card.steepest_deg is not None:
        said.append(
            f"The uphill end stands higher than {card.stop_above_deg:.0f} deg; it comes to "
            f"{card.steepest_deg:.0f} deg on these stairs."
        )
    if card.largest_rotation_deg is not None:
        rotates = "at all"
        if card.largest_rotation_deg >= SEEN:
            rotates = f"by more than {card.largest_rotation_deg:.0f} deg at once"
        said.append(f"It rotates {rotates}, or an end lifts and stays up.")
    needed = answer.required_friction
    slides = "The tracks run and it does not go on, or it slides back"
    said.append(
        f"{slides}." if needed is None else f"{slides}: there is less friction than {needed:.2f}."
    )
    if card.flippers_within_deg:
        said.append(
            f"A flipper is more than {card.flippers_within_deg:.0f} deg off its angle when a phase "
            "begins."
        )
    said.append("A step differs from those in the sketch, or is wet, loose, broken or covered.")
    return said


def _sketch_says(mission: "Mission") -> str:
    question = mission.assessment.question
    return (
        f"Sketch with dimensions: {question.robot.name} from the side on "
        f"{question.terrain_name}, {stairs_line(mission.assessment)}"
    )
