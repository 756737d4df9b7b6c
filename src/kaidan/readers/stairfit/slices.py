"""Exact slices of a mesh, and the line that a robot would drive over in one of them."""

from itertools import pairwise

import numpy as np

from kaidan.readers.kinds import Array, Indices

STEP = 0.36
"""Highest step up from one place of the line to the next [m]: higher things are walls and
ceilings."""

SAME, MOST_DOWN = 0.005, 3.0
"""Rise that counts as none, and deepest fall ahead that the line follows [m]."""
GAP = 0.05
"""Longest gap between two treads that a line leads over [m]."""


def slice_of(s: Array, t: Array, z: Array, faces: Indices, at: float) -> Array:
    """Segments in which a vertical plane cuts the triangles, shape (n, 2, 2): (s, z) of both ends.

    s, t, z, shape (v,): vertices; the plane lies at one t.
    faces, shape (m, 3): rows of the vertices.
    at: place of the plane, moved by a hair where a vertex lies in it.
    """
    off = t - at
    off = np.where(np.abs(off) < 1e-9, 1e-9, off)
    side = off[faces] > 0
    cut = side.any(axis=1) & ~side.all(axis=1)
    corners, side = faces[cut], side[cut]
    # the corner that lies alone on its side of the plane, and the two others
    odd = np.where(side.sum(axis=1) == 1, side.argmax(axis=1), (~side).argmax(axis=1))
    rows = np.arange(len(corners))
    alone = corners[rows, odd]
    ends = []
    for turn in (1, 2):
        other = corners[rows, (odd + turn) % 3]
        share = off[alone] / (off[alone] - off[other])
        ends.append(np.column_stack([s[alone] + share * (s[other] - s[alone]),
                                     z[alone] + share * (z[other] - z[alone])]))  # fmt: skip
    return np.stack(ends, axis=1)


def driven_line(segments: Array, s: float, z: float) -> Array:
    """Line on which a robot drives over a place on a tread, shape (n, 2), from the least s on.

    Ahead it is the highest surface that is no more than a step above where it was: not the
    ceiling, and not the underside of the stairs. Behind it is the highest one that is no higher,
    and no more than a step lower.
    """
    flat = segments[np.abs(segments[:, 1, 0] - segments[:, 0, 0]) > 1e-7]
    swap = flat[:, 0, 0] > flat[:, 1, 0]
    flat = np.where(swap[:, None, None], flat[:, ::-1], flat)
    places = np.unique(np.round(flat[:, :, 0], 7))
    places = places[np.r_[True, np.diff(places) > 1e-6]] if len(places) else places
    at = int(np.searchsorted(places, s)) - 1
    if not 0 <= at < len(places) - 1:
        return np.zeros((0, 2))
    spans = list(pairwise(places.tolist()))
    ahead = _walked(flat, spans[at:], z, up=STEP, down=MOST_DOWN)
    if not ahead:
        return np.zeros((0, 2))
    before = spans[at - 1 :: -1] if at else []
    behind = _walked(flat, before, ahead[0][1], up=SAME, down=STEP, back=True)
    return np.array([*reversed(behind), *ahead]).reshape(-1, 2)


def _walked(
    flat: Array,
    spans: list[tuple[float, float]],
    now: float,
    *,
    up: float,
    down: float,
    back: bool = False,
) -> list[tuple[float, float]]:
    """Corners from one span to the next, until nothing carries."""
    s0, s1 = flat[:, 0, 0], flat[:, 1, 0]
    slope = (flat[:, 1, 1] - flat[:, 0, 1]) / (s1 - s0)
    line: list[tuple[float, float]] = []
    for low, high in spans:
        middle = (low + high) / 2
        over = (s0 <= middle) & (s1 >= middle)
        if not over.any():
            if high - low > GAP:
                break
            continue
        left = flat[over, 0, 1] + slope[over] * (low - s0[over])
        right = left + slope[over] * (high - low)
        first, second = (right, left) if back else (left, right)
        allowed = (first <= now + up) & (first >= now - down)
        if not allowed.any():
            break
        best = int(np.argmax(np.where(allowed, first + second, -np.inf)))
        corners = [(low, float(left[best])), (high, float(right[best]))]
        line += corners[::-1] if back else corners
        now = float(second[best])
    return line
