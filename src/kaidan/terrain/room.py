"""Free space of a flight, across and above the line of its nosings: how wide it is up to a height.

::

     height |            |  |      sloping ceiling, handrails, stringers: looked at along the
            | |          |__|      flight, all that stands or hangs in the way lies in one picture;
            | |__   .       |      for each height the widest strip across that is free up to it
            |    |  |  .    |
            '----+--+-------+--    a robot passes where the strip for its height holds its width
"""

import math
from collections.abc import Iterable, Sequence
from typing import ClassVar, NamedTuple, Self

from kaidan.sheet import Sheet, quantity


class Opening(Sheet):
    """Clear width of a flight up to a height."""

    label: ClassVar[str] = "stairs: clear"

    height: float = quantity("m", 0.0, 100.0, "plumb above the line of the nosings")
    width: float = quantity("m", 0.0, 100.0, "of the widest strip that is free up to that height")


class Room(NamedTuple):
    """What is free along a flight."""

    openings: tuple[tuple[float, float], ...]
    """Pairs of a height and the clear width up to it, heights ascending, widths descending [m];
    infinite: not stated."""

    @classmethod
    def of(
        cls, width: float | None, headroom: float | None, clear: Iterable[Opening] = ()
    ) -> Self | None:
        """Room as a sheet states it; None: it states nothing."""
        pairs = tuple((each.height, each.width) for each in clear)
        if not pairs and width is None and headroom is None:
            return None
        stated = (math.inf if each is None else each for each in (headroom, width))
        return cls(pairs or (tuple(stated),))  # type: ignore[arg-type]

    @classmethod
    def of_all(cls, rooms: Sequence[Self]) -> Self:
        """Room of all flights of a way: for each height the narrowest of them."""
        heights = sorted({height for each in rooms for height, _ in each.openings})
        least = min(room.headroom for room in rooms)
        heights = [each for each in heights if each <= least]
        return cls(tuple((each, min(one.width_up_to(each) for one in rooms)) for each in heights))

    @property
    def headroom(self) -> float:
        """Height up to which anything is free [m]; infinite: nothing is above it."""
        return self.openings[-1][0]

    @property
    def widest(self) -> float:
        """Clear width just above the nosings [m]; infinite: not stated."""
        return self.openings[0][1]

    def width_up_to(self, height: float) -> float:
        """Widest strip that is free up to a height, or up to what hangs over all of it [m].

        NaN stands for a height that nobody knows: up to what hangs over all.
        """
        limit = min(self.headroom, height)
        return next(width for up_to, width in self.openings if not up_to < limit)

    def height_over(self, width: float) -> float:
        """Height up to which a strip of a width is free [m]; 0: it is nowhere."""
        return max((height for height, each in self.openings if each >= width), default=0.0)
