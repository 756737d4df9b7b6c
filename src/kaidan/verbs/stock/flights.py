"""A stock of stairs: flights of a table, of the catalogue, or drawn from what is known of them."""

import csv
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kaidan.errors import InputError, did_you_mean, short, shown
from kaidan.files import reason
from kaidan.sheet import bounds
from kaidan.terrain.stairs import Stairs
from kaidan.units import parse, parse_range

COLUMNS = {
    "rise": ("length", "m"),
    "going": ("length", "m"),
    "steps": ("number", "1"),
    "lower_landing": ("length", "m"),
    "upper_landing": ("length", "m"),
    "width": ("length", "m"),
    "flights": ("number", "1"),
}
"""Columns of a table, what they measure, and the unit of plain numbers; `flights` says how many
flights a row stands for."""
_ALIKE = {"count": "steps", "risers": "steps", "number": "flights", "weight": "flights"}
_FIGURES = ("rise", "going", "steps", "lower_landing", "upper_landing", "width")
_IN_HEAD = re.compile(r"(\w+?)[ _]*[\[(]?(mm|cm|m|in|ft)?[\])]?", re.ASCII)
_SPREAD = re.compile(r"(.+?)(?:\+-|±)(.+)")
MOST = 10_000_000
"""Rows of a table, or flights drawn, at most."""
_TRIES = 200
"""Draws for each flight that a stepping rule may refuse."""
Array = NDArray[np.float64]


