"""What a design is sought for: free figures, stairs to be taken, and how good a design is."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from kaidan.errors import InputError, shown
from kaidan.modes import Verdict
from kaidan.sweeps.cells import MODES, REFUSED, judged_row
from kaidan.sweeps.parameters import parameter, question_of, value_now
from kaidan.units import range_of, value_of

LATTICE = 500
"""Places of a free figure at least, of round numbers: nobody builds to a tenth of a millimetre."""
_RANK, _FAILS = 1000.0, 100.0
"""What a worse verdict and a further failing mode outweigh [deg]."""
_MOST = 90.0


class Free(NamedTuple):
    """A figure that may be chosen."""

    name: str
    low: float
    high: float
    unit: str
    now: float | None
    """As it stands; None: the sheet has none."""
    weight: float = 1.0
    """Cost of changing it over its whole range."""

    @property
    def step(self) -> float:
        """Distance of the round numbers that are tried."""
        return float(10.0 ** math.floor(math.log10((self.high - self.low) / LATTICE)))

    def rounded(self, value: float) -> float:
        """Nearest round number within the range, or the figure as it stands where that is near."""
        now = self.now
        if now is not None and self.low <= now <= self.high and abs(value - now) <= self.step / 2:
            return now
        near = round(round(value / self.step) * self.step, 12)
        return min(max(near, self.low), self.high)

    def cost(self, value: float) -> float:
        """Cost of a value: the share of the range by which it is changed, times the weight."""
        return 0.0 if self.now is None else (
            self.weight * abs(value - self.now) / (self.high - self.low))  # fmt: skip


class Cell(NamedTuple):
    """What a design comes to on one of the stairs."""

    stairs: str
    verdict: Verdict
    governs: str
    margin: float
    """[deg]; NaN: not known."""
    merit: float
    """Order: verdict, number of failing modes, margin; larger is better."""
    facing: str = ""
    flippers: str = ""


class Tried(NamedTuple):
    """A design and what it comes to."""

    values: tuple[float, ...]
    cost: float
    cells: tuple[Cell, ...]

    @property
    def worst(self) -> Cell:
        """The stairs on which it does worst."""
        return min(self.cells, key=lambda each: each.merit)

    @property
    def merit(self) -> float:
        """Merit on those."""
        return self.worst.merit

    @property
    def goes(self) -> bool:
        """Whether it is a GO on all stairs."""
        return self.worst.verdict is Verdict.GO


@dataclass
class Problem:
    """Free figures of a robot, the stairs to be taken, and every design that was tried."""

    values: Mapping[str, Any]
    """Question without stairs, as `kaidan.sweeps.parameters.question_of` takes it."""
    stairs: Sequence[Any]
    free: tuple[Free, ...]
    plans: Sequence[Mapping[str, Any]] = ()
    """Postures and facing on each of the stairs, where they are not among the values."""
    tried: dict[tuple[float, ...], Tried] = field(default_factory=dict)

    @property
    def ways(self) -> list[dict[str, Any]]:
        """Each of the stairs, with the plan on it, by the names of parameters."""
        known = [{} if each is None else {"stairs": each} for each in self.stairs]
        plans = self.plans or [{}] * len(known)
        return [{**stairs, **plan} for stairs, plan in zip(known, plans, strict=True)]

    def at(self, point: Sequence[float]) -> Tried:
        """Design at a point, rounded and judged."""
        values = tuple(
            each.rounded(float(value)) for each, value in zip(self.free, point, strict=True)
        )
        if values not in self.tried:
            cost = sum(each.cost(value) for each, value in zip(self.free, values, strict=True))
            cells = tuple(self._cell(values, each) for each in self.ways)
            self.tried[values] = Tried(values, cost, cells)
        return self.tried[values]

    def now(self) -> Tried | None:
        """The robot as it stands; None where it lacks a free figure."""
        values = [each.now for each in self.free]
        known = [value for value in values if value is not None]
        if len(known) < len(values):
            return None
        return Tried(tuple(known), 0.0, tuple(self._cell(known, each) for each in self.ways))

    def _cell(self, point: Sequence[float], way: Mapping[str, Any]) -> Cell:
        name = terrain_name(way.get("stairs"))
        own = {each.name: value for each, value in zip(self.free, point, strict=True)}
        try:
            row, _ = judged_row(question_of({**self.values, **way, **own}))
        except InputError:
            return Cell(name, Verdict.OUTSIDE_MODEL, REFUSED, math.nan, -10 * _RANK)
        return cell_of(name, row)


def cell_of(name: str, row: Mapping[str, Any]) -> Cell:
    """Cell of a row of a sweep."""
    verdict = list(Verdict)[row["verdict"]]
    if row["governs"] == REFUSED:
        return Cell(name, verdict, REFUSED, math.nan, -10 * _RANK)
    fails = sum(row[column] <= 0 for column in MODES.values())  # NaN is not known, and no failure
    margin = row["margin_deg"]
    height = -_MOST if math.isnan(margin) else float(np.clip(margin, -_MOST, _MOST))
    merit = height - _RANK * verdict.rank - _FAILS * fails
    return Cell(name, verdict, row["governs"], margin, merit, row["facing"], row["flippers"])


def terrain_name(stairs: Any) -> str:
    """What people call a terrain; nothing where its shape is given figure by figure."""
    if stairs is None:
        return ""
    if isinstance(stairs, tuple):
        return " + ".join(each.name for each in stairs)
    return str(stairs.name)


def free_of(
    values: Mapping[str, Any], given: Mapping[str, Any], weights: Mapping[str, float]
) -> tuple[Free, ...]:
    """Free figures of ranges by name."""
    if not given:
        raise InputError("nothing is free: give a figure its range, com_from_front=200mm..400mm")
    unknown = sorted(weights.keys() - given.keys())
    if unknown:
        raise InputError(f"cost of {shown(unknown[0])}: it is not free; free: {', '.join(given)}")
    found = []
    for name, ends in given.items():
        kind, unit = parameter(name)[1:]
        if kind is None or name == "steps":
            raise InputError(f"{name} is no continuous figure: vary it with kaidan sweep")
        low, high = range_of(ends, kind, option=name)
        if not low < high:
            raise InputError(f"{name} = {low:g} {unit} has no width: give LOW..HIGH")
        weight = value_of(weights.get(name, 1.0), "number", option=f"cost of {name}")
        if weight < 0:
            raise InputError(f"cost of {name} = {weight:g} is not a number from 0 on")
        found.append(Free(name, low, high, unit, value_now(values, name), weight))
    return tuple(found)
