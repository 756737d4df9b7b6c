"""Tables of terrain and robot, remembered: one of either is driven again and again."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from kaidan.contact.door import Records
from kaidan.contact.tables import body_table, ground_table

#: So many of each are remembered.
GROUNDS, BODIES = 32, 1024


def ground_of(terrain: ArrayLike) -> Records:
    """Table of `ground_table`; not to be written to."""
    points = np.ascontiguousarray(terrain, dtype=np.float64)
    return _ground(points.tobytes(), points.shape)


def body_of(parts: ArrayLike, kinds: ArrayLike | None = None) -> Records:
    """Table of `body_table`; not to be written to."""
    rows = np.ascontiguousarray(parts, dtype=np.float64)
    if kinds is None:
        return _body(rows.tobytes(), rows.shape, None)
    return _body(rows.tobytes(), rows.shape, tuple(np.asarray(kinds).tolist()))


@lru_cache(maxsize=GROUNDS)
def _ground(points: bytes, shape: tuple[int, ...]) -> Records:
    return ground_table(np.frombuffer(points).reshape(shape))


@lru_cache(maxsize=BODIES)
def _body(parts: bytes, shape: tuple[int, ...], kinds: tuple[int, ...] | None) -> Records:
    return body_table(np.frombuffer(parts).reshape(shape), kinds)
