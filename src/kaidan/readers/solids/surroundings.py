"""What is drawn around a flight: gaps along it, floors at its ends, and what is free beside it."""

import math
from typing import NamedTuple

import numpy as np

from kaidan.readers.flight import MICROMETRE
from kaidan.readers.solids.ground import ends_of
from kaidan.readers.solids.path import Path
from kaidan.readers.solids.rays import Triangles
from kaidan.readers.solids.room import Strip, free_strips, usual
from kaidan.terrain.gap import Gap
from kaidan.terrain.room import Opening
from kaidan.terrain.sentences import in_words

_HIGHEST = 100.0
"""Height of what nothing hangs over, as sheets have it [m]."""


class Surroundings(NamedTuple):
    """What is drawn around a flight."""

    strip: Strip
    """Of which people speak as the clear width."""
    clear: tuple[Opening, ...]
    """Clear widths by height, where there are several."""
    gaps: tuple[Gap, ...]
    level: tuple[float, float]
    """Lengths of the floors before and behind it, as far as they are level [m]."""
    notes: tuple[str, ...]
    """Its gaps in words."""

    @property
    def headroom(self) -> float:
        """Height that is free over the strip [m]; NaN: nothing is drawn above it."""
        return self.strip.height if math.isfinite(self.strip.height) else math.nan


def surroundings_of(
    path: Path, ground: Triangles, obstacles: Triangles, finishes: frozenset[int] = frozenset()
) -> Surroundings:
    """What is drawn around a flight.

    obstacles: what may stand or hang in the way, the flight itself among it.
    """
    ends = ends_of(path, ground)
    strips = free_strips(path, obstacles, ends.level, finishes)
    places = np.asarray(path.nosings - path.nosings[0]).tolist()
    return Surroundings(
        strip=usual(strips),
        clear=tuple(
            Opening(
                height=round(min(each.height, _HIGHEST), MICROMETRE),
                width=round(each.width, MICROMETRE),
            )
            for each in (strips if len(strips) > 1 else ())
        ),
        gaps=ends.gaps,
        level=ends.level,
        notes=tuple(in_words(each, places) for each in ends.gaps),
    )
