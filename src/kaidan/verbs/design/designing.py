"""`kaidan.design`: figures of a robot for stairs that are to be taken."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from kaidan.arguments import known_arguments, table, whole
from kaidan.errors import InputError
from kaidan.modes import CONTACT, Verdict
from kaidan.spelling import word_of
from kaidan.sweeps.parameters import question_of, settled
from kaidan.sweeps.plan import Along, Plan
from kaidan.sweeps.running import carried_out
from kaidan.sweeps.swept import Swept
from kaidan.verbs.design.answer import Design, DesignMap, FreeFigure, FrontPoint, OnStairs
from kaidan.verbs.design.postures import planned
from kaidan.verbs.design.problem import Problem, Tried, cell_of, free_of, terrain_name
from kaidan.verbs.design.search import GOALS, Goal, best_of, optimised

MOST_TRIES = 1_000_000
"""Most designs that a search judges, and largest seed of one."""
MOST_GRID = 1001
_MORE = 3
"""Times that the search begins again where the map has a better place."""


@known_arguments
def design(
    robot: Any,
    stairs: Any = None,
    *,
    free: Mapping[str, Any],
    goal: Goal = "margin",
    weights: Mapping[str, float] | None = None,
    grid: int | None = None,
    front: int = 0,
    tries: int = 400,
    seed: int = 0,
    scheduler: str = "threads",
    workers: int | None = None,
    progress: bool = False,
    **manner: Any,
) -> Design:
    """Figures of a robot with which it takes stairs best, or with the least change.

    Parameters
    ----------
    robot : Robot, str or path
        Robot of which some figures are free.
    stairs : Stairs, Profile, str, path, a tuple of flights or a list of these, optional
        Stairs to be taken, all of them; codes of the catalogue are among them.
    free : mapping of str to (low, high) or str
        Free figures and their ranges: ``{"com_from_front": (0.2, 0.4)}``; names as `kaidan.sweep`
        has them, ``payload.height`` and ``front_flippers.length`` too.
    goal : {"margin", "go"}
        The largest margin on the worst of the stairs; or the cheapest change that is a GO on all.
    weights : mapping of str to float, optional
        Cost of changing a figure over its whole range; 1 each without.
    grid : int, optional
        Places along each of the first two figures of a map; 21 without one, 0 for no map.
    front : int
        Budgets between no change and the dearest for which the best design is sought: the front of
        cost and margin.
    tries : int
        Designs that a search judges at most.
    seed : int
        Of the search.
    scheduler, workers, progress
        Of the map, see `kaidan.sweep`.
    **manner
        Everything else of a question, see `kaidan.Question.of`. Without `flippers` all designs are
        judged in the plan that `kaidan.assess` finds for the robot as it stands, off its angles
        too; where the design found has a better plan the search begins anew in it. With "best"
        every design has a search of its own, which takes long.

    Returns
    -------
    Design
        No place of the map is better than the design found.

    Raises
    ------
    InputError
        An unknown figure, a range without width, no design with a physical meaning.
    MissingExtraError
        scipy is not installed.

    Examples
    --------
    >>> found = design("absolem", "iso-14122-3", free={"com_height": (0.05, 0.3)}, friction=3.0,
    ...                flippers="flat", model="closed-form")
    >>> found.verdict, found.free[0].best
    ('go', 0.0656)
    """
    word_of("goal", goal, GOALS)
    values = {"robot": settled("robot", robot), **manner}
    if manner.get("payload") is not None:
        values["payload"] = settled("payload", manner["payload"])
    each = stairs if isinstance(stairs, list) else [stairs]
    terrains = [settled("stairs", one) for one in each]
    chosen = free_of(
        values | {"stairs": terrains[0]},
        table("free", free),
        table("weights", {} if weights is None else weights),
    )
    places = (21 if len(chosen) > 1 else 0) if grid is None else whole("grid", grid, 0, MOST_GRID)
    if places == 1:
        raise InputError(f"grid = 1 is not within 2 to {MOST_GRID} places")
    counts = (("front", front, 0), ("tries", tries, 1), ("seed", seed, 0))
    for name, given, least in counts:
        whole(name, given, least, MOST_TRIES)
    how = {"scheduler": scheduler, "workers": workers, "progress": progress}

    def sought(problem: Problem) -> tuple[Problem, Tried, Swept | None]:
        best, found = _sought(problem, goal, places if len(chosen) > 1 else 0, tries, seed, how)
        return problem, best, found

    problem = Problem(values, terrains, chosen)
    stated = manner.get("flippers") is not None
    if not stated:
        stands = [(at.low + at.high) / 2 if at.now is None else at.now for at in chosen]
        problem = planned(problem, stands)
    now = problem.now()
    problem, best, found = sought(problem)
    if not stated and not (goal == "go" and best.goes):
        other = planned(problem, best.values)
        if other.at(best.values).merit > best.merit:
            problem, best, found = sought(other)
    points = _front(problem, front, tries, seed)
    return _answer(problem, goal, now, best, found, points, manner.get("model", CONTACT.name))


def _sought(
    problem: Problem, goal: Goal, places: int, tries: int, seed: int, how: dict[str, Any]
) -> tuple[Tried, Swept | None]:
    """Best design, and the map around it, of which no place is better."""
    best = optimised(problem, goal, tries=tries, seed=seed)
    if best.worst.governs == "refused":
        question_of({**problem.values, **problem.ways[0], **_named(problem, best)})
    if not places:
        return best, None
    for _ in range(_MORE):
        found = _mapped(problem, best, places, how)
        better = _better_on(problem, found, goal)
        if better == best:
            break
        best = optimised(problem, goal, tries=tries // 4, seed=seed)
    return best, found


def _named(problem: Problem, tried: Tried) -> dict[str, float]:
    return {each.name: at for each, at in zip(problem.free, tried.values, strict=True)}


def _mapped(problem: Problem, best: Tried, places: int, how: dict[str, Any]) -> Swept:
    """Map over the first two free figures, the others as in a design."""
    x, y, *_ = problem.free
    lines = {
        each.name: list(
            dict.fromkeys(map(each.rounded, np.linspace(each.low, each.high, places).tolist()))
        )
        for each in (y, x)
    }
    first, *_ = ways = problem.ways
    along = {name: Along("stairs", [way[name] for way in ways]) for name in first}
    values = {**problem.values, **_named(problem, best), **lines}
    return carried_out(Plan.of(values | (along if len(ways) > 1 else first)), **how)


def _by_place(problem: Problem, found: Swept) -> Any:
    """Indices of the map's variables: y, x, stairs."""
    x, y, *_ = problem.free
    dims = [y.name, x.name, *(["stairs"] if "stairs" in found.plan.labels else [])]
    order = [list(found.plan.labels).index(dim) for dim in dims]

    def of(name: str) -> Any:
        array = found.variables[name].transpose(order)
        return array if len(dims) == 3 else array[..., None]

    return of


