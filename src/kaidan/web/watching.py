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
from kaidan.verbs.monitor.live import LiveMonitor
from kaidan.web.asking import live_question


def begun(body: Mapping[str, Any]) -> bytes:
    """First line of a climb and its monitor, in JSON.

    Parameters
    ----------
    body : mapping
        robot, stairs, direction, facing, flippers, payload, override, limits.

    Raises
    ------
    InputError
        Something else, or stairs that the monitor does not know.
    """
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


def fed(monitor: str, samples: list[list[Any]], *, ends: bool) -> bytes:
    """What samples come to: a line with the monitor and the summary, then one for each state.

    Parameters
    ----------
    monitor : str
        As `begun` or this gave it.
    samples : list
        Each with the values of a `kaidan.verbs.monitor.Sample`.
    ends : bool
        Whether the summary of all samples is wanted.
    """
    watch: LiveMonitor = pickle.loads(base64.b85decode(monitor))
    states = [watch.feed(Sample(*each)).model_dump(mode="json") for each in samples]
    said = summary(watch.answer()) if ends else None
    lines: list[dict[str, Any]] = [{"monitor": _kept(watch), "summary": said}]
    lines += [{"kind": "state", **each} for each in states]
    return b"\n".join(json.dumps(each).encode() for each in lines)


def _kept(monitor: LiveMonitor) -> str:
    return base64.b85encode(pickle.dumps(monitor)).decode()
