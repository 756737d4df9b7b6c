"""A fleet on a stock of stairs: every pair judged, shares counted."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError
from kaidan.modes import CONTACT, Verdict
from kaidan.robot import Robot
from kaidan.spelling import BEST
from kaidan.sweeps.cells import NOT_GO, VERDICTS
from kaidan.sweeps.plan import Along, Plan
from kaidan.sweeps.running import carried_out
from kaidan.sweeps.swept import Swept
from kaidan.verbs.comparison import laid
from kaidan.verbs.stock.answer import RobotOnStock, StockStudy
from kaidan.verbs.stock.flights import Stock

_QUANTILES = (0.05, 0.5, 0.95)


def stock_study(
    robots: Sequence[Any],
    stock: Stock,
    *,
    flippers: Any = BEST,
    go_only: bool = False,
    scheduler: str = "threads",
    workers: int | None = None,
    store: Any = None,
    progress: bool = False,
    **manner: Any,
) -> tuple[StockStudy, Swept]:
    """Which share of a stock each robot of a fleet takes, and what stops it.

    Parameters
    ----------
    robots : sequence of Robot, str or path
        Fleet.
    stock : Stock
        Flights.
    flippers : Posture or str
        As in `kaidan.assess`: best finds a plan for each pair; flat lays the flippers of all in
        line with the track where there are some.
    go_only : bool
        Whether to spare the contact model flights of which the closed form alone says that they are
        no GO; see `kaidan.sweep`.
    scheduler, workers, store, progress
        As `kaidan.sweep` has them.
    **manner
        Everything else of a question, see `kaidan.Question.of`.

    Returns
    -------
    swept : Swept
        Every pair.

    Raises
    ------
    InputError
        No robot, two of one name, or an input without physical meaning.

    Examples
    --------
    >>> stairs = Stock.drawn({"rise": "150mm..190mm", "going": "260mm..300mm"}, 50, to=0.01)
    >>> found, _ = stock_study(["absolem"], stairs, model="closed-form", friction=0.7)
    >>> found.flights, found.robots[0].governs.keys() <= {"slides_down", "tip_downhill"}
    (50.0, True)
    """
    fleet = [each if isinstance(each, Robot) else Robot.named(each) for each in robots]
    if not fleet:
        raise InputError("no robot: name one, or several joined by commas")
    names = [each.name for each in fleet]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise InputError(f"two robots are called {twice!r}")
    model = manner.get("model", CONTACT.name)
    short = stock.shortened(max(map(longest, fleet))) if model == CONTACT.name else stock
    values = {
        "robot": Along("robot", fleet),
        "flippers": Along("robot", [laid(each, flippers) for each in fleet]),
        **_columns(short),
        "model": model,
        **manner,
    }
    plan = Plan.of(values, screen=go_only)
    swept = carried_out(plan, scheduler=scheduler, workers=workers, store=store, progress=progress)
    return _answer(names, stock, short, swept, go_only=go_only), swept


def longest(robot: Robot) -> float:
    """Length that a robot has in no posture more of [m]."""
    track = robot.track
    ends = [
        0.0 - track.front_radius,
        track.flat_length + track.rear_radius,
        *(wheel.from_front - wheel.radius for wheel in track.wheels),
        *(wheel.from_front + wheel.radius for wheel in track.wheels),
    ]
    flippers = sum(
        pair.length + pair.tip_radius + max(0.0, -pair.pivot_inset)
        for pair in robot.flippers().values()
    )
    return max(ends) - min(ends) + 2 * flippers


def _columns(stock: Stock) -> dict[str, Along]:
    """Parameters along the flights; what no flight has stated stays out."""
    found = {}
    for name, values in stock.figures.items():
        known = ~np.isnan(values)
        if not known.any():
            continue
        each: list[Any] = values.tolist()
        if not known.all():
            each = [
                value if there else None for value, there in zip(each, known.tolist(), strict=True)
            ]
        found[name] = Along("flight", each)
    return found


def _answer(
    names: Sequence[str], stock: Stock, short: Stock, swept: Swept, *, go_only: bool
) -> StockStudy:
    rise, going = stock.figures["rise"], stock.figures["going"]
    slope = np.degrees(np.arctan2(rise, going))
    weights = short.flights / short.flights.sum()
    verdicts = swept.variables["verdict"].reshape(len(names), -1)
    each = [_of_robot(name, k, short, weights, swept, verdicts[k]) for k, name in enumerate(names)]
    goes = (verdicts == Verdict.GO.rank).any(axis=0)
    return StockStudy(
        model=str(swept.plan.base["model"]),
        stock=stock.name,
        flights=float(stock.flights.sum()),
        different=len(stock),
        judged=swept.plan.different,
        rise_m=(float(rise.min()), float(rise.max())),
        going_m=(float(going.min()), float(going.max())),
        angle_deg=(float(slope.min()), float(slope.max())),
        go_only=go_only,
        robots=sorted(each, key=lambda one: (-one.go, one.no_go)),
        some_robot=float(weights[goes].sum()),
    )


def _of_robot(
    name: str, k: int, stock: Stock, weights: NDArray[Any], swept: Swept, verdicts: NDArray[Any]
) -> RobotOnStock:
    shares = np.bincount(verdicts, weights=weights, minlength=len(VERDICTS))
    governs = swept.variables["governs"].reshape(-1, len(weights))[k]
    margin = swept.variables["margin_deg"].reshape(-1, len(weights))[k].astype(float)
    fails = verdicts != Verdict.GO.rank
    by_mode = {
        str(key): float(weights[fails & (governs == key)].sum())
        for key in dict.fromkeys(governs[fails].tolist())
    }
    slope = np.degrees(np.arctan2(stock.figures["rise"], stock.figures["going"]))
    known = np.isfinite(margin)
    return RobotOnStock(
        robot=name,
        go=float(shares[Verdict.GO.rank]),
        rough=float(shares[Verdict.ROUGH.rank]),
        unsure=float(shares[Verdict.UNSURE.rank]),
        no_go=float(shares[Verdict.NO_GO.rank]),
        outside_model=float(shares[Verdict.OUTSIDE_MODEL.rank]),
        not_go=float(shares[NOT_GO]),
        governs=dict(sorted(by_mode.items(), key=lambda item: -item[1])),
        steepest_go_deg=float(slope[~fails].max()) if not fails.all() else math.nan,
        margin_deg=_quantiles(margin[known], weights[known]) if known.any() else None,
    )


def _quantiles(values: NDArray[Any], weights: NDArray[Any]) -> tuple[float, float, float]:
    """Values that shares of the weight stay below."""
    order = np.argsort(values)
    sums = np.cumsum(weights[order]) / weights.sum()
    places = np.minimum(np.searchsorted(sums, _QUANTILES), len(values) - 1)
    low, middle, high = values[order][places].tolist()
    return low, middle, high