@dataclass(frozen=True)
class Stock:
    """Different flights, and how many of each there are."""

    name: str
    figures: Mapping[str, Array]
    """Rise, going, landings, width [m] and steps by their names; NaN: not stated."""
    flights: Array
    """How many flights each stands for."""

    def __len__(self) -> int:
        return len(self.flights)

    @classmethod
    def of_rows(cls, name: str, figures: Mapping[str, Array], flights: Array) -> "Stock":
        """Stock of rows; those that say the same become one.

        Raises
        ------
        InputError
            A figure beyond what stairs have; the text names row and figure.
        """
        for figure, values in figures.items():
            unit, low, high = bounds(Stairs.model_fields[figure])
            wrong = ~(np.isnan(values) | ((values >= low) & (values <= high)))
            if wrong.any():
                row = int(np.argmax(wrong))
                of = "" if unit in ("1", "risers", None) else f" {unit}"
                hint = ""
                if unit == "m" and low <= values[row] / 1000 <= high:
                    hint = " (in millimetres? head the column with its unit: rise_mm)"
                raise InputError(
                    f"{name}, flight {row + 1}: {figure} = {values[row]:g}{of} is not within "
                    f"{low:g} to {high:g}{of}{hint}"
                )
        table = np.array([np.nan_to_num(figures[each], nan=-1.0) for each in _FIGURES]).T
        different, of_row = np.unique(table, axis=0, return_inverse=True)
        counts = np.bincount(of_row.ravel(), weights=flights, minlength=len(different))
        found = {
            figure: np.where(column == -1.0, np.nan, column)
            for figure, column in zip(_FIGURES, different.T, strict=True)
        }
        return cls(name, found, counts.astype(np.float64))

    @classmethod
    def of_file(cls, path: Path) -> "Stock":
        """Stock of a CSV file with a head.

        Parameters
        ----------
        path : Path
            Columns rise and going, and any of steps (count), lower_landing, upper_landing, width,
            flights; values with their unit, or plain numbers in metres or the unit of the head
            (rise_mm). Others are left alone.

        Raises
        ------
        InputError
            A file that cannot be read, a missing column, or a value that is none.
        """
        try:
            with path.open(encoding="utf-8-sig", newline="") as file:
                rows = list(csv.reader(file))
        except UnicodeDecodeError:
            raise InputError(f"{short(path)}: cannot be read: not a text file") from None
        except (OSError, ValueError, csv.Error) as error:
            why = reason(error) if isinstance(error, OSError | ValueError) else str(error)
            raise InputError(f"{short(path)}: cannot be read: {why}") from None
        rows = [row for row in rows if any(cell.strip() for cell in row)]
        if len(rows) < 2:
            raise InputError(f"{short(path)}: holds no flights; write a head, rise,going, and rows")
        heads = [_head(cell) for cell in rows[0]]
        names = [name for name, _ in heads]
        for needed in ("rise", "going"):
            if needed not in names:
                raise InputError(
                    f"{short(path)}: no column {needed}; it has {', '.join(map(str, rows[0]))}"
                )
        columns = {}
        for k, (name, unit) in enumerate(heads):
            if name not in COLUMNS:
                continue
            if name in columns:
                raise InputError(f"{short(path)}: two columns are {name}")
            columns[name] = np.array([
                _value(row[k] if k < len(row) else "", name, unit, f"{short(path)}, line {at}")
                for at, row in enumerate(rows[1:], start=2)
            ])  # fmt: skip
        return cls._of_columns(path.name, columns)

    @classmethod
    def of_stairs(cls, each: Sequence[Stairs], name: str = "") -> "Stock":
        """Stock of uniform stairs, one flight of each.

        Raises
        ------
        InputError
            Stairs that are not uniform.
        """
        for one in each:
            if one.rise is None:
                raise InputError(f"stairs {one.name!r} are not uniform: sweep them by themselves")
        columns = {
            figure: np.array([
                np.nan if getattr(one, figure) is None else float(getattr(one, figure))
                for one in each
            ])
            for figure in _FIGURES
        }  # fmt: skip
        return cls.of_rows(name or ", ".join(one.name for one in each), columns, np.ones(len(each)))

    @classmethod
    def drawn(
        cls,
        figures: Mapping[str, Any],
        count: int,
        *,
        rule: tuple[float, float] | None = None,
        to: float = 0.001,
        seed: int = 0,
        name: str = "drawn",
    ) -> "Stock":
        """Stock of flights drawn figure by figure.

        Parameters
        ----------
        figures : mapping of str to str or (low, high)
            Of rise, going, steps and so on: a value, a range within which all are alike frequent
            ("140mm..200mm"), or a normal distribution ("172mm+-8mm", one sigma).
        count : int
            Number of flights.
        rule : (low, high), optional
            Stepping rule that a flight keeps: 2 rise + going within these [m].
        to : float
            Lengths are rounded to multiples of it [m]; flights that then are alike count together.
        seed : int
            Of the draws.
        name : str
            What people call it.

        Raises
        ------
        InputError
            An unknown figure, none of rise or going, a rule that hardly a flight keeps.
        """
        if not 1 <= count <= MOST:
            raise InputError(f"flights = {count} is not within 1 to {MOST:,}")
        if not 1e-4 <= to <= 0.05:
            raise InputError(f"lengths rounded to {to:g} m: not within 0.0001 to 0.05 m")
        unknown = figures.keys() - set(_FIGURES)
        if unknown:
            word = min(unknown)
            raise InputError(
                f"unknown figure {shown(word)}; known: {', '.join(_FIGURES)}"
                f"{did_you_mean(word, _FIGURES)}"
            )
        draw = np.random.default_rng(seed)
        kept: dict[str, list[Array]] = {figure: [] for figure in figures}
        missing = count
        for _ in range(_TRIES):
            block = {f: _draws(f, given, missing, to, draw) for f, given in figures.items()}
            good = np.ones(missing, dtype=bool)
            if rule is not None and {"rise", "going"} <= figures.keys():
                step = 2 * block["rise"] + block["going"]
                good = (step >= rule[0] - 1e-9) & (step <= rule[1] + 1e-9)
            for figure, values in block.items():
                kept[figure].append(values[good])
            missing -= int(good.sum())
            if not missing:
                return cls._of_columns(name, {f: np.concatenate(v) for f, v in kept.items()})
        raise InputError(f"{name}: hardly a flight keeps the stepping rule; widen it")

    @classmethod
    def _of_columns(cls, name: str, columns: Mapping[str, Array]) -> "Stock":
        if not {"rise", "going"} <= columns.keys():
            raise InputError(f"{name}: a stock needs rise and going")
        rows = len(columns["rise"])
        if rows > MOST:
            raise InputError(f"{name}: {rows:,} rows are more than {MOST:,}")
        default = float(Stairs.model_fields["steps"].default)
        flights = columns.get("flights", np.ones(rows))
        if not (np.isfinite(flights) & (flights > 0)).all():
            raise InputError(f"{name}: flights must be a positive number in every row")
        nothing = np.full(rows, np.nan)
        figures = {figure: columns.get(figure, nothing) for figure in _FIGURES}
        steps = np.where(np.isnan(figures["steps"]), default, figures["steps"])
        if (steps != np.round(steps)).any():
            raise InputError(f"{name}: steps must be whole numbers")
        return cls.of_rows(name, figures | {"steps": steps}, flights)

    def stairs(self) -> list[Stairs]:
        """Flights that differ, as sheets named by rise, going and steps."""
        rows = zip(*(self.figures[name].tolist() for name in _FIGURES), strict=True)
        found = []
        for row in rows:
            stated = {k: v for k, v in zip(_FIGURES, row, strict=True) if not math.isnan(v)}
            stated["steps"] = round(stated["steps"])
            name = f"{1e3 * stated['rise']:g} x {1e3 * stated['going']:g} mm, {stated['steps']}"
            found.append(Stairs(name=name, **stated))
        return found

    def shortened(self, reach: float) -> "Stock":
        """Same stock with long flights as short as says all of a robot so long [m].

        A uniform flight repeats itself once the robot has left the landing: as many nosings as the
        robot spans, and three more, hold every pose.
        """
        spacing = np.hypot(self.figures["rise"], self.figures["going"])
        enough = np.maximum(5.0, np.ceil(reach / spacing) + 3.0)
        steps = np.minimum(self.figures["steps"], enough)
        return Stock.of_rows(self.name, {**self.figures, "steps": steps}, self.flights)


