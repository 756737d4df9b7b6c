r"""Poses at which the extremes of a traverse may lie: its own, and some between them.

::

    required      .            o  a pose of the path        |  exchange of contacts: a pose just
    friction    o' 'o   |o--      .  the peak between two      before it and one just after it
             _o'        |
           o'           |o

Between events every figure is smooth along the path. So its extremes do not depend on where the
poses lie if those at events are among them, just before and just after (an exchange of contacts, a
contact that runs over a corner, a nosing that comes under the flat or leaves it), and those at
peaks between two poses.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan import contact
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.traversal.nosing_events import nosing_events
from kaidan.traversal.phases import Phase

Array = NDArray[np.float64]
Rows = NDArray[np.int64]

MOST_PEAKS = 4
"""Peaks between poses that are looked at in a phase: the most promising first."""
PROMISE = 0.25
"""How far a peak may rise over the highest of three poses, over their difference [1]: an eighth for
a parabola, the rest for what is no parabola."""
TOLERANCE = 1e-4
"""Share of a figure below which a peak promises too little to be looked at [1]."""
ROUNDS = 6
"""Times that the poses about a peak are halved, at most."""
_ONE_PLACE = 1e-8
"""Distance of poses that stand at one place, where several contacts are exchanged [m]."""
_JUST = 2e-5
"""How far beside an event a pose is looked at [m]: contacts count within 1e-9 m, and an end with a
radius of 0.2 m is that near to a nosing over sqrt(2 R 1e-9 m)."""
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
    """Tractive force along the path over mass, without its sign [N/kg]."""
    comes_off: NDArray[np.bool_]
    """Whether the trailing end leaves an edge, see `trailing_end_leaves`."""


def samples_of(
    path: contact.Path, phase: NDArray[np.str_], acceleration: float, *, whole: bool
) -> Samples:
    """Poses at which the extremes of a path may lie.

    Parameters
    ----------
    path : contact.Path
        With margins.
    phase : ndarray of str
        Phase of each pose.
    acceleration : float
        Along the path [m/s^2].
    whole : bool
        Whether a flat carries all along, so that on the flight the tilt of no pose is needed.

    Returns
    -------
    Samples
    """
    nosings = nosing_events(path)
    tilted = (phase[nosings.pose] != Phase.TRAVERSE.value) | (not whole)
    beside = _beside(path, nosings.pose[tilted], nosings.s[tilted])
    peaks, upright = _peaks(path, phase, acceleration), _upright(path)
    count = len(path.poses)
    every = [
        path,
        path.without(nosings, acceleration=acceleration),
        *peaks[0],
        path.between(*beside, acceleration=acceleration),
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
    between = np.concatenate([nosings.pose, peaks[1], beside[0], upright[0]])
    lasts = np.ones(len(traction), dtype=np.bool_)
    lasts[:count] = lasting(path)
    return Samples(
        path=seen,
        row=np.concatenate([np.arange(count), between + corners(path)[between]]),
        lasts=lasts,
        friction=_friction(seen),
        traction=traction,
        comes_off=trailing_end_leaves(seen),
    )


def lasting(path: contact.Path) -> NDArray[np.bool_]:
    """Poses in which the robot stands for a while: not in the midst of an exchange of contacts."""
    at_once = np.abs(np.diff(path.s)) < _ONE_PLACE
    lasts = np.ones(len(path.poses), dtype=np.bool_)
    lasts[1:-1] = ~(at_once[1:] & at_once[:-1])
    return lasts


def _beside(path: contact.Path, rows: Rows, s: Array) -> tuple[Rows, Array]:
    """Places just before and just after those where a nosing comes under the flat or leaves it.

    There the nosing just does not carry, or just does; in between rounding would decide.

    Returns
    -------
    rows, shares
        Row before each, and the share of the arclength to the next.
    """
    begin = path.s[rows]
    length = path.s[rows + 1] - begin
    shares = [np.clip((s + off - begin) / length, 0.0, 1.0) for off in (-_JUST, _JUST)]
    return np.tile(rows, 2), np.concatenate(shares)


def corners(path: contact.Path) -> NDArray[np.bool_]:
    """Poses at which a contact runs over a corner of the ground and takes its name."""
    poses = path.poses
    renamed = (poses.rear[1:] != poses.rear[:-1]) | (poses.front[1:] != poses.front[:-1])
    found = np.zeros(len(poses), dtype=np.bool_)
    found[1:] = _leads_on(path) & renamed
    return found


def trailing_end_leaves(path: contact.Path) -> NDArray[np.bool_]:
    """Poses at which the trailing end leaves an edge as the robot goes down.

    Its contact lies beyond the flat, on the end's arc or on a face, so that it pushes the robot
    ahead more than the flat would; and the path falls.
    """
    poses = path.poses
    flat = np.maximum(-poses.inclination, 0.0)
    return np.asarray((poses.rear_lean > flat + _ALIKE) & (np.sin(poses.path_direction) < 0.0))


def _friction(path: contact.Path) -> Array:
    assert path.margins is not None
    required = path.margins.required_friction
    return np.where(np.isfinite(required), required, np.inf)


def _leads_on(path: contact.Path) -> NDArray[np.bool_]:
    """Whether the path leads on from each pose to the next along one line of poses."""
    poses = path.poses
    return np.asarray((poses.leg[1:] == poses.leg[:-1]) & (np.diff(poses.s) > _ONE_PLACE))


def _peaks(
    path: contact.Path, phase: NDArray[np.str_], acceleration: float
) -> tuple[list[contact.Path], Rows]:
    """Poses between two where the friction required in a phase may be the largest.

    Three poses whose middle one is the highest hold a peak. Halfway between them two more are
    looked at, and again about the highest, until hardly anything lies between them.

    Returns
    -------
    poses, rows
        Some at a time, and the row before each.
    """
    middle = _highest_of_three(path, phase)
    s = np.stack([path.s[middle - 1], path.s[middle], path.s[middle + 1]])
    friction = _friction(path)
    values = np.stack([friction[middle - 1], friction[middle], friction[middle + 1]])
    found: list[contact.Path] = []
    rows = [np.empty(0, dtype=np.int64)]
    for _ in range(ROUNDS):
        open_ = np.flatnonzero(values[1] - values.min(axis=0) > 10.0 * TOLERANCE * values[1])
        if len(open_) == 0:
            break
        s, values, middle = s[:, open_], values[:, open_], middle[open_]
        halves = (s[:-1] + s[1:]) / 2.0
        row = middle - (halves < path.s[middle])
        begin = path.s[row]
        share = np.clip((halves - begin) / (path.s[row + 1] - begin), 0.0, 1.0)
        new = path.between(row.ravel(), share.ravel(), acceleration=acceleration)
        found.append(new)
        rows.append(row.ravel())
        five = np.stack([s[0], halves[0], s[1], halves[1], s[2]])
        of_five = values[[0, 0, 1, 1, 2]]
        of_five[1::2] = _friction(new).reshape(2, -1)
        high = np.clip(of_five.argmax(axis=0), 1, 3)
        about = high + np.array([[-1], [0], [1]])
        s, values = np.take_along_axis(five, about, 0), np.take_along_axis(of_five, about, 0)
    return found, np.concatenate(rows)


def _highest_of_three(path: contact.Path, phase: NDArray[np.str_]) -> Rows:
    """Rows of the middle one of three poses, which is the highest and may promise most."""
    values = _friction(path)
    slides = trailing_end_leaves(path) & (phase == Phase.LAND.value)
    pieces = _leads_on(path) & np.isfinite(values[1:])
    last, here, then = values[:-2], values[1:-1], values[2:]
    with np.errstate(invalid="ignore"):  # no friction is enough on both sides: no peak
        promise = here + PROMISE * (here - np.minimum(last, then))
    peak = pieces[1:] & pieces[:-1] & (here >= last) & (here >= then)
    chosen: list[int] = []
    for name in Phase:
        of_phase = phase == name.value
        largest = values[of_phase & ~slides].max(initial=0.0)
        more = of_phase[1:-1] & peak & (promise > largest * (1.0 + TOLERANCE))
        numbers = np.flatnonzero(more)
        chosen += numbers[np.argsort(-promise[numbers], kind="stable")][:MOST_PEAKS].tolist()
    return np.array(chosen, dtype=np.int64) + 1


def _upright(path: contact.Path) -> tuple[Rows, Array]:
    """Places between two poses where the path may stand upright, and the traction is the largest.

    Returns
    -------
    rows, shares
        Row before each, and the share of the arclength to the next.
    """
    psi = path.poses.path_direction
    swept = _turn(psi[:-1], psi[1:])
    rows, shares = [], []
    for upright in (math.pi / 2, -math.pi / 2):
        away = _turn(psi[:-1], upright)
        passed = _leads_on(path) & (away * swept > 0) & (np.abs(away) < np.abs(swept))
        rows.append(np.flatnonzero(passed))
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
