"""Nosings that a flat reaches and leaves between the poses of a path."""

import numpy as np

from kaidan.contact.columns import PASSED_COLUMNS
from kaidan.contact.path import Path
from kaidan.contact.switch import kernel
from kaidan.contact.tables import FloatArray, margin_tables


def nosings_passed(path: Path, touch: float) -> FloatArray:
    """Nosings that a flat reaches or leaves on straight pieces of a path.

    Those of which an event tells are left out, and those that pass from one part to the next in
    line with it.

    Parameters
    ----------
    path
        As driven; with margins only pieces beside a change of contacts are looked at.
    touch
        Gap up to which a nosing lies on a flat [m].

    Returns
    -------
    ndarray (k, 6)
        Arclength [m], 1 where it is reached, point of the ground, part, row before, share of
        the arclength to the next pose; in this order.
    """
    known = path.margins is not None
    margins = margin_tables(1)[0] if path.margins is None else path.margins.table
    rows = np.empty(len(path.poses), dtype=np.int64)
    size, count = 0, len(rows) + 8
    while count > size:
        size = count
        table = np.empty((size, PASSED_COLUMNS))
        count = kernel().find_passings(
            path.ground.table, path.body.table, path.poses.table, margins, known,
            path.events.table, touch, path.reach, rows, table,
        )  # fmt: skip
    return table[:count]
