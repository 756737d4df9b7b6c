"""Tasks of a worker process, each answered with a status and what is to be sent."""

import json
import os
from collections.abc import Callable, Mapping
from typing import Any

from kaidan.answer import Answer
from kaidan.errors import KaidanError, MissingExtraError, RefusedError
from kaidan.web.asking import answered, building_of, read_of, report_of

Done = tuple[dict[str, Any], bytes]
"""How a task ended, and what is to be sent."""


def done(task: Mapping[str, Any]) -> Done:
    """What comes of a task; whatever goes wrong is an answer too.

    Parameters
    ----------
    task : mapping
        ``kind`` and what that kind needs.
    """
    try:
        return {"status": 200}, _DO[task["kind"]](task)
    except RefusedError as error:
        return refusal(422, "refused", str(error))
    except MissingExtraError as error:
        return refusal(422, "missing-extra", str(error))
    except KaidanError as error:
        return refusal(422, "input", str(error))
    except MemoryError:
        return refusal(422, "memory", "the answer needs more memory than a question may take")
    except Exception as error:
        from traceback import extract_tb

        frames = extract_tb(error.__traceback__)
        place = f"{os.path.basename(frames[-1].filename)}:{frames[-1].lineno}"
        return refusal(
            500, "fault", f"a fault of kaidan itself, {type(error).__name__} in {place}: {error}"
        )


def refusal(status: int, kind: str, text: str) -> Done:
    """What is sent where there is no answer."""
    line = " ".join(text.split())
    return {"status": status}, json.dumps({"error": line, "kind": kind}).encode()


def _as_json(answer: Answer) -> bytes:
    return answer.to_json().encode()


def _ask(task: Mapping[str, Any]) -> bytes:
    return _as_json(answered(task["verb"], task["body"]))


def _text(task: Mapping[str, Any]) -> bytes:
    answer = answered(task["verb"], task["body"])
    short = getattr(answer, "short", None)
    whole = str(answer)
    said = {"text": whole, "short": short() if short else whole.splitlines()[0]}
    return json.dumps(said).encode()


def _read(task: Mapping[str, Any]) -> bytes:
    return _as_json(read_of(_uploaded(task), task["body"]))


def _building(task: Mapping[str, Any]) -> bytes:
    return _as_json(building_of(_uploaded(task), task["body"]))


def _report(task: Mapping[str, Any]) -> bytes:
    form = task["format"]
    if form == "json":
        return _as_json(report_of(task["body"]))
    from kaidan.documents import report_bytes

    return report_bytes(report_of(task["body"]), form)


def _sheets(task: Mapping[str, Any]) -> bytes:
    from kaidan.web.sheets import sheets_of

    return json.dumps(sheets_of(_uploaded(task))).encode()


def _uploaded(task: Mapping[str, Any]) -> str:
    """Name of the one file in the folder of a task, which becomes the process's own."""
    os.chdir(task["folder"])
    part = task.get("part")
    return f"{task['file']}#{part}" if part else str(task["file"])


_DO: Mapping[str, Callable[[Mapping[str, Any]], bytes]] = {
    "ask": _ask,
    "text": _text,
    "read": _read,
    "building": _building,
    "report": _report,
    "sheets": _sheets,
}
