"""Many robots on many stairs: one verdict and one margin a pair."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from kaidan import catalog, contact
from kaidan.assessment import DEFAULT_MODEL, MODELS
from kaidan.assessment.answer import Verdict
from kaidan.assessment.case import Case
from kaidan.assessment.closed_form import judge
from kaidan.assessment.contact_model import climb_of
from kaidan.assessment.readings import reading_of
from kaidan.assessment.ruling import ruling
from kaidan.errors import InputError
from kaidan.report.progress import progress

WORTH_COMPILING = 40
"""Ways from which on the compiled contact kernel, if it is there, is worth its loading."""

SYMBOLS: dict[Verdict, str] = {"go": "+", "caution": "~", "no-go": "x", "outside-model": "?"}
"""A sign for each verdict that needs no colour and no special type."""

WORDS: dict[Verdict, str] = {
    "go": "GO",
    "caution": "CAUTION",
    "no-go": "NO-GO",
    "outside-model": "OUTSIDE",
}


class Cell(NamedTuple):
    """Verdict on one robot and one staircase."""

    robot: str
    stairs: str
    flippers: str
    direction: str
    verdict: Verdict
    governs: str
    margin_deg: float
    """Worst reading, at the chosen risk; NaN outside the model."""
    margin_at_best_deg: float
    angle_deg: float
    nosing_spacing_m: float
    flat_length_m: float


class NoCentroid(NamedTuple):
    """Robot of which no centroid is published."""

    name: str
    title: str
    figures: str


class Matrix(NamedTuple):
    """Cells row by row: stairs by robots."""

    stairs: tuple[str, ...]
    """Rows."""
    robots: tuple[str, ...]
    """Columns."""
    cells: tuple[tuple[Cell, ...], ...]
    conditions: str
    """What holds for all cells, in words."""
    model: str
    """Which model judged: contact or closed-form."""
    without_centroid: tuple[NoCentroid, ...]

    def columns(self) -> dict[str, list[Any]]:
        """Columns of a table with one line a cell."""
        flat = [cell for row in self.cells for cell in row]
        return {name: [getattr(cell, name) for cell in flat] for name in Cell._fields}

    def as_dict(self) -> dict[str, Any]:
        """Everything, for JSON."""
        return {
            "model": self.model,
            "conditions": self.conditions,
            "robots": self.robots,
            "stairs": self.stairs,
            "cells": [cell._asdict() for row in self.cells for cell in row],
            "without_centroid": [robot._asdict() for robot in self.without_centroid],
        }


def matrix(
    cases: Sequence[Sequence[Case]],
    *,
    model: str = DEFAULT_MODEL,
    conditions: str = "",
    without_centroid: Sequence[str] = (),
) -> Matrix:
    """Verdicts on a table of cases.

    Parameters
    ----------
    cases : sequence of sequences of Case
        One row a staircase, one column a robot.
    model : {"contact", "closed-form"}
        Which model judges, as in `kaidan.assess`.
    conditions : str
        What holds for all cells, in words.
    without_centroid : sequence of str
        Catalogue names of robots that cannot be judged, to be named beside the table.

    Returns
    -------
    Matrix

    Raises
    ------
    InputError
        An unknown model.
    """
    if model not in MODELS:
        raise InputError(f"model = {model!r} is not known; known: {', '.join(MODELS)}")
    flat = [case for row in cases for case in row]
    compiled = None
    if model == "contact" and len(flat) >= WORTH_COMPILING and contact.numba_is_installed():
        compiled = True
    done = iter([cell(case, model, compiled) for case in progress(flat, "ways judged")])
    rows = tuple(tuple(next(done) for _ in row) for row in cases)
    gross = catalog.gross_robots()
    return Matrix(
        stairs=tuple(row[0].stairs for row in rows),
        robots=tuple(each.robot for each in rows[0]),
        cells=rows,
        conditions=conditions,
        model=model,
        without_centroid=tuple(
            NoCentroid(name, str(gross[name]["title"]), str(gross[name].get("figures", "")))
            for name in without_centroid
        ),
    )


def cell(case: Case, model: str, compiled: bool | None = None) -> Cell:
    """Verdict on one case."""
    found = judge(case)
    verdict, governs = found.verdict, found.governs
    margin, at_best = found.margin, found.margin_at_best
    if model == "contact":
        way = climb_of(case, compiled=compiled)
        told = ruling(case, way, accept="no-rotation")
        verdict, governs, margin = told.verdict, told.governs, told.margin
        at_best = math.nan
        if verdict != "outside-model":
            at_best = reading_of(case, way, kind=True).worst
    return Cell(
        robot=case.robot.name,
        stairs=case.stairs.name,
        flippers=_posture(case),
        direction=case.direction,
        verdict=verdict,
        governs=governs,
        margin_deg=math.degrees(margin),
        margin_at_best_deg=math.degrees(at_best),
        angle_deg=math.degrees(float(found.nominal.theta_s[0, found.step])),
        nosing_spacing_m=float(found.nominal.p[0, found.step]),
        flat_length_m=found.stance.flat_length,
    )


def _posture(case: Case) -> str:
    """How the flippers lie, in words; empty for a robot without any."""
    robot, posture = case.robot, case.posture
    ends = {
        "front": (robot.front_flippers, posture.front),
        "rear": (robot.rear_flippers, posture.rear),
    }
    told = {
        end: "stowed" if at is None else at if isinstance(at, str) else f"{math.degrees(at):g} deg"
        for end, (pair, at) in ends.items()
        if pair is not None
    }
    if len(set(told.values())) <= 1:
        return next(iter(told.values()), "")
    return ", ".join(f"{end} {at}" for end, at in told.items())
