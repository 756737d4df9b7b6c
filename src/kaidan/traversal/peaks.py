r"""Peaks of a figure between the poses of a path: which may be the largest, and how high they are.

::

             x          <- between two poses it is no higher than where the lines through their
           .' '.           outer poses meet
         o       o
       .'         '.
      o             o      o  a pose of the path

The way between two poses that promises most is cut into pieces with poses between them, and these
again, until none promises more than is found. Figures have kinks, for example where a belt begins
to give way at a nosing: lines bound them as well as an arch, a parabola would not.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from kaidan import contact

Array = NDArray[np.float64]
Rows = NDArray[np.int64]

AT_ONCE = 4
"""Ways between two poses that are cut together in a group: the most promising first."""
ROUNDS = 8
"""Times that more of them are cut, at most."""


def peaks_between(
    path: contact.Path,
    values: Array,
    group: Rows,
    tolerance: float,
    figure: Callable[[contact.Path], Array],
    *,
    narrow: NDArray[np.bool_] | None = None,
    acceleration: float,
) -> tuple[list[contact.Path], Rows]:
    """Poses between two at which a figure may be the largest of a group of poses.

    Parameters
    ----------
    path : contact.Path
        With margins.
    values : ndarray
        The figure at each pose.
    group : ndarray of int
        Number of the group of each pose; negative: of none.
    tolerance : float
        Share of the largest figure of a group above which is not looked for [1].
    figure : callable
        The figure at the poses of another path.
    narrow : ndarray of bool, optional
        Whether the way from each pose to the next may hide a peak that no line tells of.
    acceleration : float
        Along the path [m/s^2].

    Returns
    -------
    poses, rows
        Some at a time, and the row before each.
    """
    ways = contact.Ways(path.s, path.poses.leads_on, values, group, tolerance, narrow)
    found: list[contact.Path] = []
    rows = [np.empty(0, dtype=np.int64)]
    for _ in range(ROUNDS):
        row, shares = ways.cut_first(AT_ONCE)
        if len(row) == 0:
            break
        new = path.between(row, shares, acceleration=acceleration)
        found.append(new)
        rows.append(row)
        ways.cut(figure(new))
    return found, np.concatenate(rows)
