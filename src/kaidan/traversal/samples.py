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

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.traversal.brief import by_how_long
from kaidan.traversal.nosing_events import nosing_events
from kaidan.traversal.phases import Phase

Array = NDArray[np.float64]
Rows = NDArray[np.int64]

TOLERANCE = 1e-4
"""Share of the largest friction of a phase above which a peak is not looked for [1]."""
_ALIKE = 1e-9
"""Difference of two directions that is rounding [rad]."""


class Samples(NamedTuple):
    """Poses of a path, and those between them at which extremes may lie."""

    path: contact.Path
    """Its own poses first."""
    row: Rows
    """Row of the path that each is, or of which it has the phase."""
    lasts: NDArray[np.bool_]
    """Whether the robot stands so for a while: not in the midst of an exchange of contacts."""
    friction: Array
    """Required friction [1]; infinite where nothing holds."""
    traction: Array
    """Tractive force along the path over mass, without its sign [N/kg]; of a brief braking by how
    long it lasts."""
    comes_off: NDArray[np.bool_]
    """Whether the trailing end leaves an edge, see `trailing_end_leaves`."""


def samples_of(path: contact.Path, phase: NDArray[np.str_], acceleration: float) -> Samples:
    """Poses at which the extremes of a path may lie.

    Parameters
    ----------
    path : contact.Path
        With margins.
    phase : ndarray of str
        Phase of each pose.
    acceleration : float
        Along the path [m/s^2].

    Returns
    -------
    Samples
    """
    nosings = nosing_events(path)
    peaks, upright = _peaks(path, phase, acceleration), _upright(path)
    count = len(path.poses)
    every = [
        path,
        contact.without_nosings(path, nosings, acceleration=acceleration),
        peaks.path,
        path.between(*upright, acceleration=acceleration),
    ]
    seen = contact.joined(every)
    assert seen.margins is not None
    traction = np.abs(seen.margins.traction)
    if len(upright[0]):
        steady, psi = _turns_steadily(path, every[-1], upright[0])
        largest = np.abs(STANDARD_GRAVITY * np.sign(np.sin(psi)) + acceleration)
        last = traction[-len(psi) :]
        last[steady] = largest[steady]
    # between two phases stands a pose of both: what follows on it is of the second
    between = np.concatenate([nosings.pose, peaks.rows, upright[0]])
    row = np.concatenate([np.arange(count), between + corners(path)[between]])
    lasts = np.ones(len(traction), dtype=np.bool_)
    lasts[:count] = lasting(path)
    return Samples(
        path=seen,
        row=row,
        lasts=lasts,
        friction=_friction(seen),
        traction=by_how_long(path, traction, row),
        comes_off=trailing_end_leaves(seen),
    )


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


def _peaks(path: contact.Path, phase: NDArray[np.str_], acceleration: float) -> contact.Between:
    """Poses between two where the friction required in a phase may be the largest."""
    values = _friction(path)
    slides = trailing_end_leaves(path) & (phase == Phase.LAND.value)
    group = np.where(slides, len(Phase), -1)
    for number, name in enumerate(Phase):
        group[(phase == name.value) & ~slides] = number
    narrow = _along_ends(path)
    return contact.friction_peaks(path, values, group, narrow, TOLERANCE, acceleration=acceleration)


def _along_ends(path: contact.Path) -> NDArray[np.bool_]:
    """Whether a nosing moves along the end of a belt from a pose to the next.

    There the belt gives way at it up to some height and then no more: two kinks of the friction,
    which may be nearer to one another than the poses.
    """
    poses, on = path.poses, path.poses.leads_on
    moves = np.zeros_like(on)
    for features, normal in ((poses.rear, poses.rear_normal), (poses.front, poses.front_normal)):
        corner = contact.FeatureTable.of(features).kind == contact.FeatureKind.VERTEX
        on_body = np.arctan2(normal[:, 0], normal[:, 1]) + poses.inclination
        turns = np.abs(on_body[1:] - on_body[:-1]) > _ALIKE
        moves |= turns & (corner[1:] | corner[:-1])
    return np.asarray(moves & on)


def _upright(path: contact.Path) -> tuple[Rows, Array]:
    """Places between two poses where the path may stand upright, and the traction is the largest.

    Returns
    -------
    rows, shares
        Row before each, and the share of the arclength to the next.
    """
    psi = path.poses.path_direction
    along = np.cos(psi)
    # between two directions on one side of upright the path does not pass it
    some = np.flatnonzero(path.poses.leads_on & (along[:-1] * along[1:] < _ALIKE))
    swept = _turn(psi[some], psi[some + 1])
    rows, shares = [], []
    for upright in (math.pi / 2, -math.pi / 2):
        away = _turn(psi[some], upright)
        passed = (away * swept > 0) & (np.abs(away) < np.abs(swept))
        rows.append(some[passed])
        shares.append(away[passed] / swept[passed])
    return np.concatenate(rows), np.concatenate(shares)


def _turns_steadily(
    path: contact.Path, between: contact.Path, rows: Rows
) -> tuple[NDArray[np.bool_], Array]:
    """Whether the path turns steadily from pose to pose over those in between; directions there.

    Where it comes to a stand and goes back, its direction jumps: nothing stands upright there.
    """
    psi, middle = path.poses.path_direction, between.poses.path_direction
    first, then = _turn(psi[rows], middle), _turn(middle, psi[rows + 1])
    steady = (first * then > 0) & (np.abs(first) < math.pi / 2) & (np.abs(then) < math.pi / 2)
    return np.asarray(steady), middle


def _turn(one: Array, other: Array | float) -> Array:
    """Angle from directions to others, within half a revolution [rad]."""
    return np.asarray(np.angle(np.exp(1j * (other - one))))
