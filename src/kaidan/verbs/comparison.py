"""Many robots on many stairs: one verdict and one margin a pair."""

import math
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from kaidan import catalog
from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments, several
from kaidan.assessment import with_plan
from kaidan.assessment.verdict import conclude
from kaidan.errors import InputError
from kaidan.modes import CONTACT, Direction, Facing, Verdict
from kaidan.progress import progress
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.spelling import sheet_of
from kaidan.terrain.stairs import Stairs

WORTH_A_PROCESS = 8
"""Cells of the contact model that repay the start of a process."""


class Cell(Part):
    """Verdict on one robot and one staircase."""

    robot: str
    stairs: str
    flippers: str
    """How they lie, in words or as a plan is written; empty for a robot without any."""
    direction: Direction
    facing: Facing
    """Which end leads."""
    verdict: Verdict
    governs: str
    """What decides: a failure mode, or why nothing can be said."""
    margin_deg: float | None
    """In the worst case, at the chosen risk [deg]; null outside the model."""
    margin_best_deg: float | None
    """In the best case [deg]."""
    angle_deg: float
    """Slope of the line through the nosings [deg]."""
    nosing_spacing_m: float
    """Mean distance from nosing to nosing [m]."""
    flat_length_m: float
    """L, flippers in line included [m]."""


class NoCentroid(Part):
    """Robot of which no centroid is published."""

    name: str
    title: str
    figures: str
    """What is published of it."""


class Comparison(Answer):
    """A verdict for each pair of a robot and a staircase."""

    text_module = "kaidan.text.comparison"

    model: str
    """Which model judged."""
    direction: Direction | None
    """Which way all robots go; null where each goes as the stairs' sheet says."""
    facing: Facing | None
    """Which end leads; null where each cell has its own, as it was found."""
    planned: bool
    """Whether the flippers' best posture was found for each cell."""
    acceleration: float
    """Up the stairs [m/s^2]."""
    surface: str | None
    """Surface under the tracks; null where none was stated."""
    robots: tuple[str, ...]
    """Columns of the table."""
    stairs: tuple[str, ...]
    """Rows of the table."""
    cells: tuple[Cell, ...]
    """Row by row."""
    without_centroid: tuple[NoCentroid, ...]
    """Robots that cannot be judged."""
    belts_open: tuple[str, ...]
    """Robots of which no sheet says whether their belts have grousers: they count as smooth."""

    @property
    def rows(self) -> tuple[tuple[Cell, ...], ...]:
        """Cells of each staircase."""
        wide = len(self.robots)
        return tuple(self.cells[at : at + wide] for at in range(0, len(self.cells), wide))

    def posture(self, column: int) -> str:
        """How the flippers of a robot lie on all stairs; empty: it has none, or they differ."""
        each = {row[column].flippers for row in self.rows}
        return each.pop() if len(each) == 1 else ""

    def columns(self) -> dict[str, list[Any]]:
        """Columns of a table with one line a cell."""
        return {name: [getattr(cell, name) for cell in self.cells] for name in Cell.model_fields}


