"""Gaps in a flight or its landings: where nothing carries, as somebody drew or measured it.

::

          last tread           floor
        .-----------.         .---------     start, end: along the flight from the first nosing
        |           |         |              depth: below the lower of the two edges
     ---'           |<------->|              end or start not known: nobody found a floor there
                   start     end
"""

from collections.abc import Iterable
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import model_validator

from kaidan.sheet import Sheet, quantity

Array = NDArray[np.float64]

DEEPEST_TREAD = 0.55
"""Depth from which a level is a landing and no tread [m]."""
_FAR = (-1000.0, 1000.0)
_BEHIND = 1e-3
"""Length of a landing that begins where a gap ends [m]."""


class Gap(Sheet):
    """A gap across the way; one of its ends may be unknown, where no floor was found."""

    label: ClassVar[str] = "stairs: gaps"

    start: float | None = quantity(
        "m", *_FAR, "where it begins, from the first nosing; none: no floor was found before its "
        "end", default=None,
    )  # fmt: skip
    end: float | None = quantity(
        "m", *_FAR, "where it ends; none: no floor was found behind its start", default=None
    )
    depth: float = quantity("m", 0.0, 100.0, "below the lower of its two edges", default=0.0)
    beside: float = quantity(
        "m", 0.0, 100.0, "clear width past it; 0: it lies right across", default=0.0
    )

    @model_validator(mode="after")
    def _has_an_end(self) -> Self:
        if self.start is None and self.end is None:
            raise self.refuse("give start or end, or both")
        if self.start is not None and self.end is not None:
            if self.end <= self.start:
                raise self.refuse(f"end = {self.end:g} m is not beyond start = {self.start:g} m")
            if self.depth == 0.0:
                raise self.refuse("depth is missing (below the lower of its two edges)")
        return self

    @property
    def length(self) -> float | None:
        """Along the flight [m]; None: one of its ends is not known."""
        return None if self.start is None or self.end is None else self.end - self.start


def carved(points: Array, gaps: Iterable[Gap]) -> tuple[Array, Array]:
    """Line of a terrain with its gaps, and their far edges.

    points, shape (n, 2): line that leads ahead; the first nosing stands at x = 0 [m].
    gaps: what has an unknown end is not carved: nobody knows the terrain there.

    Shapes (m, 2) and (k, 2), the near and the far edge of each gap in turn [m].

    Examples
    --------
    >>> floor = np.array([(0.0, 0.0), (2.0, 0.0)])
    >>> carved(floor, [Gap(start=0.5, end=0.8, depth=1.0)])[0].tolist()
    [[0.0, 0.0], [0.5, 0.0], [0.5, -1.0], [0.8, -1.0], [0.8, 0.0], [2.0, 0.0]]
    """
    edges: list[tuple[float, float]] = []
    for gap in sorted((each for each in gaps if each.length), key=lambda each: each.start or 0.0):
        assert gap.start is not None
        assert gap.end is not None
        points = _reaching(points, gap.start - _BEHIND, gap.end + _BEHIND)
        before, behind = points[points[:, 0] < gap.start], points[points[:, 0] > gap.end]
        near = (gap.start, _between(before[-1], points[len(before)], gap.start))
        far = (gap.end, _between(points[-len(behind) - 1], behind[0], gap.end))
        floor = min(near[1], far[1]) - gap.depth
        points = np.vstack([before, near, (gap.start, floor), (gap.end, floor), far, behind])
        edges += [near, far]
    return points, np.array(edges).reshape(-1, 2)


def _reaching(points: Array, low: float, high: float) -> Array:
    """Line that reaches from one place at least to another, level beyond its ends."""
    first, last = points[0], points[-1]
    if first[0] > low:
        points = np.vstack([(low, first[1]), points])
    return points if last[0] >= high else np.vstack([points, (high, last[1])])


def _between(one: Array, other: Array, x: float) -> float:
    """Height at x on the straight piece between two points of a line."""
    if other[0] - one[0] <= 0.0:
        return float(other[1])
    return float(one[1] + (x - one[0]) / (other[0] - one[0]) * (other[1] - one[1]))
