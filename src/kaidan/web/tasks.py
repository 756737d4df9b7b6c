"""Tasks of a worker process, each answered with a status and what is to be sent."""

import json
import os
from collections.abc import Callable, Mapping
from contextlib import chdir
from pathlib import Path
from typing import Any

from kaidan.answer import Answer
from kaidan.errors import KaidanError, MissingExtraError, RefusedError
from kaidan.files import whole_file
from kaidan.web.asking import answered, building_of, read_of, report_of, samples_of_file
from kaidan.web.long_work import RESULT, TEXT, UPLOAD, result_of
from kaidan.web.sheets import sheets_of
from kaidan.web.space import FULL, is_full

Done = tuple[dict[str, Any], bytes]
"""How a task ended, and what is to be sent."""


def done(task: Mapping[str, Any]) -> Done:
    """What comes of a task; whatever goes wrong is an answer too.

    task: ``kind`` and what that kind needs.
    """
    try:
        return {"status": 200}, _DO[task["kind"]](task)
    except MemoryError:
        text = "the answer needs more memory than a question may take: ask for less"
        head, content = refusal(422, "memory", text)
        return head | {"spent": True}, content
    except Exception as error:
        return _refused(error)


def _refused(error: Exception) -> Done:
    """What is sent for an error."""
    if is_full(error):
        return refusal(507, "full", FULL)
    if isinstance(error, KaidanError):
        kinds = {RefusedError: "refused", MissingExtraError: "missing-extra"}
        kind = next((kind for each, kind in kinds.items() if isinstance(error, each)), "input")
        return refusal(422, kind, str(error))
    from traceback import extract_tb

    frames = extract_tb(error.__traceback__)
    place = f"{os.path.basename(frames[-1].filename)}:{frames[-1].lineno}"
    return refusal(
        500, "fault", f"a fault of kaidan itself, {type(error).__name__} in {place}: {error}"
    )


def prepare(verb: str) -> None:
    """Import and load what a verb needs, by answering it once."""
    question = {"robot": "absolem", "stairs": "ibc", "flippers": "flat"}
    done({"kind": "live" if verb == "live" else "ask", "verb": verb, "body": question})


def refusal(status: int, kind: str, text: str) -> Done:
    """What is sent where there is no answer."""
    line = " ".join(text.split())
    return {"status": status}, json.dumps({"error": line, "kind": kind}).encode()


def _as_json(answer: Answer) -> bytes:
    """JSON on one line: line ends and indents take a fifth of the time of an estimate."""
    return json.dumps(answer.to_dict(), allow_nan=False).encode()


def _ask(task: Mapping[str, Any]) -> bytes:
    return _as_json(answered(task["verb"], task["body"]))


def _text(task: Mapping[str, Any]) -> bytes:
    answer = answered(task["verb"], task["body"])
    short = getattr(answer, "short", None)
    whole = str(answer)
    said = {"text": whole, "short": short() if short else whole.splitlines()[0]}
    return json.dumps(said).encode()


def _read(task: Mapping[str, Any]) -> bytes:
    with chdir(task["folder"]):
        return _as_json(read_of(UPLOAD, task["body"]))


def _building(task: Mapping[str, Any]) -> bytes:
    with chdir(task["folder"]):
        return _as_json(building_of(UPLOAD, task["body"]))


def _samples(task: Mapping[str, Any]) -> bytes:
    with chdir(task["folder"]):
        return json.dumps(samples_of_file(UPLOAD, task["body"])).encode()


def _report(task: Mapping[str, Any]) -> bytes:
    form, body = task["format"], dict(task["body"])
    language = body.pop("language", "en")
    if form == "json":
        return report_of(body).to_json().encode()
    from kaidan.documents import report_bytes

    return report_bytes(report_of(body), form, language)


def _sheets(task: Mapping[str, Any]) -> bytes:
    with chdir(task["folder"]):
        return json.dumps(sheets_of(UPLOAD)).encode()


def _live(task: Mapping[str, Any]) -> bytes:
    from kaidan.web.watching import begun

    return begun(task["body"])


def _feed(task: Mapping[str, Any]) -> bytes:
    from kaidan.web.watching import fed

    return fed(task["monitor"], task["samples"], task["arrived"], ends=task["ends"])


def _overdue(task: Mapping[str, Any]) -> bytes:
    from kaidan.web.watching import missed

    return missed(task["monitor"], task["now"])


def _job(task: Mapping[str, Any]) -> bytes:
    folder = Path(task["folder"])
    with chdir(folder):
        found = result_of(task["verb"], task["body"], folder)
    with whole_file(folder / RESULT, durable=True) as file:
        file.write(found.content)
    (folder / TEXT).write_text(found.text, encoding="utf-8")
    return json.dumps({"media": found.media}).encode()


_DO: Mapping[str, Callable[[Mapping[str, Any]], bytes]] = {
    "ask": _ask,
    "text": _text,
    "read": _read,
    "building": _building,
    "report": _report,
    "sheets": _sheets,
    "job": _job,
    "samples": _samples,
    "live": _live,
    "feed": _feed,
    "overdue": _overdue,
}
