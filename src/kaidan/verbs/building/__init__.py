"""A building model: its flights, what each robot can do on them, and the ways to its storeys."""

import math
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from kaidan.arguments import known_arguments, several
from kaidan.errors import InputError, did_you_mean, listed, shown
from kaidan.mechanics.clearance import tip_hook_margin
from kaidan.outline import Outline
from kaidan.progress import progress, working
from kaidan.question import Question
from kaidan.readers.assembly import building_of
from kaidan.readers.building import Building, Element, Flight
from kaidan.readers.formats.ifc import read
from kaidan.readers.hints import Hints
from kaidan.readers.interpreters.building import flight_sheet
from kaidan.readers.opening import Source
from kaidan.readers.recognition import recognised
from kaidan.robot import Robot
from kaidan.spelling import BEST, robot_of, word_of
from kaidan.terrain.stairs import Stairs
from kaidan.text.building import disagreement, hooking
from kaidan.verbs.building.answer import (
    BuildingAnswer,
    CellShown,
    ElementShown,
    FlightShown,
    FloorShown,
    StoreyShown,
    TurnShown,
    WayShown,
)
from kaidan.verbs.building.judging import Judge
from kaidan.verbs.building.turning import turn_on
from kaidan.verbs.building.ways import doors_of, ways_of

_POINTS = 4
"""Digits of places in the plan [m]."""


@known_arguments
def building(
    file: Any,
    robots: Sequence[Any],
    *,
    flippers: Any = BEST,
    direction: str = "up",
    start: str | None = None,
    **manner: Any,
) -> BuildingAnswer:
    """What robots can do in a building: each flight, each landing, and the way to each storey.

    Parameters
    ----------
    file : str or path
        Building model: IFC2x3, IFC4 or IFC4x3, also zipped.
    robots : sequence of Robot, str or path
        Robots.
    flippers : Posture or {"flat", "stowed", "best"}
        Posture on the flights, as in `kaidan.assess`: best finds a plan for each pair; flat lays
        the flippers in line with the track where there are some. On landings a robot may raise
        them.
    direction : {"up", "down"}
        In which the table of all flights is judged. Ways lead up and down as they must.
    start : str, optional
        Name of the storey from which the ways begin; without it the one nearest to level zero.
    **manner
        As in `kaidan.assess`: surface, friction, risk and so on.

    Returns
    -------
    BuildingAnswer
        Also where there are no flights, or no robot gets anywhere.

    Raises
    ------
    InputError
        A file that is no readable building model, or an input without physical meaning.
    MissingExtraError
        Without the extra ``ifc``.
    """
    sheets = [robot_of(each) for each in several("robots", robots)]
    if not sheets:
        raise InputError("building: name at least one robot")
    if not isinstance(file, str | Path):
        raise InputError(f"building: file = {shown(file)} is not a path")
    if not isinstance(start, str | None):
        raise InputError(f"building: start = {shown(start)} is not the name of a storey")
    word_of("direction", direction, ("up", "down"))
    for each in sheets:  # refuses what no question takes before anything is read
        Question.of(each, Stairs(rise=0.18, going=0.28), direction=direction, **manner)
    source = Source.of(file)
    form = recognised(source)
    if form.kind != "building":
        raise source.refuse(f"{form.title} is no building model; write an IFC file")
    with working("the model is read"):
        bodies = read(source, Hints())
        found = building_of(bodies)
    return _answered(found, str(bodies.facts["schema"]), sheets, Judge(flippers, manner),
                     direction, start, manner)  # fmt: skip


def _answered(
    found: Building,
    schema: str,
    robots: list[Robot],
    judge: Judge,
    direction: str,
    start: str | None,
    manner: dict[str, Any],
) -> BuildingAnswer:
    flights = list(found.flights)
    stairs = {each.identity: flight_sheet(found, each) for each in flights}
    storeys = [
        StoreyShown(identity=each.identity, name=each.name, level_m=each.level)
        for each in found.storeys
    ]
    first = _start(storeys, start)
    pairs = [(flight, robot) for flight in flights for robot in robots]
    cells = [
        judge.cell(robot, flight, stairs[flight.identity], direction)
        for flight, robot in progress(pairs, "traverses judged")
    ]
    doors = list(doors_of(found))
    turns: list[TurnShown] = []
    ways: list[WayShown] = []
    for robot in robots:
        cell, turn = _asked(found, judge, robot, stairs)
        turns += [turn(*pair) for pair in _on_landings(found, flights)]
        if first is not None:
            ways += ways_of(found, robot, first, storeys, cell=cell, turn=turn, doors=doors)
    question = Question.of(robots[0], Stairs(rise=0.18, going=0.28), **manner)
    return BuildingAnswer(
        path=found.provenance.path,
        digest=found.provenance.digest,
        ifc_schema=schema,
        direction=direction,
        surface=question.surface.name if question.surface else None,
        start=first.name if first else "",
        robots=[each.name for each in robots],
        storeys=storeys,
        flights=[_flight(each, stairs[each.identity], robots) for each in flights],
        floors=[
            FloorShown(
                key=each.key,
                name=each.name,
                level_m=each.level,
                landing=not each.storey,
                outlines=[_places(outline) for outline in each.outlines],
                walls=_places(each.walls),
            )
            for each in found.floors.values()
        ],
        cells=cells,
        turns=turns,
        doors=doors,
        ways=ways,
        elements=[_element(each) for each in found.elements],
        notes=list(found.provenance.notes),
    )


