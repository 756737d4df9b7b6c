r"""Poses at which the extremes of a traverse may lie: its own, and some between them.

::

    required      .            o  a pose of the path        |  exchange of contacts: a pose just
    friction    o' 'o   |o--      .  the peak between two      before it and one just after it
             _o'        |
           o'           |o

Between events no figure jumps along the path. So its extremes do not depend on where the poses lie
if those at events are among them, just before and just after (an exchange of contacts, a contact
that runs over a corner, a nosing that comes under the flat or leaves it), and those at peaks
between two poses.
"""

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.traversal.brief import by_how_long
from kaidan.traversal.nosing_events import TOUCH
from kaidan.traversal.phases import Phase

Array = NDArray[np.float64]

_ALIKE = 1e-9
"""Difference of two directions that is rounding [rad]."""


def samples_of(path: contact.Path, phase: NDArray[np.str_], acceleration: float) -> contact.Sampled:
    """Poses at which the extremes of a path may lie.

    phase: phase of each pose.
    acceleration: along the path [m/s^2].

    Friction infinite where nothing holds; traction of a brief braking by how long it lasts.
    """
    count = len(path.poses)
    numbers, corner = numbers_of(phase), corners(path)
    found = contact.samples_of(path, numbers, TOUCH, acceleration=acceleration)
    seen, row = found.path, found.rows
    assert seen.margins is not None
    # between two phases stands a pose of both: what follows on it is of the second
    row[count:] += corner[row[count:]]
    lasts = np.ones(len(row), dtype=np.bool_)
    lasts[:count] = lasting(path)
    return contact.Sampled(
        path=seen,
        phase=numbers,
        corner=corner,
        row=row,
        lasts=lasts,
        friction=_friction(seen),
        traction=by_how_long(path, np.abs(seen.margins.traction), row),
        comes_off=trailing_end_leaves(seen),
    )


def numbers_of(phase: NDArray[np.str_]) -> NDArray[np.int64]:
    """Phases as numbers: 0 enters, 1 traverses, 2 lands."""
    lands = (phase == Phase.LAND.value).astype(np.int64)
    return np.asarray(lands + (phase != Phase.ENTER.value))


def lasting(path: contact.Path) -> NDArray[np.bool_]:
    """Poses in which the robot stands for a while: not in the midst of an exchange of contacts."""
    s = path.s
    at_once = np.abs(s[1:] - s[:-1]) < contact.ONE_PLACE
    lasts = np.ones(len(path.poses), dtype=np.bool_)
    lasts[1:-1] = ~(at_once[1:] & at_once[:-1])
    return lasts


def corners(path: contact.Path) -> NDArray[np.bool_]:
    """Poses at which a contact runs over a corner of the ground and takes its name."""
    poses = path.poses
    renamed = (poses.rear[1:] != poses.rear[:-1]) | (poses.front[1:] != poses.front[:-1])
    found = np.zeros(len(poses), dtype=np.bool_)
    found[1:] = poses.leads_on & renamed
    return found


def trailing_end_leaves(path: contact.Path) -> NDArray[np.bool_]:
    """Poses at which the trailing end leaves an edge as the robot goes down.

    Its contact lies beyond the flat, on the end's arc or on a face, so that it pushes the robot
    ahead more than the flat would; and the path falls.
    """
    poses = path.poses
    leaves = poses.rear_lean > np.maximum(-poses.inclination, 0.0) + _ALIKE
    leaves[leaves] = np.sin(poses.path_direction[leaves]) < 0.0
    return np.asarray(leaves)


def _friction(path: contact.Path) -> Array:
    assert path.margins is not None
    required = path.margins.required_friction
    return np.where(np.isfinite(required), required, np.inf)