@known_arguments
def compare(
    robots: Sequence[Any] | None = None,
    stairs: Sequence[Any] | None = None,
    *,
    flippers: Any = None,
    workers: int | None = 1,
    **manner: Any,
) -> Comparison:
    """Set many robots against many stairs: a verdict and a margin for each pair.

    Parameters
    ----------
    robots : sequence of Robot, str or path, optional
        Robots; all of the catalogue without them.
    stairs : sequence of Stairs, str or path, optional
        Stairs; all of the catalogue without them.
    flippers : Posture or {"best", "flat", "stowed"}, optional
        Posture of the flippers, flat where there are some. Without one the best for each pair,
        which end leads too where *facing* is not stated.
    workers : int, optional
        Processes that share the cells of the contact model (a script that asks for more than one
        needs ``if __name__ == "__main__":``); None: one for each processor.
    **manner
        As in `kaidan.assess`.

    Raises
    ------
    InputError
        An input without physical meaning, or no robot that can be judged.

    Examples
    --------
    >>> found = compare(["absolem"], ["ibc", "osha-ship"], friction=0.8, model="closed-form")
    >>> [(cell.stairs, str(cell.verdict)) for cell in found.cells]
    [('ibc', 'go'), ('osha-ship', 'no-go')]
    """
    gross = catalog.gross_robots()
    asked = [*catalog.names("robots"), *gross] if robots is None else several("robots", robots)
    apart = [each for each in asked if isinstance(each, str) and each.strip().lower() in gross]
    known = [sheet_of(each, Robot)
             for each in asked if each not in apart]  # fmt: skip
    if not asked:
        raise InputError("compare: no robots are given")
    if not known:
        raise InputError(f"no centroid is published of {', '.join(apart)}: nothing to compare")
    flights = [
        sheet_of(each, Stairs)
        for each in (catalog.names("stairs") if stairs is None else several("stairs", stairs))
    ]
    if not flights:
        raise InputError("compare: no stairs are given")
    questions = [
        Question.of(robot, flight, flippers=laid(robot, flippers), **manner)
        for flight in flights
        for robot in known
    ]
    first = questions[0]
    # a plan of many flippers takes longest: at the end short cells keep all processes at work
    longest = sorted(range(len(questions)), key=lambda at: -len(questions[at].robot.flippers()))
    with _judging([questions[at] for at in longest], workers) as judging:
        judged = {at: next(judging) for at in progress(longest, "traverses judged")}
    directions = {each.direction for each in questions}
    return Comparison(
        model=first.model,
        direction=first.direction if len(directions) == 1 else None,
        facing=None if "facing" in first.best_of else first.facing,
        planned=any("flippers" in each.best_of for each in questions),
        acceleration=first.acceleration,
        surface=first.surface.name if first.surface else None,
        robots=[robot.name for robot in known],
        stairs=[flight.name for flight in flights],
        cells=[judged[at] for at in range(len(questions))],
        without_centroid=[_no_centroid(name.strip().lower()) for name in apart],
        belts_open=[
            each.robot.name
            for each in questions[: len(known)]
            if each.robot.track.belt is None and not each.robot.track.has_grousers
        ],
    )


def laid(robot: Robot, flippers: Any) -> Any:
    """Posture to ask with: flat means stowed for a robot that has no flippers."""
    bare = robot.front_flippers is None and robot.rear_flippers is None
    is_flat = isinstance(flippers, str) and flippers.strip() == "flat"
    return "stowed" if bare and is_flat else flippers


@contextmanager
def _judging(questions: Sequence[Question], workers: int | None) -> Iterator[Iterator[Cell]]:
    """Cells of some questions one by one; many share several processes."""
    from kaidan.work.local import hands

    most = sum(each.model == CONTACT.name for each in questions) // WORTH_A_PROCESS
    count = min(hands(workers), most)
    if count < 2:
        yield map(_cell, questions)
        return
    import multiprocessing
    import threading
    from concurrent.futures import ProcessPoolExecutor

    from kaidan.work.local import become_worker

    # a copy of a process knows its modules already; safe on Linux, where no thread is at work
    copies = sys.platform == "linux" and threading.active_count() == 1
    ways = multiprocessing.get_context("fork" if copies else "spawn")
    with ProcessPoolExecutor(count, ways, initializer=become_worker) as pool:
        try:
            yield pool.map(_cell, questions)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def _no_centroid(name: str) -> NoCentroid:
    entry = catalog.gross_robots()[name]
    return NoCentroid(name=name, title=entry["title"], figures=entry.get("figures", ""))


def _cell(question: Question) -> Cell:
    question, findings, _ = with_plan(question)
    conclusion = conclude(question, findings)
    flight = question.steepest_flight
    assert flight is not None
    return Cell(
        robot=question.robot.name,
        stairs=question.terrain_name,
        flippers=_posture(question),
        direction=question.direction,
        facing=question.facing,
        verdict=conclusion.verdict,
        governs=str(conclusion.governs),
        margin_deg=math.degrees(conclusion.margin),
        margin_best_deg=math.degrees(conclusion.margin_best),
        angle_deg=math.degrees(flight.angle),
        nosing_spacing_m=flight.nosing_spacing,
        flat_length_m=question.stance.flat_length,
    )


def _posture(question: Question) -> str:
    """How the flippers lie, in words; empty for a robot without any."""
    robot, posture = question.robot, question.posture
    if question.changes:
        return question.flippers
    ends = {
        "front": (robot.front_flippers, posture.front),
        "rear": (robot.rear_flippers, posture.rear),
    }
    lie = {
        end: "stowed" if at is None else at if isinstance(at, str) else f"{math.degrees(at):g} deg"
        for end, (pair, at) in ends.items()
        if pair is not None
    }
    if len(set(lie.values())) <= 1:
        return next(iter(lie.values()), "")
    return ", ".join(f"{end} {at}" for end, at in lie.items())
