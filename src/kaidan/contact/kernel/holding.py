r"""With how much to spare belts with grousers hold a robot all along a path.

::

    poses -> supports -> those alike          of each case of grousers:
                              |        friction of the belts, a grouser that stands
                              `----->  at each support, the slip until one does
                                              |
                                              `-> least of all poses
"""

from __future__ import annotations

import math

from kaidan.contact.columns import (
    FRICTION,
    GROUSER_BEST,
    GROUSER_FACES,
    GROUSER_HEIGHT,
    GROUSER_NOSINGS,
    GROUSER_RADIUS,
    GROUSER_RIGID,
    GROUSER_SPACING,
    GROUSER_TREADS,
    GROUSER_WIDTH,
    LOAD_COULOMB,
    LOAD_X,
    LOAD_Z,
    POSE_PSI,
    POSE_S,
    R1,
    R2,
    SUPPORT_POINT,
    TILT,
    X1,
    X2,
    Z1,
    Z2,
)
from kaidan.contact.kernel.grip import belt_margins, standing_margins
from kaidan.contact.kernel.margins import ONE_PLACE
from kaidan.contact.kernel.slipping import held_while_slipping
from kaidan.contact.kernel.supports import find_alike, find_supports
from kaidan.contact.tables import (
    BodyTable,
    FloatRow,
    GroundTable,
    GrouserTable,
    IntArray,
    LoadTable,
    MarginTable,
    PoseTable,
    SupportTable,
)

#: Supports of a pose for which there is room at first, and at most.
ROOM = 4
MOST_SUPPORTS = 8


def loads_of(
    poses: PoseTable, n_pose: int, margins: MarginTable, a: float, g: float, loads: LoadTable
) -> None:
    """Write the load of each pose, and the angle of friction that smooth belts require."""
    for row in range(n_pose):
        size = math.sqrt(g * g + a * a + 2.0 * g * a * math.sin(poses[row, POSE_PSI]))
        tilt = margins[row, TILT]
        down = math.sqrt(1.0 + tilt * tilt)
        loads[row, LOAD_X] = size * tilt / down
        loads[row, LOAD_Z] = size / down
        loads[row, LOAD_COULOMB] = math.atan2(margins[row, FRICTION], 1.0)


def reach_of(body: BodyTable) -> float:
    """Distance from the centroid that no part of a robot exceeds [m]."""
    reach = 0.0
    for part in range(body.shape[0]):
        reach = max(reach, abs(body[part, X1]) + abs(body[part, Z1]) + body[part, R1])
        reach = max(reach, abs(body[part, X2]) + abs(body[part, Z2]) + body[part, R2])
    return reach


def is_passing(poses: PoseTable, n_pose: int, row: int) -> bool:
    """Whether a pose is in the midst of an exchange of contacts, both beside it at its place."""
    if row == 0 or row == n_pose - 1:
        return False
    s = poses[row, POSE_S]
    behind = abs(s - poses[row - 1, POSE_S])
    return bool(max(behind, abs(poses[row + 1, POSE_S] - s)) < ONE_PLACE)


def find_standing(
    ground: GroundTable, body: BodyTable, poses: PoseTable, n_pose: int, margins: MarginTable,
    a: float, g: float, treads: FloatRow, climbs: bool, steep: float, touch: float,
    supports: SupportTable, loads: LoadTable, unlike: IntArray, like: IntArray, points: IntArray,
) -> int:  # fmt: skip
    """Find what each pose of a path stands on, and which ones stand alike.

    Parameters
    ----------
    ground, body, poses, n_pose, margins
        Terrain, robot, its path, and the margins of its poses.
    a, g
        Acceleration along the path, gravity [m/s^2].
    treads, climbs, steep, touch
        As for :func:`kaidan.contact.kernel.supports.find_supports`.
    supports, loads, unlike, like, points
        To be filled: `MOST_SUPPORTS` rows a pose of the first and of points.

    Returns
    -------
    rows a pose of the supports; 0 where more of them than there is room for touch one
    """
    driven = poses[0:n_pose]
    loaded = loads[0:n_pose]
    loads_of(poses, n_pose, margins, a, g, loads)
    reach = reach_of(body)
    slots = ROOM
    most = find_supports(
        ground, body, body.shape[0], False, driven, treads, climbs, steep, touch, reach, supports,
        slots,
    )  # fmt: skip
    if most > MOST_SUPPORTS:
        return 0
    if most > slots:
        slots = most
        find_supports(
            ground, body, body.shape[0], False, driven, treads, climbs, steep, touch, reach,
            supports, slots,
        )  # fmt: skip
    for at in range(n_pose * slots):
        points[at] = int(supports[at, SUPPORT_POINT])
    find_alike(supports, slots, loaded, unlike, like)
    return slots


def least_held(
    poses: PoseTable, n_pose: int, climbs: bool, slip: float, grousers: GrouserTable, best: bool,
    counts: IntArray, slots: int, supports: SupportTable, loads: LoadTable, like: IntArray,
    points: IntArray, standing: FloatRow, friction: FloatRow, held: FloatRow,
) -> float:  # fmt: skip
    """Least margin of the poses that count with grousers, all of whose cases have to hold [rad].

    See `kaidan.traversal.grip.Grip`, pose by pose.

    Parameters
    ----------
    poses, n_pose
        Path.
    climbs
        Whether it leads up the stairs.
    slip
        How far beyond the spacing of grousers a slip is followed [m].
    grousers, best
        Cases of grousers, one a row, and whether those of the best case count, or of the worst.
    counts
        Which poses count (1), by where they are.
    slots, supports, loads, like, points
        As `find_standing` finds them.
    standing, friction, held
        Scratch: `MOST_SUPPORTS` rows a pose of the first.
    """
    driven = poses[0:n_pose]
    loaded = loads[0:n_pose]
    least = math.inf
    for case in range(grousers.shape[0]):
        if (grousers[case, GROUSER_BEST] > 0.0) != best:
            continue
        nosings = grousers[case, GROUSER_NOSINGS]
        treads = grousers[case, GROUSER_TREADS]
        faces = grousers[case, GROUSER_FACES]
        rigid = grousers[case, GROUSER_RIGID] > 0.0
        height = grousers[case, GROUSER_HEIGHT] if rigid else 0.0
        belt_margins(supports, slots, loaded, like, nosings, treads, faces, height, friction)
        standing_margins(
            supports, slots, loaded, like, nosings, treads, faces,
            grousers[case, GROUSER_HEIGHT], grousers[case, GROUSER_SPACING],
            grousers[case, GROUSER_WIDTH], grousers[case, GROUSER_RADIUS], rigid,
            1.0 if climbs else -1.0, standing,
        )  # fmt: skip
        held_while_slipping(
            driven, points, standing, friction, slots, -1 if climbs else 1,
            grousers[case, GROUSER_SPACING] + slip, grousers[case, GROUSER_SPACING], held,
        )  # fmt: skip
        for row in range(n_pose):
            if counts[row] == 1 and not is_passing(poses, n_pose, row) and held[row] < least:
                least = held[row]
    return least
