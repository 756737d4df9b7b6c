"""Tables into which a thread writes its paths: fresh memory would cost as much as a path."""

from __future__ import annotations

import threading
from typing import NamedTuple

from kaidan.contact.door import Records, zeros
from kaidan.contact.layout import EventRow, Pose, RotationRow

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


class PathTables(NamedTuple):
    """What `kaidan.contact.layout.Log` writes to."""

    poses: Records
    events: Records
    rotations: Records


def path_scratch(size: int) -> PathTables:
    """Tables of this thread for a path of so many poses; the next path writes over them."""
    kept: PathTables | None = getattr(_of_thread, "tables", None)
    if kept is None or len(kept.poses) < size:
        kept = PathTables(
            zeros(Pose, size), zeros(EventRow, size), zeros(RotationRow, size // 8 + 16)
        )
        if size <= KEPT:
            _of_thread.tables = kept
    return PathTables(kept.poses[:size], kept.events[:size], kept.rotations[: size // 8 + 16])
