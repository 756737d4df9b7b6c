"""Memory of the plain kernel, for tests that call its functions one by one."""

import math

import numpy as np

from kaidan.contact.door import dtype_of, plain, zeros
from kaidan.contact.layout import At, Part, Point, Scene, Turn
from kaidan.contact.memory import Row, Table


def table(kind, rows):
    """Places of records: so many, or those of an array, which `Table.flush` writes to."""
    if isinstance(rows, int):
        rows = zeros(kind, rows)
    assert rows.dtype == dtype_of(kind)
    return Table(kind, rows, len(rows))


def numbers(values, kind=float):
    """Numbers, which share the memory of an array of their type."""
    return Row(memoryview(np.asarray(values, dtype=dtype_of(kind))))


def scene(ground, body, hint=0):
    """Terrain and robot, of tables of `ground_table` and `body_table`."""
    return Scene(table(Point, ground), table(Part, body), hint)


def posed(x, z, phi):
    """Where the body is: centroid [m], inclination [rad]."""
    return At(x, z, math.cos(phi), math.sin(phi))


def turning(o, sense, end, pivot=0, start=None, finish=None, about=0j, radius=math.nan, line=None):
    """Rotation about a point, or about the centre of an end that rolls, places complex numbers."""
    nowhere = At(math.nan, math.nan, math.nan, math.nan)
    to = finish or (nowhere, complex(math.nan, math.nan))
    return Turn(
        pivot, start or nowhere, o.real, o.imag, to[0], to[1].real, to[1].imag, sense, end,
        math.cos(end), math.sin(end), about.real, about.imag, radius, *(line or 3 * (math.nan,)),
    )  # fmt: skip


def made(kind, *rows):
    """Array of records that are noughts but for what each row names, `rear.x` say."""
    found = zeros(kind, len(rows))
    for k, row in enumerate(rows):
        for path, value in row.items():
            *parts, name = path.split(".")
            place = found[k : k + 1]
            for part in parts:
                place = place[part]
            place[name] = value
    return found


def nothing(kind, count):
    """Table of which no row has been written."""
    rows = zeros(kind, count)
    rows.view(np.uint8)[...] = 0xFF
    return rows


def written(rows):
    """Which rows of such a table have been written."""
    return ~(rows.view(np.uint8).reshape(len(rows), -1) == 0xFF).all(axis=1)


def place_of(row):
    """Centroid [m] and inclination [rad] of a pose, as a table has it."""
    return float(row["x"]), float(row["z"]), float(row["inclination"])


def pair_of(row):
    """Features of a pose, as a table has them."""
    return int(row["rear"]["feature"]), int(row["front"]["feature"])


def called(function):
    """Any function of the plain kernel, which takes tables and tuples as its entries do."""
    return plain(function)
