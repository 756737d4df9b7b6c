"""Tables into which a thread writes its paths: fresh memory would cost as much as a path."""

from __future__ import annotations

import threading
from typing import NamedTuple

import numpy as np

from kaidan.contact.codes import CUT_AT_ONCE, PIECES, ROUNDS
from kaidan.contact.columns import (
    LOAD_COLUMNS,
    MARGIN_COLUMNS,
    POSE_COLUMNS,
    SUPPORT_COLUMNS,
    WAY_COLUMNS,
)
from kaidan.contact.tables import FloatArray, IntArray, margin_tables, path_tables

#: Rows up to which tables are kept.
KEPT = 40_000
#: Rows of the largest path.
MOST = 400_000

_of_thread = threading.local()


def most_poses(way: float, step: float, points: int) -> int:
    """Rows that a path over so many points may take.

    Examples
    --------
    >>> most_poses(2.0, 0.005, 10)
    6240
    """
    return int(min(4.0 * way / step + 64 * points + 4000, MOST))


def path_scratch(size: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Tables of `path_tables` of this thread; the next path writes over them."""
    if size > KEPT:
        return path_tables(size)
    kept: tuple[FloatArray, ...] | None = getattr(_of_thread, "tables", None)
    if kept is None or len(kept[0]) < size:
        kept = _of_thread.tables = path_tables(size)
    poses, events, rotations = kept
    return poses[:size], events[:size], rotations[: size // 8 + 16]


class PeakScratch(NamedTuple):
    """Tables of :func:`kaidan.contact.kernel.peak_search.find_peaks`; it fills the last three."""

    largest: FloatArray
    s: FloatArray
    line: IntArray
    ways: FloatArray
    kept: FloatArray
    order: IntArray
    chosen: IntArray
    places: IntArray
    shares: FloatArray
    inside: FloatArray
    new: FloatArray
    new_margins: FloatArray
    contacts: FloatArray
    rows: IntArray
    between: FloatArray
    margins: FloatArray


def peak_scratch(size: int, groups: int) -> PeakScratch:
    """Tables of this thread for a path of so many poses; the next search writes over them."""
    kept: PeakScratch | None = getattr(_of_thread, "peaks", None)
    if kept is not None:
        if len(kept.largest) >= groups and len(kept.s) >= size:
            return kept
        groups, size = max(groups, len(kept.largest)), max(size, len(kept.s))
    cut = CUT_AT_ONCE * groups
    places = (PIECES - 1) * cut
    most = ROUNDS * places
    new_margins, contacts = margin_tables(places)
    found = PeakScratch(
        largest=np.empty(groups),
        s=np.empty(size),
        line=np.empty(size, dtype=np.int64),
        ways=np.empty((size + most, WAY_COLUMNS)),
        kept=np.empty((size + most, WAY_COLUMNS)),
        order=np.empty(size + most, dtype=np.int64),
        chosen=np.empty(cut, dtype=np.int64),
        places=np.empty(places, dtype=np.int64),
        shares=np.empty(places),
        inside=np.empty(places),
        new=np.empty((places, POSE_COLUMNS)),
        new_margins=new_margins,
        contacts=contacts,
        rows=np.empty(most, dtype=np.int64),
        between=np.empty((most, POSE_COLUMNS)),
        margins=np.empty((most, MARGIN_COLUMNS)),
    )
    if size <= KEPT:
        _of_thread.peaks = found
    return found


def sample_scratch(size: int) -> tuple[IntArray, FloatArray, FloatArray]:
    """Rows, poses and margins of this thread, as many; the next search writes over them."""
    kept: tuple[IntArray, FloatArray, FloatArray] | None = getattr(_of_thread, "samples", None)
    if kept is not None and len(kept[0]) >= size:
        return kept
    found = (
        np.empty(size, dtype=np.int64), np.empty((size, POSE_COLUMNS)),
        np.empty((size, MARGIN_COLUMNS)),
    )  # fmt: skip
    if size <= KEPT:
        _of_thread.samples = found
    return found


def holding_scratch(size: int) -> tuple[FloatArray | IntArray, ...]:
    """Tables of :func:`kaidan.contact.kernel.holding.least_held` for a path of so many poses."""
    # the kernel's own modules are not loaded where the native one stands for them
    from kaidan.contact.kernel.holding import MOST_SUPPORTS

    wide = size * MOST_SUPPORTS
    of_poses = [np.empty(size, dtype=np.int64) for _ in range(3)]
    return (
        np.empty((wide, SUPPORT_COLUMNS)), np.empty((size, LOAD_COLUMNS)), *of_poses,
        np.empty(wide, dtype=np.int64), np.empty(wide), np.empty(size), np.empty(size),
    )  # fmt: skip
