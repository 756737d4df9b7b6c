"""The search for a design, by scipy's differential evolution from a grid and with a fixed seed.

The verdict jumps where another failure mode takes over, so nothing here asks for a slope. What is
compared is one number: for the largest margin the merit of the worst stairs; for the cheapest GO
the cost, which any GO has below anything that is none.
"""

from collections.abc import Callable, Sequence
from importlib import import_module
from itertools import product
from typing import Any, Literal

import numpy as np

from kaidan.errors import MissingExtraError
from kaidan.verbs.design.problem import Problem, Tried

Goal = Literal["margin", "go"]
GOALS: tuple[Goal, ...] = ("margin", "go")
_CHEAP = 1e4
"""By how much any GO lies below what is none."""
_COARSE = {1: 25, 2: 7, 3: 4}
"""Places along each free figure that are tried first, by the number of figures; 3 for more, and no
grid for more than 4."""
_POPULATION = 15
"""Designs of a generation; more where more is free."""
_CLOSE = 1e-9


class _EnoughError(Exception):
    """So many designs have been tried."""


def optimised(
    problem: Problem, goal: Goal, *, tries: int, seed: int, budget: float | None = None
) -> Tried:
    """Best design that a search comes upon.

    Parameters
    ----------
    problem : Problem
        Every design that is tried stays in it.
    goal : {"margin", "go"}
        The largest margin on the worst stairs; or the cheapest design that is a GO on all.
    tries : int
        Designs that are judged at most.
    seed : int
        Of the search.
    budget : float, optional
        Cost that a design may have.

    Returns
    -------
    Tried
        Of those that are alike the cheaper one.

    Raises
    ------
    MissingExtraError
        scipy is not installed.
    """
    optimize = _scipy("scipy.optimize")
    enough = len(problem.tried) + tries

    def loss(point: Sequence[float]) -> float:
        if len(problem.tried) >= enough:
            raise _EnoughError
        return loss_of(problem.at(point), goal, budget)

    bounds = [(each.low, each.high) for each in problem.free]
    first = _first(problem, loss)
    if first is not None:
        try:
            found = optimize.differential_evolution(
                loss, bounds, init=first, rng=seed, polish=False, maxiter=10**6, tol=0.0, atol=1e-3
            )
            optimize.minimize(
                loss,
                found.x,
                method="Nelder-Mead",
                bounds=bounds,
                options={"initial_simplex": _simplex(problem, found.x)},
            )
        except _EnoughError:
            pass
    return best_of(problem, goal, budget)


def best_of(problem: Problem, goal: Goal, budget: float | None = None) -> Tried:
    """Best design that was tried."""
    return min(problem.tried.values(), key=lambda each: (loss_of(each, goal, budget), each.cost))


def loss_of(tried: Tried, goal: Goal, budget: float | None = None) -> float:
    """What the search makes small."""
    dear = 0.0 if budget is None or tried.cost <= budget + _CLOSE else _CHEAP * tried.cost
    if goal == "go" and tried.goes:
        return tried.cost - _CHEAP + dear
    return dear - tried.merit


def _first(problem: Problem, loss: Callable[[Sequence[float]], float]) -> Any:
    """First generation: the best of a coarse grid, of the design as it is, and of chance."""
    free = problem.free
    now = [min(max(each.now, each.low), each.high) for each in free if each.now is not None]
    try:
        if len(now) == len(free):
            loss(now)
        if len(free) <= 4:
            count = _COARSE.get(len(free), 3)
            lines = [np.linspace(each.low, each.high, count) for each in free]
            for point in product(*lines):
                loss(point)
    except _EnoughError:
        return None
    size = max(_POPULATION, 5 * len(free))
    ranked = sorted(problem.tried.values(), key=lambda each: loss(each.values))
    good = [each.values for each in ranked[: size // 2]]
    sampler = _scipy("scipy.stats").qmc.Halton(len(free), scramble=False)
    spread = sampler.random(size - len(good) + 1)[1:]
    low, high = np.array([(each.low, each.high) for each in free]).T
    return np.array([*good, *(low + spread * (high - low))])


def _simplex(problem: Problem, at: Any) -> Any:
    """Corners some steps of the lattice apart, towards the middle of the range."""
    corners = [np.array(at)]
    for k, each in enumerate(problem.free):
        corner = np.array(at)
        corner[k] += (8.0 if corner[k] < (each.low + each.high) / 2 else -8.0) * each.step
        corners.append(corner)
    return np.array(corners)


def _scipy(module: str) -> Any:
    try:
        return import_module(module)
    except ImportError:
        raise MissingExtraError("a design study", "design") from None
