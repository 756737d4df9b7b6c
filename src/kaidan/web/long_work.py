"""What jobs do: any verb, larger sweeps, films, reports, files that take long."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from kaidan.answer import Answer
from kaidan.errors import InputError, shown
from kaidan.web.asking import VERBS, answered, building_of, read_of, report_of
from kaidan.web.keywords import made

FILES = ("read", "building")
"""Jobs that need a file."""
JOBS = (*VERBS, *FILES, "film", "report")
"""What a job may do."""
STORE, UPLOAD, RESULT, TEXT = "store", "upload", "result", "text"
"""Names in the folder of a job."""
_MEDIA = {".mp4": "video/mp4", ".gif": "image/gif"}
DOCUMENTS = {"html": "text/html; charset=utf-8", "pdf": "application/pdf"}
"""Types of reports by their formats."""


class Result(NamedTuple):
    """What a job came to."""

    media: str
    """Type of its content."""
    content: bytes
    text: str = ""
    """The words of the command, where it is an answer."""


def result_of(verb: str, body: Mapping[str, Any], folder: Path) -> Result:
    """Do a job, or go on with it.

    verb: one of `JOBS`.
    """
    if verb == "film":
        return _film(body)
    if verb == "report":
        return _report(body)
    answer: Answer
    if verb == "sweep":
        answer = _sweep(body, folder)
    elif verb == "read":
        answer = read_of(UPLOAD, body)
    elif verb == "building":
        answer = building_of(UPLOAD, body)
    else:
        answer = answered(verb, body)
    return Result("application/json", answer.to_json().encode(), str(answer))


def _sweep(body: Mapping[str, Any], folder: Path) -> Answer:
    from kaidan.sweeps.plan import Plan
    from kaidan.sweeps.running import carried_out
    from kaidan.sweeps.summary import summary_of

    values = dict(body)
    plan = Plan.of(made(values, VERBS["sweep"].several), screen=bool(values.pop("go_only", False)))
    return summary_of(carried_out(plan, store=folder / STORE, progress=True))


def _film(body: Mapping[str, Any]) -> Result:
    from kaidan.figures.animation import film_of
    from kaidan.films import film_format
    from kaidan.verbs.traverse_report import TraverseReport

    values = dict(body)
    suffix = film_format(Path(f"film.{values.pop('format', 'gif')}"), "film")
    found = answered("traverse", values)
    assert isinstance(found, TraverseReport)
    return Result(_MEDIA[suffix], film_of(found, suffix))


def _report(body: Mapping[str, Any]) -> Result:
    from kaidan.documents import report_bytes

    values = dict(body)
    form = document_format(values)
    language = values.pop("language", "en")
    return Result(DOCUMENTS[form], report_bytes(report_of(values), form, language))


def document_format(body: dict[str, Any], known: tuple[str, ...] = tuple(DOCUMENTS)) -> str:
    """Format of a report that a body asks for, taken out of it."""
    form = body.pop("format", "html")
    if form not in known:
        raise InputError(f"report: format {shown(form)} is not known; known: {', '.join(known)}")
    return str(form)