def _head(cell: str) -> tuple[str, str]:
    """Name of a column and the unit in its head."""
    match = _IN_HEAD.fullmatch(cell.strip().lower())
    if match is None:
        return cell, ""
    name = _ALIKE.get(match[1].strip("_"), match[1].strip("_"))
    return (name, match[2] or "") if name in COLUMNS else (cell, "")


def _value(cell: str, name: str, unit: str, where: str) -> float:
    text = cell.strip()
    if not text:
        if name in ("rise", "going"):
            raise InputError(f"{where}: {name} is missing")
        return 1.0 if name == "flights" else math.nan
    kind, plain = COLUMNS[name]
    try:
        number = float(text)
    except ValueError:
        return parse(text, kind, option=f"{where}: {name} =")
    if kind == "number":
        return number
    return parse(f"{number!r}{unit or plain}", kind, option=f"{where}: {name} =")


def _draws(figure: str, given: Any, count: int, to: float, draw: np.random.Generator) -> Array:
    """So many values of a figure."""
    kind = COLUMNS[figure][0]
    option = f"{figure} ="
    spread = _SPREAD.fullmatch(given) if isinstance(given, str) else None
    if spread is not None:
        middle, sigma = (parse(part.strip(), kind, option=option) for part in spread.groups())
        values = draw.normal(middle, sigma, count)
        _, low, high = bounds(Stairs.model_fields[figure])
        values = np.clip(values, low, high)
    else:
        low, high = parse_range(given, kind, option=option) if isinstance(given, str) else given
        values = draw.uniform(low, high + (1.0 if figure == "steps" else 0.0), count)
    if figure == "steps":
        return np.minimum(np.floor(values), math.floor(high))
    return np.asarray(np.round(np.round(values / to) * to, 9))
