"""A climb that is watched, as workers judge it: between two tasks its monitor is a text.

Whoever keeps that text cannot lose a climb to a worker that dies, and never opens it: only a
worker reads what a worker wrote.
"""

import base64
import json
import math
import pickle
from collections.abc import Mapping
from typing import Any

from kaidan.errors import InputError, short, shown
from kaidan.text.monitor import summary
from kaidan.verbs.monitor import AlarmLimits, Sample
from kaidan.verbs.monitor.live import LiveMonitor, LiveState
from kaidan.web.asking import live_question


def begun(body: Mapping[str, Any]) -> bytes:
    """First line of a climb and its monitor, in JSON."""
    asked = dict(body)
    given = asked.pop("limits", None) or {}
    if not isinstance(given, Mapping):
        raise InputError(f"limits = {shown(given)} is not a table")
    limits = AlarmLimits.model_validate(given)
    question = live_question(asked)
    monitor = LiveMonitor(question, limits=limits)
    head = {
        "robot": short(question.robot.name),
        "stairs": short(question.terrain_name),
        "direction": question.direction,
        "facing": question.facing,
        "slope_deg": math.degrees(monitor.slope),
        "margin_on_deg": math.degrees(limits.margin_on),
        "time_on_s": limits.time_on,
        "horizon_s": limits.horizon,
    }
    return json.dumps({"head": head, "monitor": _kept(monitor)}).encode()


def fed(monitor: str, samples: list[list[Any]], arrived: float | None, *, ends: bool) -> bytes:
    """What samples come to: a line on the monitor, then one for each state.

    monitor: as `begun` or this gave it.
    samples: each with the values of a `kaidan.verbs.monitor.Sample`.
    arrived: when they came [s]; None where their stamps alone tell the time.
    """
    watch = _opened(monitor)
    states = [watch.feed(Sample(*each), arrived) for each in samples]
    return _said(watch, states, summary(watch.answer()) if ends else None)


def missed(monitor: str, now: float) -> bytes:
    """What it comes to that no sample has come until now [s], as `fed` says it."""
    watch = _opened(monitor)
    state = watch.overdue(now)
    return _said(watch, [] if state is None else [state])


def _said(watch: LiveMonitor, states: list[LiveState], text: str | None = None) -> bytes:
    lines = [{"kind": "state", **each.model_dump(mode="json")} for each in states]
    due = lines[-1]["due_s"] if lines else None
    lines.insert(0, {"monitor": _kept(watch), "summary": text, "due_s": due})
    return b"\n".join(json.dumps(each).encode() for each in lines)


def _opened(monitor: str) -> LiveMonitor:
    watch: LiveMonitor = pickle.loads(base64.b85decode(monitor))
    return watch


def _kept(monitor: LiveMonitor) -> str:
    return base64.b85encode(pickle.dumps(monitor)).decode()