def _better_on(problem: Problem, found: Swept, goal: Goal) -> Tried:
    """Best design with those of a map."""
    of = _by_place(problem, found)
    x, y, *_ = problem.free
    arrays = {name: of(name) for name in found.variables}
    rest = {name: value for name, value in found.plan.base.items() if name in _names(problem)}
    names = [terrain_name(each) for each in problem.stairs]
    for j, at_y in enumerate(found.plan.labels[y.name]):
        for i, at_x in enumerate(found.plan.labels[x.name]):
            place = rest | {x.name: at_x, y.name: at_y}
            values = tuple(float(place[each.name]) for each in problem.free)
            if values in problem.tried:
                continue
            cells = tuple(
                cell_of(name, {key: array[j, i, k] for key, array in arrays.items()})
                for k, name in enumerate(names)
            )
            cost = sum(each.cost(v) for each, v in zip(problem.free, values, strict=True))
            problem.tried[values] = Tried(values, cost, cells)
    return best_of(problem, goal)


def _names(problem: Problem) -> set[str]:
    return {each.name for each in problem.free}


def _front(problem: Problem, count: int, tries: int, seed: int) -> list[Tried]:
    """Best designs of budgets from none to the dearest that gains anything; none dominated."""
    if count <= 0:
        return []
    dearest = best_of(problem, "margin").cost
    found: list[Tried] = []
    for k in range(count + 1):
        budget = dearest * k / count
        each = optimised(problem, "margin", tries=tries // 4, seed=seed + k, budget=budget)
        if not found or each.merit > found[-1].merit:
            found.append(each)
    return found


def _answer(
    problem: Problem,
    goal: Goal,
    now: Tried | None,
    best: Tried,
    found: Swept | None,
    front: list[Tried],
    model: str,
) -> Design:
    return Design(
        robot=problem.values["robot"].name,
        stairs=[each.stairs for each in best.cells],
        model=model,
        goal=goal,
        free=[
            FreeFigure(
                name=each.name, unit=each.unit, low=each.low, high=each.high, now=each.now, best=at
            )
            for each, at in zip(problem.free, best.values, strict=True)
        ],
        verdict=best.worst.verdict.value,
        governs=best.worst.governs,
        margin_deg=best.worst.margin,
        verdict_now=None if now is None else now.worst.verdict.value,
        margin_now_deg=None if now is None else now.worst.margin,
        cost=best.cost,
        on_stairs=[
            OnStairs(
                stairs=each.stairs,
                verdict=each.verdict.value,
                governs=each.governs,
                margin_deg=each.margin,
                facing=each.facing,
                flippers=each.flippers,
            )
            for each in best.cells
        ],
        tried=len(problem.tried),
        grid=0 if found is None else len(found) // len(problem.stairs),
        map=None if found is None else _map_of(problem, found),
        front=[
            FrontPoint(
                cost=each.cost,
                verdict=each.worst.verdict.value,
                margin_deg=each.worst.margin,
                values=each.values,
            )
            for each in front
        ],
    )


def _map_of(problem: Problem, found: Swept) -> DesignMap:
    of = _by_place(problem, found)
    x, y, *_ = problem.free
    verdicts = of("verdict").max(axis=-1)
    margins = of("margin_deg").min(axis=-1)
    return DesignMap(
        x=x.name,
        y=y.name,
        x_values=found.plan.labels[x.name],
        y_values=found.plan.labels[y.name],
        verdicts=verdicts.tolist(),
        margins_deg=[[None if math.isnan(m) else m for m in row] for row in margins.tolist()],
        share_go=float(np.mean(verdicts == Verdict.GO.rank)),
    )
