"""Tables into which a thread writes its paths: fresh memory would cost as much as a path."""

from __future__ import annotations

import threading

import numpy as np

from kaidan.contact.columns import LOAD_COLUMNS, SUPPORT_COLUMNS
from kaidan.contact.tables import FloatArray, IntArray, path_tables

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
