"""Samples of an inertial measurement unit on a robot, from a CSV file or stream, line by line."""

import csv
import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple, TextIO

from kaidan.errors import InputError

LONGEST_LINE = 10_000
"""Characters of a line that is read; a longer one is an unreadable row."""
LONGEST_SKIPPED = 10_000_000
"""Characters of a line that are skipped before the file is given up."""


class Sample(NamedTuple):
    """What is measured at one time; NaN for a drop-out."""

    t: float
    """Time [s], of any origin."""
    inclination: float
    """Inclination of the body [rad], nose up positive."""
    inclination_rate: float
    """Its rate [rad/s], nose up positive."""
    acceleration: float
    """Acceleration along the track [m/s^2], up the stairs positive, without gravity."""
    position: float = math.nan
    """Path along the line of the nosings [m], up the stairs positive, 0 where a nosing meets the
    uphill tip of the flat; NaN: not known."""
    row: int = 0
    """Line of the file, or number of the sample, counted from 1; 0 for a sample from elsewhere."""
    fault: str = ""
    """Why its row could not be read; empty if it could."""


NEEDED = ("t", "inclination", "inclination_rate", "acceleration")
"""Columns that a file must have, in SI units and radians."""
OPTIONAL = ("position",)
"""Columns that it may have; others are ignored."""


def lines_of(file: TextIO, *, origin: str) -> Iterator[str]:
    """Lines of a file or stream as they come; of an endless one its beginning.

    Parameters
    ----------
    file : text file
        Open file.
    origin : str
        What errors call it.

    Yields
    ------
    str
        A line, cut behind `LONGEST_LINE` + 1 characters.

    Raises
    ------
    InputError
        A line that does not end within `LONGEST_SKIPPED` characters.
    """
    number = 0
    while line := file.readline(LONGEST_LINE + 1):
        number += 1
        yield line
        skipped = 0
        while len(line) > LONGEST_LINE and not line.endswith("\n"):
            line = file.readline(LONGEST_LINE + 1)
            skipped += len(line)
            if not line:
                return
            if skipped > LONGEST_SKIPPED:
                raise InputError(
                    f"{origin}, line {number}: does not end within {LONGEST_SKIPPED:,} characters"
                )


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
        `row` is the line in the file. A row that cannot be read is a sample of NaN with its
        `fault`: a cell that is no number, too few or too many cells, a line that is too long.

    Raises
    ------
    InputError
        A head that is missing, unreadable, lacks a column or names one twice.
    """
    places: dict[str, int] | None = None
    width = 0
    for number, line in enumerate(lines, start=1):
        text = line.lstrip("\ufeff").strip()
        if not text or text.startswith("#"):
            continue
        if places is None:
            cells = _cells(text)
            places, width = _places(cells, origin, number), len(cells)
        else:
            yield _sample(text, places, width, number)
    if places is None:
        raise InputError(f"{origin}: holds no samples; the first line names {', '.join(NEEDED)}")


def _cells(text: str) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader([text]))]
    except csv.Error:
        return []


def _places(cells: list[str], origin: str, number: int) -> dict[str, int]:
    if any("\ufffd" in cell or "\0" in cell for cell in cells):
        raise InputError(f"{origin}: cannot be read: not a text file")
    where = f"{origin}, line {number}"
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


def _sample(text: str, places: dict[str, int], width: int, row: int) -> Sample:
    """Sample of one row; of NaN and with its fault if the row cannot be read."""
    lost = Sample(math.nan, math.nan, math.nan, math.nan, row=row)
    if len(text) > LONGEST_LINE:
        return lost._replace(fault=f"the line is longer than {LONGEST_LINE} characters")
    cells = _cells(text)
    if len(cells) <= max(places.values()) or any(cells[width:]):
        return lost._replace(fault=f"cells: {len(cells)}, the head names {width}")
    values: dict[str, float] = {}
    for name, place in places.items():
        cell = cells[place]
        try:
            values[name] = float(cell) if cell else math.nan
        except ValueError:
            shown = cell if len(cell) <= 40 else cell[:39] + "…"
            return lost._replace(fault=f"{name} = {shown!r} is not a number")
    return lost._replace(**values)  # type: ignore[arg-type]
