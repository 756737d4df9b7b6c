"""The cells of a sweep, judged one by one as `kaidan.assess` judges: same findings and verdict."""

import hashlib
import math
from collections.abc import Mapping
from functools import cache
from importlib.metadata import version as installed
from pathlib import Path
from typing import Any

import numpy as np

from kaidan.assessment import found_plan, off_plan
from kaidan.assessment.verdict import conclude
from kaidan.errors import InputError
from kaidan.models import judge
from kaidan.models.findings import Findings
from kaidan.modes import FAILURE_MODES, Verdict
from kaidan.question import Question
from kaidan.sweeps.parameters import question_of
from kaidan.sweeps.plan import Chunk
from kaidan.sweeps.screen import excluded
from kaidan.work.job import Kind, Work

NOT_GO = len(Verdict)
"""Code of a cell of which the closed form alone says that it is no GO."""
VERDICTS = (*(each.value for each in Verdict), "not-go")
"""Words of the codes of verdicts."""
REFUSED = "refused"
"""What governs a cell that has no physical meaning."""
FIGURES = ("margin_deg", "margin_best_deg", "failure_probability", "required_friction")
TEXTS = ("governs", "phase", "flippers", "facing", "refusal")
MODES = {
    key: "_".join(filter(None, (key, mode.shown_unit.replace("/", "_").replace(" ", ""))))
    for key, mode in FAILURE_MODES.items()
}
"""Failure modes and the columns of their margins."""
Row = dict[str, Any]


def judged_row(question: Question, known: Findings | None = None) -> tuple[Row, Findings]:
    """Row of a question, and its findings for another that shares them.

    question: its posture is found where it is to be.
    """
    planned, search = found_plan(question)
    if search is None or search.question is not planned:
        found = judge(planned, known=None if planned.robot.com_range else known)
    else:
        found = search.findings
    conclusion = conclude(planned, off_plan(planned, found, search))
    samples = conclusion.samples
    row: Row = {
        "verdict": conclusion.verdict.rank,
        "governs": str(conclusion.governs),
        "phase": "" if conclusion.phase is None else conclusion.phase.value,
        "step": -1 if conclusion.step is None else conclusion.step,
        "flippers": planned.flippers,
        "facing": planned.facing,
        "refusal": "",
        "margin_deg": math.degrees(conclusion.margin),
        "margin_best_deg": math.degrees(conclusion.margin_best),
        "failure_probability": math.nan if len(samples) == 1 else float(np.mean(~(samples > 0))),
        "required_friction": float(found.required_friction),
    }
    for key, column in MODES.items():
        one = found.of(FAILURE_MODES[key])
        row[column] = math.nan if one is None else one.mode.shown(one.margin(planned.risk))
    return row, found


def _without(verdict: int, governs: str, refusal: str = "") -> Row:
    """Row of a cell that is not judged."""
    words = dict.fromkeys(TEXTS, "") | {"governs": governs, "refusal": refusal}
    numbers = dict.fromkeys((*FIGURES, *MODES.values()), math.nan)
    return {"verdict": verdict, "step": -1, **words, **numbers}


def run(chunk: Chunk) -> Mapping[str, Any]:
    """Columns of a chunk: one value a cell."""
    questions: list[Question | InputError] = []
    for values in chunk.values():
        try:
            questions.append(question_of(values))
        except InputError as error:
            questions.append(error)
    keys = excluded(questions) if chunk.screen else [None] * len(questions)
    rows: list[Row] = []
    known: Findings | None = None
    for question, key in zip(questions, keys, strict=True):
        if isinstance(question, InputError):
            rows.append(_refused(question))
        elif key is not None:
            rows.append(_without(NOT_GO, key))
        else:
            try:
                row, known = judged_row(question, known)
            except InputError as error:
                row = _refused(error)
            rows.append(row)
    return {"outcome": "judged", **{name: [row[name] for row in rows] for name in LISTS}}


def _refused(error: InputError) -> Row:
    return _without(Verdict.OUTSIDE_MODEL.rank, REFUSED, str(error))


LISTS: dict[str, Kind] = {
    "verdict": "counts",
    "step": "counts",
    **dict.fromkeys(TEXTS, "texts"),
    **dict.fromkeys((*FIGURES, *MODES.values()), "numbers"),
}
"""Columns of a chunk that have a value for each cell."""


def inputs(chunk: Chunk) -> Mapping[str, Any]:
    """Which cells a chunk has."""
    return {"plan": chunk.digest, "first": chunk.first, "cells": chunk.cells}


def text(chunk: Chunk) -> str:
    """What tells a chunk from others."""
    return f"{chunk.digest} {chunk.first} {chunk.cells}"


@cache
def version() -> str:
    """Version of what a verdict depends on: kaidan, and the source of what judges."""
    package = Path(__file__).parents[1]
    apart = {"cli", "figures", "text", "lab", "verbs", "work"}
    sources = sorted(
        path for path in package.rglob("*.py") if path.relative_to(package).parts[0] not in apart
    )
    digest = hashlib.sha256(b"\0".join(path.read_bytes() for path in sources)).hexdigest()
    return f"kaidan {installed('kaidan')}, models {digest[:12]}"


CELLS = Work(
    name="cells of a sweep",
    run=run,
    inputs=inputs,
    text=text,
    version=version,
    columns={"plan": "text", "first": "count", "cells": "count", **LISTS},
    alone=False,
)
"""Cells of a sweep as the work of a campaign: a spec is a `kaidan.sweeps.plan.Chunk`."""
