"""A report: in lines for a screen, and as a document for paper."""

from typing import TYPE_CHECKING

from kaidan.text.assessment import headline, margin_line
from kaidan.text.assessment import text as screen
from kaidan.text.document import Block, Break, Document, Heading, Sheet, Table
from kaidan.text.report_appendix import appendix
from kaidan.text.report_field import field_page
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.verbs.report.answer import Mission, Report


def text(found: "Report") -> str:
    """What `assess` says of each mission."""
    return "\n\n".join(screen(each.assessment) for each in found.missions)


def document(found: "Report") -> Document:
    """Document: an overview where there are several missions, a page for the field, an appendix."""
    parts: list[Block | Sheet] = []
    if len(found.missions) > 1:
        parts += [*_overview(found), Break()]
    for number, each in enumerate(found.missions):
        parts.append(Sheet(field_page(each, number)))
        parts += [*appendix(found, each, number), Break()]
    return Document(
        title=_title(found),
        parts=tuple(parts[:-1]),
        foot=f"kaidan {found.kaidan}: a prediction by a mechanical model, not a test",
    )


def _title(found: "Report") -> str:
    if len(found.missions) == 1:
        return subject(found.missions[0].assessment.question)
    return f"{len(found.missions)} missions on stairs"


def _overview(found: "Report") -> list[Block]:
    return [
        Heading("Missions of this document", 1),
        Table(
            ("", "mission", "verdict", "margin", "why"),
            tuple(_row(number, each) for number, each in enumerate(found.missions, start=1)),
            (4, 22, 12, 22, 40),
        ),
    ]


def _row(number: int, each: "Mission") -> tuple[str, ...]:
    answer = each.assessment
    verdict, _, names = headline(answer).partition("  ")
    return str(number), names, verdict, margin_line(answer, labels=True), answer.reason
