"""Points as text: XYZ, PTS, CSV; with commas, semicolons, tabs or blanks, and a head or none."""

import re
from itertools import islice

import numpy as np

from kaidan.readers.formats.columns import points_of_columns
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Points
from kaidan.readers.opening import LARGEST, Source

_COMMENTS = ("#", "//", "%")
_LINES = 20


def is_table(source: Source) -> bool:
    """Test of a text whose first lines are rows of three numbers or more, but for a head."""
    if b"\0" in source.head:
        return False
    lines = _lines(source)
    rows = [numbers_of(line) for line in lines]
    good = [row is not None and len(row) >= 3 for row in rows]
    return len(good) >= 3 and all(good[2:]) and (good[1] or good[0] or len(good) > 3)


def _lines(source: Source) -> list[str]:
    text = source.head.decode("utf-8-sig", "replace")
    lines = [line for line in text.splitlines() if line.strip()]
    lines = lines[:-1] if len(source.head) < source.size else lines
    return [line for line in lines if not line.lstrip().startswith(_COMMENTS)][:_LINES]


def separator_of(line: str) -> str | None:
    """What stands between the cells of a line; None: blanks."""
    return next((each for each in (",", ";", "\t") if each in line), None)


def numbers_of(line: str) -> list[float] | None:
    """Numbers of a line; None: it holds something else."""
    try:
        return [float(cell) for cell in line.strip().rstrip(",;").split(separator_of(line))]
    except ValueError:
        return None


def read(source: Source, hints: Hints) -> Points:
    """Points of a text.

    Raises
    ------
    InputError
        A row that is not numbers; the text names its line.
    """
    source.refuse_larger(LARGEST)
    lines = _lines(source)
    skipped, columns = 0, (0, 1, 2)
    for line in lines[:2]:
        row = numbers_of(line)
        if row is not None and len(row) >= 3:
            break
        skipped += 1  # a head, or the count of points that PTS begins with
        columns = _columns(line) or columns
    rows = source.text(LARGEST).splitlines()
    filled = (
        number
        for number, line in enumerate(rows)
        if line.strip() and not line.lstrip().startswith(_COMMENTS)
    )
    first = next(islice(filled, skipped, None), 0)
    try:
        found = np.loadtxt(
            rows[first:],
            delimiter=separator_of(lines[-1]),
            usecols=columns,
            ndmin=2,
            comments=list(_COMMENTS),
        )
    except ValueError as error:
        where = re.search(r"row (\d+)", str(error))
        line_number = f"line {first + 1 + int(where.group(1))}" if where else ""
        raise source.refuse(
            f"no row of numbers x, y, z: {str(error).splitlines()[0]}", line_number
        ) from None
    return points_of_columns(source, "table", found.T, hints)


def _columns(line: str) -> tuple[int, int, int] | None:
    cells = [cell.strip().strip('"').lower().lstrip("/") for cell in line.split(separator_of(line))]
    for names in (("x", "y", "z"), ("x_m", "y_m", "z_m"), ("points:0", "points:1", "points:2")):
        if all(name in cells for name in names):
            return cells.index(names[0]), cells.index(names[1]), cells.index(names[2])
    return None
