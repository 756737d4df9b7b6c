"""Samples of an inertial measurement unit on a robot, from a CSV file or stream, line by line."""

import csv
import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from kaidan.errors import InputError


class Sample(NamedTuple):
    """What is measured at one time; NaN for a drop-out."""

    t: float
    """Time [s], of any origin."""
    inclination: float
    """Inclination of the body [rad], nose up positive."""
    inclination_rate: float
    """Its rate [rad/s], nose up positive."""
    acceleration: float
    """Acceleration along the track [m/s^2], up the stairs positive, gravity taken off."""
    position: float = math.nan
    """Way along the line of the nosings [m], up the stairs positive, 0 where a nosing meets the
    uphill tip of the flat; NaN: not known."""
    row: int = 0
    """Line of the file, or number of the sample, counted from 1; 0 for a sample from elsewhere."""


NEEDED = ("t", "inclination", "inclination_rate", "acceleration")
"""Columns that a file must have, in SI units and radians."""
OPTIONAL = ("position",)
"""Columns that it may have; others are ignored."""


def samples_of(lines: Iterable[str], *, origin: str) -> Iterator[Sample]:
    """Samples of a CSV text, each as soon as its line is there.

    Parameters
    ----------
    lines : iterable of str
        Lines: a head that names the columns `NEEDED` and perhaps `OPTIONAL`, in any order, then
        one row a sample. Empty lines and those that begin with ``#`` are skipped. An empty cell
        is a drop-out, NaN.
    origin : str
        What errors call the file.

    Yields
    ------
    Sample
        `row` is the line in the file.

    Raises
    ------
    InputError
        A column that is missing or named twice, a row with too few cells, a cell that is no
        number, or no head at all; with the line's number.
    """
    places: dict[str, int] | None = None
    for number, line in enumerate(lines, start=1):
        text = line.lstrip("\ufeff").strip()
        if not text or text.startswith("#"):
            continue
        where = f"{origin}, line {number}"
        try:
            cells = [cell.strip() for cell in next(csv.reader([text]))]
        except csv.Error as error:
            raise InputError(f"{where}: not CSV: {error}") from None
        if places is None:
            places = _places(cells, where)
        else:
            yield _sample(cells, places, where, number)
    if places is None:
        raise InputError(f"{origin}: holds no samples; the first line names {', '.join(NEEDED)}")


def _places(cells: list[str], where: str) -> dict[str, int]:
    known = (*NEEDED, *OPTIONAL)
    twice = [name for name in known if cells.count(name) > 1]
    if twice:
        raise InputError(f"{where}: column {twice[0]} is named twice")
    missing = [name for name in NEEDED if name not in cells]
    if missing:
        many = len(missing) > 1
        raise InputError(
            f"{where}: column{'s' * many} {', '.join(missing)} {'are' if many else 'is'} missing; "
            f"needed: {', '.join(NEEDED)}; optional: {', '.join(OPTIONAL)}"
        )
    return {name: cells.index(name) for name in known if name in cells}


def _sample(cells: list[str], places: dict[str, int], where: str, row: int) -> Sample:
    needed = 1 + max(places.values())
    if len(cells) < needed:
        raise InputError(f"{where}: {len(cells)} cells, at least {needed} are needed")
    values = {}
    for name, place in places.items():
        cell = cells[place]
        try:
            values[name] = float(cell) if cell else math.nan
        except ValueError:
            shown = cell if len(cell) <= 40 else cell[:39] + "…"
            raise InputError(f"{where}: {name} = {shown!r} is not a number") from None
    return Sample(**values, row=row)
