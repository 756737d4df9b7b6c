r"""Turning on a landing: drive and spin, back and forth, until the robot faces the next flight.

::

          arriving lane   next flight
         |      ^       |   |||||||   |
         |      |       |   |||||||   |
         |  .-------.   |-------------|   the footprint stays off every wall; its turning centre
         |  |   o   |                 |   stays on the landing, so that it does not tip down the
         |  '-------'                 |   flight over which its tail still hangs
         '----------------------------'
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from kaidan.mechanics.footprint import Footprint, blocked, inside, to_walls

Array = NDArray[np.float64]

STRIDE = 0.03
"""Length of a drive of the search, and of a cell in which one pose of a heading is kept [m]."""
TURN = np.radians(5.0)
"""Largest turn of one step of the search [rad]."""
BEYOND = np.radians(60.0)
"""How far a manoeuvre may turn further than it must [rad]."""
ABOUT_FACE = np.radians(150.0)
"""Turn from which it may be made either way round [rad]."""
MOST_STEPS = 800
_THINNED = 4
"""Of the places to turn on the spot, which lie 5 mm apart, every how many-th is tried."""
_DRIVES = np.array([1, -1, 0, 0])
_SPINS = np.array([0, 0, 1, -1])


class Goal(NamedTuple):
    """Where the way goes on: the foot of the next flight, or a passage."""

    x: float
    y: float
    """Middle of its first riser [m]."""
    heading: float
    """Of the flight [rad]."""
    width: float
    """Clear width of the flight [m]."""
    level: bool = False
    """Whether a level passage begins there instead, into which the front may reach."""


class Manoeuvre(NamedTuple):
    """How a robot turns on a landing."""

    poses: Array
    """Shape (n, 3): x, y of the turning centre [m] and heading [rad], from the start on."""
    moves: int
    """Drives and turns on the spot in a row, each until the next begins."""
    reversals: int
    """Changes between driving forward and back."""


def manoeuvre(
    footprint: Footprint,
    *,
    start: tuple[float, float, float],
    goal: Goal,
    landing: Array,
    walls: Array,
) -> Manoeuvre | None:
    """Shortest manoeuvre that is found from one flight to the foot of the next; None: none.

    A breadth-first search over poses that the robot really reaches: one stride straight on or
    back, or one step of a turn on the spot, of which each cell keeps the first. What it finds can
    be driven; that it finds nothing is no proof below the size of a cell.

    Parameters
    ----------
    footprint : Footprint
    start : (float, float, float)
        x, y [m] and heading [rad] on arrival.
    goal : Goal
    landing : array, shape (n, 2)
        Corners of the landing, on which the turning centre stays [m].
    walls : array, shape (m, 4)
        Segments that the footprint may not cross [m].

    Returns
    -------
    Manoeuvre or None

    Examples
    --------
    A landing of 1.2 by 2.2 m between two lanes of 1 m, for a robot 0.7 by 0.5 m and another 2 m:

    >>> from kaidan.mechanics.footprint import walls_of
    >>> landing = np.array([(0, 0), (1.2, 0), (1.2, 2.2), (0, 2.2)])
    >>> room = np.array([(-1, 0), (1.2, 0), (1.2, 2.2), (0, 2.2), (0, 1), (-1, 1)])
    >>> case = dict(start=(0.02, 0.5, 0.0), goal=Goal(0.0, 1.7, np.pi, 1.0), landing=landing,
    ...              walls=walls_of(room))
    >>> manoeuvre(Footprint(0.35, 0.35, 0.5), **case).moves
    8
    >>> manoeuvre(Footprint(1.0, 1.0, 0.5), **case) is None
    True

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    turn = (goal.heading - start[2] + np.pi) % (2 * np.pi) - np.pi
    steps = max(1, int(np.ceil(abs(turn) / TURN - 1e-9)))
    each = abs(turn) / steps or TURN
    spare = int(BEYOND / each)
    goals = {steps if turn > 0 else -steps} if turn else {0}
    low, high = min(0, *goals) - spare, max(0, *goals) + spare
    if abs(turn) > ABOUT_FACE and np.isclose(abs(turn), np.pi):
        goals = {-steps, steps}
        low, high = -steps - spare, steps + spare
    corners = np.vstack([landing, start[:2]])
    reach = float(np.linalg.norm(corners - start[:2], axis=1).max())
    half = int(reach / STRIDE) + 2
    seen = np.zeros((high - low + 1, 2 * half, 2 * half), dtype=bool)
    poses = [np.array([start])]
    turns = [np.zeros(1, dtype=np.int64)]
    parents = [np.full(1, -1)]
    if blocked(footprint, poses[0], walls)[0]:
        return None
    total, kind = 0, np.zeros(1, dtype=np.int64)
    for _ in range(MOST_STEPS):
        at, k = poses[-1], turns[-1]
        arrived = _arrived(footprint, at, k, goals, goal)
        if arrived.any():
            return _path(poses, turns, parents, int(np.argmax(arrived)))
        along = STRIDE * np.column_stack([np.cos(at[:, 2]), np.sin(at[:, 2]), 0 * k])
        spun = np.array([0.0, 0.0, each])
        new = (at[:, None] + along[:, None] * _DRIVES[:, None] + spun * _SPINS[:, None]).reshape(
            -1, 3
        )
        new_k = (k[:, None] + _SPINS).ravel()
        parent = total + np.repeat(np.arange(len(k)), 4)
        new_kind = np.tile(np.arange(1, 5), len(k))
        goes_on = np.argsort(new_kind != np.repeat(kind, 4), kind="stable")  # these come first
        fine = goes_on[
            (new_k[goes_on] >= low) & (new_k[goes_on] <= high) & inside(new[goes_on, :2], landing)
        ]
        total += len(k)
        cell = half + _cell(new[fine], start)
        code = np.ravel_multi_index((new_k[fine] - low, cell[:, 0], cell[:, 1]), seen.shape)
        fresh = fine[~seen.ravel()[code]]
        code = code[~seen.ravel()[code]]
        code, first = np.unique(code, return_index=True)
        free = ~blocked(footprint, new[fresh[first]], walls)
        keep = np.sort(first[free])
        if len(keep) == 0:
            return None
        seen.ravel()[code[free]] = True
        keep = fresh[keep]
        poses.append(new[keep])
        turns.append(new_k[keep])
        parents.append(parent[keep])
        kind = new_kind[keep]
    return None


