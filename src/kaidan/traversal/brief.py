r"""Braking in the midst of an exchange of contacts, by how long it lasts.

::

    braking        ___          Going down, the leading end meets the landing while the trailing
    force   ______|   |         contact is a nosing far ahead, then the last one under the flat. On
                      |____     exact steps both happen at one place; with a step a micrometre off
               s ->             the robot brakes in between, for a micrometre.

What a drive cannot brake over so short a way it makes good beyond it. So such a pose counts by the
share of `BRIEF` that this lasts, above what is braked before it and after it.
"""

import numpy as np
from numpy.typing import NDArray

from kaidan import contact

Array = NDArray[np.float64]

BRIEF = 0.02
"""Way on which a braking force counts in full [m]. On a shorter one the height that is not braked
off is at most a quarter of it, times the force missing over the weight."""


def by_how_long(path: contact.Path, traction: Array, row: NDArray[np.int64]) -> Array:
    """Tractive force over mass, that of a brief braking by how long it lasts [N/kg].

    traction: force without its sign, of the poses of the path and of some between them [N/kg].
    row: row of the path of which each is.
    """
    poses = path.poses
    falls = np.sin(poses.path_direction) < 0.0
    if not falls.any():
        return traction
    s, leg = poses.s, poses.leg
    exchange = (s[1:] - s[:-1] < contact.ONE_PLACE) | (leg[1:] != leg[:-1])
    run = np.append(0, np.cumsum(exchange))
    count = int(run[-1]) + 1
    first = np.searchsorted(run, np.arange(count))
    last = np.append(first[1:], len(run)) - 1
    length = poses.s[last] - poses.s[first]
    long = np.flatnonzero(length >= BRIEF)
    at = run[row]
    brakes = falls[row] & (length[at] < BRIEF)
    if len(long) == 0 or not brakes.any():
        return traction
    most = np.full(count, -np.inf)
    np.maximum.at(most, at, traction)
    found = traction.copy()
    for k in np.flatnonzero(np.bincount(at[brakes], minlength=count)):
        after = int(np.searchsorted(long, k))
        base = max(
            traction[last[long[after - 1]]] if after else 0.0,
            traction[first[long[after]]] if after < len(long) else 0.0,
        )
        begin, end = k, k + 1
        while begin > 0 and length[begin - 1] < BRIEF and most[begin - 1] >= most[k]:
            begin -= 1
        while end < count and length[end] < BRIEF and most[end] >= most[k]:
            end += 1
        share = min(float(length[begin:end].sum()) / BRIEF, 1.0)
        some = brakes & (at == k) & (traction > base)
        found[some] = base + share * (traction[some] - base)
    return found
