"""Bytes of a report's file: HTML or PDF, the same bytes for the same report."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from kaidan.errors import InputError, shown
from kaidan.files import format_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from kaidan.verbs.report.answer import Report

FORMATS = ("html", "pdf")
"""Formats of documents, by the suffix of the file."""
LANGUAGES = ("en", "ja")
"""Languages of the pages for the field."""


def document_format(path: Path) -> str:
    """Format that the suffix of a document's file asks for.

    Raises
    ------
    InputError
        Another suffix, or none.
    """
    return format_of(path, FORMATS, "report")


def report_bytes(found: "Report", form: str, language: str = "en") -> bytes:
    """Document of a report.

    Parameters
    ----------
    found : Report
        What `kaidan.report` answers.
    form : {"html", "pdf"}
    language : {"en", "ja"}
        Of the text; lines of commands and words of sheets are in English, and so are pictures where
        the system has no Japanese typeface.

    Returns
    -------
    bytes
        HTML: one page, complete in itself, that prints as it is read: no script, nothing fetched.
        PDF: A4. The same report gives the same bytes.

    Raises
    ------
    InputError
        Another form or language.
    MissingExtraError
        ``kaidan[report]`` is not installed.
    """
    from kaidan.documents.japanese_pictures import put_in_japanese
    from kaidan.figures.saving import figure_bytes
    from kaidan.text.japanese import in_japanese
    from kaidan.text.report import document

    if language not in LANGUAGES:
        known = ", ".join(LANGUAGES)
        raise InputError(f"report: language {shown(language)} is not known; known: {known}")
    if form not in FORMATS:
        raise InputError(f"report: format {shown(form)} is not known; known: {', '.join(FORMATS)}")
    whole, figures = document(found), dict(_figures(found))
    if language == "ja":
        whole = in_japanese(whole)
        for each in figures.values():
            put_in_japanese(each)
    if form == "html":
        from kaidan.documents.html_page import page

        return page(
            whole, {key: figure_bytes(each, "svg") for key, each in figures.items()}
        ).encode()
    from kaidan.documents.pdf_pages import pages

    return pages(whole, {key: figure_bytes(each, "png") for key, each in figures.items()})


def _figures(found: "Report") -> "Iterator[tuple[str, Figure]]":
    """Figures by the keys under which the document has their places."""
    from kaidan.figures.findings_figure import findings_figure
    from kaidan.figures.mission_sketch import mission_sketch
    from kaidan.figures.traverse_figure import traverse_figure

    for number, mission in enumerate(found.missions):
        yield f"sketch-{number}", mission_sketch(mission)
        yield f"margins-{number}", findings_figure(mission.assessment)
        if mission.traverse is not None:
            yield f"traverse-{number}", traverse_figure(mission.traverse, None)