def _cell(at: Array, start: tuple[float, float, float]) -> NDArray[np.int64]:
    """Cell of each pose along and across its own heading, from the start, shape (n, 2).

    A drive leads along a row of them, however little the heading differs from another.
    """
    cos, sin = np.cos(at[:, 2]), np.sin(at[:, 2])
    dx, dy = (at[:, :2] - start[:2]).T
    along_across = np.column_stack([dx * cos + dy * sin, dy * cos - dx * sin])
    return np.floor(along_across / STRIDE + 0.5).astype(np.int64)


def _arrived(
    footprint: Footprint, at: Array, k: NDArray[np.int64], goals: set[int], goal: Goal
) -> NDArray[np.bool_]:
    """Whether poses stand before the next flight, in line with it, within a stride of its riser."""
    cos, sin = np.cos(goal.heading), np.sin(goal.heading)
    dx, dy = goal.x - at[:, 0], goal.y - at[:, 1]
    ahead = dx * cos + dy * sin - footprint.front
    off = np.abs(dy * cos - dx * sin)
    return np.asarray(
        np.isin(k, list(goals))
        & (ahead <= STRIDE)
        & ((ahead >= -STRIDE) | goal.level)
        & (off <= (goal.width - footprint.width) / 2)
    )


def on_the_spot(
    footprint: Footprint,
    *,
    start: tuple[float, float, float],
    goal: Goal,
    landing: Array,
    walls: Array,
) -> Manoeuvre | None:
    """Drive on, turn on the spot, drive across, turn again, drive on; None: the circle has no room.

    Where a robot has room for the circle that it sweeps, on the line by which it arrives, on that
    by which it goes on, and between. The shortest free drive across is taken. Parameters and
    what is returned are those of `manoeuvre`.

    Examples
    --------
    >>> from kaidan.mechanics.footprint import walls_of
    >>> landing = np.array([(0, 0), (1.2, 0), (1.2, 2.2), (0, 2.2)])
    >>> room = np.array([(-1, 0), (1.2, 0), (1.2, 2.2), (0, 2.2), (0, 1), (-1, 1)])
    >>> found = on_the_spot(Footprint(0.35, 0.35, 0.5), start=(0.02, 0.5, 0.0), landing=landing,
    ...                     goal=Goal(0.0, 1.7, np.pi, 1.0), walls=walls_of(room))
    >>> found.moves, found.reversals
    (5, 0)

    References
    ----------
    Derived: docs/theory/clearance.md.
    """
    radius = np.hypot(max(footprint.front, footprint.rear), footprint.width / 2)
    long = float(np.ptp(landing, axis=0).sum())
    here, there = np.array(start[:2]), np.array([goal.x, goal.y])
    ahead, onward = _ahead(start[2]), _ahead(goal.heading)
    along = np.arange(0.0, long, STRIDE / 6)
    back = along + (0.0 if goal.level else footprint.front)
    sine = float(ahead[0] * onward[1] - ahead[1] * onward[0])
    if abs(sine) > 1e-6:  # the lines meet
        off = there - here
        meets = float(off[0] * onward[1] - off[1] * onward[0]) / sine
        before = float((here + meets * ahead - there) @ -onward)
        along, back = np.append(along, max(meets, 0.0)), np.append(back, max(before, back[0]))
    first, last = here + along[:, None] * ahead, there - back[:, None] * onward
    room = [inside(each, landing) & (to_walls(each, walls) >= radius) for each in (first, last)]
    first, last, back = first[room[0]], last[room[1]], back[room[1]]
    if not (len(first) and len(last)):
        return None
    apart = np.linalg.norm(first[:, None] - last, axis=2)
    # from each place on the first line to the nearest one on the other, the shortest way first
    nearest = apart.argmin(axis=1)
    ways = apart[np.arange(len(first)), nearest].round(4)
    for i in np.argsort(ways, kind="stable")[::_THINNED]:
        j = nearest[i]
        across = last[j] - first[i]
        between = first[i] + np.linspace(0.0, 1.0, 2 + int(apart[i, j] / STRIDE))[:, None] * across
        if (inside(between, landing) & (to_walls(between, walls) >= radius)).all():
            break
    else:
        return None
    # landings end some millimetres before the riser
    short = 0.0 if goal.level else footprint.front + STRIDE
    heading = start[2]
    if apart[i, j] > 1e-6:
        heading = float(np.arctan2(across[1], across[0]))
    legs = [
        _leg(here, first[i], start[2]),
        _leg(first[i], last[j], heading),
        _leg(last[j], there - min(back[j], short) * onward, goal.heading),
    ]
    poses = np.vstack(legs)
    if blocked(footprint, poses, walls).any():
        return None
    turns = np.diff([start[2], heading, goal.heading])
    spins = int((np.abs(np.sin(turns / 2)) > 1e-6).sum())
    drives = sum(len(leg) > 1 for leg in legs)
    return Manoeuvre(poses, drives + spins, 0)