def _asked(found: Building, judge: Judge, robot: Robot, stairs: dict[str, Stairs]) -> Any:
    """Verdicts and turns of one robot, each worked out once."""

    def cell(flight: Flight, up: bool) -> CellShown:
        return judge.cell(robot, flight, stairs[flight.identity], "up" if up else "down")

    @cache
    def turn(before: Flight, after: Flight) -> TurnShown:
        return turn_on(found, robot, before, after, cell(before, True).flippers)

    return cell, turn


def _on_landings(found: Building, flights: list[Flight]) -> list[tuple[Flight, Flight]]:
    """Flights that meet on a landing."""
    return [
        (before, after)
        for before in flights
        for after in flights
        if before.upper == after.lower and not found.floors[before.upper].storey
    ]


def _start(storeys: Sequence[StoreyShown], named: str | None) -> StoreyShown | None:
    """Storey from which the ways begin; None: the model has none."""
    if named is None:
        return min(storeys, key=lambda one: abs(one.level_m), default=None)
    for each in storeys:
        if named.strip().lower() in (each.name.lower(), each.identity.lower()):
            return each
    names = [each.name for each in storeys]
    hint = did_you_mean(named, names) or f"; known: {listed(names)}"
    raise InputError(f"building: no storey is called {shown(named)}{hint}")


def _hooking(flight: Flight, robots: Sequence[Robot]) -> Iterator[str]:
    """Robots whose ends may get under a nosing of open risers."""
    clear = flight.estimate.regular.rise  # however thin the boards are
    if not flight.estimate.open_risers:
        return
    for robot in robots:
        radii = Outline.of(robot).parts.reshape(-1, 3)[:, 2]
        smallest = float(radii[radii > 0].min(initial=np.inf))
        if tip_hook_margin(R=smallest, clear=clear) < 0:
            yield hooking(robot.name, smallest, clear)


def _flight(flight: Flight, sheet: Stairs, robots: Sequence[Robot]) -> FlightShown:
    estimate = flight.estimate
    left, right = estimate.left[:, :2], estimate.right[:, :2]
    (rise, going), rises = sheet.mean_step, estimate.drawn_rises
    return FlightShown(
        identity=flight.identity,
        name=flight.name,
        storey=flight.storey,
        category=flight.category,
        steps=len(estimate),
        rise_m=round(rise, 6),
        going_m=round(going, 6),
        first_rise_m=round(float(rises[0]), 6) if estimate.begins else None,
        last_rise_m=round(float(rises[-1]), 6),
        angle_deg=math.degrees(sheet.angle),
        nosing_spacing_m=sheet.nosing_spacing,
        irregularity_m=sheet.irregularity,
        width_m=estimate.width,
        headroom_m=estimate.headroom,
        overhang_m=estimate.overhang,
        open_risers=estimate.open_risers,
        lower=flight.lower,
        upper=flight.upper,
        notes=[*estimate.notes, *_hooking(flight, robots)],
        lane=_places(flight.lane),
        nosings=_places(np.hstack([left, right])),
        elements=flight.elements,
        sheet=sheet,
    )


def _element(found: Element) -> ElementShown:
    return ElementShown(
        identity=found.identity,
        name=found.name,
        category=found.category,
        kind=found.kind,
        storey=found.storey,
        outcome=found.outcome,
        flights=found.flights,
        reasons=[str(each) for each in found.refusals],
        notes=[disagreement(one) for one in found.stated if not one.agrees],
    )


def _places(rows: Any) -> list[tuple[float, ...]]:
    return [tuple(row) for row in np.asarray(rows).round(_POINTS).tolist()]
