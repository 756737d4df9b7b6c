"""Samples sent to a server that judges and shows them."""

import json
import math
import time
import urllib.error
import urllib.request
from typing import Any, NamedTuple, Self
from urllib.parse import urldefrag, urljoin, urlsplit

from kaidan.answer import plain
from kaidan.errors import InputError, short
from kaidan.question import Question
from kaidan.verbs.monitor.alarm import AlarmLimits
from kaidan.verbs.monitor.samples import Sample

PATIENCE = 10.0
"""How long a server may take to answer, and to have room for the question [s]."""


class Channel(NamedTuple):
    """A climb that a server watches."""

    address: str
    """Where samples go."""
    page: str
    """Where people see it."""
    token: str
    """Of the server; empty: it has none."""

    @classmethod
    def at(
        cls, url: str, question: Question, *, limits: AlarmLimits | None = None, token: str = ""
    ) -> Self:
        """Channel of a page that waits, whose address ends in its name, else a new one."""
        if urlsplit(url).scheme not in ("http", "https") or not urlsplit(url).netloc:
            raise InputError(f"--to {short(url)!r} is no address: write http://HOST:PORT/")
        if not token.isascii():
            raise InputError("--token holds characters that no server takes: copy it again")
        root, name = urldefrag(url)
        if not name:
            body = {
                "robot": question.robot.model_dump(mode="json"),
                "stairs": question.model_dump(mode="json")["terrain"],
                "direction": question.direction,
                "facing": question.facing,
                "flippers": question.posture.model_dump(mode="json"),
                "payload": [each.model_dump(mode="json") for each in question.payload],
                "limits": {} if limits is None else limits.model_dump(exclude_defaults=True),
            }
            name = str(_posted(urljoin(root, "api/live"), body, token)["id"])
        return cls(urljoin(root, f"api/live/{name}"), urljoin(root, f"live.html#{name}"), token)

    def send(self, samples: list[Sample], *, recorded: bool = False) -> None:
        """Send samples; of a recording they may come when they like."""
        given = [plain(each._asdict()) for each in samples]
        _posted(self.address, {"samples": given, "recorded": recorded}, self.token)

    def end(self) -> str:
        """End the climb; its summary."""
        return str(_posted(self.address, {"end": True}, self.token)["summary"])


def _posted(address: str, body: dict[str, Any], token: str) -> dict[str, Any]:
    headers = {"Content-Type": "application/json"}
    headers |= {"Authorization": f"Bearer {token}"} if token else {}
    asked = urllib.request.Request(address, json.dumps(body).encode(), headers)
    end = time.monotonic() + PATIENCE
    while True:
        try:
            with urllib.request.urlopen(asked, timeout=PATIENCE) as answer:
                said: dict[str, Any] = json.load(answer)
                return said
        except urllib.error.HTTPError as error:
            wait = _seconds(error)
            if time.monotonic() + wait > end:
                raise InputError(f"{short(address)}: {short(_why(error))}") from None
            time.sleep(wait)
        except (OSError, ValueError) as error:
            reason = getattr(error, "reason", error)
            raise InputError(f"{short(address)}: no answer: {short(reason)}") from None


def _seconds(error: urllib.error.HTTPError) -> float:
    """After how long a server that is busy has room again [s]; infinite for another error."""
    stated = error.headers.get("Retry-After", "") if error.code in (429, 503) else ""
    return float(stated) if stated.isdecimal() else math.inf


def _why(error: urllib.error.HTTPError) -> str:
    try:
        return str(json.load(error)["error"])
    except (ValueError, KeyError, TypeError):
        return error.reason
