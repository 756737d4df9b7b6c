"""A robot at rest from scratch: settled at a place, or at rest at a given inclination."""

from __future__ import annotations

import math
from typing import NamedTuple

from numpy.typing import ArrayLike

from kaidan.contact.kernel.trigonometry import cos, placed, sin
from kaidan.contact.remembered import body_of, ground_of
from kaidan.contact.switch import kernel


class Settled(NamedTuple):
    """A stable pose; ``found`` is False if the robot turns past 90 degrees."""

    found: bool
    z: float
    """Height of the centroid [m]."""
    inclination: float
    """[rad]"""
    rear: int
    """Feature of the rear contact, read by `Feature.of`."""
    front: int
    """Feature of the front contact, read by `Feature.of`; -1 if none was found."""
    points: tuple[tuple[float, float], tuple[float, float]]
    """Points of the rear and the front contact [m]; NaN if none was found."""


def settle(
    terrain: ArrayLike,
    parts: ArrayLike,
    x: float,
    inclination: float = 0.0,
    *,
    kinds: ArrayLike | None = None,
) -> Settled:
    """Stable pose at centroid x in which the robot settles from an inclination.

    Examples
    --------
    >>> pose = settle([[0, 0], [4, 0]], [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]], 2.0, 0.1)
    >>> round(pose.z, 6), abs(round(pose.inclination, 12))
    (0.071, 0.0)
    """
    scene = ground_of(terrain), body_of(parts, kinds)
    found, z, angle, rear, front = kernel().settle(scene, x, inclination, 0.0)
    rear_point = front_point = (math.nan, math.nan)
    if found:
        at = placed(x, z, angle)
        rear_point, front_point = (kernel().gap(scene, each, at)[3:] for each in (rear, front))
    return Settled(
        bool(found), float(z), float(angle), int(rear), int(front), (rear_point, front_point)
    )


def resting_height(
    terrain: ArrayLike,
    parts: ArrayLike,
    x: float,
    inclination: float,
    *,
    kinds: ArrayLike | None = None,
) -> float:
    """Lowest height of the centroid at which nothing is penetrated, at a given inclination [m].

    Examples
    --------
    >>> robot = [[-0.274, -0.011, 0.06, 0.196, -0.011, 0.06]]
    >>> round(resting_height([[0, 0], [4, 0]], robot, 2.0, 0.0), 6)
    0.071
    """
    scene = ground_of(terrain), body_of(parts, kinds)
    z, _ = kernel().touching(scene, x, cos(inclination), sin(inclination))
    return float(z)
