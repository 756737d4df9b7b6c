r"""How a robot holds that slips back until a grouser stands: the least on its way, by one nosing.

::

    <---- way ----.     one nosing, with a grouser that comes to stand on it, has to do at every
    | .  '  belt  |     pose of the slip; or friction
    ' nosing
"""

from __future__ import annotations

import math

from kaidan.contact.entries import entry
from kaidan.contact.layout import Pose
from kaidan.contact.memory import Row, Table

#: Poses that a slip passes at most.
MOST_SHIFTS = 1000


def held_by(
    points: Row[int], standing: Row[float], friction: Row[float], slots: int, row: int, point: int
) -> float:
    """Margin at a pose by friction, or by a grouser that stands at one point of the ground."""
    most = -math.inf
    if friction[row] > most:
        most = friction[row]
    for slot in range(slots):
        if points[row * slots + slot] == point and standing[row * slots + slot] > most:
            most = standing[row * slots + slot]
    return most


def is_unlike_before(points: Row[int], slots: int) -> bool:
    """Whether a path begins with one end on a floor and the other one at a nosing.

    A robot that slips back from there comes before that riser, of which the path knows nothing.
    """
    return slots > 1 and (points[0] < 0) != (points[1] < 0)


@entry
def held_while_slipping(
    poses: Table[Pose], points: Row[int], standing: Row[float], friction: Row[float], slots: int,
    sense: int, way: float, over: float, found: Row[float],
) -> None:  # fmt: skip
    """Work out with how much to spare each pose holds before the robot slips for good.

    A slip towards the beginning that leads beyond it is held there as at the beginning, unless
    that is on a floor and at a nosing at once.

    Parameters
    ----------
    poses
        Of :func:`kaidan.contact.kernel.driver.drive`.
    points
        Point of the ground of each contact at which a grouser may stand, pose by pose; -1: none.
    standing
        Margin with a grouser that stands there [rad].
    friction
        Margin of each pose by friction alone [rad].
    slots
        Contacts of a pose.
    sense
        +1 where the robot slips towards the end of the path, -1 towards its beginning.
    way
        Arclength of the slip [m].
    over
        Arclength that nothing holds and that a slip towards the end passes over, before poses from
        which one nosing holds all along that way [m].
    found
        To be filled [rad].
    """
    count = len(poses)
    for row in range(count):
        most = friction[row]
        for slot in range(slots):
            point = points[row * slots + slot]
            if point < 0:
                continue
            least = max(friction[row], standing[row * slots + slot])
            there = row
            for _ in range(min(count, MOST_SHIFTS)):
                there += sense
                if there < 0 and is_unlike_before(points, slots):
                    least = -math.inf
                if (
                    there < 0
                    or there >= count
                    or poses[there].leg != poses[row].leg
                    or abs(poses[there].s - poses[row].s) >= way
                    or not least > most
                ):
                    break
                held = held_by(points, standing, friction, slots, there, point)
                least = min(least, held)
            if least > most:
                most = least
        found[row] = most
    if sense > 0:
        for row in range(count):
            there = row + 1
            while there < count and poses[there].leg == poses[row].leg:
                if poses[there].s - poses[row].s >= over:
                    break
                # friction at one pose does not stop what slides
                if found[there] > friction[there] and found[there] > found[row]:
                    found[row] = found[there]
                there += 1
