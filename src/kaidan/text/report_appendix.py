"""The appendix of a report: inputs, margins, figures, limits of the model, versions, code."""

from typing import TYPE_CHECKING

from kaidan.modes import MODELS
from kaidan.tables import fixed
from kaidan.text.assessment import details
from kaidan.text.document import (
    Block,
    Code,
    Facts,
    Heading,
    Lines,
    Paragraph,
    Picture,
    Points,
    Table,
)
from kaidan.text.event_log import rows_of
from kaidan.text.report_record import record
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.assessment.answer import FindingShown
    from kaidan.verbs.report.answer import Mission, Report

LIMITS = (
    "It moves slowly or at a constant acceleration; impacts and springs are not in the model.",
    "One friction coefficient holds for all contacts of a part of the stairs; dust, ice, carpet "
    "and worn nosings are not in the catalogue.",
    "Curved stairs and winders are not judged. A turn on a landing is judged where its sizes are "
    "stated, by lengths in the plan: flights are driven as if they lay in line.",
    "Whether the robot keeps its heading, and what breaks in a drop, is not judged.",
    "The allowances theta_d and theta_M were measured on one robot; without figures of your own "
    "they are ranges.",
    "A robot that has to tip from nosing to nosing never gets a GO: no experiment shows that it is "
    "safe.",
)
"""What no answer of kaidan holds."""


def appendix(found: "Report", mission: "Mission", number: int) -> list[Block]:
    """Blocks of the appendix.

    number: of the mission, from 0.
    """
    answer = mission.assessment
    name = subject(answer.question)
    blocks: list[Block] = [
        Heading(f"Appendix: {name}", 1),
        Heading("Inputs", 2),
        Paragraph(
            "Status letters of sources: V read in a named source, C computed from a model, "
            "D derived, U unconfirmed. Doubt: one standard uncertainty, where one is stated."
        ),
        _inputs(mission),
        Heading("Margins", 2),
        Paragraph(
            "Positive holds. The worst case has every range at its unfavourable end, allowances "
            f"subtracted, at an accepted risk of {answer.question.risk:g}."
        ),
        _margins(mission),
        Picture(f"margins-{number}", f"Bars of the margins of {name}, as in the table", 110),
    ]
    if mission.traverse is not None:
        blocks += [
            Heading("The traverse", 2),
            Picture(
                f"traverse-{number}",
                f"Side view of {name}: poses, path, the pose that decides; below it inclination, "
                "friction and energy margin along the path",
                150,
            ),
            Table(
                ("phase", "path", "inclination", "what happens"),
                tuple(rows_of(mission.traverse.event_log)),
                (10, 10, 12, 68),
            ),
        ]
    return [
        *blocks,
        Heading("Everything that was found", 2),
        Lines(tuple(details(answer).splitlines())),
        *record(mission),
        Heading("What this cannot say", 2),
        Points(LIMITS),
        Heading("Versions", 2),
        Facts(
            (
                ("kaidan", found.kaidan),
                ("contact kernel", found.kernel),
                ("model", MODELS[answer.model].label),
            )
        ),
        Heading("The same question again", 2),
        Paragraph("kaidan report --again CODE -o FILE puts it again, with this code or its text:"),
        Code(mission.code),
    ]


def _inputs(mission: "Mission") -> Table:
    return Table(
        ("of", "figure", "symbol", "value", "doubt", "source"),
        tuple(
            (row.of, row.field, row.symbol, row.value, row.doubt, row.source)
            for row in mission.inputs
        ),
        (11, 20, 7, 17, 11, 34),
    )


def _margins(mission: "Mission") -> Table:
    return Table(
        ("failure mode", "worst case", "best case", "holds", "fails with", "where", "model"),
        tuple(_margin(key, one) for key, one in mission.assessment.findings.items()),
        (30, 13, 13, 9, 11, 13, 11),
    )


def _margin(key: str, one: "FindingShown") -> tuple[str, ...]:
    worst, best = (
        "-" if value is None else f"{fixed(value, 2, '+')} {one.unit}"
        for value in (one.margin, one.margin_best)
    )
    holds = {None: "not known", True: "yes", False: "no"}[one.holds]
    if one.holds is False and one.holds_best:
        holds = "at best"
    chance = "-" if one.probability is None else f"p = {one.probability:.3f}"
    place = "-" if one.phase is None else str(one.phase)
    place += "" if one.step is None else f", step {one.step}"
    return f"{key}: {one.label}", worst, best, holds, chance, place, one.model
