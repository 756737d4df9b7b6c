r"""Two margins in one unit: the tilt of gravity to the first rock, and to the fall.

::

        C           gravity tilted towards the downhill end until its line passes the contact that
       /|\          stays: there the robot rotates. To the first rock it is known at every pose. Of
      / | \         the fall the traverse itself tells, driven once more under tilted gravity:
     o  |  o        whatever the next contact arrests, the robot goes on as it then stands.
        v
"""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from kaidan.modes import Phase

LARGEST = math.radians(30.0)
"""Largest tilt to a fall that is looked for [rad]: stairs are hardly steeper."""
WITHIN = math.radians(0.002)
"""To which the tilt to a fall is found [rad]."""
_FIRST = math.radians(4.0)


class Fall(NamedTuple):
    """Fall under the least tilt of gravity."""

    tilt: float
    """Largest tilt that the robot survives [rad]; infinite beyond `LARGEST`; negative where it
    falls without any, and minus a right angle where that takes more than `LARGEST` off."""
    phase: Phase
    """Part of the traverse in which it falls."""
    step: int
    """Nosing at which, counted from the bottom."""


def largest_survived(
    survives: Callable[[float], bool],
    *,
    sought: Sequence[float] | None = None,
    enough: float = math.inf,
    most: float = LARGEST,
) -> float:
    """Largest tilt that is survived, see `Fall`, to `WITHIN` [rad].

    sought: tilts which it may only exceed or not [rad]: a smaller one is found where that says as
        much of each.
    enough: tilt beyond which one that is survived is as good as any [rad]: a smaller one than the
        largest is found there.
    most: tilt that is survived only by what no tilt fells [rad]. Beyond `LARGEST` it is one at
        which the robot rocks, so that it most likely falls just there: that is tried first.
    """

    def is_open(low: float, high: float) -> bool:
        if low >= enough:
            return False
        return sought is None or any(low <= each < high for each in sought)

    low, high, tilt = 0.0, math.inf, _FIRST
    if survives(0.0):
        while high == math.inf and is_open(low, high):
            if not survives(tilt):
                high = tilt
                if tilt > LARGEST and is_open(low, high) and survives(tilt - WITHIN):
                    return tilt - WITHIN
            elif tilt >= most:
                return math.inf
            else:
                low, tilt = tilt, min(2.0 * tilt, most)
    else:
        low, high = -math.pi / 2, 0.0
        while low == -math.pi / 2 and is_open(low, high):
            if survives(-tilt):
                low = -tilt
            elif tilt >= LARGEST:
                return low
            else:
                high, tilt = -tilt, min(2.0 * tilt, LARGEST)
    while high - low > WITHIN and is_open(low, high):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if survives(middle) else (low, middle)
    return low
