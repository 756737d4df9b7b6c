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

from kaidan.contact.kernel.grip import belt_margins, standing_margins
from kaidan.contact.kernel.margins import ONE_PLACE
from kaidan.contact.kernel.slipping import held_while_slipping
from kaidan.contact.kernel.supports import find_alike, find_supports
from kaidan.contact.kernel.trigonometry import atan2, sin
from kaidan.contact.layout import (
    Belts,
    Friction,
    Grousers,
    Load,
    Margin,
    Part,
    Pose,
    Pull,
    Scene,
    Stance,
    Support,
)
from kaidan.contact.memory import Row, Table, empty

#: Supports of a pose for which there is room at first, and at most.
ROOM = 4
MOST_SUPPORTS = 8


def loads_of(poses: Table[Pose], margins: Table[Margin], pull: Pull, loads: Table[Load]) -> None:
    """Write the load of each pose, and the angle of friction that smooth belts require."""
    a = pull.a
    g = pull.g
    for row in range(len(poses)):
        size = math.sqrt(g * g + a * a + 2.0 * g * a * sin(poses[row].path_direction))
        tilt = margins[row].tilt
        down = math.sqrt(1.0 + tilt * tilt)
        loads[row].x = size * tilt / down
        loads[row].z = size / down
        loads[row].coulomb = atan2(margins[row].required_friction, 1.0)


def reach_of(body: Table[Part]) -> float:
    """Distance from the centroid that no part of a robot exceeds [m]."""
    reach = 0.0
    for k in range(len(body)):
        one = body[k].one
        two = body[k].two
        reach = max(reach, abs(one.x) + abs(one.z) + one.r)
        reach = max(reach, abs(two.x) + abs(two.z) + two.r)
    return reach


def is_passing(poses: Table[Pose], row: int) -> bool:
    """Whether a pose is in the midst of an exchange of contacts, both beside it at its place."""
    if row == 0 or row == len(poses) - 1:
        return False
    s = poses[row].s
    behind = abs(s - poses[row - 1].s)
    return max(behind, abs(poses[row + 1].s - s)) < ONE_PLACE


def held_on_grousers(
    scene: Scene, poses: Table[Pose], margins: Table[Margin], pull: Pull, belts: Belts,
    counts: Row[bool],
) -> tuple[float, float]:  # fmt: skip
    """Least margins of the poses that count, with grousers in the worst and in the best case [rad].

    Infinite where more nosings than there is room for touch a flat.

    counts: which poses count, by where they are.
    """
    loads = empty(Load, len(poses))
    loads_of(poses, margins, pull, loads)
    stance = Stance(belts.climbs, belts.steep, belts.touch, reach_of(scene.body))
    supports = empty(Support, len(poses) * MOST_SUPPORTS)
    parts = len(scene.body)
    slots = ROOM
    most = find_supports(scene, parts, poses, belts.treads, stance, supports, slots)
    if most > MOST_SUPPORTS:
        return math.inf, math.inf
    if most > slots:
        slots = most
        find_supports(scene, parts, poses, belts.treads, stance, supports, slots)
    points = empty(int, len(poses) * slots)
    for k in range(len(points)):
        points[k] = supports[k].point
    like = empty(int, len(poses))
    find_alike(supports, slots, loads, like)
    worst = math.inf
    best = math.inf
    for k in range(len(belts.grousers)):
        each = belts.grousers[k]
        friction = Friction(each.nosings, each.treads, each.faces)
        grousers = Grousers(
            each.height, each.spacing, each.tip_width, each.nosing_radius, each.rigid
        )
        held = least_held(
            poses, belts.climbs, belts.slip, grousers, friction, counts, slots, supports, loads,
            like, points,
        )  # fmt: skip
        if each.best:
            best = min(best, held)
        else:
            worst = min(worst, held)
    return worst, best


def least_held(
    poses: Table[Pose], climbs: bool, slip: float, grousers: Grousers, friction: Friction,
    counts: Row[bool], slots: int, supports: Table[Support], loads: Table[Load], like: Row[int],
    points: Row[int],
) -> float:  # fmt: skip
    """Least margin of the poses that count with one case of grousers [rad].

    See `kaidan.traversal.grip.Grip`, pose by pose.

    slip: how far beyond the spacing of grousers a slip is followed [m].
    """
    height = grousers.height if grousers.rigid else 0.0
    smooth = empty(float, len(poses))
    standing = empty(float, len(poses) * slots)
    held = empty(float, len(poses))
    belt_margins(supports, slots, loads, like, friction, height, smooth)
    side = 1.0 if climbs else -1.0
    standing_margins(supports, slots, loads, like, friction, grousers, side, standing)
    spacing = grousers.spacing
    held_while_slipping(
        poses, points, standing, smooth, slots, -1 if climbs else 1, spacing + slip, spacing, held
    )
    least = math.inf
    for row in range(len(poses)):
        if counts[row] and not is_passing(poses, row) and held[row] < least:
            least = held[row]
    return least
