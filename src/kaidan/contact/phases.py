"""Phases of a path's poses, by zones in which their contacts stand."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from kaidan.contact import layout
from kaidan.contact.door import table_of
from kaidan.contact.path import Path
from kaidan.contact.switch import kernel
from kaidan.contact.tables import IntArray

#: Smallest and largest x, smallest and largest z [m].
Zone = tuple[float, float, float, float]


def phases_by_zones(
    path: Path, enters: Sequence[Sequence[Zone]], lands: Sequence[Zone]
) -> IntArray:
    """Number of the phase of each pose: 0 enters, 1 traverses, 2 lands.

    Parameters
    ----------
    path
        As driven.
    enters
        Of each flight the zones in which the rear contact stands of a robot that enters; all poses
        from the first to the last that does are of that phase.
    lands
        Zones in which the front contact stands of one that lands, whatever the rear contact says.
    """
    numbers = np.empty(len(path.poses), dtype=np.int64)
    zones = [each for flight in enters for each in flight]
    ends = np.cumsum([len(each) for each in enters], dtype=np.int64)
    kernel().name_phases(
        path.poses.table, table_of(layout.Zone, zones), ends, table_of(layout.Zone, lands), numbers
    )
    return numbers