def _ahead(heading: float) -> Array:
    return np.array([np.cos(heading), np.sin(heading)])


def _leg(start: Array, end: Array, heading: float) -> Array:
    """Poses of a drive straight on, or of none, a stride apart."""
    length = float(np.linalg.norm(end - start))
    shares = np.linspace(0.0, 1.0, 1 + int(np.ceil(length / STRIDE - 1e-6)))[:, None]
    at = start + shares * (end - start)
    return np.column_stack([at, np.full(len(at), heading)])


def _path(
    poses: list[Array], turns: list[NDArray[np.int64]], parents: list[NDArray[np.int64]], last: int
) -> Manoeuvre:
    """Poses from the start to one of the last wave, and how many moves they are."""
    every, turned, before = np.vstack(poses), np.concatenate(turns), np.concatenate(parents)
    at = len(every) - len(poses[-1]) + last
    line = []
    while at >= 0:
        line.append(at)
        at = int(before[at])
    line.reverse()
    path, k = every[line], turned[line]
    forward = np.cos(path[:-1, 2]) * np.diff(path[:, 0]) + np.sin(path[:-1, 2]) * np.diff(
        path[:, 1]
    )
    kinds = np.where(np.diff(k) != 0, 2 * np.sign(np.diff(k)), np.sign(forward))
    drives = kinds[np.abs(kinds) == 1]
    return Manoeuvre(
        path,
        int(len(kinds) > 0) + int((np.diff(kinds) != 0).sum()),
        int((np.diff(drives) != 0).sum()),
    )
